//! An example for each diagnostic code, from the code's test case in `tests/ui`.

use lexibus_codegen::diagnostics::Code;

/// Examples of all codes. A line with [`START`] and the code precedes each example. The test `ui` creates this file from its
/// cases.
const EXAMPLES: &str = include_str!("examples.txt");

/// Start of the line that precedes an example.
const START: &str = "=== ";

/// Returns the terminal output for an input that causes the diagnostic, or `None` if the code has no example.
pub fn example(code: &Code) -> Option<&'static str> {
    let examples = EXAMPLES.split(START).filter_map(|example| example.split_once('\n'));
    examples.filter(|(id, _)| *id == code.id).map(|(_, text)| text.trim_end()).next()
}

#[cfg(test)]
mod tests {
    use lexibus_codegen::diagnostics::codes::CODES;

    use super::*;

    #[test]
    fn an_example_shows_its_code() {
        for code in CODES {
            // IO001 has no example, because a test case cannot contain an unreadable file.
            let Some(text) = example(code) else {
                assert_eq!(code.id, "IO001");
                continue;
            };
            assert!(text.lines().next().is_some_and(|line| line.contains(&format!("[{}]", code.id))), "{text}");
        }
    }
}
