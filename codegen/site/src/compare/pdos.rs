//! Compares cyclic data: PDOs, sync managers and process images.

use super::change::{Effect, Judgment};
use super::comparison::{
    compare_fields, fact, fact_as, list, or_default, rules, slice, text, Comparison, Elements, COMPARED, KEY, POSITION,
};
use super::names::identifier;
use super::pairing::{Key, Matching};
use super::show::{index, indices};
use super::types;
use lexibus_codegen::facts::cob_id::{self, CobId};
use lexibus_codegen::facts::pdo::title;
use lexibus_codegen::facts::words::PLAIN;
use lexibus_codegen::ir::{
    Direction, ObjectBuses, Pdo, PdoCommunication, PdoEntry, PdoEntryKind, ProcessData, ProcessImage, SyncManager,
    SyncManagerPurpose, Type, TypeDef, Value,
};
use lexibus_codegen::number::{self, hex8};

/// Compares the cyclic data of a device or a module. `buses` are the buses of the objects.
pub(super) fn compare(old: &ProcessData, new: &ProcessData, buses: ObjectBuses, comparison: &mut Comparison<'_>) {
    compare_fields!(ProcessData, old, new, comparison, {
        pdos: |old: &Vec<Pdo>, new: &Vec<Pdo>, comparison: &mut Comparison<'_>| pdos(old, new, buses, comparison),
        sync_managers: list(Elements::titled(|sync_manager: &SyncManager| format!("sync manager {}", sync_manager.number))
            .judged(Judgment::WIRE, Judgment::WIRE), sync_manager),
        images: list(images(), image),
    });
}

/// Compares PDOs, which are paired by direction, mapping object and buses.
fn pdos(old: &[Pdo], new: &[Pdo], buses: ObjectBuses, comparison: &mut Comparison<'_>) {
    let key = |pdo: &Pdo| format!("{:?} {} {:?}", pdo.direction, pdo.mapping_index, pdo.buses);
    for (old, new) in super::pairing::pairs(old, new, key, |_| String::new()) {
        let Some(either) = new.or(old) else { continue };
        let title = format!("{} {}", title(either, buses), either.name);
        comparison.within(title.trim(), |comparison| match (old, new) {
            (Some(old), Some(new)) => pdo(old, new, comparison),
            (Some(_), None) => comparison.removed(Judgment::API_AND_WIRE),
            _ => comparison.added(Judgment::ADDITION),
        });
    }
}

fn pdo(old: &Pdo, new: &Pdo, comparison: &mut Comparison<'_>) {
    compare_fields!(Pdo, old, new, comparison, {
        number: fact("number", Judgment::WIRE),
        name,
        communication: or_default(|one, other, comparison: &mut Comparison<'_>| {
            communication(one, other, new.direction, comparison);
        }),
        entries: slice(entries),
        fixed: fact_as("mapping", if new.fixed { Judgment::API } else { Judgment::API_COMPATIBLE }, |fixed| {
            if *fixed { "fixed" } else { "variable" }.to_owned()
        }),
        mandatory: fact("has to be assigned", Judgment::BEHAVIOR),
        sync_manager: fact("sync manager", Judgment::WIRE),
        excludes: |old: &Vec<u16>, new: &Vec<u16>, comparison: &mut Comparison<'_>| excludes(old, new, comparison),
        excluded_sync_managers: fact("excluded sync managers", Judgment::BEHAVIOR),
        sync_unit: fact("sync unit", Judgment::WIRE),
        from_object: fact("follows from its mapping object", Judgment::NONE),
        depends_on_slot: fact("index grows with the slot", Judgment::WIRE),
        depends_on_slot_group: fact("index grows with the slot group", Judgment::WIRE),
        is_virtual: fact("carries no data", Judgment::API_AND_WIRE),
        overwritten_by_module: fact("replaced by a module", Judgment::WIRE),
        oversampling: fact("oversampling", Judgment::WIRE),
        order: fact("position in the assignment", Judgment::WIRE),
        sra_parameter: fact("parameters of the safety-related application", Judgment::BEHAVIOR),
        names,
        max_bytes: fact("maximum length in bytes", Judgment::BEHAVIOR),
        documentation, doubts, extensions,
        implicit: fact("follows from the number of PDOs", Judgment::NONE),
    }, KEY => [direction, mapping_index, buses], POSITION => [origin]);
}

fn excludes(old: &[u16], new: &[u16], comparison: &mut Comparison<'_>) {
    let is_more = new.iter().any(|index| !old.contains(index));
    let judgment = if is_more { Judgment::BEHAVIOR } else { Judgment::BEHAVIOR_COMPATIBLE };
    comparison.texts("excludes", indices(old), indices(new), judgment);
}

