//! Reasons for differences between Lexibus and a plain XPath reading of GSDML files.

use lexibus_codegen::compile::Compilation;

use super::facts::{Difference, Elements};
use super::tally::Reasons;

/// Known differences between the plain reading and Lexibus: the name of each difference, and an explanation.
const PEER: &[(&str, &str)] = &[
    ("attributes in another case", "In XML, `VendorId` and `VendorID` differ. Lexibus reads and reports both."),
    (
        "submodules out of place",
        "It lists a SubmoduleItem among virtual submodules. Lexibus keeps it only as attributes.",
    ),
];

pub const REASONS: Reasons = Reasons { quirks: &["G01", "G12", "G15"], peer: PEER };

/// A file with the facts that the script and Lexibus read from it.
pub struct Case<'a> {
    pub text: String,
    pub peer: &'a Elements,
}

pub fn reason(case: &Case<'_>, difference: &Difference<'_>) -> Option<&'static str> {
    let (element, peer, ours) = (difference.element, difference.peer, difference.ours);
    let Some(fact) = difference.fact else { return missing(case, element, ours.is_some()) };
    match (peer, ours) {
        (Some(peer), Some(ours)) => Some("G01").filter(|_| is_misdeclared(peer, ours)),
        (None, Some(ours)) if fact == "name" => {
            let mut translations = case.peer.get(element)?.iter().filter(|(name, _)| name.starts_with("name "));
            Some("G12").filter(|_| translations.any(|(_, text)| text == ours))
        }
        (None, Some(ours)) => {
            let attribute = match fact {
                "vendor number" => "VendorId=\"0x",
                "device number" => "DeviceId=\"0x",
                _ => return None,
            };
            let digits = case.text.split_once(attribute)?.1.split('"').next()?;
            let number = u32::from_str_radix(digits, 16).ok()?;
            Some("attributes in another case").filter(|_| ours == number.to_string())
        }
        _ => None,
    }
}

/// Returns whether a UTF-8 text was decoded as ISO 8859-1 because the file declares this encoding.
fn is_misdeclared(peer: &str, ours: &str) -> bool {
    let bytes: Option<Vec<u8>> = peer.chars().map(|letter| u8::try_from(u32::from(letter)).ok()).collect();
    bytes.is_some_and(|bytes| bytes == ours.as_bytes())
}

/// Returns the reason why only the plain reading has an element: the file lists a submodule among submodules of another kind.
fn missing(case: &Case<'_>, element: &str, is_direct: bool) -> Option<&'static str> {
    let is_misplaced = |holder: &str| case.peer.get(holder)?.get("fixed").filter(|fixed| *fixed == "?").map(|_| ());
    let number = element.strip_prefix("submodule ");
    let holders = case.peer.keys().filter(|key| match number {
        Some(number) => key.rsplit_once(" holds ").is_some_and(|(_, held)| held == number),
        None => *key == element,
    });
    let is_misplaced = !is_direct && holders.into_iter().any(|holder| is_misplaced(holder).is_some());
    is_misplaced.then_some("submodules out of place")
}

/// Returns the reason for a file that the independent reader rejects: if Lexibus also rejects the file, the file is not
/// well-formed.
pub fn rejection(compilation: &Compilation) -> Option<&'static str> {
    compilation.catalog.is_none().then_some("G15")
}
