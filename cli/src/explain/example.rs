//! Example of each code: a diagnostic from the code's case in `tests/ui`.

use lexibus_codegen::diagnostics::Code;

/// All examples, each below a line with [`START`] and the code. The test `ui` writes the file from the cases.
const EXAMPLES: &str = include_str!("examples.txt");

/// Start of the line above an example.
const START: &str = "=== ";

/// Returns the diagnostic that a terminal shows for an input with the fault.
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
            // Cases cannot show an unreadable file.
            let Some(text) = example(code) else {
                assert_eq!(code.id, "IO001");
                continue;
            };
            assert!(text.lines().next().is_some_and(|line| line.contains(&format!("[{}]", code.id))), "{text}");
        }
    }
}
