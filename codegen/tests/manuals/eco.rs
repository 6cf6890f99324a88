//! Compares the register table of the Eco drive with the text of its manual. Each printed row must be in the register table
//! once, cite its line, and have the properties in the printed cells. Each deliberate difference must have a `doubt` entry.

use crate::eco_support;

use std::collections::BTreeSet;

use eco_support::*;
use lexibus_codegen::ir::{Access, Binding, Item, Storage, Type, Value};

#[test]
fn the_table_has_no_findings() {
    let compilation = table();
    let found: Vec<String> = compilation.diagnostics.list().iter().map(|found| compilation.one_line(found)).collect();
    assert_eq!(found, Vec::<String>::new());
}

/// A printed row for a register or a range of registers.
struct Printed {
    line: usize,
    /// First and last register number of the row.
    numbers: (u16, u16),
    is_saved: bool,
    /// Printed limits as bit patterns, without a sign.
    limits: Vec<u64>,
    /// First and last address of the row.
    addresses: (u16, u16),
}

/// Returns the rows of the manual's register table. A row consists of a label and all cells up to the address.
fn registers(manual: &[String]) -> Vec<Printed> {
    let mut rows: Vec<(usize, String)> = Vec::new();
    let mut open = false;
    for (line, text) in lines(manual, 37, 475) {
        let is_label = text.starts_with('R') && text[1..].starts_with(|c: char| c.is_ascii_digit());
        if is_label && !(open && text.len() <= 5) {
            rows.push((line, text.to_owned()));
            open = true;
        } else if open {
            let last = rows.last_mut().expect("a row");
            last.1 += " ";
            last.1 += text;
        }
        open &= !rows.last().is_some_and(|(_, text)| is_whole(text));
    }
    rows.into_iter().map(|(line, text)| register(line, &text)).collect()
}

/// Returns whether the text of a row is complete. A complete row contains the word `si`, `sì` or `no`, and an
/// address, or two addresses if the label is a range.
fn is_whole(text: &str) -> bool {
    let range = text.get(3..8).is_some_and(|label| label.contains('-'));
    let addresses = || hex_numbers(text, 4).into_iter().filter(|&entry| entry > 0x8000 || text.starts_with("R00"));
    let enough = addresses().filter(|address| address & 0x8000 != 0).count() >= if range { 2 } else { 1 };
    enough && (text.contains(" si ") || text.contains(" sì ") || text.contains(" no "))
}

fn register(line: usize, text: &str) -> Printed {
    let words: Vec<&str> = text.split_whitespace().collect();
    let save = words.iter().rposition(|word| ["si", "sì", "no"].contains(word)).expect("a save flag");
    let label = text.split(|c: char| c.is_alphabetic() && c != 'R').next().expect("a label");
    let numbers: Vec<u16> = label
        .split(|c: char| !c.is_ascii_digit())
        .filter_map(|digits| digits.parse().ok())
        .take(if label.contains('-') { 2 } else { 1 })
        .collect();
    let cells = words[save + 1..].join(" ").replace(['X', '–'], "-").replace("0-7", "0 -7");
    let mut values: Vec<u64> = cells
        .split(['-', ' '])
        .map(|cell| cell.trim_start_matches("0x").trim_start_matches('x'))
        .filter(|cell| !cell.is_empty())
        .map(|cell| u64::from_str_radix(cell, 16).expect("a number"))
        .collect();
    let addresses = values.split_off(values.len() - numbers.len());
    let whole = |list: &[u64]| (list[0] as u16, list[list.len() - 1] as u16);
    Printed {
        line,
        numbers: (numbers[0], numbers[numbers.len() - 1]),
        is_saved: words[save] != "no",
        limits: values,
        addresses: whole(&addresses),
    }
}

/// Returns the printed limits of a value with `bits` bits. The lower limit is negative if it would otherwise exceed the upper
/// limit.
fn signed(limits: &[u64], bits: u32) -> (i128, i128) {
    // One printed limit has nine hexadecimal digits, which is one too many.
    let limit = |value: u64| i128::from(if value > 0xFFFF_FFFF { value >> 4 } else { value });
    let (low, high) = (limit(limits[0]), limit(limits[1]));
    (if low > high { low - (1 << bits) } else { low }, high)
}

fn limits(item: &Item) -> Option<(i128, i128)> {
    item.limits.low.as_ref().and_then(Value::as_int).zip(item.limits.high.as_ref().and_then(Value::as_int))
}

