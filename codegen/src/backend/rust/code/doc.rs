//! Documents: code of one construct, and where it may be broken.

use compact_str::CompactString;

/// Code of one construct: its text on one line, and the places at which it may be broken.
///
/// The members of a list are all on one line, or each has its own line. As in Oppen's algorithm, a list is on one line only if the
/// text up to the next place for a break fits as well.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Doc {
    text: String,
    /// By their offsets in the text.
    marks: Vec<(usize, Mark)>,
}

/// A place in a document.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) enum Mark {
    /// Begins a list.
    Open,
    /// Begins the fields of a struct's literal; `is_long` if they are never on one line.
    OpenStruct { is_long: bool },
    /// Begins a list of numbers or names: a broken line has as many as fit.
    OpenNumbers,
    /// Is between members.
    Next,
    /// Ends a list, a struct or numbers.
    Close,
    /// A place at which the line could be broken and never is. The look-ahead ends here.
    Stop,
    /// A place at which the line continues on the next one if the rest doesn't fit. It replaces a blank behind it.
    Soft,
}

/// A part of a line: text, or a document.
pub trait Piece {
    /// Appends it.
    fn put(&self, to: &mut Doc);
}

/// A place at which the line could be broken and never is.
#[derive(Clone, Copy)]
pub struct Stop;

impl Piece for Stop {
    fn put(&self, to: &mut Doc) {
        to.mark(Mark::Stop);
    }
}

/// A place at which the line continues on the next one if the rest doesn't fit.
#[derive(Clone, Copy)]
pub struct Break;

impl Piece for Break {
    fn put(&self, to: &mut Doc) {
        to.mark(Mark::Soft);
    }
}

impl Piece for str {
    fn put(&self, to: &mut Doc) {
        to.text.push_str(self);
    }
}

impl Piece for String {
    fn put(&self, to: &mut Doc) {
        to.text.push_str(self);
    }
}

impl Piece for CompactString {
    fn put(&self, to: &mut Doc) {
        to.text.push_str(self);
    }
}

impl Piece for Doc {
    fn put(&self, to: &mut Doc) {
        let start = to.text.len();
        to.text.push_str(&self.text);
        to.marks.extend(self.marks.iter().map(|(at, mark)| (at + start, *mark)));
    }
}

impl Piece for std::fmt::Arguments<'_> {
    fn put(&self, to: &mut Doc) {
        // Writing to a String can't fail.
        let _ = std::fmt::Write::write_fmt(&mut to.text, *self);
    }
}

impl<P: Piece + ?Sized> Piece for &P {
    fn put(&self, to: &mut Doc) {
        (**self).put(to);
    }
}

impl<P: Piece> Piece for Option<P> {
    fn put(&self, to: &mut Doc) {
        if let Some(own) = self {
            own.put(to);
        }
    }
}

macro_rules! numbers {
    ($($number:ty)*) => {$(
        impl Piece for $number {
            fn put(&self, to: &mut Doc) {
                format_args!("{self}").put(to);
            }
        }
    )*};
}
numbers!(u8 u16 u32 u64 usize i128);

impl<T: Into<String>> From<T> for Doc {
    fn from(text: T) -> Self {
        Doc { text: text.into(), marks: Vec::new() }
    }
}

impl Doc {
    /// These pieces, one behind the other.
    pub fn of(pieces: &[&dyn Piece]) -> Self {
        let mut doc = Doc::default();
        pieces.iter().for_each(|piece| piece.put(&mut doc));
        doc
    }

    /// Its text, on one line.
    pub fn text(&self) -> &str {
        &self.text
    }

    pub(super) fn marks(&self) -> &[(usize, Mark)] {
        &self.marks
    }

    /// Makes it empty.
    pub(super) fn clear(&mut self) {
        self.text.clear();
        self.marks.clear();
    }

    fn mark(&mut self, mark: Mark) {
        self.marks.push((self.text.len(), mark));
    }

    /// A list of these members between `start` and `end`.
    fn list(start: &dyn Piece, members: &mut dyn Iterator<Item = &dyn Piece>, end: &str) -> Self {
        let mut doc = Doc::default();
        start.put(&mut doc);
        doc.mark(Mark::Open);
        for (at, member) in members.enumerate() {
            if at > 0 {
                doc.next();
            }
            member.put(&mut doc);
        }
        doc.mark(Mark::Close);
        doc.text.push_str(end);
        doc
    }

    /// The same for members of different types.
    pub fn joined(start: &[&dyn Piece], members: &[&dyn Piece], end: &str) -> Self {
        Doc::list(&Doc::of(start), &mut members.iter().copied(), end)
    }

