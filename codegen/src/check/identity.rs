//! Identity: differences between the identity of the device and object 0x1018 (CiA 301 7.5.2.21).

use super::context::Context;
use crate::diagnostics::{codes, Diagnostics};
use crate::ir::IdentityNumber;
use crate::number::hex32;
use crate::resolve::identity_in_object;

/// Reports numbers in object 0x1018 that differ from the identity of the device. The number 0 is ignored, because tools fill
/// unused fields with 0.
pub(super) fn check(context: &Context<'_>, diagnostics: &mut Diagnostics) {
    let device = context.device;
    for number in IdentityNumber::ALL {
        let in_object = identity_in_object(device, number);
        let Some((stated, (value, span))) = device.identity.number(number).zip(in_object) else { continue };
        if stated != value && value != 0 {
            let (name, value, stated) = (number.name(), hex32(value), hex32(stated));
            let message = format!("the {name} is {value} in object 0x1018, but {stated} in the device identity");
            diagnostics.push(codes::IDENTITY_MISMATCH.at(span, message).label("the device identity is used"));
        }
    }
}
