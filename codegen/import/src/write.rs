//! Writes the register table as TOML. Each row is written on one line, and the entries of the rows are aligned.

use std::collections::HashSet;
use std::fmt::Write as _;

use lexibus_codegen::frontend::table::is_unit;

use super::layout::{Chapter, Listing, Space};
use super::rows::{Row, RowAddress};

/// Maximum width in characters to which keys are padded.
const MAX_KEY: usize = 36;

/// Returns a TOML string. If the text starts with `$` and a lower-case letter, adds a space before the `$`, because
/// such a text would refer to an option.
pub(super) fn quoted(text: &str) -> String {
    let mut out = String::with_capacity(text.len() + 2);
    out.push('"');
    let is_option = text.strip_prefix('$').is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_lowercase()));
    if is_option {
        out.push(' ');
    }
    for letter in text.chars() {
        match letter {
            '"' => out.push_str("\\\""),
            '\\' => out.push_str("\\\\"),
            letter if letter.is_control() => {
                let _ = write!(out, "\\u{:04X}", u32::from(letter));
            }
            letter => out.push(letter),
        }
    }
    out.push('"');
    out
}

/// Returns a TOML key. Uses quotation marks only if they are necessary.
fn key(text: &str) -> String {
    let is_bare = |letter: char| letter.is_ascii_alphanumeric() || matches!(letter, '_' | '-');
    if !text.is_empty() && text.chars().all(is_bare) {
        text.to_owned()
    } else {
        quoted(text)
    }
}

/// Formats an integer in decimal digits, or in hexadecimal digits if `is_hex` is set and the integer is not negative.
pub(super) fn digits(value: i128, is_hex: bool) -> String {
    match value {
        0.. if is_hex => format!("0x{value:X}"),
        _ => value.to_string(),
    }
}

/// Formats an integer for TOML. Integers outside of the range of `i64` become strings.
pub(super) fn int(value: i128, is_hex: bool) -> String {
    let text = digits(value, is_hex);
    if i64::try_from(value).is_ok() {
        text
    } else {
        quoted(&text)
    }
}

/// Formats a floating-point number for TOML.
pub(super) fn real(value: f64) -> String {
    if value.fract() == 0.0 && value.abs() < 1e9 {
        format!("{value:.0}")
    } else {
        format!("{value:?}")
    }
}

/// Formats a text as a comment line.
fn comment(text: &str) -> String {
    let text: String = text.chars().map(|letter| if letter.is_control() { ' ' } else { letter }).collect();
    format!("# {text}\n")
}

/// Returns the text of the complete table.
pub(super) fn table(list: &Listing, name: &str, source: &str) -> String {
    let mut out =
        comment(&format!("Register table generated from {source} by `lexibus import`. Check it against the manual."));
    out += "lexibus = 1\n\n[device]\n";
    let _ = writeln!(out, "name = {}", quoted(name));
    let mut addresses = list.chapters.iter().flat_map(|chapter| &chapter.rows).map(|row| row.address);
    let is_object =
        |address| matches!(address, Ok(RowAddress::Object { .. } | RowAddress::Register { object: Some(_), .. }));
    // The list does not state which bus the objects belong to, so the user must add the bus.
    if !list.spaces.is_empty() && !addresses.any(is_object) {
        out += "buses = [\"modbus\"]\n";
    }
    if list.no_access {
        out += "\n[defaults]\naccess = \"ro\"    # the list does not state access rights\n";
    }
    list.spaces.iter().for_each(|item| space(&mut out, item));
    list.chapters.iter().for_each(|item| chapter(&mut out, item, list));
    definitions(&mut out, list);
    units(&mut out, list);
    out
}

fn space(out: &mut String, space: &Space) {
    let _ = write!(out, "\n[spaces.{0}]\nmodbus = {{ table = \"{0}\", first = {1}", space.table.name(), space.first);
    if space.low_first {
        *out += ", order = \"low_first\"";
    }
    if space.swap {
        *out += ", swap = true";
    }
    *out += " }";
    *out += match (space.is_first_known, space.first) {
        (false, _) => "    # write `first = 1` if the manual counts registers from 1\n",
        (true, 2..) => "    # this printed address is wire address 0\n",
        (true, _) => "\n",
    };
}

fn chapter(out: &mut String, chapter: &Chapter, list: &Listing) {
    *out += "\n[[chapters]]\n";
    if !chapter.title.is_empty() {
        let _ = writeln!(out, "title = {}", quoted(&chapter.title));
    }
    if let Some(table) = chapter.table {
        let _ = writeln!(out, "space = \"{}\"", table.name());
    }
    let rows = || chapter.rows.iter().filter(|row| row.address.is_ok());
    if rows().next().is_some() {
        *out += "\n[chapters.registers]\n";
    }
    let longest = rows().map(|row| key(&row.name).chars().count()).max().unwrap_or(0).min(MAX_KEY);
    let columns = rows().map(|row| head(row).map(|text| text.chars().count()));
    let widths = columns.fold([0; 3], |widest, lengths| std::array::from_fn(|at| widest[at].max(lengths[at])));
    for row in &chapter.rows {
        match row.address {
            Ok(_) => line(out, row, longest, widths, list),
            Err(reason) => *out += &comment(&format!("{reason}: {}", row.text)),
        }
    }
}

