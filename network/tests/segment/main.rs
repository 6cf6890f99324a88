//! Tests for EtherCAT segments. They compare the start-up commands with those of the runtime, and the sync managers and the identity
//! with the SII image of the same device.

#[rustfmt::skip]
#[allow(dead_code)]
#[deny(missing_docs, clippy::all)]
mod generated;
#[path = "../support/settings.rs"]
mod settings;
#[path = "../support/mod.rs"]
mod support;

use lexibus::ethercat::{
    Assignment, ClockSettings, ClockSignal, Device, Module, SlotPlan, StartupCommand as Command, Transition,
};
use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::selection::Selection;
use lexibus_codegen::source::Source;
use lexibus_export::sii;
use lexibus_network::compile::Compilation;
use lexibus_network::ethercat::{Clock, Segment, StartupCommand, SubDevice};
use lexibus_network::output::{files, segment_rust};
use settings::{fmmu_settings, manager_settings};
use support::{compiled, messages, root, valid};

lexibus::dictionary! {
    /// A modular coupler and a drive.
    #[allow(deprecated)]
    pub mod io = "../tests/data/coupler.esi.xml";
}

lexibus::dictionary! {
    /// A device with slot groups.
    #[allow(deprecated)]
    pub mod groups = "../tests/data/gateway.esi.xml";
}

/// Compiles a network file in a folder that contains both device descriptions.
fn network(name: &str, text: &str) -> Compilation {
    let description = |file: &'static str| {
        (file, std::fs::read_to_string(root().join("tests/data").join(file)).expect("a description"))
    };
    let files = [description("coupler.esi.xml"), description("gateway.esi.xml"), ("network.toml", text.to_owned())];
    compiled(&format!("segment-{name}"), &files)
}

fn segment(compilation: &Compilation) -> &Segment {
    valid(compilation).segment.as_ref().expect("a segment")
}

/// Returns the diagnostics of a segment with one SubDevice.
fn faults(name: &str, keys: &str) -> Vec<String> {
    messages(&network(name, &format!("[segment]\ncycle = 1000\n[segment.subdevices.one]\n{keys}")))
}

const COUPLER: &str = "device = \"coupler.esi.xml\"\nmodel = \"CP-32\"\n";
const DRIVE: &str = "device = \"coupler.esi.xml\"\nmodel = \"SV-1\"\n";

/// Converts commands of the runtime to the type that the network compiler uses.
fn of_runtime(commands: impl Iterator<Item = Command>) -> Vec<StartupCommand> {
    let names = [(Transition::IP, "IP"), (Transition::PS, "PS")];
    let command = |command: Command| StartupCommand {
        transition: names.iter().find(|(transition, _)| *transition == command.transition).expect("IP or PS").1,
        index: command.object.index,
        sub_index: command.object.sub_index,
        complete_access: command.complete_access,
        data: command.data().to_vec(),
    };
    commands.map(command).collect()
}

#[test]
fn start_up_commands_of_a_drive_are_those_of_the_runtime() {
    let text = format!(
        "[segment]\ncycle = 1000\n[segment.subdevices.default]\n{DRIVE}\n\
         [segment.subdevices.velocity]\n{DRIVE}pdos = [\"0x1A01\", \"velocity mode\"]\n"
    );
    let compilation = network("drive", &text);
    let subdevices = &segment(&compilation).subdevices;
    let default = Assignment::<8>::by_default(&io::sv_1::DEVICE).unwrap();
    assert_eq!(subdevices[0].startup, of_runtime(default.startup()));
    let velocity = Assignment::<8>::new(&io::sv_1::DEVICE, &[0x1A01, 0x1601]).unwrap();
    assert_eq!(subdevices[1].startup, of_runtime(velocity.startup()));
    assert!(subdevices[1].startup.iter().any(|command| command.index == 0x1601), "the mapping is written");
    let lengths = |subdevice: &SubDevice| subdevice.sync_managers.iter().map(|one| one.length).collect::<Vec<_>>();
    assert_eq!(lengths(&subdevices[0]), [128, 128, default.bytes(2) as u16, default.bytes(3) as u16]);
    assert_eq!(lengths(&subdevices[1]), [128, 128, velocity.bytes(2) as u16, velocity.bytes(3) as u16]);
}

