//! Functions that return the facts of an EDS in the form that the table of quirks requires. They read the file without Lexibus.

use super::corpus_support::number::{self, hex_digits, number, plain, Number};
use super::corpus_support::reading::{cut, Part, Reading};
use super::corpus_support::{entry, header, lines};
use super::facts::{self, put, put_flag, put_some, Facts};

/// Numbers of the signed types in CiA 301, with their lengths in bits.
const SIGNED: [(i128, u32); 8] =
    [(0x02, 8), (0x03, 16), (0x04, 32), (0x10, 24), (0x12, 40), (0x13, 48), (0x14, 56), (0x15, 64)];

/// Returns the length of a signed type in bits, or `None` for other types.
pub fn signed_bits(ty: i128) -> Option<u32> {
    SIGNED.iter().find(|(entry, _)| *entry == ty).map(|(_, bits)| *bits)
}

/// Parses a value whose type has the CiA 301 number `ty`. Hexadecimal digits are the bit pattern of a signed number (E07, E08) or
/// of a real number (E51). `$NODEID` is accepted at any position, ignoring case (E12 to E17), and is replaced with the node-ID.
pub fn value(raw: &str, ty: i128, node_id: u8) -> Option<String> {
    match ty {
        0x08 => real(cut(raw).0, 32),
        0x11 => real(cut(raw).0, 64),
        0x09 | 0x0B => Some(format!("'{raw}'")),
        0x01..=0x07 | 0x10 | 0x12..=0x16 | 0x18..=0x1B => integer(cut(raw).0, ty, node_id),
        _ => None,
    }
}

fn real(raw: &str, bits: usize) -> Option<String> {
    let value = number::real(raw, bits).or_else(|| Some(plain(raw)? as f64))?;
    Some(facts::real(value))
}

fn integer(raw: &str, ty: i128, node_id: u8) -> Option<String> {
    let value = match number(raw)? {
        Number::Plain(value) => value,
        Number::NodeId(offset) => offset + i128::from(node_id),
    };
    let is_negative = |bits: &u32| hex_digits(raw).is_some() && (1 << (bits - 1)..1 << bits).contains(&value);
    Some(signed_bits(ty).filter(is_negative).map_or(value, |bits| value - (1 << bits)).to_string())
}

/// Returns whether a value depends on the node-ID.
pub fn is_relative(raw: &str) -> bool {
    matches!(number(cut(raw).0), Some(Number::NodeId(_)))
}

/// Returns the access rights for a text of AccessType. Ignores the case of the keywords in CiA 306 (E47). Any other text means
/// `ro` (E48).
pub fn access(text: Option<&str>) -> &'static str {
    const KNOWN: [&str; 6] = ["ro", "wo", "rw", "rwr", "rww", "const"];
    let text = text.unwrap_or_default();
    KNOWN.into_iter().find(|known| known.eq_ignore_ascii_case(text)).unwrap_or("ro")
}

/// Returns the last value (E28) of `key` in `section`. Ignores the case of both names (E25, E66).
fn value_of<'t>(text: &'t str, section: &str, key: &str) -> Option<&'t str> {
    let (mut is_within, mut found) = (false, None);
    for (_, line) in lines(text) {
        if let Some((name, _)) = header(line) {
            is_within = name.eq_ignore_ascii_case(section);
        } else if let Some((_, value)) = entry(line).filter(|(entry, _)| is_within && entry.eq_ignore_ascii_case(key)) {
            found = Some(value);
        }
    }
    found.filter(|value| !value.is_empty())
}

fn number_of(text: &str, section: &str, key: &str) -> Option<i128> {
    plain(cut(value_of(text, section, key)?).0)
}