/// Returns the aligned first entries of a row: address, type and access rights.
fn head(row: &Row) -> [String; 3] {
    let address = match row.address {
        Ok(RowAddress::Register { printed, object, .. }) => {
            let obj = object.map_or(String::new(), |(index, sub)| match sub {
                Some(sub) => format!(", obj = \"0x{index:04X}:{sub}\""),
                None => format!(", obj = 0x{index:04X}"),
            });
            let number = |value: u32| if printed.is_hex { format!("0x{value:04X}") } else { value.to_string() };
            match printed.last {
                Some(last) => format!("reg = \"{}-{}\"{obj}", number(printed.first), number(last)),
                None => format!("reg = {}{obj}", number(printed.first)),
            }
        }
        Ok(RowAddress::Object { index, sub }) => format!("obj = \"0x{index:04X}:{}\"", sub.unwrap_or(0)),
        Ok(RowAddress::Parameter(number)) => format!("param = {number}"),
        Err(_) => String::new(),
    };
    let access = row.access.map_or(String::new(), |access| format!("access = \"{access}\""));
    [address, format!("type = \"{}\"", row.ty.text()), access]
}

fn line(out: &mut String, row: &Row, longest: usize, widths: [usize; 3], list: &Listing) {
    let name = key(&row.name);
    let _ = write!(out, "{name:longest$} = {{ ");
    let rest = rest(row, list);
    let head = head(row);
    let last = if rest.is_empty() { head.iter().rposition(|entry| !entry.is_empty()).unwrap_or(0) } else { head.len() };
    for (at, (entry, width)) in head.iter().zip(widths).enumerate() {
        let comma = if at < last && !entry.is_empty() { "," } else { "" };
        let text = format!("{entry}{comma}");
        // The last entry of a line needs no padding.
        if at < last && width > 0 {
            let _ = write!(out, "{text:0$} ", width + 1);
        } else if at == last {
            let _ = write!(out, "{text} ");
        }
    }
    let _ = writeln!(out, "{}}}", if rest.is_empty() { String::new() } else { rest.join(", ") + " " });
}

/// Returns the entries of a row that follow the address, type and access rights.
fn rest(row: &Row, list: &Listing) -> Vec<String> {
    let mut rest = Vec::new();
    let table = match row.address {
        Ok(RowAddress::Register { table, .. }) => table,
        _ => None,
    };
    let space = list.spaces.iter().find(|space| Some(space.table) == table);
    // Only registers can have a word order.
    let is_register = matches!(row.address, Ok(RowAddress::Register { .. }));
    let of_space = space.is_some_and(|space| space.low_first);
    let low_first = row.order.low_first.filter(|&low_first| is_register && low_first != of_space);
    rest.extend(low_first.map(|low| format!("order = \"{}\"", if low { "low_first" } else { "high_first" })));
    let swap = row.order.swap.filter(|&swap| is_register && swap != space.is_some_and(|space| space.swap));
    rest.extend(swap.map(|swap| format!("swap = {swap}")));
    rest.extend(row.count.map(|count| format!("count = {count}")));
    if let Some(scale) = &row.scale {
        let kind = if scale.is_exponent { "exponent" } else { "by" };
        rest.push(format!("scale = {{ {kind} = {} }}", quoted(&scale.name)));
    }
    if let Some(definition) = row.meaning.and_then(|at| list.definitions.get(at)) {
        rest.push(format!("{} = {}", if definition.is_bits { "bits" } else { "enum" }, quoted(&definition.name)));
    }
    rest.extend(row.facts.iter().map(|(key, value)| format!("{key} = {value}")));
    rest
}

fn definitions(out: &mut String, list: &Listing) {
    let rows = list.chapters.iter().flat_map(|chapter| &chapter.rows).filter(|row| row.address.is_ok());
    let used: HashSet<usize> = rows.filter_map(|row| row.meaning).collect();
    for (_, definition) in list.definitions.iter().enumerate().filter(|(at, _)| used.contains(at)) {
        let (kind, inner) = if definition.is_bits { ("bits", "at") } else { ("enums", "values") };
        let _ = writeln!(out, "\n[{kind}.{}.{inner}]", key(&definition.name));
        for (key, value) in &definition.entries {
            let _ = writeln!(out, "{key} = {value}");
        }
    }
}

/// Writes definitions of the unknown units, which the user must complete.
fn units(out: &mut String, list: &Listing) {
    let rows = list.chapters.iter().flat_map(|chapter| &chapter.rows).filter(|row| row.address.is_ok());
    let units = rows.flat_map(|row| &row.facts).filter(|(key, _)| *key == "unit").map(|(_, unit)| unit.as_str());
    let unknown: std::collections::BTreeSet<&str> = units.filter(|unit| !is_unit(unit.trim_matches('"'))).collect();
    if !unknown.is_empty() {
        *out += "\n[units]\n";
    }
    for unit in unknown {
        let _ = writeln!(out, "{unit} = {{ symbol = {unit} }}");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_and_numbers_of_toml() {
        assert_eq!(quoted("a \"b\" \\ \u{7}"), "\"a \\\"b\\\" \\\\ \\u0007\"");
        assert_eq!(quoted("$name"), "\" $name\"");
        assert_eq!((key("speed_1"), key("speed 1"), key("")), ("speed_1".into(), "\"speed 1\"".into(), "\"\"".into()));
        assert_eq!(
            (int(16, true), int(-5, true), int(i128::from(u64::MAX), false)),
            ("0x10".into(), "-5".into(), "\"18446744073709551615\"".into())
        );
        assert_eq!((real(0.1), real(10.0), real(1e-7)), ("0.1".into(), "10".into(), "1e-7".into()));
    }
}
