//! Lints that depend on the notation of a table: digits, printed objects next to register numbers, patterns of states and
//! commands.

use super::at::{At, Entries, Literal, TextOr};
use super::format::{MachineTable, NumberOrText, PatternTable, Row};
use super::notation;
use super::spaces::Space;
use super::tree::Reader;
use crate::diagnostics::{codes, Code};
use crate::ir::{Type, Value};
use crate::number::{hex, hex16};
use crate::source::Span;
use crate::text::brief;

/// Minimum number of rows whose object follows the rule of the space. If a chapter has this number of such rows, the
/// lint expects an object in each row of the chapter.
const PRINTED: usize = 3;

/// Checks the digits and the value of a number against its type.
pub(super) fn number(reader: &mut Reader<'_, '_>, given: &At<Literal>, value: &Value, ty: Type) {
    let span = reader.span(given);
    capital(reader, span);
    if let (Type::Integer(bits) | Type::Unsigned(bits), Some(digits)) = (ty, hexadecimal(reader.source.slice(span))) {
        let (count, needed) = (digits.len(), usize::from(bits).div_ceil(4));
        let problem = match count {
            _ if count > needed => Some(format!("has {count} hexadecimal digits")),
            2.. if count < needed && digits.starts_with('0') => {
                Some(format!("is padded to {count} hexadecimal digits"))
            }
            _ => None,
        };
        if let Some(problem) = problem {
            let message = format!("`0x{}` {problem}, but {ty} needs {needed}", brief(&digits));
            reader.report_with_help(&codes::HEX_DIGITS, span, message, DIGITS);
        }
    }
    range(reader, value, ty, span);
}

/// Reports a number that begins with `0X`. TOML has no numbers with this prefix, but a text may contain such a number.
fn capital(reader: &mut Reader<'_, '_>, span: Span) {
    let text = reader.source.slice(span).trim_matches(['"', '\'']);
    if text.starts_with("0X") {
        let message = format!("`{}` has the prefix `0X` instead of `0x`", brief(text));
        let found = codes::HEX_DIGITS.at(span, message).label("read as a hexadecimal number");
        reader.diagnostics.push(found.help("write `0x`, unless the X replaces a lost digit"));
    }
}

/// Help text for a wrong number of digits.
const DIGITS: &str =
    "compare the number and its type with the manual: a digit was doubled or lost, or the type is wrong";

/// Reports a key that has more hexadecimal digits than the integer type `base` needs. Types of less than 8 bits are not
/// checked.
pub(super) fn key(reader: &mut Reader<'_, '_>, given: &At<String>, base: Type) {
    let Some(bits) = base.bits().filter(|&bits| bits >= 8) else { return };
    let needed = bits.div_ceil(4) as usize;
    let longest = given.value.split("..").filter_map(hexadecimal).find(|digits| digits.len() > needed);
    if let Some(digits) = longest {
        let message =
            format!("`0x{}` has {} hexadecimal digits, but {base} needs {needed}", brief(&digits), digits.len());
        reader.report_with_help(&codes::HEX_DIGITS, reader.span(given), message, DIGITS);
    }
}

/// Reports a number that is outside of the range of its type.
pub(super) fn range(reader: &mut Reader<'_, '_>, value: &Value, ty: Type, span: Span) {
    let Some((low, high)) = ty.integer_range() else { return };
    let message = match value {
        Value::Int(number) if *number < low || *number > high => format!("{number} is outside of the range of {ty}"),
        Value::Real(number) => format!("{number} is outside of the range of {ty}"),
        _ => return,
    };
    let found = codes::OUT_OF_TYPE.at(span, message).label("kept unchanged");
    reader.diagnostics.push(match (ty, value) {
        (Type::Unsigned(bits), Value::Int(..0)) => found.help(format!("check whether the type is `i{bits}`")),
        (Type::Integer(bits @ 1..=64), Value::Int(number)) if (0..1i128 << bits).contains(number) => {
            found.help(format!("check whether the type is `u{bits}`"))
        }
        _ => found,
    });
}

