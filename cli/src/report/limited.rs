//! Limits the number of diagnostics that are printed for each code and file.

use std::borrow::Cow;
use std::collections::HashMap;

use lexibus_codegen::diagnostics::{Diagnostic, Severity};

/// Maximum number of diagnostics that are printed for each code and file, unless the user requests all of them.
const LIMIT: usize = 3;

/// A part of the text output: a diagnostic, or the number of omitted diagnostics.
pub(super) enum Shown<'d> {
    /// A diagnostic in full.
    Full(&'d Diagnostic),
    /// A warning to print without its marked lines, notes and help, because it is not the first printed diagnostic of
    /// its code in the file.
    Brief(&'d Diagnostic),
    /// A line with the number of diagnostics that are left out.
    More(String),
}

/// Numbers of diagnostics of a code in a file.
#[derive(Default)]
struct Count {
    total: usize,
    /// Number of diagnostics that were printed.
    shown: usize,
    /// Number of diagnostics that the printed ones represent. If a file has too many diagnostics of a code, the last
    /// one is a closing diagnostic, which represents all diagnostics that were only counted.
    covered: usize,
}

/// Selects the diagnostics to print, in their order. Only the first warning of a code in a file is printed in full.
/// After the third diagnostic of a code, a line states the number of further diagnostics. If `all` is set, every
/// diagnostic is printed in full.
pub(super) fn limited<'d>(diagnostics: &'d [Cow<Diagnostic>], all: bool) -> impl Iterator<Item = Shown<'d>> {
    let mut counts: HashMap<_, Count> = HashMap::new();
    for diagnostic in diagnostics {
        counts.entry((diagnostic.span.file, diagnostic.code.id)).or_default().total += diagnostic.occurrences();
    }
    diagnostics
        .iter()
        .flat_map(move |diagnostic| {
            let count = counts.entry((diagnostic.span.file, diagnostic.code.id)).or_default();
            if count.shown == LIMIT && !all {
                return [None, None];
            }
            count.shown += 1;
            count.covered += diagnostic.occurrences();
            let left = count.total - count.covered;
            let more = (count.shown == LIMIT && left > 0 && !all)
                .then(|| Shown::More(format!("and {left} more of {} (--all)", diagnostic.code.id)));
            let is_brief = count.shown > 1 && diagnostic.severity == Severity::Warning && !all;
            let shown = if is_brief { Shown::Brief(diagnostic) } else { Shown::Full(diagnostic) };
            [Some(shown), more]
        })
        .flatten()
}

#[cfg(test)]
mod tests {
    use super::*;
    use lexibus_codegen::diagnostics::{codes, Code, Diagnostics};
    use lexibus_codegen::limits::MAX_SAME_DIAGNOSTICS;
    use lexibus_codegen::source::{FileId, Span};

    fn lines(diagnostics: &Diagnostics, all: bool) -> Vec<String> {
        let list: Vec<_> = diagnostics.list().iter().map(Cow::Borrowed).collect();
        let line = |shown| match shown {
            Shown::Full(diagnostic) | Shown::Brief(diagnostic) => diagnostic.message.clone(),
            Shown::More(more) => more,
        };
        limited(&list, all).map(line).collect()
    }

    fn push(diagnostics: &mut Diagnostics, code: &'static Code, file: u32, count: usize) {
        for at in 0..count as u32 {
            diagnostics.push(Diagnostic::new(code, Span::new(FileId(file), at, at + 1), format!("{}{file}", code.id)));
        }
    }

    #[test]
    fn three_diagnostics_of_a_code_are_shown_for_each_file() {
        let mut diagnostics = Diagnostics::default();
        push(&mut diagnostics, &codes::JUNK_LINE, 0, 3);
        push(&mut diagnostics, &codes::OCTAL_NUMBER, 1, 5);
        push(&mut diagnostics, &codes::JUNK_LINE, 1, 4);
        diagnostics.sort();
        let shown = lines(&diagnostics, false);
        let mut expected = vec!["EDS0030"; 3];
        expected.extend(["EDS0201", "EDS0031", "EDS0201", "EDS0031", "EDS0201", "and 2 more of EDS020 (--all)"]);
        expected.extend(["EDS0031", "and 1 more of EDS003 (--all)"]);
        assert_eq!(shown, expected);
        assert_eq!(lines(&diagnostics, true).len(), 12);
    }

    #[test]
    fn only_the_first_warning_of_a_code_is_full() {
        let mut diagnostics = Diagnostics::default();
        push(&mut diagnostics, &codes::JUNK_LINE, 0, 4);
        push(&mut diagnostics, &codes::INPUT_TOO_LARGE, 0, 2);
        diagnostics.sort();
        let list: Vec<_> = diagnostics.list().iter().map(Cow::Borrowed).collect();
        let brief = |all| {
            let is_brief = |shown| match shown {
                Shown::Brief(diagnostic) => Some(diagnostic.code.id),
                _ => None,
            };
            limited(&list, all).filter_map(is_brief).collect::<Vec<_>>()
        };
        assert_eq!(brief(false), ["EDS003"; 2]);
        assert_eq!(brief(true), [""; 0]);
    }

    #[test]
    fn the_number_includes_diagnostics_beyond_the_bound() {
        let mut diagnostics = Diagnostics::default();
        push(&mut diagnostics, &codes::JUNK_LINE, 0, MAX_SAME_DIAGNOSTICS + 7);
        diagnostics.sort();
        let shown = lines(&diagnostics, false);
        assert_eq!(shown[3..], [format!("and {} more of EDS003 (--all)", MAX_SAME_DIAGNOSTICS + 4)]);
        assert_eq!(
            lines(&diagnostics, true).last().map(String::as_str),
            Some("this file has 7 more diagnostics of EDS003")
        );
    }
}
