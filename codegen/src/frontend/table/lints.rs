//! Lints that need a table as it is written: digits, printed objects beside printed numbers, patterns of states.

use super::at::{At, Entries, Literal, TextOr};
use super::format::{MachineTable, NumberOrText, PatternTable, Row};
use super::place;
use super::spaces::Space;
use super::tree::Reader;
use crate::diagnostics::{codes, Code, Diagnostic};
use crate::ir::{Type, Value};
use crate::source::Span;
use crate::text::brief;

/// So many objects beside numbers are how a chapter prints its rows.
const PRINTED: usize = 3;

/// Holds a number against its type: the digits that it is written in, and its value.
pub(super) fn number(reader: &mut Reader<'_, '_>, given: &At<Literal>, value: &Value, ty: Type) {
    let span = reader.span(given);
    capital(reader, span);
    if let (Type::Integer(bits) | Type::Unsigned(bits), Some(digits)) = (ty, hexadecimal(reader.source.slice(span))) {
        let (own, needed) = (digits.len(), usize::from(bits).div_ceil(4));
        let problem = match own {
            _ if own > needed => Some(format!("has {own} digits")),
            2.. if own < needed && digits.starts_with('0') => Some(format!("is filled up to {own} digits")),
            _ => None,
        };
        if let Some(problem) = problem {
            let message = format!("`0x{}` {problem}, and {ty} has {needed}", brief(&digits));
            let found = Diagnostic::new(&codes::HEX_DIGITS, span, message);
            reader.diagnostics.push(found.help(DIGITS));
        }
    }
    range(reader, value, ty, span);
}

/// Reports `0X`, which TOML has no numbers with: in quotation marks it is read all the same.
fn capital(reader: &mut Reader<'_, '_>, span: Span) {
    let text = reader.source.slice(span).trim_matches(['"', '\'']);
    if text.starts_with("0X") {
        let message = format!("`{}` begins with `0X`, and other numbers with `0x`", brief(text));
        let found = Diagnostic::new(&codes::HEX_DIGITS, span, message).label("read as a hexadecimal number");
        reader.diagnostics.push(found.help("write `0x`, unless the X stands for a digit that was lost"));
    }
}

/// What to do about digits.
const DIGITS: &str = "a digit was doubled or lost, or the type is another: compare both with the manual";

/// The key of a value, or of a range of values, has no more digits than its integer. Narrow fields are written in bytes.
pub(super) fn key(reader: &mut Reader<'_, '_>, given: &At<String>, base: Type) {
    let Some(bits) = base.bits().filter(|&bits| bits >= 8) else { return };
    let needed = bits.div_ceil(4) as usize;
    let longest = given.value.split("..").filter_map(hexadecimal).find(|digits| digits.len() > needed);
    if let Some(digits) = longest {
        let message = format!("`0x{}` has {} digits, and {base} has {needed}", brief(&digits), digits.len());
        let found = Diagnostic::new(&codes::HEX_DIGITS, reader.span(given), message);
        reader.diagnostics.push(found.help(DIGITS));
    }
}

/// Reports a number that its type can't have.
pub(super) fn range(reader: &mut Reader<'_, '_>, value: &Value, ty: Type, span: Span) {
    let Some((low, high)) = ty.integer_range() else { return };
    let message = match value {
        Value::Int(number) if *number < low || *number > high => format!("{ty} is never {number}"),
        Value::Real(number) => format!("{ty} is never {number}"),
        _ => return,
    };
    let found = Diagnostic::new(&codes::OUT_OF_TYPE, span, message).label("kept as it is");
    reader.diagnostics.push(match (ty, value) {
        (Type::Unsigned(bits), Value::Int(..0)) => found.help(format!("is the type `i{bits}`?")),
        (Type::Integer(bits @ 1..=64), Value::Int(number)) if (0..1i128 << bits).contains(number) => {
            found.help(format!("is the type `u{bits}`?"))
        }
        _ => found,
    });
}