fn communication(
    old: &PdoCommunication,
    new: &PdoCommunication,
    direction: Direction,
    comparison: &mut Comparison<'_>,
) {
    let cob_id = |id: &Option<Value>| {
        let text = |id| cob_id::text(id, CobId::of_pdo(direction)).unwrap_or_else(|| PLAIN.value(id));
        id.as_ref().map(text).unwrap_or_default()
    };
    compare_fields!(PdoCommunication, old, new, comparison, {
        index: fact_as("index", Judgment::WIRE, index),
        cob_id: fact_as("COB-ID", Judgment::WIRE, cob_id),
        transmission_type: fact("transmission type", Judgment::BEHAVIOR),
        inhibit_time: fact("inhibit time in 100 µs", Judgment::BEHAVIOR),
        event_timer: fact("event timer in ms", Judgment::BEHAVIOR),
        sync_start: fact("SYNC start value", Judgment::BEHAVIOR),
        writable: fact("writable sub-indices", Judgment::BEHAVIOR),
    });
}

/// Compares the entries of a PDO. The layout is compared as a whole, because an inserted entry changes the positions of
/// all later entries.
fn entries(old: &[PdoEntry], new: &[PdoEntry], comparison: &mut Comparison<'_>) {
    let (old_types, new_types) = comparison.types;
    let layouts = [Layout { entries: old, types: old_types }, Layout { entries: new, types: new_types }];
    let [mut old_text, mut new_text] = [layouts[0].texts(), layouts[1].texts()];
    if old_text != new_text {
        shorten(&mut old_text, &mut new_text);
        comparison.push("layout", old_text.join(", "), new_text.join(", "), layouts[0].effects_of(&layouts[1]));
    } else {
        lengths(old, new, comparison);
    }
    objects(old, new, comparison);
    // Compare the other facts of entries with equal keys.
    let matching = Matching::of(&entry_keys(old), &entry_keys(new));
    for (old, other) in old.iter().zip(matching.new_of_old) {
        if let Some(new) = other.map(|at| &new[at]) {
            comparison.within(&entry_title(new), |comparison| entry(old, new, comparison));
        }
    }
}

/// PDO entries with the types that they refer to.
struct Layout<'a> {
    entries: &'a [PdoEntry],
    types: &'a [TypeDef],
}

impl Layout<'_> {
    fn fields(&self) -> impl Iterator<Item = &PdoEntry> {
        self.entries.iter().filter(|entry| entry.kind != PdoEntryKind::Padding)
    }

    /// Returns a text for each entry of the layout, such as `0: UNSIGNED16 Controlword` and `16: INTEGER32 Target position`.
    fn texts(&self) -> Vec<String> {
        let text =
            |entry: &PdoEntry| format!("{}: {} {}", entry.bit_offset, types::name(self.types, entry.ty), entry.name);
        self.fields().map(text).collect()
    }

    /// Returns the effects of a changed layout. The entries become fields of a Rust struct, with the same names and
    /// types.
    fn effects_of(&self, new: &Layout<'_>) -> Judgment {
        let fields = |layout: &Layout<'_>| -> Vec<(String, String)> {
            layout.fields().map(|entry| (identifier(&entry.name), types::name(layout.types, entry.ty))).collect()
        };
        let api = if fields(self) != fields(new) { Effect::Breaking } else { Effect::Unaffected };
        Judgment { api, wire: self.wire_effect_of(new), ..Judgment::NONE }
    }

    /// Returns the effect on the communication. The change is breaking if the positions or lengths of the entries
    /// differ. Otherwise, the effect depends on the encodings of the old and new types at each position.
    fn wire_effect_of(&self, new: &Layout<'_>) -> Effect {
        let positions =
            |layout: &Layout<'_>| layout.entries.iter().map(|entry| (entry.bit_offset, entry.bits)).collect::<Vec<_>>();
        if positions(self) != positions(new) {
            return Effect::Breaking;
        }
        let types = self.entries.iter().zip(new.entries);
        let effects = types.map(|(one, other)| types::wire_effect(self.types, one.ty, new.types, other.ty));
        effects.max().unwrap_or_default()
    }
}

/// Returns the keys that pair entries. The key of an entry is its name and its bit offset. The key of a padding is its
/// position among the paddings.
fn entry_keys(entries: &[PdoEntry]) -> Vec<Key> {
    let mut paddings = 0_u32..;
    let name = |entry: &PdoEntry| match entry.kind {
        PdoEntryKind::Padding => format!("padding {}", paddings.next().unwrap_or_default()),
        _ => entry_title(entry),
    };
    entries.iter().map(name).map(|name| Key { name, position: String::new() }).collect()
}

/// Compares the lengths of entries. This comparison is necessary because the texts of the layouts contain neither
/// paddings nor lengths.
fn lengths(old: &[PdoEntry], new: &[PdoEntry], comparison: &mut Comparison<'_>) {
    let length = |entries: &[PdoEntry]| entries.iter().fold(0_u32, |bits, entry| bits.saturating_add(entry.bits));
    let of_all = |entries: &[PdoEntry]| format!("{} bits", length(entries));
    let of_each =
        |entries: &[PdoEntry]| entries.iter().map(|entry| entry.bits.to_string()).collect::<Vec<_>>().join(", ");
    if length(old) != length(new) {
        comparison.push("length", of_all(old), of_all(new), Judgment::WIRE);
    } else {
        comparison.texts("lengths of entries in bits", of_each(old), of_each(new), Judgment::WIRE);
    }
}

