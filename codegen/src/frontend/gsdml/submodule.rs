//! Reads submodules of all kinds: virtual and pluggable submodules, interfaces and ports.

use super::links::{ElementKind, Owner};
use super::module_info::Info;
use super::number::tokens;
use super::reader::Reader;
use crate::frontend::xml::{Given, Read};
use crate::ir::{
    Numbers, ProfinetSettings, SlotNumbers, Submodule, SubmoduleId, SubmoduleKind, SubmoduleUse, SubslotName,
};
use crate::syntax::xml::Tag;

/// Subslot number of the first interface.
const INTERFACE: u16 = 0x8000;

/// Destination for the built-in submodules of an element, and for the device settings that they declare.
pub(super) struct Holder<'h> {
    /// Submodules of the catalog.
    pub submodules: &'h mut Vec<Submodule>,
    /// Submodules that the element uses, with their subslots.
    pub uses: &'h mut Vec<SubmoduleUse>,
    /// Device settings that an interface may declare.
    pub settings: Option<&'h mut ProfinetSettings>,
}

/// Returns the kind of submodule that the element `element` describes, or `None` if the element describes no submodule.
fn kind_of(element: &str) -> Option<SubmoduleKind> {
    match element {
        "VirtualSubmoduleItem" => Some(SubmoduleKind::Virtual),
        "SubmoduleItem" => Some(SubmoduleKind::Pluggable),
        "InterfaceSubmoduleItem" => Some(SubmoduleKind::Interface),
        "PortSubmoduleItem" => Some(SubmoduleKind::Port),
        _ => None,
    }
}

