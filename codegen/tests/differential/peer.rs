//! The independent readers: scripts in Python.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use serde::Deserialize;

use super::corpus_support::{files_of, folder_of, File};
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

/// The Python that `tests/interop/setup.sh` made, or the one that `LEXIBUS_PYTHON` names; `None`, with a message, where it
/// lacks what the scripts need.
fn python() -> Option<&'static Path> {
    static PYTHON: OnceLock<Option<PathBuf>> = OnceLock::new();
    let python = PYTHON.get_or_init(|| {
        let own = || Path::new(env!("CARGO_MANIFEST_DIR")).join("../target/python/bin/python");
        let python = std::env::var_os("LEXIBUS_PYTHON").map_or_else(own, PathBuf::from);
        let imports = Command::new(&python).args(["-c", "import canopen, lxml"]).output();
        imports.is_ok_and(|output| output.status.success()).then_some(python)
    });
    if python.is_none() {
        eprintln!("skipped: no Python with canopen and lxml; tests/interop/setup.sh makes one");
    }
    python.as_deref()
}

/// The files of a format, each with what its script says of it; `None`, with a message, where the corpus or Python isn't there.
pub fn answers(format: &str) -> Option<Vec<(File, Answer)>> {
    let (python, files, folder) = (python()?, files_of(format)?, folder_of(format)?);
    let paths: Vec<_> = files.iter().map(|file| folder.join(&file.name)).collect();
    let answers = ask(python, &format!("{format}.py"), &paths);
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
