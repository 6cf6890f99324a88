//! What a device is called, and what fits into its slots.

use super::number::hex32;
use crate::ir::{Device, Fit};

/// The title of a device: the first of its name, that of its product, its order code and its identifier; empty if it has none of them.
pub fn title(device: &Device) -> &str {
    let names = [&device.name, &device.identity.product_name, &device.identity.order_code, &device.id];
    names.into_iter().find(|name| !name.trim().is_empty()).map_or("", |name| name.as_str())
}

/// What fits into a slot: `module 0x00000539`, `modules of the class IO`.
pub fn fit(fit: &Fit) -> String {
    match fit {
        Fit::Ident(ident) => format!("module {}", hex32(*ident)),
        Fit::Class(class) => format!("modules of the class {class}"),
        Fit::Name(name) => name.to_string(),
    }
}
