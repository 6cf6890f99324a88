//! Why a plain reading with XPath and Lexibus may differ on GSDML files.

use lexibus_codegen::compile::Compilation;

use super::facts::{Difference, Elements};
use super::tally::Reasons;

/// What the plain reading does in a way of its own, with a sentence each.
const PEER: &[(&str, &str)] = &[
    ("attributes in another case", "To XML, `VendorId` isn't `VendorID`; Lexibus reads it, and says so."),
    ("submodules out of place", "It lists a SubmoduleItem among virtual ones, which Lexibus keeps as attributes only."),
];

pub const REASONS: Reasons = Reasons { quirks: &["G01", "G12", "G15"], peer: PEER };

/// A file, and what both read from it.
pub struct Case<'a> {
    pub text: String,
    pub peer: &'a Elements,
}

pub fn reason(case: &Case<'_>, difference: &Difference<'_>) -> Option<&'static str> {
    let (element, peer, own) = (difference.element, difference.peer, difference.own);
    let Some(fact) = difference.fact else { return missing(case, element, own.is_some()) };
    match (peer, own) {
        (Some(peer), Some(own)) => Some("G01").filter(|_| is_misdeclared(peer, own)),
        (None, Some(own)) if fact == "name" => {
            let mut translations = case.peer.get(element)?.iter().filter(|(name, _)| name.starts_with("name "));
            Some("G12").filter(|_| translations.any(|(_, text)| text == own))
        }
        (None, Some(own)) => {
            let attribute = match fact {
                "vendor number" => "VendorId=\"0x",
                "device number" => "DeviceId=\"0x",
                _ => return None,
            };
            let digits = case.text.split_once(attribute)?.1.split('"').next()?;
            let number = u32::from_str_radix(digits, 16).ok()?;
            Some("attributes in another case").filter(|_| own == number.to_string())
        }
        _ => None,
    }
}

/// UTF-8 that declares ISO 8859-1: the declaration made a character of each byte.
fn is_misdeclared(peer: &str, own: &str) -> bool {
    let bytes: Option<Vec<u8>> = peer.chars().map(|letter| u8::try_from(u32::from(letter)).ok()).collect();
    bytes.is_some_and(|bytes| bytes == own.as_bytes())
}

/// What only the plain reading has: a submodule in a list of another kind, and that its owner holds it.
fn missing(case: &Case<'_>, element: &str, is_own: bool) -> Option<&'static str> {
    let is_misplaced = |holder: &str| case.peer.get(holder)?.get("fixed").filter(|fixed| *fixed == "?").map(|_| ());
    let number = element.strip_prefix("submodule ");
    let holders = case.peer.keys().filter(|key| match number {
        Some(number) => key.rsplit_once(" holds ").is_some_and(|(_, held)| held == number),
        None => *key == element,
    });
    let is_misplaced = !is_own && holders.into_iter().any(|holder| is_misplaced(holder).is_some());
    is_misplaced.then_some("submodules out of place")
}

/// A file that isn't well-formed is none to Lexibus either.
pub fn rejection(compilation: &Compilation) -> Option<&'static str> {
    compilation.catalog.is_none().then_some("G15")
}
