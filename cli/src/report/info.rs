//! Summaries of descriptions as text.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use lexibus_codegen::number::{hex16, hex32};
use lexibus_codegen::text::printable;
use lexibus_export::json::{DeviceInfo, Info, ModuleContent, ModuleInfo, PdoInfo, SubmoduleInfo};

use crate::shell;

/// Returns a one-line summary of a file: `drive.eds: EDS, Demo Drive, 32 objects, 59 entries, 2 RPDOs, 2 TPDOs`.
pub(crate) fn summary_line(info: &Info) -> String {
    let mut parts = vec![info.format.unwrap_or("unknown format").to_uppercase()];
    match info.devices.as_slice() {
        [device] => {
            parts.push(device_title(device));
            match device.registers {
                Some(registers) if registers > 0 => parts.extend(counted(registers, "register")),
                _ => {
                    parts.extend(counted(device.objects, "object").into_iter().chain(counted(device.entries, "entry")))
                }
            }
            parts.extend(counted(device.rx_pdos.len(), "RPDO"));
            parts.extend(counted(device.tx_pdos.len(), "TPDO"));
        }
        devices => parts.extend(counted(devices.len(), "device")),
    }
    parts.extend(info.dictionary.and_then(|dictionary| counted(dictionary.objects, "object")));
    parts.extend(info.modules.as_ref().and_then(|modules| counted(modules.len(), "module")));
    parts.extend(info.submodules.as_ref().and_then(|submodules| counted(submodules.len(), "submodule")));
    format!("{}: {}", info.file, parts.join(", "))
}

/// Formats a count such as `2 entries`. Returns `None` if the count is 0.
fn counted(count: usize, noun: &str) -> Option<String> {
    match (count, noun.strip_suffix('y')) {
        (0, _) => None,
        (1, _) => Some(format!("1 {noun}")),
        (_, Some(stem)) => Some(format!("{count} {stem}ies")),
        _ => Some(format!("{count} {noun}s")),
    }
}

/// Returns the summary of a file for human readers.
pub(crate) fn info_text(info: &Info) -> String {
    let mut text = String::new();
    let _ =
        writeln!(text, "{} ({}, {})", printable(&info.file), info.format.unwrap_or("unknown format"), info.encoding);
    match info.devices.as_slice() {
        [device] => one_device(&mut text, device),
        [] => {}
        devices => {
            let _ = writeln!(text, "  vendor {}", vendors(devices));
            let title = ["--device", "order code", "revision", "product", "objects", "entries", "PDOs", "name"];
            columns(&mut text, title, devices.iter().map(device_row));
        }
    }
    if let Some(dictionary) = &info.dictionary {
        let _ = writeln!(text, "  a dictionary: {} objects, {} entries", dictionary.objects, dictionary.entries);
    }
    let modules = || info.modules.iter().flatten();
    if modules().next().is_some() {
        columns(&mut text, ["--module", "ident", "content", "name"], modules().map(module_row));
    }
    for submodule in info.submodules.iter().flatten() {
        let SubmoduleInfo { input_bytes, output_bytes, .. } = submodule;
        let (id, ident) = (printable(&submodule.id), hex32(submodule.ident));
        let _ = writeln!(text, "  submodule {id} ({ident}): {input_bytes} bytes in, {output_bytes} bytes out");
    }
    for (severity, counts) in [("errors", &info.errors), ("warnings", &info.warnings)] {
        let all: Vec<String> = counts.iter().map(|(code, count)| format!("{code} × {count}")).collect();
        if !all.is_empty() {
            let _ = writeln!(text, "  {severity}: {}", all.join(", "));
        }
    }
    text
}

/// Adds the facts of the only device of a file.
fn one_device(text: &mut String, device: &DeviceInfo) {
    let [vendor, product, revision] = [device.vendor_id, device.product_code, device.revision].map(number);
    let _ = writeln!(text, "  {}", printable(&device_title(device)));
    let _ = writeln!(text, "    vendor {vendor}, product {product}, revision {revision}");
    let registers = device.registers.map(|number| format!(", {number} registers")).unwrap_or_default();
    let _ = writeln!(text, "    {} objects, {} entries{registers}", device.objects, device.entries);
    for (direction, pdos) in [("RPDO", &device.rx_pdos), ("TPDO", &device.tx_pdos)] {
        let all: Vec<String> = pdos.iter().map(pdo_text).collect();
        if !all.is_empty() {
            let _ = writeln!(text, "    {direction}: {}", all.join(", "));
        }
    }
}

fn number(value: Option<u32>) -> String {
    value.map_or("unknown".to_owned(), hex32)
}

/// Returns the row of a device in the table of all devices.
fn device_row(device: &DeviceInfo) -> [String; 8] {
    [
        argument(device.argument.as_deref()),
        device.order_code.clone(),
        number(device.revision),
        number(device.product_code),
        device.objects.to_string(),
        device.entries.to_string(),
        (device.rx_pdos.len() + device.tx_pdos.len()).to_string(),
        device.name.clone(),
    ]
}

/// Returns the row of a module in the table of all modules.
fn module_row(module: &ModuleInfo) -> [String; 4] {
    [argument(module.argument.as_deref()), hex32(module.ident), module_text(module), module.name.clone()]
}

/// Returns an argument in the notation of a shell, or `-` if there is none.
fn argument(text: Option<&str>) -> String {
    text.map_or_else(|| "-".to_owned(), shell::argument)
}

/// Returns the different vendor IDs of the devices, separated by commas.
fn vendors(devices: &[DeviceInfo]) -> String {
    let ids: BTreeSet<Option<u32>> = devices.iter().map(|device| device.vendor_id).collect();
    ids.into_iter().map(number).collect::<Vec<_>>().join(", ")
}

/// Adds a table with aligned columns.
fn columns<const N: usize>(text: &mut String, title: [&str; N], rows: impl Iterator<Item = [String; N]>) {
    let rows = rows.map(|row| row.map(|cell| printable(&cell).into_owned()));
    let all: Vec<[String; N]> = std::iter::once(title.map(str::to_owned)).chain(rows).collect();
    let width = |column: usize| all.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
    let widths: [usize; N] = std::array::from_fn(width);
    for row in &all {
        let cells = row.iter().zip(widths).map(|(cell, width)| format!("{cell:width$}"));
        let _ = writeln!(text, "  {}", cells.collect::<Vec<_>>().join("  ").trim_end());
    }
}

/// Returns the order code and the name of a device. Leaves out the order code if the name contains it. Returns a
/// placeholder if both are empty.
fn device_title(device: &DeviceInfo) -> String {
    match (device.order_code.is_empty(), device.name.is_empty()) {
        (true, true) => "(no name)".to_owned(),
        (true, false) => device.name.clone(),
        (false, true) => device.order_code.clone(),
        (false, false) if device.name.contains(&device.order_code) => device.name.clone(),
        (false, false) => format!("{}: {}", device.order_code, device.name),
    }
}

fn module_text(module: &ModuleInfo) -> String {
    match &module.content {
        ModuleContent::Profinet { input_bytes, output_bytes, records, .. } => {
            format!("{input_bytes} bytes in, {output_bytes} bytes out, {} records", records.len())
        }
        ModuleContent::EtherCat { objects, entries, rx_pdos, tx_pdos } => {
            let pdos = rx_pdos.len() + tx_pdos.len();
            format!("{objects} objects, {entries} entries, {pdos} PDOs")
        }
    }
}

fn pdo_text(pdo: &PdoInfo) -> String {
    format!("{} ({} entries, {} bits)", hex16(pdo.index), pdo.entries, pdo.bits)
}
