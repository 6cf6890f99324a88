//! Sections of network files with their keys.

/// A kind of table in a network file, with its keys.
#[derive(Debug)]
pub(crate) struct Section {
    /// Name of the table for diagnostics: `the section of a node`.
    pub name: &'static str,
    /// Keys that the table can contain.
    pub keys: &'static [Key],
}

/// A key of a [`Section`].
#[derive(Debug)]
pub(crate) struct Key {
    /// Name of the key.
    pub name: &'static str,
    /// Form of the value.
    pub form: Form,
    /// Description of the value for the JSON Schema, with its unit.
    pub about: &'static str,
}

/// Form of a value.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Form {
    /// An integer in a range.
    Integer(i64, i64),
    /// A positive number.
    Number,
    /// `true` or `false`.
    Flag,
    /// A text.
    Text,
    /// A text with 1 byte up to a maximum number of bytes.
    ShortText(usize),
    /// A list of texts.
    Texts,
    /// A table that is described by a section.
    Table(&'static Section),
    /// A table whose values are tables described by the same section, such as `nodes`.
    Named(&'static Section),
    /// A table with arbitrary keys and single values.
    Values,
    /// A table with arbitrary keys. Each value is a single value, or a table that is described by a section.
    ValuesOr(&'static Section),
    /// A list of objects.
    Objects,
    /// An integer or a text.
    IntegerOrText,
    /// Any value, which Lexibus ignores.
    Ignored,
}

/// Declares the keys of a section: name, form, description. Only `network.toml` needs descriptions, for its JSON Schema.
macro_rules! keys {
    ($($name:literal $form:expr $(, $about:literal)?;)*) => {
        &[$($crate::frontend::section::Key { name: $name, form: $form, about: concat!($($about)?) }),*]
    };
}
pub(crate) use keys;
