//! Completes the identity of a device without EtherCAT. Numbers that are missing or 0 get the default values in object
//! 0x1018 (CiA 301 7.5.2.21), if there are any.

use crate::ir::{Device, FactOrigin, Identity, IdentityNumber, Rule, Value};
use crate::source::Span;

/// Completes the identity of a device. Does not change EtherCAT devices, because a missing number in Type (ETG.2000) matches any
/// number.
pub(super) fn run(device: &mut Device) {
    if device.ethercat.is_some() {
        return;
    }
    for number in IdentityNumber::ALL {
        if let (None | Some(0), Some((value, _))) = (device.identity.number(number), in_object(device, number)) {
            *number_mut(&mut device.identity, number) = Some(value);
            device.identity.origins.push((number, FactOrigin::Rule(Rule::IdentityObject)));
        }
    }
}

fn number_mut(identity: &mut Identity, number: IdentityNumber) -> &mut Option<u32> {
    match number {
        IdentityNumber::VendorId => &mut identity.vendor_id,
        IdentityNumber::ProductCode => &mut identity.product_code,
        IdentityNumber::RevisionNumber => &mut identity.revision_number,
    }
}

/// Returns the default value of an entry in object 0x1018 with its location, if the value is an unsigned 32-bit number.
pub(crate) fn in_object(device: &Device, number: IdentityNumber) -> Option<(u32, Span)> {
    let item = device.entry(0x1018, number as u8 + 1)?;
    let value = item.default.as_ref().and_then(Value::as_int)?;
    Some((u32::try_from(value).ok()?, item.at.default))
}
