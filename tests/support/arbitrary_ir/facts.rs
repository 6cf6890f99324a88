//! Random facts of items, bits and messages except their type: quantities, conditions, availability, behavior,
//! variants.

use lexibus_codegen::ir::{
    Access, Availability, Behavior, Condition, Conversion, ItemVariant, MachineUnit, Quantity, Srdo, Storage, Type,
    Value,
};
use lexibus_codegen::source::Span;

use super::bytes::Bytes;
use super::names;
use super::types;
use super::values;

/// Returns arbitrary access rights.
pub fn access(b: &mut Bytes<'_>) -> Access {
    b.pick(&[
        Access::ReadWrite,
        Access::ReadOnly,
        Access::WriteOnly,
        Access::ReadWriteInput,
        Access::ReadWriteOutput,
        Access::Constant,
    ])
}

pub fn condition(b: &mut Bytes<'_>) -> Condition {
    Condition {
        item: names::name(b).into(),
        values: b.list(2, |b| Value::Int(values::number(b))),
        names: b.few(4, 2, names::name),
        mask: b.maybe(4, |b| b.pick(&[1, 0x0F, 0x8000, u64::MAX])),
    }
}

pub fn availability(b: &mut Bytes<'_>) -> Availability {
    Availability {
        models: b.list(2, names::model),
        since: b.maybe(3, names::version),
        until: b.maybe(3, names::version),
        replaced_by: b.maybe(4, names::name).map(Into::into),
        options: b.few(4, 2, names::name),
        buses: b.maybe(4, names::buses).unwrap_or_default(),
    }
}

/// Returns a unit and a scale. The scale may depend on one of the machine constants in `given`.
pub fn quantity(b: &mut Bytes<'_>, given: &[lexibus_codegen::ir::CompactString]) -> Quantity {
    Quantity {
        unit: names::unit(b),
        units: names::texts(b),
        scale: b.maybe(2, types::scale),
        sentinels: b.few(3, 3, |b| (Value::Int(values::number(b)), names::name(b))),
        step: b.maybe(6, values::any),
        machine: b.maybe(3, |b| {
            let [times, over] = [0; 2].map(|_| b.list(2, |b| names::of(b, given).into()));
            Box::new(MachineUnit { unit: names::unit(b), times, over })
        }),
        conversions: b.few(8, 2, |b| conversion(b, given)),
    }
}

fn conversion(b: &mut Bytes<'_>, given: &[lexibus_codegen::ir::CompactString]) -> Conversion {
    Conversion {
        raw: b.maybe(2, values::number),
        value: b.maybe(2, values::real),
        unit: b.maybe(4, names::unit),
        given: b.few(3, 2, |b| (names::of(b, given).into(), values::real(b))),
        model: b.maybe(4, |b| names::model(b).into()),
        by: b.maybe(4, values::real),
        documentation: names::documentation(b),
        at: Span::default(),
    }
}

pub fn behavior(b: &mut Bytes<'_>) -> Behavior {
    Behavior {
        storage: match b.within(0..=3) {
            0 => Storage::Unknown,
            1 => Storage::Volatile,
            2 => Storage::Immediate,
            _ => Storage::OnCommand(names::name(b).into()),
        },
        effective: b.maybe(4, names::text),
        write_when: b.few(3, 2, condition),
        writable_values: b.few(3, 3, |b| Value::Int(values::number(b))),
        side_effects: b.few(4, 2, names::text),
        self_clearing: b.any(),
        write_once: b.one_in(6),
        backup: b.any(),
        setting: b.any(),
        safety: b.maybe(6, |b| b.pick(&["si", "so", "sio", "sp"]).into()),
        srdo: b.maybe(6, |b| Srdo { inverted: b.maybe(2, |b| (b.within(0x2000..=0x9FFF), b.within(0..=0xFE))) }),
        hidden: b.one_in(4),
        pdi_access: b.maybe(6, access),
        read_states: b.few(6, 2, names::name),
        write_states: b.few(6, 2, names::name),
    }
}

/// Returns the facts of an item that differ on some models or buses. `ty` is the type of the item.
pub fn variant(b: &mut Bytes<'_>, ty: Type) -> ItemVariant {
    ItemVariant {
        models: b.list(1, names::model),
        buses: names::buses(b),
        ty: b.maybe(4, types::integer),
        access: b.maybe(4, access),
        default: b.maybe(3, |b| values::of(b, ty)),
        limits: values::limits(b, ty),
        step: b.maybe(6, values::any),
        scale: b.maybe(6, types::scale),
        documentation: names::documentation(b),
        at: Default::default(),
    }
}
