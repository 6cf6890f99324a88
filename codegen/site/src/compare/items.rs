//! Objects, registers and parameters.

use std::collections::{BTreeMap, HashMap, HashSet, VecDeque};

use super::{renamed, types, Changes, Judgement, Scope};
use lexibus_codegen::facts::physical::Physical;
use lexibus_codegen::facts::words::PLAIN;
use lexibus_codegen::ir::{
    Access, Behaviour, Binding, Group, Item, Limits, ObjectBuses, Quantity, Scale, Storage, Type, Value,
};

/// An item with the group that has it.
type Placed<'a> = (&'a Group, &'a Item);

/// The first address of an item, and of a further item there its name.
type Key = (String, String);

pub(super) fn compare(old: &Scope<'_>, new: &Scope<'_>, changes: &mut Changes) {
    let (was, is) = (placed(old), placed(new));
    let mut gone = Vec::new();
    let mut told = HashSet::new();
    for (key, own) in &was {
        match is.get(key) {
            Some(other) => item((old, *own), (new, *other), &key.0, &mut told, changes),
            None => gone.push((key, *own)),
        }
    }
    let mut added: Vec<Option<(&Key, Placed<'_>)>> =
        is.iter().filter(|(key, _)| !was.contains_key(*key)).map(|(key, own)| Some((key, *own))).collect();
    let mut by_path: HashMap<(&str, &str), VecDeque<usize>> = HashMap::new();
    for (position, (_, own)) in added.iter().flatten().enumerate() {
        by_path.entry(path(*own)).or_default().push_back(position);
    }
    for ((key, _), own) in gone {
        // An item of the same name at another address has moved there.
        let same = by_path.get_mut(&path(own)).filter(|_| !own.1.name.is_empty()).and_then(VecDeque::pop_front);
        match same.and_then(|position| added[position].take()) {
            Some(((new_key, _), other)) => {
                let element = element(new_key, own);
                changes.push(&element, "address", (key.clone(), new_key.clone()), Judgement::Compatible);
                item((old, own), (new, other), new_key, &mut told, changes);
            }
            None => changes.existence(&element(key, own), true, false),
        }
    }
    for ((key, _), own) in added.into_iter().flatten() {
        changes.existence(&element(key, own), false, true);
    }
}

/// All items by their first address.
fn placed<'a>(scope: &Scope<'a>) -> BTreeMap<Key, Placed<'a>> {
    let mut all = BTreeMap::new();
    for group in &scope.groups {
        for item in &group.items {
            let key = item.bindings.first().map(address).unwrap_or_default();
            let key = (key, String::new());
            // A second name of an address is an item of its own.
            let key = if all.contains_key(&key) { (key.0, item.name.to_string()) } else { key };
            all.entry(key).or_insert((*group, item));
        }
    }
    all
}

fn address(binding: &Binding) -> String {
    match binding {
        Binding::Object { index, sub_index, .. } => format!("0x{index:04X}:{sub_index:02X}"),
        Binding::Register(own) => {
            let bit = own.bit_offset.map(|bit| format!(".{bit}")).unwrap_or_default();
            format!("{:?} {:05}{bit}", own.space, own.address).to_lowercase()
        }
        Binding::Record { index, bit_offset, .. } => format!("record 0x{index:04X} bit {bit_offset:05}"),
        Binding::Image(own) => format!("{} bit {:05}", own.image, own.bit_offset),
        Binding::Parameter { space, code } => format!("{space} 0x{code:04X}"),
        Binding::Ascii(name) => name.to_string(),
        Binding::EscMemory { address, .. } => format!("memory 0x{address:04X}"),
        Binding::Indirect(own) => format!("{} window 0x{:04X}", own.space, own.number),
    }
}

/// The buses of an address, each in the way in which the handle says so.
fn buses_of(binding: &Binding) -> Vec<&'static str> {
    vec![match binding {
        Binding::Object { buses: ObjectBuses { canopen: true, coe: true }, .. } => return vec!["CANopen", "EtherCAT"],
        Binding::Object { buses: ObjectBuses { coe: true, .. }, .. } => "EtherCAT",
        Binding::Object { .. } => "CANopen",
        Binding::Register(_) => "Modbus",
        Binding::Record { .. } => "PROFINET",
        Binding::Image(_) => "a process image",
        Binding::Parameter { .. } => "a serial line",
        Binding::Ascii(_) => "lines of text",
        Binding::EscMemory { .. } => "the controller's memory",
        Binding::Indirect(_) => "a window",
    }]
}

/// The buses on which an item is.
fn buses(item: &Item) -> Vec<&'static str> {
    let mut all: Vec<_> = item.bindings.iter().flat_map(buses_of).collect();
    all.sort_unstable();
    all.dedup();
    all
}

