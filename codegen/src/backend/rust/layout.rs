//! Breaks long lines where and how `prettyplease` would.
//!
//! The template writes every construct on one line and marks where it may be broken: `«` and `»` enclose a group,
//! `¦` separates its members, and `¬` stands where `prettyplease` could break a line but never does. A group that doesn't fit the line has each member on a line of its own, with a comma behind
//! each. `‡` is a blank, or the start of a further line where what follows doesn't fit. As in Oppen's algorithm, what follows a group up to the next place for a break has to fit, too. The marks are
//! taken out of everything that comes from a description before it gets here.

/// The greatest width of a line, in bytes as `prettyplease` counts.
const MARGIN: usize = 89;

const OPEN: char = '«';
const CLOSE: char = '»';
const NEXT: char = '¦';
const STOP: char = '¬';
const SOFT: char = '‡';

/// Whether a letter is a mark.
pub(super) fn is_mark(letter: char) -> bool {
    matches!(letter, OPEN | CLOSE | NEXT | STOP | SOFT)
}

/// `text` with its marks carried out.
pub(super) fn fit(text: &str) -> String {
    let mut out = String::with_capacity(text.len() + text.len() / 16);
    for line in text.split_inclusive('\n') {
        let is_comment = line.trim_start().starts_with("//");
        if is_comment || memchr::memchr(0xC2, line.as_bytes()).is_none() || !line.contains([OPEN, SOFT, STOP]) {
            out.push_str(line);
        } else {
            break_line(line, &mut out);
        }
    }
    out
}

/// A string literal keeps its signs, so that its marks are none.
fn is_quote(letter: char, previous: char) -> bool {
    letter == '"' && previous != '\\'
}

fn break_line(line: &str, out: &mut String) {
    let indent = line.len() - line.trim_start_matches(' ').len();
    let tokens = tokenize(line.trim_end_matches('\n'));
    let mut printer = Printer { tokens: &tokens, out, column: 0, indent, broken: Vec::new() };
    for at in 0..tokens.len() {
        printer.print(at);
    }
    out.push('\n');
}

#[derive(Debug, PartialEq, Eq)]
enum Token<'a> {
    Text(&'a str),
    Open,
    Next,
    Close,
    /// A place for a break that is never used, but ends the look ahead.
    Stop,
    /// A blank in front of an operator.
    Soft,
}

fn tokenize(line: &str) -> Vec<Token<'_>> {
    let mut tokens = Vec::new();
    let mut start = 0;
    let mut in_string = false;
    let mut previous = ' ';
    for (at, letter) in line.char_indices() {
        if is_quote(letter, previous) {
            in_string = !in_string;
        }
        // `\\` is a backslash, and not the escape of what follows.
        previous = if previous == '\\' && letter == '\\' { ' ' } else { letter };
        if in_string || !is_mark(letter) {
            continue;
        }
        if at > start {
            tokens.push(Token::Text(&line[start..at]));
        }
        tokens.push(match letter {
            OPEN => Token::Open,
            CLOSE => Token::Close,
            STOP => Token::Stop,
            SOFT => Token::Soft,
            _ => Token::Next,
        });
        start = at + letter.len_utf8();
        // The blank behind a separator is the separator's own.
        if letter == NEXT && line[start..].starts_with(' ') {
            start += 1;
        }
    }
    if start < line.len() {
        tokens.push(Token::Text(&line[start..]));
    }
    tokens
}

struct Printer<'t, 'o> {
    tokens: &'t [Token<'t>],
    out: &'o mut String,
    column: usize,
    indent: usize,
    /// For each open group, whether it is broken.
    broken: Vec<bool>,
}

impl Printer<'_, '_> {
    fn print(&mut self, at: usize) {
        let parent_fits = self.broken.last() == Some(&false);
        match &self.tokens[at] {
            Token::Text(text) => self.text(text),
            Token::Stop => {}
            Token::Soft => {
                if !parent_fits && self.column + 1 + self.width(at + 1) > MARGIN {
                    self.indent += 4;
                    self.newline();
                    self.indent -= 4;
                } else {
                    self.text(" ");
                }
            }
            Token::Open => {
                let breaks = !parent_fits && self.column + self.width(at) > MARGIN;
                self.broken.push(breaks);
                if breaks {
                    self.indent += 4;
                    self.newline();
                }
            }
            Token::Next => {
                self.text(",");
                if self.broken.last() == Some(&true) {
                    self.newline();
                } else {
                    self.text(" ");
                }
            }
            Token::Close => {
                if self.broken.pop() == Some(true) {
                    self.text(",");
                    self.indent -= 4;
                    self.newline();
                }
            }
        }
    }

    fn text(&mut self, text: &str) {
        self.out.push_str(text);
        self.column += text.len();
    }

    fn newline(&mut self) {
        self.out.push('\n');
        self.out.extend(std::iter::repeat_n(' ', self.indent));
        self.column = self.indent;
    }

    /// Width on one line of the group that opens at `at`, and of what follows it up to the next place for a break that
    /// lies in no later group.
    fn width(&self, at: usize) -> usize {
        let (mut width, mut depth) = (0, 0);
        for token in &self.tokens[at..] {
            match token {
                Token::Text(text) => width += text.len(),
                Token::Open => depth += 1,
                // Behind the group, a separator or the end of the group around it.
                Token::Next if depth == 0 => return width + 1,
                Token::Close | Token::Stop | Token::Soft if depth == 0 => return width,
                Token::Stop => {}
                Token::Soft => width += 1,
                Token::Next => width += 2,
                Token::Close => depth -= 1,
            }
        }
        width
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_lines_lose_their_marks() {
        assert_eq!(fit("a(«b¦ c»);\n"), "a(b, c);\n");
        assert_eq!(fit("x(«\"«¦»\"»)\n"), "x(\"«¦»\")\n");
        assert_eq!(fit("/// « stays »\n"), "/// « stays »\n");
    }

    #[test]
    fn long_groups_break_from_the_outside() {
        let name = "n".repeat(70);
        assert_eq!(
            fit(&format!("    {name}(«aaaaaaaa¦ f(«b»)»);\n")),
            format!("    {name}(\n        aaaaaaaa,\n        f(b),\n    );\n")
        );
        assert_eq!(fit(&format!("{name}: get(«a¦ b»)‡as u32,\n")), format!("{name}: get(a, b) as u32,\n"));
        let long = format!("{name}{name}");
        assert_eq!(
            fit(&format!("{}: get(«a»)‡as u32,\n", &long[..75])),
            format!("{}: get(a)\n    as u32,\n", &long[..75])
        );
        let line = format!("fn {name}(«&mut self») -> f<«u8»> {{\n");
        assert_eq!(fit(&line), format!("fn {name}(\n    &mut self,\n) -> f<u8> {{\n"));
    }
}
