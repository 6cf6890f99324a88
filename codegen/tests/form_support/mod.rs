//! The form of generated code is that of `prettyplease`.

/// Without the header, which is no documentation, and without the calls of `location!`: `prettyplease` drops comments, and gives what
/// is in the braces of a macro no form.
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

/// The first line that isn't as `prettyplease` prints it.
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
