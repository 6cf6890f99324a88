//! Tests for the output files of the example network, and of other networks with the same devices.

mod support;

use std::path::Path;

use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::diagnostics::Levels;
use lexibus_codegen::ir::{Catalog, Value};
use lexibus_codegen::source::Source;
use lexibus_network::check::bus_load;
use lexibus_network::compile::{compile, Compilation};
use lexibus_network::output::{dbc, dcf, files, master_dcf, master_writes};
use support::{compiled, entries, example_file, root, valid};

fn example() -> Compilation {
    let path = root().join("examples/network/network.toml");
    let compilation = compile(Source::read(&path).expect("the example"), Levels::lenient());
    assert_eq!(compilation.diagnostics.list().len(), 0, "{:?}", compilation.diagnostics.list());
    compilation
}

/// Reads an exported file, and returns its catalog. Panics if the file has diagnostics.
fn read(name: &str, text: String) -> Catalog {
    let compilation = check(Source::new(name, text.into_bytes()), &Options::default());
    let messages: Vec<String> =
        compilation.diagnostics.list().iter().map(|found| compilation.one_line(found)).collect();
    assert_eq!(messages, Vec::<String>::new());
    compilation.catalog.expect("a catalog")
}

#[test]
fn a_concise_dcf_contains_the_values_in_order() {
    let compilation = example();
    let files = files(compilation.usable().expect("a network"));
    let file = |name: &str| files.iter().find(|file| file.name == name).expect("a file").content.clone();
    let valves = entries(&file("valves.bin"));
    assert_eq!(
        valves,
        [(0x1017, 0, vec![0xF4, 0x01]), (0x2100, 0, vec![0x8A, 0x02])],
        "500 ms, and 6.5 bar is raw 650"
    );
    let addresses: Vec<(u16, u8)> =
        entries(&file("axis2.bin")).into_iter().map(|(index, sub_index, _)| (index, sub_index)).collect();
    let pdo = [(0x1601, 0), (0x1601, 1), (0x1601, 0), (0x1401, 1)];
    assert_eq!(addresses, [&[(0x1017, 0), (0x1401, 1)], &pdo[..]].concat(), "disable, clear, map, count, enable");
    let axis1 = entries(&file("axis1.bin"));
    assert_eq!(axis1[0], (0x1016, 1, vec![0x2C, 0x01, 127, 0]), "three times the heartbeat of the master");
    assert_eq!(axis1.last(), Some(&(0x60C2, 1, vec![10])));
}

#[test]
fn the_dcf_of_a_node_contains_its_values() {
    let compilation = example();
    let network = compilation.usable().expect("a network");
    let node = network.nodes.iter().find(|node| node.name.value == "axis1").expect("a node");
    let catalog = read("axis1.dcf", dcf(network, node).expect("a DCF"));
    let device = &catalog.devices[0];
    let commissioning = device.commissioning.as_ref().expect("network settings");
    assert_eq!((commissioning.node_id, commissioning.bit_rate), (Some(1), Some(500)));
    let configured =
        |index, sub_index| device.entry(index, sub_index).and_then(|item| item.configured_value().cloned());
    assert_eq!(configured(0x6081, 0), Some(Value::Int(3000)));
    assert_eq!(configured(0x6060, 0), Some(Value::Int(3)), "the name of a value");
    assert_eq!(configured(0x1801, 1), Some(Value::Int(0x281)));
    assert_eq!(configured(0x1801, 3), Some(Value::Int(100)));
    assert_eq!(configured(0x6083, 0), None);
}

