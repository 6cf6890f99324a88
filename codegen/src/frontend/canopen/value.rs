//! Converts the text of a default value, limit or configured value to a [`Value`] of the item's type.

use super::number::{self, Number, Parsed, Quirk};
use crate::diagnostics::{codes, Code, Diagnostics};
use crate::ir::{CompactString, Type, Value};
use crate::number::hex;
use crate::source::Span;
use crate::text::brief;

/// Purpose of a value, which determines the diagnostics that apply.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Default value or configured value.
    Value,
    /// Minimum or maximum. Signed limits are often written as bit patterns.
    Limit,
}

/// Converts texts to values, and reports repairs.
pub struct Converter<'d> {
    /// List to which the converter adds its diagnostics.
    pub diagnostics: &'d mut Diagnostics,
    /// Further names of `$NODEID`.
    pub aliases: &'d [String],
}

impl Converter<'_> {
    /// Converts `text` at `span` to a value of type `ty`. Returns `None` for empty text.
    pub fn value(&mut self, text: &str, span: Span, ty: Type, role: Role) -> Option<Value> {
        if text.is_empty() {
            return None;
        }
        Some(match ty {
            Type::Integer(_) | Type::Unsigned(_) => self.integer(text, span, ty, role),
            Type::Boolean => self.boolean(text, span),
            Type::Real32 | Type::Real64 => self.real(text, span, ty),
            Type::VisibleString(_) | Type::UnicodeString(_) => Value::Text(self.unquoted(text, span).into()),
            Type::OctetString(_) => self.octets(text, span),
            Type::Domain => {
                self.report(&codes::DOMAIN_DEFAULT, span, "a DOMAIN cannot have a value or a limit", "kept as text");
                raw(text)
            }
            Type::TimeOfDay | Type::TimeDifference => self.time(text, span, ty),
            Type::Time(_) | Type::Opaque(_) | Type::Named(_) => raw(text),
        })
    }

    /// Returns the value of `text` if it is a plain number that fits the integer type `ty` and needs no diagnostic. The
    /// type must have at most 32 bits.
    #[inline]
    pub fn plain_integer(&self, text: &str, ty: Type) -> Option<Value> {
        let (Type::Integer(bits) | Type::Unsigned(bits)) = ty else { return None };
        let value = number::plain(text).filter(|_| self.aliases.is_empty())?;
        let (low, high) = match ty {
            _ if bits > 32 => return None,
            Type::Integer(_) => (-1i64 << (bits.max(1) - 1), (1i64 << (bits.max(1) - 1)) - 1),
            _ => (0, (1i64 << bits) - 1),
        };
        let fits = (low..=high).contains(&value)
            && (!number::is_plain_hex(text) || (text.len() - 2) * 4 <= usize::from(bits).next_multiple_of(4));
        fits.then(|| Value::Int(value.into()))
    }

    /// Reads a number or formula, and reports deviations from the grammar. Returns `None` and reports the text if it is
    /// neither.
    pub fn number(&mut self, text: &str, span: Span) -> Option<Value> {
        let number = number::parse(text, self.aliases);
        self.quirk(number, text, span);
        match number.parsed {
            Parsed::Int { value, .. } => Some(Value::Int(value)),
            Parsed::NodeId(offset) => Some(Value::NodeId(offset)),
            Parsed::UnknownFormula => {
                self.unknown_formula(text, span);
                None
            }
            Parsed::Text => {
                let message = format!("`{text}` is not a number");
                let label = "expected a decimal number, or a hexadecimal number with `0x`";
                self.report(&codes::ILLEGAL_NUMBER, span, message, label);
                None
            }
        }
    }

    /// Removes and reports one pair of quotation marks around `text`.
    pub fn unquoted<'t>(&mut self, text: &'t str, span: Span) -> &'t str {
        let inside = |text: &'t str| text.strip_prefix('"')?.strip_suffix('"');
        let Some(inner) = inside(text) else { return text };
        let found = codes::QUOTED_VALUE
            .at(span, "the text is in quotation marks")
            .label("one pair of quotation marks was removed");
        // A fix is offered only if it removes all quotation marks.
        self.diagnostics.push(if inside(inner).is_some() {
            found.help("remove the quotation marks")
        } else {
            found.fix(inner)
        });
        inner
    }

    fn integer(&mut self, text: &str, span: Span, ty: Type, role: Role) -> Value {
        let number = number::parse(text, self.aliases);
        self.quirk(number, text, span);
        match number.parsed {
            Parsed::Int { value, hex } => self.fit(value, hex, text, span, ty, role),
            Parsed::NodeId(offset) => self.fit_formula(offset, text, span, ty),
            Parsed::UnknownFormula => {
                self.unknown_formula(text, span);
                raw(text)
            }
            Parsed::Text => self.fraction(text, span, ty),
        }
    }

    /// Checks a number against the range of its type. For a signed type, a hexadecimal number with the sign bit set becomes a
    /// negative number. The conversion is reported unless the number is a limit. Reports any other number outside of the range.
    fn fit(&mut self, value: i128, hex: bool, text: &str, span: Span, ty: Type, role: Role) -> Value {
        let Some((low, high)) = ty.integer_range() else { return Value::Int(value) };
        if (low..=high).contains(&value) {
            self.digits(text, span, ty);
            return Value::Int(value);
        }
        let modulus = high - low + 1;
        if hex && ty.is_signed() && value < modulus {
            let negative = value - modulus;
            if role == Role::Value {
                let found = codes::TWOS_COMPLEMENT
                    .at(span, format!("{text} is out of range for {ty}, but is the bit pattern of {negative}"));
                self.diagnostics.push(found.label(format!("read as {negative}")).fix(negative.to_string()));
            }
            return Value::Int(negative);
        }
        let message = format!("{text} is out of range for {ty} ({low} to {high})");
        self.report(&codes::OUT_OF_TYPE, span, message, "kept unchanged");
        Value::Int(value)
    }

    /// Reports a number that has more hexadecimal digits than its type needs. Possible causes are a doubled digit or a
    /// type that is too short.
    fn digits(&mut self, text: &str, span: Span, ty: Type) {
        let digits = text.strip_prefix("0x").or_else(|| text.strip_prefix("0X"));
        let (Some(digits), Some(bits)) = (digits, ty.bits()) else { return };
        let needed = bits.div_ceil(4) as usize;
        // Many tools write all numbers with 8 digits. Numbers with 2, 4, 8 or 16 digits are therefore reported only if
        // the user explicitly enables this diagnostic.
        let is_usual = matches!(digits.len(), 2 | 4 | 8 | 16) && !self.diagnostics.asks_for(&codes::HEX_DIGITS);
        if digits.len() > needed && !is_usual && digits.bytes().all(|byte| byte.is_ascii_hexdigit()) {
            let message = format!("`{}` has {} hexadecimal digits, but {ty} needs {needed}", brief(text), digits.len());
            let found = codes::HEX_DIGITS.at(span, message).label("the number is used as written");
            self.diagnostics.push(found.help("check the digits and the data type against the manual"));
        }
    }

    /// Checks that the results of a `$NODEID` formula for the node-IDs 1 to 127 fit the type.
    fn fit_formula(&mut self, offset: i128, text: &str, span: Span, ty: Type) -> Value {
        if let Some((low, high)) = ty.integer_range() {
            if offset + 1 < low || offset + 127 > high {
                let message = format!("{text} is outside of the range of {ty} for some of the node-IDs 1 to 127");
                self.report(&codes::OUT_OF_TYPE, span, message, "kept unchanged");
            }
        }
        Value::NodeId(offset)
    }

    /// Reads a number with a zero fraction, such as `0.0`, for an integer type. Keeps any other text unchanged. Reports
    /// the text in both cases.
    fn fraction(&mut self, text: &str, span: Span, ty: Type) -> Value {
        if let Some((whole, fraction)) = text.split_once('.') {
            if !fraction.is_empty() && fraction.bytes().all(|byte| byte == b'0') {
                if let Some(value) = number::parse(whole, &[]).int() {
                    let found =
                        codes::REAL_FOR_INTEGER.at(span, format!("{text} is a real number, but the type is {ty}"));
                    self.diagnostics.push(found.label(format!("read as {value}")).fix(value.to_string()));
                    return Value::Int(value);
                }
            }
            if text.parse::<f64>().is_ok() {
                let message = format!("{text} is a real number, but the type is {ty}");
                self.report(&codes::REAL_FOR_INTEGER, span, message, "kept as text");
                return raw(text);
            }
        }
        self.illegal(text, span, ty)
    }

    fn boolean(&mut self, text: &str, span: Span) -> Value {
        if text.eq_ignore_ascii_case("true") {
            return Value::Bool(true);
        }
        if text.eq_ignore_ascii_case("false") {
            return Value::Bool(false);
        }
        let number = number::parse(text, self.aliases);
        self.quirk(number, text, span);
        match number.int() {
            Some(0) => Value::Bool(false),
            Some(1) => Value::Bool(true),
            Some(value) => {
                self.report(&codes::OUT_OF_TYPE, span, format!("{text} is not a BOOLEAN value"), "expected 0 or 1");
                Value::Int(value)
            }
            None => self.illegal(text, span, Type::Boolean),
        }
    }

    fn real(&mut self, text: &str, span: Span, ty: Type) -> Value {
        if let Some(digits) = text.strip_prefix("0x").or_else(|| text.strip_prefix("0X")) {
            return self.real_bits(digits, text, span, ty);
        }
        if let Some(value) = finite(text) {
            return Value::Real(value);
        }
        if let Some(value) = text.contains(',').then(|| finite(&text.replacen(',', ".", 1))).flatten() {
            let fix = text.replacen(',', ".", 1);
            let found = codes::DECIMAL_COMMA.at(span, format!("{text} has a decimal comma"));
            self.diagnostics.push(found.label(format!("read as {value}")).fix(fix));
            return Value::Real(value);
        }
        match number::parse(text, self.aliases).parsed {
            Parsed::UnknownFormula => {
                self.unknown_formula(text, span);
                raw(text)
            }
            // A node-ID formula defines an integer, so it is not a valid value of a real type.
            _ => self.not_finite(text, span, ty),
        }
    }

    /// Reads a hexadecimal number for a real type. The digits are a bit pattern if there are exactly as many digits as
    /// the type needs. Otherwise, the number is the value itself.
    fn real_bits(&mut self, digits: &str, text: &str, span: Span, ty: Type) -> Value {
        let bits = if ty == Type::Real32 { 32 } else { 64 };
        let Ok(pattern) = u64::from_str_radix(digits, 16) else { return self.not_finite(text, span, ty) };
        if digits.starts_with('+') {
            return self.not_finite(text, span, ty);
        }
        if digits.len() as u32 == bits / 4 {
            let value = if bits == 32 { f64::from(f32::from_bits(pattern as u32)) } else { f64::from_bits(pattern) };
            return if value.is_finite() { Value::Real(value) } else { self.not_finite(text, span, ty) };
        }
        let message = format!("{text} does not have the {} digits of a {ty} bit pattern", bits / 4);
        self.report(&codes::REAL_AS_HEX, span, message, format!("read as the number {pattern}"));
        Value::Real(pattern as f64)
    }

    fn octets(&mut self, text: &str, span: Span) -> Value {
        let digits = text.strip_prefix("0x").or_else(|| text.strip_prefix("0X")).unwrap_or(text);
        let digits = digits.chars().filter(|digit| !matches!(digit, ' ' | '\t'));
        let nibbles: Option<Vec<u8>> = digits.map(|digit| digit.to_digit(16).map(|digit| digit as u8)).collect();
        match nibbles {
            Some(nibbles) if !nibbles.is_empty() && nibbles.len() % 2 == 0 => {
                Value::Bytes(nibbles.chunks_exact(2).map(|pair| pair[0] << 4 | pair[1]).collect())
            }
            _ => {
                let message = format!("`{text}` does not consist of pairs of hexadecimal digits");
                self.report(&codes::BAD_OCTETS, span, message, "kept as text");
                raw(text)
            }
        }
    }

    /// Reads a time as a 48-bit number. The milliseconds are in bits 0 to 27, and the days are in bits 32 to 47.
    fn time(&mut self, text: &str, span: Span, ty: Type) -> Value {
        let number = number::parse(text, self.aliases);
        self.quirk(number, text, span);
        let Some(value) = number.int() else { return self.illegal(text, span, ty) };
        let (milliseconds, days) = (value & 0xFFFF_FFFF, value >> 32);
        match u16::try_from(days) {
            Ok(days) if milliseconds < 1 << 28 => Value::Time { milliseconds: milliseconds as u32, days },
            _ => {
                let message =
                    format!("{text} is not a {ty} value (bits 0 to 27 are milliseconds, bits 32 to 47 are days)");
                self.report(&codes::OUT_OF_TYPE, span, message, "kept as text");
                raw(text)
            }
        }
    }

    fn illegal(&mut self, text: &str, span: Span, ty: Type) -> Value {
        self.report(&codes::ILLEGAL_NUMBER, span, format!("`{text}` is not a value of the type {ty}"), "kept as text");
        raw(text)
    }

    fn not_finite(&mut self, text: &str, span: Span, ty: Type) -> Value {
        let message = format!("`{text}` is not a finite {ty} number");
        self.report(&codes::ILLEGAL_NUMBER, span, message, "kept as text");
        raw(text)
    }

    fn unknown_formula(&mut self, text: &str, span: Span) {
        let found = codes::UNKNOWN_FORMULA.at(span, format!("`{text}` is not a formula that CiA 306 defines"));
        let help = "write $NODEID or $NODEID+number, or declare the other name of the node-ID with `--node-id-alias`";
        self.diagnostics.push(found.label("kept as text").help(help));
    }

    /// Reports the deviation of a number from the grammar.
    pub fn quirk(&mut self, number: Number, text: &str, span: Span) {
        let Some(quirk) = number.quirk else { return };
        let (code, message): (&'static Code, String) = match quirk {
            Quirk::Octal => (&codes::OCTAL_NUMBER, format!("{text} is octal because of its leading zero")),
            Quirk::LeadingZero => (&codes::LEADING_ZERO, format!("{text} has a leading zero")),
            Quirk::HexSuffix => (&codes::HEX_SUFFIX, format!("{text} has the suffix `h` of a hexadecimal number")),
            Quirk::CSuffix => (&codes::TRAILING_TEXT, format!("{text} has the suffix of a C literal")),
            Quirk::ReversedNodeId => (&codes::REVERSED_NODEID, format!("`{text}` does not start with $NODEID")),
        };
        let fix = match number.parsed {
            Parsed::Int { value, hex: true } => hex(value),
            Parsed::Int { value, hex: false } => value.to_string(),
            Parsed::NodeId(offset @ ..0) => format!("$NODEID+{offset}"),
            Parsed::NodeId(offset) => format!("$NODEID+{}", hex(offset)),
            _ => return,
        };
        self.diagnostics.push(code.at(span, message).label(format!("read as {fix}")).fix(fix));
    }

    fn report(&mut self, code: &'static Code, span: Span, message: impl Into<String>, label: impl Into<String>) {
        self.diagnostics.push(code.at(span, message).label(label));
    }
}

