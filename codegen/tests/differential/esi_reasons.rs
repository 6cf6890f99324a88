//! Reasons for differences between Lexibus and a plain XPath reading of ESI files. The script marks text that it cannot
//! interpret with a question mark, and the reasons check this text.

use std::collections::{HashMap, HashSet};

use super::corpus_support::File;
use super::facts::{Difference, Elements, Facts};
use super::tally::Reasons;

/// Known differences between the plain reading and Lexibus: the name of each difference, and an explanation.
const PEER: &[(&str, &str)] = &[
    ("a bare &", "libxml2 rejects a file with a `&` that starts no reference. Lexibus reads it as text."),
    ("objects twice", "It lists both objects of one index. Lexibus keeps the first and reports the second."),
    (
        "the enable byte",
        "It reads Enable as a number. Lexibus reads it as the register of ETG.1000.4, whose lowest bit enables.",
    ),
    (
        "types of mapped objects",
        "It uses the type that an entry names. Lexibus uses the type of the mapped object, if the length is equal.",
    ),
];

pub const REASONS: Reasons = Reasons {
    quirks: &["X01", "X02", "X11", "X13", "X14", "X15", "X16", "X17", "X19", "X21", "X22", "X32"],
    peer: PEER,
};

/// A file with the facts that the script and Lexibus read from it.
pub struct Case<'a> {
    text: String,
    peer: &'a Elements,
    ours: &'a Elements,
    /// PDO entries in Lexibus, keyed by the owner, index and sub-index of the mapped object.
    mapped: HashMap<(&'a str, u16, u8), Vec<&'a Facts>>,
    /// Names of devices and modules that have a dictionary.
    described: HashSet<&'a str>,
}

impl<'a> Case<'a> {
    pub fn new(file: &File, peer: &'a Elements, ours: &'a Elements) -> Self {
        let mut mapped: HashMap<_, Vec<&Facts>> = HashMap::new();
        for (name, facts) in peer {
            let Some((owner, _)) = name.split_once("xPdo ").filter(|(_, rest)| rest.contains(" entry ")) else {
                continue;
            };
            let Some((index, sub)) = address(facts) else { continue };
            let entries = mapped.entry((owner.trim_end_matches([' ', 'R', 'T']), index, sub)).or_default();
            entries.extend(ours.get(name));
        }
        let described = peer.keys().filter_map(|name| Some(name.split_once(" object ")?.0)).collect();
        Case { text: file.text(), peer, ours, mapped, described }
    }

    /// Returns the type of the object that an entry maps, as read by Lexibus.
    fn type_of_mapped(&self, entry: &str) -> Option<&str> {
        let (index, sub) = address(self.ours.get(entry)?)?;
        let (owner, _) = entry.split_once("xPdo ")?;
        let object = format!("{} object {index:04X}:{sub:02X}", owner.trim_end_matches([' ', 'R', 'T']));
        self.ours.get(&object)?.get("type").map(String::as_str)
    }
}

/// Returns the index and sub-index in the facts of an entry.
fn address(facts: &Facts) -> Option<(u16, u8)> {
    let number = |fact: &str| facts.get(fact).map_or(Some(0), |number| number.parse::<u16>().ok());
    Some((number("index")?, u8::try_from(number("sub-index")?).ok()?))
}

/// Splits an element name such as `device 0 object 1018:01` into the owner, index and sub-index.
fn object(element: &str) -> Option<(&str, u16, Option<u8>)> {
    let (owner, object) = element.split_once(" object ")?;
    let (index, sub) = object.split_once(':').map_or((object, None), |(index, sub)| (index, Some(sub)));
    let sub = match sub {
        Some(sub) => Some(u8::from_str_radix(sub, 16).ok()?),
        None => None,
    };
    Some((owner, u16::from_str_radix(index, 16).ok()?, sub))
}

pub fn reason(case: &Case<'_>, difference: &Difference<'_>) -> Option<&'static str> {
    let (element, peer, ours) = (difference.element, difference.peer, difference.ours);
    let Some(fact) = difference.fact else { return missing(case, element, ours.is_some()) };
    match fact {
        "purpose" if element.contains(" Sm ") => {
            let usual = ["MBoxOut", "MBoxIn", "Outputs", "Inputs"];
            let is_unusual = !peer.is_some_and(|text| usual.contains(&text));
            let (row, expected) = match purpose_of_pdos(case, element) {
                Some(purpose) => ("X32", Some(purpose)),
                None => ("X19", purpose(case, element)),
            };
            Some(row).filter(|_| is_unusual && ours == expected)
        }
        "enable" => {
            let byte: u8 = peer?.parse().ok()?;
            Some("the enable byte").filter(|_| byte > 1 && ours == Some("1").filter(|_| byte & 1 == 1))
        }
        "mapping" => Some("X17").filter(|_| (peer, ours) == (Some("TR"), Some("RT"))),
        "type" if long_array(case, element) == Some(1) => Some("X14"),
        "name" if long_array(case, element) == Some(1) => {
            Some("X14").filter(|_| ours.zip(peer).is_some_and(|(ours, peer)| peer == format!("{ours} 1")))
        }
        "type" => of_type(case, element, peer?, ours),
        "array" => {
            let ((peer, count), (ours, other)) = (peer?.rsplit_once('[')?, ours?.rsplit_once('[')?);
            of_type(case, element, peer, Some(ours)).filter(|_| count == other)
        }
        "bits" => of_array(case.ours.get(element)?.get("array")?, ours?),
        "default" | "low" | "high" => of_value(case, difference),
        _ => of_text(case, peer?, ours?),
    }
}

