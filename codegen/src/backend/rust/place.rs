//! Where an item is found: the type of a handle's location, and the code that makes it.

mod words;

use super::route::{Kind, Leg, Net, Route, Way};
use super::scope::{ObjectBus, Scope};
use super::window;
use crate::ir::{Binding, Direction, Item, RegisterBinding, RegisterSpace, Type};

/// Index and sub-index.
pub(super) type ObjectAddress = (u16, u8);

/// An item's address on each bus that generated code can reach, and the routes to it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Place<'i> {
    canopen: Option<(u16, u8)>,
    coe: Option<(u16, u8)>,
    modbus: Option<&'i RegisterBinding>,
    serial: Option<u32>,
    image: Option<Field<'i>>,
    esc: Option<(u16, u16)>,
    routes: [Route<'i>; 6],
    /// Bits of the value, where a part of a register is meant.
    bits: u32,
    /// Whether the value is a sequence of bytes, and no number.
    is_bytes: bool,
    /// Whether it is a text of 16 bits a letter: a register holds a letter, as a number.
    is_wide: bool,
}

/// A field of a fixed process image.
#[derive(Clone, Copy, Debug)]
struct Field<'i> {
    image: &'i str,
    first: u32,
    bits: u32,
    ty: Option<Type>,
    /// Whether the device gets it.
    is_output: bool,
    big_endian: bool,
}

/// What makes a location.
pub(super) struct Maker {
    pub parameters: String,
    pub arguments: String,
    pub body: String,
}

/// The buses of a location, and what the route is on each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Buses([Kind; 6]);

impl Buses {
    /// Whether there is none.
    pub fn is_empty(self) -> bool {
        self == Buses::default()
    }

    /// Whether every route is an address.
    pub fn is_direct(self) -> bool {
        self.0.iter().all(|kind| matches!(kind, Kind::Absent | Kind::One(Leg::Direct)))
    }

    /// The buses of both.
    pub fn union(self, other: Buses) -> Buses {
        Buses(std::array::from_fn(|at| self.0[at].max(other.0[at])))
    }

    /// The runtime's name of the location, where it has one.
    pub fn path(self) -> Option<&'static str> {
        let [canopen, coe, modbus, serial, image, esc] = self.0.map(|kind| kind != Kind::Absent);
        if !self.is_direct() {
            return None;
        }
        Some(match (canopen, coe, modbus, serial, image, esc) {
            (true, false, false, false, false, false) => "rt::OnCanOpen",
            (false, true, false, false, false, false) => "rt::OnCoE",
            (true, true, false, false, false, false) => "rt::OnCanOpenAndCoE",
            (false, false, true, false, false, false) => "rt::OnModbus",
            (true, false, true, false, false, false) => "rt::OnCanOpenAndModbus",
            (false, true, true, false, false, false) => "rt::OnCoEAndModbus",
            (true, true, true, false, false, false) => "rt::OnCanOpenCoEAndModbus",
            (false, false, false, true, false, false) => "rt::OnSerial",
            (false, false, false, false, true, false) => "rt::OnImage",
            (false, false, false, false, false, true) => "rt::OnEsc",
            _ => return None,
        })
    }

    /// The type of the location, written out.
    pub fn written_out(self) -> String {
        let [canopen, coe, modbus, serial, image, esc] = self.types();
        format!("rt::Location<«{canopen}¦ {coe}¦ {modbus}¦ rt::Absent¦ {serial}¦ {image}¦ {esc}»>")
    }

    fn types(self) -> [String; 6] {
        std::array::from_fn(|at| self.0[at].ty(Net::ALL[at]))
    }

    /// Its name as a part of another one.
    pub fn word(self) -> String {
        let words: String = Net::ALL.iter().zip(self.0).map(|(net, kind)| kind.word(*net)).collect();
        format!("On{words}")
    }

    /// The buses, for a sentence.
    pub fn titles(self) -> String {
        let present = Net::ALL.iter().zip(self.0).filter(|(_, kind)| *kind != Kind::Absent);
        present.map(|(net, _)| net.title()).collect::<Vec<_>>().join(", ")
    }
}