fn path<'a>((group, item): Placed<'a>) -> (&'a str, &'a str) {
    (&group.name, &item.name)
}

/// What a report calls an item.
fn element(key: &str, (group, item): Placed<'_>) -> String {
    let name = if item.name.is_empty() { &group.name } else { &item.name };
    format!("{key} {name}").trim().to_owned()
}

fn item(
    (old_scope, old): (&Scope<'_>, Placed<'_>),
    (new_scope, new): (&Scope<'_>, Placed<'_>),
    key: &str,
    told: &mut HashSet<(Type, Type)>,
    changes: &mut Changes,
) {
    let element = element(key, new);
    let (was, is) = (old.1, new.1);
    if old.0.index().is_some() && old.0.name != new.0.name && old.0.items.len() > 1 {
        let names = (old.0.name.to_string(), new.0.name.to_string());
        changes.fact(&element, "object", names, renamed(&old.0.name, &new.0.name));
    }
    changes.fact(&element, "name", (was.name.to_string(), is.name.to_string()), renamed(&was.name, &is.name));
    let type_of = |scope: &Scope<'_>, item: &Item| types::written(scope.types, item.ty);
    changes.fact(&element, "type", (type_of(old_scope, was), type_of(new_scope, is)), Judgement::Breaking);
    if told.insert((was.ty, is.ty)) {
        types::compare((old_scope.types, was.ty), (new_scope.types, is.ty), &element, changes);
    }
    let (on, now_on) = (buses(was), buses(is));
    let lost = on.iter().any(|bus| !now_on.contains(bus));
    let judged = |breaks: bool| if breaks { Judgement::Breaking } else { Judgement::Compatible };
    changes.fact(&element, "buses", (on.join(", "), now_on.join(", ")), judged(lost));
    let is_on_both = |bus: &&str| on.contains(bus) && now_on.contains(bus);
    let further = |item: &Item| {
        let on_both = |binding: &&Binding| buses_of(binding).iter().any(is_on_both);
        item.bindings.iter().skip(1).filter(on_both).map(address).collect::<Vec<_>>().join(", ")
    };
    changes.fact(&element, "further addresses", (further(was), further(is)), Judgement::Compatible);
    let narrower = !is.access.readable() && was.access.readable() || !is.access.writable() && was.access.writable();
    let access = |own: Access| own.name().to_owned();
    changes.fact(&element, "access", (access(was.access), access(is.access)), judged(narrower));
    let mappable = |item: &Item| match (item.mappable.rpdo, item.mappable.tpdo) {
        (true, true) => "any PDO".to_owned(),
        (true, false) => "RPDOs".to_owned(),
        (false, true) => "TPDOs".to_owned(),
        (false, false) => "none".to_owned(),
    };
    let lost = was.mappable.rpdo && !is.mappable.rpdo || was.mappable.tpdo && !is.mappable.tpdo;
    changes.fact(&element, "mappable into", (mappable(was), mappable(is)), judged(lost));
    if was.limits != is.limits {
        let narrower = judged(is_narrower(&was.limits, &is.limits));
        changes.push(&element, "range", (range(was), range(is)), narrower);
    }
    let default = |item: &Item| {
        item.default.as_ref().map(|value| PLAIN.of_item(item, value, &Value::to_string)).unwrap_or_default()
    };
    if was.default != is.default {
        changes.push(&element, "default", (default(was), default(is)), Judgement::Compatible);
    }
    let (orders_before, orders_now) = (orders(was), orders(is));
    if !orders_before.0.is_empty() && !orders_now.0.is_empty() {
        changes.fact(&element, "word order", (orders_before.0, orders_now.0), Judgement::Breaking);
    }
    if !orders_before.1.is_empty() && !orders_now.1.is_empty() {
        changes.fact(&element, "byte order", (orders_before.1, orders_now.1), Judgement::Breaking);
    }
    behaviour((was, is), &element, changes);
    let quantity = |item: &Item| item.quantity.as_deref().cloned().unwrap_or_default();
    let (was, is) = (quantity(was), quantity(is));
    changes.fact(&element, "unit", (was.unit.to_string(), is.unit.to_string()), Judgement::Breaking);
    changes.fact(&element, "scale", (scale(&was), scale(&is)), Judgement::Breaking);
    let sentinels =
        |own: &Quantity| own.sentinels.iter().map(|(raw, _)| raw.to_string()).collect::<Vec<_>>().join(", ");
    changes.fact(&element, "no number", (sentinels(&was), sentinels(&is)), Judgement::Breaking);
}

