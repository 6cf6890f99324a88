//! The constant with the configured values of a DCF, XDC or network file.

use super::code::{call, list, Doc};
use super::literal;
use super::options::RustOptions;
use crate::facts::configuration::{Configuration, LeftOut, Setting};
use crate::ir::Device;
use crate::number::{self, hex16, hex8};

/// Maximum number of addresses that the documentation lists for each reason why objects are left out.
const SHOWN: usize = 12;

/// The constant, ready to be printed.
pub(super) struct ConfigurationModel {
    pub docs: Vec<String>,
    /// Phases of the configuration: the name and the settings of each phase. Phases without settings are left out.
    pub phases: Vec<(&'static str, Vec<Doc>)>,
}

/// Returns the model of the constant, or `None` if no value is configured.
pub(super) fn model(device: &Device, options: &RustOptions) -> Option<ConfigurationModel> {
    match &options.configuration {
        Some(settings) => of_network(settings),
        None => of_description(device),
    }
}

fn of_network(settings: &[Setting]) -> Option<ConfigurationModel> {
    let docs = vec!["Values of the network file, in the order of the concise DCF.".to_owned()];
    let phases = vec![("network", settings.iter().map(setting).collect())];
    (!settings.is_empty()).then_some(ConfigurationModel { docs, phases })
}

fn of_description(device: &Device) -> Option<ConfigurationModel> {
    let configuration = Configuration::of(device)?;
    let mut docs = vec!["Values that the file configures, in the order in which the device accepts them.".to_owned()];
    docs.extend(left_out(&configuration.left_out));
    let all = [
        ("disable_pdos", configuration.disable_pdos),
        ("communication", configuration.communication),
        ("parameters", configuration.parameters),
        ("mapping", configuration.mapping),
        ("pdo_parameters", configuration.pdo_parameters),
        ("enable_pdos", configuration.enable_pdos),
    ];
    let phases = all.into_iter().filter(|(_, settings)| !settings.is_empty());
    let phases = phases.map(|(name, settings)| (name, settings.iter().map(setting).collect())).collect();
    Some(ConfigurationModel { docs, phases })
}

/// Returns a paragraph for each reason why configured objects are left out.
fn left_out(list: &[((u16, u8), LeftOut)]) -> Vec<String> {
    let of_reason = |group: &[((u16, u8), LeftOut)]| {
        let addresses = group.iter().take(SHOWN).map(|((index, sub_index), _)| number::object(*index, *sub_index));
        let more = group.len().saturating_sub(SHOWN);
        let more = (more > 0).then(|| format!("{more} more"));
        let addresses: Vec<String> = addresses.chain(more).collect();
        let reason = group.first().map_or("", |(_, reason)| reason.text());
        [String::new(), format!("Left out: {reason} ({}).", addresses.join(", "))]
    };
    list.chunk_by(|(_, one), (_, other)| one == other).flat_map(of_reason).collect()
}

/// Returns the constructor call of a setting.
fn setting(setting: &Setting) -> Doc {
    let constructor = match (setting.adds_node_id, setting.is_default) {
        (false, false) => "rt::Setting::fixed",
        (false, true) => "rt::Setting::fixed_default",
        (true, false) => "rt::Setting::from_node",
        (true, true) => "rt::Setting::from_node_default",
    };
    let call = call!(constructor, write(setting));
    match setting.is_write_only {
        false => call,
        true => call!("rt::Setting::write_only", call),
    }
}

/// Returns the constructor call of a write.
fn write(setting: &Setting) -> Doc {
    let (index, sub_index) = setting.object;
    let (name, value) = match *setting.bytes.as_slice() {
        [a] => ("u8", hex8(a)),
        [a, b] => ("u16", hex16(u16::from_le_bytes([a, b]))),
        [a, b, c, d] => ("u32", literal::word(u32::from_le_bytes([a, b, c, d]))),
        // A value of more than 8 bytes is not a number, so print it as text if possible.
        ref text if text.len() > 8 => ("bytes", literal::text_bytes(text)),
        ref bytes => ("bytes", literal::bytes(bytes)),
    };
    let arguments = [hex16(index), hex8(sub_index), value];
    list(&format!("rt::SdoWrite::new_{name}("), arguments, ")")
}
