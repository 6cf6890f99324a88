//! Runs the independent readers, which are Python scripts.

use std::path::{Path, PathBuf};
use std::process::Command;

use serde::Deserialize;

use super::corpus_support::{files_of, folder_of, lane, python, File};
use super::facts::Elements;

/// A reader's result for one file.
#[derive(Debug, Default, Deserialize)]
pub struct Answer {
    /// The elements, if the reader could read the original or the repaired text.
    pub elements: Option<Elements>,
    /// The reasons why the reader rejected the original text of the file, if any.
    #[serde(default)]
    pub errors: Vec<String>,
}

/// Returns the files of a format with the reader's results. In the fast lane, or if the corpus or Python is missing, prints a
/// message and returns `None`.
pub fn answers(format: &str) -> Option<Vec<(File, Answer)>> {
    if lane::skips("the comparison with independent readers") {
        return None;
    }
    let (python, files, folder) = (python::with(&["canopen", "lxml"])?, files_of(format)?, folder_of(format)?);
    let paths: Vec<_> = files.iter().map(|file| folder.join(&file.name)).collect();
    let answers = ask(&python, &format!("{format}.py"), &paths);
    Some(files.into_iter().zip(answers).collect())
}

/// Runs `script` for the files at `paths` and returns its results.
fn ask(python: &Path, script: &str, paths: &[PathBuf]) -> Vec<Answer> {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/differential").join(script);
    let mut command = Command::new(python);
    command.arg("-X").arg("utf8").arg(script).args(paths).env("PYTHONDONTWRITEBYTECODE", "1");
    let output = command.output().expect("Python runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout).expect("UTF-8");
    let answers = text.lines().map(|line| serde_json::from_str(line).unwrap_or_else(|error| panic!("{error}: {line}")));
    let answers: Vec<Answer> = answers.collect();
    assert_eq!(answers.len(), paths.len(), "a line for each file");
    answers
}
