//! Formats values as the text of EDS entries. Reading a written text gives the same value again unless a note says that the value was
//! changed.

use super::note::NoteKind;
use super::writer::quoted;
use super::Reals;
use crate::types::hex_digits;
use lexibus_codegen::ir::{Type, Value};

/// The role of a value in an entry.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    /// The default value or the configured value of an item.
    Value,
    /// The minimum of an item.
    Low,
    /// The maximum of an item.
    High,
}

/// The text of a value, and a note if the value was changed or omitted. The text is `None` if the type cannot represent the
/// value.
type Written = (Option<String>, Option<NoteKind>);

/// The notation of numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Form {
    /// True if unsigned integers are written in hexadecimal.
    pub hex: bool,
    pub reals: Reals,
}

/// Formats `value` as the text of an entry of type `ty`.
pub(super) fn text(value: &Value, ty: Type, role: Role, form: Form) -> Written {
    match ty {
        Type::Boolean | Type::Integer(_) | Type::Unsigned(_) => integer(value, ty, role, form.hex),
        Type::Real32 | Type::Real64 if form.reals == Reals::Pattern => pattern(value, ty),
        Type::Real32 | Type::Real64 => real(value),
        Type::VisibleString(_) | Type::UnicodeString(_) => string(value),
        Type::OctetString(_) => octets(value),
        Type::TimeOfDay | Type::TimeDifference => time(value),
        Type::Domain | Type::Time(_) | Type::Opaque(_) | Type::Named(_) => match value {
            Value::Raw(text) | Value::Text(text) => written(text.to_string()),
            _ => left_out(),
        },
    }
}

fn written(text: String) -> Written {
    (Some(text), None)
}

fn left_out() -> Written {
    (None, Some(NoteKind::Value))
}

fn integer(value: &Value, ty: Type, role: Role, hex: bool) -> Written {
    let number = |value: i128| match hex && value >= 0 && !ty.is_signed() {
        true => format!("{value:#X}"),
        false => value.to_string(),
    };
    match value {
        Value::Int(value) => written(number(*value)),
        Value::Bool(value) => written(number(i128::from(*value))),
        Value::NodeId(offset @ ..0) => (Some(format!("$NODEID+{offset}")), Some(NoteKind::NegativeFormula)),
        Value::NodeId(offset) => written(format!("$NODEID+0x{offset:X}")),
        Value::Raw(text) => written(without_comment(text)),
        Value::Real(value) if value.is_finite() && value.abs() < 1e30 => {
            let whole = match role {
                Role::Value if value.fract() != 0.0 => return left_out(),
                Role::Value => value.trunc(),
                Role::Low => value.ceil(),
                Role::High => value.floor(),
            };
            (Some(number(whole as i128)), (whole != *value).then_some(NoteKind::RoundedLimit))
        }
        _ => left_out(),
    }
}

fn real(value: &Value) -> Written {
    match value {
        Value::Real(value) if value.is_finite() => {
            let text = format!("{value:?}");
            written(text.strip_suffix(".0").unwrap_or(&text).to_owned())
        }
        Value::Int(_) | Value::Bool(_) => integer(value, Type::Integer(64), Role::Value, false),
        Value::Raw(text) => written(without_comment(text)),
        _ => left_out(),
    }
}

/// Returns the IEEE 754 bit pattern of a value in hexadecimal: 8 digits for a REAL32, 16 digits for a REAL64. Values
/// that are not finite numbers are formatted as in decimal notation, if possible.
fn pattern(value: &Value, ty: Type) -> Written {
    match (value.as_real().filter(|value| value.is_finite()), ty) {
        (Some(value), Type::Real32) => written(format!("0x{:08X}", (value as f32).to_bits())),
        (Some(value), _) => written(format!("0x{:016X}", value.to_bits())),
        (None, _) => real(value),
    }
}

fn string(value: &Value) -> Written {
    match value {
        // Quotation marks distinguish an empty text from a missing value.
        Value::Text(text) if text.is_empty() => written("\"\"".into()),
        Value::Text(text) | Value::Raw(text) => written(quoted(text).into_owned()),
        Value::Int(value) => written(value.to_string()),
        _ => left_out(),
    }
}

fn octets(value: &Value) -> Written {
    match value {
        Value::Bytes(bytes) if !bytes.is_empty() => written(hex_digits(bytes)),
        Value::Raw(text) => written(without_comment(text)),
        _ => left_out(),
    }
}

