//! Compares the parameters in both chapters of the manual with the register table, row by row.

use std::collections::BTreeSet;

use lexibus_codegen::ir::{Device, Item, ItemVariant, Scale, Value};

use super::hsd_support::{chapter, code, device, line, number, original, table, underlying, Manual};

/// A parameter as printed in the manual, with one line for both models or one line per model (SM137, SM140).
struct Printed {
    lines: [usize; 2],
    code: u32,
    name: String,
    size: String,
    unit: String,
    /// Default and range for the SM137 and the SM140.
    values: [[String; 2]; 2],
}

/// Returns the printed parameters in a range of lines. `has_size` means that the table has columns for size and unit. A
/// parameter may have no second line.
fn parameters(manual: &Manual, from: usize, to: usize, has_size: bool) -> Vec<Printed> {
    let mut found: Vec<Printed> = Vec::new();
    for (at, cells) in manual.rows(from, to) {
        let tail = |at: usize| cells.get(cells.len() - 2 + at).cloned().unwrap_or_default();
        match number(&cells[0]).filter(|_| cells[0].starts_with("0x")) {
            Some(code) => found.push(Printed {
                lines: [at, 0],
                code: code as u32,
                name: cells[2].clone(),
                size: if has_size { cells[3].clone() } else { String::new() },
                unit: if has_size { cells[4].clone() } else { String::new() },
                values: [[tail(0), tail(1)], Default::default()],
            }),
            None => match found.last_mut() {
                Some(entry) if entry.lines == [at - 1, 0] && cells[0].is_empty() && cells[2].is_empty() => {
                    (entry.lines[1], entry.values[1]) = (at, [tail(0), tail(1)]);
                }
                _ => {}
            },
        }
    }
    found
}

/// Returns the default, minimum and maximum of a parameter for a model.
pub fn of_model(item: &Item, model: &str) -> [Option<i128>; 3] {
    let variant = item.variants.iter().find(|variant| variant.models.iter().any(|entry| entry == model));
    let int = |value: Option<&Value>| value.and_then(Value::as_int);
    let of_model = |of: &dyn Fn(&ItemVariant) -> Option<i128>, base| variant.and_then(of).or(base);
    [
        of_model(&|variant| int(variant.default.as_ref()), int(item.default.as_ref())),
        of_model(&|variant| int(variant.limits.low.as_ref()), int(item.limits.low.as_ref())),
        of_model(&|variant| int(variant.limits.high.as_ref()), int(item.limits.high.as_ref())),
    ]
}

/// Parses a range such as `0 / 32767` or `-(2^{31})-1/(2^{31}-1)`.
fn range(cell: &str) -> Option<[i128; 2]> {
    let plain = cell.replace(['$', '{', '}', ' '], "").replace("2³¹", "2^31");
    let (low, high) = plain.split_once('/')?;
    let one = |text: &str| match text {
        "-(2^31)-1" => Some(-(1 << 31) - 1),
        "(2^31-1)" | "(2^31)-1" => Some((1 << 31) - 1),
        other => other.parse().ok(),
    };
    Some([one(low)?, one(high)?])
}

/// Returns the printed cells that differ from the item.
fn differences(printed: &Printed, item: &Item) -> Vec<String> {
    let mut found = Vec::new();
    // Some parameters have one line for both models.
    let lines = if printed.lines[1] == 0 { 1 } else { 2 };
    for (model, cells) in ["SM137 rev. C", "SM140"].into_iter().zip(&printed.values).take(lines) {
        let actual = of_model(item, model);
        let given =
            cells[0].strip_prefix("8 EnetX ").map(|cell| cell.replace(" RS485", "")).unwrap_or(cells[0].clone());
        match number(&given) {
            Some(default) if actual[0] == Some(default) => {}
            None if cells[0].is_empty() && actual[0].is_none() => {}
            None if cells[0] == "--" && actual[0].is_none() => {}
            _ => found.push(format!("{model} default {:?}", cells[0])),
        }
        match range(&cells[1]) {
            Some(range) if range.map(Some) == actual[1..] => {}
            None if matches!(cells[1].as_str(), "" | "--") && actual[1..] == [None, None] => {}
            _ => found.push(format!("{model} range {:?}", cells[1])),
        }
    }
    found
}

/// Compares printed parameters with their items. Returns the name and the differences of each parameter that differs.
fn compare(device: &Device, title: &str, printed: &[Printed]) -> Vec<(String, Vec<String>)> {
    let group = chapter(device, title);
    assert_eq!(group.items.len(), printed.len());
    let mut wrong = Vec::new();
    for (item, entry) in group.items.iter().zip(printed) {
        assert_eq!(
            (code(item), line(item.documentation.as_ref().and_then(|documentation| documentation.cite.as_deref()))),
            (entry.code, entry.lines[0])
        );
        let name = if original(&item.names).is_empty() { item.name.as_str() } else { original(&item.names) };
        assert_eq!(name, entry.name, "line {}", entry.lines[0]);
        let differences = differences(entry, item);
        if !differences.is_empty() {
            assert!(!item.doubts.is_empty() || item.availability.is_some(), "{name}: {differences:?}");
            wrong.push((item.name.to_string(), differences));
        }
    }
    wrong
}

