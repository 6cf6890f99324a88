//! The overview of a device on its first page.

use super::entry::{self, Doubt};
use super::slots::Slots;
use super::words::{self, PLAIN};
use lexibus_codegen::facts::number::{hex16, hex32};
use lexibus_codegen::facts::profinet::{self, NamedFacts};
use lexibus_codegen::ir::{Catalog, Device, DistributedClocks, EtherCatSettings, Manual, ProfinetSettings};

/// The content of a device's first page.
#[derive(Debug)]
pub(super) struct Overview {
    pub facts: Vec<String>,
    /// Description of the device in other languages.
    pub translations: Vec<(String, String)>,
    /// Names and values of properties of the identity, the buses and the source file.
    pub identity: Vec<(&'static str, String)>,
    /// Names and values of facts about a device access point.
    pub access_point: NamedFacts,
    /// Models of the device with their constants.
    pub models: Vec<Model>,
    pub doubts: Vec<Doubt>,
}

/// The table of contents of a device.
#[derive(Debug)]
pub(super) struct Contents {
    /// File name, title and number of items of each area.
    pub areas: Vec<(String, String, usize)>,
    /// Links to the cyclic data, with their titles.
    pub frames: Vec<(String, String)>,
    pub slots: Slots,
}

/// A model of a device family, as a page shows it.
#[derive(Debug)]
pub(super) struct Model {
    pub name: String,
    pub facts: String,
    pub constants: Vec<(String, String)>,
}

pub(super) fn overview(catalog: &Catalog, device: &Device, manual: &Manual) -> Overview {
    let mut facts = PLAIN.description(device.documentation.as_deref());
    facts.extend(PLAIN.manual_entry(manual, "", device.documentation.as_deref(), &device.names));
    let mut identity = identity(device);
    identity.extend(settings(device));
    let title = [manual.title.as_str(), manual.edition.as_str()].into_iter().filter(|text| !text.is_empty());
    let title = title.collect::<Vec<_>>().join(", ");
    identity.extend((!title.is_empty()).then_some(("Manual", title)));
    if let Some(file) = catalog.files.first() {
        let name = file.name.rsplit(['/', '\\']).next().unwrap_or_default();
        identity.push(("Read from", format!("{name} ({}), SHA-256 {}", file.format.name(), file.sha256)));
    }
    let models = device.variants.iter().map(|variant| Model {
        name: variant.name.to_string(),
        facts: PLAIN.description(variant.documentation.as_deref()).join(" "),
        constants: variant.constants.iter().map(|(name, value)| (name.to_string(), PLAIN.value(value))).collect(),
    });
    let translations = words::translations(device.documentation.as_deref());
    Overview {
        facts,
        translations,
        identity,
        access_point: profinet::access_point(catalog, device),
        models: models.collect(),
        doubts: entry::doubts(doubts(device), manual),
    }
}

/// Returns the ambiguities that no other page shows: ambiguities of the device, of machine constants and of empty
/// chapters.
fn doubts(device: &Device) -> impl Iterator<Item = &lexibus_codegen::ir::Doubt> {
    let given = device.given.iter().flat_map(|given| &given.doubts);
    let empty = device.groups.iter().filter(|group| group.index().is_none() && group.items.is_empty());
    device.doubts.iter().chain(given).chain(empty.flat_map(|group| &group.doubts))
}

fn identity(device: &Device) -> Vec<(&'static str, String)> {
    let identity = &device.identity;
    let hex = |number: Option<u32>| number.map(hex32).unwrap_or_default();
    let all = [
        ("Vendor", identity.vendor_name.to_string()),
        ("Product", identity.product_name.to_string()),
        ("Order code", identity.order_code.to_string()),
        ("Vendor-ID", hex(identity.vendor_id)),
        ("Product code", hex(identity.product_code)),
        ("Revision", hex(identity.revision_number)),
    ];
    all.into_iter().filter(|(_, value)| !value.is_empty()).collect()
}

/// Returns the names and values of the device's bus settings.
fn settings(device: &Device) -> Vec<(&'static str, String)> {
    let mut all = Vec::new();
    if let Some(settings) = &device.canopen {
        let rates: Vec<String> = settings.bit_rates.iter().map(|rate| format!("{rate} kbit/s")).collect();
        all.push(("CANopen", if rates.is_empty() { "yes".to_owned() } else { rates.join(", ") }));
    }
    all.extend(device.ethercat.as_deref().map(|settings| ("EtherCAT", ethercat(settings))));
    all.extend(device.profinet.as_deref().map(|settings| ("PROFINET", profinet_identity(settings))));
    for table in &device.modbus {
        let functions: Vec<String> = table.functions.iter().map(u8::to_string).collect();
        let most = [("reads", table.max_read), ("writes", table.max_write)];
        let most = most.into_iter().filter_map(|(what, most)| Some(format!("{what} up to {}", most?)));
        let facts: Vec<String> = std::iter::once(format!("functions {}", functions.join(", "))).chain(most).collect();
        all.push(("Modbus", facts.join("; ")));
    }
    all.extend(device.node_ids.map(|(first, last)| ("Numbers of nodes", format!("{first} to {last}"))));
    let profiles: Vec<String> = device.profiles.iter().map(u32::to_string).collect();
    all.extend((!profiles.is_empty()).then(|| ("Profiles", profiles.join(", "))));
    all
}

fn ethercat(settings: &EtherCatSettings) -> String {
    let mut facts = Vec::new();
    if let Some(mailbox) = &settings.mailbox {
        let protocols = [
            ("CoE", mailbox.coe.is_some()),
            ("FoE", mailbox.foe.is_some()),
            ("EoE", mailbox.eoe.is_some()),
            ("SoE", mailbox.soe.is_some()),
            ("AoE", mailbox.aoe.is_some()),
            ("VoE", mailbox.voe.is_some()),
        ];
        let protocols: Vec<&str> = protocols.into_iter().filter(|(_, has)| *has).map(|(name, _)| name).collect();
        facts.push(match protocols.is_empty() {
            true => "mailbox".to_owned(),
            false => format!("mailbox with {}", protocols.join(", ")),
        });
    }
    facts.extend(settings.clocks.as_deref().map(clocks));
    let most = settings.slots.as_deref().and_then(|rules| rules.max_slots);
    facts.extend(most.map(|most| format!("up to {most} slots")));
    if facts.is_empty() {
        "yes".to_owned()
    } else {
        facts.join("; ")
    }
}

fn clocks(clocks: &DistributedClocks) -> String {
    let modes: Vec<&str> = clocks.modes.iter().map(|mode| mode.name.as_str()).collect();
    format!("distributed clocks ({})", modes.join(", "))
}

fn profinet_identity(settings: &ProfinetSettings) -> String {
    let mut facts = vec![format!("device {}, module {}", hex16(settings.device_id), hex32(settings.ident))];
    if !settings.dns_name.is_empty() {
        facts.push(format!("name {}", settings.dns_name));
    }
    facts.join("; ")
}
