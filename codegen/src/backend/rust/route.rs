//! The route to an item on each bus: its Rust type, and the code that creates it.

use super::code::{call, generic, seq, slice, Doc};
use crate::ir::{Bus, Limits, Value};
use crate::number::hex16;

/// The buses of a location, in the order of its fields. PROFINET records are not included because register tables
/// cannot describe them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum RouteBus {
    CanOpen,
    CoE,
    Modbus,
    Serial,
    Image,
    Esc,
}

impl RouteBus {
    pub const ALL: [RouteBus; 6] =
        [RouteBus::CanOpen, RouteBus::CoE, RouteBus::Modbus, RouteBus::Serial, RouteBus::Image, RouteBus::Esc];

    /// Returns the bus of the IR, the name for use in other names, the name for a sentence, and the address type.
    fn facts(self) -> (Bus, &'static str, &'static str, &'static str) {
        match self {
            RouteBus::CanOpen => (Bus::CanOpen, "CanOpen", "CANopen", "rt::Object"),
            RouteBus::CoE => (Bus::EtherCat, "CoE", "EtherCAT", "rt::Object"),
            RouteBus::Modbus => (Bus::Modbus, "Modbus", "Modbus", "rt::Register"),
            RouteBus::Serial => (Bus::Serial, "Serial", "the serial line", "rt::Parameter"),
            RouteBus::Image => (Bus::Profinet, "Image", "PROFINET", "rt::ImageField"),
            RouteBus::Esc => (Bus::EtherCat, "Esc", "the slave controller", "rt::EscMemory"),
        }
    }

    /// Returns the corresponding bus of the IR.
    pub fn of_items(self) -> Bus {
        self.facts().0
    }

    /// Returns the name of the bus for use in other names.
    pub fn word(self) -> &'static str {
        self.facts().1
    }

    /// Returns the name of the runtime's type for the bus.
    pub fn type_name(self) -> &'static str {
        match self {
            RouteBus::Image => "ProcessImage",
            _ => self.word(),
        }
    }

    /// Returns the name of the location field for the bus.
    pub fn field(self) -> String {
        self.word().to_lowercase()
    }

    /// Returns the name of the bus for a sentence.
    pub fn title(self) -> &'static str {
        self.facts().2
    }

    /// Returns the name of the address type for the bus.
    pub fn address_type(self) -> &'static str {
        self.facts().3
    }
}

/// The kind of an access path. The kind states whether a value is converted or has other limits on the bus, and whether
/// it is accessed through a window.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum PathKind {
    Direct,
    Resized,
    Limited,
    LimitedResized,
    Window,
}

impl PathKind {
    fn ty(self, bus: RouteBus, reads: bool) -> Doc {
        let address = bus.address_type();
        match self {
            PathKind::Direct => Doc::from(address),
            PathKind::Resized => generic!("rt::Resized", address),
            PathKind::Limited => generic!("rt::Limited", address),
            PathKind::LimitedResized => generic!("rt::Limited", generic!("rt::Resized", address)),
            PathKind::Window if reads => generic!("rt::Through", generic!("rt::ReadWindow", address)),
            PathKind::Window => generic!("rt::Through", generic!("rt::WriteWindow", address)),
        }
    }

    fn word(self) -> &'static str {
        match self {
            PathKind::Direct => "",
            PathKind::Resized => "Resized",
            PathKind::Limited => "Limited",
            PathKind::LimitedResized => "LimitedResized",
            PathKind::Window => "Window",
        }
    }
}

/// The kinds of the paths that a route uses for reading and writing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum RouteKind {
    #[default]
    Absent,
    /// The same path for reading and writing, or a path for the only access that the item allows.
    One(PathKind),
    Reads(PathKind),
    Writes(PathKind),
    Both(PathKind, PathKind),
}

impl RouteKind {
    /// Returns the type of the route. Returns `None` if the item has no route on the bus.
    pub fn ty(self, bus: RouteBus) -> Option<Doc> {
        Some(match self {
            RouteKind::Absent => return None,
            RouteKind::One(path_kind) => path_kind.ty(bus, true),
            RouteKind::Reads(path_kind) => generic!("rt::Split", path_kind.ty(bus, true), "rt::Closed"),
            RouteKind::Writes(path_kind) => generic!("rt::Split", "rt::Closed", path_kind.ty(bus, false)),
            RouteKind::Both(read, write) => generic!("rt::Split", read.ty(bus, true), write.ty(bus, false)),
        })
    }

    /// Returns the name of the route for use in other names.
    pub fn word(self, bus: RouteBus) -> String {
        let bus = bus.word();
        match self {
            RouteKind::Absent => String::new(),
            RouteKind::One(path_kind) => format!("{bus}{}", path_kind.word()),
            RouteKind::Reads(path_kind) => format!("{bus}{}In", path_kind.word()),
            RouteKind::Writes(path_kind) => format!("{bus}{}Out", path_kind.word()),
            RouteKind::Both(PathKind::Window, PathKind::Window) => format!("{bus}Windows"),
            RouteKind::Both(read, write) => format!("{bus}{}In{}Out", read.word(), write.word()),
        }
    }
}