/// The code that makes the address of an item on a bus, where it has one there, and it can be read or written.
pub(super) fn address(scope: &Scope<'_>, item: &Item, net: Net, writes: bool) -> Option<String> {
    let place = Place::of(scope, item);
    place.is_possible(item, net, writes).then(|| place.address(net))?
}

impl<'i> Place<'i> {
    pub fn of(scope: &Scope<'_>, item: &'i Item) -> Self {
        let mut place = Place::direct(scope, item);
        if is_plain(item) {
            place.routes = Net::ALL.map(|net| match place.has(net) {
                true => place.plain(item),
                false => Route::default(),
            });
        } else {
            place.routes = Net::ALL.map(|net| place.route(scope, item, net));
        }
        place
    }

    fn direct(scope: &Scope<'_>, item: &'i Item) -> Self {
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
                Binding::Image { image, bit_offset, bits, ty } => {
                    let found = scope.image(image).map(|own| Field {
                        image,
                        first: *bit_offset,
                        bits: *bits,
                        ty: *ty,
                        is_output: own.direction == Direction::Receive,
                        big_endian: own.big_endian,
                    });
                    place.image = place.image.or(found.filter(|_| is_field(scope.base(item.ty), *bit_offset, *bits)));
                }
                Binding::EscMemory { address, length } => place.esc = place.esc.or(Some((*address, *length))),
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
        place
    }

    /// Whether the item has an address on a bus.
    fn has(&self, net: Net) -> bool {
        match net {
            Net::CanOpen => self.canopen.is_some(),
            Net::CoE => self.coe.is_some(),
            Net::Modbus => self.modbus.is_some(),
            Net::Serial => self.serial.is_some(),
            Net::Image => self.image.is_some(),
            Net::Esc => self.esc.is_some(),
        }
    }