/// Returns the digits of a hexadecimal number, which may be in quotation marks.
fn hexadecimal(text: &str) -> Option<String> {
    let text = text.trim_matches(['"', '\'']);
    let digits = text.strip_prefix("0x").or_else(|| text.strip_prefix("0X"))?;
    let digits: String = digits.chars().filter(|&c| c != '_').collect();
    (!digits.is_empty() && digits.chars().all(|c| c.is_ascii_hexdigit())).then_some(digits)
}

/// Reports an index that is decimal, has the prefix `0X`, or does not have four digits.
pub(super) fn index<T>(reader: &mut Reader<'_, '_>, given: &At<T>) {
    capital(reader, reader.span(given));
    let text = reader.source.slice(reader.span(given)).trim_matches(['"', '\'']);
    let first = text.split([':', '.']).next().unwrap_or_default();
    if let Some(number) = first.parse::<u16>().ok().filter(|number| *number > 0) {
        let message = format!("the index `{first}` has no prefix `0x` and is read as {}", hex16(number));
        let found = codes::HEX_DIGITS.at(reader.span(given), message);
        reader.diagnostics.push(found.help(format!("write {}, or 0x{first} if the manual omits `0x`", hex16(number))));
    }
    if let Some(message) = digits_of_index(reader, given) {
        let found = codes::HEX_DIGITS.at(reader.span(given), message);
        reader.diagnostics.push(found.help("compare the neighboring rows: a digit was doubled or lost"));
    }
}

/// Returns a message if a hexadecimal index, or the start or end of a range of indices, does not have four digits.
pub(super) fn digits_of_index<T>(reader: &Reader<'_, '_>, given: &At<T>) -> Option<String> {
    let text = reader.source.slice(reader.span(given)).trim_matches(['"', '\'']);
    let mut indices = text.split(':').next().unwrap_or_default().split("..");
    let digits = indices.find_map(|index| hexadecimal(index).filter(|digits| digits.len() != 4))?;
    Some(format!("the index `0x{}` has {} digits instead of 4", brief(&digits), digits.len()))
}

/// Maximum distance between the register numbers of neighboring rows in one block.
const BLOCK: u64 = 16;

/// Help text for an object that does not follow from its register number.
pub(super) const FORMULA: &str = "keep the number that the neighboring rows support, add a `doubt`, \
                                  and allow this code on the row";

/// Register number and object of a row that contains both, and the object according to the rule of the space.
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
            NumberOrText::Text(text) => notation::registers(text)?.0.into(),
        };
        let index = match &obj.value {
            NumberOrText::Number(index) => *index,
            NumberOrText::Text(text) => notation::objects(text)?.indices.0.into(),
        };
        let rule = u32::try_from(number).ok().and_then(|number| space?.object(number));
        Some(Printed { span: reader.span(obj), number, index, rule: rule.map(|(index, _)| index.into()) })
    }

    /// Returns whether both register numbers are in one block. In different blocks, the indices of objects may have different
    /// offsets from the register numbers.
    fn is_near(&self, other: &Printed) -> bool {
        self.number.abs_diff(other.number) <= BLOCK
    }

    fn offset(&self) -> i64 {
        self.index.wrapping_sub(self.number)
    }
}

