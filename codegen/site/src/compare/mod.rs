//! What changed between two versions of a description, and whether code that was written for the old one still fits.
//!
//! ```
//! use lexibus_site::compare::{compare, Judgement};
//! use lexibus_codegen::compile::{check, Options};
//! use lexibus_codegen::source::Source;
//!
//! let eds = |access: &str| {
//!     let text = format!("[DeviceInfo]\n[ManufacturerObjects]\nSupportedObjects=1\n1=0x2000\n\
//!                         [2000]\nParameterName=Gain\nDataType=6\nAccessType={access}\n");
//!     check(Source::new("d.eds", text.into()), &Options::default()).catalog.expect("a device")
//! };
//! let changes = compare(&eds("rw"), &eds("ro"));
//! assert_eq!((changes.len(), changes[0].judgement), (1, Judgement::Breaking));
//! assert_eq!(changes[0].to_string(), "breaking: 0x2000:00 Gain: access rw, now ro");
//! ```

mod items;
mod machines;
mod messages;
mod pdos;
mod types;

use std::collections::BTreeMap;
use std::fmt;

use serde::Serialize;

use lexibus_codegen::facts;
use lexibus_codegen::ir::{Catalog, Device, Group, ModbusTable, Module, ObjectBuses, Pdo, ProcessImage, TypeDef};
use lexibus_codegen::passes::names_unique::{self, Case, Wish};
use lexibus_codegen::text::printable;

/// Whether code that was written for the old description still fits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Judgement {
    /// It compiles, and what it does is still allowed.
    Compatible,
    /// It doesn't compile, is refused at run time, or means something else.
    Breaking,
}

impl Judgement {
    /// The word that reports print.
    pub fn name(self) -> &'static str {
        match self {
            Judgement::Compatible => "compatible",
            Judgement::Breaking => "breaking",
        }
    }
}

/// A difference between two descriptions.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Change {
    /// The device or module, where there are several.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub owner: String,
    /// What changed: address and name.
    pub element: String,
    /// Which fact of it: `access`, `type`, `range`, `layout`; `added`, `removed`.
    pub fact: &'static str,
    /// What it was; empty for what is new.
    pub old: String,
    /// What it is; empty for what is gone.
    pub new: String,
    /// What it means for generated code.
    pub judgement: Judgement,
}

impl fmt::Display for Change {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Change { owner, element, fact, old, new, judgement } = self;
        // They are texts of the descriptions, and this is for a terminal.
        let [owner, element, old, new] = [owner, element, old, new].map(|text| printable(text));
        let of = if owner.is_empty() { String::new() } else { format!("{owner}: ") };
        write!(f, "{}: {of}{element}", judgement.name())?;
        match (old.is_empty(), new.is_empty()) {
            (true, true) => write!(f, ": {fact}"),
            (true, false) => write!(f, ": {fact}, {new}"),
            (false, true) => write!(f, ": {fact}, was {old}"),
            (false, false) => write!(f, ": {fact} {old}, now {new}"),
        }
    }
}

/// What changed from `old` to `new`, in the order of the old description; what is new stands behind.
pub fn compare(old: &Catalog, new: &Catalog) -> Vec<Change> {
    let mut changes = Changes::default();
    let is_one = old.devices.len() == 1 && new.devices.len() == 1;
    for (old, new) in pairs(&old.devices, &new.devices, device_key, is_one) {
        changes.owner = if is_one { String::new() } else { old.or(new).map(title).unwrap_or_default() };
        match (old, new) {
            (Some(old), Some(new)) => device(old, new, &mut changes),
            (old, new) => changes.existence("device", old.is_some(), new.is_some()),
        }
    }
    for (old, new) in pairs_of_modules(&old.modules, &new.modules) {
        changes.owner = old.or(new).map(|own| format!("module {}", own.name)).unwrap_or_default();
        match (old, new) {
            (Some(old), Some(new)) => Scope::of_module(old).compare(&Scope::of_module(new), &mut changes),
            (old, new) => changes.existence("module", old.is_some(), new.is_some()),
        }
    }
    changes.owner.clear();
    for (old_own, new_own) in
        pairs(&old.submodules, &new.submodules, |own| format!("{:08X} {}", own.ident, own.id), false)
    {
        changes.owner = old_own.or(new_own).map(|own| format!("submodule {}", own.name)).unwrap_or_default();
        match (old_own, new_own) {
            (Some(one), Some(other)) => {
                Scope::of_submodule(old, one).compare(&Scope::of_submodule(new, other), &mut changes);
            }
            (one, other) => changes.existence("submodule", one.is_some(), other.is_some()),
        }
    }
    changes.list
}

