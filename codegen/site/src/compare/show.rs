//! Formats values for reports.

use lexibus_codegen::facts;
use lexibus_codegen::facts::words::PLAIN;
use lexibus_codegen::ir::{
    Access, AxisStep, Bus, Buses, Category, CompactString, Condition, Direction, Fit, LocalText, Numbers, ObjectBuses,
    ObjectCode, Oversampling, Reference, SharedList, SlotNumbers, Trigger, Value, Zone,
};
use lexibus_codegen::number::{self, hex, hex16, hex32};

/// Formats a value for reports. Different values must have different texts.
pub(super) trait Show {
    fn show(&self) -> String;
}

/// Implements `Show` for types that implement `Display`.
macro_rules! show_as_text {
    ($($type:ty),*) => {
        $(impl Show for $type {
            fn show(&self) -> String {
                self.to_string()
            }
        })*
    };
}

show_as_text!(u8, u16, u32, u64, i32, i64, i128, f64, Bus, Buses, CompactString, str, String, Value);

impl<Id> Show for Reference<Id> {
    fn show(&self) -> String {
        self.name.to_string()
    }
}

/// Implements `Show` by matching the value against patterns, each with the text of the matching values.
macro_rules! show_as_name {
    ($($type:ident { $($pattern:pat => $name:expr),* $(,)? })*) => {
        $(impl Show for $type {
            fn show(&self) -> String {
                match self { $($pattern => ($name).to_string()),* }
            }
        })*
    };
}

show_as_name! {
    bool { true => "yes", false => "no" }
    Access { access => access.name() }
    ObjectCode { code => code.name() }
    Direction { Direction::Receive => "received by the device", Direction::Transmit => "sent by the device" }
    Trigger {
        Trigger::Rising => "rising edge",
        Trigger::Falling => "falling edge",
        Trigger::Toggle => "both edges",
        Trigger::SelfClearing => "cleared by the device",
    }
    Zone { Zone::Reserved => "reserved", Zone::Vendor => "vendor-specific" }
    Category {
        Category::Mandatory => "mandatory",
        Category::Optional => "optional",
        Category::Conditional => "conditional",
        Category::Manufacturer => "manufacturer-specific",
    }
    Condition { condition => PLAIN.holds(condition) }
    LocalText { text => format!("{}: {}", text.language, text.text) }
    Fit { fit => facts::device::fit(fit) }
    AxisStep {
        AxisStep::Index(step) => format!("index + {}", hex(*step)),
        AxisStep::SubIndex => "sub-index = axis",
        AxisStep::SubIndexStride(stride) => format!("sub-index + {stride}"),
    }
    ObjectBuses { buses => [("CANopen", buses.canopen), ("EtherCAT", buses.coe)].into_iter().filter(|(_, is_on)| *is_on)
        .map(|(name, _)| name).collect::<Vec<_>>().join(", ") }
    Numbers { numbers => numbers.0.iter().map(|&(first, last)| number::range(first, last, |number| number.to_string()))
        .collect::<Vec<_>>().join(", ") }
    SlotNumbers { places => [("allowed", &places.allowed), ("fixed", &places.fixed), ("used", &places.used)].into_iter()
        .filter(|(_, numbers)| !numbers.is_empty()).map(|(kind, numbers)| format!("{kind} {}", numbers.show())).collect::<Vec<_>>().join("; ") }
    Oversampling { oversampling => {
        let Oversampling { factor, min, max, index_increment } = oversampling;
        let all = [("factor", factor), ("minimum", min), ("maximum", max), ("index increment", index_increment)];
        all.into_iter().filter_map(|(name, number)| Some(format!("{name} {}", (*number)?))).collect::<Vec<_>>().join(", ")
    } }
}

impl<T: Show> Show for Option<T> {
    fn show(&self) -> String {
        self.as_ref().map(T::show).unwrap_or_default()
    }
}

impl<T: Show + ?Sized> Show for Box<T> {
    fn show(&self) -> String {
        T::show(self)
    }
}

impl<T: Show> Show for [T] {
    fn show(&self) -> String {
        self.iter().map(T::show).collect::<Vec<_>>().join(", ")
    }
}

impl<T: Show> Show for Vec<T> {
    fn show(&self) -> String {
        self.as_slice().show()
    }
}

impl<T: Show> Show for SharedList<T> {
    fn show(&self) -> String {
        (**self).show()
    }
}

impl<A: Show, B: Show> Show for (A, B) {
    fn show(&self) -> String {
        format!("{} {}", self.0.show(), self.1.show())
    }
}

/// Formats an index in hexadecimal notation.
pub(super) fn index(number: &u16) -> String {
    hex16(*number)
}

/// Formats a list of indices.
pub(super) fn indices(numbers: &[u16]) -> String {
    numbers.iter().map(index).collect::<Vec<_>>().join(", ")
}

/// Formats an identity number in hexadecimal notation. The text is empty if there is no number.
pub(super) fn ident(number: &Option<u32>) -> String {
    number.map(hex32).unwrap_or_default()
}