/// Reports a printed object that does not follow from the neighboring rows, unless these rows follow the rule of the space.
pub(super) fn series(reader: &mut Reader<'_, '_>, rows: &[(At<String>, At<Row>)], space: Option<&Space>) {
    let printed: Vec<_> = rows.iter().filter_map(|(_, row)| Printed::new(reader, &row.value, space)).collect();
    for (at, row) in printed.iter().enumerate() {
        let offset = |at: Option<usize>| Some(printed.get(at?)?.offset());
        let (before, after) = (offset(at.checked_sub(1)), offset(Some(at + 1)));
        let neighbors = match (before, after) {
            (Some(_), Some(_)) => (before, after),
            (Some(_), None) => (before, offset(at.checked_sub(2))),
            _ => (after, offset(Some(at + 2))),
        };
        let (Some(expected), true) = (neighbors.0, neighbors.0 == neighbors.1) else { continue };
        // If the neighboring rows follow the rule of the space, another check already reported the object of this row.
        let by_rule = row.rule == Some(row.number.wrapping_add(expected));
        let is_member = [at.checked_sub(1), Some(at + 1)].into_iter().flatten().filter_map(|at| printed.get(at));
        let is_member = is_member.clone().count() > 0 && is_member.into_iter().all(|other| row.is_near(other));
        if row.offset() != expected && !by_rule && is_member {
            let (index, expected) = (hex16(row.index), hex16(row.number.wrapping_add(expected)));
            let message = format!("the row has object {index}, but the neighboring rows suggest {expected}");
            reader.report_with_help(&codes::REGISTER_FORMULA, row.span, message, FORMULA);
        }
    }
}

/// Reports rows without an object in a chapter in which at least [`PRINTED`] rows contain objects that follow the rule
/// of the space.
pub(super) fn unprinted(reader: &mut Reader<'_, '_>, rows: &[(At<String>, At<Row>)], space: Option<&Space>) {
    let printed = rows.iter().filter_map(|(_, row)| Printed::new(reader, &row.value, space));
    if printed.filter(|row| row.rule == Some(row.index)).count() < PRINTED {
        return;
    }
    for (_, row) in rows.iter().filter(|(_, row)| row.value.obj.is_none()) {
        let Some(reg) = &row.value.reg else { continue };
        let number = notation::registers(&reg.value.to_string());
        let Some((index, _)) = number.and_then(|(first, _)| space?.object(first)) else { continue };
        let message = format!(
            "the row has no object, but the rule in `[spaces]` gives {}, and other rows of the chapter have objects",
            hex16(index)
        );
        let found = codes::REGISTER_FORMULA.at(reader.span(reg), message);
        reader.diagnostics.push(found.help("use a space without this rule if the register is not an object"));
    }
}

/// Checks that no two states of a machine, and no two of its commands, match the same value. Also reports values with bits outside
/// of their mask.
pub(super) fn machine(reader: &mut Reader<'_, '_>, table: &MachineTable) {
    if let Some(TextOr::Table(states)) = table.states.as_ref().map(|states| &states.value) {
        patterns(reader, states, "states", &codes::STATES_OVERLAP);
    }
    patterns(reader, &table.commands, "commands", &codes::COMMANDS_OVERLAP);
}

fn patterns(reader: &mut Reader<'_, '_>, list: &Entries<PatternTable>, what: &str, code: &'static Code) {
    let complete = |(key, pattern): &'_ (At<String>, At<PatternTable>)| {
        Some((key.clone(), pattern.value.mask?, pattern.value.value?))
    };
    let list: Vec<(At<String>, u32, u32)> = list.iter().filter_map(complete).collect();
    for (at, (key, mask, value)) in list.iter().enumerate() {
        if value & !mask != 0 {
            let message = format!("the value {} has bits outside of the mask {}", hex(*value), hex(*mask));
            reader.report(&codes::PATTERN_OUTSIDE_MASK, reader.span(key), message);
            continue;
        }
        for (other_key, other_mask, other) in list.iter().take(at) {
            if (value ^ other) & mask & other_mask == 0 && other & !other_mask == 0 {
                let (both, first, second) = (hex(value | other), brief(&other_key.value), brief(&key.value));
                let message = format!("the value {both} matches both {what} `{first}` and `{second}`");
                let found = code.at(reader.span(key), message);
                reader
                    .diagnostics
                    .push(found.note_at(reader.span(other_key), format!("the other {}", what.trim_end_matches('s'))));
                // Each pattern is reported only once, because the number of pairs grows quadratically with the number of
                // patterns.
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
