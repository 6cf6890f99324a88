//! What the compiler repaired in the source, or doubts, where it matters: at the items that it is about, and all of it on a page.

use std::collections::HashMap;

use super::words::one_line;
use lexibus_codegen::compile::Compilation;
use lexibus_codegen::diagnostics::{Class, Diagnostic};
use lexibus_codegen::facts::words::sentence;
use lexibus_codegen::ir::{Group, Item};
use lexibus_codegen::source::Span;

/// How many findings one place has at most; the others are on the page of all.
const MAX_AT_ONE_PLACE: usize = 64;

/// A finding of the compiler.
#[derive(Clone, Debug)]
pub(super) struct Finding {
    /// Whether the source was repaired there.
    pub is_repair: bool,
    /// `file:line:column`.
    pub place: String,
    /// Its code: `EDS020`.
    pub code: &'static str,
    /// What is wrong, how it was read, and what to do about it.
    pub text: String,
}

/// The findings of a compilation.
#[derive(Debug, Default)]
pub(super) struct Findings {
    pub list: Vec<Finding>,
    /// Where they are, by place, with the numbers of their rows in the list.
    places: Vec<(Span, usize)>,
}

impl Findings {
    pub fn of(compilation: &Compilation) -> Self {
        let mut own = Findings::default();
        // Devices of one file may give one finding each.
        let mut known = HashMap::new();
        for diagnostic in compilation.diagnostics.list() {
            let finding = finding(compilation, diagnostic);
            let at = *known.entry((finding.place.clone(), finding.text.clone())).or_insert_with(|| {
                own.list.push(finding);
                own.list.len() - 1
            });
            own.places.push((diagnostic.span, at));
        }
        own.places.retain(|(span, _)| !span.is_empty());
        own.places.sort_unstable();
        own.places.dedup();
        own
    }

    /// What is about an item: what begins within one of the places where its facts stand.
    pub fn of_item(&self, item: &Item) -> Vec<Finding> {
        if self.places.is_empty() {
            return Vec::new();
        }
        let at = &item.at;
        self.within(&[
            item.origin.span,
            at.name,
            at.ty,
            at.access,
            at.mappable,
            at.default,
            at.low,
            at.high,
            at.configured,
            at.documentation,
        ])
    }

    /// What is about an object as a whole.
    pub fn of_group(&self, group: &Group) -> Vec<Finding> {
        self.within(&[group.origin.span])
    }

    /// A row may stand for thousands of items with a finding each, of which every item would show all.
    fn within(&self, spans: &[Span]) -> Vec<Finding> {
        let mut found: Vec<usize> = Vec::new();
        for span in spans.iter().filter(|span| !span.is_empty()) {
            let first = self.places.partition_point(|(own, _)| (own.file, own.start) < (span.file, span.start));
            let inside = |(own, _): &&(Span, usize)| own.file == span.file && own.start < span.end;
            found.extend(self.places[first..].iter().take_while(inside).map(|(_, at)| *at).take(MAX_AT_ONE_PLACE));
        }
        found.sort_unstable();
        found.dedup();
        found.into_iter().filter_map(|at| self.list.get(at)).cloned().collect()
    }
}

fn finding(compilation: &Compilation, diagnostic: &Diagnostic) -> Finding {
    let place = compilation.sources.get(diagnostic.span.file.0 as usize).map(|source| {
        let name = source.name().rsplit(['/', '\\']).next().unwrap_or_default();
        let at = source.position(diagnostic.span.start);
        if diagnostic.span.is_empty() {
            name.to_owned()
        } else {
            format!("{name}:{}:{}", at.line, at.column)
        }
    });
    let parts = [diagnostic.message.as_str(), &diagnostic.label]
        .into_iter()
        .chain(diagnostic.notes.iter().map(|note| note.message.as_str()));
    let parts = parts.chain(diagnostic.help.as_deref()).map(one_line).filter(|part| !part.is_empty());
    let text: Vec<String> = parts.map(|part| sentence(&part)).collect();
    Finding {
        is_repair: diagnostic.code.class == Class::Repair,
        place: place.unwrap_or_default(),
        code: diagnostic.code.id,
        text: text.join(" "),
    }
}
