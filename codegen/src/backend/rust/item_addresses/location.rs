//! Generates the code that creates the location of an item.

use super::ItemAddresses;
use crate::backend::rust::code::{call, list, seq, Doc};
use crate::backend::rust::located::Located;
use crate::backend::rust::route::{Route, RouteBus};
use crate::number::{hex16, hex8};

/// A function that creates locations, and the arguments for one item.
pub(in crate::backend::rust) struct Maker {
    pub parameters: Vec<String>,
    pub arguments: Vec<String>,
    pub body: Doc,
}

impl ItemAddresses<'_> {
    /// Returns the name of the constructors for an item with a single object address, and the index and sub-index of
    /// the object. Returns `None` if these constructors cannot express the location.
    pub fn only_object(&self) -> Option<(&'static str, u16, u8)> {
        let routed = self.routed();
        if !routed.is_simple() {
            return None;
        }
        match (routed.canopen, routed.coe, routed.modbus, routed.serial) {
            (Some((index, sub)), None, None, None) => Some(("object", index, sub)),
            (None, Some((index, sub)), None, None) => Some(("coe_object", index, sub)),
            (Some((index, sub)), Some(coe), None, None) if coe == (index, sub) => Some(("shared_object", index, sub)),
            _ => None,
        }
    }

    /// Returns the first arguments of the register constructors: the object address, if there is one, and the register.
    /// Returns `None` if these constructors cannot express the location.
    pub fn with_register(&self) -> Option<Vec<String>> {
        let routed = self.routed();
        let register = self.register(routed.modbus.filter(|_| routed.serial.is_none() && routed.is_simple())?);
        match (routed.canopen, routed.coe) {
            (None, None) => Some(vec![register]),
            (Some(canopen), Some(coe)) if canopen != coe => None,
            (canopen, coe) => {
                let (index, sub) = canopen.or(coe)?;
                Some(vec![hex16(index), hex8(sub), register])
            }
        }
    }

    /// Returns the addresses on the buses that have a route to the item. On other buses, a client can neither read nor
    /// write the item.
    fn routed(&self) -> Self {
        let is_routed = |bus: RouteBus| self.routes[bus as usize].access_paths().next().is_some();
        ItemAddresses {
            canopen: self.canopen.filter(|_| is_routed(RouteBus::CanOpen)),
            coe: self.coe.filter(|_| is_routed(RouteBus::CoE)),
            modbus: self.modbus.filter(|_| is_routed(RouteBus::Modbus)),
            serial: self.serial.filter(|_| is_routed(RouteBus::Serial)),
            image: self.image.filter(|_| is_routed(RouteBus::Image)),
            esc: self.esc.filter(|_| is_routed(RouteBus::Esc)),
            ..*self
        }
    }

    /// Returns whether all routes are direct, and no address is in a process image or in the memory of a slave
    /// controller.
    fn is_simple(&self) -> bool {
        self.image.is_none() && self.esc.is_none() && self.buses().is_direct()
    }

    /// Returns the call that creates the location with the type `path`. `windows` is the path to the device's windows.
    pub fn code(&self, located: &Located<'_>, path: &str, windows: &str) -> Doc {
        if self.buses().path().is_none() {
            return self.new_location(located, path, windows);
        }
        let ItemAddresses { canopen, coe, modbus, serial, image, esc, .. } = self.routed();
        let same = canopen.is_none() || coe.is_none() || canopen == coe;
        match (canopen.or(coe), modbus, serial) {
            (Some((index, sub)), None, None) if same => {
                let method = match (canopen, coe) {
                    (Some(_), None) => "canopen",
                    (None, _) => "coe",
                    _ => "object",
                };
                Doc::from(format!("{path}::{method}({}, {})", hex16(index), hex8(sub)))
            }
            (Some((index, sub)), Some(register), None) if same => {
                let [index, sub] = [hex16(index), hex8(sub)];
                call!(seq![path, "::register"], index, sub, self.register(register))
            }
            (None, Some(register), None) => call!(seq![path, "::modbus"], self.register(register)),
            (None, None, Some(code)) => Doc::from(format!("{path}::serial({code})")),
            (None, None, None) => match (image, esc) {
                (Some(field), _) => call!(seq![path, "::field"], field.code(self.is_bytes)),
                (None, Some((address, length))) => Doc::from(format!("{path}::memory({}, {length})", hex16(address))),
                (None, None) => self.new_location(located, path, windows),
            },
            // There is no short constructor for different addresses on several buses or for rare combinations of
            // routes.
            _ => self.new_location(located, path, windows),
        }
    }

    fn new_location(&self, located: &Located<'_>, path: &str, windows: &str) -> Doc {
        self.location_of(located, path, windows, |bus| self.address(bus).unwrap_or_default(), None)
    }

    /// Returns the code of a location with the type `path`. `address` returns the code of the address on a bus, and
    /// `number` is the number that selects the item in a window.
    fn location_of(
        &self,
        located: &Located<'_>,
        path: &str,
        windows: &str,
        address: impl Fn(RouteBus) -> String,
        number: Option<&str>,
    ) -> Doc {
        let window =
            |at: usize| format!("{windows}{}", located.windows.get(at).map_or("", |window| window.name.as_str()));
        let route = |bus: RouteBus| self.routes[bus as usize].code(&address(bus), window, number);
        list(&format!("{path}::new("), RouteBus::ALL.into_iter().filter_map(route), ")")
    }

    /// Returns a function that creates the location from the values that differ between items. A call of the generated
    /// function compiles in a third of the time that the full expression needs. Returns `None` if the runtime defines
    /// the location type, or if no bus allows access to the item. Also returns `None` if the item has different numbers
    /// in several windows. `windows` is the path to the device's windows.
    pub fn maker(&self, located: &Located<'_>, windows: &str) -> Option<Maker> {
        let buses = self.buses();
        if buses.is_empty() || buses.path().is_some() {
            return None;
        }
        let access_paths = || self.routes.iter().flat_map(Route::access_paths);
        let mut numbers = access_paths().filter_map(|access_path| Some(access_path.window?.1));
        let number = numbers.next();
        if numbers.any(|other| Some(other) != number) {
            return None;
        }
        let is_addressed =
            |bus: &RouteBus| self.routes[*bus as usize].access_paths().any(|access_path| access_path.window.is_none());
        let addressed = || RouteBus::ALL.into_iter().filter(is_addressed);
        let mut parameters: Vec<String> =
            addressed().map(|bus| format!("{}: {}", bus.field(), bus.address_type())).collect();
        let mut arguments: Vec<String> = addressed().filter_map(|bus| self.address(bus)).collect();
        if let Some(number) = number {
            parameters.push("number: u32".to_owned());
            arguments.push(hex16(number));
        }
        Some(Maker {
            parameters,
            arguments,
            body: self.location_of(located, &buses.word(), windows, RouteBus::field, Some("number")),
        })
    }

    /// Returns the code that creates the item's address on a bus.
    pub(super) fn address(&self, bus: RouteBus) -> Option<String> {
        let object = |(index, sub): (u16, u8)| format!("rt::Object::new({}, {})", hex16(index), hex8(sub));
        match bus {
            RouteBus::CanOpen => self.canopen.map(object),
            RouteBus::CoE => self.coe.map(object),
            RouteBus::Modbus => self.register_code(),
            RouteBus::Serial => self.serial.map(|code| format!("rt::Parameter({code})")),
            RouteBus::Image => self.image.map(|field| field.code(self.is_bytes)),
            RouteBus::Esc => {
                self.esc.map(|(address, length)| format!("rt::EscMemory::new({}, {length})", hex16(address)))
            }
        }
    }
}
