//! Compares items: their values, limits, access rights and behavior.

use super::bindings;
use super::change::{Effect, Judgment};
use super::comparison::{
    compare_fields, each, each_positioned, fact, fact_as, joined, judged, list, or_default, rules, slice, text,
    Comparison, Elements, POSITION,
};
use super::conditions::{conditions, restricted};
use super::show::Show;
use super::texts::{described, renamed};
use super::types;
use lexibus_codegen::facts;
use lexibus_codegen::facts::words::PLAIN;
use lexibus_codegen::ir::{
    Access, Behavior, CompactString, Configured, Conversion, Item, ItemVariant, Limits, MachineUnit, Mappable,
    Quantity, Rare, RelatedItems, Scale, Srdo, Storage, TypeDef, Value,
};
use lexibus_codegen::number::hex;

/// Compares all facts of an item.
pub(super) fn compare(old: &Item, new: &Item, comparison: &mut Comparison<'_>) {
    compare_named(old, new, judged("name", renamed), comparison);
}

/// Compares all facts of an item. `name` is the function that compares the names.
pub(super) fn compare_named(
    old: &Item,
    new: &Item,
    name: impl Fn(&CompactString, &CompactString, &mut Comparison<'_>),
    comparison: &mut Comparison<'_>,
) {
    let access = new.access;
    compare_fields!(Item, old, new, comparison, {
        name: name,
        names,
        ty: types::compare,
        bindings: slice(bindings::compare),
        access: judged("access", access_effects),
        mappable: mappable,
        default: |_: &_, _: &_, comparison: &mut Comparison<'_>| default(old, new, comparison),
        limits: |one: &Rare<Limits>, other: &Rare<Limits>, comparison: &mut Comparison<'_>| {
            range([old, new], [one, other], access, comparison);
        },
        variants: list(variants(), |one: &ItemVariant, other: &ItemVariant, comparison: &mut Comparison<'_>| {
            variant([old, new], one, other, comparison);
        }),
        configured: or_default(configured),
        quantity: or_default(quantity),
        behavior: or_default(behavior),
        availability,
        related: or_default(related),
        is_reserved: fact("reserved", Judgment::NONE),
        is_optional: fact("optional", Judgment::BEHAVIOR),
        shared_by_axes: fact("shared by all axes", Judgment::API),
        flags: fact_as("flags of the object", Judgment::BEHAVIOR, |flags| hex(*flags)),
        documentation, doubts, extensions, origins,
    }, POSITION => [origin, at]);
}

rules!(fn related(RelatedItems) {
    same_as: fact("same value as", Judgment::NONE),
    same_quantity: fact("same quantity as", Judgment::NONE),
    upper_half: fact("upper half", Judgment::BEHAVIOR),
    valid_count: fact("number of valid elements", Judgment::BEHAVIOR),
    id: text("identifier in the file"),
    unsuitable_values: text("unsuitable named values"),
});

/// Returns the effects of changed access rights.
fn access_effects(old: &Access, new: &Access) -> Judgment {
    let lost = old.readable() && !new.readable() || old.writable() && !new.writable();
    let gained = !old.readable() && new.readable() || !old.writable() && new.writable();
    let api = match (lost, gained) {
        (true, _) => Effect::Breaking,
        (false, true) => Effect::Compatible,
        (false, false) => Effect::Unaffected,
    };
    let behavior = match (old, new) {
        (Access::Constant, _) => Effect::Breaking,
        (_, Access::Constant) => Effect::Compatible,
        _ => Effect::Unaffected,
    };
    Judgment { api, behavior, ..Judgment::NONE }
}

fn mappable(old: &Mappable, new: &Mappable, comparison: &mut Comparison<'_>) {
    let lost = old.rpdo && !new.rpdo || old.tpdo && !new.tpdo;
    let judgment = if lost { Judgment::API } else { Judgment::API_COMPATIBLE };
    let text = |mappable: &Mappable| facts::item::mappable(*mappable).unwrap_or("none").to_owned();
    comparison.texts("mappable into", text(old), text(new), judgment);
}

fn default(old: &Item, new: &Item, comparison: &mut Comparison<'_>) {
    if old.default != new.default {
        let (old_types, new_types) = comparison.types;
        let texts = [facts::item::default(old, old_types), facts::item::default(new, new_types)];
        comparison.values("default", [&old.default, &new.default], texts, stated_effects(&old.default, &new.default));
    }
}

/// Returns the effects of a changed fact on the behavior. Adding a fact that the old description lacks breaks nothing.
fn stated_effects<T>(old: &Option<T>, _: &Option<T>) -> Judgment {
    match old {
        None => Judgment::BEHAVIOR_COMPATIBLE,
        Some(_) => Judgment::BEHAVIOR,
    }
}

