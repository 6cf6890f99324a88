//! Diagnostics as text for a terminal.
//!
//! Every function here takes the [`Diagnostic`](super::Diagnostic)s as they are and the list of
//! [`Source`](crate::source::Source)s that their spans index. None panics, whatever a span says: an offset outside of
//! a file is moved to its end, one inside a character to the character's edge, and a file that isn't in the list makes
//! a finding without a place.

pub mod place;
pub mod terminal;

/// How many findings there were: `2 errors and 1 warning`, `no findings`.
pub fn summary(errors: usize, warnings: usize) -> String {
    let counted = |count: usize, what: &str| format!("{count} {what}{}", if count == 1 { "" } else { "s" });
    match (errors, warnings) {
        (0, 0) => "no findings".into(),
        (_, 0) => counted(errors, "error"),
        (0, _) => counted(warnings, "warning"),
        _ => format!("{} and {}", counted(errors, "error"), counted(warnings, "warning")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_summary_counts_what_there_is() {
        assert_eq!(summary(0, 0), "no findings");
        assert_eq!(summary(1, 0), "1 error");
        assert_eq!(summary(0, 3), "3 warnings");
        assert_eq!(summary(2, 1), "2 errors and 1 warning");
    }
}
