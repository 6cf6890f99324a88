//! Identity of a device: missing numbers come from object 0x1018 (CiA 301 7.5.2.19).

use crate::ir::{Device, Value};

/// Completes the identity of a device. EtherCAT devices are not changed, because a missing number in Type (ETG.2000) matches any number.
pub(super) fn run(device: &mut Device) {
    if device.ethercat.is_some() {
        return;
    }
    for number in IdentityNumber::ALL {
        let stated = number.stated(device);
        if let (None | Some(0), Some(value)) = (stated, number.in_object(device).map(|(value, _)| value)) {
            *number.stated_mut(device) = Some(value);
        }
    }
}

/// A number in the identity object 0x1018.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum IdentityNumber {
    /// Vendor ID (sub-index 1).
    Vendor,
    /// Product code (sub-index 2).
    Product,
    /// Revision number (sub-index 3).
    Revision,
}

impl IdentityNumber {
    /// All identity numbers.
    pub(crate) const ALL: [IdentityNumber; 3] =
        [IdentityNumber::Vendor, IdentityNumber::Product, IdentityNumber::Revision];

    /// Returns the name of the identity number for diagnostics.
    pub(crate) fn name(self) -> &'static str {
        match self {
            IdentityNumber::Vendor => "vendor ID",
            IdentityNumber::Product => "product code",
            IdentityNumber::Revision => "revision number",
        }
    }

    /// Returns the number that the identity of the device contains.
    pub(crate) fn stated(self, device: &Device) -> Option<u32> {
        match self {
            IdentityNumber::Vendor => device.identity.vendor_id,
            IdentityNumber::Product => device.identity.product_code,
            IdentityNumber::Revision => device.identity.revision_number,
        }
    }

    fn stated_mut(self, device: &mut Device) -> &mut Option<u32> {
        match self {
            IdentityNumber::Vendor => &mut device.identity.vendor_id,
            IdentityNumber::Product => &mut device.identity.product_code,
            IdentityNumber::Revision => &mut device.identity.revision_number,
        }
    }

    /// Returns the default value of the entry in object 0x1018, with its location.
    pub(crate) fn in_object(self, device: &Device) -> Option<(u32, crate::source::Span)> {
        let item = device.entry(0x1018, self as u8 + 1)?;
        let value = item.default.as_ref().and_then(Value::as_int)?;
        Some((u32::try_from(value).ok()?, item.at.default))
    }
}
