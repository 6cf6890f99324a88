//! Why a plain reading with XPath and Lexibus may differ on ESI files. What the script makes nothing of it gives as it is,
//! behind a question mark: reasons look at that text.

use std::collections::{HashMap, HashSet};

use super::corpus_support::File;
use super::facts::{Difference, Elements, Facts};
use super::tally::Reasons;

/// What the plain reading does in a way of its own, with a sentence each.
const PEER: &[(&str, &str)] = &[
    ("a bare &", "libxml2 rejects a file with a `&` that starts no reference; Lexibus reads it as what it is."),
    ("objects twice", "It lists both objects of one index; Lexibus keeps the first, and says so."),
    (
        "the enable byte",
        "It takes Enable as a number; Lexibus as the register of ETG.1000.4, whose lowest bit enables.",
    ),
    (
        "types of mapped objects",
        "It takes the type that an entry names; Lexibus the mapped object's of the same length.",
    ),
];

pub const REASONS: Reasons = Reasons {
    quirks: &["X01", "X02", "X11", "X13", "X14", "X15", "X16", "X17", "X19", "X21", "X22", "X32"],
    peer: PEER,
};

/// A file, and what both read from it.
pub struct Case<'a> {
    text: String,
    peer: &'a Elements,
    own: &'a Elements,
    /// The entries of PDOs as Lexibus has them, by the object that they map: owner, index and sub-index.
    mapped: HashMap<(&'a str, u16, u8), Vec<&'a Facts>>,
    /// Devices and modules with a dictionary.
    described: HashSet<&'a str>,
}

impl<'a> Case<'a> {
    pub fn new(file: &File, peer: &'a Elements, own: &'a Elements) -> Self {
        let mut mapped: HashMap<_, Vec<&Facts>> = HashMap::new();
        for (name, facts) in peer {
            let Some((owner, _)) = name.split_once("xPdo ").filter(|(_, rest)| rest.contains(" entry ")) else {
                continue;
            };
            let Some((index, sub)) = address(facts) else { continue };
            let entries = mapped.entry((owner.trim_end_matches([' ', 'R', 'T']), index, sub)).or_default();
            entries.extend(own.get(name));
        }
        let described = peer.keys().filter_map(|name| Some(name.split_once(" object ")?.0)).collect();
        Case { text: file.text(), peer, own, mapped, described }
    }

    /// The type that Lexibus has for the object that an entry maps.
    fn type_of_mapped(&self, entry: &str) -> Option<&str> {
        let (index, sub) = address(self.own.get(entry)?)?;
        let (owner, _) = entry.split_once("xPdo ")?;
        let object = format!("{} object {index:04X}:{sub:02X}", owner.trim_end_matches([' ', 'R', 'T']));
        self.own.get(&object)?.get("type").map(String::as_str)
    }
}

/// The index and sub-index of an entry.
fn address(facts: &Facts) -> Option<(u16, u8)> {
    let number = |fact: &str| facts.get(fact).map_or(Some(0), |number| number.parse::<u16>().ok());
    Some((number("index")?, u8::try_from(number("sub-index")?).ok()?))
}

/// `device 0 object 1018:01`, taken apart.
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
    let (element, peer, own) = (difference.element, difference.peer, difference.own);
    let Some(fact) = difference.fact else { return missing(case, element, own.is_some()) };
    match fact {
        "purpose" if element.contains(" Sm ") => {
            let usual = ["MBoxOut", "MBoxIn", "Outputs", "Inputs"];
            let is_unusual = !peer.is_some_and(|text| usual.contains(&text));
            let (row, expected) = match purpose_of_pdos(case, element) {
                Some(purpose) => ("X32", Some(purpose)),
                None => ("X19", purpose(case, element)),
            };
            Some(row).filter(|_| is_unusual && own == expected)
        }
        "enable" => {
            let byte: u8 = peer?.parse().ok()?;
            Some("the enable byte").filter(|_| byte > 1 && own == Some("1").filter(|_| byte & 1 == 1))
        }
        "mapping" => Some("X17").filter(|_| (peer, own) == (Some("TR"), Some("RT"))),
        "type" if long_array(case, element) == Some(1) => Some("X14"),
        "name" if long_array(case, element) == Some(1) => {
            Some("X14").filter(|_| own.zip(peer).is_some_and(|(own, peer)| peer == format!("{own} 1")))
        }
        "type" => of_type(case, element, peer?, own),
        "array" => {
            let ((peer, count), (own, other)) = (peer?.rsplit_once('[')?, own?.rsplit_once('[')?);
            of_type(case, element, peer, Some(own)).filter(|_| count == other)
        }
        "bits" => of_array(case.own.get(element)?.get("array")?, own?),
        "default" | "low" | "high" => of_value(case, difference),
        _ => of_text(case, peer?, own?),
    }
}

