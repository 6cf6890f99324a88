//! The route to an item on each bus: its type, and the code that makes it.

use super::code::{call, generic, seq, slice, Doc};
use crate::ir::{Bus, Limits, Value};

/// The buses of a location, in the order of its fields, except the records of PROFINET, which tables have no items in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Net {
    CanOpen,
    CoE,
    Modbus,
    Serial,
    Image,
    Esc,
}

impl Net {
    pub const ALL: [Net; 6] = [Net::CanOpen, Net::CoE, Net::Modbus, Net::Serial, Net::Image, Net::Esc];

    /// The bus that facts of items are about.
    pub fn of_items(self) -> Bus {
        match self {
            Net::CanOpen => Bus::CanOpen,
            Net::CoE | Net::Esc => Bus::EtherCat,
            Net::Modbus => Bus::Modbus,
            Net::Serial => Bus::Serial,
            Net::Image => Bus::Profinet,
        }
    }

    /// Its name as a part of another one.
    pub fn word(self) -> &'static str {
        match self {
            Net::CanOpen => "CanOpen",
            Net::CoE => "CoE",
            Net::Modbus => "Modbus",
            Net::Serial => "Serial",
            Net::Image => "Image",
            Net::Esc => "Esc",
        }
    }

    /// The runtime's type of the bus.
    pub fn bus(self) -> &'static str {
        match self {
            Net::Image => "ProcessImage",
            _ => self.word(),
        }
    }

    /// The field of a location.
    pub fn field(self) -> String {
        self.word().to_lowercase()
    }

    /// Its name in a sentence.
    pub fn title(self) -> &'static str {
        match self {
            Net::CanOpen => "CANopen",
            Net::CoE => "EtherCAT",
            Net::Modbus => "Modbus",
            Net::Serial => "the serial line",
            Net::Image => "PROFINET",
            Net::Esc => "the slave controller",
        }
    }

    /// The type of its addresses.
    pub fn address(self) -> &'static str {
        match self {
            Net::CanOpen | Net::CoE => "rt::Object",
            Net::Modbus => "rt::Register",
            Net::Serial => "rt::Parameter",
            Net::Image => "rt::ImageField",
            Net::Esc => "rt::EscMemory",
        }
    }
}

/// What lies between an item and an address.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Leg {
    Direct,
    Resized,
    Limited,
    LimitedResized,
    Window,
}

impl Leg {
    fn ty(self, net: Net, reads: bool) -> Doc {
        let address = net.address();
        match self {
            Leg::Direct => Doc::from(address),
            Leg::Resized => generic!("rt::Resized", address),
            Leg::Limited => generic!("rt::Limited", address),
            Leg::LimitedResized => generic!("rt::Limited", generic!("rt::Resized", address)),
            Leg::Window if reads => generic!("rt::Through", generic!("rt::ReadWindow", address)),
            Leg::Window => generic!("rt::Through", generic!("rt::WriteWindow", address)),
        }
    }

    fn word(self) -> &'static str {
        match self {
            Leg::Direct => "",
            Leg::Resized => "Resized",
            Leg::Limited => "Limited",
            Leg::LimitedResized => "LimitedResized",
            Leg::Window => "Window",
        }
    }
}

/// The kind of a route.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Kind {
    #[default]
    Absent,
    /// One for whatever the item's access allows.
    One(Leg),
    Reads(Leg),
    Writes(Leg),
    Both(Leg, Leg),
}

impl Kind {
    /// Its type, if there is a route.
    pub fn ty(self, net: Net) -> Option<Doc> {
        Some(match self {
            Kind::Absent => return None,
            Kind::One(leg) => leg.ty(net, true),
            Kind::Reads(leg) => generic!("rt::Split", leg.ty(net, true), "rt::Closed"),
            Kind::Writes(leg) => generic!("rt::Split", "rt::Closed", leg.ty(net, false)),
            Kind::Both(read, write) => generic!("rt::Split", read.ty(net, true), write.ty(net, false)),
        })
    }

    /// Its name as a part of another one.
    pub fn word(self, net: Net) -> String {
        let bus = net.word();
        match self {
            Kind::Absent => String::new(),
            Kind::One(leg) => format!("{bus}{}", leg.word()),
            Kind::Reads(leg) => format!("{bus}{}In", leg.word()),
            Kind::Writes(leg) => format!("{bus}{}Out", leg.word()),
            Kind::Both(Leg::Window, Leg::Window) => format!("{bus}Windows"),
            Kind::Both(read, write) => format!("{bus}{}In{}Out", read.word(), write.word()),
        }
    }
}

