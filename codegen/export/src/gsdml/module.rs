//! Modules, and what modules, submodules and device access points have in common.

use super::elements::{self, Attributes};
use super::{submodule, Context};
use crate::note::{NoteKind, Place};
use crate::xml::Xml;
use lexibus_codegen::ir::{CompactString, Documentation, Extension, Module, Numbers, Places, SubslotName, Texts};

/// What ModuleInfo says.
pub(super) struct Info<'i> {
    pub(super) name: &'i str,
    pub(super) names: &'i Texts,
    pub(super) documentation: Option<&'i Documentation>,
    pub(super) vendor: &'i str,
    pub(super) order: &'i str,
    pub(super) hardware: &'i str,
    pub(super) software: &'i str,
    /// Category and family.
    pub(super) attributes: &'i Attributes,
}

/// Attributes of ModuleInfo.
const OF_INFO: [&str; 2] = ["CategoryRef", "SubCategory1Ref"];

/// The value of an attribute that is kept as it is.
pub(super) fn find<'a>(attributes: &'a Attributes, key: &str) -> &'a str {
    attributes.iter().find(|(own, _)| own == key).map_or("", |(_, value)| value)
}

impl Info<'_> {
    /// Writes ModuleInfo.
    pub(super) fn write(&self, xml: &mut Xml, context: &mut Context<'_>) {
        xml.open("ModuleInfo");
        for key in OF_INFO {
            let value = find(self.attributes, key);
            if !value.is_empty() {
                xml.attribute(key, value);
            }
        }
        xml.open("Name");
        xml.attribute("TextId", context.texts.id(self.name, self.names));
        xml.close();
        match self.documentation {
            Some(documentation) => context.texts.documentation(xml, "InfoText", documentation),
            None if context.is_gsdml => {}
            // The schema wants a text there.
            None => {
                let own = Documentation {
                    text: self.name.into(),
                    translations: self.names.clone(),
                    ..Documentation::default()
                };
                context.texts.documentation(xml, "InfoText", &own);
                context.notes.add(NoteKind::MissingText, Place::Named(self.name));
            }
        }
        elements::FAMILY.write(xml, self.attributes);
        let values = [
            ("VendorName", self.vendor),
            ("OrderNumber", self.order),
            ("HardwareRelease", self.hardware),
            ("SoftwareRelease", self.software),
        ];
        for (name, value) in values.into_iter().filter(|(_, value)| !value.is_empty()) {
            xml.open(name);
            xml.attribute("Value", value);
            xml.close();
        }
        xml.close();
    }
}

/// Whether an attribute stands in ModuleInfo.
pub(super) fn is_of_info(key: &str) -> bool {
    OF_INFO.contains(&key) || matches!(key, "HardwareRelease" | "SoftwareRelease")
}

/// Ranges of numbers as GSDML writes them.
pub(super) fn ranges(numbers: &Numbers) -> String {
    let range = |&(first, last): &(u16, u16)| match first == last {
        true => first.to_string(),
        false => format!("{first}..{last}"),
    };
    numbers.0.iter().map(range).collect::<Vec<_>>().join(" ")
}

/// Attributes that list places; `what` is Slots or Subslots.
pub(super) fn places(xml: &mut Xml, places: &Places, what: &str) {
    let lists = [("AllowedIn", &places.allowed), ("UsedIn", &places.used), ("FixedIn", &places.fixed)];
    for (name, numbers) in lists.into_iter().filter(|(_, numbers)| !numbers.is_empty()) {
        xml.attribute(&format!("{name}{what}"), ranges(numbers));
    }
}

/// Writes SubslotList.
pub(super) fn subslots(xml: &mut Xml, context: &mut Context<'_>, names: &[SubslotName]) {
    if names.is_empty() {
        return;
    }
    xml.open("SubslotList");
    for own in names {
        xml.open("SubslotItem");
        xml.attribute("SubslotNumber", own.number);
        xml.attribute("TextId", context.texts.id(&own.name, &own.names));
        xml.close();
    }
    xml.close();
}

/// Writes Graphics of references that are kept as `GraphicItemRef@Type`.
pub(super) fn graphics(xml: &mut Xml, attributes: &Attributes) {
    let own = attributes.iter().filter_map(|(key, target)| Some((key.strip_prefix("GraphicItemRef@")?, target)));
    graphics_of(xml, own);
}

/// Writes Graphics.
pub(super) fn graphics_of<'g>(xml: &mut Xml, list: impl Iterator<Item = (&'g str, &'g CompactString)>) {
    let mut list = list.peekable();
    if list.peek().is_none() {
        return;
    }
    xml.open("Graphics");
    for (kind, target) in list {
        xml.open("GraphicItemRef");
        xml.attribute("Type", kind);
        xml.attribute("GraphicItemTarget", target);
        xml.close();
    }
    xml.close();
}

/// Writes a module.
pub(super) fn write(xml: &mut Xml, context: &mut Context<'_>, module: &Module) {
    let is_attribute = |extension: &&Extension| !extension.key.contains('/');
    let attributes: Vec<(CompactString, CompactString)> = module
        .extensions
        .iter()
        .filter(is_attribute)
        .map(|extension| (extension.key.clone(), extension.value.clone()))
        .collect();
    xml.open("ModuleItem");
    xml.attribute("ID", &module.id);
    xml.attribute("ModuleIdentNumber", format_args!("0x{:08X}", module.number));
    if !module.subslots.is_empty() {
        xml.attribute("PhysicalSubslots", ranges(&module.subslots));
    }
    for (key, value) in attributes.iter().filter(|(key, _)| !elements::is_of_element(key) && !is_of_info(key)) {
        xml.attribute(key, value);
    }
    let info = Info {
        name: &module.name,
        names: &module.names,
        documentation: module.documentation.as_deref(),
        vendor: &module.identity.vendor_name,
        order: &module.identity.order_code,
        hardware: &module.revision,
        software: &module.version,
        attributes: &attributes,
    };
    info.write(xml, context);
    subslots(xml, context, &module.subslot_names);
    submodule::built_in(xml, context, &module.submodules, None);
    submodule::useable(xml, context, &module.submodules);
    graphics(xml, &attributes);
    xml.close();
    let lost = module.extensions.len() - attributes.len();
    context.notes.add_many(NoteKind::Extension, lost, Place::Named(&module.name));
}