/// Why a text is another one, of what libxml2 recovered from a file that it rejects: it is as it stands in the file.
fn of_text(case: &Case<'_>, peer: &str, own: &str) -> Option<&'static str> {
    if !case.text.contains(own) {
        return None;
    }
    let rest = own.strip_prefix(peer);
    if rest.is_some_and(|rest| rest.starts_with('&')) {
        return Some("a bare &");
    }
    let same = |(peer, own): (char, char)| peer == own || peer == char::REPLACEMENT_CHARACTER;
    let is_undecoded = peer.chars().count() == own.chars().count() && peer.chars().zip(own.chars()).all(same);
    is_undecoded.then_some("X01")
}

/// What one of the two doesn't have at all.
fn missing(case: &Case<'_>, element: &str, is_own: bool) -> Option<&'static str> {
    if !is_own {
        if element.ends_with(" again") {
            return Some("objects twice");
        }
        return long_array(case, element).filter(|&number| number > 1).map(|_| "X14");
    }
    // A mapped object that nothing describes: Lexibus adds it, with what the entry says.
    let (owner, index, sub) = object(element)?;
    let is_mapped = match sub {
        Some(sub) => case.mapped.get(&(owner, index, sub)).is_some_and(|entries| is_as_mapped(case, element, entries)),
        None => case.mapped.keys().any(|&(other, own, _)| other == owner && own == index),
    };
    is_mapped.then_some(if case.described.contains(owner) { "X22" } else { "X21" })
}

/// Whether an object is what one of the entries that map it says.
fn is_as_mapped(case: &Case<'_>, element: &str, entries: &[&Facts]) -> bool {
    let Some(own) = case.own.get(element) else { return false };
    entries.iter().any(|entry| ["name", "type"].iter().all(|fact| own.get(*fact) == entry.get(*fact)))
}

/// What a sync manager is for according to the PDOs that name it, if they have one direction.
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

/// What a sync manager is for where its text doesn't say it: by the mode and the direction in its control byte, or by its
/// place, at which the two of a mailbox come first.
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

/// The number of an element of an array of more elements than there are sub-indices, which Lexibus keeps as one value at the
/// place of the first. It has the type of the elements, and as many as the plain reading.
fn long_array(case: &Case<'_>, element: &str) -> Option<u32> {
    let (object, sub) = element.rsplit_once(':')?;
    let sub = u32::from_str_radix(sub, 16).ok()?;
    let ty = |sub: u32| Some(case.peer.get(&format!("{object}:{sub:02X}"))?.get("type")?.as_str());
    let is_of = |peer: &str, own: &str| peer == own || peer.strip_prefix('?').and_then(by_name).as_deref() == Some(own);
    let subs = case.own.range(format!("{object}:")..format!("{object};"));
    subs.into_iter().find_map(|(name, facts)| {
        let first = u32::from_str_radix(name.rsplit_once(':')?.1, 16).ok().filter(|&first| first <= sub)?;
        let (own, count) = facts.get("type")?.strip_suffix(']')?.split_once('[')?;
        let count: u32 = count.parse().ok().filter(|&count| count >= 255 && sub - first < count)?;
        let is_whole = ty(first + count - 1).is_some() && ty(first + count).is_none();
        (is_whole && is_of(ty(sub)?, own)).then_some(sub - first + 1)
    })
}

/// Why a type is another one.
fn of_type(case: &Case<'_>, element: &str, peer: &str, own: Option<&str>) -> Option<&'static str> {
    if let Some(bits) = peer.strip_prefix("?enumeration of ").and_then(|rest| rest.strip_suffix(" bits")) {
        return Some("X13").filter(|_| own == Some(&format!("u{bits}")));
    }
    // What no name says is opaque, which is no type here.
    if let Some(name) = peer.strip_prefix('?') {
        return Some("X11").filter(|_| own == by_name(name).as_deref());
    }
    let own = own?;
    let is_mapped = case.type_of_mapped(element) == Some(own) && bits(own).is_some();
    Some("types of mapped objects").filter(|_| is_mapped && bits(own) == bits(peer))
}

/// The length in bits of a type of numbers.
fn bits(ty: &str) -> Option<u32> {
    if ty == "bool" {
        return Some(1);
    }
    ty.strip_prefix(['i', 'u', 'f'])?.parse().ok()
}

/// Why an array is as long as its elements together, and not as its BitSize says.
fn of_array(array: &str, own: &str) -> Option<&'static str> {
    let (element, count) = array.strip_suffix(']')?.split_once('[')?;
    let count: u32 = count.parse().ok()?;
    Some("X14").filter(|_| Some(own) == bits(element).map(|bits| (bits * count).to_string()).as_deref())
}

/// What a name outside the tables can only mean: `UINT16`, or `UDINT_hex`.
fn by_name(name: &str) -> Option<String> {
    const TABLE: [(&str, &str); 4] = [("USINT", "u8"), ("UINT", "u16"), ("UDINT", "u32"), ("INT", "i16")];
    let start = name.split_once('_').map(|(start, _)| start);
    if let Some((_, ty)) = start.and_then(|start| TABLE.iter().find(|(known, _)| *known == start)) {
        return Some((*ty).to_owned());
    }
    let sized = |prefix: &str| name.strip_prefix(prefix)?.parse::<u8>().ok();
    sized("UINT").map(|bits| format!("u{bits}")).or_else(|| sized("INT").map(|bits| format!("i{bits}")))
}

/// Why a default or a limit is another one.
fn of_value(case: &Case<'_>, difference: &Difference<'_>) -> Option<&'static str> {
    let (peer, own) = (difference.peer?, difference.own?);
    let ty = case.peer.get(difference.element)?.get("type")?;
    let bits: u32 = ty.get(1..)?.parse().ok()?;
    let own: i128 = own.parse().ok()?;
    if let Some(digits) = peer.strip_prefix('?') {
        // Of bytes that are too many the zeros behind the value say nothing, and those that are missing are zeros.
        let octet = |at: usize| u8::from_str_radix(digits.get(at..at + 2)?, 16).ok();
        let octets: Vec<u8> = (0..digits.len()).step_by(2).filter_map(octet).collect();
        let value =
            octets.iter().rev().try_fold(0i128, |value, &octet| value.checked_mul(256)?.checked_add(octet.into()));
        return Some("X15").filter(|_| value == Some(own) && octets.len() != bits.div_ceil(8) as usize);
    }
    let peer: i128 = peer.parse().ok()?;
    let modulus = 1i128 << bits;
    Some("X16").filter(|_| match ty.as_bytes()[0] {
        b'i' => peer - own == modulus,
        b'u' => peer == -1 && own == modulus - 1,
        _ => false,
    })
}

/// Why libxml2 rejects a file.
pub fn rejection(error: &str) -> Option<&'static str> {
    match error {
        _ if error.starts_with("Extra content at the end of the document") => Some("X02"),
        _ if error.starts_with("Invalid bytes in character encoding") => Some("X01"),
        _ if error.starts_with("EntityRef: expecting ';'") => Some("a bare &"),
        _ => None,
    }
}
