//! Windows. A window is a pair of items: the first item selects a value by its number, and the second item contains the
//! selected value.

use super::item_addresses;
use super::route::RouteBus;
use super::scope::Scope;
use crate::ir::{Binding, Device, IndirectBinding, Item, ItemId, ItemRef, Procedure, Step, WindowSide};
use crate::names::{self, Case, NameRequest};

/// Maximum number of polls until the device clears the number in the window. This value applies if the description
/// states no timeout. Otherwise, the timeout in milliseconds is the number of polls.
const POLLS: u32 = 100;

/// A window through which a client reads or writes items on one bus.
#[derive(Clone, Debug)]
pub(super) struct Window {
    pub key: (String, u8, RouteBus, bool),
    pub side: WindowSide,
    /// Number of bits of the item that selects the value.
    pub number_bits: u32,
    /// Number of bits of the item that contains the value, and whether this item is signed.
    pub value: (u32, bool),
    /// Code that creates the addresses of the number and of the value.
    pub addresses: [String; 2],
    pub number_first: bool,
    pub handshake: String,
    pub name: String,
}

/// Returns all windows through which items of the device are accessed, without repetitions.
pub(super) fn windows(scope: &Scope<'_>, device: &Device) -> Vec<Window> {
    let mut found: Vec<Window> = Vec::new();
    for item in scope.groups.iter().flat_map(|group| &group.items) {
        for binding in item.bindings.iter().filter_map(indirect) {
            for bus in RouteBus::ALL {
                for (side, is_write) in [(&binding.read, false), (&binding.write, true)] {
                    let Some(side) = side else { continue };
                    let key = (binding.space.to_string(), binding.window, bus, is_write);
                    if !is_on(binding, bus) || found.iter().any(|window| window.key == key && window.side == *side) {
                        continue;
                    }
                    found.extend(window(scope, device, side, key));
                }
            }
        }
    }
    let titles: Vec<String> = found.iter().map(title).collect();
    let name_requests = found.iter().zip(&titles).map(|(window, name)| NameRequest {
        name,
        fallback: "window".into(),
        suffix: window.key.1.to_string(),
    });
    let names = names::unique(name_requests, &[], Case::Snake);
    for (window, name) in found.iter_mut().zip(names) {
        window.name = name.to_ascii_uppercase();
    }
    found
}

pub(super) fn indirect(binding: &Binding) -> Option<&IndirectBinding> {
    match binding {
        Binding::Indirect(indirect) => Some(indirect),
        _ => None,
    }
}

fn is_on(binding: &IndirectBinding, bus: RouteBus) -> bool {
    bus != RouteBus::Esc && binding.buses.contains(bus.of_items())
}

/// Returns the position of the window that a binding uses on a bus.
pub(super) fn position(windows: &[Window], binding: &IndirectBinding, bus: RouteBus, is_write: bool) -> Option<usize> {
    let side = if is_write { &binding.write } else { &binding.read }.as_ref()?;
    let number = u64::from(binding.number);
    windows.iter().position(|candidate| {
        let (space, window, of, writes) = &candidate.key;
        let is_of_binding = *space == binding.space && *window == binding.window && *of == bus && *writes == is_write;
        is_of_binding
            && candidate.side == *side
            && is_on(binding, bus)
            && (candidate.number_bits >= 64 || number >> candidate.number_bits == 0)
    })
}

fn title(window: &Window) -> String {
    let (space, _, bus, is_write) = &window.key;
    format!("{space} {} {}", if *is_write { "write" } else { "read" }, bus.word().to_lowercase())
}

/// Returns the read or write window of a binding on one bus. Returns `None` if the number or the value has no usable
/// address on this bus, or does not have 1 to 64 bits.
fn window(scope: &Scope<'_>, device: &Device, side: &WindowSide, key: (String, u8, RouteBus, bool)) -> Option<Window> {
    let (_, _, bus, is_write) = key;
    let (number, value) = (scope.referred(&side.number)?, scope.referred(&side.value)?);
    let addresses =
        [item_addresses::address(scope, number, bus, true)?, item_addresses::address(scope, value, bus, is_write)?];
    let [number_type, value_type] = [number, value].map(|item| scope.base(item.type_on(bus.of_items())));
    let bits = |ty: crate::ir::Type| ty.bits().filter(|bits| (1..=64).contains(bits));
    let procedure = side.procedure.as_ref().and_then(|reference| device.procedure(reference));
    let implied = procedure.map(|procedure| ImpliedHandshake::of(procedure, side)).unwrap_or_default();
    let is_cleared = number.behavior.as_ref().is_some_and(|behavior| behavior.self_clearing);
    let clears = side.clears.unwrap_or(implied.clears || is_cleared);
    let limited = |given: Option<u32>| given.map(|milliseconds| milliseconds.min(u16::MAX.into()));
    let timeout = limited(side.timeout.or(implied.timeout)).unwrap_or(POLLS);
    let handshake = match limited(side.wait.or(implied.wait)).filter(|wait| *wait > 0) {
        _ if clears => format!("rt::Handshake::cleared({timeout})"),
        Some(wait) => format!("rt::Handshake::after({wait})"),
        None => "rt::Handshake::NONE".to_owned(),
    };
    Some(Window {
        number_bits: bits(number_type)?,
        value: (bits(value_type)?, value_type.is_signed()),
        addresses,
        // If the device clears the number after a transfer, writing the number starts the transfer. The number is
        // therefore written last.
        number_first: side.number_first.or(implied.number_first).unwrap_or(!clears),
        handshake,
        side: side.clone(),
        key,
        name: String::new(),
    })
}

/// Properties of a handshake that the steps of a procedure imply.
#[derive(Default)]
struct ImpliedHandshake {
    clears: bool,
    timeout: Option<u32>,
    wait: Option<u32>,
    number_first: Option<bool>,
}

impl ImpliedHandshake {
    fn of(procedure: &Procedure, side: &WindowSide) -> Self {
        let mut implied = ImpliedHandshake::default();
        let writes = |step: &Step, id: ItemId| match step {
            Step::Write(item, _) | Step::WriteBits(item, ..) | Step::WriteArgument(item, _) => item.id == Some(id),
            _ => false,
        };
        for step in &procedure.steps {
            match step {
                Step::WaitFor(item, _, value, timeout) if item.id == side.number.id && value.as_int() == Some(0) => {
                    (implied.clears, implied.timeout) = (true, *timeout);
                }
                Step::Delay(time) => implied.wait = Some(implied.wait.unwrap_or(0).saturating_add(*time)),
                _ => {}
            }
        }
        let position = |item: &ItemRef| item.id.and_then(|id| procedure.steps.iter().position(|step| writes(step, id)));
        implied.number_first = position(&side.number).zip(position(&side.value)).map(|(number, value)| number < value);
        implied
    }
}

/// Returns whether a window can transfer values of an item. Windows transfer Booleans, integers, and real numbers that
/// have the width of the window's value.
pub(super) fn carries(scope: &Scope<'_>, item: &Item, window: &Window) -> bool {
    use crate::ir::Type;
    match scope.base(item.ty) {
        Type::Boolean | Type::Integer(1..=64) | Type::Unsigned(1..=64) => true,
        ty @ (Type::Real32 | Type::Real64) => ty.bits() == Some(window.value.0),
        _ => false,
    }
}
