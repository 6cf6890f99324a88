//! Writes all kinds of submodules: virtual and pluggable submodules, interfaces and ports.

use std::collections::HashSet;

use super::elements::{self, Attributes};
use super::module::{self, find, graphics_of, slot_lists};
use super::values::ranges;
use super::{io_data, record, Context};
use crate::note::{NoteKind, Subject};
use crate::xml::Xml;
use lexibus_codegen::ir::{
    Catalog, CompactString, Device, Numbers, ProfinetSettings, Submodule, SubmoduleKind, SubmoduleUse,
};

/// Subslot of the first interface.
const INTERFACE: u16 = 0x8000;

/// Returns whether the element of the submodule is inside a device access point or module, and not in the submodule
/// list.
fn is_built_in(context: &Context<'_>, at: u32) -> bool {
    let Some(submodule) = context.catalog.submodules.get(at as usize) else { return false };
    match submodule.kind {
        SubmoduleKind::Virtual | SubmoduleKind::Interface => true,
        SubmoduleKind::Pluggable => false,
        SubmoduleKind::Port => !context.pluggable_ports.contains(&at),
    }
}

/// Returns the ports for the submodule list: ports that several elements use, that an element allows or uses in
/// subslots without fixing them there, or that no element uses.
pub(super) fn pluggable_ports(catalog: &Catalog) -> HashSet<u32> {
    let uses = |list: &[SubmoduleUse]| -> Vec<(u32, bool)> {
        let is_anywhere = |submodule_use: &SubmoduleUse| {
            !submodule_use.places.allowed.is_empty() || !submodule_use.places.used.is_empty()
        };
        list.iter().map(|submodule_use| (submodule_use.submodule.0, is_anywhere(submodule_use))).collect()
    };
    let of_devices = catalog.devices.iter().flat_map(|device: &Device| uses(&device.submodules));
    let of_modules = catalog.modules.iter().flat_map(|module| uses(&module.submodules));
    let (mut pluggable, mut used) = (HashSet::new(), HashSet::new());
    for (at, is_anywhere) in of_devices.chain(of_modules) {
        // A port that two elements use cannot be built into either of them.
        if !used.insert(at) || is_anywhere {
            pluggable.insert(at);
        }
    }
    let is_port = |submodule: &Submodule| submodule.kind == SubmoduleKind::Port;
    let unused = (0u32..).zip(&catalog.submodules).filter(|(at, submodule)| is_port(submodule) && !used.contains(at));
    pluggable.extend(unused.map(|(at, _)| at));
    pluggable
}

/// Writes the built-in submodules of a device access point or a module.
pub(super) fn built_in(
    xml: &mut Xml,
    context: &mut Context<'_>,
    uses: &[SubmoduleUse],
    settings: Option<&ProfinetSettings>,
) {
    let catalog = context.catalog;
    let built_in: Vec<(&Submodule, &SubmoduleUse)> = uses
        .iter()
        .filter(|submodule_use| is_built_in(context, submodule_use.submodule.0))
        .filter_map(|built_in| Some((catalog.submodules.get(built_in.submodule.0 as usize)?, built_in)))
        .collect();
    let (ordinary, system): (Vec<_>, Vec<_>) =
        built_in.into_iter().partition(|(submodule, _)| submodule.kind == SubmoduleKind::Virtual);
    xml.list("VirtualSubmoduleList", ordinary, |xml, (submodule, submodule_use)| {
        let fixed = Some(&submodule_use.places.fixed).filter(|numbers| **numbers != Numbers::from_iter([1]));
        write(xml, context, submodule, "VirtualSubmoduleItem", fixed, None);
    });
    let mut settings = settings;
    xml.list("SystemDefinedSubmoduleList", system, |xml, (submodule, submodule_use)| {
        let element = match submodule.kind {
            SubmoduleKind::Interface => "InterfaceSubmoduleItem",
            _ => "PortSubmoduleItem",
        };
        // The first interface contains the settings of the whole device.
        let settings = settings.take_if(|_| submodule.kind == SubmoduleKind::Interface);
        write(xml, context, submodule, element, Some(&submodule_use.places.fixed), settings);
    });
}

/// Writes references to pluggable submodules.
pub(super) fn useable(xml: &mut Xml, context: &mut Context<'_>, uses: &[SubmoduleUse]) {
    let catalog = context.catalog;
    let others: Vec<&SubmoduleUse> =
        uses.iter().filter(|submodule_use| !is_built_in(context, submodule_use.submodule.0)).collect();
    xml.list("UseableSubmodules", others, |xml, submodule_use| {
        let Some(submodule) = catalog.submodules.get(submodule_use.submodule.0 as usize) else { return };
        xml.open("SubmoduleItemRef");
        xml.attribute("SubmoduleItemTarget", &submodule.id);
        slot_lists(xml, &submodule_use.places, "Subslots");
        xml.close();
    });
}

/// Writes the SubmoduleList element.
pub(super) fn pluggable(xml: &mut Xml, context: &mut Context<'_>) {
    let catalog = context.catalog;
    let is_listed = |(at, submodule): &(u32, &Submodule)| match submodule.kind {
        SubmoduleKind::Pluggable => true,
        SubmoduleKind::Port => context.pluggable_ports.contains(at),
        SubmoduleKind::Virtual | SubmoduleKind::Interface => false,
    };
    let listed: Vec<(u32, &Submodule)> = (0u32..).zip(&catalog.submodules).filter(is_listed).collect();
    xml.list("SubmoduleList", listed, |xml, (_, submodule)| {
        let element = match submodule.kind {
            SubmoduleKind::Port => "PortSubmoduleItem",
            _ => "SubmoduleItem",
        };
        write(xml, context, submodule, element, None, None);
    });
}

