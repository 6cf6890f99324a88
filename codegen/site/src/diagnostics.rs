//! Repairs and warnings of the compiler. Each item shows its diagnostics, and separate pages list all diagnostics.

use std::collections::{BTreeMap, HashMap};

use super::split::{self, Section};
use super::words::one_line;
use lexibus_codegen::compile::Compilation;
use lexibus_codegen::diagnostics::{Class, Code, Diagnostic};
use lexibus_codegen::facts::words::{capital, sentence};
use lexibus_codegen::ir::{Group, Item};
use lexibus_codegen::source::Span;

/// Maximum number of diagnostics that an item shows for one span. The page with all diagnostics lists the others.
const MAX_PER_SPAN: usize = 64;

/// A diagnostic of the compiler, as a page shows it.
#[derive(Clone, Debug)]
pub(super) struct ShownDiagnostic {
    /// Position in the form `file:line:column`.
    pub position: String,
    pub code: &'static Code,
    /// Message, label, notes and help of the diagnostic.
    pub text: String,
}

impl ShownDiagnostic {
    /// Returns whether the compiler repaired the source.
    pub fn is_repair(&self) -> bool {
        self.code.class == Class::Repair
    }
}

/// The diagnostics with the same code.
#[derive(Debug)]
pub(super) struct DiagnosticGroup<'d> {
    pub code: &'static Code,
    pub list: Vec<&'d ShownDiagnostic>,
}

impl<'d> Section for DiagnosticGroup<'d> {
    type Element = &'d ShownDiagnostic;

    fn elements(&mut self) -> &mut Vec<&'d ShownDiagnostic> {
        &mut self.list
    }

    fn continued(&self) -> Self {
        DiagnosticGroup { code: self.code, list: Vec::new() }
    }

    fn texts<'t>(diagnostic: &'t &'d ShownDiagnostic) -> impl Iterator<Item = &'t str> {
        [&diagnostic.position, &diagnostic.text].into_iter().map(String::as_str)
    }
}

impl DiagnosticGroup<'_> {
    /// Returns the number of diagnostics as a text such as `1 repair` or `3 warnings`.
    pub fn count(&self) -> String {
        let noun = if self.code.class == Class::Repair { "repair" } else { "warning" };
        let plural = if self.list.len() == 1 { "" } else { "s" };
        format!("{} {noun}{plural}", self.list.len())
    }

    /// Returns the first sentence of the code's explanation.
    pub fn explanation(&self) -> &'static str {
        let text = self.code.explanation;
        let begins = |(at, _): &(usize, &str)| text[at + 2..].starts_with(char::is_uppercase);
        let ends = [text.match_indices(". ").find(begins).map(|(at, _)| at + 1), text.find('\n')];
        &text[..ends.into_iter().flatten().min().unwrap_or(text.len())]
    }
}

/// Groups the diagnostics by code, in the order of the identifiers, and divides the groups into pages.
pub(super) fn pages(list: &[ShownDiagnostic]) -> Vec<Vec<DiagnosticGroup<'_>>> {
    let mut groups: BTreeMap<&str, DiagnosticGroup<'_>> = BTreeMap::new();
    for diagnostic in list {
        let code = diagnostic.code;
        groups.entry(code.id).or_insert(DiagnosticGroup { code, list: Vec::new() }).list.push(diagnostic);
    }
    split::pages(groups.into_values().collect())
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

    /// Returns the diagnostics whose spans begin within the span of an item or of one of its facts.
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
            at.others.low,
            at.others.high,
            at.others.configured,
            at.others.documentation,
        ])
    }

    /// Returns the diagnostics that concern an object as a whole.
    pub fn of_group(&self, group: &Group) -> Vec<ShownDiagnostic> {
        self.within(&[group.origin.span])
    }

    /// Returns the diagnostics that begin within these spans. The number of diagnostics is limited because a table row
    /// can represent thousands of items.
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
    let source = |span: Span| compilation.sources.get(span.file.0 as usize);
    let position = source(diagnostic.span).map(|source| {
        let name = lexibus_codegen::text::file_name(source.name());
        let at = source.position(diagnostic.span.start);
        if diagnostic.span.is_empty() {
            name.to_owned()
        } else {
            format!("{name}:{}:{}", at.line, at.column)
        }
    });
    // The label completes the message: what the compiler did, or what is at the position.
    let message = [diagnostic.message.as_str(), &diagnostic.label].map(one_line);
    let message: Vec<&str> = message.iter().map(String::as_str).filter(|part| !part.is_empty()).collect();
    // The message of a note with a span states only what is at the span, so add the line number.
    let line = |span: Span| Some(source(span)?.position(span.start).line);
    let notes = diagnostic.notes.iter().map(|note| match note.span.filter(|span| !span.is_empty()).and_then(line) {
        Some(line) => format!("Line {line}: {}", one_line(&note.message)),
        None => one_line(&note.message),
    });
    let parts = std::iter::once(message.join(": ")).chain(notes).chain(diagnostic.help.as_deref().map(one_line));
    let text: Vec<String> = parts.filter(|part| !part.is_empty()).map(|part| sentence(&capital(&part))).collect();
    ShownDiagnostic { position: position.unwrap_or_default(), code: diagnostic.code, text: text.join(" ") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lexibus_codegen::diagnostics::codes::CODES;

    #[test]
    fn explanations_begin_with_a_sentence() {
        for code in CODES.iter().copied() {
            let sentence = DiagnosticGroup { code, list: Vec::new() }.explanation();
            assert!(sentence.ends_with('.') && sentence.len() > 20 && sentence.len() < 400, "{}: {sentence}", code.id);
        }
    }
}
