//! What a device is called.

use crate::ir::Device;

/// The title of a device: the first of its name, that of its product, its order code and its identifier; empty if it has none of them.
pub fn title(device: &Device) -> &str {
    let names = [&device.name, &device.identity.product_name, &device.identity.order_code, &device.id];
    names.into_iter().find(|name| !name.trim().is_empty()).map_or("", |name| name.as_str())
}
