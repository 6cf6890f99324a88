//! Documents: the code of a construct with marked positions for line breaks.

use compact_str::CompactString;

use crate::number::hex16;

/// Code of one construct: its text on one line, with marked positions for line breaks.
///
/// The members of a list are either all on one line or each on a separate line. Lists of numbers or names are an
/// exception. As in Oppen's algorithm, a list is on one line only if the text that follows it, up to the next break
/// position, also fits.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Doc {
    text: String,
    /// Marks, each with its byte offset in the text. No document has 4 GiB.
    marks: Vec<(u32, Mark)>,
}

/// The meaning of a position in a document.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) enum Mark {
    /// Begins a list of members.
    Open,
    /// Begins the fields of a struct literal. `is_long` means that each field has its own line.
    OpenStruct { is_long: bool },
    /// Begins a list of numbers or names. If the list is broken, each line has as many members as fit.
    OpenNumbers,
    /// Separates two members of a list.
    Next,
    /// Ends a list, struct literal or list of numbers.
    Close,
    /// Ends the text that must fit on the line together with the preceding list. The line is never broken at this
    /// position.
    Stop,
    /// A position where the line is broken if the following text does not fit. A line break replaces the space at this
    /// position.
    Soft,
}

/// A piece of a line: text or a document.
pub trait Piece {
    /// Appends the piece to a document.
    fn put(&self, to: &mut Doc);
}

/// The piece for [`Mark::Stop`], which ends the text that must fit on the line together with the preceding list.
#[derive(Clone, Copy)]
pub struct Stop;

impl Piece for Stop {
    fn put(&self, to: &mut Doc) {
        to.mark(Mark::Stop);
    }
}

/// A position where the line is broken if the following text does not fit.
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
        let start = to.end();
        to.text.push_str(&self.text);
        to.marks.extend(self.marks.iter().map(|(at, mark)| (at.saturating_add(start), *mark)));
    }
}

impl Piece for std::fmt::Arguments<'_> {
    fn put(&self, to: &mut Doc) {
        // Writing to a `String` never fails.
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
        if let Some(piece) = self {
            piece.put(to);
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
    /// Creates a document from pieces in their order.
    pub fn of(pieces: &[&dyn Piece]) -> Self {
        let mut doc = Doc::default();
        pieces.iter().for_each(|piece| piece.put(&mut doc));
        doc.exact()
    }

    /// Frees the unused capacity, because a model contains many documents.
    fn exact(mut self) -> Self {
        self.text.shrink_to_fit();
        self.marks.shrink_to_fit();
        self
    }

    /// Returns the text of the document, on one line.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Returns the marks from a position on, each with its byte offset in the text.
    pub(super) fn marks(&self, from: usize) -> impl Iterator<Item = (usize, Mark)> + '_ {
        self.marks.get(from..).unwrap_or_default().iter().map(|(at, mark)| (*at as usize, *mark))
    }

    /// Removes all text and all marks from the document.
    pub(super) fn clear(&mut self) {
        self.text.clear();
        self.marks.clear();
    }

    fn mark(&mut self, mark: Mark) {
        self.marks.push((self.end(), mark));
    }

    fn end(&self) -> u32 {
        u32::try_from(self.text.len()).unwrap_or(u32::MAX)
    }

    /// Creates a list of members between `start` and `end`.
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
        doc.exact()
    }

    /// Creates a list from members of different types.
    pub fn joined(start: &[&dyn Piece], members: &[&dyn Piece], end: &str) -> Self {
        Doc::list(&Doc::of(start), &mut members.iter().copied(), end)
    }

    /// Adds a separator after a member of a list.
    fn next(&mut self) {
        self.mark(Mark::Next);
        self.text.push_str(", ");
    }

    /// Returns whether the document contains a struct literal whose fields each have their own line.
    pub(super) fn has_long(&self) -> bool {
        self.marks.iter().any(|(_, mark)| matches!(mark, Mark::OpenStruct { is_long: true }))
    }
}

