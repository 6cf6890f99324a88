//! What a device goes by: its title, and the names of its type, its module and its file.

use super::literal;
use crate::ir::{Device, FileInfo};
use crate::names::{self, Case, Wish};

/// The generated module uses these names itself, or has functions of which clippy would say that they are called like the type.
const RESERVED: [&str; 8] = ["Self", "C", "S", "X", "Option", "Result", "New", "On"];

/// Names that a file's module can't have.
const RESERVED_FOR_FILE: [&str; 4] = ["self", "super", "crate", "rt"];

/// The file's own name, without the folders that lead to it on this machine.
pub(super) fn file_name(file: &FileInfo) -> String {
    let name = file.name.rsplit(['/', '\\']).next().unwrap_or(&file.name);
    name.chars().map(|letter| if literal::is_harmless(letter) { letter } else { ' ' }).collect()
}

/// What documentation calls the device.
pub(super) fn title(device: &Device) -> String {
    let identity = &device.identity;
    match (identity.vendor_name.is_empty(), device.name.is_empty()) {
        (false, false) => format!("{} {}", identity.vendor_name, device.name),
        (true, false) => device.name.to_string(),
        (false, true) => format!("a device of {}", identity.vendor_name),
        (true, true) => "the device".to_owned(),
    }
}

/// The name of the device's type: the caller's, the product's, or the file's.
pub(super) fn device_name(device: &Device, file: &FileInfo, chosen: Option<&str>) -> String {
    name_of(device, file, chosen, Case::Pascal)
}

/// The name of the device's module.
pub(super) fn module_name(device: &Device, file: &FileInfo) -> String {
    name_of(device, file, None, Case::Snake)
}

fn name_of(device: &Device, file: &FileInfo, chosen: Option<&str>, case: Case) -> String {
    let stem = file_name(file);
    let stem = stem.rsplit_once('.').map_or(stem.as_str(), |(stem, _)| stem);
    // The order code of a slave is what people call it; its name is a sentence.
    let short = if device.ethercat.is_some() { device.identity.order_code.as_str() } else { "" };
    let names = [chosen.unwrap_or(""), short, &device.name, stem, "device"];
    let wish = |name| Wish { name, fallback: String::new(), suffix: "Device".into() };
    let candidates = names.iter().map(|name| names::unique(&[wish(*name)], &RESERVED, case).remove(0));
    let name = candidates.into_iter().find(|name| !name.is_empty() && name != "_device").unwrap_or_default();
    names::escaped(&name)
}

/// A file's stem as the name of a module.
pub(super) fn stem_name(stem: &str) -> Option<String> {
    let wish = Wish { name: stem, fallback: String::new(), suffix: "device".into() };
    let name = names::unique(&[wish], &RESERVED_FOR_FILE, Case::Snake).remove(0);
    (!name.is_empty()).then_some(name)
}
