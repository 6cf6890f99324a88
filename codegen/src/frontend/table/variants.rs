//! What differs of an item between models, or between buses.

use super::at::At;
use super::format::{Row, VariantTable};
use super::rows::Rows;
use super::tree::{cited, Reader};
use super::{device, scale, value};
use crate::diagnostics::{codes, Diagnostic};
use crate::ir::{Item, ItemVariant, Limits, Type};

impl Rows {
    /// Puts the variants of a row into its item.
    pub(super) fn variants(&mut self, reader: &mut Reader<'_, '_>, item: &mut Item, row: &Row) {
        let Some(list) = &row.variants else { return };
        let base = self.underlying(item.ty);
        item.variants = list.iter().map(|given| self.variant(reader, given, base)).collect();
    }

    fn variant(&mut self, reader: &mut Reader<'_, '_>, given: &At<VariantTable>, base: Type) -> ItemVariant {
        let own = &given.value;
        let names = |list: &Option<Vec<At<String>>>| {
            list.iter().flatten().map(|name| name.value.as_str().into()).collect::<Vec<_>>()
        };
        self.references.extend(own.models.iter().flatten().map(|model| (model.clone(), "model")));
        if let Some(buses) = &own.buses {
            device::buses(reader, buses);
        }
        let mut value = |literal: &Option<At<_>>| literal.as_ref().map(|own| value::value(reader, own, base));
        let (default, low, high, step) = (value(&own.default), value(&own.min), value(&own.max), value(&own.step));
        let found = ItemVariant {
            models: names(&own.models),
            buses: names(&own.buses),
            default,
            limits: Limits { low, high, ..Limits::default() },
            step,
            scale: scale::read(reader, own.scale.as_ref(), None, &mut self.references),
            documentation: reader.documentation(own.doc.as_deref(), own.cite.as_ref().map(cited)),
            at: reader.span(given),
        };
        let differs = own.default.is_some() || own.min.is_some() || own.max.is_some() || own.step.is_some();
        let message = match () {
            () if found.models.is_empty() && found.buses.is_empty() => "the variant says neither `models` nor `buses`",
            () if !differs && own.scale.is_none() && found.documentation.is_none() => {
                "the variant says nothing that differs: `default`, `min`, `max`, `step` or `scale`"
            }
            () => return found,
        };
        reader.diagnostics.push(Diagnostic::new(&codes::TABLE_VALUE, found.at, message));
        found
    }
}