fn raw(text: &str) -> Value {
    Value::Raw(CompactString::from(text))
}

/// Reads a finite decimal real number. Returns `None` for any other text, including the words `inf` and `nan`, which Rust accepts.
fn finite(text: &str) -> Option<f64> {
    let numeric = text.bytes().all(|byte| byte.is_ascii_digit() || matches!(byte, b'.' | b'-' | b'+' | b'e' | b'E'));
    let value = numeric.then(|| text.parse::<f64>().ok()).flatten().filter(|value| value.is_finite())?;
    // A nonzero number is rejected if its `f64` value is zero.
    let mantissa = text.split(['e', 'E']).next().unwrap_or(text);
    let is_zero = !mantissa.bytes().any(|byte| matches!(byte, b'1'..=b'9'));
    (value != 0.0 || is_zero).then_some(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn convert(text: &str, ty: Type, role: Role) -> (Option<Value>, Vec<&'static str>) {
        let mut diagnostics = Diagnostics::default();
        let value = Converter { diagnostics: &mut diagnostics, aliases: &[] }.value(text, Span::default(), ty, role);
        (value, diagnostics.list().iter().map(|d| d.code.id).collect())
    }

    fn value(text: &str, ty: Type) -> (Option<Value>, Vec<&'static str>) {
        convert(text, ty, Role::Value)
    }

    #[test]
    fn integers_fit_their_type_or_are_reported() {
        let i32 = Type::Integer(32);
        assert_eq!(value("0xFFFFFFFF", i32), (Some(Value::Int(-1)), vec!["EDS024"]));
        assert_eq!(convert("0x80000000", i32, Role::Limit), (Some(Value::Int(i32::MIN.into())), vec![]));
        assert_eq!(convert("65536", Type::Unsigned(16), Role::Limit), (Some(Value::Int(65536)), vec!["EDS025"]));
        assert_eq!(value("0.0", Type::Unsigned(32)), (Some(Value::Int(0)), vec!["EDS028"]));
        assert_eq!(value("2.5", i32), (Some(raw("2.5")), vec!["EDS028"]));
        assert_eq!(value("abc", i32), (Some(raw("abc")), vec!["EDS022"]));
        assert_eq!(value("", i32), (None, vec![]));
        assert_eq!(value("-8388608", Type::Integer(24)), (Some(Value::Int(-8_388_608)), vec![]));
    }

    #[test]
    fn reals_in_every_spelling() {
        for text in ["1.5", "0x3FC00000"] {
            assert_eq!(value(text, Type::Real32), (Some(Value::Real(1.5)), vec![]), "{text}");
        }
        assert_eq!(value("1,5", Type::Real32), (Some(Value::Real(1.5)), vec!["EDS029"]));
        assert_eq!(value("0x02", Type::Real32), (Some(Value::Real(2.0)), vec!["EDS030"]));
        assert_eq!(value("0x3FF8000000000000", Type::Real64), (Some(Value::Real(1.5)), vec![]));
        assert_eq!(value("-3.402823E+38", Type::Real32), (Some(Value::Real(-3.402823E+38)), vec![]));
        for text in ["nan", "inf", "0x7FC00000", "0x+1", "1e999", "1e-400", "$NODEID+1"] {
            assert_eq!(value(text, Type::Real32).1, ["EDS022"], "{text}");
        }
    }

    #[test]
    fn texts_octets_and_times() {
        let string = Type::VisibleString(None);
        assert_eq!(value("\"abc\"", string), (Some(Value::Text("abc".into())), vec!["EDS016"]));
        assert_eq!(value("\"", string), (Some(Value::Text("\"".into())), vec![]));
        for text in ["01a105", "01 a1 05", "0x01a105"] {
            assert_eq!(value(text, Type::OctetString(None)), (Some(Value::Bytes(vec![1, 0xa1, 5])), vec![]));
        }
        assert_eq!(value("0x123", Type::OctetString(None)), (Some(raw("0x123")), vec!["EDS037"]));
        assert_eq!(value("0", Type::TimeOfDay), (Some(Value::Time { milliseconds: 0, days: 0 }), vec![]));
        assert_eq!(
            value("0x000200000005", Type::TimeDifference),
            (Some(Value::Time { milliseconds: 5, days: 2 }), vec![])
        );
        assert_eq!(value("true", Type::Boolean), (Some(Value::Bool(true)), vec![]));
        assert_eq!(value("2", Type::Boolean), (Some(Value::Int(2)), vec!["EDS025"]));
        assert_eq!(value("@ABCD", Type::Domain), (Some(raw("@ABCD")), vec!["EDS031"]));
    }
}