fn write(
    xml: &mut Xml,
    context: &mut Context<'_>,
    submodule: &Submodule,
    element: &'static str,
    fixed: Option<&Numbers>,
    settings: Option<&ProfinetSettings>,
) {
    let attributes = submodule.attributes.as_slice();
    let is_system = matches!(element, "InterfaceSubmoduleItem" | "PortSubmoduleItem");
    let has_info = !is_system || fixed.is_none();
    xml.open(element);
    head(xml, context, submodule, has_info);
    match fixed.filter(|numbers| !numbers.is_empty()) {
        Some(numbers) if is_system => subslot(xml, element, numbers),
        Some(numbers) => xml.attribute("FixedInSubslots", ranges(numbers)),
        None => {}
    }
    elements::kept(xml, attributes);
    match submodule.kind {
        SubmoduleKind::Virtual | SubmoduleKind::Pluggable => io_data::write(xml, context, submodule),
        SubmoduleKind::Interface => elements::GENERAL.write(xml, attributes),
        SubmoduleKind::Port => {}
    }
    record::list(xml, context, submodule);
    match submodule.kind {
        SubmoduleKind::Interface => interface(xml, attributes, settings),
        SubmoduleKind::Port => elements::MAU_TYPES.write(xml, attributes),
        SubmoduleKind::Virtual | SubmoduleKind::Pluggable => {}
    }
    if has_info {
        info(xml, context, submodule);
    }
    graphics_of(xml, submodule.graphics.iter().map(|(kind, target)| (kind.as_str(), target)));
    if matches!(submodule.kind, SubmoduleKind::Virtual | SubmoduleKind::Pluggable) {
        elements::OF_SUBMODULE.iter().for_each(|element| element.write(xml, attributes));
    }
    xml.close();
    xml.notes.add_many(NoteKind::Extension, submodule.extensions.len(), Subject::Named(&submodule.name));
}

fn head(xml: &mut Xml, context: &mut Context<'_>, submodule: &Submodule, has_info: bool) {
    xml.text_attribute("ID", &submodule.id);
    xml.attribute("SubmoduleIdentNumber", format_args!("0x{:08X}", submodule.ident));
    xml.unless("API", submodule.api, 0);
    xml.optional("TextId", (!has_info).then(|| context.texts.id(&submodule.name, &submodule.names)));
}

/// Writes the subslot number of a port, or of an interface whose subslot is not the default.
fn subslot(xml: &mut Xml, element: &str, numbers: &Numbers) {
    let first = numbers.0.first().map_or(INTERFACE, |(first, _)| *first);
    xml.optional("SubslotNumber", Some(first).filter(|first| element == "PortSubmoduleItem" || *first != INTERFACE));
}

fn info(xml: &mut Xml, context: &mut Context<'_>, submodule: &Submodule) {
    let attributes = submodule.attributes.as_slice();
    let has_nothing = submodule.name.is_empty() && submodule.documentation.is_none();
    if has_nothing && context.is_gsdml {
        return;
    }
    let Submodule { name, names, documentation, identity, .. } = submodule;
    let [hardware, software] = ["HardwareRelease", "SoftwareRelease"].map(|key| find(attributes, key));
    let values = [&identity.vendor_name, &identity.order_code, hardware, software];
    module::info(xml, context, name, names, documentation.as_deref(), attributes, values);
}

/// Writes the child elements of an interface that come after its records.
fn interface(xml: &mut Xml, attributes: &Attributes, settings: Option<&ProfinetSettings>) {
    elements::OF_INTERFACE.iter().for_each(|element| element.write(xml, attributes));
    elements::RELATIONS.write(xml, &relations(attributes, settings, true));
    elements::MEDIA_REDUNDANCY.write(xml, attributes);
}

/// Returns the attributes of ApplicationRelations and its child elements, including those that the IR stores in fields.
pub(super) fn relations(
    attributes: &Attributes,
    settings: Option<&ProfinetSettings>,
    is_interface: bool,
) -> Vec<(CompactString, CompactString)> {
    let of = |element: &str| {
        let is_of_element = |key: &str| key.split_once('@').map_or(key, |(name, _)| name) == element;
        attributes.iter().filter(move |(key, _)| is_of_element(key)).cloned().collect::<Vec<_>>()
    };
    let attribute = |key: &str, value: String| (key.into(), value.into());
    let mut list = Vec::new();
    let mut timing = Vec::new();
    if let Some(settings) = settings {
        let modes = settings.startup_modes.join(";");
        let has_modes = is_interface || modes != "Legacy";
        list.extend(has_modes.then(|| attribute("ApplicationRelations@StartupMode", modes)));
        let relations = Some(settings.relations).filter(|relations| *relations != 1);
        list.extend(relations.map(|relations| attribute("ApplicationRelations@NumberOfAR", relations.to_string())));
        let numbers = [
            ("TimingProperties@SendClock", &settings.send_clocks),
            ("TimingProperties@ReductionRatio", &settings.reduction_ratios),
        ];
        let numbers = numbers.into_iter().filter(|(_, numbers)| !numbers.is_empty());
        timing.extend(numbers.map(|(key, numbers)| attribute(key, ranges(numbers))));
    }
    list.extend(of("ApplicationRelations"));
    list.append(&mut timing);
    list.extend(of("TimingProperties"));
    list.extend(of("RT_Class3TimingProperties"));
    list
}
