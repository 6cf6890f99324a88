//! The EtherCAT segment as a Rust module.

use std::fmt::Write as _;

use lexibus_codegen::ir::Direction;
use lexibus_codegen::names::{unique, Case, NameRequest};
use lexibus_codegen::number::{hex16, hex32, hex8};

use super::rust_text::{one_line, HEADER};
use crate::ethercat::{
    direction_name, Clock, ClockSignal, Fmmu, Identity, Segment, StartupCommand, SubDevice, SyncManager,
};

/// Names that the Rust module of a SubDevice must not have. The module of a SubDevice with such a name gets the position as a suffix.
const RESERVED: [&str; 1] = ["command"];

/// Returns a Rust module with the constants of each SubDevice: position, alias, identity, logical addresses, sync managers, FMMUs,
/// distributed clocks, and start-up commands.
pub fn segment_rust(segment: &Segment) -> String {
    let requests: Vec<NameRequest<'_>> =
        segment.subdevices.iter().map(|one| NameRequest::new(&one.name, "subdevice", one.position)).collect();
    let modules = unique(requests, &RESERVED, Case::Snake);
    let mut text = HEADER.to_owned();
    if segment.subdevices.iter().any(|one| !one.startup.is_empty()) {
        text += COMMAND;
    }
    for (subdevice, module) in segment.subdevices.iter().zip(&modules) {
        let _ = writeln!(text, "\n/// The SubDevice `{}`.\npub mod {module} {{", one_line(&subdevice.name));
        constants(&mut text, subdevice);
        text += "}\n";
    }
    text
}

const COMMAND: &str = "
/// Returns a start-up command.
const fn command(
    transition: ::lexibus::ethercat::Transition,
    index: u16,
    sub_index: u8,
    complete_access: bool,
    bytes: &'static [u8],
) -> ::lexibus::ethercat::StartupCommand {
    let data = ::lexibus::ethercat::StartupData::Bytes(bytes);
    ::lexibus::ethercat::StartupCommand {
        transition,
        object: ::lexibus::Object { index, sub_index },
        complete_access,
        data,
    }
}
";

fn constants(text: &mut String, subdevice: &SubDevice) {
    let mut constant = |about: &str, name: &str, ty: &str, value: &str| {
        let _ = writeln!(text, "    /// {about}\n    pub const {name}: {ty} = {value};");
    };
    constant("Position on the bus, counted from 0.", "POSITION", "u16", &subdevice.position.to_string());
    constant("Station alias; 0 = none.", "ALIAS", "u16", &subdevice.alias.to_string());
    let Identity { vendor_id, product_code, revision_number } = subdevice.identity;
    for (about, name, number) in [
        ("Expected vendor-ID, if known.", "VENDOR_ID", vendor_id),
        ("Expected product code, if known.", "PRODUCT_CODE", product_code),
        ("Expected revision number, if known.", "REVISION_NUMBER", revision_number),
    ] {
        let value = number.map_or("None".to_owned(), |number| format!("Some({})", hex32(number)));
        constant(about, name, "Option<u32>", &value);
    }
    for direction in [Direction::Receive, Direction::Transmit] {
        let name = direction_name(direction);
        let about = format!("Logical addresses of the {name}.");
        constant(&about, &name.to_uppercase(), "::core::ops::Range<u32>", &addresses(subdevice, direction));
    }
    let list = slice(subdevice.sync_managers.iter().map(sync_manager));
    let about = "Sync managers, sorted by number.";
    constant(about, "SYNC_MANAGERS", "&[::lexibus::ethercat::SyncManagerSettings]", &list);
    let list = slice(subdevice.fmmus.iter().map(fmmu));
    constant("FMMUs of the process data.", "FMMUS", "&[::lexibus::ethercat::FmmuSettings]", &list);
    let settings = subdevice.dc.as_ref().map_or("None".to_owned(), |settings| format!("Some({})", clock(settings)));
    let about = match &subdevice.dc {
        Some(settings) => format!("Distributed clocks in the mode `{}`.", one_line(&settings.mode)),
        None => "Distributed clocks; the description has no modes.".to_owned(),
    };
    constant(&about, "CLOCK", "Option<::lexibus::ethercat::ClockSettings>", &settings);
    let list = slice(subdevice.startup.iter().map(command));
    let about = "SDO downloads in their order, each with its state transition.";
    constant(about, "STARTUP", "&[::lexibus::ethercat::StartupCommand]", &list);
}

/// Returns a slice with one line for each element.
fn slice(elements: impl Iterator<Item = String>) -> String {
    let lines: String = elements.map(|element| format!("        {element},\n")).collect();
    if lines.is_empty() {
        "&[]".to_owned()
    } else {
        format!("&[\n{lines}    ]")
    }
}

fn sync_manager(manager: &SyncManager) -> String {
    let SyncManager { number, start_address, length, control, enable, op_only, .. } = manager;
    format!(
        "::lexibus::ethercat::SyncManagerSettings {{ number: {number}, start_address: {}, length: {length}, control: {}, \
         enable: {enable}, op_only: {op_only} }}",
        hex16(*start_address),
        hex8(*control)
    )
}

fn fmmu(fmmu: &Fmmu) -> String {
    let Fmmu { number, sync_manager, direction, logical_address, length, physical_address, op_only } = fmmu;
    let direction = match direction {
        Direction::Receive => "Output",
        Direction::Transmit => "Input",
    };
    format!(
        "::lexibus::ethercat::FmmuSettings {{ number: {number}, sync_manager: {sync_manager}, \
         direction: ::lexibus::ethercat::Direction::{direction}, logical_address: {logical_address}, length: {length}, \
         physical_address: {}, op_only: {op_only} }}",
        hex16(*physical_address)
    )
}

fn clock(clock: &Clock) -> String {
    let signal = |signal: ClockSignal| {
        let ClockSignal { cycle_time, shift_time, relative_to_inputs } = signal;
        format!(
            "::lexibus::ethercat::ClockSignal {{ cycle_time: {cycle_time}, shift_time: {shift_time}, \
             relative_to_inputs: {relative_to_inputs} }}"
        )
    };
    format!(
        "::lexibus::ethercat::ClockSettings {{ assign_activate: {}, sync0: {}, sync1: {} }}",
        hex32(clock.assign_activate),
        signal(clock.sync0),
        signal(clock.sync1)
    )
}

/// Returns the range of logical addresses of one direction. The addresses of a direction are contiguous.
fn addresses(subdevice: &SubDevice, direction: Direction) -> String {
    let fmmus = || subdevice.fmmus.iter().filter(|fmmu| fmmu.direction == direction);
    let start = fmmus().map(|fmmu| fmmu.logical_address).min().unwrap_or(0);
    let end = fmmus().map(|fmmu| fmmu.logical_address + u32::from(fmmu.length)).max().unwrap_or(0);
    format!("{start}..{end}")
}

fn command(command: &StartupCommand) -> String {
    let StartupCommand { transition, index, sub_index, complete_access, data } = command;
    let bytes: Vec<String> = data.iter().map(|byte| hex8(*byte)).collect();
    format!(
        "super::command(::lexibus::ethercat::Transition::{transition}, {}, {sub_index}, {complete_access}, &[{}])",
        hex16(*index),
        bytes.join(", ")
    )
}
