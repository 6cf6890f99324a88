//! JSON values whose objects keep the order of their fields.

use std::borrow::Cow;

use serde::{Serialize, Serializer};

use lexibus_codegen::text::steers;

/// A JSON value.
#[derive(Serialize)]
#[serde(untagged)]
pub(super) enum Json<'a> {
    Null,
    Flag(bool),
    Number(usize),
    Text(Cow<'a, str>),
    List(Vec<Json<'a>>),
    #[serde(serialize_with = "in_order")]
    Object(Vec<(&'static str, Json<'a>)>),
}

fn in_order<S: Serializer>(fields: &[(&'static str, Json<'_>)], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(fields.iter().map(|(name, value)| (name, value)))
}

/// Returns an object with these fields.
pub(super) fn object<'a>(fields: impl IntoIterator<Item = (&'static str, Json<'a>)>) -> Json<'a> {
    Json::Object(fields.into_iter().collect())
}

/// Returns an object with these fields, except those whose value is null.
pub(super) fn without_nulls<'a>(fields: impl IntoIterator<Item = (&'static str, Json<'a>)>) -> Json<'a> {
    object(fields.into_iter().filter(|(_, value)| !matches!(value, Json::Null)))
}

/// Returns a list of these values.
pub(super) fn list<'a>(values: impl IntoIterator<Item: Into<Json<'a>>>) -> Json<'a> {
    Json::List(values.into_iter().map(Into::into).collect())
}

impl Json<'_> {
    /// Returns the value on one line.
    ///
    /// Escapes all control characters. JSON allows some of them in strings, but a terminal would interpret them. Control
    /// characters occur only in strings, where the escape sequence has the same meaning.
    pub(super) fn to_text(&self) -> String {
        let json = serde_json::to_string(self).expect("strings and numbers serialize");
        if !json.contains(steers) {
            return json;
        }
        let mut text = String::with_capacity(json.len() + 16);
        for c in json.chars() {
            if steers(c) {
                text += &format!("\\u{:04x}", u32::from(c));
            } else {
                text.push(c);
            }
        }
        text
    }
}

macro_rules! from {
    ($($ty:ty: $value:ident => $json:expr,)+) => {
        $(impl<'a> From<$ty> for Json<'a> {
            fn from($value: $ty) -> Self {
                $json
            }
        })+
    };
}

from! {
    bool: flag => Json::Flag(flag),
    u32: number => Json::Number(number as usize),
    usize: number => Json::Number(number),
    &'a str: text => Json::Text(text.into()),
    String: text => Json::Text(text.into()),
}

impl<'a, T: Into<Json<'a>>> From<Option<T>> for Json<'a> {
    fn from(value: Option<T>) -> Self {
        value.map_or(Json::Null, Into::into)
    }
}
