//! Elements whose attributes the IR stores unchanged, as a list of `Element@Attribute` and value.

use crate::xml::Xml;
use lexibus_codegen::ir::CompactString;

/// Name of an element, and its allowed child elements.
pub(super) struct Element(&'static str, &'static [Element]);

pub(super) static CERTIFICATION: Element = Element("CertificationInfo", &[]);
pub(super) static ASSETS: Element = Element("AssetManagement", &[]);
pub(super) static REDUNDANCY: Element = Element("SystemRedundancy", &[]);
pub(super) static SLOT_GROUPS: Element =
    Element("SlotGroups", &[Element("SlotGroup", &[Element("Name", &[]), Element("InfoText", &[])])]);
pub(super) static FIELDBUS_SLOTS: Element = Element("FieldbusIntegrationSlots", &[]);
pub(super) static RELATIONS: Element =
    Element("ApplicationRelations", &[Element("TimingProperties", &[]), Element("RT_Class3TimingProperties", &[])]);
pub(super) static MAU_TYPES: Element = Element("MAUTypeList", &[Element("MAUTypeItem", &[])]);
pub(super) static FAMILY: Element = Element("Family", &[]);

/// The child element of an interface before the interface's records. [`OF_INTERFACE`], [`RELATIONS`] and
/// [`MEDIA_REDUNDANCY`] are the child elements after the records.
pub(super) static GENERAL: Element = Element("General", &[Element("DCP_FlashOnceSignalUnit", &[])]);
pub(super) static OF_INTERFACE: [Element; 4] = [
    Element("RT_Class3Properties", &[]),
    Element("SynchronisationMode", &[]),
    Element("TimeSynchronisation", &[]),
    Element("ReportingSystem", &[]),
];
pub(super) static MEDIA_REDUNDANCY: Element = Element("MediaRedundancy", &[Element("Interconnection", &[])]);

/// The child elements of a virtual or pluggable submodule after the submodule's pictures.
pub(super) static OF_SUBMODULE: [Element; 4] = [
    Element("IsochroneMode", &[]),
    Element("SlotCluster", &[]),
    Element(
        "PROFIenergy",
        &[
            Element("EnergySavingModeList", &[Element("EnergySavingModeItem", &[])]),
            Element("MeasurementList", &[Element("MeasurementItem", &[Element("MeasurementValue", &[])])]),
        ],
    ),
    Element("ReportingSystemEvents", &[Element("Observer", &[])]),
];

pub(super) type Attributes = [(CompactString, CompactString)];

impl Element {
    /// Returns the element names on the path from this element to the element `name`, which is this element or a descendant.
    fn path(&self, name: &str) -> Option<Vec<&'static str>> {
        let Element(first, children) = *self;
        if first == name {
            return Some(vec![first]);
        }
        let below = children.iter().find_map(|child| child.path(name))?;
        Some(std::iter::once(first).chain(below).collect())
    }

    /// Writes the element once for each of its occurrences in `attributes`.
    pub(super) fn write<'e>(
        &self,
        xml: &mut Xml,
        attributes: impl IntoIterator<Item = &'e (CompactString, CompactString)>,
    ) {
        let mut open: Vec<Opened<'e>> = Vec::new();
        for (key, value) in attributes {
            let (name, attribute) = key.split_once('@').unwrap_or((key, ""));
            let Some(path) = self.path(name) else { continue };
            let is_new =
                |opened: &Opened<'_>| opened.is_full || attribute.is_empty() || opened.seen.contains(&attribute);
            let same = open.iter().zip(&path).take_while(|(opened, name)| opened.name == **name).count();
            let keep = match open.get(same.wrapping_sub(1)) {
                Some(opened) if same == path.len() && is_new(opened) => same - 1,
                _ => same,
            };
            while open.len() > keep {
                open.pop();
                xml.close();
            }
            for name in path.iter().skip(keep) {
                if let Some(above) = open.last_mut() {
                    above.is_full = true;
                }
                xml.open(*name);
                open.push(Opened { name, seen: Vec::new(), is_full: false });
            }
            if attribute.is_empty() {
                xml.content(value);
            } else if let Some(opened) = open.last_mut() {
                opened.seen.push(attribute);
                xml.attribute(attribute, value);
            }
        }
        open.iter().for_each(|_| xml.close());
    }
}

/// Writes the attributes of `element` that the IR stores unchanged.
pub(super) fn attributes_of(xml: &mut Xml, element: &str, attributes: &Attributes) {
    for (key, value) in attributes {
        if let Some((_, name)) = key.split_once('@').filter(|(name, _)| *name == element) {
            xml.attribute(name, value);
        }
    }
}

/// Writes the attributes that the IR stores unchanged, except those of child elements.
pub(super) fn kept(xml: &mut Xml, attributes: &Attributes) {
    for (key, value) in attributes.iter().filter(|(key, _)| !is_of_element(key) && !is_of_info(key)) {
        xml.attribute(key, value);
    }
}

/// An element whose start tag has been written.
struct Opened<'e> {
    name: &'static str,
    seen: Vec<&'e str>,
    /// True if the element already has children, so that no attributes can follow.
    is_full: bool,
}

/// Returns whether `key` contains an element name: as `Element@Attribute`, as a path, or as the name of a known element.
pub(super) fn is_of_element(key: &str) -> bool {
    let roots = [&CERTIFICATION, &ASSETS, &REDUNDANCY, &SLOT_GROUPS, &FIELDBUS_SLOTS, &RELATIONS, &MAU_TYPES, &FAMILY];
    let all = roots.into_iter().chain([&GENERAL, &MEDIA_REDUNDANCY]).chain(&OF_INTERFACE).chain(&OF_SUBMODULE);
    let name = key.split_once('@').map_or(key, |(name, _)| name);
    key.contains(['@', '/']) || all.into_iter().any(|root| root.path(name).is_some())
}

/// Attributes of ModuleInfo.
pub(super) const OF_INFO: [&str; 2] = ["CategoryRef", "SubCategory1Ref"];

/// Returns whether the IR stores a fact of the ModuleInfo element under this key.
fn is_of_info(key: &str) -> bool {
    OF_INFO.contains(&key) || matches!(key, "HardwareRelease" | "SoftwareRelease")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_repeated_attribute_begins_another_element() {
        let list = [
            ("MAUTypeList@ExtensionSupported", "true"),
            ("MAUTypeItem@Value", "16"),
            ("MAUTypeItem@Extension", "1"),
            ("MAUTypeItem@Value", "30"),
            ("Other@Value", "1"),
        ]
        .map(|(key, value)| (CompactString::from(key), CompactString::from(value)));
        let mut xml = Xml::new();
        MAU_TYPES.write(&mut xml, &list);
        let text = xml.finish().text.lines().skip(1).map(str::trim).collect::<Vec<_>>().join("");
        let items = "<MAUTypeItem Value=\"16\" Extension=\"1\"/><MAUTypeItem Value=\"30\"/>";
        assert_eq!(text, format!("<MAUTypeList ExtensionSupported=\"true\">{items}</MAUTypeList>"));
        assert!(is_of_element("TimeSynchronisation") && !is_of_element("MayIssueProcessAlarm"));
    }
}
