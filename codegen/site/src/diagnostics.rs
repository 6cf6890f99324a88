//! Repairs and warnings of the compiler. Each item shows its diagnostics, and one page lists all of them.

use std::collections::HashMap;

use super::words::one_line;
use lexibus_codegen::compile::Compilation;
use lexibus_codegen::diagnostics::{Class, Diagnostic};
use lexibus_codegen::facts::words::sentence;
use lexibus_codegen::ir::{Group, Item};
use lexibus_codegen::source::Span;

/// Maximum number of diagnostics that an item shows for one span. The page with all diagnostics lists the others.
const MAX_PER_SPAN: usize = 64;

/// A diagnostic of the compiler, as a page shows it.
#[derive(Clone, Debug)]
pub(super) struct ShownDiagnostic {
    /// True if the compiler repaired the source.
    pub is_repair: bool,
    /// Position in the form `file:line:column`.
    pub position: String,
    /// Code of the diagnostic, such as `EDS020`.
    pub code: &'static str,
    /// Message, label, notes and help of the diagnostic.
    pub text: String,
}

/// The diagnostics of a compilation.
#[derive(Debug, Default)]
pub(super) struct ShownDiagnostics {
    pub list: Vec<ShownDiagnostic>,
    /// Spans in sorted order, each with the position of its diagnostic in `list`.
    spans: Vec<(Span, usize)>,
}

impl ShownDiagnostics {
    pub fn of(compilation: &Compilation) -> Self {
        let mut diagnostics = ShownDiagnostics::default();
        // A diagnostic that several devices of a file have in common is listed once.
        let mut known = HashMap::new();
        for diagnostic in compilation.diagnostics.list() {
            let shown = shown(compilation, diagnostic);
            let at = *known.entry((shown.position.clone(), shown.text.clone())).or_insert_with(|| {
                diagnostics.list.push(shown);
                diagnostics.list.len() - 1
            });
            diagnostics.spans.push((diagnostic.span, at));
        }
        diagnostics.spans.retain(|(span, _)| !span.is_empty());
        diagnostics.spans.sort_unstable();
        diagnostics.spans.dedup();
        diagnostics
    }

    /// Returns the diagnostics whose spans begin within the spans of an item's facts.
    pub fn of_item(&self, item: &Item) -> Vec<ShownDiagnostic> {
        if self.spans.is_empty() {
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

    /// Returns the diagnostics that concern an object as a whole.
    pub fn of_group(&self, group: &Group) -> Vec<ShownDiagnostic> {
        self.within(&[group.origin.span])
    }

    /// Returns the diagnostics within these spans. The number of diagnostics is limited because a table row can
    /// represent thousands of items.
    fn within(&self, spans: &[Span]) -> Vec<ShownDiagnostic> {
        let mut found: Vec<usize> = Vec::new();
        for span in spans.iter().filter(|span| !span.is_empty()) {
            let first = self.spans.partition_point(|(known, _)| (known.file, known.start) < (span.file, span.start));
            let inside = |(known, _): &&(Span, usize)| known.file == span.file && known.start < span.end;
            found.extend(self.spans[first..].iter().take_while(inside).map(|(_, at)| *at).take(MAX_PER_SPAN));
        }
        found.sort_unstable();
        found.dedup();
        found.into_iter().filter_map(|at| self.list.get(at)).cloned().collect()
    }
}

fn shown(compilation: &Compilation, diagnostic: &Diagnostic) -> ShownDiagnostic {
    let position = compilation.sources.get(diagnostic.span.file.0 as usize).map(|source| {
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
    ShownDiagnostic {
        is_repair: diagnostic.code.class == Class::Repair,
        position: position.unwrap_or_default(),
        code: diagnostic.code.id,
        text: text.join(" "),
    }
}
