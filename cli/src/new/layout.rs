//! Breaks the lines of generated code like `rustfmt` with its default settings. Templates cannot contain these line
//! breaks, because the length of a line depends on the names in a description.

/// Maximum width of a line.
const LINE: usize = 100;

/// Maximum width of a list of arguments, or of a chain of calls, that is written on one line.
const SHORT: usize = 60;

/// A position in the code: the indentation, and the text of the line up to the expression.
#[derive(Clone, Copy)]
pub(super) struct At<'a>(pub usize, pub &'a str);

impl At<'_> {
    fn fits(self, text: &str) -> bool {
        self.0 + width(self.1) + width(text) <= LINE
    }

    /// Returns a line break and an indentation that is `levels` levels deeper than that of the line.
    fn newline(self, levels: usize) -> String {
        format!("\n{}", " ".repeat(self.0 + 4 * levels))
    }
}

fn width(text: &str) -> usize {
    text.chars().count()
}

/// Returns the code of a call, a macro or a tuple: `head`, the arguments in parentheses, and `end`.
pub(super) fn call(at: At<'_>, head: &str, arguments: &[&str], end: &str) -> String {
    let joined = arguments.join(", ");
    let one = format!("{head}({joined}){end}");
    if at.fits(&one) && (arguments.len() == 1 || width(&joined) <= SHORT) {
        return at.1.to_owned() + &one;
    }
    let lines = arguments.join(&format!(",{}", at.newline(1)));
    let comma = if head.ends_with('!') { "" } else { "," };
    format!("{}{head}({}{lines}{comma}{}){end}", at.1, at.newline(1), at.newline(0))
}

/// Returns the code of a chain of fields and calls that starts at `root`, followed by `end`.
pub(super) fn chain(at: At<'_>, root: &str, calls: &[&str], end: &str) -> String {
    let one = format!("{root}.{}", calls.join("."));
    if at.fits(&format!("{one}{end}")) && (calls.len() == 1 || width(&one) + width(end.trim_end_matches(';')) <= SHORT)
    {
        return format!("{}{one}{end}", at.1);
    }
    // If the root is not longer than one level of indentation, the first field or call stays on the same line as the
    // root.
    let separator = |position: usize| if position == 0 && width(root) <= 4 { String::new() } else { at.newline(1) };
    let lines: String = calls.iter().enumerate().map(|(at, call)| format!("{}.{call}", separator(at))).collect();
    format!("{}{root}{lines}{end}", at.1)
}

/// Returns the signature of a method of the driver. Breaks the line if it is too long at an indentation of one level.
pub(super) fn method(name: &str, value: Option<&str>, result: &str) -> String {
    let value = value.map(|ty| format!("value: {ty}"));
    let parameters: Vec<&str> = std::iter::once("&mut self").chain(value.as_deref()).collect();
    let one = format!("pub fn {name}({}) -> {result} {{", parameters.join(", "));
    if At(4, "").fits(&one) {
        return one;
    }
    format!("pub fn {name}(\n        {},\n    ) -> {result} {{", parameters.join(",\n        "))
}
