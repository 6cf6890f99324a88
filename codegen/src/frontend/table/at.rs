//! Common types of the format: values with their span, entries in the order of the file, and alternatives.

/// Value with its span, in bytes of the file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct At<T> {
    /// Value without its span.
    pub value: T,
    /// Offset of the first byte.
    pub start: u32,
    /// Offset after the last byte.
    pub end: u32,
}

/// Entries of a table, in the order of the file.
#[derive(Clone, Debug, PartialEq)]
pub struct Entries<T>(pub Vec<(At<String>, At<T>)>);

impl<T> Default for Entries<T> {
    fn default() -> Self {
        Entries(Vec::new())
    }
}

impl<T> Entries<T> {
    /// Returns an iterator over the keys and their values.
    pub fn iter(&self) -> impl Iterator<Item = &(At<String>, At<T>)> {
        self.0.iter()
    }
}

/// Number, text or Boolean.
#[derive(Clone, Debug, PartialEq)]
pub enum Literal {
    /// Boolean: `true` or `false`.
    Bool(bool),
    /// Integer.
    Int(i128),
    /// Number with a fraction.
    Real(f64),
    /// Text.
    Text(String),
}

/// Text, or a table that contains the text and further keys.
#[derive(Clone, Debug, PartialEq)]
pub enum TextOr<T> {
    /// Text without further keys.
    Text(String),
    /// Table with the text and further keys.
    Table(Box<T>),
}

/// Boolean, or a table with further keys.
#[derive(Clone, Debug, PartialEq)]
pub enum FlagOr<T> {
    /// Boolean: `true` or `false`.
    Flag(bool),
    /// Table with further keys.
    Table(Box<T>),
}

/// Single value, or a list of values.
#[derive(Clone, Debug, PartialEq)]
pub struct OneOrMany<T>(pub Vec<T>);

impl<T> Default for OneOrMany<T> {
    fn default() -> Self {
        OneOrMany(Vec::new())
    }
}

#[cfg(test)]
mod schema {
    //! JSON Schemas of the types in this file.

    use std::borrow::Cow;

    use schemars::{json_schema, JsonSchema, Schema, SchemaGenerator};

    use super::{At, Entries, FlagOr, Literal, OneOrMany, TextOr};

    impl<T: JsonSchema> JsonSchema for At<T> {
        fn inline_schema() -> bool {
            T::inline_schema()
        }

        fn schema_name() -> Cow<'static, str> {
            T::schema_name()
        }

        fn schema_id() -> Cow<'static, str> {
            T::schema_id()
        }

        fn json_schema(generator: &mut SchemaGenerator) -> Schema {
            T::json_schema(generator)
        }
    }

    impl JsonSchema for Literal {
        fn inline_schema() -> bool {
            true
        }

        fn schema_name() -> Cow<'static, str> {
            "Literal".into()
        }

        fn json_schema(_: &mut SchemaGenerator) -> Schema {
            json_schema!({ "type": ["boolean", "number", "string"] })
        }
    }

    /// Implements `JsonSchema` for types whose schema is repeated at each use of the type.
    macro_rules! inline {
        ($($name:ident $prefix:literal $inner:ident $schema:tt)*) => {$(
            impl<T: JsonSchema> JsonSchema for $name<T> {
                fn inline_schema() -> bool {
                    true
                }

                fn schema_name() -> Cow<'static, str> {
                    format!(concat!($prefix, "_{}"), T::schema_name()).into()
                }

                fn json_schema(generator: &mut SchemaGenerator) -> Schema {
                    let $inner = generator.subschema_for::<T>();
                    json_schema!($schema)
                }
            }
        )*};
    }

    inline! {
        Entries "Entries_of" inner { "type": "object", "additionalProperties": inner }
        TextOr "Text_or" table { "anyOf": [{ "type": "string" }, table] }
        FlagOr "Flag_or" table { "anyOf": [{ "type": "boolean" }, table] }
        OneOrMany "One_or_many" one { "anyOf": [one, { "type": "array", "items": one }] }
    }
}
