//! The independent readers: scripts in Python.

use std::path::{Path, PathBuf};
use std::process::Command;

use serde::Deserialize;

use super::corpus_support::{files_of, folder_of, lane, python, File};
use super::facts::Elements;

/// What a reader says of one file.
#[derive(Debug, Default, Deserialize)]
pub struct Answer {
    /// Its elements, where it reads the file.
    pub elements: Option<Elements>,
    /// Why it rejects the file, where it does.
    #[serde(default)]
    pub errors: Vec<String>,
}

/// The files of a format, each with what its script says of it; `None`, with a message, where the corpus or Python isn't there.
pub fn answers(format: &str) -> Option<Vec<(File, Answer)>> {
    if lane::skips("the comparison with independent readers") {
        return None;
    }
    let (python, files, folder) = (python::with(&["canopen", "lxml"])?, files_of(format)?, folder_of(format)?);
    let paths: Vec<_> = files.iter().map(|file| folder.join(&file.name)).collect();
    let answers = ask(&python, &format!("{format}.py"), &paths);
    Some(files.into_iter().zip(answers).collect())
}

/// What `script` says of each of `paths`.
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