/// Asserts that a SubDevice has the commands and the process data of a slot plan.
fn assert_equal<const N: usize>(subdevice: &SubDevice, plan: &SlotPlan<N>) {
    assert_eq!(subdevice.startup, of_runtime(plan.startup()));
    for manager in [2, 3] {
        let pdos = subdevice.pdos.iter().filter(|pdo| pdo.sync_manager == manager);
        let placed: Vec<_> = pdos.map(|pdo| (pdo.slot, pdo.index, pdo.bit_offset, pdo.bits)).collect();
        let expected: Vec<_> = plan.pdos(manager).map(|pdo| (pdo.slot, pdo.index, pdo.bit, pdo.bits)).collect();
        assert_eq!(placed, expected);
        assert_eq!(usize::from(subdevice.sync_managers[usize::from(manager)].length), plan.bytes(manager));
    }
}

/// Returns a plan with modules in the given slots.
fn plan<const N: usize>(device: &'static Device, modules: &[(u16, &'static Module)]) -> SlotPlan<N> {
    let mut plan = SlotPlan::new(device).unwrap();
    modules.iter().for_each(|(slot, module)| plan.plug(*slot, module).unwrap());
    plan.check().unwrap();
    plan
}

#[test]
fn start_up_commands_of_a_coupler_are_those_of_the_runtime() {
    let modules = "modules = { 4 = \"DI-16\", 0 = \"16 digital inputs\", 1 = \"AI-2\", 2 = 0x2001 }\n";
    let compilation = network("coupler", &format!("[segment.subdevices.coupler]\n{COUPLER}{modules}"));
    let [inputs, analog] = [&io::modules::di_16::MODULE, &io::modules::ai_2::MODULE];
    let modules = [(0, inputs), (1, analog), (2, &io::modules::do_8::MODULE), (4, inputs)];
    assert_equal(&segment(&compilation).subdevices[0], &plan::<32>(&io::cp_32::DEVICE, &modules));
}

#[test]
fn start_up_commands_with_slot_groups_are_those_of_the_runtime() {
    let keys = "device = \"gateway.esi.xml\"\nmodel = \"GW-4\"\n\
                modules = { 0 = \"BIT-2\", 1 = \"BIT-4\", 2 = \"BIT-4\", 3 = \"BIT-2\" }\n";
    let compilation = network("groups", &format!("[segment.subdevices.gateway]\n{keys}"));
    let [two, four] = [&groups::modules::bit_2::MODULE, &groups::modules::bit_4::MODULE];
    let plan = plan::<4>(&groups::gw_4::DEVICE, &[(0, two), (1, four), (2, four), (3, two)]);
    assert_equal(&segment(&compilation).subdevices[0], &plan);
}

#[test]
fn parameters_follow_the_assignment() {
    let keys = "parameters = { \"Motor/Direction\" = \"Counter-clockwise\", \"0x2000:2\" = 250 }\n";
    let compilation =
        network("parameters", &format!("[segment]\ncycle = 1000\n[segment.subdevices.axis]\n{DRIVE}{keys}"));
    let commands = &segment(&compilation).subdevices[0].startup;
    let last: Vec<_> =
        commands.iter().rev().take(2).map(|one| (one.transition, one.sub_index, one.data.clone())).collect();
    assert_eq!(last, [("PS", 2, vec![250, 0]), ("PS", 1, vec![1])]);
}

/// Two modules of the same type have objects with the same names. A name in the table of a module refers to an object of this module.
#[test]
fn objects_of_modules_have_names() {
    let module = |slot: u8, object: &str, value: &str| {
        format!("{slot} = {{ module = \"AI-2\", parameters = {{ \"{object}\" = \"{value}\" }} }}")
    };
    let keys = |object: &str| {
        let modules = [module(2, object, "60 Hz"), module(1, "0x8010:1", "50 Hz")].join(", ");
        format!("{COUPLER}modules = {{ {modules} }}\n")
    };
    let compilation = network("names", &format!("[segment.subdevices.coupler]\n{}", keys("Settings/Filter")));
    let commands = &segment(&compilation).subdevices[0].startup;
    let last = commands[commands.len() - 2..].iter();
    let last: Vec<_> = last.map(|command| (command.index, command.sub_index, command.data.as_slice())).collect();
    assert_eq!(last, [(0x8010, 1, &[1][..]), (0x8020, 1, &[2][..])]);
    let of_subdevice =
        format!("{COUPLER}modules = {{ 1 = \"AI-2\" }}\nparameters = {{ \"Settings/Filter\" = \"60 Hz\" }}\n");
    let compilation = network("names", &format!("[segment.subdevices.one]\n{of_subdevice}"));
    let helps: Vec<_> = compilation.diagnostics.list().iter().filter_map(|found| found.help.clone()).collect();
    let table = "1 = { module = \"2 analogue inputs\", parameters = { \"Settings/Filter\" = … } }";
    assert_eq!(helps, [format!("move the value to the table of a module: `{table}`")]);
    assert_eq!(
        faults("names", &keys("Settings/Fitler")),
        ["NET010 `2 analogue inputs` has no object `Settings/Fitler`"]
    );
}

