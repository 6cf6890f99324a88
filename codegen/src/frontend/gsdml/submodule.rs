//! Submodules of all kinds: virtual and pluggable ones, interfaces and ports.

use super::links::{Kind, Owner};
use super::module::Info;
use super::number::tokens;
use super::reader::{attribute, Given, Read, Reader};
use crate::ir::{
    CompactString, Extensions, Numbers, Places, ProfinetSettings, Submodule, SubmoduleId, SubmoduleKind, SubmoduleUse,
    SubslotName,
};
use crate::syntax::xml::Tag;

/// Subslot of the first interface.
const INTERFACE: u16 = 0x8000;

/// What holds built-in submodules.
pub(super) struct Holder<'h> {
    /// Submodules of the catalogue.
    pub submodules: &'h mut Vec<Submodule>,
    /// Where they are.
    pub uses: &'h mut Vec<SubmoduleUse>,
    /// What an interface says of the device as a whole.
    pub settings: Option<&'h mut ProfinetSettings>,
    pub extensions: &'h mut Extensions,
}

/// The kind of submodule that an element stands for.
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
    /// Reads VirtualSubmoduleList or SystemDefinedSubmoduleList.
    pub fn built_in(&mut self, list: &Tag<'a>, holder: &mut Holder<'_>) -> Read<()> {
        while let Some(tag) = self.cursor.child(list)? {
            let kind = match kind_of(tag.name) {
                Some(kind) if kind != SubmoduleKind::Pluggable => kind,
                _ => {
                    self.unknown(&tag, holder.extensions)?;
                    continue;
                }
            };
            let position = holder.submodules.len();
            let (submodule, fixed) =
                self.submodule(&tag, kind, Kind::BuiltIn, position, holder.settings.as_deref_mut())?;
            let fixed = if fixed.is_empty() { Numbers::from_iter([default_subslot(kind)]) } else { fixed };
            holder.submodules.push(submodule);
            let submodule = SubmoduleId(u32::try_from(position).unwrap_or(u32::MAX));
            holder.uses.push(SubmoduleUse { submodule, places: Places { fixed, ..Places::default() } });
        }
        Ok(())
    }

    /// Reads SubmoduleList.
    pub fn submodule_list(
        &mut self,
        list: &Tag<'a>,
        submodules: &mut Vec<Submodule>,
        rest: &mut Extensions,
    ) -> Read<()> {
        while let Some(tag) = self.cursor.child(list)? {
            match kind_of(tag.name) {
                Some(kind) => {
                    let (submodule, _) = self.submodule(&tag, kind, Kind::Pluggable, submodules.len(), None)?;
                    submodules.push(submodule);
                }
                None => self.unknown(&tag, rest)?,
            }
        }
        Ok(())
    }

    /// Reads a submodule; gives it with the subslots in which it is built in.
    fn submodule(
        &mut self,
        parent: &Tag<'a>,
        kind: SubmoduleKind,
        ids: Kind,
        position: usize,
        mut settings: Option<&mut ProfinetSettings>,
    ) -> Read<(Submodule, Numbers)> {
        let origin = self.cursor.origin(parent);
        let mut submodule = Submodule { kind, origin, status_lengths: (1, 1), ..Submodule::default() };
        let names = ["ID", "SubmoduleIdentNumber", "API", "FixedInSubslots", "SubslotNumber", "TextId"];
        let [id, ident, api, fixed, subslot, text] = self.fields_of(parent, &names, &mut submodule.attributes)?;
        self.register(parent, ids, id.as_ref(), position);
        submodule.id = id.map_or_else(CompactString::default, |id| id.text.into());
        submodule.ident = self.required_ident(parent, ident.as_ref(), "SubmoduleIdentNumber");
        submodule.api = self.unsigned(api.as_ref(), u32::MAX, "API number").unwrap_or(0);
        if let Some(text) = text {
            submodule.name = self.names.hold(text);
        }
        let mut info = Info::default();
        while let Some(tag) = self.cursor.child(parent)? {
            match tag.name {
                "IOData" => self.io_data(&tag, &mut submodule)?,
                "RecordDataList" => self.record_data_list(&tag, &mut submodule)?,
                "ModuleInfo" => info = self.module_info(&tag, &mut submodule.extensions)?,
                "Graphics" => submodule.graphics = self.graphics(&tag, &mut submodule.extensions)?,
                "ApplicationRelations" => {
                    self.application_relations(&tag, settings.as_deref_mut(), &mut submodule)?;
                }
                name if is_kept(name) => self.keep_attributes(&tag, &mut submodule.attributes)?,
                _ => self.unknown(&tag, &mut submodule.extensions)?,
            }
        }
        // Virtual submodules of V1.0 have no name.
        let named = kind == SubmoduleKind::Virtual || !submodule.name.is_empty() || !info.name.is_empty();
        if !named {
            self.missing(parent, "name", "its name is left empty");
        }
        info.of_submodule(&mut submodule);
        let mut fixed = self.numbers(fixed.as_ref());
        if let Some(number) = self.unsigned16(subslot.as_ref(), "number of a subslot") {
            fixed.0.push((number, number));
        }
        Ok((submodule, fixed))
    }

    /// Reads ApplicationRelations. What the IR has fields for is taken from the first interface.
    pub fn application_relations(
        &mut self,
        parent: &Tag<'a>,
        settings: Option<&mut ProfinetSettings>,
        submodule: &mut Submodule,
    ) -> Read<()> {
        // Of a further interface, everything is kept as it is written.
        let Some(settings) = settings.filter(|settings| settings.startup_modes.is_empty()) else {
            return self.keep_attributes(parent, &mut submodule.attributes);
        };
        let mut others = Vec::new();
        let [startup, relations] = self.fields_of(parent, &["StartupMode", "NumberOfAR"], &mut others)?;
        add("ApplicationRelations", others, submodule);
        let startup = startup.as_ref().map_or("Legacy", |given| given.text.as_ref());
        settings.startup_modes = tokens(startup).map(Into::into).collect();
        settings.relations = self.unsigned16(relations.as_ref(), "number of application relations").unwrap_or(1);
        while let Some(tag) = self.cursor.child(parent)? {
            if tag.name != "TimingProperties" {
                self.keep_attributes(&tag, &mut submodule.attributes)?;
                continue;
            }
            let mut others = Vec::new();
            let [clock, ratio] = self.fields_of(&tag, &["SendClock", "ReductionRatio"], &mut others)?;
            add("TimingProperties", others, submodule);
            settings.send_clocks = self.numbers(clock.as_ref());
            settings.reduction_ratios = self.numbers(ratio.as_ref());
            self.no_children(&tag, &mut submodule.extensions)?;
        }
        Ok(())
    }

    /// Reads UseableSubmodules.
    pub fn useable_submodules(&mut self, list: &Tag<'a>, owner: Owner, rest: &mut Extensions) -> Read<()> {
        let names = ["SubmoduleItemTarget", "AllowedInSubslots", "FixedInSubslots", "UsedInSubslots"];
        while let Some(tag) = self.cursor.child(list)? {
            if tag.name != "SubmoduleItemRef" {
                self.unknown(&tag, rest)?;
                continue;
            }
            let [target, allowed, fixed, used] = self.fields(&tag, &names, rest)?;
            let places = self.places([allowed, fixed, used]);
            match target {
                Some(target) => self.links.submodule(owner, target, places),
                None => self.missing(&tag, "SubmoduleItemTarget", "left out"),
            }
            self.no_children(&tag, rest)?;
        }
        Ok(())
    }

    /// The places that the attributes Allowed…, Fixed… and Used… list.
    pub fn places(&mut self, given: [Option<Given<'a>>; 3]) -> Places {
        let [allowed, fixed, used] = given.map(|given| self.numbers(given.as_ref()));
        Places { allowed, fixed, used }
    }

    /// Reads SubslotList.
    pub fn subslot_list(&mut self, list: &Tag<'a>, rest: &mut Extensions) -> Read<Vec<SubslotName>> {
        let mut subslots = Vec::new();
        while let Some(tag) = self.cursor.child(list)? {
            if tag.name != "SubslotItem" {
                self.unknown(&tag, rest)?;
                continue;
            }
            let [number, text] = self.fields(&tag, &["SubslotNumber", "TextId"], rest)?;
            if number.is_none() {
                self.missing(&tag, "SubslotNumber", "left out");
            }
            let name = self.name(&tag, text);
            if let Some(number) = self.unsigned16(number.as_ref(), "number of a subslot") {
                subslots.push(SubslotName { number, name, ..SubslotName::default() });
            }
            self.no_children(&tag, rest)?;
        }
        Ok(subslots)
    }
}

