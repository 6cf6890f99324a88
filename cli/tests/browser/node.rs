//! Node, which runs the scripts that steer the browser.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;

/// Where `setup.sh` puts the libraries of the scripts, and pictures are kept.
const PLACE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../target/browser");

/// Set where the tests may not be skipped, as in CI once `setup.sh` has done its work.
const REQUIRED: &str = "LEXIBUS_BROWSER";

/// Runs a script of this folder with these paths, which are made only where there is a browser; without one, says that the
/// test is skipped. The script fails the test.
pub fn run<const N: usize>(script: &str, paths: impl FnOnce() -> [PathBuf; N]) {
    if let Err(why) = ready() {
        assert!(std::env::var_os(REQUIRED).is_none(), "{REQUIRED} is set, but {why}");
        eprintln!("skipped: {why}; see cli/tests/browser/README.md");
        return;
    }
    let output = node(script, &paths()).expect("Node runs");
    let told = format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success(), "{script}: {told}");
    print!("{told}");
}

/// Whether a browser can be steered, and if not, why.
fn ready() -> Result<(), &'static str> {
    static READY: OnceLock<Result<(), String>> = OnceLock::new();
    let ready = READY.get_or_init(|| match node("ready.mjs", &[]) {
        Ok(output) if output.status.success() => Ok(()),
        Ok(output) => Err(format!("no browser can be steered ({})", String::from_utf8_lossy(&output.stderr).trim())),
        Err(error) => Err(format!("there is no Node ({error})")),
    });
    ready.as_ref().copied().map_err(String::as_str)
}

fn node(script: &str, paths: &[PathBuf]) -> std::io::Result<Output> {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/browser").join(script);
    Command::new("node").arg(script).args(paths).env("LEXIBUS_BROWSER_MODULES", PLACE).output()
}

/// The folder for pictures.
pub fn artefacts() -> PathBuf {
    Path::new(PLACE).join("pictures")
}
