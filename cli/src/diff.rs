//! `lexibus diff`: reports the changes between two versions of a description.

use std::path::Path;

use askama::Template;
use lexibus_codegen::compile::{self, Compilation, Options};
use lexibus_codegen::source::Source;
use lexibus_site::compare::{compare, Change, Class, Summary};

use super::args::{Diff, DiffFormat, Printing, Shown};
use super::files::put;
use super::report::Reporter;
use super::Failure;

#[derive(Template)]
#[template(path = "diff.html")]
struct Report<'c> {
    old: String,
    new: String,
    changes: &'c [Change],
    summary: Summary,
}

/// Compares two descriptions. Returns `false` if a change breaks Rust code or the communication, or if a description
/// has errors or describes nothing.
pub(super) fn run(diff: &Diff) -> Result<bool, Failure> {
    let options = Options { choices: diff.option.clone(), no_profiles: diff.no_profiles, ..Options::default() };
    let (Some(old), Some(new)) = (read(&diff.old, &options)?, read(&diff.new, &options)?) else { return Ok(false) };
    let mut changes = match (&old.catalog, &new.catalog) {
        (Some(old), Some(new)) => compare(old, new),
        _ => return Ok(false),
    };
    let summary = Summary::of(&changes);
    let last = last_class(diff.show);
    changes.retain(|change| change.judgment.class() <= last);
    let text = report(diff, &changes, summary)?;
    put(diff.out.as_deref(), &text)?;
    Ok(summary.api == 0 && summary.wire == 0)
}

/// Returns the least severe class of changes to show.
fn last_class(shown: Shown) -> Class {
    match shown {
        Shown::Breaking => Class::Breaking,
        Shown::Behavior => Class::Behavior,
        Shown::Compatible => Class::Compatible,
        Shown::All => Class::None,
    }
}

/// Compiles a description. If the description has errors or describes nothing, reports its diagnostics and returns
/// `None`.
fn read(path: &Path, options: &Options) -> Result<Option<Compilation>, Failure> {
    let source =
        Source::read(path).map_err(|error| Failure::Usage(format!("cannot read {}: {error}", path.display())))?;
    let compilation = compile::check(source, options);
    if compilation.is_usable() && compilation.catalog.is_some() {
        return Ok(Some(compilation));
    }
    Reporter::with(&Printing::TEXT, false)?.report(&compilation)?;
    Ok(None)
}

fn report(diff: &Diff, changes: &[Change], summary: Summary) -> Result<String, Failure> {
    match diff.format {
        DiffFormat::Text => {
            let lines = changes.iter().map(|change| format!("{change}\n"));
            Ok(lines.chain([format!("{summary}\n")]).collect())
        }
        DiffFormat::Json => {
            let lines: Result<Vec<String>, _> = changes.iter().map(serde_json::to_string).collect();
            let lines = lines.map_err(std::io::Error::other)?;
            Ok(lines.iter().map(|line| format!("{line}\n")).collect())
        }
        DiffFormat::Html => {
            let name =
                |path: &Path| path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
            let report = Report { old: name(&diff.old), new: name(&diff.new), changes, summary };
            Ok(report.render().map_err(std::io::Error::other)?)
        }
    }
}
