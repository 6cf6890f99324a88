//! What must not compile, and what the compiler says to it.
//!
//! The messages are those of one version of the compiler: after a change of it, run with `TRYBUILD=overwrite` and read
//! the difference.

#[test]
fn compile_fail() {
    trybuild::TestCases::new().compile_fail("tests/compile-fail/*.rs");
}