/// The path through which an item is read or written on a bus.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct AccessPath<'i> {
    /// Position of the window, and the number that selects the item in it. `None` if the item has its own address.
    pub window: Option<(usize, u32)>,
    /// Number of bits on the bus if it differs from the number of bits of the item.
    pub resized: Option<u8>,
    /// Allowed values on the bus, and whether the item is signed. `None` if the description states no separate limits
    /// for the bus, if the item is accessed through a window, or if the item is not an integer.
    pub limited: Option<(&'i Limits, bool)>,
    /// True if the conversion is signed, that is, if the narrower of the two integers (of the item and on the bus) is
    /// signed.
    pub is_signed: bool,
}

impl AccessPath<'_> {
    pub fn kind(&self) -> PathKind {
        match (self.window, self.resized, self.limited) {
            (Some(_), ..) => PathKind::Window,
            (None, None, None) => PathKind::Direct,
            (None, Some(_), None) => PathKind::Resized,
            (None, None, Some(_)) => PathKind::Limited,
            (None, Some(_), Some(_)) => PathKind::LimitedResized,
        }
    }

    /// Returns the code that creates the path. `at` is the code of the address or window. `number` replaces the number
    /// that selects the item in the window.
    pub fn code(&self, at: &str, number: Option<&str>) -> Doc {
        let sign = if self.is_signed { "signed" } else { "unsigned" };
        if let Some((_, window_number)) = self.window {
            let number = number.map_or_else(|| hex16(window_number), ToOwned::to_owned);
            return call!(seq!["rt::Through::", sign], number, seq!["&", at]);
        }
        let code = match self.resized {
            Some(bits) => call!(seq!["rt::Resized::", sign], at, bits),
            None => Doc::from(at),
        };
        match self.limited {
            Some((limits, is_signed)) => {
                call!("rt::Limited::new", code, is_signed.to_string(), slice(ranges(limits)))
            }
            None => code,
        }
    }
}

/// Returns the minimum and maximum of each allowed range.
fn ranges(limits: &Limits) -> Vec<String> {
    let number = |value: &Value| value.as_int().and_then(|value| i64::try_from(value).ok());
    let end = |value: Option<&Value>, none: &str| value.and_then(number).map_or(none.to_owned(), |end| end.to_string());
    if limits.allowed.is_empty() {
        return vec![format!("({}, {})", end(limits.low.as_ref(), "i64::MIN"), end(limits.high.as_ref(), "i64::MAX"))];
    }
    let ranges = limits.allowed.iter().filter_map(|(first, last)| Some((number(first)?, number(last)?)));
    ranges.map(|(first, last)| format!("({first}, {last})")).collect()
}

/// The paths through which an item is read and written on a bus.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Route<'i> {
    pub read: Option<AccessPath<'i>>,
    pub write: Option<AccessPath<'i>>,
    /// True if the item is readable and writable, although a bus may allow only reading or only writing.
    pub is_partial: bool,
}

impl Route<'_> {
    pub fn kind(&self) -> RouteKind {
        match (&self.read, &self.write) {
            (None, None) => RouteKind::Absent,
            (Some(read), Some(write)) if read == write => RouteKind::One(read.kind()),
            (Some(read), Some(write)) => RouteKind::Both(read.kind(), write.kind()),
            // A route through a window has a type that states whether the window is for reading or for writing.
            (Some(access_path), None) if self.is_partial || access_path.window.is_some() => {
                RouteKind::Reads(access_path.kind())
            }
            (None, Some(access_path)) if self.is_partial || access_path.window.is_some() => {
                RouteKind::Writes(access_path.kind())
            }
            (Some(access_path), None) | (None, Some(access_path)) => RouteKind::One(access_path.kind()),
        }
    }

    /// Returns the paths of the route: for reading, for writing, or both.
    pub fn access_paths(&self) -> impl Iterator<Item = &AccessPath<'_>> {
        self.read.iter().chain(&self.write)
    }

    /// Returns the code that creates the route. Returns `None` if the item has no route on the bus. `address` is the
    /// code of the address, and `window` returns the name of a window. `number` replaces the number that selects the
    /// item in the window.
    pub fn code(&self, address: &str, window: impl Fn(usize) -> String, number: Option<&str>) -> Option<Doc> {
        let code_of = |access_path: &AccessPath<'_>| match access_path.window {
            Some((at, _)) => access_path.code(&window(at), number),
            None => access_path.code(address, None),
        };
        Some(match (self.kind(), &self.read, &self.write) {
            (RouteKind::Reads(_), Some(read), _) => call!("rt::Split::reading", code_of(read)),
            (RouteKind::Writes(_), _, Some(write)) => call!("rt::Split::writing", code_of(write)),
            (RouteKind::Both(..), Some(read), Some(write)) => call!("rt::Split::new", code_of(read), code_of(write)),
            (RouteKind::One(_), Some(only), _) | (RouteKind::One(_), None, Some(only)) => code_of(only),
            _ => return None,
        })
    }
}
