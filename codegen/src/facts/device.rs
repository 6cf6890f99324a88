//! Titles, families and buses of devices, and modules that slots accept.

use super::words::bus_names;
use crate::ir::{Bus, Catalog, Device, Fit};
use crate::number::hex32;

/// Returns the title of a device: its name, product name, order code or identifier. The text is empty if the description contains
/// none of these texts.
pub fn title(device: &Device) -> &str {
    let names = [&device.name, &device.identity.product_name, &device.identity.order_code, &device.id];
    names.into_iter().find(|name| !name.trim().is_empty()).map_or("", |name| name.as_str())
}

/// Returns the name of the device's family. The text is empty if the description states none.
pub fn family<'d>(catalog: &'d Catalog, device: &'d Device) -> &'d str {
    let group = device.ethercat.as_ref().map(|settings| &settings.group).filter(|group| !group.is_empty());
    if let Some(group) = group {
        let named = group.id.and_then(|id| catalog.families.get(id.0 as usize));
        return named.map_or(group, |family| &family.name);
    }
    device.profinet.as_ref().map_or("", |settings| match settings.family.1.as_str() {
        "" => settings.family.0.as_str(),
        product => product,
    })
}

/// Returns the names of the buses of a device: `CANopen and Modbus`.
pub fn buses(device: &Device) -> String {
    let buses = [
        (device.canopen.is_some(), Bus::CanOpen),
        (device.ethercat.is_some(), Bus::EtherCat),
        (device.profinet.is_some(), Bus::Profinet),
        (!device.modbus.is_empty(), Bus::Modbus),
        (device.framing.is_some(), Bus::Serial),
    ];
    bus_names(buses.into_iter().filter(|(has, _)| *has).map(|(_, bus)| bus).collect())
}

/// Returns the modules that a slot accepts: `module 0x00000539`, `modules of the class IO`.
pub fn fit(fit: &Fit) -> String {
    match fit {
        Fit::Ident(ident) => format!("module {}", hex32(*ident)),
        Fit::Class(class) => format!("modules of the class {class}"),
        Fit::Name(name) => name.to_string(),
    }
}
