//! All ambiguities of the source with what was assumed, the most severe first.

use super::area::Area;
use super::entry::Doubt;
use super::process::Frame;
use super::protocol::Protocol;
use crate::ir::Severity;

/// An ambiguity, and the element that it is about.
#[derive(Debug)]
pub(super) struct Assumption<'d> {
    /// File and anchor of the element.
    pub link: String,
    /// Its address and name.
    pub about: String,
    pub doubt: &'d Doubt,
}

/// The ambiguities of one severity.
#[derive(Debug)]
pub(super) struct Ranked<'d> {
    pub severity: Severity,
    pub assumptions: Vec<Assumption<'d>>,
}

impl Severity {
    /// What a wrong assumption leads to, as a heading.
    pub(super) fn heading(self) -> &'static str {
        match self {
            Severity::Hazard => "Can move a motor or damage wiring",
            Severity::Value => "Can change a value",
            Severity::Print => "Misprints",
        }
    }
}

/// The places where a device has ambiguities.
pub(super) struct Places<'d> {
    /// The first page, and the ambiguities that belong to no element.
    pub overview: (&'d str, &'d [Doubt]),
    pub areas: &'d [Area],
    /// The page of process data.
    pub process: Option<(&'d str, &'d [Frame])>,
    /// The page of messages.
    pub protocol: Option<(&'d str, &'d Protocol)>,
}

impl<'d> Places<'d> {
    /// All ambiguities by severity, within one in the order of the pages; none for a severity without any.
    pub fn ranked(&self) -> Vec<Ranked<'d>> {
        let mut ranks = [Severity::Hazard, Severity::Value, Severity::Print]
            .map(|severity| Ranked { severity, assumptions: Vec::new() });
        for own in self.all() {
            ranks[own.doubt.severity as usize].assumptions.push(own);
        }
        ranks.into_iter().filter(|rank| !rank.assumptions.is_empty()).collect()
    }

    fn all(&self) -> Vec<Assumption<'d>> {
        let mut all = Vec::new();
        // Those with a subject are in the list of the device, and are shown a second time where that is.
        let mut add = |link: String, about: String, doubts: &'d [Doubt]| {
            let assumption = |doubt| Assumption { link: link.clone(), about: about.clone(), doubt };
            all.extend(doubts.iter().filter(|doubt| doubt.subject.is_empty()).map(assumption));
        };
        let (file, doubts) = self.overview;
        add(file.to_owned(), "Device".to_owned(), doubts);
        for area in self.areas {
            add(area.file.clone(), area.title.clone(), &area.doubts);
            for section in &area.sections {
                let anchor = section.anchor.as_deref().unwrap_or_default();
                add(format!("{}#{anchor}", area.file), named(&section.number, &section.name), &section.doubts);
                for row in &section.rows {
                    add(format!("{}#{}", area.file, row.anchor), named(&row.number, &row.name), &row.doubts);
                }
            }
        }
        if let Some((file, frames)) = self.process {
            frames.iter().for_each(|own| add(format!("{file}#{}", own.anchor), own.title.clone(), &own.doubts));
        }
        if let Some((file, protocol)) = self.protocol {
            let messages = &protocol.messages;
            messages.iter().for_each(|own| add(format!("{file}#{}", own.anchor), own.name.clone(), &own.doubts));
        }
        let with_subject = doubts.iter().filter(|doubt| !doubt.subject.is_empty());
        let assumption = |doubt: &'d Doubt| Assumption { link: file.to_owned(), about: doubt.subject.clone(), doubt };
        all.extend(with_subject.map(assumption));
        all
    }
}

fn named(number: &str, name: &str) -> String {
    format!("{number} {name}").trim().to_owned()
}
