//! Where an item is found: the type of a handle's location, and the code that makes it.

use super::scope::{ObjectBus, Scope};
use crate::ir::{Binding, Item, RegisterBinding, RegisterSpace, Type};

/// Index and sub-index.
pub(super) type ObjectAddress = (u16, u8);

/// An item's address on each bus that generated code can reach.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Place<'i> {
    canopen: Option<(u16, u8)>,
    coe: Option<(u16, u8)>,
    modbus: Option<&'i RegisterBinding>,
    serial: Option<u32>,
    /// Bits of the value, where a part of a register is meant.
    bits: u32,
    /// Whether the value is a sequence of bytes, and no number.
    is_bytes: bool,
    /// Whether it is a text of 16 bits a letter: a register holds a letter, as a number.
    is_wide: bool,
    /// Whether it is a number with a sign.
    is_signed: bool,
}

/// The buses of a location.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Buses {
    pub canopen: bool,
    pub coe: bool,
    pub modbus: bool,
    pub serial: bool,
}

impl Buses {
    /// Whether there is none.
    pub fn is_empty(self) -> bool {
        self == Buses::default()
    }

    /// The buses of both.
    pub fn union(self, other: Buses) -> Buses {
        Buses {
            canopen: self.canopen || other.canopen,
            coe: self.coe || other.coe,
            modbus: self.modbus || other.modbus,
            serial: self.serial || other.serial,
        }
    }

    /// The type of the location, in terms of the runtime.
    pub fn path(self) -> String {
        match (self.canopen, self.coe, self.modbus, self.serial) {
            (true, false, false, false) => "rt::OnCanOpen".to_owned(),
            (false, true, false, false) => "rt::OnCoE".to_owned(),
            (true, true, false, false) => "rt::OnCanOpenAndCoE".to_owned(),
            (false, false, true, false) => "rt::OnModbus".to_owned(),
            (true, false, true, false) => "rt::OnCanOpenAndModbus".to_owned(),
            (false, true, true, false) => "rt::OnCoEAndModbus".to_owned(),
            (true, true, true, false) => "rt::OnCanOpenCoEAndModbus".to_owned(),
            (false, false, false, true) => "rt::OnSerial".to_owned(),
            (canopen, coe, modbus, serial) => {
                let part = |is: bool, path: &str| if is { format!("rt::{path}") } else { "rt::Absent".to_owned() };
                format!(
                    "rt::Location<«{}¦ {}¦ {}¦ rt::Absent¦ {}»>",
                    part(canopen, "Object"),
                    part(coe, "Object"),
                    part(modbus, "Register"),
                    part(serial, "Parameter")
                )
            }
        }
    }

    /// Its name as a part of another one.
    pub fn word(self) -> String {
        let parts = [(self.canopen, "CanOpen"), (self.coe, "CoE"), (self.modbus, "Modbus"), (self.serial, "Serial")];
        let words: String = parts.into_iter().filter(|(is, _)| *is).map(|(_, word)| word).collect();
        format!("On{words}")
    }
}

impl<'i> Place<'i> {
    pub fn of(scope: &Scope<'_>, item: &'i Item) -> Self {
        let mut place = Place::default();
        for binding in &item.bindings {
            match binding {
                Binding::Object { buses, index, sub_index } => {
                    let object = Some((*index, *sub_index));
                    place.canopen = place.canopen.or(object.filter(|_| buses.canopen));
                    place.coe = place.coe.or(object.filter(|_| buses.coe));
                }
                Binding::Register(register) => place.modbus = place.modbus.or(Some(register)),
                Binding::Parameter { code, .. } => place.serial = place.serial.or(Some(*code)),
                _ => {}
            }
        }
        let base = scope.base(item.ty);
        place.bits = base.bits().unwrap_or(0);
        place.is_bytes = matches!(
            base,
            Type::VisibleString(_) | Type::OctetString(_) | Type::UnicodeString(_) | Type::Domain | Type::Opaque(_)
        );
        place.is_wide = matches!(base, Type::UnicodeString(_));
        place.is_signed = matches!(base, Type::Integer(_));
        place
    }

