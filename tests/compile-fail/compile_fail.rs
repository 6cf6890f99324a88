//! Code that must not compile, and what rustc says about it.
//!
//! The messages are those of one rustc version. After a change of it, run with `TRYBUILD=overwrite` and review the difference.

use std::process::Command;

/// The compiler whose messages `cases` has.
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
