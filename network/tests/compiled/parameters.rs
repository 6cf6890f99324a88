//! Tests for objects that `parameters` set. The master, the other nodes and the checks use the values of these objects.

use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::ir::{Catalog, Direction};
use lexibus_codegen::source::Source;
use lexibus_codegen::RustOptions;
use lexibus_network::check::bus_load;
use lexibus_network::compile::Compilation;
use lexibus_network::model::Network;
use lexibus_network::output::{master_dcf, rust};

use crate::support::{compiled, example_file, messages, node, valid};

fn with_parameters(name: &str, parameters: &str) -> Compilation {
    let text = format!(
        "[master]\nid = 127\n[nodes.axis]\nid = 1\ndevice = \"drive.eds\"\nheartbeat = 100\nparameters = {{ {parameters} }}\n"
    );
    compiled(name, &[("drive.eds", example_file("drive.eds")), ("network.toml", text)])
}

/// Returns the master's object dictionary.
fn master(network: &Network) -> Catalog {
    let text = master_dcf(network).expect("a master");
    check(Source::new("master.dcf", text.into_bytes()), &Options::default()).catalog.expect("a catalog")
}

fn value(master: &Catalog, index: u16, sub_index: u8) -> Option<i128> {
    master.devices[0].entry(index, sub_index)?.initial()?.as_int()
}

#[test]
fn the_master_expects_the_heartbeat_of_the_last_value() {
    let compilation = with_parameters("parameters-heartbeat", "\"0x1017\" = 200");
    let network = valid(&compilation);
    assert_eq!(node(network, "axis").heartbeat.value, 200);
    assert_eq!(value(&master(network), 0x1016, 1), Some(1 << 16 | 600));
    let load = bus_load(network);
    assert_eq!(load.traffic.iter().map(|traffic| traffic.rate).collect::<Vec<_>>(), [5.0]);
    let rust = rust(network, &RustOptions::default());
    let (_, module) = rust.iter().find(|(name, _)| name == "network.rs").expect("a module");
    assert!(module.contains("ErrorControl::Heartbeat(Duration::from_millis(600))"), "{module}");

    let off = with_parameters("parameters-heartbeat", "\"0x1017\" = 0");
    assert_eq!(value(&master(valid(&off)), 0x1016, 1), None);
    let long = with_parameters("parameters-heartbeat", "\"0x1017\" = 30_000");
    assert_eq!(messages(&long), ["NET020 the consumer time for the heartbeat of `axis` is 90000 ms"]);
}

#[test]
fn the_master_expects_the_emcy_of_the_last_value() {
    let compilation = with_parameters("parameters-emcy", "\"0x1014\" = 0x91");
    assert_eq!(value(&master(valid(&compilation)), 0x1028, 1), Some(0x91));
    let compilation = with_parameters("parameters-emcy", "\"0x1014\" = 0x80000081");
    assert_eq!(value(&master(valid(&compilation)), 0x1028, 1), Some(0x8000_0000));
    let compilation = with_parameters("parameters-emcy", "\"0x1014\" = 0x181");
    let conflict = "NET019 TPDO 1 of `axis` and the EMCY of `axis` use the same CAN-ID 0x181";
    assert_eq!(messages(&compilation), [conflict]);
    let compilation = with_parameters("parameters-emcy", "\"0x1014\" = 0x601");
    assert_eq!(messages(&compilation), ["NET023 the EMCY of `axis` cannot use the CAN-ID 0x601"]);
}

/// Values that configure TPDO 2, in the order in which they must be written: disable, clear, map, count, enable.
const TPDO: &str = "
    - {index: 0x1801, sub_index: 1, value: 0x80000281}
    - {index: 0x1801, sub_index: 2, value: 1}
    - {index: 0x1A01, sub_index: 0, value: 0}
    - {index: 0x1A01, sub_index: 1, value: 0x60410010}
    - {index: 0x1A01, sub_index: 2, value: 0x606C0020}
    - {index: 0x1A01, sub_index: 0, value: 2}
    - {index: 0x1801, sub_index: 1, value: 0x281}
";

fn with_sdo(sdo: &str, period: u32) -> Compilation {
    let text = format!(
        "master: {{node_id: 127, sync_period: {period}}}\naxis:\n  node_id: 1\n  dcf: drive.eds\n  \
         tpdo: {{1: {{enabled: false}}}}\n  sdo:{sdo}"
    );
    compiled("parameters-pdo", &[("drive.eds", example_file("drive.eds")), ("bus.yml", text)])
}

#[test]
fn the_master_receives_a_pdo_that_parameters_configure() {
    let compilation = with_sdo(TPDO, 10_000);
    let network = valid(&compilation);
    let pdo = node(network, "axis").pdo(Direction::Transmit, 2).expect("a PDO");
    assert!(pdo.is_enabled);
    assert_eq!((pdo.cob_id, pdo.transmission, pdo.bits()), (0x281, 1, 48));
    let master = master(network);
    assert_eq!([1, 2].map(|sub_index| value(&master, 0x1400, sub_index)), [Some(0x281), Some(1)]);
    assert_eq!(value(&master, 0x5800, 0), Some(2 << 8 | 1));
    assert_eq!([1, 2].map(|sub_index| value(&master, 0x5A00, sub_index)), [Some(0x6041_0010), Some(0x606C_0020)]);
    assert!(bus_load(network).traffic.iter().any(|traffic| traffic.name == "TPDO 2 of `axis`"));
}

#[test]
fn pdos_that_parameters_configure_are_checked() {
    let without_sync = with_sdo(TPDO, 0);
    assert_eq!(messages(&without_sync), ["NET022 TPDO 2 of `axis` is synchronous, but no node sends SYNC"]);
    let position = "value: 0x281}\n    - {index: 0x1A01, sub_index: 3, value: 0x60640020}\n    - {index: 0x1A01, sub_index: 0, value: 3}";
    let long = with_sdo(&TPDO.replace("value: 0x281}", position), 10_000);
    assert_eq!(messages(&long), ["NET017 TPDO 2 maps 80 bits, but a PDO has at most 64"]);
    let conflict = with_sdo(&TPDO.replace("value: 0x281}", "value: 0x81}"), 10_000);
    assert_eq!(messages(&conflict), ["NET019 TPDO 2 of `axis` and the EMCY of `axis` use the same CAN-ID 0x81"]);
    let mapped = |word: &str| messages(&with_sdo(&TPDO.replace("0x606C0020", word), 10_000));
    assert_eq!(mapped("0x60400010"), ["NET016 object 0x6040 `Controlword` cannot be mapped into a TPDO"]);
    assert_eq!(mapped("0x60490010"), ["NET016 TPDO 2 of `axis` maps object 0x6049:0"]);
    assert_eq!(mapped("0x606C0010"), ["NET016 TPDO 2 maps 16 bits of object 0x606C `Velocity actual value`"]);
    assert_eq!(mapped("0x00050008"), [""; 0], "a gap");
}