fn time(value: &Value) -> Written {
    match value {
        Value::Time { milliseconds, days } => {
            written(format!("0x{:X}", u64::from(*days) << 32 | u64::from(*milliseconds)))
        }
        Value::Int(value) => written(value.to_string()),
        Value::Raw(text) => written(without_comment(text)),
        _ => left_out(),
    }
}

/// Quotes a text in which `;` or `#` occurs before the first quotation mark, because these characters would begin a
/// comment. Treats other texts like [`quoted`].
fn without_comment(text: &str) -> String {
    let has_comment = text.find([';', '#', '"']).is_some_and(|at| !text[at..].starts_with('"'));
    if has_comment {
        return format!("\"{text}\"");
    }
    quoted(text).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(value: Value, ty: Type) -> Option<String> {
        text(&value, ty, Role::Value, Form::default()).0
    }

    #[test]
    fn numbers_and_formulas() {
        let u32 = Type::Unsigned(32);
        let hex = Form { hex: true, ..Form::default() };
        assert_eq!(text(&Value::Int(0x1A0), u32, Role::Value, hex), written("0x1A0".into()));
        assert_eq!(text(&Value::Int(-1), Type::Integer(32), Role::Value, hex), written("-1".into()));
        assert_eq!(of(Value::Int(70_000), Type::Unsigned(16)).as_deref(), Some("70000"));
        assert_eq!(of(Value::NodeId(0x180), u32).as_deref(), Some("$NODEID+0x180"));
        assert_eq!(of(Value::NodeId(0), u32).as_deref(), Some("$NODEID+0x0"), "some readers require a number");
        assert_eq!(text(&Value::NodeId(-2), u32, Role::Value, hex).1, Some(NoteKind::NegativeFormula));
        assert_eq!(of(Value::Bool(true), Type::Boolean).as_deref(), Some("1"));
        for (role, expected) in [(Role::Low, Some("3")), (Role::High, Some("2")), (Role::Value, None)] {
            assert_eq!(text(&Value::Real(2.5), u32, role, Form::default()).0.as_deref(), expected);
        }
        assert_eq!(of(Value::Raw("a;b".into()), u32).as_deref(), Some("\"a;b\""));
        assert_eq!(of(Value::Text("x".into()), u32), None);
    }

    #[test]
    fn reals_have_the_digits_that_they_need() {
        for (value, ty, expected) in [
            (0.1, Type::Real32, "0.1"),
            (f64::from(0.1f32), Type::Real32, "0.10000000149011612"),
            (1.0, Type::Real64, "1"),
            (-3.402823E+38, Type::Real32, "-3.402823e38"),
            (1e300, Type::Real64, "1e300"),
        ] {
            assert_eq!(of(Value::Real(value), ty).as_deref(), Some(expected));
        }
    }

    #[test]
    fn reals_as_patterns() {
        let form = Form { reals: Reals::Pattern, ..Form::default() };
        for (value, ty, expected) in [
            (Value::Real(1.0), Type::Real32, "0x3F800000"),
            (Value::Int(0), Type::Real32, "0x00000000"),
            (Value::Real(-0.1), Type::Real64, "0xBFB999999999999A"),
        ] {
            assert_eq!(text(&value, ty, Role::Value, form).0.as_deref(), Some(expected));
        }
    }

    #[test]
    fn texts_octets_and_times() {
        let string = Type::VisibleString(None);
        for (value, expected) in [("a b", "a b"), ("", "\"\""), (" a", "\" a\""), ("\"a\"", "\"\"a\"\""), ("\"", "\"")]
        {
            assert_eq!(of(Value::Text(value.into()), string).as_deref(), Some(expected));
        }
        assert_eq!(of(Value::Bytes(vec![1, 0xA1]), Type::OctetString(None)).as_deref(), Some("01A1"));
        let time = Value::Time { milliseconds: 5, days: 2 };
        assert_eq!(of(time, Type::TimeOfDay).as_deref(), Some("0x200000005"));
        assert_eq!(of(Value::Bytes(vec![1]), Type::Domain), None);
        assert_eq!(of(Value::Raw("@AB;C".into()), Type::Domain).as_deref(), Some("@AB;C"));
    }
}
