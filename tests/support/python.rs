//! Finds a Python interpreter for tests with independent programs.

use std::path::{Path, PathBuf};
use std::process::Command;

/// Returns the path of a Python interpreter that can import `modules`. If there is none, prints a message and returns `None`.
///
/// Uses the interpreter that `LEXIBUS_PYTHON` names. If this variable is not set, uses the interpreter that
/// `tests/interop/setup.sh` has installed, or `python3` if there is none.
///
/// # Panics
///
/// Panics if the interpreter that `LEXIBUS_PYTHON` names does not exist or lacks a module.
pub fn with(modules: &[&str]) -> Option<PathBuf> {
    let named = std::env::var_os("LEXIBUS_PYTHON").map(PathBuf::from);
    let installed = || {
        let folders = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors();
        folders.map(|folder| folder.join("target/python/bin/python")).find(|python| python.is_file())
    };
    let python = named.clone().or_else(installed).unwrap_or_else(|| "python3".into());
    let import = format!("import {}", modules.join(", "));
    let imported = Command::new(&python).args(["-c", &import]).output();
    if imported.is_ok_and(|output| output.status.success()) {
        return Some(python);
    }
    let lacks = format!("{} cannot {import}; tests/interop/setup.sh makes a Python that can", python.display());
    assert!(named.is_none(), "LEXIBUS_PYTHON is {lacks}");
    println!("skipped: {lacks}");
    None
}
