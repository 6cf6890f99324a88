//! Reasons for differences between `canopen` and Lexibus. A reason applies only if the original text of the file shows it, and
//! if Lexibus has the value that the table of quirks requires.

use super::corpus_support::number::{hex_digits, number, Number};
use super::corpus_support::reading::{Part, Reading, Section};
use super::corpus_support::{entry, header, lines, File};
use super::eds_expected as expected;
use super::facts::{Difference, Elements};
use super::tally::Reasons;

/// Known differences between the library `canopen` and Lexibus: the name of each difference, and an explanation.
const PEER: &[(&str, &str)] = &[
    ("files by ending", "It reads only files with the extensions .eds and .dcf, and no XML."),
    ("files without sections", "It reads a file without a section of CiA 306 as an empty dictionary, not as an error."),
    ("identity of 1018", "It reads the identity only from [DeviceInfo], even if that is 0 and object 0x1018 is not."),
    ("limits that are no integers", "It reads every limit as an integer, and drops those of reals and texts."),
    ("limits with $NODEID", "It reads formulas in values, but drops those in limits."),
    ("node-ID 255", "It accepts any number as a node-ID. In LSS, 255 means none, so Lexibus drops it."),
    ("suffixes of C", "It drops `0x1234LL`. Lexibus reads the number and reports it."),
    ("times of two numbers", "It removes the blank from `1 2000`, and reads days and milliseconds as one number."),
];

pub const REASONS: Reasons = Reasons {
    quirks: &[
        "E01", "E06", "E08", "E14", "E16", "E18", "E19", "E21", "E23", "E27", "E28", "E30", "E43", "E44", "E48", "E49",
        "E51", "E54", "E56", "E58", "E59", "E64", "E66", "E70", "E78", "E82",
    ],
    peer: PEER,
};

/// A file with the facts that the library and Lexibus read from it.
pub struct Case<'a> {
    pub text: String,
    pub reading: Reading,
    pub peer: &'a Elements,
    pub ours: &'a Elements,
    node_id: u8,
}

impl Case<'_> {
    /// Creates a case. `node_id` replaces `$NODEID` if the file has no node-ID, or if its node-ID is 255, which means an
    /// unconfigured device in LSS.
    pub fn new<'a>(file: &File, peer: &'a Elements, ours: &'a Elements, node_id: u8) -> Case<'a> {
        let text = file.text();
        let given = peer.get("device").and_then(|facts| facts.get("node-ID")?.parse().ok()).filter(|id| *id != 255);
        Case { reading: Reading::of(&text), text, peer, ours, node_id: given.unwrap_or(node_id) }
    }

    /// Returns the section that describes an element. Elements have names such as `1018` and `1018:01`.
    fn section(&self, element: &str) -> Option<&Section> {
        let (index, sub) = address(element)?;
        match sub {
            Some(sub) => self.reading.get(index, Part::Sub(sub)).or_else(|| self.reading.get(index, Part::Object)),
            None => self.reading.get(index, Part::Object),
        }
    }
}

fn address(element: &str) -> Option<(u16, Option<u8>)> {
    let (index, sub) = element.split_once(':').map_or((element, None), |(index, sub)| (index, Some(sub)));
    let sub = sub.map(|sub| u8::from_str_radix(sub, 16).expect("a sub-index"));
    Some((u16::from_str_radix(index, 16).ok()?, sub))
}

pub fn reason(case: &Case<'_>, difference: &Difference<'_>) -> Option<&'static str> {
    if difference.element == "device" {
        return of_device(case, difference);
    }
    let (index, sub) = address(difference.element)?;
    match difference.fact {
        None => missing(case, index, sub, difference),
        Some(fact) => of_value(case, index, sub, fact, difference),
    }
}

/// Returns the reason why the library does not find an element.
fn missing(case: &Case<'_>, index: u16, sub: Option<u8>, difference: &Difference<'_>) -> Option<&'static str> {
    difference.ours?;
    let object = case.reading.get(index, Part::Object);
    let compact = object.and_then(|object| object.number("compactsubobj")).unwrap_or(-1);
    match sub {
        Some(sub) if i128::from(sub) <= compact => {
            let expected = expected::compact(&case.reading, index, sub, case.node_id);
            Some("E43").filter(|_| case.ours.get(difference.element) == expected.as_ref())
        }
        _ => Some("E70").filter(|_| object.is_none() && is_announced(case, index, sub)),
    }
}

