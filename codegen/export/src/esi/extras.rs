//! Writes timeouts and the extension attributes for which ETG.2000 has an element or attribute.

use std::collections::HashSet;

use super::text::hex;
use super::Context;
use crate::note::{NoteKind, Subject};
use crate::xml::Xml;
use lexibus_codegen::etg::language;
use lexibus_codegen::ir::{Device, EtherCatSettings, Extension};

/// Attributes of the Type element that the IR stores as extensions.
const OF_TYPE: [&str; 8] = [
    "Type@CheckProductCode",
    "Type@CheckRevisionNo",
    "Type@CheckSerialNo",
    "Type@TcSmClass",
    "Type@TcCfgModeSafeOp",
    "Type@ModulePdoGroup",
    "Type@DownloadModuleList",
    "Type@ShowHideableSubDevices",
];

/// Elements of a profile that contain a number.
const OF_PROFILE: [&str; 2] = ["AddInfo", "SubAddInfo"];

/// Timeouts of the state machine and of the mailbox. If the file contains one timeout of a list, the schema requires
/// all timeouts of this list.
const STATE_TIMES: [&str; 4] = ["PreopTimeout", "SafeopOpTimeout", "BackToInitTimeout", "BackToSafeopTimeout"];
const MAILBOX_TIMES: [&str; 2] = ["RequestTimeout", "ResponseTimeout"];

/// Elements that follow the timeouts in Info.
const CONTROLLER: [&str; 3] =
    ["EtherCATController/DpramSize", "EtherCATController/SmCount", "EtherCATController/FmmuCount"];
const ALIAS: [&str; 1] = ["Info/StationAliasSupported"];
const IMAGES: [&str; 2] = ["Image16x14", "ImageFile16x14"];
const URL: &str = "Device/URL";
const URL_LANGUAGE: &str = "Device/URL@LcId";
const VENDOR_URL: &str = "Vendor/URL";

fn find<'e>(list: &'e [Extension], key: &str) -> Option<&'e Extension> {
    list.iter().find(|extension| extension.key == key)
}

/// Returns the number of a device's extensions that the exported file cannot contain.
pub(super) fn lost(device: &Device) -> usize {
    let all = device.extensions.as_slice();
    let image = IMAGES.iter().find(|key| find(all, key).is_some());
    let (mut seen, mut lost) = (HashSet::new(), 0);
    for extension in all {
        let key = extension.key.as_str();
        let is_known = OF_TYPE.contains(&key) || CONTROLLER.contains(&key) || ALIAS.contains(&key);
        // The schema allows each known element and the picture at most once.
        let is_single = is_known || image.is_some_and(|image| *image == key);
        let is_written = matches!(key, URL | URL_LANGUAGE) || is_single && seen.insert(key);
        lost += usize::from(!is_written);
    }
    lost
}

/// Writes the attributes of Type except the identity.
pub(super) fn of_type(xml: &mut Xml, device: &Device) {
    let without_lrw = device.ethercat.as_ref().is_some_and(|settings| settings.without_lrw);
    xml.flag("UseLrdLwr", without_lrw, "true");
    for key in OF_TYPE {
        if let Some(extension) = find(&device.extensions, key) {
            xml.attribute(key.trim_start_matches("Type@"), &extension.value);
        }
    }
}

/// Writes the URLs of a device. In the IR, the language of a URL precedes the URL.
pub(super) fn urls(xml: &mut Xml, device: &Device) {
    let mut lcid = None;
    for extension in &device.extensions {
        match extension.key.as_str() {
            URL_LANGUAGE => lcid = Some(&extension.value),
            URL => {
                xml.open("URL");
                xml.optional("LcId", lcid.take());
                xml.content(&extension.value);
                xml.close();
            }
            _ => {}
        }
    }
}

/// Writes the Info element unless it is empty.
pub(super) fn info(xml: &mut Xml, context: &mut Context<'_>, device: &Device, settings: &EtherCatSettings) {
    let list = device.extensions.as_slice();
    let states = times(context, settings, &STATE_TIMES);
    let mailbox = times(context, settings, &MAILBOX_TIMES);
    let has_elements = CONTROLLER.iter().chain(&ALIAS).any(|key| find(list, key).is_some());
    let has_facts = settings.ebus_current.is_some()
        || settings.identification_register.is_some()
        || settings.identification_in_al_status
        || settings.safe_op_without_sync;
    if states.is_empty() && mailbox.is_empty() && !has_elements && !has_facts {
        return;
    }
    xml.open("Info");
    if let Some(current) = settings.ebus_current {
        xml.open("Electrical");
        xml.leaf("EBusCurrent", current);
        xml.close();
    }
    if !states.is_empty() || settings.safe_op_without_sync {
        xml.open("StateMachine");
        timeouts(xml, states);
        behavior(xml, settings);
        xml.close();
    }
    if !mailbox.is_empty() {
        xml.open("Mailbox");
        timeouts(xml, mailbox);
        xml.close();
    }
    if CONTROLLER.iter().any(|key| find(list, key).is_some()) {
        xml.open("EtherCATController");
        elements(xml, list, &CONTROLLER);
        xml.close();
    }
    elements(xml, list, &ALIAS);
    xml.optional_leaf("IdentificationAdo", settings.identification_register.map(|address| hex(address, 4)));
    xml.optional_leaf("IdentificationReg134", settings.identification_in_al_status.then_some("true"));
    xml.close();
}

