//! A drive crate, built and tested from its own folder as its author would.

use std::path::Path;
use std::process::Command;

#[test]
fn a_users_crate_compiles_and_its_tests_pass() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folder = root.join("tests/drive-crate");
    // The same versions as the workspace has, and nothing to be fetched anew.
    std::fs::copy(root.join("Cargo.lock"), folder.join("Cargo.lock")).expect("the workspace's Cargo.lock");
    let output = Command::new(env!("CARGO"))
        .args(["test", "--quiet", "--manifest-path", "Cargo.toml"])
        .current_dir(&folder)
        .env("CARGO_TARGET_DIR", Path::new(env!("CARGO_TARGET_TMPDIR")).join("drive-crate"))
        .output()
        .expect("cargo runs");
    let (out, errors) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success(), "{out}\n{errors}");
    assert!(out.contains("5 passed"), "{out}");
}