/// Returns the reason why a text differs. If a file is rejected, the text that libxml2 recovers can differ from the text in the
/// file.
fn of_text(case: &Case<'_>, peer: &str, ours: &str) -> Option<&'static str> {
    if !case.text.contains(ours) {
        return None;
    }
    let rest = ours.strip_prefix(peer);
    if rest.is_some_and(|rest| rest.starts_with('&')) {
        return Some("a bare &");
    }
    let same = |(peer, ours): (char, char)| peer == ours || peer == char::REPLACEMENT_CHARACTER;
    let is_undecoded = peer.chars().count() == ours.chars().count() && peer.chars().zip(ours.chars()).all(same);
    is_undecoded.then_some("X01")
}

/// Returns the reason why one of the readers lacks an element.
fn missing(case: &Case<'_>, element: &str, is_direct: bool) -> Option<&'static str> {
    if !is_direct {
        if element.ends_with(" again") {
            return Some("objects twice");
        }
        return long_array(case, element).filter(|&number| number > 1).map(|_| "X14");
    }
    // If a mapped object has no description, Lexibus adds the object and copies the facts of the PDO entry.
    let (owner, index, sub) = object(element)?;
    let is_mapped = match sub {
        Some(sub) => case.mapped.get(&(owner, index, sub)).is_some_and(|entries| is_as_mapped(case, element, entries)),
        None => case.mapped.keys().any(|&(other, ours, _)| other == owner && ours == index),
    };
    is_mapped.then_some(if case.described.contains(owner) { "X22" } else { "X21" })
}

/// Returns whether an object has the facts of a PDO entry that maps the object.
fn is_as_mapped(case: &Case<'_>, element: &str, entries: &[&Facts]) -> bool {
    let Some(ours) = case.ours.get(element) else { return false };
    entries.iter().any(|entry| ["name", "type"].iter().all(|fact| ours.get(*fact) == entry.get(*fact)))
}

/// Returns the purpose of a sync manager. The direction of the PDOs that name the sync manager determines the purpose,
/// if all these PDOs have the same direction.
fn purpose_of_pdos(case: &Case<'_>, element: &str) -> Option<&'static str> {
    let (owner, number) = element.split_once(" Sm ")?;
    let is_named_by = |kind: &str| {
        let start = format!("{owner} {kind} ");
        let is_pdo = |name: &str| name.strip_prefix(&start).is_some_and(|rest| !rest.contains(" entry "));
        case.peer.iter().any(|(name, facts)| is_pdo(name) && facts.get("Sm").is_some_and(|sm| sm == number))
    };
    match (is_named_by("RxPdo"), is_named_by("TxPdo")) {
        (true, false) => Some("Outputs"),
        (false, true) => Some("Inputs"),
        _ => None,
    }
}

/// Returns the purpose of a sync manager whose text does not state a purpose. The purpose follows from mode and direction in the
/// control byte. If the control byte is missing or 0, the purpose follows from the position: if the device has at least four sync
/// managers, the first two belong to the mailbox.
fn purpose(case: &Case<'_>, element: &str) -> Option<&'static str> {
    let (owner, place) = element.split_once(" Sm ")?;
    let control = case.peer.get(element)?.get("control").map_or(Some(0), |control| control.parse::<u8>().ok())?;
    let has_mailbox = case.peer.contains_key(&format!("{owner} Sm 3"));
    Some(match control & 0b1111 {
        _ if control == 0 && has_mailbox => match place {
            "0" => "MBoxOut",
            "1" => "MBoxIn",
            "2" => "Outputs",
            _ => "Inputs",
        },
        _ if control == 0 => ["Outputs", "Inputs"][usize::from(place != "0")],
        0b0110 => "MBoxOut",
        0b0010 => "MBoxIn",
        0b0100 => "Outputs",
        _ => "Inputs",
    })
}

/// Returns the number of an array element if the array has more elements than there are sub-indices. Lexibus stores such an array
/// as one value at its first sub-index, with the same element type and count.
fn long_array(case: &Case<'_>, element: &str) -> Option<u32> {
    let (object, sub) = element.rsplit_once(':')?;
    let sub = u32::from_str_radix(sub, 16).ok()?;
    let ty = |sub: u32| Some(case.peer.get(&format!("{object}:{sub:02X}"))?.get("type")?.as_str());
    let is_of =
        |peer: &str, ours: &str| peer == ours || peer.strip_prefix('?').and_then(by_name).as_deref() == Some(ours);
    let subs = case.ours.range(format!("{object}:")..format!("{object};"));
    subs.into_iter().find_map(|(name, facts)| {
        let first = u32::from_str_radix(name.rsplit_once(':')?.1, 16).ok().filter(|&first| first <= sub)?;
        let (ours, count) = facts.get("type")?.strip_suffix(']')?.split_once('[')?;
        let count: u32 = count.parse().ok().filter(|&count| count >= 255 && sub - first < count)?;
        let is_whole = ty(first + count - 1).is_some() && ty(first + count).is_none();
        (is_whole && is_of(ty(sub)?, ours)).then_some(sub - first + 1)
    })
}

/// Returns the reason why a type differs.
fn of_type(case: &Case<'_>, element: &str, peer: &str, ours: Option<&str>) -> Option<&'static str> {
    if let Some(bits) = peer.strip_prefix("?enumeration of ").and_then(|rest| rest.strip_suffix(" bits")) {
        return Some("X13").filter(|_| ours == Some(&format!("u{bits}")));
    }
    // The type name is not in the ETG tables. Lexibus must have the type that `by_name` returns.
    if let Some(name) = peer.strip_prefix('?') {
        return Some("X11").filter(|_| ours == by_name(name).as_deref());
    }
    let ours = ours?;
    let is_mapped = case.type_of_mapped(element) == Some(ours) && bits(ours).is_some();
    Some("types of mapped objects").filter(|_| is_mapped && bits(ours) == bits(peer))
}

/// Returns the length of a numeric type in bits.
fn bits(ty: &str) -> Option<u32> {
    if ty == "bool" {
        return Some(1);
    }
    ty.strip_prefix(['i', 'u', 'f'])?.parse().ok()
}

/// Returns the reason why the length of an array differs: Lexibus multiplies the length of an element by the number of elements,
/// and ignores BitSize.
fn of_array(array: &str, ours: &str) -> Option<&'static str> {
    let (element, count) = array.strip_suffix(']')?.split_once('[')?;
    let count: u32 = count.parse().ok()?;
    Some("X14").filter(|_| Some(ours) == bits(element).map(|bits| (bits * count).to_string()).as_deref())
}

/// Returns the type for a name that is not in the ETG tables, such as `UINT16` or `UDINT_hex`.
fn by_name(name: &str) -> Option<String> {
    const TABLE: [(&str, &str); 4] = [("USINT", "u8"), ("UINT", "u16"), ("UDINT", "u32"), ("INT", "i16")];
    let start = name.split_once('_').map(|(start, _)| start);
    if let Some((_, ty)) = start.and_then(|start| TABLE.iter().find(|(known, _)| *known == start)) {
        return Some((*ty).to_owned());
    }
    let sized = |prefix: &str| name.strip_prefix(prefix)?.parse::<u8>().ok();
    sized("UINT").map(|bits| format!("u{bits}")).or_else(|| sized("INT").map(|bits| format!("i{bits}")))
}

/// Returns the reason why a default or limit differs.
fn of_value(case: &Case<'_>, difference: &Difference<'_>) -> Option<&'static str> {
    let (peer, ours) = (difference.peer?, difference.ours?);
    let ty = case.peer.get(difference.element)?.get("type")?;
    let bits: u32 = ty.get(1..)?.parse().ok()?;
    let ours: i128 = ours.parse().ok()?;
    if let Some(digits) = peer.strip_prefix('?') {
        // Surplus bytes must be zero; missing bytes count as zero.
        let octet = |at: usize| u8::from_str_radix(digits.get(at..at + 2)?, 16).ok();
        let octets: Vec<u8> = (0..digits.len()).step_by(2).filter_map(octet).collect();
        let value =
            octets.iter().rev().try_fold(0i128, |value, &octet| value.checked_mul(256)?.checked_add(octet.into()));
        return Some("X15").filter(|_| value == Some(ours) && octets.len() != bits.div_ceil(8) as usize);
    }
    let peer: i128 = peer.parse().ok()?;
    let modulus = 1i128 << bits;
    Some("X16").filter(|_| match ty.as_bytes()[0] {
        b'i' => peer - ours == modulus,
        b'u' => peer == -1 && ours == modulus - 1,
        _ => false,
    })
}

/// Returns the reason why libxml2 rejects a file.
pub fn rejection(error: &str) -> Option<&'static str> {
    match error {
        _ if error.starts_with("Extra content at the end of the document") => Some("X02"),
        _ if error.starts_with("Invalid bytes in character encoding") => Some("X01"),
        _ if error.starts_with("EntityRef: expecting ';'") => Some("a bare &"),
        _ => None,
    }
}
