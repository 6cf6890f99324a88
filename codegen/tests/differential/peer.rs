//! The independent readers: scripts in Python.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use serde::Deserialize;

use super::corpus_support::{files_of, folder_of, lane, File};
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

/// What the scripts need.
const LIBRARIES: [&str; 2] = ["canopen", "lxml"];

/// The Python that `LEXIBUS_PYTHON` names, which has to have what the scripts need: whoever sets it wants these tests. Else
/// the one that `tests/interop/setup.sh` made; `None`, with a message, where it isn't there.
fn python() -> Option<&'static Path> {
    static PYTHON: OnceLock<Option<PathBuf>> = OnceLock::new();
    let python = PYTHON.get_or_init(|| {
        let named = std::env::var_os("LEXIBUS_PYTHON").map(PathBuf::from);
        let own = || Path::new(env!("CARGO_MANIFEST_DIR")).join("../target/python/bin/python");
        let python = named.clone().unwrap_or_else(own);
        let missing = missing(&python);
        assert!(
            named.is_none() || missing.is_empty(),
            "LEXIBUS_PYTHON is {}, which lacks {}; tests/interop/setup.sh makes a Python that has them",
            python.display(),
            missing.join(" and ")
        );
        missing.is_empty().then_some(python)
    });
    if python.is_none() {
        eprintln!("skipped: no Python with {}; tests/interop/setup.sh makes one", LIBRARIES.join(" and "));
    }
    python.as_deref()
}

/// The libraries that a Python can't import: all of them where it doesn't even run.
fn missing(python: &Path) -> Vec<&'static str> {
    let imports = |library: &str| Command::new(python).arg("-c").arg(format!("import {library}")).output();
    let lacks = |library: &&str| !imports(library).is_ok_and(|output| output.status.success());
    LIBRARIES.into_iter().filter(lacks).collect()
}

/// The files of a format, each with what its script says of it; `None`, with a message, where the corpus or Python isn't there.
pub fn answers(format: &str) -> Option<Vec<(File, Answer)>> {
    if lane::skips("the comparison with independent readers") {
        return None;
    }
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
