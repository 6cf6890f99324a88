//! Windows: what takes the number of an item, and what has its value then.

use super::item_addresses;
use super::route::RouteBus;
use super::scope::Scope;
use crate::ir::{Binding, Device, IndirectBinding, Item, ItemId, ItemRef, Procedure, Step, WindowSide};
use crate::names::{self, Case, Wish};

/// How often a number is looked at that the device clears, where nothing says for how many milliseconds.
const POLLS: u32 = 100;

/// A window in one direction on one bus.
#[derive(Clone, Debug)]
pub(super) struct Window {
    pub key: (String, u8, RouteBus, bool),
    pub side: WindowSide,
    /// Bits of the number.
    pub number_bits: u32,
    /// Bits of the value, and whether it has a sign.
    pub value: (u32, bool),
    /// What makes the addresses of both.
    pub addresses: [String; 2],
    pub number_first: bool,
    pub handshake: String,
    pub name: String,
}

/// All windows through which an item of the device is found, each once.
pub(super) fn windows(scope: &Scope<'_>, device: &Device) -> Vec<Window> {
    let mut found: Vec<Window> = Vec::new();
    for item in scope.groups.iter().flat_map(|group| &group.items) {
        for binding in item.bindings.iter().filter_map(indirect) {
            for bus in RouteBus::ALL {
                for (side, is_write) in [(&binding.read, false), (&binding.write, true)] {
                    let Some(side) = side else { continue };
                    let key = (binding.space.to_string(), binding.window, bus, is_write);
                    if !is_on(binding, bus) || found.iter().any(|own| own.key == key && own.side == *side) {
                        continue;
                    }
                    found.extend(window(scope, device, side, key));
                }
            }
        }
    }
    let titles: Vec<String> = found.iter().map(title).collect();
    let wishes: Vec<Wish<'_>> = found
        .iter()
        .zip(&titles)
        .map(|(own, name)| Wish { name, fallback: "window".into(), suffix: own.key.1.to_string() })
        .collect();
    let names = names::unique(&wishes, &[], Case::Snake);
    for (window, name) in found.iter_mut().zip(names) {
        window.name = name.to_ascii_uppercase();
    }
    found
}

pub(super) fn indirect(binding: &Binding) -> Option<&IndirectBinding> {
    match binding {
        Binding::Indirect(own) => Some(own),
        _ => None,
    }
}

fn is_on(binding: &IndirectBinding, bus: RouteBus) -> bool {
    bus != RouteBus::Esc && binding.buses.contains(bus.of_items())
}

/// The position of the window of an item on a bus.
pub(super) fn position(windows: &[Window], binding: &IndirectBinding, bus: RouteBus, is_write: bool) -> Option<usize> {
    let side = if is_write { &binding.write } else { &binding.read }.as_ref()?;
    let number = u64::from(binding.number);
    windows.iter().position(|own| {
        let (space, window, of, writes) = &own.key;
        let is_own = *space == binding.space && *window == binding.window && *of == bus && *writes == is_write;
        is_own && own.side == *side && is_on(binding, bus) && (own.number_bits >= 64 || number >> own.number_bits == 0)
    })
}

fn title(own: &Window) -> String {
    let (space, _, bus, is_write) = &own.key;
    format!("{space} {} {}", if *is_write { "write" } else { "read" }, bus.word().to_lowercase())
}

/// The window, where the bus has all of it.
fn window(scope: &Scope<'_>, device: &Device, side: &WindowSide, key: (String, u8, RouteBus, bool)) -> Option<Window> {
    let (_, _, bus, is_write) = key;
    let (number, value) = (scope.referred(&side.number)?, scope.referred(&side.value)?);
    let addresses =
        [item_addresses::address(scope, number, bus, true)?, item_addresses::address(scope, value, bus, is_write)?];
    let [number_type, value_type] = [number, value].map(|item| scope.base(item.type_on(bus.of_items())));
    let bits = |ty: crate::ir::Type| ty.bits().filter(|bits| (1..=64).contains(bits));
    let procedure = side.procedure.as_ref().and_then(|reference| device.procedure(reference));
    let told = procedure.map(|own| Told::of(own, side)).unwrap_or_default();
    let is_cleared = number.behaviour.as_ref().is_some_and(|own| own.self_clearing);
    let clears = side.clears.unwrap_or(told.clears || is_cleared);
    let milliseconds = |given: Option<u32>| given.map(|own| own.min(u16::MAX.into()));
    let timeout = milliseconds(side.timeout.or(told.timeout)).unwrap_or(POLLS);
    let handshake = match milliseconds(side.wait.or(told.wait)).filter(|own| *own > 0) {
        _ if clears => format!("rt::Handshake::cleared({timeout})"),
        Some(wait) => format!("rt::Handshake::after({wait})"),
        None => "rt::Handshake::NONE".to_owned(),
    };
    Some(Window {
        number_bits: bits(number_type)?,
        value: (bits(value_type)?, value_type.is_signed()),
        addresses,
        // What the device clears starts the transfer.
        number_first: side.number_first.or(told.number_first).unwrap_or(!clears),
        handshake,
        side: side.clone(),
        key,
        name: String::new(),
    })
}

/// What the steps of a procedure tell of a handshake.
#[derive(Default)]
struct Told {
    clears: bool,
    timeout: Option<u32>,
    wait: Option<u32>,
    number_first: Option<bool>,
}

impl Told {
    fn of(procedure: &Procedure, side: &WindowSide) -> Self {
        let mut told = Told::default();
        let writes = |step: &Step, id: ItemId| match step {
            Step::Write(item, _) | Step::WriteBits(item, ..) | Step::WriteArgument(item, _) => item.id == Some(id),
            _ => false,
        };
        for step in &procedure.steps {
            match step {
                Step::WaitFor(item, _, value, timeout) if item.id == side.number.id && value.as_int() == Some(0) => {
                    (told.clears, told.timeout) = (true, *timeout);
                }
                Step::Delay(time) => told.wait = Some(told.wait.unwrap_or(0).saturating_add(*time)),
                _ => {}
            }
        }
        let place = |item: &ItemRef| item.id.and_then(|id| procedure.steps.iter().position(|step| writes(step, id)));
        told.number_first = place(&side.number).zip(place(&side.value)).map(|(number, value)| number < value);
        told
    }
}

/// Whether values of an item can go through a window: integers, and numbers of the same width.
pub(super) fn carries(scope: &Scope<'_>, item: &Item, window: &Window) -> bool {
    use crate::ir::Type;
    match scope.base(item.ty) {
        Type::Boolean | Type::Integer(1..=64) | Type::Unsigned(1..=64) => true,
        ty @ (Type::Real32 | Type::Real64) => ty.bits() == Some(window.value.0),
        _ => false,
    }
}
