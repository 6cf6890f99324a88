//! Models of a device: their constants, and items with a different range or initial value.

use super::code::{call, list, seq, Declaration, Stop};
use super::constructor::Arguments;
use super::context::Context;
use super::docs;
use super::given::{in_unit, name_request};
use super::item_type::ItemType;
use super::literal;
use super::objects::ObjectModel;
use super::variant;
use crate::ir::{Device, Value, Variant};
use crate::names::{self, Case};

/// A model of the device that has constants or different items, ready to be printed.
pub(super) struct DeviceModel {
    pub name: String,
    pub docs: Vec<String>,
    pub constants: Vec<Declaration>,
    pub items: Vec<ModelItem>,
}

impl DeviceModel {
    /// Returns whether the handles refer to types of the device.
    pub(super) fn names_types(&self) -> bool {
        self.items.iter().any(|item| item.is_named)
    }
}

/// A handle for one model of the device, ready to be printed.
pub(super) struct ModelItem {
    pub constant: Declaration,
    /// True if the value has the type of an enumeration or bit field of the device.
    is_named: bool,
}

/// Returns the models that have constants, or items that differ from those of other models. Items of objects with
/// several values are not considered. `objects` contains the handles for all models.
pub(super) fn models(context: &Context<'_>, device: &Device, objects: &[ObjectModel]) -> Vec<DeviceModel> {
    let all = device.variants.iter().map(|variant| {
        let single_values = objects.iter().filter(|object| !object.has_entries());
        let items: Vec<ModelItem> =
            single_values.filter_map(|object| model_item(context, object, &variant.name)).collect();
        (variant, constants(device, &variant.name, &variant.constants), items)
    });
    let different: Vec<_> = all.filter(|(_, constants, items)| !constants.is_empty() || !items.is_empty()).collect();
    let name_requests = different.iter().map(|(variant, ..)| name_request(&variant.name));
    let names = names::unique(name_requests, &["self", "super", "crate"], Case::Snake);
    let model = |((variant, constants, items), name): ((&Variant, _, _), String)| {
        let name = names::escaped(&name);
        DeviceModel { name, docs: documentation(context, variant), constants, items }
    };
    different.into_iter().zip(names).map(model).collect()
}

fn documentation(context: &Context<'_>, variant: &Variant) -> Vec<String> {
    let title = docs::sentence(&docs::escape(&variant.name));
    let described = docs::described(variant.documentation.as_deref(), &context.manual);
    docs::paragraphs([title].into_iter().chain(described))
}

fn model_item(context: &Context<'_>, object: &ObjectModel, model: &str) -> Option<ModelItem> {
    let handle = object.items.first()?;
    let item = context.item(handle.id)?;
    let on_model = variant::on_model(item, model)?;
    let ty = ItemType::of(context, item);
    let arguments = Arguments::of(&on_model, "", &ty, "");
    let [range, initial] = arguments.of_model();
    let mut facts = Vec::new();
    facts.extend(docs::limits(&on_model));
    let shown = |value: &Value| docs::WORDS.of_item(&on_model, value, &docs::value);
    facts.extend(on_model.default.as_ref().map(|value| format!("default {}", shown(value))));
    let (name, title) = (&handle.constant, docs::escape(&item.name));
    let docs = format!("{title}: {}. The handle for all models is [`objects::{name}`].", facts.join(", "));
    let path = list(&format!("objects::{}<", handle.access), &handle.arguments_at_top, ">");
    let value = call!("rt::Item::of_model", seq!["objects::", name], range, initial);
    let constant = Declaration::new([docs], seq!["const ", name, ": ", path], seq![Stop, value]);
    Some(ModelItem { constant, is_named: ty.named.is_some() })
}

fn constants(device: &Device, model: &str, stated: &[(crate::ir::CompactString, Value)]) -> Vec<Declaration> {
    let given =
        device.given.iter().flat_map(|number| number.models.iter().map(move |(name, value)| (number, name, value)));
    let given = given.filter(|(_, name, _)| *name == model);
    let given = given.map(|(number, _, value)| (&number.name, value, in_unit(&number.unit)));
    let all: Vec<_> = stated.iter().map(|(name, value)| (name, value, String::new())).chain(given).collect();
    let name_requests = all.iter().map(|(name, ..)| name_request(name));
    let names = names::unique(name_requests, &[], Case::Snake);
    let constant = |((name, value, unit), constant): ((&crate::ir::CompactString, &Value, String), String)| {
        let real = literal::real(value.as_real()?, 64)?;
        let docs = docs::sentence(&(docs::escape(name) + &unit));
        Some(Declaration::new([docs], seq!["const ", constant.to_ascii_uppercase(), ": f64"], real))
    };
    all.into_iter().zip(names).filter_map(constant).collect()
}