/// Changes that were found so far.
#[derive(Default)]
struct Changes {
    owner: String,
    list: Vec<Change>,
}

impl Changes {
    fn push(&mut self, element: &str, fact: &'static str, (old, new): (String, String), judgement: Judgement) {
        let (owner, element) = (self.owner.clone(), element.to_owned());
        self.list.push(Change { owner, element, fact, old, new, judgement });
    }

    /// A fact that is as it was, or changed.
    fn fact(&mut self, element: &str, fact: &'static str, (old, new): (String, String), judgement: Judgement) {
        if old != new {
            self.push(element, fact, (old, new), judgement);
        }
    }

    /// What there is no more, or not before.
    fn existence(&mut self, element: &str, was: bool, is: bool) {
        let (fact, judgement) = match (was, is) {
            (true, false) => ("removed", Judgement::Breaking),
            (false, true) => ("added", Judgement::Compatible),
            _ => return,
        };
        self.push(element, fact, (String::new(), String::new()), judgement);
    }
}

/// A device, a module or a submodule: what has values of its own.
struct Scope<'a> {
    groups: Vec<&'a Group>,
    types: &'a [TypeDef],
    pdos: &'a [Pdo],
    images: Vec<&'a ProcessImage>,
    /// The buses that objects are on.
    buses: ObjectBuses,
}

impl<'a> Scope<'a> {
    fn of_device(own: &'a Device) -> Self {
        Scope {
            groups: own.groups.iter().collect(),
            types: &own.types,
            pdos: &own.process_data.pdos,
            images: own.process_data.images.iter().collect(),
            buses: facts::pdo::buses(own),
        }
    }

    fn of_module(own: &'a Module) -> Self {
        Scope {
            groups: own.fixed_objects.iter().chain(&own.groups).collect(),
            types: &own.types,
            pdos: &own.process_data.pdos,
            images: own.process_data.images.iter().collect(),
            buses: ObjectBuses::COE,
        }
    }

    fn of_submodule(catalog: &'a Catalog, own: &'a lexibus_codegen::ir::Submodule) -> Self {
        let images = own.input.iter().chain(&own.output).map(|data| &data.image).collect();
        Scope {
            groups: own.records.iter().collect(),
            types: &catalog.types,
            pdos: &[],
            images,
            buses: ObjectBuses::COE,
        }
    }

    fn compare(&self, new: &Scope<'_>, changes: &mut Changes) {
        items::compare(self, new, changes);
        pdos::compare(self, new, changes);
    }
}

fn device(old: &Device, new: &Device, changes: &mut Changes) {
    let number = |own: Option<u32>| own.map(|own| format!("0x{own:08X}")).unwrap_or_default();
    let (one, other) = (&old.identity, &new.identity);
    for (fact, old, new) in [
        ("vendor-ID", one.vendor_id, other.vendor_id),
        ("product code", one.product_code, other.product_code),
        ("revision", one.revision_number, other.revision_number),
    ] {
        changes.fact("the device", fact, (number(old), number(new)), Judgement::Compatible);
    }
    changes.fact("the device", "name", (title(old), title(new)), renamed(&title(old), &title(new)));
    requests(old, new, changes);
    Scope::of_device(old).compare(&Scope::of_device(new), changes);
    messages::compare(old, new, changes);
    machines::compare(old, new, changes);
    types::codes(&old.code_tables, &new.code_tables, changes);
}

fn judged(breaks: bool) -> Judgement {
    if breaks {
        Judgement::Breaking
    } else {
        Judgement::Compatible
    }
}