fn timeouts(xml: &mut Xml, times: Vec<(&'static str, u32)>) {
    if !times.is_empty() {
        xml.open("Timeout");
        times.into_iter().for_each(|(name, limit)| xml.leaf(name, limit));
        xml.close();
    }
}

fn behavior(xml: &mut Xml, settings: &EtherCatSettings) {
    if settings.safe_op_without_sync {
        xml.open("Behavior");
        xml.attribute("StartToSafeopNoSync", "true");
        xml.close();
    }
}

fn elements(xml: &mut Xml, list: &[Extension], keys: &[&'static str]) {
    for key in keys {
        if let (Some(extension), Some((_, name))) = (find(list, key), key.split_once('/')) {
            xml.leaf(name, &extension.value);
        }
    }
}

/// Returns the timeouts with these names if all of them exist. Otherwise, adds a note for those that exist.
fn times(context: &mut Context<'_>, settings: &EtherCatSettings, names: &[&'static str]) -> Vec<(&'static str, u32)> {
    let limit = |name: &&'static str| {
        let found = settings.timeouts.iter().find(|(known, _)| known == *name);
        found.map(|(_, limit)| (*name, *limit))
    };
    let found: Vec<(&'static str, u32)> = names.iter().filter_map(limit).collect();
    if found.len() == names.len() {
        return found;
    }
    context.notes.add_many(NoteKind::Incomplete, found.len(), Subject::Named("Timeout"));
    Vec::new()
}

/// Writes the name of the picture file.
pub(super) fn image(xml: &mut Xml, device: &Device) {
    let first = IMAGES.iter().find_map(|key| Some((*key, find(&device.extensions, key)?)));
    if let Some((key, extension)) = first {
        xml.leaf(key, &extension.value);
    }
}

/// Returns whether an extension of a module can be written to the module's Profile element.
pub(super) fn is_of_profile(extension: &Extension) -> bool {
    OF_PROFILE.contains(&extension.key.as_str()) && extension.value.parse::<i32>().is_ok()
}

/// Writes the elements AddInfo and SubAddInfo of a profile. These elements contain numbers in addition to the profile
/// number.
pub(super) fn profile(xml: &mut Xml, list: &[Extension]) {
    for key in OF_PROFILE {
        if let Some(extension) = find(list, key).filter(|extension| is_of_profile(extension)) {
            xml.leaf(key, &extension.value);
        }
    }
}

/// Writes the vendor's name in the additional languages.
pub(super) fn vendor_names(xml: &mut Xml, context: &mut Context<'_>) {
    for name in &context.catalog.vendor_names {
        match language::lcid(&name.language) {
            Some(lcid) => {
                xml.open("Name");
                xml.attribute("LcId", lcid);
                xml.content(&name.text);
                xml.close();
            }
            None => context.notes.add(NoteKind::Language, Subject::Named("Vendor")),
        }
    }
}

/// Writes the vendor's URLs, which the IR stores as extensions. Adds a note for the other extensions and for the
/// descriptions of the catalog.
pub(super) fn of_vendor(xml: &mut Xml, context: &mut Context<'_>) {
    let urls = context.catalog.extensions.iter().filter(|extension| extension.key == VENDOR_URL);
    urls.for_each(|extension| xml.leaf("URL", &extension.value));
    let lost = context.catalog.extensions.iter().filter(|extension| extension.key != VENDOR_URL).count();
    let lost = lost + context.catalog.descriptions.len();
    context.notes.add_many(NoteKind::Extension, lost, Subject::Named("Vendor"));
}

/// Writes the version of a file that contains only diagnosis messages. Adds a note for the other extensions and for the
/// names of the vendor.
pub(super) fn diagnosis_version(xml: &mut Xml, context: &mut Context<'_>) {
    const VERSION: &str = "EtherCATDiag@Version";
    let all = context.catalog.extensions.as_slice();
    xml.optional("Version", find(all, VERSION).map(|extension| &extension.value));
    let lost = all.iter().filter(|extension| extension.key != VERSION).count() + context.catalog.vendor_names.len();
    context.notes.add_many(NoteKind::Extension, lost, Subject::Device);
}
