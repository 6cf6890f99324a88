//! Renders templates. Rendering cannot fail because the templates contain no fallible expressions.

use askama::Template;

/// Renders a template of an HTML page.
pub(super) fn html(template: &impl Template) -> String {
    template.render().unwrap_or_default()
}

/// Renders a template of a Markdown page and reduces consecutive empty lines to one.
pub(super) fn markdown(template: &impl Template) -> String {
    let rendered = template.render().unwrap_or_default();
    let mut text = String::with_capacity(rendered.len());
    let mut was_empty = true;
    for line in rendered.lines().map(str::trim_end) {
        if !(was_empty && line.is_empty()) {
            text.push_str(line);
            text.push('\n');
        }
        was_empty = line.is_empty();
    }
    text.truncate(text.trim_end().len());
    text.push('\n');
    text
}
