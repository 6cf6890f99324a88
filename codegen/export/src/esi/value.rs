//! Writes default values and limits as numbers, texts or little-endian bytes. The default and limits of an item use the
//! same form (ETG.2000, ObjectInfoType).

use crate::note::NoteKind;
use crate::types::hex_digits;
use lexibus_codegen::facts::encoding;
use lexibus_codegen::ir::{Item, Type, Value};

/// Child elements of an Info element, and notes on values that the element cannot contain.
pub(super) type Written = (Vec<(&'static str, String)>, Vec<NoteKind>);

/// Returns the Info child elements of an item: limits and default value. `ty` is the basic type of the item.
pub(super) fn elements(item: &Item, ty: Type) -> Written {
    let (mut low, mut high) = (item.limits.low.as_ref(), item.limits.high.as_ref());
    let mut notes = Vec::new();
    if item.limits.are_swapped(ty) {
        (low, high) = (None, None);
        notes.push(NoteKind::SwappedLimits);
    }
    let values = [low, high, item.default.as_ref()];
    if let (Some(Value::Text(text)), true) = (&item.default, is_plain(item.default.as_ref())) {
        notes.extend(values.iter().take(2).flatten().map(|_| NoteKind::Value));
        return (vec![("DefaultString", text.to_string())], notes);
    }
    let as_numbers = values.iter().flatten().all(|value| number(value).is_some() || bytes(value, ty).is_none());
    let names =
        if as_numbers { ["MinValue", "MaxValue", "DefaultValue"] } else { ["MinData", "MaxData", "DefaultData"] };
    let mut elements = Vec::new();
    for (name, value) in names.into_iter().zip(values) {
        let Some(value) = value else { continue };
        match if as_numbers { number(value) } else { bytes(value, ty).map(|bytes| hex_digits(&bytes)) } {
            Some(text) => elements.push((name, text)),
            None => notes.push(NoteKind::Value),
        }
    }
    (elements, notes)
}

/// Returns whether a value is a text that can be written as DefaultString. Readers remove leading and trailing spaces
/// and interpret an empty element as no default value. Texts with control characters are written as bytes.
fn is_plain(value: Option<&Value>) -> bool {
    matches!(value, Some(Value::Text(text))
        if !text.is_empty() && text.trim() == text.as_str() && !text.contains(char::is_control))
}

fn number(value: &Value) -> Option<String> {
    value.as_int().map(|value| value.to_string())
}

/// Returns a value of type `ty` as little-endian bytes. Readers interpret an element without digits as no value, so an
/// empty text is written as a NUL.
fn bytes(value: &Value, ty: Type) -> Option<Vec<u8>> {
    match (value, ty) {
        (Value::Text(text), Type::UnicodeString(_)) if text.is_empty() => Some(vec![0, 0]),
        (Value::Text(text), _) if text.is_empty() => Some(vec![0]),
        _ => encoding::bytes(value, ty),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lexibus_codegen::ir::{Binding, Limits};

    fn of(ty: Type, low: Option<Value>, default: Option<Value>) -> (Vec<(&'static str, String)>, usize) {
        let mut item = Item::new(Binding::coe(0x2000, 0));
        item.limits = Limits { low, ..Limits::default() }.into();
        item.default = default;
        let (elements, notes) = elements(&item, ty);
        (elements, notes.len())
    }

    #[test]
    fn forms() {
        let one = |name, text: &str| (vec![(name, text.to_owned())], 0);
        let int = |value| Some(Value::Int(value));
        assert_eq!(of(Type::Integer(16), None, int(-2)), one("DefaultValue", "-2"));
        assert_eq!(of(Type::Real32, None, Some(Value::Real(1.5))), one("DefaultData", "0000C03F"));
        let text = |text: &str| Some(Value::Text(text.into()));
        assert_eq!(of(Type::VisibleString(None), None, text("a b")), one("DefaultString", "a b"));
        assert_eq!(of(Type::VisibleString(None), None, text("")), one("DefaultData", "00"));
        assert_eq!(of(Type::UnicodeString(None), None, text(" ä")), one("DefaultData", "2000E400"));
        let both = (vec![("MinData", "FFFF".to_owned()), ("DefaultData", "01".to_owned())], 0);
        assert_eq!(of(Type::Integer(16), int(-1), Some(Value::Bytes(vec![1]))), both);
        assert_eq!(of(Type::Unsigned(32), int(0), Some(Value::NodeId(0x180))), (vec![("MinValue", "0".to_owned())], 1));
    }
}