    pub fn buses(&self) -> Buses {
        Buses {
            canopen: self.canopen.is_some(),
            coe: self.coe.is_some(),
            modbus: self.modbus.is_some(),
            serial: self.serial.is_some(),
        }
    }

    /// The object on the bus of `scope`, or on the other one that has objects.
    pub fn object_on(&self, bus: ObjectBus) -> Option<(u16, u8)> {
        match bus {
            ObjectBus::CanOpen => self.canopen.or(self.coe),
            ObjectBus::CoE => self.coe.or(self.canopen),
        }
    }

    /// What the constructors of objects are called here, and the object, where the item is nothing else.
    pub fn only_object(&self) -> Option<(&'static str, u16, u8)> {
        match (self.canopen, self.coe, self.modbus, self.serial) {
            (Some((index, sub)), None, None, None) => Some(("object", index, sub)),
            (None, Some((index, sub)), None, None) => Some(("coe_object", index, sub)),
            (Some((index, sub)), Some(coe), None, None) if coe == (index, sub) => Some(("shared_object", index, sub)),
            _ => None,
        }
    }

    /// The arguments that the constructors of registers begin with, where the item is a register, and at most one object
    /// beside.
    pub fn with_register(&self) -> Option<String> {
        let register = self.register(self.modbus.filter(|_| self.serial.is_none())?);
        match (self.canopen, self.coe) {
            (None, None) => Some(register),
            (Some(canopen), Some(coe)) if canopen != coe => None,
            (canopen, coe) => {
                let (index, sub) = canopen.or(coe)?;
                Some(format!("0x{index:04X}¦ 0x{sub:02X}¦ {register}"))
            }
        }
    }

    /// The call that makes the location.
    pub fn code(&self) -> String {
        let path = self.buses().path();
        let object = |(index, sub): (u16, u8)| format!("0x{index:04X}¦ 0x{sub:02X}");
        let same = self.canopen.is_none() || self.coe.is_none() || self.canopen == self.coe;
        match (self.canopen.or(self.coe), self.modbus, self.serial) {
            (Some((index, sub)), None, None) if same => {
                let method = match (self.canopen, self.coe) {
                    (Some(_), None) => "canopen",
                    (None, _) => "coe",
                    _ => "object",
                };
                format!("{path}::{method}(0x{index:04X}, 0x{sub:02X})")
            }
            (Some(place), Some(register), None) if same => {
                format!("{path}::register(«{}¦ {}»)", object(place), self.register(register))
            }
            (None, Some(register), None) => format!("{path}::modbus(«{}»)", self.register(register)),
            (None, None, Some(code)) => format!("{path}::serial({code})"),
            _ => {
                // Addresses that differ between the buses, and combinations that are too rare for a name.
                let canopen = self.canopen.map(|(index, sub)| format!("rt::Object::new(0x{index:04X}, 0x{sub:02X})"));
                let coe = self.coe.map(|(index, sub)| format!("rt::Object::new(0x{index:04X}, 0x{sub:02X})"));
                let modbus = self.modbus.map(|register| self.register(register));
                let serial = self.serial.map(|code| format!("rt::Parameter({code})"));
                let or_absent = |part: Option<String>| part.unwrap_or_else(|| "rt::Absent".to_owned());
                let parts = [canopen, coe, modbus, None, serial].map(or_absent);
                format!("rt::Location::new(«{}»)", parts.join("¦ "))
            }
        }
    }

    /// The objects: that of the dictionary, and where CANopen and EtherCAT have different ones, the one on EtherCAT.
    pub fn objects(&self) -> [Option<(u16, u8)>; 2] {
        [self.canopen.or(self.coe), self.coe.filter(|coe| self.canopen.is_some_and(|canopen| canopen != *coe))]
    }

    /// The call that makes the register.
    pub fn register_code(&self) -> Option<String> {
        self.modbus.map(|register| self.register(register))
    }

    /// What registers are sorted by: table, address and first bit.
    pub fn register_key(&self) -> Option<(u8, u16, Option<u8>)> {
        self.modbus.map(|register| {
            let table = match register.space {
                RegisterSpace::Holding => 0,
                RegisterSpace::Input => 1,
                RegisterSpace::Coil => 2,
                RegisterSpace::DiscreteInput => 3,
            };
            (table, register.address, register.bit_offset)
        })
    }