/// Compares the limits of an item or of one of its variants.
fn range(items: [&Item; 2], limits: [&Limits; 2], access: Access, comparison: &mut Comparison<'_>) {
    if limits[0] != limits[1] {
        let (old_types, new_types) = comparison.types;
        let text = |side: usize, types: &[TypeDef]| match limits[side].text.is_empty() {
            true => facts::item::range(items[side], limits[side], types, usize::MAX),
            false => limits[side].text.to_string(),
        };
        let texts = [text(0, old_types), text(1, new_types)];
        comparison.values("range", limits, texts, range_effects(limits[0], limits[1], access));
    }
}

/// Returns the effects of changed limits. For a writable item, the change is breaking if a value that could be written
/// becomes invalid. For any other item, the change is breaking if a value can be outside of the old limits.
fn range_effects(old: &Limits, new: &Limits, access: Access) -> Judgment {
    let is_broken = if access.writable() { is_narrower(old, new) } else { is_narrower(new, old) };
    // Allowed values that are not numbers are not compared one by one.
    if is_broken || old.text != new.text {
        Judgment::BEHAVIOR
    } else {
        Judgment::BEHAVIOR_COMPATIBLE
    }
}

/// Returns whether the old limits allow a value that the new limits do not allow.
fn is_narrower(old: &Limits, new: &Limits) -> bool {
    let real = |value: &Option<Value>| value.as_ref().and_then(Value::as_real);
    let is_beyond = |old: Option<f64>, new: Option<f64>, beyond: fn(f64, f64) -> bool| match (old, new) {
        (None, Some(_)) => true,
        (Some(old), Some(new)) => beyond(new, old),
        _ => false,
    };
    let below = is_beyond(real(&old.low), real(&new.low), |new, old| new > old);
    let above = is_beyond(real(&old.high), real(&new.high), |new, old| new < old);
    let is_allowed = |value: f64| {
        new.allowed.iter().any(|(first, last)| {
            first.as_real().is_some_and(|first| first <= value) && last.as_real().is_some_and(|last| value <= last)
        })
    };
    let mut ends = old.allowed.iter().flat_map(|(first, last)| [first.as_real(), last.as_real()]).flatten();
    let is_unlisted = !new.allowed.is_empty() && (old.allowed.is_empty() || !ends.all(is_allowed));
    below || above || is_unlisted
}

/// Compares the variants of an item, which are paired by their models and buses.
fn variants() -> Elements<ItemVariant> {
    Elements::titled(|variant: &ItemVariant| {
        let models = variant.models.iter().map(CompactString::as_str);
        let all: Vec<&str> = models.chain(variant.buses.iter().map(|bus| bus.name())).collect();
        format!("on {}", all.join(", "))
    })
    .judged(Judgment::BEHAVIOR, Judgment::BEHAVIOR)
}

/// Compares the old and the new version of a variant. A variant applies only to some models or buses.
fn variant(items: [&Item; 2], old: &ItemVariant, new: &ItemVariant, comparison: &mut Comparison<'_>) {
    let access = new.access.unwrap_or(items[1].access);
    compare_fields!(ItemVariant, old, new, comparison, {
        models: fact("models", Judgment::BEHAVIOR),
        buses: fact("buses", Judgment::BEHAVIOR),
        ty: types::compare_optional("type", Judgment::API_AND_WIRE),
        access: judged("access", |old: &Option<Access>, new: &Option<Access>| {
            access_effects(&old.unwrap_or(items[0].access), &new.unwrap_or(items[1].access))
        }),
        default: |old: &Option<Value>, new: &Option<Value>, comparison: &mut Comparison<'_>| {
            if old != new {
                let (old_types, new_types) = comparison.types;
                let texts = [value(items[0], old, old_types), value(items[1], new, new_types)];
                comparison.values("default", [old, new], texts, stated_effects(old, new));
            }
        },
        limits: |old: &Limits, new: &Limits, comparison: &mut Comparison<'_>| {
            range(items, [old, new], access, comparison);
        },
        step: judged("step", stated_effects),
        scale: fact_as("scale", Judgment::API_AND_BEHAVIOR, |scale: &Option<Scale>| {
            scale.as_ref().map(|scale| PLAIN.scale(scale, "")).unwrap_or_default()
        }),
        documentation,
    }, POSITION => [at]);
}