fn is_saved(item: &Item) -> bool {
    item.behavior.as_ref().is_some_and(|behavior| matches!(behavior.storage, Storage::OnCommand(_)))
}

#[test]
fn every_register_is_there_at_its_line() {
    let Some(manual) = manual() else { return };
    let compilation = table();
    let device = device(&compilation);
    let printed = registers(&manual);
    assert_eq!(printed.len(), 69, "rows of the manual");
    let mut wrong = Vec::new();
    let mut count = 0;
    for row in &printed {
        assert_eq!(row.numbers.1 - row.numbers.0, row.addresses.1 - row.addresses.0, "line {}", row.line);
        for number in row.numbers.0..=row.numbers.1 {
            count += 1;
            let wanted = row.addresses.0 + (number - row.numbers.0);
            assert_eq!(wanted, 0x8000 + number, "line {}", row.line);
            let Some(item) = items(device).find(|item| address(item) == Some(wanted)) else {
                wrong.push(format!("line {}: no R{number}", row.line));
                continue;
            };
            let bits = base(device, item.ty).bits().expect("a length");
            let facts = [
                ("line", item_cites(item, row.line)),
                ("saved", is_saved(item) == row.is_saved),
                ("limits", limits(item) == Some(signed(&row.limits, bits)) || !item.doubts.is_empty()),
            ];
            let missing: Vec<_> = facts.into_iter().filter(|(_, holds)| !holds).map(|(fact, _)| fact).collect();
            if !missing.is_empty() {
                wrong.push(format!("line {} {}: {missing:?} {:?}", row.line, item.name, limits(item)));
            }
        }
    }
    assert_eq!(wrong, Vec::<String>::new());
    assert_eq!(count, 134);
    assert_eq!(items(device).filter(|item| address(item).is_some_and(|address| address >= 0x8000)).count(), 134);
}

#[test]
fn registers_without_the_printed_limits_say_why() {
    let Some(manual) = manual() else { return };
    let compilation = table();
    let device = device(&compilation);
    let mut differing = BTreeSet::new();
    for row in registers(&manual) {
        let item = items(device).find(|item| address(item) == Some(row.addresses.0)).expect("an item");
        let bits = base(device, item.ty).bits().expect("a length");
        if limits(item) != Some(signed(&row.limits, bits)) {
            differing.insert(row.numbers.0);
        }
    }
    // The limits of three registers differ from the printed limits: the register of the status word, and two registers whose
    // objects are shorter.
    assert_eq!(differing, BTreeSet::from([5, 34, 42]));
}

/// Compares the addresses of each register on five buses with an extracted table.
#[test]
fn one_register_is_one_item_on_five_buses() {
    let Some(rows) = rows("one_register_five_buses") else { return };
    let native = table();
    let siemens = with_choices(&[("register_base", "siemens"), ("parameter_base", "siemens")]);
    let plc = with_choices(&[("register_base", "siemens_plc"), ("parameter_base", "siemens_plc")]);
    let tables = [device(&native), device(&siemens), device(&plc)];
    assert_eq!(rows.len(), 134);
    let mut wrong = Vec::new();
    for row in &rows {
        let number: u16 = row[0][1..].parse().expect("a number");
        let row_items = tables.map(|device| {
            let is_window = |binding: &Binding| match binding {
                Binding::Indirect(window) => window.number == 0x8000 + u32::from(number),
                _ => false,
            };
            items(device).find(|item| item.bindings.iter().any(is_window)).expect("a register")
        });
        let addresses = row_items.map(address);
        let printed = [
            u16::from_str_radix(row[5].trim_start_matches("0x"), 16).ok(),
            row[6].parse().ok(),
            row[7].split('=').next().and_then(|entry| entry.parse().ok()),
        ];
        let is_same_object = !row[8].contains("DIFFERENT") && !row[8].contains("while") && row[8].starts_with("0x60")
            || row[8].starts_with("0x2")
            || row[8].starts_with("0x3");
        let object = is_same_object.then(|| place(&row[8]));
        if addresses != printed || row_items[0].object() != object {
            wrong.push(format!("{}: {addresses:?} {printed:?} {:?} {object:?}", row[0], row_items[0].object()));
        }
        if object.is_some() && bytes(tables[0], row_items[0]).to_string() != row[9] {
            wrong.push(format!("{}: {} bytes", row[0], bytes(tables[0], row_items[0])));
        }
        let image = in_images(row_items[0]).first().map(|(image, at, _)| (*image, *at));
        if image != image_position(&row[13]) {
            wrong.push(format!("{}: {image:?} {}", row[0], row[13]));
        }
    }
    assert_eq!(wrong, Vec::<String>::new());
}