/// Whether an element of a submodule is kept as attributes.
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

/// Where a submodule is that doesn't say it.
fn default_subslot(kind: SubmoduleKind) -> u16 {
    match kind {
        SubmoduleKind::Interface => INTERFACE,
        SubmoduleKind::Port => INTERFACE + 1,
        SubmoduleKind::Virtual | SubmoduleKind::Pluggable => 1,
    }
}

/// Adds attributes of an element within a submodule.
fn add(element: &str, others: Vec<(CompactString, CompactString)>, submodule: &mut Submodule) {
    let named = |(key, value): (CompactString, CompactString)| {
        let mut own = CompactString::from(element);
        own.push('@');
        own.push_str(&key);
        (own, value)
    };
    submodule.attributes.extend(others.into_iter().map(named));
}

impl Info<'_> {
    /// What ModuleInfo says of a submodule.
    fn of_submodule(self, submodule: &mut Submodule) {
        if !self.name.is_empty() {
            submodule.name = self.name;
        }
        submodule.documentation = self.documentation;
        submodule.identity.vendor_name =
            self.vendor.as_ref().map_or_else(Default::default, |given| given.text.as_ref().into());
        submodule.identity.order_code =
            self.order.as_ref().map_or_else(Default::default, |given| given.text.as_ref().into());
        attribute("HardwareRelease", self.hardware.as_ref(), &mut submodule.attributes);
        attribute("SoftwareRelease", self.software.as_ref(), &mut submodule.attributes);
        submodule.attributes.extend(self.attributes);
    }
}