#[test]
fn objects_of_modules_have_the_address_in_their_slot() {
    let keys =
        |object: &str| format!("{COUPLER}modules = {{ 1 = \"AI-2\" }}\nparameters = {{ \"{object}\" = \"60 Hz\" }}\n");
    let compilation = network("slots", &format!("[segment.subdevices.coupler]\n{}", keys("0x8010:1")));
    let commands = &segment(&compilation).subdevices[0].startup;
    let last = commands.last().map(|command| (command.index, command.sub_index, command.data.as_slice()));
    assert_eq!(last, Some((0x8010, 1, &[2][..])));
    assert_eq!(faults("slots", &keys("0x8000:1")), ["NET010 `CP-32 coupler with 32 slots` has no object 0x8000"]);
    assert_eq!(
        faults("slots", &keys("0x8010:2")),
        ["NET010 object 0x8010 `Settings` of `2 analogue inputs` has no sub-index 2"]
    );
}

#[test]
fn logical_addresses_are_outputs_then_inputs() {
    let text = format!(
        "[segment]\ncycle = 500\n[segment.subdevices.axis1]\n{DRIVE}\n\
         [segment.subdevices.io]\n{COUPLER}modules = {{ 0 = \"DO-8\" }}\n\
         [segment.subdevices.axis2]\n{DRIVE}dc = \"SM\"\nalias = 7\n"
    );
    let compilation = network("addresses", &text);
    let segment = segment(&compilation);
    assert_eq!((segment.output_bytes, segment.input_bytes), (13, 15));
    let fmmus: Vec<_> = segment
        .subdevices
        .iter()
        .flat_map(|one| &one.fmmus)
        .map(|fmmu| (fmmu.number, fmmu.sync_manager, fmmu.logical_address, fmmu.length, fmmu.physical_address))
        .collect();
    let expected = [
        (0, 2, 0, 6, 0x1100),
        (1, 3, 13, 7, 0x1400),
        (0, 2, 6, 1, 0x1100),
        (1, 3, 20, 1, 0x1400),
        (0, 2, 7, 6, 0x1100),
        (1, 3, 21, 7, 0x1400),
    ];
    assert_eq!(fmmus, expected);
    let clocks: Vec<_> = segment.subdevices.iter().map(|one| one.dc.as_ref()).collect();
    let sync0 = clocks[0].map(|clock| (clock.assign_activate, clock.sync0.cycle_time, clock.sync0.shift_time));
    assert_eq!(sync0, Some((0x0300, 500_000, 250_000)));
    assert_eq!((clocks[1], clocks[2].map(|clock| clock.assign_activate)), (None, Some(0)));
    assert_eq!(segment.subdevices.iter().map(|one| one.alias).collect::<Vec<_>>(), [0, 0, 7]);
}

/// A virtual sync manager describes a memory area that has no sync manager in the slave controller, but has an FMMU.
#[test]
fn a_virtual_sync_manager_has_an_fmmu() {
    let text = std::fs::read_to_string(root().join("tests/data/coupler.esi.xml")).expect("a description");
    let inputs = "<Sm DefaultSize=\"7\"";
    assert_eq!(text.matches(inputs).count(), 1);
    let text = text.replace(inputs, "<Sm Virtual=\"1\" DefaultSize=\"7\"");
    let network = format!("[segment]\ncycle = 1000\n[segment.subdevices.axis]\n{DRIVE}");
    let compilation = compiled("segment-virtual", &[("coupler.esi.xml", text), ("network.toml", network)]);
    let segment = segment(&compilation);
    let axis = &segment.subdevices[0];
    assert_eq!(axis.sync_managers.iter().map(|one| one.number).collect::<Vec<_>>(), [0, 1, 2]);
    let fmmus = axis.fmmus.iter();
    let fmmus: Vec<_> = fmmus.map(|one| (one.number, one.sync_manager, one.length, one.physical_address)).collect();
    assert_eq!(fmmus, [(0, 2, 6, 0x1100), (1, 3, 7, 0x1400)]);
    assert_eq!((segment.output_bytes, segment.input_bytes), (6, 7));
}

