//! The identity of a device.

use super::code::{Data, Declaration, Doc};
use super::docs::WORDS;
use super::literal;
use crate::ir::Device;
use crate::number::hex32;

/// Fields of the constant `IDENTITY`: numbers, followed by names.
const FIELDS: [&str; 6] = ["vendor_id", "product_code", "revision_number", "vendor_name", "product_name", "order_code"];

/// Returns the constant `IDENTITY` of a device, whose documentation contains its title and the origin of each number that
/// does not come from the header of the description.
pub(super) fn constant(device: &Device, title: &str) -> Declaration {
    let identity = &device.identity;
    let numbers = [identity.vendor_id, identity.product_code, identity.revision_number];
    let names = [&identity.vendor_name, &identity.product_name, &identity.order_code].map(|name| name.as_str());
    let title = format!("Identity of {title}: vendor, product and revision.");
    let sentences: Vec<String> = [title].into_iter().chain(WORDS.identity_origins(identity)).collect();
    with(sentences.join(" "), numbers.map(|number| number.map(hex32)), names)
}

/// Returns the constant `IDENTITY` with these numbers and names. `numbers` are literals.
pub(super) fn with(docs: String, numbers: [Option<String>; 3], names: [&str; 3]) -> Declaration {
    let names = names.map(|name| Doc::from(literal::string(name)));
    let values = numbers.map(Data::option).into_iter().chain(names);
    Declaration::new(
        [docs],
        "const IDENTITY: rt::Identity",
        Data::fields("rt::Identity", FIELDS.into_iter().zip(values)),
    )
}
