//! What differs of an item between models, or between buses.

use thin_vec::ThinVec;

use super::at::At;
use super::format::{Row, VariantTable};
use super::rows::Rows;
use super::tree::Reader;
use super::words::ACCESSES;
use super::{buses, scale, types, value};
use crate::diagnostics::{codes, Diagnostic};
use crate::ir::{Binding, Bus, Item, ItemVariant, Limits, RegisterSpace, Type, Value};

impl Rows {
    /// Puts the variants of a row into its item.
    pub(super) fn variants(&mut self, reader: &mut Reader<'_, '_>, item: &mut Item, row: &Row) {
        let Some(list) = &row.variants else { return };
        let base = self.definitions.underlying(item.ty);
        item.variants = list.iter().map(|given| self.variant(reader, given, base)).collect();
        // Another width takes another number of registers.
        let Some(bits) = item.type_on(Bus::Modbus).bits().filter(|_| item.type_on(Bus::Modbus) != item.ty) else {
            return;
        };
        for binding in &mut item.bindings {
            if let Binding::Register(own) = binding {
                let is_word = matches!(own.space, RegisterSpace::Holding | RegisterSpace::Input);
                own.count = u16::try_from(bits.div_ceil(if is_word { 16 } else { 1 })).unwrap_or(own.count);
            }
        }
    }

    fn variant(&mut self, reader: &mut Reader<'_, '_>, given: &At<VariantTable>, base: Type) -> ItemVariant {
        let own = &given.value;
        let models = own.models.iter().flatten();
        self.references.extend(models.clone().map(|model| (model.clone(), "model")));
        let buses = own.buses.as_ref().map(|list| buses::read(reader, list));
        let ty = own.ty.as_ref().and_then(|given| self.other_type(reader, given, base));
        let allowed = own.allowed.as_ref();
        let allowed = allowed.map(|list| value::ranges(reader, (&list.value, (list.start, list.end)), base));
        let on_models = own.models.is_some() && (own.ty.is_some() || own.access.is_some());
        if on_models || (own.buses.is_none() && (own.ty.is_some() || own.access.is_some())) {
            let message =
                "another `type` or `access` is one on some `buses`: models that differ so have rows of their own";
            reader.report(&codes::TABLE_VALUE, reader.span(given), message);
        }
        let mut value = |literal: &Option<At<_>>| literal.as_ref().map(|own| value::value(reader, own, base));
        let (default, low, high, step) = (value(&own.default), value(&own.min), value(&own.max), value(&own.step));
        let found = ItemVariant {
            models: models.map(|model| model.value.as_str().into()).collect(),
            buses: buses.unwrap_or_default(),
            ty,
            access: own.access.as_ref().and_then(|access| reader.word(access, "access", &ACCESSES)),
            default,
            limits: limits(low, high, allowed.unwrap_or_default()),
            step,
            scale: scale::of_variant(reader, own.scale.as_ref(), &mut self.references),
            documentation: reader.documentation_of(own),
            at: reader.span(given),
        };
        let differs = own.ty.is_some()
            || own.access.is_some()
            || own.allowed.is_some()
            || own.default.is_some()
            || own.min.is_some()
            || own.max.is_some()
            || own.step.is_some();
        let message = match () {
            () if found.models.is_empty() && own.buses.as_ref().is_none_or(Vec::is_empty) => "the variant says neither `models` nor `buses`",
            () if !differs && own.scale.is_none() && found.documentation.is_none() => {
                "the variant says nothing that differs: `type`, `access`, `allowed`, `default`, `min`, `max`, `step` or `scale`"
            }
            () => return found,
        };
        reader.diagnostics.push(Diagnostic::new(&codes::TABLE_VALUE, found.at, message));
        found
    }

    /// The type of an integer that has another width.
    fn other_type(&self, reader: &mut Reader<'_, '_>, given: &At<String>, base: Type) -> Option<Type> {
        let is_integer = |ty: &Type| matches!(ty, Type::Integer(1..=64) | Type::Unsigned(1..=64) | Type::Boolean);
        let found = types::named(&given.value).filter(|named| named.elements.is_none()).map(|named| named.ty);
        let found = found.filter(|ty| is_integer(ty) && is_integer(&base));
        if found.is_none() {
            let message =
                "on another bus, an integer may have another width: `i8`, `u16`; anything else has its own row";
            reader.report(&codes::TABLE_VALUE, reader.span(given), message);
        }
        found
    }
}

/// Of a list, the least and the greatest are limits, too.
fn limits(low: Option<Value>, high: Option<Value>, allowed: ThinVec<(Value, Value)>) -> Limits {
    let compare = |one: &&Value, other: &&Value| match (one.as_int(), other.as_int()) {
        (Some(one), Some(other)) => one.cmp(&other),
        _ => one.as_real().unwrap_or(f64::NAN).total_cmp(&other.as_real().unwrap_or(f64::NAN)),
    };
    let least = allowed.iter().map(|(first, _)| first).min_by(compare).cloned();
    let greatest = allowed.iter().map(|(_, last)| last).max_by(compare).cloned();
    Limits { low: low.or(least), high: high.or(greatest), allowed }
}