#[test]
fn parameters_of_chapter_6() {
    let Some(manual) = Manual::read() else { return };
    let compilation = table();
    let device = device(&compilation);
    let pages = [(1510, 1535, 11), (1537, 1564, 12), (1566, 1601, 20), (1603, 1614, 4)];
    let mut printed = Vec::new();
    for (from, to, count) in pages {
        let page = parameters(&manual, from, to, true);
        assert_eq!(page.len(), count, "line {from}");
        printed.extend(page);
    }
    let holes: Vec<u32> = (0x100..=0x130).filter(|code| !printed.iter().any(|row| row.code == *code)).collect();
    assert_eq!((printed.len(), holes.as_slice()), (47, &[0x102, 0x129][..]));
    let sizes = |size: &str| printed.iter().filter(|row| row.size == size).count();
    assert_eq!((sizes("16bit"), sizes("32bit"), sizes("")), (32, 4, 11));
    let wrong = compare(device, "Parameters", &printed);
    let names: Vec<&str> = wrong.iter().map(|(name, _)| name.as_str()).collect();
    let expected = ["ORIG_AZZ", "LOW_SLIM", "HIGH_SLIM", "RESERVED4", "TIMEOUTFB", "INVDIN", "TIPOAZZ", "VAZZOUTMIC"];
    assert_eq!(names, expected, "{wrong:#?}");
    for (item, entry) in chapter(device, "Parameters").items.iter().zip(&printed) {
        let bits = underlying(device, item.ty).bits();
        let is_tuned = matches!(entry.code, 0x120..=0x123);
        match entry.size.as_str() {
            "16bit" => assert_eq!(bits, Some(16), "{}", item.name),
            "32bit" => assert_eq!(bits, Some(32), "{}", item.name),
            _ => assert_eq!(bits, is_tuned.then_some(16), "{}", item.name),
        }
        assert_eq!(
            unit(item, entry.code),
            entry.unit.to_lowercase().replace("x ", "x").replace(" ²", "²"),
            "{}",
            item.name
        );
    }
}

/// Returns the unit of a parameter in the notation of the manual. Returns an empty text if the manual prints no unit.
fn unit(item: &Item, code: u32) -> String {
    let Some(quantity) = item.quantity.as_ref() else { return String::new() };
    let symbol = match quantity.unit.as_str() {
        "V" => "volt ",
        "A" => "a",
        "ms" => "msec",
        "count" => "cnt",
        "count/s²" => return "10000 cnt/sec²".to_owned(),
        other => other,
    };
    match &quantity.scale {
        // The manual states the units of RESERVED1 and TIMEOUTFB only in the text, not in the table.
        _ if matches!(code, 0x120 | 0x12D) => String::new(),
        Some(Scale::Linear { factor, .. }) => format!("{symbol}x{factor}"),
        _ => symbol.to_owned(),
    }
}

#[test]
fn low_level_parameters() {
    let Some(manual) = Manual::read() else { return };
    let compilation = table();
    let device = device(&compilation);
    let printed = parameters(&manual, 1760, 1864, false);
    assert_eq!(printed.len(), 46);
    let low: Vec<u32> = printed.iter().map(|row| row.code & 0xFFF).collect();
    assert_eq!(low, (0..=0x2D).collect::<Vec<_>>());
    let wrong = compare(device, "Low-level parameters", &printed);
    let names: Vec<&str> = wrong.iter().map(|(name, _)| name.as_str()).collect();
    // For the parameter KIQDLIMIN, the manual's row for the SM140 is empty.
    assert_eq!(names, ["KIQDLIMIN"], "{wrong:#?}");
    let chapters = ["Parameters", "Low-level parameters"].map(|title| chapter(device, title));
    assert_eq!(chapters.map(|group| group.items.len()).iter().sum::<usize>(), 93);
    let printed = |item: &Item| match original(&item.names) {
        "" => item.name.to_string(),
        name => name.to_owned(),
    };
    let names = chapters.map(|group| group.items.iter().map(printed).collect::<BTreeSet<_>>());
    assert_eq!(names[0].intersection(&names[1]).count(), 12);
    let low_halves = chapters[1]
        .items
        .iter()
        .filter(|item| item.related.as_ref().is_some_and(|related| related.upper_half.is_some()));
    assert_eq!(low_halves.count(), 4);
}