#[test]
fn the_master_knows_all_nodes() {
    let compilation = example();
    let network = compilation.usable().expect("a network");
    let catalog = read("master.dcf", master_dcf(network).expect("a DCF"));
    let device = &catalog.devices[0];
    let value = |index, sub_index| device.entry(index, sub_index).and_then(|item| item.initial()?.as_int());
    assert_eq!(value(0x1016, 1), Some(20 << 16 | 1500));
    assert_eq!(value(0x1F80, 0), Some(1));
    assert_eq!(value(0x1F81, 1), Some(0x30D), "boot, mandatory, retry factor 3");
    assert_eq!(value(0x1F81, 2), Some(0x305));
    assert_eq!(value(0x1F81, 3), None);
    assert_eq!(value(0x1F86, 20), Some(0x4023));
    let file = device.entry(0x1F22, 1).and_then(|item| item.configured.as_ref()?.upload_file.clone());
    assert_eq!(file.as_deref(), Some("axis1.bin"));
    let writes = master_writes(network);
    assert!(writes.contains(&((0x1F87, 1), 0x0001_0000)), "{writes:?}");
    // RPDO 2 of the second axis receives TPDO 2 of the first axis, so the master does not send this RPDO.
    let rpdos = network.nodes.iter().flat_map(|node| &node.pdos).filter(|pdo| pdo.is_enabled && pdo.cob_id == 0x281);
    assert_eq!(rpdos.count(), 2);
    let sent = (0..3).filter_map(|number| value(0x1800 + number, 1)).collect::<Vec<_>>();
    assert_eq!(sent, [0x214, 0x201, 0x202]);
    assert_eq!(value(0x1803, 1), None);
}

#[test]
fn the_bus_load_is_that_of_all_cyclic_frames() {
    let compilation = example();
    let load = bus_load(compilation.usable().expect("a network"));
    // Every 10 ms: SYNC, two PDOs with 6 bytes, and one PDO with 4 bytes. Every 100 ms: three heartbeats. Every 500 ms: one heartbeat.
    let expected = 100.0 * f64::from(55 + 2 * 115 + 95) + (3.0 * 10.0 + 2.0) * 65.0;
    assert!((load.bits_per_second() - expected).abs() < 1e-6, "{}", load.bits_per_second());
    assert_eq!(load.unbounded.len(), 5);
}

#[test]
fn a_dbc_lists_each_receiver_once() {
    let text = "[master]\nid = 127\n\n[nodes.axis1]\nid = 1\ndevice = \"drive.eds\"\n\
                tpdo = { 1 = { map = [\"Statusword\"] }, 2 = { enabled = false } }\n\n[nodes.axis2]\nid = 2\n\
                device = \"drive.eds\"\ntpdo = { 1 = { enabled = false }, 2 = { enabled = false } }\n\
                rpdo = { 1 = { cob_id = \"axis1.tpdo1\", map = [\"Controlword\"] }, \
                2 = { cob_id = \"axis1.tpdo1\", map = [\"Controlword\"] } }\n";
    let files = [("drive.eds", example_file("drive.eds")), ("network.toml", text.to_owned())];
    let bytes = dbc(valid(&compiled("dbc-receivers", &files)));
    let text = String::from_utf8(bytes).expect("ASCII");
    let message = text.split("BO_ ").find(|message| message.contains("axis1_TPDO1")).expect("a message");
    assert!(message.contains("\"\" axis2,master\n"), "{message}");
}

#[test]
fn a_cpj_writes_the_values_of_its_dcf() {
    let drive = example_file("drive.eds");
    let of = "[6081]\r\nParameterName=Profile velocity\r\n";
    assert!(drive.contains(of));
    let configured = drive.replace(of, &format!("{of}ParameterValue=1234\r\n"));
    let project = "[Topology]\nNetName=Line\nNodes=0x01\nNode3Present=0x01\nNode3Name=axis\nNode3DCFName=axis.dcf\nEDSBaseName=eds\n";
    let compilation = compiled("cpj", &[("eds/axis.dcf", configured), ("line.cpj", project.to_owned())]);
    let network = compilation.usable().expect("a network");
    assert_eq!((network.name.as_str(), network.nodes[0].id), ("Line", 3));
    let files = files(network);
    let bin = files.iter().find(|file| file.name == "axis.bin").expect("a concise DCF");
    assert_eq!(entries(&bin.content), [(0x6081, 0, vec![0xD2, 0x04, 0, 0])]);
    assert!(files.iter().all(|file| file.name != "master.dcf"), "a .cpj has no master");
}