/// Returns the start address, length, control register and enable bit of each sync manager in an SII image.
fn sii_sync_managers(image: &[u8]) -> Vec<(u16, u16, u8, bool)> {
    let word = |at: usize| u16::from_le_bytes([image[at], image[at + 1]]);
    let mut at = 0x80;
    while word(at) != 41 {
        assert_ne!(word(at), 0xFFFF, "the image has the category of sync managers");
        at += 4 + 2 * usize::from(word(at + 2));
    }
    let content = &image[at + 4..][..2 * usize::from(word(at + 2))];
    let manager = |bytes: &[u8]| {
        let word = |at: usize| u16::from_le_bytes([bytes[at], bytes[at + 1]]);
        (word(0), word(2), bytes[4], bytes[6] & 1 != 0)
    };
    content.chunks_exact(8).map(manager).collect()
}

#[test]
fn defaults_are_those_of_the_sii_image() {
    let compilation = network("sii", &format!("[segment]\ncycle = 1000\n[segment.subdevices.axis]\n{DRIVE}"));
    let axis = &segment(&compilation).subdevices[0];
    let source = Source::read(&root().join("tests/data/coupler.esi.xml")).expect("a description");
    let select = Selection { devices: vec!["SV-1".parse().expect("a filter")], ..Selection::default() };
    let described = check(source, &Options { select, ..Options::default() });
    let catalog = described.catalog.expect("a catalog");
    let image = sii::export(&catalog.devices[0], &sii::Options::default()).expect("an image").bytes;
    let number = |at: usize| Some(u32::from_le_bytes(image[at..at + 4].try_into().expect("four bytes")));
    let identity = axis.identity;
    assert_eq!(
        (identity.vendor_id, identity.product_code, identity.revision_number),
        (number(16), number(20), number(24))
    );
    let managers = axis.sync_managers.iter();
    let managers: Vec<_> = managers.map(|one| (one.start_address, one.length, one.control, one.enable)).collect();
    assert_eq!(managers, sii_sync_managers(&image));
}

#[test]
fn a_file_with_only_a_segment_has_only_its_output_files() {
    let compilation =
        network("json", &format!("[segment]\ncycle = 1000\n[segment.subdevices.axis]\n{DRIVE}alias = 3\n"));
    let files = files(valid(&compilation));
    assert_eq!(files.iter().map(|file| file.name.as_str()).collect::<Vec<_>>(), ["segment.json", "segment.rs"]);
    let json: serde_json::Value = serde_json::from_slice(&files[0].content).expect("JSON");
    let axis = &json["subdevices"][0];
    assert_eq!(
        (&axis["name"], &axis["alias"], &axis["identity"]["product_code"]),
        (&"axis".into(), &3.into(), &0x00A1_0002.into())
    );
    assert_eq!(axis["startup"][0]["data"], "08");
}

#[test]
fn a_file_can_have_nodes_and_a_segment() {
    let node = |name| std::fs::read_to_string(root().join("examples/network").join(name)).expect("a description");
    let coupler = std::fs::read_to_string(root().join("tests/data/coupler.esi.xml")).expect("a description");
    let text = format!(
        "[master]\nid = 127\n[nodes.axis]\nid = 1\ndevice = \"drive.eds\"\n[segment.subdevices.servo]\n{DRIVE}dc = \"SM\"\n"
    );
    let compilation = compiled(
        "segment-both",
        &[("drive.eds", node("drive.eds")), ("coupler.esi.xml", coupler), ("network.toml", text)],
    );
    let names: Vec<String> = files(valid(&compilation)).into_iter().map(|file| file.name).collect();
    for name in ["axis.dcf", "master.dcf", "network.dbc", "network.rs", "segment.json", "segment.rs"] {
        assert!(names.iter().any(|file| file == name), "{name} in {names:?}");
    }
}

