//! Reads the differences of an item between models or between buses.

use thin_vec::ThinVec;

use super::at::At;
use super::format::{Row, VariantTable};
use super::rows::Rows;
use super::tree::Reader;
use super::words::ACCESSES;
use super::{buses, scale, types, value};
use crate::diagnostics::codes;
use crate::ir::{Binding, Bus, Item, ItemVariant, Limits, RegisterSpace, Type, Value};

impl Rows {
    /// Adds the variants of a row to its item.
    pub(super) fn variants(&mut self, reader: &mut Reader<'_, '_>, item: &mut Item, row: &Row) {
        let Some(list) = &row.variants else { return };
        let base = self.definitions.underlying(item.ty);
        item.variants = list.iter().map(|given| self.variant(reader, given, base)).collect();
        // On Modbus, a type of another length occupies a different number of registers, so this number is calculated
        // again.
        let Some(bits) = item.type_on(Bus::Modbus).bits().filter(|_| item.type_on(Bus::Modbus) != item.ty) else {
            return;
        };
        for binding in &mut item.bindings {
            if let Binding::Register(register) = binding {
                let is_word = matches!(register.space, RegisterSpace::Holding | RegisterSpace::Input);
                register.count = u16::try_from(bits.div_ceil(if is_word { 16 } else { 1 })).unwrap_or(register.count);
            }
        }
    }

    fn variant(&mut self, reader: &mut Reader<'_, '_>, given: &At<VariantTable>, base: Type) -> ItemVariant {
        let table = &given.value;
        let models = table.models.iter().flatten();
        reader.mention(models.clone(), "model");
        let buses = table.buses.as_ref().map(|list| buses::read(reader, list));
        let ty = table.ty.as_ref().and_then(|given| self.other_type(reader, given, base));
        let allowed = table.allowed.as_ref();
        let allowed = allowed.map(|list| value::ranges(reader, &list.value, (list.start, list.end), base));
        let on_models = table.models.is_some() && (table.ty.is_some() || table.access.is_some());
        if on_models || (table.buses.is_none() && (table.ty.is_some() || table.access.is_some())) {
            let message = "`type` and `access` of a variant need `buses`";
            reader.report_with_help(&codes::TABLE_VALUE, reader.span(given), message, "write separate rows for models");
        }
        let mut value = |literal: &Option<At<_>>| literal.as_ref().map(|table| value::value(reader, table, base));
        let (default, low, high, step) =
            (value(&table.default), value(&table.min), value(&table.max), value(&table.step));
        let found = ItemVariant {
            models: models.map(|model| model.value.as_str().into()).collect(),
            buses: buses.unwrap_or_default(),
            ty,
            access: table.access.as_ref().and_then(|access| reader.word(access, "access right", &ACCESSES)),
            default,
            limits: limits(low, high, allowed.unwrap_or_default()),
            step,
            scale: scale::of_variant(reader, table.scale.as_ref()),
            documentation: reader.documentation_of(table),
            at: reader.span(given),
        };
        let differs = table.ty.is_some()
            || table.access.is_some()
            || table.allowed.is_some()
            || table.default.is_some()
            || table.min.is_some()
            || table.max.is_some()
            || table.step.is_some();
        let message = match () {
            () if found.models.is_empty() && table.buses.as_ref().is_none_or(Vec::is_empty) => "the variant has neither `models` nor `buses`",
            () if !differs && table.scale.is_none() && found.documentation.is_none() => {
                "the variant changes nothing: write `type`, `access`, `allowed`, `default`, `min`, `max`, `step` or `scale`"
            }
            () => return found,
        };
        reader.diagnostics.push(codes::TABLE_VALUE.at(found.at, message));
        found
    }

    /// Returns the type of a variant. Reports the type unless the item and the variant both have an integer type or
    /// `bool`.
    fn other_type(&self, reader: &mut Reader<'_, '_>, given: &At<String>, base: Type) -> Option<Type> {
        let is_integer = |ty: &Type| matches!(ty, Type::Integer(1..=64) | Type::Unsigned(1..=64) | Type::Boolean);
        let found = types::single(&given.value).filter(|ty| is_integer(ty) && is_integer(&base));
        if found.is_none() {
            let message = "`type` of a variant can only change the length of an integer";
            let help = "write an integer type such as `i8` or `u16`, or a separate row";
            reader.report_with_help(&codes::TABLE_VALUE, reader.span(given), message, help);
        }
        found
    }
}

/// Returns the limits of a variant. A missing minimum or maximum follows from the allowed values.
fn limits(low: Option<Value>, high: Option<Value>, allowed: ThinVec<(Value, Value)>) -> Limits {
    let compare = |one: &&Value, other: &&Value| match (one.as_int(), other.as_int()) {
        (Some(one), Some(other)) => one.cmp(&other),
        _ => one.as_real().unwrap_or(f64::NAN).total_cmp(&other.as_real().unwrap_or(f64::NAN)),
    };
    let minimum = allowed.iter().map(|(first, _)| first).min_by(compare).cloned();
    let maximum = allowed.iter().map(|(_, last)| last).max_by(compare).cloned();
    Limits { low: low.or(minimum), high: high.or(maximum), allowed, ..Limits::default() }
}