#[test]
fn a_node_can_have_the_name_master_if_the_network_has_no_master() {
    let project = "[Topology]\nNodes=0x01\nNode3Present=0x01\nNode3Name=master\nNode3DCFName=drive.eds\n";
    let files_of = [("drive.eds", example_file("drive.eds")), ("line.cpj", project.to_owned())];
    let compilation = compiled("cpj-master", &files_of);
    let names: Vec<String> = files(valid(&compilation)).into_iter().map(|file| file.name).collect();
    assert_eq!(names.iter().filter(|name| *name == "master.dcf").count(), 1, "{names:?}");
}

#[test]
fn damaged_files_cause_no_panic() {
    let drive = example_file("drive.eds");
    let io = example_file("io.eds");
    let toml = example_file("network.toml");
    let yaml =
        "options: {dcf_path: \".\"}\nmaster: {node_id: 127, sync_period: 1000}\ndefaults: &d\n  dcf: drive.eds\n\
                nodes:\n  a:\n    <<: *d\n    node_id: 1\n    sdo: [{index: 0x6081, value: 5}]\n    tpdo:\n      1: \
                {cob_id: auto, mapping: [{index: 0x6041, sub_index: 0}]}\n";
    compiled("damaged", &[("drive.eds", drive), ("io.eds", io)]);
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("damaged");
    let mut state = 30u64;
    let mut random = |end: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % end
    };
    const BYTES: &[u8] = b"\n\t :{}[]\"'=.,-0129axe&*<#%\x00\xff\xc3";
    let mut built = 0;
    for round in 0..300 {
        let (name, text) = if round % 2 == 0 { ("network.toml", toml.as_str()) } else { ("bus.yml", yaml) };
        let mut bytes = text.as_bytes().to_vec();
        for _ in 0..1 + random(3) {
            let at = random(bytes.len());
            match random(3) {
                0 => drop(bytes.remove(at)),
                1 => bytes[at] = BYTES[random(BYTES.len())],
                _ => bytes.insert(at, BYTES[random(BYTES.len())]),
            }
        }
        let compilation = compile(Source::new(name, bytes).in_folder(&folder), Levels::lenient());
        if let Some(network) = &compilation.network {
            built += files(network).len();
        }
    }
    assert!(built > 0);
}

/// Compiles a network with one node. The description of the node is the example's drive with replaced texts.
fn with_drive(name: &str, replaced: &[(&str, &str)], node: &str) -> Compilation {
    let drive = std::fs::read_to_string(root().join("examples/network/drive.eds")).expect("the example");
    let drive = replaced.iter().fold(drive, |drive, (from, to)| {
        assert!(drive.contains(from), "{from}");
        drive.replace(from, to)
    });
    let network = format!("[master]\nid = 127\n[nodes]\naxis = {{ id = 3, device = \"drive.eds\", {node} }}\n");
    compiled(name, &[("drive.eds", drive), ("network.toml", network)])
}

#[test]
fn a_declared_zero_is_written_unless_the_description_states_it() {
    let inhibit = "[1800sub3]\r\nParameterName=Inhibit time\r\nObjectType=0x7\r\nDataType=0x0006\r\nAccessType=rw\r\n";
    let replaced = [(&*format!("{inhibit}DefaultValue=0\r\n"), inhibit)];
    let node = "tpdo = { 1 = { inhibit_time = 0, event_timer = 0 } }";
    let compilation = with_drive("zero", &replaced, node);
    let files = files(compilation.usable().expect("a network"));
    let bin = files.iter().find(|file| file.name == "axis.bin").expect("a concise DCF");
    let written: Vec<(u16, u8)> = entries(&bin.content).into_iter().map(|(index, sub, _)| (index, sub)).collect();
    assert_eq!(written, [(0x1800, 1), (0x1800, 3), (0x1800, 1)], "the event timer is 0 in the description");
}

#[test]
fn dummy_entries_reserve_space_in_an_rpdo() {
    let node = "rpdo = { 1 = { map = [\"0x0005\", \"Controlword\"] } }";
    let compilation = with_drive("dummy", &[], node);
    let pdos = &compilation.usable().expect("a network").nodes[0].pdos;
    let mapped: Vec<(u16, u8)> = pdos[0].entries.iter().map(|entry| (entry.index, entry.bits)).collect();
    assert_eq!(mapped, [(5, 8), (0x6040, 16)]);
}