/// Where one direction of the traffic to an item goes on one bus.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Way<'i> {
    /// The window, by its position; none where the item has an address of its own.
    pub window: Option<(usize, u32)>,
    /// Bits of the number there, where they aren't those of the item.
    pub resized: Option<u8>,
    /// The only values there, and whether the item's have a sign.
    pub limited: Option<(&'i Limits, bool)>,
    /// Whether the narrower one of the item and the number there has a sign.
    pub is_signed: bool,
}

impl Way<'_> {
    pub fn leg(&self) -> Leg {
        match (self.window, self.resized, self.limited) {
            (Some(_), ..) => Leg::Window,
            (None, None, None) => Leg::Direct,
            (None, Some(_), None) => Leg::Resized,
            (None, None, Some(_)) => Leg::Limited,
            (None, Some(_), Some(_)) => Leg::LimitedResized,
        }
    }

    /// The code that makes it, of that of the address or, through a window, that of the window; `number` stands for the number.
    pub fn code(&self, at: &str, number: Option<&str>) -> Doc {
        let sign = if self.is_signed { "signed" } else { "unsigned" };
        if let Some((_, own)) = self.window {
            let number = number.map_or_else(|| format!("0x{own:04X}"), ToOwned::to_owned);
            return call!(seq!["rt::Through::", sign], number, seq!["&", at]);
        }
        let own = match self.resized {
            Some(bits) => call!(seq!["rt::Resized::", sign], at, bits),
            None => Doc::from(at),
        };
        match self.limited {
            Some((limits, is_signed)) => {
                call!("rt::Limited::new", own, is_signed.to_string(), slice(runs(limits)))
            }
            None => own,
        }
    }
}

/// First and last value of each run.
fn runs(limits: &Limits) -> Vec<String> {
    let number = |value: &Value| value.as_int().and_then(|value| i64::try_from(value).ok());
    let end = |value: Option<&Value>, none: &str| value.and_then(number).map_or(none.to_owned(), |end| end.to_string());
    if limits.allowed.is_empty() {
        return vec![format!("({}, {})", end(limits.low.as_ref(), "i64::MIN"), end(limits.high.as_ref(), "i64::MAX"))];
    }
    let runs = limits.allowed.iter().filter_map(|(first, last)| Some((number(first)?, number(last)?)));
    runs.map(|(first, last)| format!("({first}, {last})")).collect()
}

/// The way in and the way out on one bus.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Route<'i> {
    pub read: Option<Way<'i>>,
    pub write: Option<Way<'i>>,
    /// Whether the item's access, whatever the bus, has a direction that this bus doesn't.
    pub is_partial: bool,
}

impl Route<'_> {
    pub fn kind(&self) -> Kind {
        match (&self.read, &self.write) {
            (None, None) => Kind::Absent,
            (Some(read), Some(write)) if read == write => Kind::One(read.leg()),
            (Some(read), Some(write)) => Kind::Both(read.leg(), write.leg()),
            // A window is one for reading or for writing by its type.
            (Some(way), None) if self.is_partial || way.window.is_some() => Kind::Reads(way.leg()),
            (None, Some(way)) if self.is_partial || way.window.is_some() => Kind::Writes(way.leg()),
            (Some(way), None) | (None, Some(way)) => Kind::One(way.leg()),
        }
    }

    /// The ways that there are.
    pub fn ways(&self) -> impl Iterator<Item = &Way<'_>> {
        self.read.iter().chain(&self.write)
    }

    /// The code that makes it, if there is one; `address` is that of the address, `window` names a window, and `number` stands
    /// for its number.
    pub fn code(&self, address: &str, window: impl Fn(usize) -> String, number: Option<&str>) -> Option<Doc> {
        let way = |way: &Way<'_>| match way.window {
            Some((at, _)) => way.code(&window(at), number),
            None => way.code(address, None),
        };
        Some(match (self.kind(), &self.read, &self.write) {
            (Kind::Reads(_), Some(read), _) => call!("rt::Split::reading", way(read)),
            (Kind::Writes(_), _, Some(write)) => call!("rt::Split::writing", way(write)),
            (Kind::Both(..), Some(read), Some(write)) => call!("rt::Split::new", way(read), way(write)),
            (Kind::One(_), Some(only), _) | (Kind::One(_), None, Some(only)) => way(only),
            _ => return None,
        })
    }
}
