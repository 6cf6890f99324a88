//! Collects all ambiguities in the source with the compiler's assumptions, sorted by severity.

use std::collections::HashMap;

use super::area::Area;
use super::codes::Codes;
use super::entry::Doubt;
use super::machines::Behavior;
use super::process::Frame;
use super::protocol::Protocol;
use super::split::Section;
use lexibus_codegen::ir::Severity;

/// An ambiguity and the elements that it affects. Several elements are affected if the source repeats a row.
#[derive(Debug)]
pub(super) struct Assumption<'d> {
    pub elements: Vec<Element>,
    pub doubt: &'d Doubt,
}

/// A link to an element that an ambiguity affects.
#[derive(Debug)]
pub(super) struct Element {
    /// File and anchor of the element.
    pub link: String,
    /// Address and name of the element.
    pub title: String,
}

/// All ambiguities with the same severity.
#[derive(Debug)]
pub(super) struct Ranked<'d> {
    pub severity: Severity,
    pub assumptions: Vec<Assumption<'d>>,
}

impl<'d> Section for Ranked<'d> {
    type Element = Assumption<'d>;

    fn elements(&mut self) -> &mut Vec<Assumption<'d>> {
        &mut self.assumptions
    }

    fn continued(&self) -> Self {
        Ranked { severity: self.severity, assumptions: Vec::new() }
    }

    fn texts<'t>(assumption: &'t Assumption<'d>) -> impl Iterator<Item = &'t str> {
        let Doubt { says, chosen, why, cite, .. } = assumption.doubt;
        let elements = assumption.elements.iter().flat_map(|element| [&element.link, &element.title]);
        [says, chosen, why, cite].into_iter().chain(elements).map(String::as_str)
    }
}

impl Ranked<'_> {
    /// Returns a heading that describes the effect of a wrong assumption.
    pub fn heading(&self) -> &'static str {
        match self.severity {
            Severity::Hazard => "Can move a motor or damage wiring",
            Severity::Value => "Can change a value",
            Severity::Print => "Misprints",
        }
    }
}

/// The pages of a device and the ambiguities on them.
pub(super) struct AmbiguitySources<'d> {
    /// The first page of the device, and the ambiguities that belong to no single element.
    pub overview: (&'d str, &'d [Doubt]),
    pub areas: &'d [Area],
    /// The page of process data, if there is one.
    pub process: Option<(&'d str, &'d [Frame])>,
    /// The page of messages, if there is one.
    pub protocol: Option<(&'d str, &'d Protocol)>,
    /// The page of state machines and procedures, if there is one.
    pub behavior: Option<(&'d str, &'d Behavior)>,
    /// The pages of code tables.
    pub codes: &'d [(String, String, Vec<Codes>)],
}

impl<'d> AmbiguitySources<'d> {
    /// Returns all ambiguities by severity. Severities without ambiguities are omitted.
    pub fn ranked(&self) -> Vec<Ranked<'d>> {
        let mut ranks = [Severity::Hazard, Severity::Value, Severity::Print]
            .map(|severity| Ranked { severity, assumptions: Vec::new() });
        for assumption in self.all() {
            ranks[assumption.doubt.severity as usize].assumptions.push(assumption);
        }
        ranks.into_iter().filter(|rank| !rank.assumptions.is_empty()).collect()
    }

    /// Returns all ambiguities without repetitions.
    fn all(&self) -> Vec<Assumption<'d>> {
        let mut all: Vec<Assumption<'d>> = Vec::new();
        let mut known = HashMap::new();
        self.visit(&mut |link, title, doubt| {
            // Ignore the subject and the prefix: they differ between the types of one definition, and between the overview and
            // the element, although the ambiguity is the same.
            let key = Doubt { subject: String::new(), prefix: String::new(), ..doubt.clone() };
            let at = *known.entry(key).or_insert(all.len());
            if at == all.len() {
                all.push(Assumption { elements: Vec::new(), doubt });
            }
            // An ambiguity with a subject occurs on the overview and again at each element with the subject's type.
            let title = if doubt.subject.is_empty() { title } else { &doubt.subject };
            if doubt.subject.is_empty() || all[at].elements.iter().all(|element| element.title != title) {
                all[at].elements.push(Element { link, title: title.to_owned() });
            }
        });
        all
    }

    /// Calls `visitor` for each ambiguity with the link and title of the affected element. Ambiguities on the overview
    /// that have a subject come last.
    fn visit(&self, visitor: &mut impl FnMut(String, &str, &'d Doubt)) {
        let (first, doubts) = self.overview;
        let (of_device, with_subject): (Vec<_>, Vec<_>) = doubts.iter().partition(|doubt| doubt.subject.is_empty());
        of_device.into_iter().for_each(|doubt| visitor(first.to_owned(), "Device", doubt));
        for area in self.areas {
            let file = &area.file;
            area.doubts.iter().for_each(|doubt| visitor(file.clone(), &area.title, doubt));
            for section in &area.sections {
                let (anchor, title) = (section.anchor.as_deref(), named(&section.number, &section.name));
                let link = || format!("{file}#{}", anchor.unwrap_or_default());
                section.doubts.iter().for_each(|doubt| visitor(link(), &title, doubt));
                for shared in &section.shared {
                    for row in shared.rows(&section.rows) {
                        visitor(format!("{file}#{}", row.anchor), &named(&row.number, &row.name), &shared.doubt);
                    }
                }
                for row in &section.rows {
                    let (link, title) = (|| format!("{file}#{}", row.anchor), named(&row.number, &row.name));
                    row.doubts.iter().chain(&row.doubts_of_type).for_each(|doubt| visitor(link(), &title, doubt));
                }
            }
        }
        if let Some((file, behavior)) = self.behavior {
            let machines = behavior.machines.iter().map(|machine| (&machine.anchor, &machine.title, &machine.doubts));
            let sequences = behavior.sequences.iter().map(|one| (&one.anchor, &one.name, &one.doubts));
            for (anchor, title, doubts) in machines.chain(sequences) {
                doubts.iter().for_each(|doubt| visitor(format!("{file}#{anchor}"), title, doubt));
            }
        }
        let mut visit_all = |file: &str, anchor: &str, title: &str, doubts: &'d [Doubt]| {
            doubts.iter().for_each(|doubt| visitor(format!("{file}#{anchor}"), title, doubt));
        };
        if let Some((file, frames)) = self.process {
            frames.iter().for_each(|frame| visit_all(file, &frame.anchor, &frame.title, &frame.doubts));
        }
        if let Some((file, protocol)) = self.protocol {
            protocol
                .messages
                .iter()
                .for_each(|message| visit_all(file, &message.anchor, &message.name, &message.doubts));
        }
        for (file, _, tables) in self.codes {
            tables.iter().for_each(|table| visit_all(file, &table.anchor, &table.title, &table.doubts));
        }
        with_subject.into_iter().for_each(|doubt| visitor(first.to_owned(), "Device", doubt));
    }
}

fn named(number: &str, name: &str) -> String {
    format!("{number} {name}").trim().to_owned()
}