/// Creates a list of members between `start` and `end`. If the members do not fit on one line, each member has its own
/// line.
pub fn list<P: Piece>(start: &str, members: impl IntoIterator<Item = P>, end: &str) -> Doc {
    let members: Vec<P> = members.into_iter().collect();
    Doc::list(&start, &mut members.iter().map(|member| member as &dyn Piece), end)
}

/// Creates `&[…]`.
pub fn slice<P: Piece>(members: impl IntoIterator<Item = P>) -> Doc {
    list("&[", members, "]")
}

/// Creates a document from pieces in their order.
macro_rules! seq {
    ($($piece:expr),* $(,)?) => {
        $crate::backend::rust::code::Doc::of(&[$(&$piece),*])
    };
}

/// Creates `path(…)`, which is a call or a function's parameter list.
macro_rules! call {
    ($path:expr $(, $argument:expr)* $(,)?) => {
        $crate::backend::rust::code::Doc::joined(&[&$path, &"("], &[$(&$argument),*], ")")
    };
}

/// Creates `path<…>`.
macro_rules! generic {
    ($path:expr $(, $argument:expr)* $(,)?) => {
        $crate::backend::rust::code::Doc::joined(&[&$path, &"<"], &[$(&$argument),*], ">")
    };
}

pub(in crate::backend::rust) use {call, generic, seq};

/// Creates the values of constants from numbers, paths, structs, lists and calls.
pub struct Data;

impl Data {
    /// Creates `Some(value)` or `None`.
    pub fn option(value: Option<impl std::fmt::Display>) -> Doc {
        match value {
            Some(value) => Doc::from(format!("Some({value})")),
            None => Doc::from("None"),
        }
    }

    /// Creates `Some(value)` or `None`. The line can be broken inside of the value.
    pub fn optional(value: Option<Doc>) -> Doc {
        value.map_or_else(|| Doc::from("None"), |value| Data::call("Some", [value]))
    }

    /// Creates a hexadecimal number with four digits.
    pub fn index(value: u16) -> Doc {
        Doc::from(hex16(value))
    }

    /// Creates `path { name: value, … }`. The literal is on one line only if it is short. Without fields, creates only
    /// `path`.
    pub fn fields<N: AsRef<str>>(path: &str, fields: impl IntoIterator<Item = (N, Doc)>) -> Doc {
        /// Maximum length of a struct literal on one line, counted up to the space before its closing brace.
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

    /// Creates `&[…]`. If all members are numbers, each line contains as many numbers as fit.
    pub fn slice(members: impl IntoIterator<Item = Doc>) -> Doc {
        let members: Vec<Doc> = members.into_iter().collect();
        let is_number =
            |member: &Doc| member.marks.is_empty() && member.text.starts_with(|first: char| first.is_ascii_digit());
        let mut doc = slice(&members);
        if members.iter().all(is_number) {
            doc.marks[0].1 = Mark::OpenNumbers;
        }
        doc
    }

    /// Creates the last part of an import: a single name, or `{…}` with as many names per line as fit.
    pub fn names(names: &[String]) -> Doc {
        if let [only] = names {
            return Doc::from(only.as_str());
        }
        let mut doc = list("{", names, "}");
        doc.marks[0].1 = Mark::OpenNumbers;
        doc
    }

    /// Creates `path(…)`. If the only argument is a struct literal, it starts on the same line.
    pub fn call(path: &str, arguments: impl IntoIterator<Item = Doc>) -> Doc {
        let arguments: Vec<Doc> = arguments.into_iter().collect();
        match arguments.as_slice() {
            [only] if matches!(only.marks.first(), Some((_, Mark::OpenStruct { .. }))) => seq![path, "(", only, ")"],
            _ => list(&format!("{path}("), &arguments, ")"),
        }
    }
}