    /// What separates two members.
    fn next(&mut self) {
        self.mark(Mark::Next);
        self.text.push_str(", ");
    }

    /// Whether a struct within it is never on one line.
    pub(super) fn has_long(&self) -> bool {
        self.marks.iter().any(|(_, mark)| matches!(mark, Mark::OpenStruct { is_long: true }))
    }
}

/// `start` and `end` with members between them, one a line where they don't fit.
pub fn list<P: Piece>(start: &str, members: impl IntoIterator<Item = P>, end: &str) -> Doc {
    let members: Vec<P> = members.into_iter().collect();
    Doc::list(&start, &mut members.iter().map(|own| own as &dyn Piece), end)
}

/// `&[…]`.
pub fn slice<P: Piece>(members: impl IntoIterator<Item = P>) -> Doc {
    list("&[", members, "]")
}

/// The pieces, one behind the other.
macro_rules! seq {
    ($($piece:expr),* $(,)?) => {
        $crate::backend::rust::code::Doc::of(&[$(&$piece),*])
    };
}

/// `path(…)`: a call, or the parameters of a function.
macro_rules! call {
    ($path:expr $(, $argument:expr)* $(,)?) => {
        $crate::backend::rust::code::Doc::joined(&[&$path, &"("], &[$(&$argument),*], ")")
    };
}

/// `path<…>`.
macro_rules! generic {
    ($path:expr $(, $argument:expr)* $(,)?) => {
        $crate::backend::rust::code::Doc::joined(&[&$path, &"<"], &[$(&$argument),*], ">")
    };
}

pub(in crate::backend::rust) use {call, generic, seq};

/// Literals of nothing but numbers, paths, structs, lists and calls.
pub struct Data;

impl Data {
    /// `Some(value)` or `None`.
    pub fn option(value: Option<impl std::fmt::Display>) -> Doc {
        match value {
            Some(value) => Doc::from(format!("Some({value})")),
            None => Doc::from("None"),
        }
    }

    /// A number in hexadecimal with four digits.
    pub fn index(value: u16) -> Doc {
        Doc::from(format!("0x{value:04X}"))
    }

    /// `path { name: value, … }`, on one line only where it is short; `path` where there is no field.
    pub fn fields<N: AsRef<str>>(path: &str, fields: impl IntoIterator<Item = (N, Doc)>) -> Doc {
        /// A literal longer than this, up to the blank before its closing brace, has one line per field.
        const SHORT: usize = 34;
        let mut fields = fields.into_iter().peekable();
        let mut doc = Doc::from(path);
        if fields.peek().is_none() {
            return doc;
        }
        doc.text.push_str(" {");
        let open = doc.marks.len();
        doc.mark(Mark::OpenStruct { is_long: false });
        doc.text.push(' ');
        for (at, (name, value)) in fields.enumerate() {
            if at > 0 {
                doc.next();
            }
            doc.text.push_str(name.as_ref());
            if value.text != name.as_ref() {
                doc.text.push_str(": ");
                value.put(&mut doc);
            }
        }
        doc.mark(Mark::Close);
        doc.text.push(' ');
        let is_long = doc.text.len() > SHORT || doc.has_long();
        doc.text.push('}');
        doc.marks[open].1 = Mark::OpenStruct { is_long };
        doc
    }

    /// `&[…]`, filled with as many members a line as fit where all are numbers.
    pub fn slice(members: impl IntoIterator<Item = Doc>) -> Doc {
        let members: Vec<Doc> = members.into_iter().collect();
        let is_number = |own: &Doc| own.marks.is_empty() && own.text.starts_with(|first: char| first.is_ascii_digit());
        let mut doc = slice(&members);
        if members.iter().all(is_number) {
            doc.marks[0].1 = Mark::OpenNumbers;
        }
        doc
    }

    /// The end of an import: the name, or `{…}` filled with as many names a line as fit.
    pub fn names(names: &[String]) -> Doc {
        if let [only] = names {
            return Doc::from(only.as_str());
        }
        let mut doc = list("{", names, "}");
        doc.marks[0].1 = Mark::OpenNumbers;
        doc
    }

    /// `path(…)`. A single struct stays on the line of its call.
    pub fn call(path: &str, arguments: impl IntoIterator<Item = Doc>) -> Doc {
        let arguments: Vec<Doc> = arguments.into_iter().collect();
        match arguments.as_slice() {
            [only] if matches!(only.marks.first(), Some((_, Mark::OpenStruct { .. }))) => seq![path, "(", only, ")"],
            _ => list(&format!("{path}("), &arguments, ")"),
        }
    }
}