/// Parses an address such as `0x6099:1`. Remarks may follow the address.
fn place(text: &str) -> (u16, u8) {
    let index = u16::from_str_radix(&text[2..6], 16).expect("an index");
    let sub = text[6..].trim_start_matches(':').chars().next().and_then(|digit| digit.to_digit(10)).unwrap_or(0);
    (index, sub as u8)
}

/// Parses a position in an image, such as `IN 0..1` or `IN 2 / display OUT 2`. Returns `None` for other texts, such as
/// `indirect`.
fn image_position(text: &str) -> Option<(&'static str, u32)> {
    let (image, rest) = match text.split_once(' ') {
        Some(("IN", rest)) => ("from the master", rest),
        Some(("OUT", rest)) => ("to the master", rest),
        _ => return None,
    };
    let digits: String = rest.chars().take_while(char::is_ascii_digit).collect();
    Some((image, digits.parse().ok()?))
}

#[test]
fn values_fill_their_registers() {
    let compilation = table();
    let device = device(&compilation);
    for item in items(device).filter(|item| address(item).is_some_and(|address| address >= 0x8000)) {
        let register = item.bindings.iter().find_map(|binding| match binding {
            Binding::Register(register) => Some(register),
            _ => None,
        });
        let register = register.expect("a register");
        assert_eq!((register.count, register.words_per_address, register.extended), (2, 2, true), "{}", item.name);
        assert!(!register.low_word_first, "{}", item.name);
    }
}

/// Returns the name, line and row text of each printed parameter.
fn parameters(manual: &[String]) -> Vec<(String, usize, String)> {
    let mut rows: Vec<(String, usize, String)> = Vec::new();
    for (line, text) in lines(manual, 478, 603) {
        let name = text.split(' ').next().unwrap_or_default();
        let mut letters = name.chars();
        let is_name = letters.next().is_some_and(|c| "dEFcIOPAHn".contains(c))
            && letters.next().is_some_and(|c| c.is_ascii_digit())
            && letters.next().is_none();
        if is_name {
            rows.push((name.to_owned(), line, text.to_owned()));
        } else if let Some((_, _, row)) = rows.last_mut() {
            row.push(' ');
            row.push_str(text);
        }
    }
    rows
}

#[test]
fn every_parameter_is_there_at_its_line() {
    let Some(manual) = manual() else { return };
    let compilation = table();
    let device = device(&compilation);
    let printed = parameters(&manual);
    assert_eq!(printed.len(), 59);
    let mut kinds = [0; 4];
    let mut found = 0;
    for (name, line, text) in &printed {
        let kind = ["Numero", "%  1-99", "Gradi", "--"].iter().position(|kind| text.contains(kind)).expect("a content");
        kinds[kind] += 1;
        let Some(code) = hex_numbers(text, 4).first().copied() else {
            assert!(["F4", "O4"].contains(&name.as_str()), "line {line}");
            assert!(!items(device).any(|item| item.name == *name), "line {line}");
            continue;
        };
        let decimal: u32 =
            text.split(" (0x").next().and_then(|entry| entry.rsplit(' ').next()).unwrap().parse().unwrap();
        assert_eq!(decimal, code, "line {line}");
        let item = item(device, name);
        found += 1;
        assert!(item_cites(item, *line), "line {line} {name}");
        assert_eq!(address(item).map(u32::from), Some(code), "line {line} {name}");
        assert_eq!(base(device, item.ty), Type::Unsigned(16), "{name}");
        let unit = item.quantity.as_ref().map_or("", |quantity| quantity.unit.as_str());
        match kind {
            1 => assert_eq!((unit, limits(item)), ("%", Some((1, 99))), "{name}"),
            2 => assert_eq!(unit, "°", "{name}"),
            _ => {}
        }
        let is_window = |binding: &&Binding| matches!(binding, Binding::Indirect(window) if window.number == code);
        assert_eq!(item.bindings.iter().filter(is_window).count(), 3, "{name}");
        // All writable parameters are saved, according to the section "Salvataggio su flash".
        assert_eq!(is_saved(item), item.access == Access::ReadWrite, "{name}");
    }
    assert_eq!((kinds, found), ([38, 18, 2, 1], 57));
}