/// Returns the value of a device fact such as `bit rate`, or `None` if the file does not contain this fact.
pub fn of_device(text: &str, fact: &str) -> Option<String> {
    let number = |key: &str| number_of(text, "DeviceInfo", key);
    match fact {
        "vendor name" => value_of(text, "DeviceInfo", "VendorName").map(str::to_owned),
        "granularity" => number("Granularity").map(|bits| bits.to_string()),
        "RPDOs" => number("NrOfRXPDO").map(|count| count.to_string()),
        "TPDOs" => number("NrOfTXPDO").map(|count| count.to_string()),
        "bit rate" => number_of(text, "DeviceComissioning", "Baudrate").map(|rate| rate.to_string()),
        "bit rates" => {
            let rates = [10, 20, 50, 125, 250, 500, 800, 1000].into_iter();
            let has = |rate: &i32| number(&format!("BaudRate_{rate}")).is_some_and(|flag| flag != 0);
            Some(rates.filter(has).map(|rate| rate.to_string()).collect::<Vec<_>>().join(" "))
        }
        "comments" => {
            let count = number_of(text, "Comments", "Lines")?;
            let line = |at| value_of(text, "Comments", &format!("Line{at}")).unwrap_or_default();
            Some((1..=count).map(line).collect::<Vec<_>>().join("\n").trim_end().to_owned())
        }
        _ => None,
    }
}

/// Returns the facts of a sub-index that CompactSubObj implies (E43). Separate sections can list the name and the
/// value of the sub-index (E44).
pub fn compact(reading: &Reading, index: u16, sub: u8, node_id: u8) -> Option<Facts> {
    let object = reading.get(index, Part::Object)?;
    let mut facts = Facts::new();
    if sub == 0 {
        put(&mut facts, "name", "NrOfObjects");
        put(&mut facts, "type", "5");
        put(&mut facts, "access", "ro");
        // Do not count sub-index 255, because it describes the structure of the object (E77).
        put_some(&mut facts, "default", object.number("compactsubobj").map(|count| count.min(254)));
        return Some(facts);
    }
    let refined = |part| Some(reading.get(index, part)?.get(&sub.to_string())?.value.as_str());
    let name = || format!("{}{sub}", object.get("parametername").map_or("", |name| &name.value));
    put(&mut facts, "name", refined(Part::Name).map_or_else(name, str::to_owned));
    let ty = object.number("datatype")?;
    let value = |raw: Option<&str>| raw.and_then(|raw| value(raw, ty, node_id));
    put(&mut facts, "type", ty.to_string());
    put(&mut facts, "access", access(object.text("accesstype")));
    put_flag(&mut facts, "mappable", object.number("pdomapping").is_some_and(|flag| flag != 0));
    put_some(&mut facts, "default", value(object.text("defaultvalue")));
    put_flag(&mut facts, "relative", object.text("defaultvalue").is_some_and(is_relative));
    put_some(&mut facts, "low", value(object.text("lowlimit")));
    put_some(&mut facts, "high", value(object.text("highlimit")));
    put_some(&mut facts, "value", value(refined(Part::Value).or(object.text("parametervalue"))));
    Some(facts)
}

/// Returns the type of a sub-index that CompactPDO implies (E70). Each bit of CompactPDO selects a communication parameter,
/// for which CiA 301 defines a type. The mapping has eight entries.
pub fn compact_pdo(text: &str, index: u16, sub: u8) -> Option<&'static str> {
    let mask = number_of(text, "DeviceInfo", "CompactPDO").filter(|mask| *mask != 0)?;
    match (index & 0x200 != 0, sub) {
        (_, 0) => Some("5"),
        (true, 1..=8) => Some("7"),
        (false, 1..=6) if mask >> (sub - 1) & 1 == 1 => Some(["7", "5", "6", "5", "6", "5"][usize::from(sub) - 1]),
        _ => None,
    }
}

/// Returns the number of PDOs in the same direction as the PDO object `index`.
pub fn pdos(text: &str, index: u16) -> Option<i128> {
    number_of(text, "DeviceInfo", if index < 0x1800 { "NrOfRXPDO" } else { "NrOfTXPDO" })
}
