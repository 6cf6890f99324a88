//! `lexibus diff`: what changed between two versions of a description.

use std::io::Write;
use std::path::Path;

use askama::Template;
use lexibus_codegen::compile::{self, Compilation, Options};
use lexibus_codegen::output::write_if_changed;
use lexibus_codegen::source::Source;
use lexibus_site::compare::{compare, Change, Judgement};

use super::args::{Colour, Diff, DiffFormat, MessageFormat};
use super::report::Reporter;
use super::Failure;

#[derive(Template)]
#[template(path = "diff.html")]
struct Report<'c> {
    old: String,
    new: String,
    changes: &'c [Change],
    breaking: usize,
}

/// Whether nothing is breaking.
pub(super) fn run(diff: &Diff) -> Result<bool, Failure> {
    let options = Options { choices: diff.option.clone(), no_profiles: diff.no_profiles, ..Options::default() };
    let (Some(old), Some(new)) = (read(&diff.old, &options)?, read(&diff.new, &options)?) else { return Ok(false) };
    let changes = match (&old.catalog, &new.catalog) {
        (Some(old), Some(new)) => compare(old, new),
        _ => return Ok(false),
    };
    let breaking = changes.iter().filter(|own| own.judgement == Judgement::Breaking).count();
    let text = written(diff, &changes, breaking)?;
    match &diff.out {
        Some(path) => write_if_changed(path, &text)
            .map_err(|error| Failure::Usage(format!("can't write {}: {error}", path.display())))?,
        None => std::io::stdout().lock().write_all(text.as_bytes())?,
    }
    Ok(breaking == 0)
}

/// A description; `None` where it has errors, which are told.
fn read(path: &Path, options: &Options) -> Result<Option<Compilation>, Failure> {
    let source =
        Source::read(path).map_err(|error| Failure::Usage(format!("can't read {}: {error}", path.display())))?;
    let compilation = compile::check(source, options);
    if compilation.is_usable() && compilation.catalog.is_some() {
        return Ok(Some(compilation));
    }
    Reporter::with(MessageFormat::Text, Colour::Auto, false).report(&compilation)?;
    Ok(None)
}

fn written(diff: &Diff, changes: &[Change], breaking: usize) -> Result<String, Failure> {
    match diff.format {
        DiffFormat::Text => {
            let mut text: String = changes.iter().map(|own| format!("{own}\n")).collect();
            text += &match (changes.len(), breaking) {
                (0, _) => "no changes\n".to_owned(),
                (1, _) => format!("1 change, {breaking} breaking\n"),
                (count, _) => format!("{count} changes, {breaking} breaking\n"),
            };
            Ok(text)
        }
        DiffFormat::Json => {
            let lines: Result<Vec<String>, _> = changes.iter().map(serde_json::to_string).collect();
            let lines = lines.map_err(std::io::Error::other)?;
            Ok(lines.iter().map(|line| format!("{line}\n")).collect())
        }
        DiffFormat::Html => {
            let name =
                |path: &Path| path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
            let report = Report { old: name(&diff.old), new: name(&diff.new), changes, breaking };
            Ok(report.render().map_err(std::io::Error::other)?)
        }
    }
}