/// Compares the values that are split into several parameters. Most of these values have a more significant and a less significant
/// part. One value, an offset, has a sign and three parts.
#[test]
fn every_number_in_several_parameters_is_a_composite() {
    let Some(manual) = manual() else { return };
    let compilation = table();
    let device = device(&compilation);
    let printed = parameters(&manual);
    let with = |words: &str| printed.iter().filter(|row| row.2.contains(words)).collect::<Vec<_>>();
    let halves = with("significativa");
    let mut expected: Vec<(Vec<&str>, Option<&str>)> = Vec::new();
    for pair in halves.chunks(2) {
        assert!(pair[0].2.contains("più") && pair[1].2.contains("meno"), "line {}", pair[0].1);
        expected.push((pair.iter().map(|row| row.0.as_str()).collect(), None));
    }
    let offset = with("Offset di spazio in impulsi");
    // The parameters H6, H7 and H8 contain the tens of thousands, the hundreds and the units of the offset.
    let weights = ["decine di migliaia", "centinaia", "unità"];
    assert!(offset.iter().zip(weights).all(|(row, weight)| row.2.contains(weight)));
    let sign = with("Segno offset di spazio");
    expected.push((offset.iter().map(|row| row.0.as_str()).collect(), Some(sign[0].0.as_str())));
    let of_table = |composite: &lexibus_codegen::ir::Composite| {
        (composite.parts.clone(), composite.sign.as_ref().map(|sign| sign.0.clone()))
    };
    let composites: Vec<_> = device.composites.iter().map(of_table).collect();
    let parts: Vec<(Vec<&str>, Option<&str>)> = composites
        .iter()
        .map(|(parts, sign)| {
            (parts.iter().map(|part| part.as_str()).collect(), sign.as_ref().map(|sign| sign.as_str()))
        })
        .collect();
    assert_eq!((parts.len(), parts), (5, expected));
    assert!(device.composites.iter().all(|entry| entry.base == 100));
    for row in halves.iter().chain(&offset).chain(&sign) {
        let actual = device.composites.iter().find(|composite| {
            composite.parts.iter().chain(composite.sign.as_ref().map(|sign| &sign.0)).any(|part| **part == row.0)
        });
        assert!(cites(actual.expect("a composite").documentation.as_deref(), row.1), "line {} {}", row.1, row.0);
    }
}

#[test]
fn the_command_that_saves_has_an_address_of_its_own() {
    let compilation = with_choices(&[("register_base", "siemens"), ("parameter_base", "siemens")]);
    let device = device(&compilation);
    for name in ["save_to_flash", "save_to_flash_32"] {
        assert_eq!(address(item(device, name)), Some(0x3802));
    }
    assert_eq!(item(device, "save_to_flash").access, Access::WriteOnly);
}

/// Compares the list of objects that 0x1010 saves (section "Salvataggio su flash") with the register table. The list has 36
/// cells, and prints 0x3701 for each of the inputs 9, 10 and 11.
#[test]
fn what_canopen_saves_is_saved() {
    let Some(manual) = manual() else { return };
    let compilation = table();
    let device = device(&compilation);
    let text: String = lines(&manual, 3361, 3407).map(|(_, text)| text.to_owned() + " ").collect();
    let cells = hex_numbers(&text.replace("sub1", " 1").replace("sub2", " 2"), 4);
    assert_eq!(cells.len(), 36);
    let saved: BTreeSet<u16> =
        items(device).filter(|item| is_saved(item)).filter_map(Item::object).map(|object| object.0).collect();
    for index in &cells {
        let index = *index as u16;
        assert!(saved.contains(&index), "0x{index:04X}");
    }
    let listed: BTreeSet<u16> = cells.iter().map(|cell| *cell as u16).collect();
    let beyond: Vec<u16> = saved.difference(&listed).copied().collect();
    // The manual's list prints 0x3701 instead of two of these six objects. The remaining four objects are outputs, which are
    // saved according to the register table.
    assert_eq!(beyond, [0x3301, 0x3302, 0x3501, 0x3502, 0x3702, 0x3703]);
    let registers = items(device).filter(|item| address(item).is_some_and(|address| address >= 0x8000));
    assert_eq!(registers.filter(|item| is_saved(item)).count(), 125);
}
