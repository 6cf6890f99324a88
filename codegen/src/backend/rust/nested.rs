//! Modules within the generated module.

/// How far the content of a module stands to the right of the module.
pub(super) const STEP: usize = 4;

/// Writes a module, where it has content; that was written at the left margin.
pub(super) fn module(out: &mut String, heading: &str, name: &str, content: &str) {
    if content.is_empty() {
        return;
    }
    *out += &format!("/// {heading}\npub mod {name} {{\n");
    for line in content.lines() {
        if !line.is_empty() {
            out.extend(std::iter::repeat_n(' ', STEP));
        }
        out.push_str(line);
        out.push('\n');
    }
    out.push_str("}\n");
}
