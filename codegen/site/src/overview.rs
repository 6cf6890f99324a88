//! The overview of a device on its first page.

use super::entry::{self, Doubt};
use super::slots::Slots;
use super::words::{self, PLAIN};
use lexibus_codegen::facts::device;
use lexibus_codegen::facts::profinet::{self, NamedFacts};
use lexibus_codegen::ir::{
    Catalog, Device, DistributedClocks, EtherCatSettings, Manual, ModbusTable, ProfinetSettings, RegisterSpace,
};
use lexibus_codegen::number::{hex16, hex32};

/// The data that a device's first page shows.
#[derive(Debug)]
pub(super) struct Overview {
    pub facts: Vec<String>,
    /// Description of the device in other languages.
    pub translations: Vec<(String, String)>,
    /// Properties from the identity, the buses, the manual and the source file, each with its name and value.
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
    identity.push(("Manual", title));
    if let Some(file) = catalog.files.first() {
        let name = lexibus_codegen::text::file_name(&file.name);
        identity.push(("Read from", format!("{name} ({}), SHA-256 {}", file.format.name(), file.sha256)));
    }
    identity.retain(|(_, value)| !value.is_empty());
    let models = device.variants.iter().map(|variant| Model {
        name: variant.name.to_string(),
        facts: PLAIN.description(variant.documentation.as_deref()).join(" "),
        constants: variant.constants.iter().map(|(name, value)| (name.to_string(), PLAIN.value(value))).collect(),
    });
    let translations = words::translations(&device.name, &[], device.documentation.as_deref());
    Overview {
        facts,
        translations,
        identity,
        access_point: profinet::access_point(catalog, device),
        models: models.collect(),
        doubts: entry::doubts_with_subjects(doubts(catalog, device), manual),
    }
}

/// Returns the ambiguities that the first page shows: those of the device and its definitions, those of machine constants, and
/// those of chapters and process images without items.
fn doubts<'d>(
    catalog: &'d Catalog,
    device: &'d Device,
) -> impl Iterator<Item = (&'d str, &'d lexibus_codegen::ir::Doubt)> {
    let given = device.given.iter().flat_map(|given| &given.doubts);
    let empty = device.groups.iter().filter(|group| group.index().is_none() && group.items.is_empty());
    let others = given.chain(empty.flat_map(|group| &group.doubts));
    lexibus_codegen::facts::doubts::of_device(catalog, device).into_iter().chain(others.map(|doubt| ("", doubt)))
}

fn identity(device: &Device) -> Vec<(&'static str, String)> {
    let identity = &device.identity;
    let hex = |number: Option<u32>| number.map(hex32).unwrap_or_default();
    let origins = PLAIN.identity_origins(identity).join(" ");
    vec![
        ("Vendor", identity.vendor_name.to_string()),
        ("Product", identity.product_name.to_string()),
        ("Order code", identity.order_code.to_string()),
        ("Vendor-ID", hex(identity.vendor_id)),
        ("Product code", hex(identity.product_code)),
        ("Revision", hex(identity.revision_number)),
        ("Origin", origins),
    ]
}

/// Returns the names and values of the device's bus settings. One row lists all buses. The values of buses
/// without settings are empty.
fn settings(device: &Device) -> Vec<(&'static str, String)> {
    let rates = device.canopen.iter().flat_map(|settings| &settings.bit_rates);
    let rates: Vec<String> = rates.map(u16::to_string).collect();
    let tables: Vec<String> = device.modbus.iter().map(|table| modbus(table, device.modbus.len() > 1)).collect();
    let profiles: Vec<String> = device.profiles.iter().map(u32::to_string).collect();
    vec![
        ("Buses", device::buses(device)),
        ("Bit rates", if rates.is_empty() { String::new() } else { format!("{} kbit/s", rates.join(", ")) }),
        ("EtherCAT", device.ethercat.as_deref().map(ethercat).unwrap_or_default()),
        ("PROFINET", device.profinet.as_deref().map(profinet_identity).unwrap_or_default()),
        ("Modbus", tables.join(". ")),
        (addresses(device), device.node_ids.map(|(first, last)| format!("{first} to {last}")).unwrap_or_default()),
        ("Profiles", profiles.join(", ")),
    ]
}

/// Returns the term for a node address on the device's buses.
fn addresses(device: &Device) -> &'static str {
    match (device.canopen.is_some(), device.modbus.is_empty()) {
        (true, true) => "Node-IDs",
        (true, false) => "Node-IDs and slave addresses",
        (false, _) => "Slave addresses",
    }
}

/// Returns the functions and the maximum request lengths of a Modbus table, with the name of the table if there are
/// several.
fn modbus(table: &ModbusTable, is_one_of_several: bool) -> String {
    let functions: Vec<String> = table.functions.iter().map(u8::to_string).collect();
    let space = if is_one_of_several { format!("{}: ", table.space.title()) } else { String::new() };
    let elements = match table.space {
        RegisterSpace::Coil => "coils",
        RegisterSpace::DiscreteInput => "discrete inputs",
        RegisterSpace::Holding | RegisterSpace::Input => "registers",
    };
    let most = [("reads", table.max_read), ("writes", table.max_write)];
    let most = most.into_iter().filter_map(|(what, most)| Some(format!("{what} up to {} {}", most?, elements)));
    let facts: Vec<String> = std::iter::once(format!("functions {}", functions.join(", "))).chain(most).collect();
    space + &facts.join("; ")
}

/// Returns the protocols of the mailbox, the modes of the distributed clocks and the maximum number of slots.
fn ethercat(settings: &EtherCatSettings) -> String {
    let mailbox = settings.mailbox.as_ref().map(|mailbox| {
        let protocols = [
            ("CoE", mailbox.coe.is_some()),
            ("FoE", mailbox.foe.is_some()),
            ("EoE", mailbox.eoe.is_some()),
            ("SoE", mailbox.soe.is_some()),
            ("AoE", mailbox.aoe.is_some()),
            ("VoE", mailbox.voe.is_some()),
        ];
        let protocols: Vec<&str> = protocols.into_iter().filter(|(_, has)| *has).map(|(name, _)| name).collect();
        match protocols.is_empty() {
            true => "mailbox".to_owned(),
            false => format!("mailbox with {}", protocols.join(", ")),
        }
    });
    let most = settings.slots.as_deref().and_then(|rules| rules.max_slots).map(|most| format!("up to {most} slots"));
    let facts = mailbox.into_iter().chain(settings.clocks.as_deref().map(clocks)).chain(most);
    facts.collect::<Vec<_>>().join("; ")
}

fn clocks(clocks: &DistributedClocks) -> String {
    let modes: Vec<&str> = clocks.modes.iter().map(|mode| mode.name.as_str()).collect();
    format!("distributed clocks ({})", modes.join(", "))
}

fn profinet_identity(settings: &ProfinetSettings) -> String {
    let mut facts = vec![format!("device {}, module {}", hex16(settings.device_id), hex32(settings.ident))];
    facts.extend((!settings.dns_name.is_empty()).then(|| format!("name {}", settings.dns_name)));
    facts.join("; ")
}