/// The digits of a number that is written in hexadecimal, in quotation marks or not.
fn hexadecimal(text: &str) -> Option<String> {
    let text = text.trim_matches(['"', '\'']);
    let digits = text.strip_prefix("0x").or_else(|| text.strip_prefix("0X"))?;
    let digits: String = digits.chars().filter(|&c| c != '_').collect();
    (!digits.is_empty() && digits.chars().all(|c| c.is_ascii_hexdigit())).then_some(digits)
}

/// Reports an index that isn't written in four digits: one was lost.
pub(super) fn index<T>(reader: &mut Reader<'_, '_>, given: &At<T>) {
    capital(reader, reader.span(given));
    let text = reader.source.slice(reader.span(given)).trim_matches(['"', '\'']);
    let first = text.split([':', '.']).next().unwrap_or_default();
    if let Some(number) = first.parse::<u16>().ok().filter(|number| *number > 0) {
        let message = format!("the index `{first}` is decimal: 0x{number:04X}");
        let found = Diagnostic::new(&codes::HEX_DIGITS, reader.span(given), message);
        reader
            .diagnostics
            .push(found.help(format!("write 0x{number:04X}, or 0x{first} where the manual leaves `0x` out")));
    }
    if let Some(message) = digits_of_index(reader, given) {
        let found = Diagnostic::new(&codes::HEX_DIGITS, reader.span(given), message);
        reader.diagnostics.push(found.help("a digit was doubled or lost: look at the rows around it"));
    }
}

/// What is wrong with the digits of an index, or of the first and last of a range.
pub(super) fn digits_of_index<T>(reader: &Reader<'_, '_>, given: &At<T>) -> Option<String> {
    let text = reader.source.slice(reader.span(given)).trim_matches(['"', '\'']);
    let mut indices = text.split(':').next().unwrap_or_default().split("..");
    let digits = indices.find_map(|index| hexadecimal(index).filter(|digits| digits.len() != 4))?;
    Some(format!("the index `0x{}` has {} digits, and any has 4", brief(&digits), digits.len()))
}

/// How far apart the numbers of neighbours in one block are at most.
const BLOCK: u64 = 16;

/// What to do about an object that doesn't follow from its number.
pub(super) const FORMULA: &str =
    "one of the two is misprinted: keep the one that the rows around it support, with a `doubt`, \
                                  and allow this code on the row";

/// Number and object of a row that has both, and the object of its rule.
struct Printed {
    span: Span,
    number: i64,
    index: i64,
    rule: Option<i64>,
}

impl Printed {
    fn new(reader: &Reader<'_, '_>, row: &Row, space: Option<&Space>) -> Option<Self> {
        let (reg, obj) = (row.reg.as_ref()?, row.obj.as_ref()?);
        let number = match &reg.value {
            NumberOrText::Number(number) => *number,
            NumberOrText::Text(text) => place::registers(text)?.0.into(),
        };
        let index = match &obj.value {
            NumberOrText::Number(index) => *index,
            NumberOrText::Text(text) => place::objects(text)?.indices.0.into(),
        };
        let rule = u32::try_from(number).ok().and_then(|number| space?.object(number));
        Some(Printed { span: reader.span(obj), number, index, rule: rule.map(|(index, _)| index.into()) })
    }

    /// Whether the numbers are those of one block: rows of several blocks have objects of several.
    fn is_near(&self, other: &Printed) -> bool {
        self.number.abs_diff(other.number) <= BLOCK
    }

    fn offset(&self) -> i64 {
        self.index.wrapping_sub(self.number)
    }
}