/// Returns whether an object that the file does not describe belongs to a PDO that CompactPDO and the number of PDOs imply.
fn is_announced(case: &Case<'_>, index: u16, sub: Option<u8>) -> bool {
    if !(0x1400..0x1C00).contains(&index) {
        return false;
    }
    let Some(sub) = sub else {
        let first = index & !0x3FF;
        let all = case.ours.range(format!("{first:04X}")..format!("{:04X}", first + 0x200));
        let count = all.filter(|(name, _)| name.len() == 4).count();
        return expected::pdos(&case.text, index) == i128::try_from(count).ok();
    };
    let ty = case.ours.get(&format!("{index:04X}:{sub:02X}")).and_then(|facts| facts.get("type"));
    ty.is_some() && ty.map(String::as_str) == expected::compact_pdo(&case.text, index, sub)
}

fn of_device(case: &Case<'_>, difference: &Difference<'_>) -> Option<&'static str> {
    let Some(fact) = difference.fact else {
        let is_nothing = case.ours.is_empty() && case.peer.values().all(|facts| facts.is_empty());
        return is_nothing.then_some("files without sections");
    };
    let (peer, ours) = (difference.peer, difference.ours);
    let keys: &[&str] = match fact {
        "vendor name" => &["VendorName"],
        "RPDOs" => &["NrOfRXPDO"],
        "TPDOs" => &["NrOfTXPDO"],
        "bit rate" => &["Baudrate"],
        "bit rates" => &["BaudRate_1000", "BaudRate_500", "BaudRate_250", "BaudRate_125"],
        _ => &[],
    };
    let is_expected = || ours.is_some() && ours == expected::of_device(&case.text, fact).as_deref();
    let identity = ["vendor number", "product number", "revision number"].iter().position(|name| *name == fact);
    let in_object = identity.and_then(|at| case.ours.get(&format!("1018:{:02X}", at + 1))?.get("default"));
    match fact {
        "granularity" if peer == Some("1") && is_expected() => Some("E82"),
        "comments" if is_misspelled(&case.text, "Line5") && is_expected() => Some("E59"),
        "node-ID" if ours.is_none() && peer == Some("255") => Some("node-ID 255"),
        _ if peer.is_none_or(|peer| peer == "0") && ours.is_some() && ours == in_object.map(String::as_str) => {
            Some("identity of 1018")
        }
        _ if ours.is_none() && peer == Some("\"\"") => Some("E23"),
        _ if keys.iter().any(|key| is_misspelled(&case.text, key)) && is_expected() => Some("E66"),
        _ => None,
    }
}

/// Returns whether a file contains `key`, ignoring case.
fn has_key(text: &str, key: &str) -> bool {
    lines(text).iter().any(|(_, line)| entry(line).is_some_and(|(ours, _)| ours.eq_ignore_ascii_case(key)))
}

/// Returns whether a file contains `key` only with different capitalization.
fn is_misspelled(text: &str, key: &str) -> bool {
    has_key(text, key) && !lines(text).iter().any(|(_, line)| entry(line).is_some_and(|(ours, _)| ours == key))
}

fn of_value(
    case: &Case<'_>,
    index: u16,
    sub: Option<u8>,
    fact: &str,
    difference: &Difference<'_>,
) -> Option<&'static str> {
    let (peer, ours) = (difference.peer, difference.ours);
    let object = case.reading.get(index, Part::Object)?;
    let is_compact = object.number("compactsubobj").is_some_and(|count| count > 0);
    if let Some(sub) = sub.filter(|&sub| is_compact && case.reading.get(index, Part::Sub(sub)).is_none()) {
        let reason = match fact {
            "value" if peer.is_none() => "E44",
            "name" if sub <= 1 => "E43",
            "access" | "default" if sub == 0 => "E43",
            _ => return None,
        };
        let facts = expected::compact(&case.reading, index, sub, case.node_id)?;
        return Some(reason).filter(|_| ours.is_some() && ours == facts.get(fact).map(String::as_str));
    }
    let section = case.section(difference.element)?;
    let ty = section.number("datatype").unwrap_or(0);
    let key = match fact {
        "default" | "relative" => "defaultvalue",
        "value" => "parametervalue",
        "low" => "lowlimit",
        "high" => "highlimit",
        // The library treats unknown types as DOMAIN. Lexibus keeps the original type.
        "type" => {
            let is_unknown = peer == Some("15") && !(1..=0x1B).contains(&ty);
            return Some("E56").filter(|_| is_unknown && ours == Some(&ty.to_string()));
        }
        "access" => {
            let text = section.text("accesstype");
            let is_strange = text.map(str::to_lowercase).as_deref() == peer;
            return Some("E48").filter(|_| is_strange && ours == Some(expected::access(text)));
        }
        _ => return None,
    };
    let raw = section.get(key).map(|fact| fact.value.as_str())?;
    match fact {
        "relative" => {
            let is_strange = !raw.contains("$NODEID") && expected::is_relative(raw);
            Some("E14").filter(|_| is_strange && ours == Some("yes"))
        }
        "low" | "high" => of_limit(raw, ty, case.node_id, difference),
        _ => of_text(raw, ty, case.node_id, difference),
    }
}

