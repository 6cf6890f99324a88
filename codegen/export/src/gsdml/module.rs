//! Writes modules, and the parts that modules, submodules and device access points have in common.

use super::elements::{self, Attributes};
use super::values::ranges;
use super::{submodule, Context};
use crate::note::{NoteKind, Subject};
use crate::xml::Xml;
use lexibus_codegen::ir::{CompactString, Documentation, Module, SlotNumbers, SubslotName, Texts};

/// Returns the value of an attribute that the IR stores unchanged. Returns an empty text if the attribute is missing.
pub(super) fn find<'a>(attributes: &'a Attributes, key: &str) -> &'a str {
    attributes.iter().find(|(name, _)| name == key).map_or("", |(_, value)| value)
}

/// Writes the ModuleInfo element. `values` are the vendor name, order number, hardware release and software release. `attributes`
/// are those that the IR stores unchanged, including the category and the family.
pub(super) fn info(
    xml: &mut Xml,
    context: &mut Context<'_>,
    name: &str,
    names: &Texts,
    documentation: Option<&Documentation>,
    attributes: &Attributes,
    values: [&str; 4],
) {
    xml.open("ModuleInfo");
    for key in elements::OF_INFO {
        xml.text_attribute(key, find(attributes, key));
    }
    context.texts.text(xml, "Name", name, names);
    context.texts.documentation(xml, "InfoText", documentation);
    // The schema requires the element InfoText, so the name replaces a missing text.
    if documentation.is_none() && !context.is_gsdml {
        context.texts.text(xml, "InfoText", name, names);
        xml.notes.add(NoteKind::MissingText, Subject::Named(name));
    }
    elements::FAMILY.write(xml, attributes);
    let elements = ["VendorName", "OrderNumber", "HardwareRelease", "SoftwareRelease"];
    for (element, value) in elements.into_iter().zip(values).filter(|(_, value)| !value.is_empty()) {
        xml.empty(element, &[("Value", &value)]);
    }
    xml.close();
}

/// Writes the attributes that list slots or subslots; `what` is `Slots` or `Subslots`.
pub(super) fn slot_lists(xml: &mut Xml, slots: &SlotNumbers, what: &str) {
    let lists = [("AllowedIn", &slots.allowed), ("UsedIn", &slots.used), ("FixedIn", &slots.fixed)];
    for (name, numbers) in lists.into_iter().filter(|(_, numbers)| !numbers.is_empty()) {
        xml.attribute(&format!("{name}{what}"), ranges(numbers));
    }
}

/// Writes the SubslotList element.
pub(super) fn subslots(xml: &mut Xml, context: &mut Context<'_>, names: &[SubslotName]) {
    xml.list("SubslotList", names, |xml, subslot| {
        let text = context.texts.id(&subslot.name, &subslot.names);
        xml.empty("SubslotItem", &[("SubslotNumber", &subslot.number), ("TextId", &text)]);
    });
}

/// Writes a Graphics element. The IR stores its references as `GraphicItemRef@Type`.
pub(super) fn graphics(xml: &mut Xml, attributes: &Attributes) {
    let references = attributes.iter().filter_map(|(key, target)| Some((key.strip_prefix("GraphicItemRef@")?, target)));
    graphics_of(xml, references);
}

/// Writes a Graphics element with the given references.
pub(super) fn graphics_of<'g>(xml: &mut Xml, list: impl Iterator<Item = (&'g str, &'g CompactString)>) {
    xml.list("Graphics", list, |xml, (kind, target)| {
        xml.empty("GraphicItemRef", &[("Type", &kind), ("GraphicItemTarget", &target)]);
    });
}

/// Writes the ModuleItem element of a module.
pub(super) fn write(xml: &mut Xml, context: &mut Context<'_>, module: &Module) {
    xml.open("ModuleItem");
    xml.attribute("ID", &module.id);
    xml.attribute("ModuleIdentNumber", format_args!("0x{:08X}", module.number));
    xml.text_attribute("PhysicalSubslots", &ranges(&module.subslots));
    elements::kept(xml, &module.attributes);
    let Module { name, names, documentation, identity, revision, version, attributes, .. } = module;
    let values = [&identity.vendor_name, &identity.order_code, revision, version].map(|text| text.as_str());
    info(xml, context, name, names, documentation.as_deref(), attributes, values);
    subslots(xml, context, &module.subslot_names);
    submodule::built_in(xml, context, &module.submodules, None);
    submodule::useable(xml, context, &module.submodules);
    graphics(xml, &module.attributes);
    xml.close();
    xml.notes.add_many(NoteKind::Extension, module.extensions.len(), Subject::Named(&module.name));
}
