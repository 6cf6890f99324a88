//! Identity: the numbers of the device against object 0x1018 (CiA 301 7.5.2.19).

use super::context::Context;
use crate::diagnostics::{codes, Diagnostics};
use crate::resolve::IdentityNumber;

/// Reports numbers of object 0x1018 that are not those of the device. Tools fill an unused field with zero.
pub(super) fn check(context: &Context<'_>, diagnostics: &mut Diagnostics) {
    let device = context.device;
    for number in IdentityNumber::ALL {
        let (Some(stated), Some((value, span))) = (number.stated(device), number.in_object(device)) else { continue };
        if stated != value && value != 0 {
            let name = number.name();
            let message = format!("the {name} in 0x1018 is {value:#x}, the one of the device {stated:#x}");
            diagnostics.push(codes::IDENTITY_MISMATCH.at(span, message).label("the device's is used"));
        }
    }
}
