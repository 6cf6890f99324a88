//! The last line of a report: the numbers of errors and warnings.

/// Returns the numbers of errors and warnings as text: `2 errors and 1 warning`, or `no errors or warnings`.
pub fn summary(errors: usize, warnings: usize) -> String {
    let counted = |count: usize, what: &str| format!("{count} {what}{}", if count == 1 { "" } else { "s" });
    match (errors, warnings) {
        (0, 0) => "no errors or warnings".into(),
        (_, 0) => counted(errors, "error"),
        (0, _) => counted(warnings, "warning"),
        _ => format!("{} and {}", counted(errors, "error"), counted(warnings, "warning")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_summary_counts_errors_and_warnings() {
        assert_eq!(summary(0, 0), "no errors or warnings");
        assert_eq!(summary(1, 0), "1 error");
        assert_eq!(summary(0, 3), "3 warnings");
        assert_eq!(summary(2, 1), "2 errors and 1 warning");
    }
}
