//! Parameters of both chapters, row by row.

use std::collections::BTreeSet;

use lexibus_codegen::ir::{Device, Item, ItemVariant, Scale, Value};

use super::hsd_support::{chapter, code, device, line, number, original, table, underlying, Manual};

/// A parameter as the manual prints it: the lines of SM137 and SM140, and the cells of both.
struct Printed {
    lines: [usize; 2],
    code: u32,
    name: String,
    size: String,
    unit: String,
    /// Default and range, of SM137 and of SM140.
    values: [[String; 2]; 2],
}

/// The parameters of some lines; `has_size` where there are columns of size and unit. A parameter without a second line has none.
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
                Some(own) if own.lines == [at - 1, 0] && cells[0].is_empty() && cells[2].is_empty() => {
                    (own.lines[1], own.values[1]) = (at, [tail(0), tail(1)]);
                }
                _ => {}
            },
        }
    }
    found
}

/// What a model has of a parameter: default, least and greatest value.
pub fn of_model(item: &Item, model: &str) -> [Option<i128>; 3] {
    let variant = item.variants.iter().find(|own| own.models.iter().any(|own| own == model));
    let int = |value: Option<&Value>| value.and_then(Value::as_int);
    let own = |of: &dyn Fn(&ItemVariant) -> Option<i128>, base| variant.and_then(of).or(base);
    [
        own(&|own| int(own.default.as_ref()), int(item.default.as_ref())),
        own(&|own| int(own.limits.low.as_ref()), int(item.limits.low.as_ref())),
        own(&|own| int(own.limits.high.as_ref()), int(item.limits.high.as_ref())),
    ]
}

/// The two numbers of a range: `0 / 32767`, `-(2^{31})-1/(2^{31}-1)`.
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

/// What of its printed cells a row of the table reads otherwise.
fn differences(printed: &Printed, item: &Item) -> Vec<String> {
    let mut found = Vec::new();
    // Some have one line for both models.
    let lines = if printed.lines[1] == 0 { 1 } else { 2 };
    for (model, cells) in ["SM137 rev. C", "SM140"].into_iter().zip(&printed.values).take(lines) {
        let own = of_model(item, model);
        let given = cells[0].strip_prefix("8 EnetX ").map(|own| own.replace(" RS485", "")).unwrap_or(cells[0].clone());
        match number(&given) {
            Some(default) if own[0] == Some(default) => {}
            None if cells[0].is_empty() && own[0].is_none() => {}
            None if cells[0] == "--" && own[0].is_none() => {}
            _ => found.push(format!("{model} default {:?}", cells[0])),
        }
        match range(&cells[1]) {
            Some(range) if range.map(Some) == own[1..] => {}
            None if matches!(cells[1].as_str(), "" | "--") && own[1..] == [None, None] => {}
            _ => found.push(format!("{model} range {:?}", cells[1])),
        }
    }
    found
}

/// Holds parameters against their rows; returns what is read otherwise, each with its doubts.
fn compare(device: &Device, title: &str, printed: &[Printed]) -> Vec<(String, Vec<String>)> {
    let group = chapter(device, title);
    assert_eq!(group.items.len(), printed.len());
    let mut wrong = Vec::new();
    for (item, own) in group.items.iter().zip(printed) {
        assert_eq!(
            (code(item), line(item.documentation.as_ref().and_then(|own| own.cite.as_deref()))),
            (own.code, own.lines[0])
        );
        let name = if original(&item.names).is_empty() { item.name.as_str() } else { original(&item.names) };
        assert_eq!(name, own.name, "L{}", own.lines[0]);
        let differences = differences(own, item);
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
        assert_eq!(page.len(), count, "L{from}");
        printed.extend(page);
    }
    let holes: Vec<u32> = (0x100..=0x130).filter(|code| !printed.iter().any(|own| own.code == *code)).collect();
    assert_eq!((printed.len(), holes.as_slice()), (47, &[0x102, 0x129][..]));
    let sizes = |size: &str| printed.iter().filter(|own| own.size == size).count();
    assert_eq!((sizes("16bit"), sizes("32bit"), sizes("")), (32, 4, 11));
    let wrong = compare(device, "Parameters", &printed);
    let names: Vec<&str> = wrong.iter().map(|(name, _)| name.as_str()).collect();
    let expected = ["ORIG_AZZ", "LOW_SLIM", "HIGH_SLIM", "RESERVED4", "TIMEOUTFB", "INVDIN", "TIPOAZZ", "VAZZOUTMIC"];
    assert_eq!(names, expected, "{wrong:#?}");
    for (item, own) in chapter(device, "Parameters").items.iter().zip(&printed) {
        let bits = underlying(device, item.ty).bits();
        let is_tuned = matches!(own.code, 0x120..=0x123);
        match own.size.as_str() {
            "16bit" => assert_eq!(bits, Some(16), "{}", item.name),
            "32bit" => assert_eq!(bits, Some(32), "{}", item.name),
            _ => assert_eq!(bits, is_tuned.then_some(16), "{}", item.name),
        }
        assert_eq!(
            unit(item, own.code),
            own.unit.to_lowercase().replace("x ", "x").replace(" ²", "²"),
            "{}",
            item.name
        );
    }
}

/// The unit of a parameter as the manual would print it; empty where it prints none.
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
        // RESERVED1 and TIMEOUTFB have units in the text only.
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
    let low: Vec<u32> = printed.iter().map(|own| own.code & 0xFFF).collect();
    assert_eq!(low, (0..=0x2D).collect::<Vec<_>>());
    let wrong = compare(device, "Low-level parameters", &printed);
    let names: Vec<&str> = wrong.iter().map(|(name, _)| name.as_str()).collect();
    // The line of the SM140 is empty.
    assert_eq!(names, ["KIQDLIMIN"], "{wrong:#?}");
    let chapters = ["Parameters", "Low-level parameters"].map(|title| chapter(device, title));
    assert_eq!(chapters.map(|group| group.items.len()).iter().sum::<usize>(), 93);
    let printed = |item: &Item| match original(&item.names) {
        "" => item.name.to_string(),
        name => name.to_owned(),
    };
    let names = chapters.map(|group| group.items.iter().map(printed).collect::<BTreeSet<_>>());
    assert_eq!(names[0].intersection(&names[1]).count(), 12);
    let low_halves =
        chapters[1].items.iter().filter(|item| item.related.as_ref().is_some_and(|own| own.upper_half.is_some()));
    assert_eq!(low_halves.count(), 4);
}
