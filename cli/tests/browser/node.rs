//! Runs the scripts that control the browser. The scripts need Node.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;

/// Folder for screenshots and for the libraries that `setup.sh` installs.
const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../target/browser");

/// Environment variable that makes a missing browser an error. CI sets this variable after running `setup.sh`.
const REQUIRED: &str = "LEXIBUS_BROWSER";

/// Runs a script with paths as arguments. The test fails if the script fails.
///
/// If no browser is available, the test fails if the environment variable [`REQUIRED`] is set. Otherwise, the function
/// prints that the test is skipped, and does not create the paths.
pub fn run<const N: usize>(script: &str, paths: impl FnOnce() -> [PathBuf; N]) {
    if let Err(why) = ready() {
        assert!(std::env::var_os(REQUIRED).is_none(), "{REQUIRED} is set, but {why}");
        eprintln!("skipped: {why}; see cli/tests/browser/README.md");
        return;
    }
    let output = node(script, &paths()).expect("Node runs");
    let printed = format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success(), "{script}: {printed}");
    print!("{printed}");
}

/// Returns an error with the reason if no browser can be controlled.
fn ready() -> Result<(), &'static str> {
    static READY: OnceLock<Result<(), String>> = OnceLock::new();
    let ready = READY.get_or_init(|| match node("ready.mjs", &[]) {
        Ok(output) if output.status.success() => Ok(()),
        Ok(output) => Err(format!("no browser can be controlled ({})", String::from_utf8_lossy(&output.stderr).trim())),
        Err(error) => Err(format!("Node is not installed ({error})")),
    });
    ready.as_ref().copied().map_err(String::as_str)
}

fn node(script: &str, paths: &[PathBuf]) -> std::io::Result<Output> {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/browser").join(script);
    Command::new("node").arg(script).args(paths).env("LEXIBUS_BROWSER_MODULES", FOLDER).output()
}

/// Returns the folder for screenshots.
pub fn pictures() -> PathBuf {
    Path::new(FOLDER).join("pictures")
}