/// The requests that the tables of Modbus take.
fn requests(old: &Device, new: &Device, changes: &mut Changes) {
    let list = |functions: &[u8]| functions.iter().map(u8::to_string).collect::<Vec<_>>().join(", ");
    let number = |own: Option<u16>| own.map(|own| own.to_string()).unwrap_or_default();
    for (was, is) in pairs(&old.modbus, &new.modbus, |own| own.space.title(), false) {
        let Some(own) = was.or(is) else { continue };
        let element = format!("Modbus table {}", own.space.title());
        let functions = |own: Option<&ModbusTable>| own.map(|own| own.functions.clone()).unwrap_or_default();
        let (before, now) = (functions(was), functions(is));
        // Without a list, all functions are accepted.
        let is_lost = !now.is_empty() && (before.is_empty() || before.iter().any(|own| !now.contains(own)));
        changes.fact(&element, "function codes", (list(&before), list(&now)), judged(is_lost));
        for (fact, most) in [
            ("longest read", (|own: &ModbusTable| own.max_read) as fn(&ModbusTable) -> Option<u16>),
            ("longest write", |own: &ModbusTable| own.max_write),
        ] {
            let (before, now) = (was.and_then(most), is.and_then(most));
            let is_shorter = now.is_some_and(|now| before.is_none_or(|before| now < before));
            changes.fact(&element, fact, (number(before), number(now)), judged(is_shorter));
        }
        let split = |own: Option<&ModbusTable>| own.is_some_and(|own| own.split);
        let (before, now) = (split(was), split(is));
        let texts = (before.to_string(), now.to_string());
        changes.fact(&element, "longer values in several requests", texts, judged(before && !now));
    }
}

fn title(device: &Device) -> String {
    let names = [&device.name, &device.identity.product_name, &device.identity.order_code, &device.id];
    names.into_iter().find(|name| !name.is_empty()).map(ToString::to_string).unwrap_or_default()
}

fn device_key(own: &Device) -> String {
    format!("{:?} {} {}", own.identity.product_code, title(own), own.id)
}

fn pairs_of_modules<'a>(old: &'a [Module], new: &'a [Module]) -> Vec<(Option<&'a Module>, Option<&'a Module>)> {
    pairs(old, new, |own| format!("{:08X} {}", own.number, own.id), false)
}

/// What was and what is, by a key: what is new stands behind. Those that are `alone` on both sides belong together.
fn pairs<'a, T, K: Ord>(
    old: &'a [T],
    new: &'a [T],
    key: impl Fn(&T) -> K,
    alone: bool,
) -> Vec<(Option<&'a T>, Option<&'a T>)> {
    if alone {
        return vec![(old.first(), new.first())];
    }
    let mut left: BTreeMap<K, Vec<usize>> = BTreeMap::new();
    for (position, own) in new.iter().enumerate().rev() {
        left.entry(key(own)).or_default().push(position);
    }
    let mut pair = |own: &T| left.get_mut(&key(own)).and_then(Vec::pop).map(|position| &new[position]);
    let mut all: Vec<_> = old.iter().map(|own| (Some(own), pair(own))).collect();
    let mut added: Vec<usize> = left.into_values().flatten().collect();
    added.sort_unstable();
    all.extend(added.into_iter().map(|position| (None, Some(&new[position]))));
    all
}

/// Compares what has the same name, and tells what is gone and what is new.
fn by_name<T>(
    kind: &str,
    (old, new): (&[T], &[T]),
    name: impl Fn(&T) -> &str,
    changes: &mut Changes,
    both: impl Fn((&T, &T), &str, &mut Changes),
) {
    for (was, is) in pairs(old, new, |own| name(own).to_owned(), false) {
        let Some(own) = was.or(is) else { continue };
        let element = format!("{kind} {}", name(own));
        match was.zip(is) {
            Some(pair) => both(pair, &element, changes),
            None => changes.existence(&element, was.is_some(), is.is_some()),
        }
    }
}

/// Whether a new name is another identifier.
fn renamed(old: &str, new: &str) -> Judgement {
    let identifier = |name: &str| names_unique::unique(&[Wish::new(name, "item", "")], &[], Case::Snake);
    match identifier(old) == identifier(new) {
        true => Judgement::Compatible,
        false => Judgement::Breaking,
    }
}
