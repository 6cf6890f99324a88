//! Code that must not compile, and the error messages of rustc.
//!
//! The messages depend on the version of rustc. After an update, run with `TRYBUILD=overwrite` and review the
//! changes.

use std::process::Command;

/// The version of rustc for the messages in `cases`.
const COMPILER: &str = "rustc 1.95.";

#[test]
fn compile_fail() {
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let version = Command::new(rustc).arg("--version").output().expect("rustc runs").stdout;
    let version = String::from_utf8_lossy(&version);
    if !version.starts_with(COMPILER) {
        println!("skipped: the messages are those of {COMPILER}x, and this is {version}");
        return;
    }
    trybuild::TestCases::new().compile_fail("cases/*.rs");
}