impl<'a> Reader<'a, '_> {
    /// Reads a `VirtualSubmoduleList` or `SystemDefinedSubmoduleList` element.
    pub fn built_in(&mut self, list: &Tag<'a>, holder: &mut Holder<'_>) -> Read<()> {
        while let Some(tag) = self.child(list)? {
            let kind = match kind_of(tag.name) {
                Some(kind) if kind != SubmoduleKind::Pluggable => kind,
                _ => {
                    self.unknown(&tag)?;
                    continue;
                }
            };
            let position = holder.submodules.len();
            let (submodule, fixed) =
                self.submodule(&tag, kind, ElementKind::BuiltIn, position, holder.settings.as_deref_mut())?;
            let fixed = if fixed.is_empty() { Numbers::from_iter([default_subslot(kind)]) } else { fixed };
            holder.submodules.push(submodule);
            let submodule = SubmoduleId(u32::try_from(position).unwrap_or(u32::MAX));
            holder.uses.push(SubmoduleUse { submodule, places: SlotNumbers { fixed, ..SlotNumbers::default() } });
        }
        Ok(())
    }

    /// Reads a `SubmoduleList` element.
    pub fn submodule_list(&mut self, list: &Tag<'a>, submodules: &mut Vec<Submodule>) -> Read<()> {
        while let Some(tag) = self.child(list)? {
            match kind_of(tag.name) {
                Some(kind) => {
                    let (submodule, _) = self.submodule(&tag, kind, ElementKind::Pluggable, submodules.len(), None)?;
                    submodules.push(submodule);
                }
                None => self.unknown(&tag)?,
            }
        }
        Ok(())
    }

    /// Reads a submodule. Also returns the subslots in which the submodule is fixed.
    fn submodule(
        &mut self,
        parent: &Tag<'a>,
        kind: SubmoduleKind,
        ids: ElementKind,
        position: usize,
        mut settings: Option<&mut ProfinetSettings>,
    ) -> Read<(Submodule, Numbers)> {
        let (origin, start) = (self.origin(parent), self.extensions.len());
        let mut submodule = Submodule { kind, origin, status_lengths: (1, 1), ..Submodule::default() };
        let names = ["ID", "SubmoduleIdentNumber", "API", "FixedInSubslots", "SubslotNumber", "TextId"];
        let [id, ident, api, fixed, subslot, text] =
            self.attributes_and_others(parent, names, &mut submodule.attributes)?;
        self.register(parent, ids, &id, position);
        submodule.id = id.compact();
        submodule.ident = self.required_ident(parent, &ident, "SubmoduleIdentNumber");
        submodule.api = self.unsigned(&api, u32::MAX, "API number").unwrap_or(0);
        if !text.is_missing() {
            submodule.name = self.placeholder(text);
        }
        let mut info = Info::default();
        while let Some(tag) = self.child(parent)? {
            match tag.name {
                "IOData" => self.io_data(&tag, &mut submodule)?,
                "RecordDataList" => self.record_data_list(&tag, &mut submodule)?,
                "ModuleInfo" => info = self.module_info(&tag)?,
                "Graphics" => submodule.graphics = self.graphics(&tag)?,
                "ApplicationRelations" => self.application_relations(&tag, settings.as_deref_mut(), &mut submodule)?,
                name if is_kept(name) => self.keep_as_attributes(&tag, &mut submodule.attributes)?,
                _ => self.unknown(&tag)?,
            }
        }
        // Virtual submodules have no name in GSDML V1.0.
        let named = kind == SubmoduleKind::Virtual || !submodule.name.is_empty() || !info.name.is_empty();
        if !named {
            self.missing(parent, "name", "the name is left empty");
        }
        let Submodule { name, documentation, identity, attributes, .. } = &mut submodule;
        info.add_to(name, documentation, identity, attributes);
        submodule.records.shrink_to_fit();
        submodule.extensions = self.extensions_since(start);
        let mut fixed = self.numbers(&fixed);
        fixed.0.extend(self.unsigned16(&subslot, "subslot number").map(|number| (number, number)));
        Ok((submodule, fixed))
    }

    /// Reads an `ApplicationRelations` element. Only the first such element of a device access point fills the fields
    /// of the IR.
    pub fn application_relations(
        &mut self,
        parent: &Tag<'a>,
        settings: Option<&mut ProfinetSettings>,
        submodule: &mut Submodule,
    ) -> Read<()> {
        // Any other `ApplicationRelations` element becomes attributes of the submodule.
        let Some(settings) = settings.filter(|settings| settings.startup_modes.is_empty()) else {
            return self.keep_as_attributes(parent, &mut submodule.attributes);
        };
        let names = ["StartupMode", "NumberOfAR"];
        let [startup, relations] = self.attributes_and_prefixed(parent, names, &mut submodule.attributes)?;
        let startup = if startup.is_missing() { "Legacy" } else { startup.text.as_ref() };
        settings.startup_modes = tokens(startup).map(Into::into).collect();
        settings.relations = self.unsigned16(&relations, "number of application relations").unwrap_or(1);
        while let Some(tag) = self.child(parent)? {
            if tag.name != "TimingProperties" {
                self.keep_as_attributes(&tag, &mut submodule.attributes)?;
                continue;
            }
            let names = ["SendClock", "ReductionRatio"];
            let [clock, ratio] = self.attributes_and_prefixed(&tag, names, &mut submodule.attributes)?;
            settings.send_clocks = self.numbers(&clock);
            settings.reduction_ratios = self.numbers(&ratio);
            self.no_children(&tag)?;
        }
        Ok(())
    }

    /// Reads a `UseableSubmodules` element.
    pub fn useable_submodules(&mut self, list: &Tag<'a>, owner: Owner) -> Read<()> {
        let names = ["SubmoduleItemTarget", "AllowedInSubslots", "FixedInSubslots", "UsedInSubslots"];
        self.each(list, "SubmoduleItemRef", |reader, tag| {
            let [target, allowed, fixed, used] = reader.attributes(tag, names)?;
            let places = reader.places([allowed, fixed, used]);
            if reader.require(tag, &target, "SubmoduleItemTarget", "left out") {
                reader.format.links.submodules.push((owner, target, places));
            }
            reader.no_children(tag)
        })
    }

    /// Reads the slot or subslot numbers in the attributes `Allowed…`, `Fixed…` and `Used…`.
    pub fn places(&mut self, given: [Given<'a>; 3]) -> SlotNumbers {
        let [allowed, fixed, used] = given.map(|given| self.numbers(&given));
        SlotNumbers { allowed, fixed, used }
    }

    /// Reads a `SubslotList` element.
    pub fn subslot_list(&mut self, list: &Tag<'a>) -> Read<Vec<SubslotName>> {
        let mut subslots = Vec::new();
        self.each(list, "SubslotItem", |reader, tag| {
            let [number, text] = reader.attributes(tag, ["SubslotNumber", "TextId"])?;
            reader.require(tag, &number, "SubslotNumber", "left out");
            let name = reader.name(tag, text);
            if let Some(number) = reader.unsigned16(&number, "subslot number") {
                subslots.push(SubslotName { number, name, ..SubslotName::default() });
            }
            reader.no_children(tag)
        })?;
        Ok(subslots)
    }
}

/// Returns whether a child element of a submodule becomes attributes of the submodule.
fn is_kept(element: &str) -> bool {
    const NAMES: [&str; 11] = [
        "IsochroneMode",
        "SlotCluster",
        "PROFIenergy",
        "ReportingSystemEvents",
        "MAUTypeList",
        "General",
        "RT_Class3Properties",
        "SynchronisationMode",
        "TimeSynchronisation",
        "ReportingSystem",
        "MediaRedundancy",
    ];
    NAMES.contains(&element)
}

/// Returns the subslot in which a submodule of this kind is built in by default.
fn default_subslot(kind: SubmoduleKind) -> u16 {
    match kind {
        SubmoduleKind::Interface => INTERFACE,
        SubmoduleKind::Port => INTERFACE + 1,
        SubmoduleKind::Virtual | SubmoduleKind::Pluggable => 1,
    }
}
