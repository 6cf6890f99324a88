//! A tree of tables, lists and scalars with spans, which TOML and YAML share.

use std::ops::Deref;

use lexibus_codegen::source::Span;

/// A value with its location in the file.
#[derive(Clone, Debug, PartialEq)]
pub struct At<T> {
    /// The value.
    pub value: T,
    /// Location of the value.
    pub span: Span,
}

impl<T> At<T> {
    /// Creates a value at `span`.
    pub fn new(value: T, span: Span) -> Self {
        At { value, span }
    }
}

impl<T> Deref for At<T> {
    type Target = T;

    fn deref(&self) -> &T {
        &self.value
    }
}

/// An element of the tree.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// Location of the element.
    pub span: Span,
    /// Content of the element.
    pub content: Content,
}

/// Content of a [`Node`].
#[derive(Clone, Debug, PartialEq)]
pub enum Content {
    /// A single value.
    Scalar(Scalar),
    /// Elements in their order.
    List(Vec<Node>),
    /// Keys with values, in their order.
    Table(Vec<Entry>),
}

/// A key with its value.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// The key.
    pub key: At<String>,
    /// The value.
    pub value: Node,
}

/// A single value.
#[derive(Clone, Debug, PartialEq)]
pub enum Scalar {
    /// No value.
    Null,
    /// `true` or `false`.
    Bool(bool),
    /// An integer.
    Integer(i128),
    /// A real number.
    Real(f64),
    /// A text.
    Text(String),
}

impl Scalar {
    /// Describes the value for diagnostics: `the text "a"`, `the integer 5`.
    pub fn described(&self) -> String {
        match self {
            Scalar::Null => "no value".to_owned(),
            Scalar::Bool(flag) => format!("`{flag}`"),
            Scalar::Integer(number) => format!("the integer {number}"),
            Scalar::Real(number) => format!("the number {number}"),
            Scalar::Text(text) => format!("the text {:?}", lexibus_codegen::text::brief(text)),
        }
    }
}

impl Node {
    /// Describes the element for diagnostics: `a table`, `the integer 5`.
    pub fn described(&self) -> String {
        match &self.content {
            Content::Scalar(scalar) => scalar.described(),
            Content::List(_) => "a list".to_owned(),
            Content::Table(_) => "a table".to_owned(),
        }
    }
}

/// A syntax error.
#[derive(Debug)]
pub struct SyntaxError {
    /// Location of the error.
    pub span: Span,
    /// Message for a diagnostic.
    pub message: String,
}