    /// The route to an item that is the same everywhere.
    fn plain(&self, item: &Item) -> Route<'i> {
        let way = Some(Way { window: None, resized: None, limited: None, is_signed: false });
        let (read, write) = (way.filter(|_| item.access.readable()), way.filter(|_| item.access.writable()));
        Route { read, write, is_partial: false }
    }

    /// Whether a bus lets the item be read, or written, at its address.
    fn is_possible(&self, item: &Item, net: Net, writes: bool) -> bool {
        let access = if net == Net::Esc { item.access } else { item.access_on(net.in_tables()) };
        let allows = if writes { access.writable() } else { access.readable() };
        let goes = match (net, self.image) {
            (Net::Image, Some(field)) => field.is_output == writes,
            _ => true,
        };
        self.has(net) && allows && goes
    }

    fn route(&self, scope: &Scope<'_>, item: &'i Item, net: Net) -> Route<'i> {
        let way = |writes: bool| {
            let is_allowed = if writes { item.access.writable() } else { item.access.readable() };
            let direct = || self.is_possible(item, net, writes).then(|| self.own_way(scope, item, net))?;
            is_allowed.then(|| direct().or_else(|| through(scope, item, net, writes)))?
        };
        let (read, write) = (way(false), way(true));
        let is_partial = item.access.readable() && item.access.writable();
        Route { read, write, is_partial }
    }

    /// The way to the item's own address; none where its type can't have the width that it has there.
    fn own_way(&self, scope: &Scope<'_>, item: &'i Item, net: Net) -> Option<Way<'i>> {
        let (own, there) = (scope.base(item.ty), scope.base(item.type_on(net.in_tables())));
        let there = match (net, self.image, self.esc) {
            (Net::Image, Some(field), _) => field.ty.map_or(own, |ty| scope.base(ty)),
            (Net::Esc, _, Some((_, length))) => in_memory(own, length),
            _ => there,
        };
        let limited =
            item.limits_on(net.in_tables()).filter(|_| is_integer(own)).map(|own_limits| (own_limits, own.is_signed()));
        let resized = own.bits() != there.bits() && own.bits().is_some();
        let is_signed = if resized { narrower(own, there).is_signed() } else { own.is_signed() };
        let bits = there.bits().filter(|bits| (1..=64).contains(bits)).and_then(|bits| u8::try_from(bits).ok());
        if resized && !(is_integer(own) && is_integer(there)) {
            return None;
        }
        Some(Way { window: None, resized: bits.filter(|_| resized), limited, is_signed })
    }

    pub fn buses(&self) -> Buses {
        Buses(self.routes.map(|route| route.kind()))
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
        if !self.is_simple() {
            return None;
        }
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
        let register = self.register(self.modbus.filter(|_| self.serial.is_none() && self.is_simple())?);
        match (self.canopen, self.coe) {
            (None, None) => Some(register),
            (Some(canopen), Some(coe)) if canopen != coe => None,
            (canopen, coe) => {
                let (index, sub) = canopen.or(coe)?;
                Some(format!("0x{index:04X}¦ 0x{sub:02X}¦ {register}"))
            }
        }
    }

    /// Whether every route is an address, and none is in an image or in a slave controller.
    fn is_simple(&self) -> bool {
        self.image.is_none() && self.esc.is_none() && self.buses().is_direct()
    }

    /// The call that makes the location. `windows` leads to the windows of the device.
    pub fn code(&self, scope: &Scope<'_>, windows: &str) -> String {
        let Some(path) = self.buses().path() else { return self.new_location(scope, windows) };
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
            (None, None, None) => match (self.image, self.esc) {
                (Some(field), _) => format!("{path}::field(«{}»)", field.code(self.is_bytes)),
                (None, Some((address, length))) => format!("{path}::memory(0x{address:04X}, {length})"),
                (None, None) => self.new_location(scope, windows),
            },
            // Addresses that differ between the buses, and routes that are too rare for a name.
            _ => self.new_location(scope, windows),
        }
    }

    fn new_location(&self, scope: &Scope<'_>, windows: &str) -> String {
        self.location_of(scope, windows, |net| self.address(net).unwrap_or_default(), None)
    }

    /// The code of a location whose addresses are `address`, and whose numbers behind windows `number`.
    fn location_of(
        &self,
        scope: &Scope<'_>,
        windows: &str,
        address: impl Fn(Net) -> String,
        number: Option<&str>,
    ) -> String {
        let window = |at: usize| format!("{windows}{}", scope.windows.get(at).map_or("", |own| own.name.as_str()));
        let [canopen, coe, modbus, serial, image, esc] =
            Net::ALL.map(|net| self.routes[net as usize].code(&address(net), window, number));
        format!("rt::Location::new(«{canopen}¦ {coe}¦ {modbus}¦ rt::Absent¦ {serial}¦ {image}¦ {esc}»)")
    }

    /// The location as a function of what items differ in, for one that the runtime has no name for: `rustc` takes a third of
    /// the time for a call of such a function. `windows` leads to the windows of the device.
    pub fn maker(&self, scope: &Scope<'_>, windows: &str) -> Option<Maker> {
        let buses = self.buses();
        if buses.is_empty() || buses.path().is_some() {
            return None;
        }
        let ways = || self.routes.iter().flat_map(Route::ways);
        let mut numbers = ways().filter_map(|way| Some(way.window?.1));
        let number = numbers.next();
        if numbers.any(|other| Some(other) != number) {
            return None;
        }
        let is_addressed = |net: &Net| self.routes[*net as usize].ways().any(|way| way.window.is_none());
        let addressed = || Net::ALL.into_iter().filter(is_addressed);
        let mut parameters: Vec<String> =
            addressed().map(|net| format!("{}: {}", net.word().to_lowercase(), net.address())).collect();
        let mut arguments: Vec<String> = addressed().filter_map(|net| self.address(net)).collect();
        if let Some(number) = number {
            parameters.push("number: u32".to_owned());
            arguments.push(format!("0x{number:04X}"));
        }
        Some(Maker {
            parameters: parameters.join("¦ "),
            arguments: arguments.join("¦ "),
            body: self.location_of(scope, windows, |net| net.word().to_lowercase(), Some("number")),
        })
    }

    /// The code that makes the item's address on a bus.
    fn address(&self, net: Net) -> Option<String> {
        let object = |(index, sub): (u16, u8)| format!("rt::Object::new(0x{index:04X}, 0x{sub:02X})");
        match net {
            Net::CanOpen => self.canopen.map(object),
            Net::CoE => self.coe.map(object),
            Net::Modbus => self.modbus.map(|register| self.register(register)),
            Net::Serial => self.serial.map(|code| format!("rt::Parameter({code})")),
            Net::Image => self.image.map(|field| field.code(self.is_bytes)),
            Net::Esc => self.esc.map(|(address, length)| format!("rt::EscMemory::new(0x{address:04X}, {length})")),
        }
    }

    /// The objects: that of the dictionary, and where CANopen and EtherCAT have different ones, the one on EtherCAT.
    pub fn objects(&self) -> [Option<(u16, u8)>; 2] {
        [self.canopen.or(self.coe), self.coe.filter(|coe| self.canopen.is_some_and(|canopen| canopen != *coe))]
    }

    /// Whether the object is one on CANopen.
    pub fn is_on_canopen(&self) -> bool {
        self.canopen.is_some()
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
        if register.words_per_address > 1 {
            code += &format!(".words_per_address({})", register.words_per_address);
        }
        code
    }
}

