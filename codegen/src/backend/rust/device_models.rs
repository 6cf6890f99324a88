//! The models of a device: their constants, and the items in whose values they differ, each with those of its model.

use super::code::{list, Doc};
use super::constructor::Arguments;
use super::context::Context;
use super::docs;
use super::given::{in_unit, wish};
use super::item_type::ItemType;
use super::literal;
use super::objects::ObjectModel;
use super::variant;
use crate::ir::{Device, Value, Variant};
use crate::names::{self, Case, Wish};

/// A model of the device that has something of its own.
pub(super) struct DeviceModel {
    pub name: String,
    pub docs: Vec<String>,
    /// Names, documentation, values.
    pub constants: Vec<(String, String, String)>,
    pub items: Vec<OwnItem>,
}

impl DeviceModel {
    /// Whether its handles name types of the device.
    pub(super) fn names_types(&self) -> bool {
        self.items.iter().any(|own| own.is_named)
    }
}

/// A handle, ready to be written.
pub(super) struct OwnItem {
    pub name: String,
    pub docs: String,
    /// Its type, as the device's place names it.
    pub ty: Doc,
    /// Whether its value is an enumeration or a bit field of the device.
    pub is_named: bool,
    pub range: Doc,
    pub initial: Doc,
}

/// The models that have constants or items of their own. `objects` are the handles of all models.
pub(super) fn models(context: &Context<'_>, device: &Device, objects: &[ObjectModel]) -> Vec<DeviceModel> {
    let all = device.variants.iter().map(|own| {
        let with = objects.iter().filter(|object| !object.is_module);
        let items: Vec<OwnItem> = with.filter_map(|object| self::own(context, object, &own.name)).collect();
        (own, constants(device, &own.name, &own.constants), items)
    });
    let with: Vec<_> = all.filter(|(_, constants, items)| !constants.is_empty() || !items.is_empty()).collect();
    let wishes: Vec<Wish<'_>> = with.iter().map(|(own, ..)| wish(&own.name)).collect();
    let names = names::unique(&wishes, &["self", "super", "crate"], Case::Snake);
    let model = |((own, constants, items), name): ((&Variant, _, _), String)| {
        let name = names::escaped(&name);
        DeviceModel { name, docs: documentation(context, own), constants, items }
    };
    with.into_iter().zip(names).map(model).collect()
}

fn documentation(context: &Context<'_>, own: &Variant) -> Vec<String> {
    let mut lines = vec![docs::sentence(&docs::escape(&own.name))];
    docs::described(own.documentation.as_deref(), &context.manual, &mut lines);
    lines
}

fn own(context: &Context<'_>, object: &ObjectModel, model: &str) -> Option<OwnItem> {
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
    Some(OwnItem {
        name: handle.constant.clone(),
        docs: format!(
            "{}: {}. Handle for all models: [`objects::{}`].",
            docs::escape(&item.name),
            facts.join(", "),
            handle.constant
        ),
        ty: list(&format!("objects::{}<", handle.access), &handle.arguments_at_top, ">"),
        is_named: ty.named.is_some(),
        range: range.clone(),
        initial: initial.clone(),
    })
}

fn constants(device: &Device, model: &str, own: &[(crate::ir::CompactString, Value)]) -> Vec<(String, String, String)> {
    let given = device.given.iter().flat_map(|own| own.models.iter().map(move |(name, value)| (own, name, value)));
    let given = given.filter(|(_, name, _)| *name == model);
    let given = given.map(|(own, _, value)| (&own.name, value, in_unit(&own.unit)));
    let all: Vec<_> = own.iter().map(|(name, value)| (name, value, String::new())).chain(given).collect();
    let wishes: Vec<Wish<'_>> = all.iter().map(|(name, ..)| wish(name)).collect();
    let names = names::unique(&wishes, &[], Case::Snake);
    let constant = |((name, value, unit), constant): ((&crate::ir::CompactString, &Value, String), String)| {
        let real = literal::real(value.as_real()?, 64)?;
        Some((constant.to_ascii_uppercase(), docs::sentence(&(docs::escape(name) + &unit)), real))
    };
    all.into_iter().zip(names).filter_map(constant).collect()
}
