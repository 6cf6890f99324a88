//! Tests suggested fixes. Each fix must remove its diagnostic and cause no other diagnostic.

use std::collections::BTreeMap;

use lexibus_codegen::compile::{check, Compilation, Options};
use lexibus_codegen::diagnostics::Diagnostic;
use lexibus_codegen::source::Source;

/// Applies the fixes in the first file of a compilation one at a time and compares the diagnostics. Applies at most `most`
/// fixes per code. Returns the number of applied fixes. `source` creates a source from a text.
///
/// # Errors
///
/// Returns the fixes that change nothing, do not remove their diagnostic, or cause another diagnostic.
pub fn all_hold(
    text: &str,
    options: &Options,
    most: usize,
    source: impl Fn(String) -> Source,
) -> Result<usize, String> {
    // Compile the decoded text, because the fixed texts will also be UTF-8.
    let plain = check(source(text.to_owned()), options);
    let before = places(&plain);
    let (mut counts, mut wrong, mut applied) = (BTreeMap::new(), Vec::new(), 0);
    for diagnostic in plain.diagnostics.list() {
        let Some(fix) = diagnostic.fix.as_deref().filter(|_| diagnostic.span.file.0 == 0) else { continue };
        let count = counts.entry(diagnostic.code.id).or_insert(0);
        *count += 1;
        if *count > most {
            continue;
        }
        applied += 1;
        let range = diagnostic.span.start as usize..diagnostic.span.end as usize;
        let (old, mut fixed) = (&text[range.clone()], text.to_owned());
        fixed.replace_range(range, fix);
        let after = places(&check(source(fixed), options));
        let actual = key(&plain, diagnostic);
        let count_in = |places: &BTreeMap<Key, usize>, key: &Key| places.get(key).copied().unwrap_or_default();
        let added: Vec<_> = after.keys().filter(|key| count_in(&after, key) > count_in(&before, key)).collect();
        if count_in(&after, &actual) >= count_in(&before, &actual) || !added.is_empty() {
            wrong.push(format!("{actual:?}: `{old}` to `{fix}` ({}) adds {added:?}", diagnostic.message));
        }
    }
    if wrong.is_empty() {
        Ok(applied)
    } else {
        Err(format!("{} wrong fixes of {applied}:\n{}", wrong.len(), wrong.join("\n")))
    }
}

/// Code, file number and line of a diagnostic.
type Key = (&'static str, usize, usize);

fn key(compilation: &Compilation, diagnostic: &Diagnostic) -> Key {
    let file = diagnostic.span.file.0 as usize;
    (diagnostic.code.id, file, compilation.sources[file].position(diagnostic.span.start).line as usize)
}

/// Returns the number of diagnostics for each code, file and line.
fn places(compilation: &Compilation) -> BTreeMap<Key, usize> {
    let mut places = BTreeMap::new();
    for diagnostic in compilation.diagnostics.list() {
        *places.entry(key(compilation, diagnostic)).or_default() += 1;
    }
    places
}
