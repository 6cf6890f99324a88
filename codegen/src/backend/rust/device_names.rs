//! Names of a device: its title and the names of its type, module and file.

use super::literal;
use crate::ir::{Device, FileInfo};
use crate::names::{self, Case, NameRequest};

/// Names that the type of a device must not have: the keyword `Self`, names that the generated code uses, and names of
/// constructors, because clippy reports a constructor that has the name of its type.
const RESERVED: [&str; 8] = ["Self", "C", "S", "X", "Option", "Result", "New", "On"];

/// Names that the module of a file must not have.
const RESERVED_FOR_FILE: [&str; 4] = ["self", "super", "crate", "rt"];

/// Returns the file name without folders. Spaces replace characters that could mislead a reader.
pub(super) fn file_name(file: &FileInfo) -> String {
    let name = crate::text::file_name(&file.name);
    name.chars().map(|letter| if literal::is_harmless(letter) { letter } else { ' ' }).collect()
}

/// Returns the title of the device in documentation.
pub(super) fn title(device: &Device) -> String {
    let identity = &device.identity;
    match (identity.vendor_name.is_empty(), device.name.is_empty()) {
        (false, false) => format!("{} {}", identity.vendor_name, device.name),
        (true, false) => device.name.to_string(),
        (false, true) => format!("an unnamed device by {}", identity.vendor_name),
        (true, true) => "the device".to_owned(),
    }
}

/// Returns the name of the device's type. The name comes from the first of these sources that contains a name: the
/// chosen name, the order code of an EtherCAT device, the device's name, the file name, and the word `device`.
pub(super) fn device_name(device: &Device, file: &FileInfo, chosen: Option<&str>) -> String {
    name_of(device, file, chosen, Case::Pascal)
}

/// Returns the name of the module for `device`: the default name of its type in snake case.
pub fn module_name(device: &Device, file: &FileInfo) -> String {
    name_of(device, file, None, Case::Snake)
}

fn name_of(device: &Device, file: &FileInfo, chosen: Option<&str>, case: Case) -> String {
    let stem = file_name(file);
    let stem = stem.rsplit_once('.').map_or(stem.as_str(), |(stem, _)| stem);
    // Engineers usually know an EtherCAT device by its order code. The name of the device in its ESI file is often a
    // long phrase.
    let short = if device.ethercat.is_some() { device.identity.order_code.as_str() } else { "" };
    let names = [chosen.unwrap_or(""), short, &device.name, stem, "device"];
    let name_request = |name| NameRequest { name, fallback: String::new(), suffix: "Device".into() };
    let candidates = names.iter().map(|name| names::unique([name_request(*name)], &RESERVED, case).remove(0));
    let name = candidates.into_iter().find(|name| !name.is_empty() && name != "_device").unwrap_or_default();
    names::escaped(&name)
}

/// Returns the name of the generated file for an input file: the words of `stem` in snake case. `stem` is the name of
/// the input file without its extension. Returns `None` if `stem` has no words.
pub fn stem_name(stem: &str) -> Option<String> {
    let name_request = NameRequest { name: stem, fallback: String::new(), suffix: "device".into() };
    let name = names::unique([name_request], &RESERVED_FOR_FILE, Case::Snake).remove(0);
    (!name.is_empty()).then_some(name)
}