fn range(item: &Item) -> String {
    let physical = Physical::of(item.quantity.as_deref());
    match item.limits.allowed.is_empty() {
        true => PLAIN.range(&item.limits, physical.as_ref(), &Value::to_string),
        false => PLAIN.first_allowed(&item.limits, physical.as_ref(), &Value::to_string, usize::MAX),
    }
}

/// The order of the words of a longer value on Modbus, and of the bytes of a word.
fn orders(item: &Item) -> (String, String) {
    let register = item.bindings.iter().find_map(|binding| match binding {
        Binding::Register(own) => Some(own),
        _ => None,
    });
    let Some(own) = register else { return Default::default() };
    let words = match (own.count, own.low_word_first) {
        (..=1, _) => "",
        (_, true) => "low word first",
        (_, false) => "high word first",
    };
    (words.to_owned(), if own.bytes_swapped { "swapped" } else { "high byte first" }.to_owned())
}

/// Storage, side effects and conditions of writing.
fn behaviour((old, new): (&Item, &Item), element: &str, changes: &mut Changes) {
    let own = |item: &Item| item.behaviour.as_deref().cloned().unwrap_or_default();
    let (was, is) = (own(old), own(new));
    let stored = |own: &Behaviour| match &own.storage {
        Storage::Unknown => String::new(),
        Storage::Volatile => "volatile".to_owned(),
        Storage::Immediate => "at once".to_owned(),
        Storage::OnCommand(command) => format!("on command {command}"),
    };
    changes.fact(element, "non-volatile storage", (stored(&was), stored(&is)), Judgement::Compatible);
    let effective = |own: &Behaviour| own.effective.as_deref().unwrap_or_default().to_owned();
    changes.fact(element, "takes effect", (effective(&was), effective(&is)), Judgement::Compatible);
    let when = |own: &Behaviour| own.write_when.iter().map(|own| PLAIN.holds(own)).collect::<Vec<_>>().join(" and ");
    // A write that the device accepted may be refused.
    let judgement = if is.write_when.is_empty() { Judgement::Compatible } else { Judgement::Breaking };
    changes.fact(element, "writable while", (when(&was), when(&is)), judgement);
    let values = |own: &Behaviour| own.writable_values.iter().map(Value::to_string).collect::<Vec<_>>().join(", ");
    let judgement = if is.writable_values.is_empty() { Judgement::Compatible } else { Judgement::Breaking };
    changes.fact(element, "writable values", (values(&was), values(&is)), judgement);
    for (fact, was, is) in [
        ("cleared by the device", was.self_clearing, is.self_clearing),
        ("writable only once", was.write_once, is.write_once),
    ] {
        changes.fact(element, fact, (was.to_string(), is.to_string()), Judgement::Compatible);
    }
    let effects = |own: &Behaviour| own.side_effects.join("; ");
    changes.fact(element, "side effects", (effects(&was), effects(&is)), Judgement::Compatible);
}

/// Whether some value was allowed that isn't any more.
fn is_narrower(old: &Limits, new: &Limits) -> bool {
    let real = |own: &Option<Value>| own.as_ref().and_then(Value::as_real);
    let below = match (real(&old.low), real(&new.low)) {
        (None, Some(_)) => true,
        (Some(old), Some(new)) => new > old,
        _ => false,
    };
    let above = match (real(&old.high), real(&new.high)) {
        (None, Some(_)) => true,
        (Some(old), Some(new)) => new < old,
        _ => false,
    };
    let is_allowed = |value: f64| {
        new.allowed.iter().any(|(first, last)| {
            first.as_real().is_some_and(|first| first <= value) && last.as_real().is_some_and(|last| value <= last)
        })
    };
    let ends = old.allowed.iter().flat_map(|(first, last)| [first.as_real(), last.as_real()]).flatten();
    let listed = !new.allowed.is_empty() && (old.allowed.is_empty() || !ends.into_iter().all(is_allowed));
    below || above || listed
}

fn scale(own: &Quantity) -> String {
    match &own.scale {
        None => String::new(),
        Some(Scale::Linear { factor, offset }) if *offset == 0.0 => format!("× {factor}"),
        Some(Scale::Linear { factor, offset }) => format!("× {factor} + {offset}"),
        Some(Scale::Reciprocal { numerator }) => format!("{numerator} / raw"),
        Some(Scale::Fraction { bits, base }) => format!("/ 2^{bits} × {base}"),
        Some(Scale::Exponent { exponent, base, fraction }) => format!("/ 2^{fraction} × {base}^{exponent}"),
        Some(Scale::ByItem { item, factor }) => format!("× {factor} / {item}"),
        Some(Scale::TimesItem { item, factor }) => format!("× {factor} × {item}"),
    }
}
