//! Writes timeouts and the facts that only tools use.

use super::text::hex;
use crate::note::{NoteKind, Subject};
use crate::xml::Xml;
use lexibus_codegen::etg::language;
use lexibus_codegen::ir::{Catalog, CompactString, EtherCatSettings};

/// Timeouts of the state machine and of the mailbox. If the file contains one timeout of a list, the schema requires
/// all timeouts of this list.
const STATE_TIMES: [&str; 4] = ["PreopTimeout", "SafeopOpTimeout", "BackToInitTimeout", "BackToSafeopTimeout"];
const MAILBOX_TIMES: [&str; 2] = ["RequestTimeout", "ResponseTimeout"];

/// Attributes of the Dc element and of mailbox protocols that the IR stores unchanged.
const ATTRIBUTES: [(&str, &[&str]); 6] = [
    ("AoE", &["AdsRouter", "GenerateOwnNetId", "InitializeOwnNetId"]),
    ("EoE", &["IP", "MAC", "TimeStamp"]),
    ("CoE", &["EdsFile", "DS402Channels", "SdoUploadWithMaxLength", "TimeDistribution"]),
    ("Module/CoE", &["EdsFile", "ModuleOD"]),
    ("Dc", &["UnknownFRMW", "Unknown64Bit", "ExternalRefClock", "PotentialReferenceClock", "TimeLoopControlOnly"]),
    ("SoE", &["ChannelCount", "DriveFollowsBit3Support"]),
];

/// Writes the attributes of Type except the identity.
pub(super) fn of_type(xml: &mut Xml, settings: &EtherCatSettings) {
    xml.flag("UseLrdLwr", settings.without_lrw, "true");
    let Some(tool) = &settings.tool else { return };
    let attributes = [
        ("CheckProductCode", &tool.check_product_code),
        ("CheckRevisionNo", &tool.check_revision),
        ("CheckSerialNo", &tool.check_serial_number),
        ("TcSmClass", &tool.sync_manager_class),
        ("TcCfgModeSafeOp", &tool.safe_op_in_config_mode),
        ("ModulePdoGroup", &tool.module_pdo_group),
        ("DownloadModuleList", &tool.download_module_list),
        ("ShowHideableSubDevices", &tool.show_hideable_sub_devices),
    ];
    attributes.into_iter().for_each(|(name, text)| xml.text_attribute(name, text));
}

/// Writes the attributes that the schema defines for an element. Adds a note for each other attribute.
pub(super) fn attributes(xml: &mut Xml, element: &'static str, list: &[(CompactString, CompactString)]) {
    let known = ATTRIBUTES.iter().find(|(known, _)| *known == element).map_or(&[] as &[&str], |(_, names)| names);
    for (name, value) in list {
        match known.contains(&name.as_str()) {
            true => xml.attribute(name, value),
            false => xml.notes.add(NoteKind::Extension, Subject::Named(element)),
        }
    }
}

/// Writes the URLs of a device. English needs no language number.
pub(super) fn urls(xml: &mut Xml, settings: &EtherCatSettings) {
    for url in &settings.urls {
        xml.open("URL");
        xml.optional("LcId", language::lcid(&url.language).filter(|lcid| *lcid != language::ENGLISH));
        xml.content(&url.text);
        xml.close();
    }
}

/// Writes the Info element unless it is empty.
pub(super) fn info(xml: &mut Xml, settings: &EtherCatSettings) {
    let states = times(xml, settings, &STATE_TIMES);
    let mailbox = times(xml, settings, &MAILBOX_TIMES);
    let has_facts = settings.ebus_current.is_some()
        || settings.controller.is_some()
        || settings.station_alias.is_some()
        || settings.identification_register.is_some()
        || settings.identification_in_al_status
        || settings.safe_op_without_sync;
    if states.is_empty() && mailbox.is_empty() && !has_facts {
        return;
    }
    xml.open("Info");
    if let Some(current) = settings.ebus_current {
        xml.leaves("Electrical", &[("EBusCurrent", &current)]);
    }
    if !states.is_empty() || settings.safe_op_without_sync {
        xml.open("StateMachine");
        timeouts(xml, states);
        if settings.safe_op_without_sync {
            xml.empty("Behavior", &[("StartToSafeopNoSync", &true)]);
        }
        xml.close();
    }
    if !mailbox.is_empty() {
        xml.open("Mailbox");
        timeouts(xml, mailbox);
        xml.close();
    }
    if let Some(controller) = settings.controller {
        xml.open("EtherCATController");
        xml.optional_leaf("DpramSize", controller.memory_bytes);
        xml.optional_leaf("SmCount", controller.sync_managers);
        xml.optional_leaf("FmmuCount", controller.fmmus);
        xml.close();
    }
    xml.optional_leaf("StationAliasSupported", settings.station_alias);
    xml.optional_leaf("IdentificationAdo", settings.identification_register.map(|address| hex(address, 4)));
    xml.optional_leaf("IdentificationReg134", settings.identification_in_al_status.then_some("true"));
    xml.close();
}

fn timeouts(xml: &mut Xml, times: Vec<(&'static str, u32)>) {
    xml.list("Timeout", times, |xml, (name, limit)| xml.leaf(name, limit));
}

/// Returns the timeouts with these names if all of them exist. Otherwise, adds a note for those that exist, and returns
/// an empty list.
fn times(xml: &mut Xml, settings: &EtherCatSettings, names: &[&'static str]) -> Vec<(&'static str, u32)> {
    let limit = |name: &&'static str| {
        let found = settings.timeouts.iter().find(|(known, _)| known == *name);
        found.map(|(_, limit)| (*name, *limit))
    };
    let found: Vec<(&'static str, u32)> = names.iter().filter_map(limit).collect();
    if found.len() == names.len() {
        return found;
    }
    xml.notes.add_many(NoteKind::Incomplete, found.len(), Subject::Named("Timeout"));
    Vec::new()
}

/// Writes the vendor's URLs. Adds a note for the extensions and descriptions of the catalog.
pub(super) fn of_vendor(xml: &mut Xml, catalog: &Catalog) {
    catalog.vendor_urls.iter().for_each(|url| xml.leaf("URL", url));
    let lost = catalog.extensions.len() + catalog.descriptions.len();
    xml.notes.add_many(NoteKind::Extension, lost, Subject::Named("Vendor"));
}

/// Writes the version of a file that contains only diagnosis messages. Adds a note for the extensions, and for the names and URLs of
/// the vendor.
pub(super) fn diagnosis_version(xml: &mut Xml, catalog: &Catalog) {
    let Catalog { format_version, extensions, vendor_names, vendor_urls, .. } = catalog;
    xml.text_attribute("Version", format_version);
    let lost = extensions.len() + vendor_names.len() + vendor_urls.len();
    xml.notes.add_many(NoteKind::Extension, lost, Subject::Device);
}