/// Returns a title for reports, such as `Status at bit 16`.
fn entry_title(entry: &PdoEntry) -> String {
    format!("{} at bit {}", entry.name, entry.bit_offset).trim_start().to_owned()
}

fn entry(old: &PdoEntry, new: &PdoEntry, comparison: &mut Comparison<'_>) {
    compare_fields!(PdoEntry, old, new, comparison, {
        // The reported layout change already shows all changed positions, except those of paddings.
        bit_offset: fact("first bit", Judgment::NONE),
        kind: fact_as("kind", Judgment::API, |kind| kind_name(*kind).to_owned()),
        name: text("name"),
        ty: |one: &Type, other: &Type, comparison: &mut Comparison<'_>| match new.kind {
            PdoEntryKind::Padding => {
                let (old_types, new_types) = comparison.types;
                let (old, new) = (types::name(old_types, *one), types::name(new_types, *other));
                comparison.texts("type", old, new, Judgment::NONE);
            }
            // The layout texts contain the types, so only the definitions of named types are compared.
            _ => types::compare_definitions(*one, *other, comparison),
        },
        fixed: fact("part of every mapping", Judgment::BEHAVIOR),
        depends_on_slot: fact("index grows with the slot", Judgment::WIRE),
        depends_on_slot_group: fact("index grows with the slot group", Judgment::WIRE),
        names,
    }, COMPARED => [index, sub_index, bits], "follows from index and sub-index" => [item], POSITION => [origin]);
}

fn kind_name(kind: PdoEntryKind) -> &'static str {
    match kind {
        PdoEntryKind::Item => "an item",
        PdoEntryKind::Unknown => "an object without a description",
        PdoEntryKind::Unnumbered => "data without an object",
        PdoEntryKind::Padding => "padding",
    }
}

/// Compares the lists of mapped objects.
fn objects(old: &[PdoEntry], new: &[PdoEntry], comparison: &mut Comparison<'_>) {
    let objects = |entries: &[PdoEntry]| -> Vec<String> {
        entries.iter().map(|entry| number::object(entry.index, entry.sub_index)).collect()
    };
    let (mut old, mut new) = (objects(old), objects(new));
    if old != new {
        shorten(&mut old, &mut new);
        comparison.push("mapped objects", old.join(", "), new.join(", "), Judgment::WIRE);
    }
}

/// Replaces the common beginning and the common end of both lists with `…`, each only if it consists of several
/// elements.
fn shorten(old: &mut Vec<String>, new: &mut Vec<String>) {
    let first = old.iter().zip(&*new).take_while(|(one, other)| one == other).count();
    let rest = (old.len() - first).min(new.len() - first);
    let last = old.iter().rev().zip(new.iter().rev()).take(rest).take_while(|(one, other)| one == other).count();
    for list in [old, new] {
        if last > 1 {
            list.splice(list.len() - last.., ["…".to_owned()]);
        }
        if first > 1 {
            list.splice(..first, ["…".to_owned()]);
        }
    }
}

rules!(fn sync_manager(SyncManager) {
    purpose: fact_as("purpose", Judgment::WIRE, |purpose: &SyncManagerPurpose| purpose.label().to_owned()),
    label: text("name of the purpose"),
    start_address: fact_as("start address", Judgment::WIRE, index),
    default_size: fact("length in bytes", Judgment::WIRE),
    size_range: fact("minimum and maximum length", Judgment::BEHAVIOR),
    control: fact_as("control register", Judgment::WIRE, |control| hex8(*control)),
    enable: fact("enabled", Judgment::WIRE),
    op_only: fact("in Op only", Judgment::BEHAVIOR),
    is_virtual: fact("exists in the description only", Judgment::WIRE),
}, KEY => [number], POSITION => [origin]);

/// Compares process images, which are paired by direction and name.
fn images() -> Elements<ProcessImage> {
    Elements { name: |image| format!("{:?} {}", image.direction, image.name), ..Elements::titled(image_title) }
}

fn image_title(image: &ProcessImage) -> String {
    let name = match (image.name.as_str(), image.direction) {
        ("", Direction::Receive) => "to the device",
        ("", Direction::Transmit) => "from the device",
        (name, _) => name,
    };
    format!("image {name}")
}

rules!(pub(super) fn image(ProcessImage) {
    name,
    direction: fact("direction", Judgment::API_AND_WIRE),
    length: fact("length", Judgment::API_AND_WIRE),
    overhead: fact("further bytes", Judgment::WIRE),
    big_endian: fact_as("byte order", Judgment::WIRE, |big_endian| {
        if *big_endian { "big-endian" } else { "little-endian" }.to_owned()
    }),
    fields: slice(entries), doubts,
});
