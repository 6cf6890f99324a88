//! The interface between generated code and this crate, as a number.

/// The version of the interface that generated code relies on.
pub const VERSION: u32 = 1;

/// Checks that generated code and this crate belong together. Generated code calls it in a constant.
///
/// ```
/// const _: () = lexibus::interface::assert_version(lexibus::interface::VERSION);
/// ```
///
/// # Panics
///
/// When `generated` isn't [`VERSION`]; in a constant, that is a compile error.
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
