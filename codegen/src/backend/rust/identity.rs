//! The identity of a device.

use super::code::{Data, Doc};
use super::docs::WORDS;
use super::literal;
use crate::ir::Device;
use crate::number::hex32;

/// Numbers and names of a device's identity as literals, ready to be printed.
pub(super) struct IdentityModel {
    pub vendor_id: Doc,
    pub product_code: Doc,
    pub revision_number: Doc,
    pub vendor_name: String,
    pub product_name: String,
    pub order_code: String,
    /// Sentences that state the origin of each number that does not come from the header of the description.
    pub origins: Vec<String>,
}

impl IdentityModel {
    pub(super) fn new(device: &Device) -> Self {
        let identity = &device.identity;
        let number = |value: Option<u32>| Data::option(value.map(hex32));
        IdentityModel {
            vendor_id: number(identity.vendor_id),
            product_code: number(identity.product_code),
            revision_number: number(identity.revision_number),
            vendor_name: literal::string(&identity.vendor_name),
            product_name: literal::string(&identity.product_name),
            order_code: literal::string(&identity.order_code),
            origins: WORDS.identity_origins(identity),
        }
    }
}