#[test]
fn a_device_on_ethercat_has_no_node_id() {
    let found = faults("node-id", &format!("{DRIVE}parameters = {{ \"0x2000:2\" = \"$NODEID+1\" }}\n"));
    assert_eq!(found, ["NET012 object 0x2000:2 `Current limit`: a device on EtherCAT has no node-ID"]);
    let eds = faults("eds", "device = \"drive.eds\"\n");
    assert_eq!(eds, ["NET008 the file `drive.eds` is not found"]);
    assert_eq!(faults("none", ""), ["NET008 the SubDevice `one` has no device description"]);
}

#[test]
fn invalid_modules_are_reported() {
    let of = |modules: &str| faults("modules", &format!("{COUPLER}modules = {modules}\n"));
    assert_eq!(of("{ 0 = \"DI-61\" }"), ["NET025 `CP-32 coupler with 32 slots` has no module `DI-61`"]);
    assert_eq!(of("{ 32 = \"DI-16\" }"), ["NET025 `CP-32 coupler with 32 slots` has no slot 32"]);
    assert_eq!(of("{}"), ["NET025 slots 0 to 31 (`Terminals`) have 0 modules, but the minimum is 1"]);
    let long = "{ 0 = \"AI-2\", 1 = \"AI-2\", 2 = \"AI-2\" }";
    assert_eq!(of(long), ["NET027 sync manager 3 has 16 bytes of process data, but its maximum length is 12 bytes"]);
    let drive = faults("modules", &format!("{DRIVE}modules = {{ 0 = 1 }}\n"));
    assert_eq!(drive, ["NET025 `SV-1 servo drive` has no slot 0"]);
    assert_eq!(of("{ 1 = \"AI-2\", 01 = \"DO-8\" }"), ["NET025 slot 1 has several modules"]);
    assert_eq!(of("{ 0 = \"DI-16\", 1 = { parameters = {} } }"), ["NET004 the table of a module has no key `module`"]);
}

#[test]
fn a_misplaced_key_of_a_module_is_reported() {
    let compilation =
        network("misplaced", &format!("[segment.subdevices.one]\n{DRIVE}dc = \"SM\"\nmodule = \"DI-16\"\n"));
    let found = &compilation.diagnostics.list()[0];
    assert_eq!((found.code.id, found.message.as_str()), ("NET003", "the key `module` is in the wrong section"));
    assert_eq!(found.help.as_deref(), Some("move the key to the table of a module, or write `modules`"));
}

/// Padding before a group of modules is described in a mapping object, with at most 254 entries of at most 255 bits.
#[test]
fn padding_that_does_not_fit_into_a_pdo_is_reported() {
    let text = std::fs::read_to_string(root().join("tests/data/coupler.esi.xml")).expect("a description");
    let of = |alignment: u32| {
        let group = format!("</Slot><ModulePdoGroup Alignment=\"{alignment}\" RxPdo=\"#x1700\" TxPdo=\"#x1B00\"/>");
        let text = text.replacen("</Slot>", &group, 1);
        let network = format!("[segment.subdevices.one]\n{COUPLER}modules = {{ 0 = \"DI-16\" }}\n");
        messages(&compiled("segment-padding", &[("coupler.esi.xml", text), ("network.toml", network)]))
    };
    assert_eq!(of(4), Vec::<String>::new());
    let [padding, length] = &of(9000)[..] else { panic!("two messages") };
    assert_eq!(padding, "NET026 the padding of PDO 0x1B00 has 71992 bits, but the maximum is 64770");
    assert!(length.starts_with("NET027"), "{length}");
}

#[test]
fn invalid_assignments_are_reported() {
    let of = |pdos: &str| faults("pdos", &format!("{DRIVE}pdos = {pdos}\n"));
    assert_eq!(
        of("[\"0x1600\", \"0x1601\", \"0x1A01\"]"),
        ["NET026 RxPDO 0x1601 `Velocity mode` cannot be assigned together with RxPDO 0x1600 `Position mode`"]
    );
    assert_eq!(of("[\"0x1600\"]"), ["NET026 the mandatory TxPDO 0x1A01 `Position` is not assigned"]);
    assert_eq!(of("[\"Positon\"]"), ["NET026 `SV-1 servo drive` has no PDO `Positon`"]);
    assert_eq!(of("[\"0x1A01\", \"0x1A01\"]"), ["NET026 TxPDO 0x1A01 `Position` is assigned twice"]);
}

