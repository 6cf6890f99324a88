//! After this pass a device has the identity that its header and object 0x1018 agree on (CiA 301 7.5.2.19).

use crate::diagnostics::{codes, Diagnostic, Diagnostics};
use crate::ir::{Device, Value};

pub(super) fn run(device: &mut Device, diagnostics: &mut Diagnostics) {
    let from_object = |device: &Device, sub| {
        let item = device.entry(0x1018, sub)?;
        let value = item.default.as_ref().and_then(Value::as_int)?;
        Some((u32::try_from(value).ok()?, item.at.default))
    };
    // The numbers of ETG.2000's Type select the device, also where they are zero, and one that is missing fits any.
    let as_given = device.ethercat.is_some();
    for (sub, name) in [(1, "vendor number"), (2, "product code"), (3, "revision number")] {
        let object = from_object(device, sub);
        let header = match sub {
            1 => &mut device.identity.vendor_id,
            2 => &mut device.identity.product_code,
            _ => &mut device.identity.revision_number,
        };
        let Some((value, span)) = object else { continue };
        match *header {
            None if as_given => {}
            None => *header = Some(value),
            // Zero is how tools fill a field that nobody filled in.
            Some(announced) if announced != value && (announced != 0 || as_given) && value != 0 => {
                diagnostics.push(
                    Diagnostic::new(
                        &codes::IDENTITY_MISMATCH,
                        span,
                        format!("the {name} in 0x1018 is {value:#x}, the one of the device {announced:#x}"),
                    )
                    .label("the device's is used"),
                );
            }
            Some(0) => *header = Some(value),
            Some(_) => {}
        }
    }
}
