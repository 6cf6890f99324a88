//! Formats the addresses of an item for documentation.

use super::{Field, ItemAddresses};
use crate::backend::rust::route::{Route, RouteBus};
use crate::backend::rust::scope::Scope;
use crate::backend::rust::words::escape;
use crate::facts::register;
use crate::ir::{Item, RegisterSpace};
use crate::number::{self, hex16};

impl ItemAddresses<'_> {
    /// Returns the addresses of an item in words. Names in an ASCII protocol and addresses in the memory of a slave
    /// controller are left out.
    pub fn facts(&self, scope: &Scope<'_>, item: &Item) -> String {
        let object = |(index, sub)| number::object(index, sub);
        let mut facts = Vec::new();
        match (self.canopen, self.coe) {
            (Some(canopen), Some(coe)) if canopen != coe => {
                facts.push(format!("{} on CANopen", object(canopen)));
                facts.push(format!("{} on EtherCAT", object(coe)));
            }
            (canopen, coe) => facts.extend(canopen.or(coe).map(object)),
        }
        let tables = scope.device.map_or(&[][..], |device| &device.modbus);
        facts.extend(
            self.modbus
                .map(|register_binding| format!("Modbus {}", escape(&register::text(register_binding, item, tables)))),
        );
        facts.extend(self.serial.map(|code| format!("parameter {}", hex16(code))));
        facts.extend(self.image.map(|field| field.facts()));
        facts.extend(self.number_in_words());
        facts.join(", ")
    }

    /// Returns the main addresses of an item in short form.
    pub fn heading(&self) -> String {
        let object = self.canopen.or(self.coe).map(|(index, sub)| number::object(index, sub));
        let register = self.modbus.map(|register_binding| match register_binding.bit_offset {
            Some(bit) => format!("register {} from bit {bit}", escape(&register::printed(register_binding))),
            None => format!("register {}", escape(&register::printed(register_binding))),
        });
        let serial = self.serial.map(|code| format!("parameter {}", hex16(code)));
        let found: Vec<String> = object.into_iter().chain(register).chain(serial).collect();
        if !found.is_empty() {
            return found.join(", ");
        }
        let memory = self.esc.map(|(address, _)| format!("memory {}", hex16(address)));
        self.image.map(|field| field.facts()).or(memory).or(self.number_in_words()).unwrap_or_default()
    }

    /// Returns a text with the number that selects the item in a window, and the buses on which clients use a window.
    fn number_in_words(&self) -> Option<String> {
        let number = self.number()?;
        let window = |route: &Route<'_>| route.access_paths().find_map(|access_path| access_path.window);
        let windowed = RouteBus::ALL.iter().zip(&self.routes).filter(|(_, route)| window(route).is_some());
        let windowed: Vec<&str> = windowed.map(|(bus, _)| bus.title()).collect();
        Some(format!("indirect access with number {} ({})", hex16(number), windowed.join(", ")))
    }

    /// Returns the number that selects the item in a window, if clients access the item through a window.
    fn number(&self) -> Option<u32> {
        self.routes
            .iter()
            .flat_map(Route::access_paths)
            .find_map(|access_path| access_path.window)
            .map(|(_, number)| number)
    }

    /// Returns a suffix that distinguishes the item from other items with the same name.
    pub fn suffix(&self) -> String {
        match (self.modbus, self.canopen.or(self.coe), self.serial) {
            (Some(register), _, _) => {
                // Registers in different Modbus tables can have the same address.
                let table = match register.space {
                    RegisterSpace::Holding => "",
                    RegisterSpace::Input => "input_",
                    RegisterSpace::Coil => "coil_",
                    RegisterSpace::DiscreteInput => "discrete_",
                };
                match register.bit_offset {
                    Some(bit) => format!("{table}{}_{bit}", register.address),
                    None => format!("{table}{}", register.address),
                }
            }
            (None, Some((index, sub)), _) => format!("{index:04X}_{sub}"),
            (None, None, Some(code)) => code.to_string(),
            (None, None, None) => match (self.image, self.esc) {
                (Some(field), _) => format!("{}_{}", field.image, field.first),
                (None, Some((address, _))) => format!("{address:04X}"),
                (None, None) => self.number().map_or_else(|| "0".to_owned(), |number| format!("{number:04X}")),
            },
        }
    }
}

impl Field<'_> {
    fn facts(self) -> String {
        let (byte, bit) = (self.first / 8, self.first % 8);
        let last = (self.first + self.bits.max(1) - 1) / 8;
        let bits = match (bit, self.bits % 8) {
            (0, 0) if byte == last => format!("byte {byte}"),
            (0, 0) => format!("bytes {byte} to {last}"),
            _ if self.bits == 1 => format!("bit {bit} of byte {byte}"),
            _ => format!("{} bits from bit {bit} of byte {byte}", self.bits),
        };
        format!("{bits} of the process image {}", escape(self.image))
    }
}
