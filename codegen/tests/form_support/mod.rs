//! Tests that generated code has the format of `prettyplease`.

/// Returns the code without its header and without calls of `location!`. `prettyplease` drops comments such as the header,
/// and does not format the braces of macros.
fn body(text: &str) -> String {
    let mut end = None;
    let is_formatted = |line: &&str| {
        let was_inside = end.is_some();
        if line.trim_start() == "rt::location! {" {
            end = Some(line.replace("rt::location! {", "}"));
        } else if end.as_deref() == Some(*line) {
            end = None;
        }
        !was_inside && end.is_none()
    };
    let lines = text.lines().skip_while(|line| line.starts_with("//")).skip_while(|line| line.is_empty());
    lines.filter(is_formatted).flat_map(|line| [line, "\n"]).collect()
}

/// Compares code with the output of `prettyplease`. Returns a syntax error, the first different line, or a different length as an
/// error.
pub fn canonical(name: &str, text: &str) -> Result<(), String> {
    let text = body(text);
    let parsed = syn::parse_file(&text).map_err(|error| format!("{name}: {error}"))?;
    let expected = prettyplease::unparse(&parsed);
    for (line, (ours, theirs)) in text.lines().zip(expected.lines()).enumerate() {
        if ours != theirs {
            return Err(format!("{name}, line {} without header and macros:\n    {ours}\n    {theirs}", line + 1));
        }
    }
    (text.len() == expected.len()).then_some(()).ok_or_else(|| format!("{name}: not of the same length"))
}