#[test]
fn the_cycle_time_is_required_if_a_clock_needs_it() {
    let of = |dc: &str| messages(&network("cycle", &format!("[segment.subdevices.axis]\n{DRIVE}{dc}")));
    assert_eq!(of(""), ["NET004 the mode `DC` of the distributed clocks needs the cycle time of the segment"]);
    assert_eq!(of("dc = \"SM\"\n"), Vec::<String>::new());
    assert_eq!(of("dc = \"DX\"\n"), ["NET028 `SV-1 servo drive` has no mode `DX` of the distributed clocks"]);
}

/// Compares the generated module with `generated.rs`, which is compiled with this test. If `LEXIBUS_BLESS` is set, first writes
/// `generated.rs`.
#[test]
fn the_rust_module_has_the_data_of_the_segment() {
    let text = format!(
        "[segment]\ncycle = 1000\n[segment.subdevices.terminals]\n{COUPLER}alias = 5\nmodules = {{ 0 = \"DO-8\", 2 = \"AI-2\" }}\n\
         [segment.subdevices.\"Axis 1\"]\n{DRIVE}\n[segment.subdevices.command]\n{DRIVE}pdos = [\"0x1A01\"]\n"
    );
    let compilation = network("rust", &text);
    let segment = segment(&compilation);
    let path = root().join("network/tests/segment/generated.rs");
    if std::env::var_os("LEXIBUS_BLESS").is_some() {
        std::fs::write(&path, segment_rust(segment)).expect("a file");
    }
    assert_eq!(segment_rust(segment), std::fs::read_to_string(&path).expect("the module"));
    let [terminals, axis, last] = &segment.subdevices[..] else { panic!("three SubDevices") };
    assert_eq!(of_runtime(generated::terminals::STARTUP.iter().copied()), terminals.startup);
    assert_eq!(of_runtime(generated::axis_1::STARTUP.iter().copied()), axis.startup);
    assert_eq!(of_runtime(generated::command_2::STARTUP.iter().copied()), last.startup);
    assert_eq!((generated::terminals::POSITION, generated::axis_1::POSITION, generated::terminals::ALIAS), (0, 1, 5));
    assert_eq!(generated::axis_1::PRODUCT_CODE, axis.identity.product_code);
    assert_eq!((generated::terminals::OUTPUTS, generated::axis_1::OUTPUTS), (0..1, 1..7));
    assert_eq!((generated::terminals::INPUTS, generated::axis_1::INPUTS), (7..13, 13..20));
    assert!(generated::command_2::OUTPUTS.is_empty());
    use generated::{axis_1, command_2, terminals as io};
    let modules = [
        (io::SYNC_MANAGERS, io::FMMUS, io::CLOCK, terminals),
        (axis_1::SYNC_MANAGERS, axis_1::FMMUS, axis_1::CLOCK, axis),
        (command_2::SYNC_MANAGERS, command_2::FMMUS, command_2::CLOCK, last),
    ];
    for (managers, fmmus, clock, subdevice) in modules {
        assert_eq!(managers, subdevice.sync_managers.iter().map(manager_settings).collect::<Vec<_>>());
        assert_eq!(fmmus, subdevice.fmmus.iter().map(fmmu_settings).collect::<Vec<_>>());
        assert_eq!(clock, subdevice.dc.as_ref().map(clock_settings));
    }
    assert_eq!(axis_1::CLOCK.map(|clock| (clock.assign_activate, clock.sync0.cycle_time)), Some((0x0300, 1_000_000)));
    assert_eq!(axis_1::FMMUS[0].bytes()[..6], [1, 0, 0, 0, 6, 0]);
}

fn clock_settings(clock: &Clock) -> ClockSettings {
    let signal = |signal: lexibus_network::ethercat::ClockSignal| ClockSignal {
        cycle_time: signal.cycle_time,
        shift_time: signal.shift_time,
        relative_to_inputs: signal.relative_to_inputs,
    };
    ClockSettings { assign_activate: clock.assign_activate, sync0: signal(clock.sync0), sync1: signal(clock.sync1) }
}
