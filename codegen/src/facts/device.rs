//! Titles of devices, and modules that slots accept.

use super::number::hex32;
use crate::ir::{Device, Fit};

/// Returns the title of a device: its name, product name, order code or identifier. The text is empty if the description contains
/// none of these texts.
pub fn title(device: &Device) -> &str {
    let names = [&device.name, &device.identity.product_name, &device.identity.order_code, &device.id];
    names.into_iter().find(|name| !name.trim().is_empty()).map_or("", |name| name.as_str())
}

/// Returns the modules that a slot accepts: `module 0x00000539`, `modules of the class IO`.
pub fn fit(fit: &Fit) -> String {
    match fit {
        Fit::Ident(ident) => format!("module {}", hex32(*ident)),
        Fit::Class(class) => format!("modules of the class {class}"),
        Fit::Name(name) => name.to_string(),
    }
}
