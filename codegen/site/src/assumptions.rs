//! Collects all ambiguities in the source with the compiler's assumptions, sorted by severity.

use std::collections::HashMap;
use std::slice::from_ref;

use super::area::Area;
use super::entry::Doubt;
use super::parts::Parts;
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

/// Returns all ambiguities of a device by severity. `first` is the first page of the device. Severities without ambiguities are
/// omitted.
pub(super) fn ranked<'d>(parts: &'d Parts, first: &str) -> Vec<Ranked<'d>> {
    let mut ranks = [Severity::Hazard, Severity::Value, Severity::Print]
        .map(|severity| Ranked { severity, assumptions: Vec::new() });
    for assumption in all(parts, first) {
        ranks[assumption.doubt.severity as usize].assumptions.push(assumption);
    }
    ranks.into_iter().filter(|rank| !rank.assumptions.is_empty()).collect()
}

/// Returns all ambiguities without repetitions.
fn all<'d>(parts: &'d Parts, first: &str) -> Vec<Assumption<'d>> {
    let mut all: Vec<Assumption<'d>> = Vec::new();
    let mut known = HashMap::new();
    visit(parts, first, |link, title, doubt| {
        // Ignore the subject and the prefix: they differ between the types of one definition, and between the overview and the
        // element, although the ambiguity is the same.
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

/// Calls `visitor` for each ambiguity with the link and title of the affected element. Ambiguities on the overview that
/// have a subject come last.
fn visit<'d>(parts: &'d Parts, first: &str, mut visitor: impl FnMut(String, &str, &'d Doubt)) {
    let mut each = |file: &str, anchor: &str, title: &str, doubts: &'d [Doubt]| {
        let hash = if anchor.is_empty() { "" } else { "#" };
        doubts.iter().for_each(|doubt| visitor(format!("{file}{hash}{anchor}"), title, doubt));
    };
    let overview = |has_subject: bool| {
        parts.overview.doubts.iter().filter(move |doubt| doubt.subject.is_empty() != has_subject).map(from_ref)
    };
    overview(false).for_each(|doubt| each(first, "", "Device", doubt));
    for Area { file, title, doubts, sections, .. } in &parts.areas {
        each(file, "", title, doubts);
        for section in sections {
            let anchor = section.anchor.as_deref().unwrap_or_default();
            each(file, anchor, &named(&section.number, &section.name), &section.doubts);
            for shared in &section.shared {
                for row in shared.rows(&section.rows) {
                    each(file, &row.anchor, &named(&row.number, &row.name), from_ref(&shared.doubt));
                }
            }
            for row in &section.rows {
                let title = named(&row.number, &row.name);
                each(file, &row.anchor, &title, &row.doubts);
                each(file, &row.anchor, &title, &row.doubts_of_type);
            }
        }
    }
    if let Some((file, behavior)) = &parts.behavior {
        behavior.machines.iter().for_each(|one| each(file, &one.anchor, &one.title, &one.doubts));
        behavior.sequences.iter().for_each(|one| each(file, &one.anchor, &one.name, &one.doubts));
    }
    if let Some(file) = &parts.process {
        parts.data.frames.iter().for_each(|frame| each(file, &frame.anchor, &frame.title, &frame.doubts));
    }
    if let Some((file, protocol)) = &parts.protocol {
        protocol.messages.iter().for_each(|message| each(file, &message.anchor, &message.name, &message.doubts));
    }
    for (file, _, tables) in &parts.codes {
        tables.iter().for_each(|table| each(file, &table.anchor, &table.title, &table.doubts));
    }
    overview(true).for_each(|doubt| each(first, "", "Device", doubt));
}

fn named(number: &str, name: &str) -> String {
    format!("{number} {name}").trim().to_owned()
}
