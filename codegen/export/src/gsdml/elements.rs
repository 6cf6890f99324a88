//! Elements whose attributes the IR stores unchanged, as a list of `Element@Attribute` and value.

use crate::xml::Xml;
use lexibus_codegen::ir::CompactString;

/// An element and its allowed child elements.
pub(super) struct Element {
    pub(super) name: &'static str,
    children: &'static [Element],
}

const fn leaf(name: &'static str) -> Element {
    Element { name, children: &[] }
}

const fn element(name: &'static str, children: &'static [Element]) -> Element {
    Element { name, children }
}

static NAMED: [Element; 2] = [leaf("Name"), leaf("InfoText")];
static SLOT_GROUP: [Element; 1] = [element("SlotGroup", &NAMED)];
static MAU_TYPE: [Element; 1] = [leaf("MAUTypeItem")];
static TIMING: [Element; 2] = [leaf("TimingProperties"), leaf("RT_Class3TimingProperties")];
static SIGNAL: [Element; 1] = [leaf("DCP_FlashOnceSignalUnit")];
static INTERCONNECTION: [Element; 1] = [leaf("Interconnection")];
static OBSERVER: [Element; 1] = [leaf("Observer")];
static ENERGY_MODE: [Element; 1] = [leaf("EnergySavingModeItem")];
static MEASUREMENT_VALUE: [Element; 1] = [leaf("MeasurementValue")];
static MEASUREMENT: [Element; 1] = [element("MeasurementItem", &MEASUREMENT_VALUE)];
static ENERGY: [Element; 2] = [element("EnergySavingModeList", &ENERGY_MODE), element("MeasurementList", &MEASUREMENT)];

pub(super) static CERTIFICATION: Element = leaf("CertificationInfo");
pub(super) static ASSETS: Element = leaf("AssetManagement");
pub(super) static REDUNDANCY: Element = leaf("SystemRedundancy");
pub(super) static SLOT_GROUPS: Element = element("SlotGroups", &SLOT_GROUP);
pub(super) static FIELDBUS_SLOTS: Element = leaf("FieldbusIntegrationSlots");
pub(super) static RELATIONS: Element = element("ApplicationRelations", &TIMING);
pub(super) static MAU_TYPES: Element = element("MAUTypeList", &MAU_TYPE);
pub(super) static FAMILY: Element = leaf("Family");

/// The child element of an interface before the interface's records. [`OF_INTERFACE`], [`RELATIONS`] and
/// [`MEDIA_REDUNDANCY`] are the child elements after the records.
pub(super) static GENERAL: Element = element("General", &SIGNAL);
pub(super) static OF_INTERFACE: [Element; 4] =
    [leaf("RT_Class3Properties"), leaf("SynchronisationMode"), leaf("TimeSynchronisation"), leaf("ReportingSystem")];
pub(super) static MEDIA_REDUNDANCY: Element = element("MediaRedundancy", &INTERCONNECTION);

/// The child elements of a virtual or pluggable submodule after the submodule's pictures.
pub(super) static OF_SUBMODULE: [Element; 4] = [
    leaf("IsochroneMode"),
    leaf("SlotCluster"),
    element("PROFIenergy", &ENERGY),
    element("ReportingSystemEvents", &OBSERVER),
];

pub(super) type Attributes = [(CompactString, CompactString)];

impl Element {
    fn has(&self, name: &str) -> bool {
        self.name == name || self.children.iter().any(|child| child.has(name))
    }

    /// Returns the element names on the path from this element to the descendant `name`.
    fn path(&self, name: &str) -> Option<Vec<&'static str>> {
        if self.name == name {
            return Some(vec![self.name]);
        }
        let below = self.children.iter().find_map(|child| child.path(name))?;
        Some(std::iter::once(self.name).chain(below).collect())
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
    key.contains(['@', '/']) || all.into_iter().any(|root| root.has(name))
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