    fn register(&self, register: &RegisterBinding) -> String {
        let RegisterBinding { address, count, .. } = register;
        let low_first = register.low_word_first && *count > 1 && !self.is_bytes;
        let mut code = match register.space {
            RegisterSpace::Holding if low_first => format!("rt::Register::low_first({address}, {count})"),
            RegisterSpace::Holding if *count == 1 => format!("rt::Register::holding({address})"),
            RegisterSpace::Holding => format!("rt::Register::high_first({address}, {count})"),
            other => {
                let table = match other {
                    RegisterSpace::Coil => "Coil",
                    RegisterSpace::DiscreteInput => "DiscreteInput",
                    _ => "Input",
                };
                format!("rt::Register::new(rt::RegisterTable::{table}, {address}, {count})")
            }
        };
        if self.is_bytes {
            code += ".ordered(rt::WordOrder::Bytes)";
        } else if low_first && register.space != RegisterSpace::Holding {
            code += ".ordered(rt::WordOrder::LowFirst)";
        }
        if register.bytes_swapped != self.is_wide {
            code += ".swapped()";
        }
        if let Some(first) = register.bit_offset {
            code += &format!(".part({first}, {})", self.bits);
        }
        if register.extended && self.is_signed && self.bits < 16 * u32::from(register.count) {
            code += ".sign_extended()";
        }
        if register.words_per_address > 1 {
            code += &format!(".words_per_address({})", register.words_per_address);
        }
        code
    }

    /// What the documentation calls the places.
    pub fn facts(&self) -> String {
        let object = |(index, sub): (u16, u8)| format!("0x{index:04X}:{sub:02X}");
        let mut facts = Vec::new();
        match (self.canopen, self.coe) {
            (Some(canopen), Some(coe)) if canopen != coe => {
                facts.push(format!("{} on CANopen", object(canopen)));
                facts.push(format!("{} on EtherCAT", object(coe)));
            }
            (canopen, coe) => facts.extend(canopen.or(coe).map(object)),
        }
        facts.extend(self.modbus.map(register_facts));
        facts.extend(self.serial.map(|code| format!("parameter {code}")));
        facts.join(", ")
    }

    /// The place in a few words.
    pub fn heading(&self) -> String {
        let object = self.canopen.or(self.coe).map(|(index, sub)| format!("0x{index:04X}:{sub:02X}"));
        let register = self.modbus.map(|register| match register.bit_offset {
            Some(bit) => format!("register {} from bit {bit}", register.address),
            None => format!("register {}", register.address),
        });
        let serial = self.serial.map(|code| format!("parameter {code}"));
        object.into_iter().chain(register).chain(serial).collect::<Vec<_>>().join(", ")
    }

    /// What tells the item from others of its name.
    pub fn suffix(&self) -> String {
        match (self.modbus, self.canopen.or(self.coe), self.serial) {
            (Some(register), _, _) => {
                // Two tables of Modbus have the same numbers.
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
            (None, None, code) => code.unwrap_or(0).to_string(),
        }
    }
}

fn register_facts(register: &RegisterBinding) -> String {
    let table = match register.space {
        RegisterSpace::Holding => "holding register",
        RegisterSpace::Input => "input register",
        RegisterSpace::Coil => "coil",
        RegisterSpace::DiscreteInput => "discrete input",
    };
    let bits = match register.words_per_address {
        0 | 1 => String::new(),
        words => format!(" of {} bits", 16 * u16::from(words)),
    };
    let each = if bits.is_empty() { "" } else { " each" };
    let mut facts = match register.last() {
        last if last <= register.address => format!("{table} {}{bits}", register.address),
        last => format!("{table}s {} to {last}{bits}{each}", register.address),
    };
    if let Some(bit) = register.bit_offset {
        facts += &format!(" from bit {bit}");
    }
    if register.low_word_first && register.count > 1 {
        facts += ", low word first";
    }
    if register.bytes_swapped {
        facts += ", bytes swapped";
    }
    facts
}