/// Returns the text of an optional value for reports. The text is empty if there is no value.
fn value(item: &Item, value: &Option<Value>, types: &[TypeDef]) -> String {
    value.as_ref().map(|value| facts::item::value(item, value, types)).unwrap_or_default()
}

rules!(fn configured(Configured) {
    value: judged("configured value", stated_effects),
    denotation: text("denotation"),
    upload_file: text("upload file"),
    download_file: fact("download file", Judgment::BEHAVIOR),
});

fn quantity(old: &Quantity, new: &Quantity, comparison: &mut Comparison<'_>) {
    compare_fields!(Quantity, old, new, comparison, {
        // A unit that the old description lacks breaks nothing.
        unit: judged("unit", |old: &CompactString, _: &CompactString| match old.is_empty() {
            true => Judgment::API_COMPATIBLE,
            false => Judgment::API_AND_BEHAVIOR,
        }),
        units: text("unit in other languages"),
        scale: |_: &_, _: &_, comparison: &mut Comparison<'_>| scale(old, new, comparison),
        sentinels: slice(sentinels),
        step: judged("step", stated_effects),
        machine: or_default(machine_unit),
        conversions: each_positioned("examples of conversions", conversion),
    });
}

/// Compares scales. The scale determines the Rust type.
fn scale(old: &Quantity, new: &Quantity, comparison: &mut Comparison<'_>) {
    if old.scale != new.scale {
        let shown =
            |quantity: &Quantity| Some(PLAIN.scale(quantity.scale.as_ref()?, facts::physical::shown_unit(quantity)));
        let text = |quantity| shown(quantity).unwrap_or_default();
        comparison.values("scale", [&old.scale, &new.scale], [text(old), text(new)], Judgment::API_AND_BEHAVIOR);
    }
}

/// Compares sentinels: raw values that do not represent a number. They are generic arguments of the Rust type.
fn sentinels(old: &[(Value, CompactString)], new: &[(Value, CompactString)], comparison: &mut Comparison<'_>) {
    let numbers = |list: &[(Value, CompactString)]| list.iter().map(|(raw, _)| raw.clone()).collect::<Vec<_>>();
    fact("special value", Judgment::API_AND_BEHAVIOR)(&numbers(old), &numbers(new), comparison);
    let meanings = |list: &[(Value, CompactString)]| joined(list, |(_, name)| name.show());
    comparison.texts("meaning of special values", meanings(old), meanings(new), Judgment::NONE);
}

rules!(fn machine_unit(MachineUnit) {
    unit: fact("machine unit", Judgment::API),
    times: fact("multiplied by", Judgment::API),
    over: fact("divided by", Judgment::API),
});

/// Formats a conversion without its source position, such as `250 = 25 °C`.
fn conversion(conversion: &Conversion) -> String {
    let Conversion { raw, value, unit, given, model, by, documentation, at: _ } = conversion;
    let given: Vec<String> = given.iter().map(|(name, number)| format!(", {name} {number}")).collect();
    let text = described(documentation.as_deref());
    let (unit, model, by) = (unit.show(), model.show(), by.show());
    format!("{} = {} {unit}{} {model} {by} {text}", raw.show(), value.show(), given.concat())
}

rules!(fn behavior(Behavior) {
    storage: storage,
    effective: judged("takes effect", stated_effects),
    write_when: conditions("writable while"),
    writable_values: restricted("writable values"),
    side_effects: each("side effects", Judgment::BEHAVIOR, CompactString::to_string),
    self_clearing: fact("cleared by the device", Judgment::BEHAVIOR),
    write_once: fact("writable only once", Judgment::BEHAVIOR),
    backup: fact("part of a backup", Judgment::BEHAVIOR),
    setting: fact("setting of the application", Judgment::NONE),
    safety: fact("role in functional safety", Judgment::BEHAVIOR),
    srdo: fact_as("mapping into SRDOs", Judgment::BEHAVIOR, |srdo: &Option<Srdo>| {
        PLAIN.behavior(&Behavior { srdo: *srdo, ..Behavior::default() }).concat()
    }),
    hidden: fact("hidden by tools", Judgment::NONE),
    pdi_access: fact("access of the device's processor", Judgment::BEHAVIOR),
    read_states: restricted("readable in states"),
    write_states: restricted("writable in states"),
});

fn storage(old: &Storage, new: &Storage, comparison: &mut Comparison<'_>) {
    let judgment = if *old == Storage::Unknown { Judgment::BEHAVIOR_COMPATIBLE } else { Judgment::BEHAVIOR };
    let text = |storage: &Storage| PLAIN.storage(storage).unwrap_or_default();
    comparison.texts("storage", text(old), text(new), judgment);
}
