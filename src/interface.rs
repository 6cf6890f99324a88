//! Version of the interface between generated code and this crate.

/// Version of the interface that this crate provides to generated code. The version increases if functions that generated code calls
/// change, or if the code of a definition in [`profiles`](crate::profiles) changes, because generated code re-exports it.
pub const VERSION: u32 = 1;

/// Checks that generated code matches the interface version of this crate. Generated code calls this function in a
/// constant.
///
/// ```
/// const _: () = lexibus::interface::assert_version(lexibus::interface::VERSION);
/// ```
///
/// # Panics
///
/// Panics if `generated` isn't [`VERSION`]. In a constant, the panic is a compile error.
#[track_caller]
pub const fn assert_version(generated: u32) {
    assert!(
        generated == VERSION,
        "this code was generated for another version of `lexibus`: bring `lexibus` and `lexibus-codegen` to the same \
         version and generate it again"
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    const _: () = assert_version(VERSION);

    #[test]
    #[should_panic(expected = "generated for another version of `lexibus`")]
    fn another_version_is_refused() {
        assert_version(VERSION + 1);
    }
}
