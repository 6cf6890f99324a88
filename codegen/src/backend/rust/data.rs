//! Nested literals (structs, arrays, calls) in the form in which `prettyplease` prints them.

/// The greatest width of a line, in bytes as `prettyplease` counts.
const MARGIN: usize = 89;

/// A struct literal that is longer than this up to its closing brace gets a line a field.
const SHORT_STRUCT: usize = 34;

/// An expression of nothing but literals, paths and calls.
#[derive(Clone, Debug)]
pub(super) enum Data {
    /// A number, a string, a path.
    Text(String),
    /// `path { name: value, … }`.
    Struct(&'static str, Vec<(&'static str, Data)>),
    /// `&[…]`.
    Slice(Vec<Data>),
    /// `path(…)`.
    Call(&'static str, Vec<Data>),
}

impl Data {
    /// Any text that stays on its line.
    pub fn text(text: impl Into<String>) -> Self {
        Data::Text(text.into())
    }

    /// `true` or `false`.
    pub fn flag(value: bool) -> Self {
        Data::text(value.to_string())
    }

    /// `Some(value)` or `None`.
    pub fn option(value: Option<impl std::fmt::Display>) -> Self {
        match value {
            Some(value) => Data::text(format!("Some({value})")),
            None => Data::text("None"),
        }
    }

    /// A number in hexadecimal with four digits.
    pub fn index(value: u16) -> Self {
        Data::text(format!("0x{value:04X}"))
    }

    /// The text of the expression that starts in `column` of a line indented by `indent`, with `tail` bytes behind it.
    /// `nest` is how far the whole text is moved to the right afterwards; `column` doesn't count that.
    pub fn render(&self, indent: usize, column: usize, tail: usize, nest: usize) -> String {
        let mut out = String::new();
        self.write(&mut out, indent, column, tail, MARGIN - nest);
        out
    }

    fn write(&self, out: &mut String, indent: usize, column: usize, tail: usize, margin: usize) {
        if let Some(flat) = self.flat().filter(|flat| column + flat.len() + tail <= margin) {
            out.push_str(&flat);
            return;
        }
        let inner = indent + 4;
        match self {
            Data::Text(text) => out.push_str(text),
            Data::Struct(path, fields) => {
                out.push_str(path);
                out.push_str(" {");
                for (left, (name, value)) in (0..fields.len()).rev().zip(fields) {
                    line(out, inner);
                    let start = inner + name.len() + 2;
                    out.push_str(name);
                    out.push_str(": ");
                    value.write(out, inner, start, behind(left), margin);
                    out.push(',');
                }
                line(out, indent);
                out.push('}');
            }
            Data::Slice(elements) if elements.iter().all(Data::is_number) => {
                out.push_str("&[");
                fill(out, elements, inner, margin);
                line(out, indent);
                out.push(']');
            }
            Data::Slice(elements) => {
                out.push_str("&[");
                members(out, elements, inner, margin);
                line(out, indent);
                out.push(']');
            }
            Data::Call(path, arguments) => {
                out.push_str(path);
                out.push('(');
                match arguments.as_slice() {
                    // A single struct stays on the line of its call.
                    [only @ Data::Struct(..)] => only.write(out, indent, column + path.len() + 1, tail + 1, margin),
                    _ => {
                        members(out, arguments, inner, margin);
                        line(out, indent);
                    }
                }
                out.push(')');
            }
        }
    }

    /// On one line, where that is allowed at all.
    fn flat(&self) -> Option<String> {
        let list = |elements: &[Data]| -> Option<String> {
            let flat: Option<Vec<String>> = elements.iter().map(Data::flat).collect();
            Some(flat?.join(", "))
        };
        match self {
            Data::Text(text) => Some(text.clone()),
            Data::Slice(elements) => Some(format!("&[{}]", list(elements)?)),
            Data::Call(path, arguments) => Some(format!("{path}({})", list(arguments)?)),
            Data::Struct(path, fields) => {
                let flat = |(name, value): &(&str, Data)| Some(format!("{name}: {}", value.flat()?));
                let fields: Option<Vec<String>> = fields.iter().map(flat).collect();
                let text = format!("{path} {{ {} ", fields?.join(", "));
                (text.len() <= SHORT_STRUCT).then(|| text + "}")
            }
        }
    }

    fn is_number(&self) -> bool {
        match self {
            Data::Text(text) => text.starts_with(|first: char| first.is_ascii_digit()),
            _ => false,
        }
    }
}

/// The comma behind an element counts where another element follows; the last one's may stand beyond the margin.
fn behind(left: usize) -> usize {
    usize::from(left > 0)
}

fn line(out: &mut String, indent: usize) {
    out.push('\n');
    out.extend(std::iter::repeat_n(' ', indent));
}

fn members(out: &mut String, elements: &[Data], indent: usize, margin: usize) {
    for (left, element) in (0..elements.len()).rev().zip(elements) {
        line(out, indent);
        element.write(out, indent, indent, behind(left), margin);
        out.push(',');
    }
}

/// Numbers, as many on a line as fit.
fn fill(out: &mut String, elements: &[Data], indent: usize, margin: usize) {
    let mut column = usize::MAX;
    for (left, element) in (0..elements.len()).rev().zip(elements) {
        let Data::Text(text) = element else { continue };
        if column.saturating_add(1 + text.len() + behind(left)) > margin {
            line(out, indent);
            column = indent;
        } else {
            out.push(' ');
            column += 1;
        }
        out.push_str(text);
        out.push(',');
        column += text.len() + 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn canonical(data: &Data) {
        let text = format!("static X: T = {};\n", data.render(0, 14, 1, 0));
        assert_eq!(text, prettyplease::unparse(&syn::parse_file(&text).unwrap()));
    }

    #[test]
    fn literals_are_as_prettyplease_prints_them() {
        let numbers = |count: u16| Data::Slice((0..count).map(|at| Data::index(at * 7)).collect());
        for count in 0..60 {
            canonical(&numbers(count));
        }
        let point = |size: usize| {
            Data::Struct("rt::P", vec![("x", Data::text("1".repeat(size))), ("long_name", Data::option(Some(2)))])
        };
        for size in 1..70 {
            canonical(&point(size));
            canonical(&Data::Slice(vec![point(size), point(1)]));
            canonical(&Data::Call("Some", vec![point(size)]));
            let call = Data::Call("rt::f", vec![Data::text("a".repeat(size)), Data::text("b".repeat(20))]);
            canonical(&call);
            canonical(&Data::Slice(vec![call.clone(), call.clone()]));
            canonical(&Data::Struct(
                "rt::Q",
                vec![("call", call), ("numbers", numbers(size as u16)), ("point", point(3))],
            ));
        }
    }
}