fn of_limit(raw: &str, ty: i128, node_id: u8, difference: &Difference<'_>) -> Option<&'static str> {
    let (peer, ours) = (difference.peer, difference.ours?);
    if !(1..=0x1B).contains(&ty) {
        return Some("E56").filter(|_| ours == format!("raw {raw}"));
    }
    let is_expected = peer.is_none() && expected::value(raw, ty, node_id).as_deref() == Some(ours);
    match number(raw) {
        _ if !is_expected => None,
        Some(Number::NodeId(_)) => Some("limits with $NODEID"),
        None => Some("limits that are no integers"),
        Some(Number::Plain(_)) => None,
    }
}

/// Returns the reason why a default or configured value differs. The reason depends on the text and the type number.
fn of_text(raw: &str, ty: i128, node_id: u8, difference: &Difference<'_>) -> Option<&'static str> {
    let (peer, ours) = (difference.peer, difference.ours?);
    let bare = raw.trim_matches('"');
    let kept = ours == format!("raw {raw}");
    let is_expected = || expected::value(raw, ty, node_id).as_deref() == Some(ours);
    match ty {
        0x09 | 0x0B => Some("E23").filter(|_| ours == format!("'{bare}'") && raw.len() == bare.len() + 2),
        0x0F => Some("E54").filter(|_| kept && peer.is_none()),
        0x08 | 0x11 => Some("E51").filter(|_| peer.is_none() && hex_digits(raw).is_some() && is_expected()),
        0x0C | 0x0D => Some("times of two numbers").filter(|_| kept && raw.split(' ').count() == 2),
        1..=0x1B if peer.is_none() => match number(raw) {
            _ if raw.starts_with('$') && kept => Some("E18"),
            Some(Number::NodeId(0)) if raw.eq_ignore_ascii_case("$NODEID") => Some("E16").filter(|_| is_expected()),
            Some(_) => None,
            None if kept => Some("E19"),
            None => with_suffix(raw, ours),
        },
        1..=0x1B => {
            let is_unsigned = expected::signed_bits(ty).is_some() && number(raw)? == Number::Plain(peer?.parse().ok()?);
            Some("E08").filter(|_| is_unsigned && is_expected())
        }
        _ => Some("E56").filter(|_| kept),
    }
}

/// Returns the reason why a number with a suffix differs, such as `00h` (hexadecimal) or `0x1ULL` (C).
fn with_suffix(raw: &str, ours: &str) -> Option<&'static str> {
    let ours: i128 = ours.parse().ok()?;
    let hexadecimal = raw.strip_suffix(['h', 'H']).and_then(|digits| i128::from_str_radix(digits, 16).ok());
    if hexadecimal == Some(ours) {
        return Some("E19");
    }
    let bare = raw.trim_end_matches(['U', 'L', 'u', 'l']);
    (number(bare) == Some(Number::Plain(ours))).then_some("suffixes of C")
}

/// Keys whose values the library reads as numbers.
const NUMBERS: [&str; 4] = ["ObjectType", "VendorNumber", "ProductNumber", "RevisionNumber"];

/// Returns whether a file contains `key` with an empty value.
fn is_empty(text: &str, key: &str) -> bool {
    lines(text).iter().any(|(_, line)| entry(line) == Some((key, "")))
}

/// Returns the reason why the library cannot load a file.
pub fn rejection(file: &File, error: &str) -> Option<&'static str> {
    let text = file.text();
    let has_section = |name: &str| lines(&text).iter().any(|(_, line)| header(line).is_some_and(|ours| ours.0 == name));
    let (kind, rest) = error.split_once(": ")?;
    match kind {
        "UnicodeDecodeError" => Some("E30"),
        "DuplicateOptionError" => Some("E28"),
        "DuplicateSectionError" => Some("E27"),
        "MissingSectionHeaderError" if has_section("Device Classification") || has_section("File") => Some("E78"),
        "MissingSectionHeaderError" if text.starts_with("../") => Some("E64"),
        "NoOptionError" if rest.starts_with("No option 'DataType'") => Some("E49"),
        "NoOptionError" if rest.starts_with("No option 'Dummy") => Some("E58"),
        "NoOptionError" if rest.starts_with("No option 'Line") => Some("E59"),
        "ValueError" if rest.starts_with("Cannot import from the '") => Some("files by ending"),
        "ValueError" => match rest.strip_prefix("invalid literal for int() with base 0: ")?.trim_matches('\'') {
            "" => Some("E06").filter(|_| NUMBERS.iter().any(|key| is_empty(&text, key))),
            literal if literal.contains(" #") => Some("E21"),
            literal if literal.starts_with('0') => Some("E01"),
            _ => None,
        },
        _ => None,
    }
}