impl Field<'_> {
    fn code(self, is_bytes: bool) -> String {
        let direction = if self.is_output { "output" } else { "input" };
        let code = format!("rt::ImageField::{direction}({}, {})", self.first, self.bits);
        match (is_bytes, self.big_endian) {
            (true, _) => format!("{code}.ordered(rt::ImageOrder::Bytes)"),
            (false, false) => format!("{code}.ordered(rt::ImageOrder::LittleEndian)"),
            (false, true) => code,
        }
    }
}

/// The way through a window of the item's space on a bus.
fn through<'i>(scope: &Scope<'_>, item: &Item, net: Net, writes: bool) -> Option<Way<'i>> {
    item.bindings.iter().filter_map(window::indirect).find_map(|binding| {
        let at = window::position(&scope.windows, binding, net, writes)?;
        let own = scope.windows.get(at).filter(|own| window::carries(scope, item, own))?;
        let (bits, is_signed) = own.value;
        let base = scope.base(item.ty);
        let is_signed = if base.bits().unwrap_or(0) <= bits { base.is_signed() } else { is_signed };
        Some(Way { window: Some((at, binding.number)), resized: None, limited: None, is_signed })
    })
}

/// Whether an item is the same on every bus on which it has an address, and nowhere else.
fn is_plain(item: &Item) -> bool {
    let is_address = |binding: &Binding| {
        !matches!(binding, Binding::Indirect(_) | Binding::Image { .. } | Binding::EscMemory { .. })
    };
    item.variants.is_empty() && item.bindings.iter().all(is_address)
}

/// Whether the runtime reads such a value from an image: a number within 8 bytes, or bytes that lie as they are.
fn is_field(ty: Type, first: u32, bits: u32) -> bool {
    match ty {
        Type::VisibleString(_) | Type::OctetString(_) | Type::Opaque(_) => {
            first.is_multiple_of(8) && bits <= u16::MAX.into()
        }
        Type::UnicodeString(_) | Type::Domain => false,
        _ => first % 8 + bits <= 64,
    }
}

/// A number in so many bytes of a slave controller.
fn in_memory(ty: Type, length: u16) -> Type {
    match (ty.bits(), u8::try_from(length)) {
        (Some(bits), Ok(length @ 1..=8)) if bits.div_ceil(8) != u32::from(length) => Type::Unsigned(8 * length),
        _ => ty,
    }
}

fn is_integer(ty: Type) -> bool {
    matches!(ty, Type::Boolean | Type::Integer(1..=64) | Type::Unsigned(1..=64))
}

fn narrower(one: Type, other: Type) -> Type {
    if one.bits() <= other.bits() {
        one
    } else {
        other
    }
}
