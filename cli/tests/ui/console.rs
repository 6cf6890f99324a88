//! Runs the calls of `lexibus` that a test case lists, in a copy of its folder.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::case::Case;

/// Returns the calls, each followed by its standard output, its standard error, and its exit code if the code is not 0.
///
/// # Errors
///
/// Returns an error if a file cannot be copied or read, or if `lexibus` cannot be started.
pub fn of(case: &Case) -> Result<String, String> {
    let folder = copy_of(case).map_err(|error| format!("{}: {error}", case.name()))?;
    let transcript = case.settings.commands.iter().map(|line| match *line.split(' ').collect::<Vec<_>>() {
        ["cat", name] => shown(&folder.join(name)).map(|text| format!("$ {line}\n{text}")),
        ["cp", from, to] => match std::fs::copy(folder.join(from), folder.join(to)) {
            Ok(_) => Ok(format!("$ {line}\n")),
            Err(error) => Err(format!("{line}: {error}")),
        },
        _ => called(line, &folder).map(|text| format!("$ lexibus {line}\n{text}")),
    });
    Ok(transcript.collect::<Result<Vec<String>, String>>()?.join("\n"))
}

/// Copies the files of a test case to an empty folder.
fn copy_of(case: &Case) -> std::io::Result<PathBuf> {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("ui").join(case.name());
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder)?;
    for entry in std::fs::read_dir(&case.folder)? {
        let path = entry?.path();
        std::fs::copy(&path, folder.join(path.file_name().unwrap_or_default()))?;
    }
    Ok(folder)
}

/// Runs a call. The words of the call contain no spaces.
fn called(line: &str, folder: &Path) -> Result<String, String> {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lexibus"));
    let output =
        command.args(line.split_whitespace()).current_dir(folder).env("NO_COLOR", "1").env("COLUMNS", "100").output();
    let output = output.map_err(|error| format!("{line}: {error}"))?;
    let text = String::from_utf8_lossy(&output.stdout) + String::from_utf8_lossy(&output.stderr);
    Ok(match output.status.code() {
        Some(0) => text.into_owned(),
        code => format!("{text}[exit code {}]\n", code.map_or("unknown".to_owned(), |code| code.to_string())),
    })
}

/// Returns the content of a file. Bytes other than printable ASCII and line feeds are escaped.
fn shown(path: &Path) -> Result<String, String> {
    let bytes = std::fs::read(path).map_err(|error| format!("{}: {error}", path.display()))?;
    let shown = bytes.iter().map(|&byte| match byte {
        b'\n' | b' '..=b'~' => char::from(byte).to_string(),
        byte => byte.escape_ascii().to_string(),
    });
    Ok(shown.collect())
}