/// Reports a printed object that doesn't follow from those of the rows around it, where these follow no rule either.
pub(super) fn series(reader: &mut Reader<'_, '_>, rows: &[(At<String>, At<Row>)], space: Option<&Space>) {
    let printed: Vec<_> = rows.iter().filter_map(|(_, row)| Printed::new(reader, &row.value, space)).collect();
    for (at, own) in printed.iter().enumerate() {
        let offset = |at: Option<usize>| Some(printed.get(at?)?.offset());
        let (before, after) = (offset(at.checked_sub(1)), offset(Some(at + 1)));
        let neighbours = match (before, after) {
            (Some(_), Some(_)) => (before, after),
            (Some(_), None) => (before, offset(at.checked_sub(2))),
            _ => (after, offset(Some(at + 2))),
        };
        let (Some(expected), true) = (neighbours.0, neighbours.0 == neighbours.1) else { continue };
        // Where the neighbours follow the rule, breaking it was reported already.
        let by_rule = own.rule == Some(own.number.wrapping_add(expected));
        let is_member = [at.checked_sub(1), Some(at + 1)].into_iter().flatten().filter_map(|at| printed.get(at));
        let is_member = is_member.clone().count() > 0 && is_member.into_iter().all(|other| own.is_near(other));
        if own.offset() != expected && !by_rule && is_member {
            let message = format!(
                "the row says object 0x{:04X}, and by the rows around it, it would be 0x{:04X}",
                own.index,
                own.number.wrapping_add(expected)
            );
            let found = Diagnostic::new(&codes::REGISTER_FORMULA, own.span, message);
            reader.diagnostics.push(found.help(FORMULA));
        }
    }
}

/// Reports rows without an object, where others of their chapter have the one that the rule gives: the manual prints none.
pub(super) fn unprinted(reader: &mut Reader<'_, '_>, rows: &[(At<String>, At<Row>)], space: Option<&Space>) {
    let printed = rows.iter().filter_map(|(_, row)| Printed::new(reader, &row.value, space));
    if printed.filter(|own| own.rule == Some(own.index)).count() < PRINTED {
        return;
    }
    for (_, row) in rows.iter().filter(|(_, row)| row.value.obj.is_none()) {
        let Some(reg) = &row.value.reg else { continue };
        let number = match &reg.value {
            NumberOrText::Number(number) => u32::try_from(*number).ok(),
            NumberOrText::Text(text) => place::registers(text).map(|(first, _)| first),
        };
        let Some((index, _)) = number.and_then(|number| space?.object(number)) else { continue };
        let message =
            format!("the row says no object, as others here do, and the rule of its space gives 0x{index:04X}");
        let found = Diagnostic::new(&codes::REGISTER_FORMULA, reader.span(reg), message);
        reader.diagnostics.push(found.help("a space without that rule keeps the register on its own bus"));
    }
}

/// Holds the states of a machine against each other, and so its commands.
pub(super) fn machine(reader: &mut Reader<'_, '_>, table: &MachineTable) {
    if let Some(TextOr::Table(states)) = table.states.as_ref().map(|own| &own.value) {
        patterns(reader, states, "states", &codes::STATES_OVERLAP);
    }
    patterns(reader, &table.commands, "commands", &codes::COMMANDS_OVERLAP);
}

fn patterns(reader: &mut Reader<'_, '_>, list: &Entries<PatternTable>, what: &str, code: &'static Code) {
    let complete =
        |(key, own): &'_ (At<String>, At<PatternTable>)| Some((key.clone(), own.value.mask?, own.value.value?));
    let list: Vec<(At<String>, u32, u32)> = list.iter().filter_map(complete).collect();
    for (at, (key, mask, value)) in list.iter().enumerate() {
        if value & !mask != 0 {
            let message = format!("nothing & {mask:#X} is {value:#X}");
            reader.report(&codes::PATTERN_OUTSIDE_MASK, reader.span(key), message);
            continue;
        }
        for (other_key, other_mask, other) in list.iter().take(at) {
            if (value ^ other) & mask & other_mask == 0 && other & !other_mask == 0 {
                let message = format!(
                    "{:#X} is both of the {what} `{}` and `{}`",
                    value | other,
                    brief(&other_key.value),
                    brief(&key.value)
                );
                let found = Diagnostic::new(code, reader.span(key), message);
                reader.diagnostics.push(found.note_at(reader.span(other_key), "the other one"));
                // One says that it is wrong. With all of them there would be as many as pairs.
                break;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::hexadecimal;

    #[test]
    fn digits_of_hexadecimal_numbers() {
        assert_eq!(hexadecimal("0x007F_FFFF").as_deref(), Some("007FFFFF"));
        assert_eq!(hexadecimal("\"0X20a\"").as_deref(), Some("20a"));
        for text in ["12", "\"0x80+$NODEID\"", "[0x1, 0x2]", "0x", "-0x10"] {
            assert_eq!(hexadecimal(text), None, "{text}");
        }
    }
}
