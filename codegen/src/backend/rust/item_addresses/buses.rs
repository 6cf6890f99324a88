//! The buses on which an item can be accessed. These buses determine the Rust type of the item's location.

use crate::backend::rust::code::{seq, Doc};
use crate::backend::rust::route::{PathKind, Route, RouteBus, RouteKind};

/// The buses of a location, with the kind of route on each bus.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(in crate::backend::rust) struct Buses([RouteKind; 6]);

impl Buses {
    pub fn of(routes: &[Route<'_>; 6]) -> Self {
        Buses(std::array::from_fn(|at| routes[at].kind()))
    }

    /// Returns whether the item of the location cannot be accessed on any bus.
    pub fn is_empty(self) -> bool {
        self == Buses::default()
    }

    /// Returns whether all accesses use the item's own address without a conversion, and each bus of the location
    /// allows all accesses that the item allows.
    pub fn is_direct(self) -> bool {
        self.0.iter().all(|kind| matches!(kind, RouteKind::Absent | RouteKind::One(PathKind::Direct)))
    }

    /// Returns the buses that at least one of two locations has.
    pub fn union(self, other: Buses) -> Buses {
        Buses(std::array::from_fn(|at| self.0[at].max(other.0[at])))
    }

    /// Returns the path of the location type if the runtime defines it.
    pub fn path(self) -> Option<&'static str> {
        let [canopen, coe, modbus, serial, image, esc] = self.0.map(|kind| kind != RouteKind::Absent);
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

    /// Returns the fields of the location type: its buses, each with its route type.
    pub fn fields(self) -> Vec<Doc> {
        let fields = RouteBus::ALL.iter().zip(self.0).filter_map(|(bus, kind)| Some((bus, kind.ty(*bus)?)));
        fields.map(|(bus, ty)| seq![bus.field(), ": rt::", bus.type_name(), " => ", ty]).collect()
    }

    /// Returns the name of the location type. The name is also used as a part of other names.
    pub fn word(self) -> String {
        let words: String = RouteBus::ALL.iter().zip(self.0).map(|(bus, kind)| kind.word(*bus)).collect();
        format!("On{}", if words.is_empty() { "NoBus" } else { words.as_str() })
    }

    /// Returns the names of the buses for a sentence.
    pub fn titles(self) -> String {
        let present = RouteBus::ALL.iter().zip(self.0).filter(|(_, kind)| *kind != RouteKind::Absent);
        let titles: Vec<&str> = present.map(|(bus, _)| bus.title()).collect();
        match titles.as_slice() {
            [] => "no bus".to_owned(),
            [title] => (*title).to_owned(),
            [first @ .., last] => format!("{} and {last}", first.join(", ")),
        }
    }
}
