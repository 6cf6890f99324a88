//! Tests with random networks. After a node's concise DCF has been written, the values of the node must agree with the
//! model. They must also agree with the DCF of the node and the DCF of the master.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::diagnostics::{Level, Levels, Severity};
use lexibus_codegen::ir::{Catalog, Direction, Item};
use lexibus_codegen::source::Source;
use lexibus_network::compile::{compile, Compilation};
use lexibus_network::model::{Network, NetworkNode, NetworkPdo};
use lexibus_network::output::{files, OutputFile};

use crate::random::Random;
use crate::random_networks;
use crate::support::{compiled, configured, entries, example_file, with_tpdo_5};

/// Values of integer objects by index and sub-index.
type Dictionary = BTreeMap<(u16, u8), u64>;

/// Returns the initial values of the integer objects of a device with the node-ID `id`.
fn dictionary(catalog: &Catalog, id: u8) -> Dictionary {
    let items = catalog.devices[0].items();
    let value = |item: &Item| Some((item.object()?, item.initial()?.resolved(id).as_int()?));
    items.filter_map(value).map(|(object, value)| (object, value as u64)).collect()
}

/// Returns the values of a node after its concise DCF has been written.
fn configured_dictionary(node: &NetworkNode, files: &[OutputFile]) -> Dictionary {
    // Before the configuration, the device has the default values, not the configured values of a DCF.
    let mut device = node.description.catalog().clone();
    for item in device.devices[0].groups.iter_mut().flat_map(|group| &mut group.items) {
        item.configured = None;
    }
    let mut values = dictionary(&device, node.id);
    let name = format!("{}.bin", node.name.value);
    let written = files.iter().find(|file| file.name == name).map_or(Vec::new(), |file| entries(&file.content));
    for (index, sub_index, bytes) in written {
        let value = bytes.iter().rev().fold(0u64, |value, byte| value << 8 | u64::from(*byte));
        values.insert((index, sub_index), value);
    }
    values
}

/// Compares a PDO of the model with the values of its node.
fn compare_pdo(node: &NetworkNode, pdo: &NetworkPdo, values: &Dictionary, text: &str) {
    let value = |sub_index| values.get(&(pdo.index(), sub_index)).copied().unwrap_or(0);
    let context = format!("{} of {}\n{text}", pdo.title(), node.name.value);
    assert_eq!(u64::from(pdo.cob_id), value(1), "{context}");
    assert_eq!(u64::from(pdo.transmission), value(2), "{context}");
    match pdo.direction {
        Direction::Transmit => {
            assert_eq!(u64::from(pdo.inhibit_time), value(3), "{context}");
            assert_eq!(u64::from(pdo.event_timer), value(5), "{context}");
            assert_eq!(u64::from(pdo.sync_start), value(6), "{context}");
        }
        Direction::Receive => assert_eq!(u64::from(pdo.event_deadline), value(5), "{context}"),
    }
    let words: Vec<u64> = pdo
        .entries
        .iter()
        .map(|entry| u64::from(entry.index) << 16 | u64::from(entry.sub_index) << 8 | u64::from(entry.bits))
        .collect();
    assert_eq!(words, mapping(values, pdo.index()), "{context}");
    assert_eq!(pdo.is_enabled, value(1) >> 31 == 0 && !words.is_empty(), "{context}");
}

/// Returns the mapping of the PDO whose communication object has the given index. Leaves out entries with the value 0, which are unused.
fn mapping(values: &Dictionary, index: u16) -> Vec<u64> {
    let count = values.get(&(index + 0x200, 0)).copied().unwrap_or(0) as u8;
    (1..=count).map(|sub_index| values[&(index + 0x200, sub_index)]).filter(|word| *word != 0).collect()
}

/// A PDO: its COB-ID, an integer that contains its number and the node-ID, and its mapping.
type Exchanged = (u64, u64, Vec<u64>);

/// Reads the eight communication objects from index `first` on, and returns the enabled PDOs of all nodes.
fn enabled(nodes: &[(u8, Dictionary)], first: u16) -> BTreeSet<Exchanged> {
    let of_node = |(id, values): &(u8, Dictionary)| {
        let pdo = |number: u16| {
            let cob_id = *values.get(&(first + number, 1))?;
            let words = mapping(values, first + number);
            let is_enabled = cob_id >> 31 == 0 && !words.is_empty();
            is_enabled.then_some((cob_id, u64::from(number + 1) << 8 | u64::from(*id), words))
        };
        (0..8).filter_map(pdo).collect::<Vec<_>>()
    };
    nodes.iter().flat_map(of_node).collect()
}

/// Returns the PDOs that the master exchanges with the nodes. The master's objects from index `communication` on contain the
/// COB-IDs. Those from index `remote` on contain the PDO numbers, node-IDs and mappings.
fn exchanged(master: &Dictionary, communication: u16, remote: u16) -> BTreeSet<Exchanged> {
    let pdo = |number: u16| {
        let words = mapping(master, remote + number);
        Some((*master.get(&(communication + number, 1))?, *master.get(&(remote + number, 0))?, words))
    };
    (0..64).filter_map(pdo).collect()
}

fn can_id(cob_id: u64) -> u64 {
    if cob_id >> 29 & 1 == 0 {
        cob_id & 0x7FF
    } else {
        cob_id & 0x3FFF_FFFF
    }
}

/// Compares the master's object dictionary with the values of the nodes.
fn compare_master(network: &Network, master: &Dictionary, nodes: &[(u8, Dictionary)], text: &str) {
    let heartbeats =
        nodes.iter().map(|(id, values)| (u64::from(*id), values[&(0x1017, 0)])).filter(|(_, time)| *time > 0);
    let mut expected: Vec<u64> = heartbeats.map(|(id, time)| (id << 16) | (time * 3)).collect();
    if !network.master.as_ref().expect("a master").consumes_heartbeats {
        expected.clear();
    }
    let consumed: Vec<u64> =
        master.range((0x1016, 1)..=(0x1016, 255)).map(|(_, value)| *value).filter(|value| *value != 0).collect();
    assert_eq!(consumed, expected, "{text}");
    for (id, values) in nodes {
        let emcy = Some(values[&(0x1014, 0)]).filter(|cob_id| cob_id >> 31 == 0).unwrap_or(1 << 31);
        assert_eq!(master[&(0x1028, *id)], emcy, "{text}");
    }
    let (sent, received) = (enabled(nodes, 0x1800), enabled(nodes, 0x1400));
    assert_eq!(exchanged(master, 0x1400, 0x5800), sent, "{text}");
    let of_nodes: BTreeSet<u64> = sent.iter().map(|(cob_id, ..)| can_id(*cob_id)).collect();
    let length = |words: &[u64]| words.iter().map(|word| word & 0xFF).sum::<u64>().div_ceil(8);
    let frames = |pdos: BTreeSet<Exchanged>| -> Vec<(u64, u64)> {
        pdos.iter()
            .map(|(cob_id, _, words)| (can_id(*cob_id), length(words)))
            .filter(|(id, _)| !of_nodes.contains(id))
            .collect()
    };
    let from_master = frames(exchanged(master, 0x1800, 0x5C00));
    let expected: BTreeSet<(u64, u64)> = frames(received).into_iter().collect();
    assert_eq!(from_master.len(), expected.len(), "each frame once\n{text}");
    assert_eq!(from_master.into_iter().collect::<BTreeSet<_>>(), expected, "{text}");
}

/// Compares the first heartbeat consumer entry of a node with the settings of the network file.
fn compare_consumer(compilation: &Compilation, node: &NetworkNode, values: &Dictionary, text: &str) {
    let master = compilation.network.as_ref().and_then(|network| network.master.as_ref()).expect("a master");
    let section = text.split("[nodes.").find(|section| section.starts_with(&format!("{}]", node.name.value)));
    let section = section.expect("the section of the node");
    let is_refused = compilation.diagnostics.list().iter().any(|found| {
        found.message == format!("the node `{}` cannot monitor the heartbeat of the master", node.name.value)
    });
    let expected = match section.contains("heartbeat_consumer = true") && master.heartbeat.value > 0 && !is_refused {
        _ if section.contains("0x1016:1") => return,
        true => 127 << 16 | 300,
        // In this DCF, the entry monitors the master, so the compiler clears it.
        false if section.contains("drive.dcf") => 127 << 16,
        false => 0,
    };
    assert_eq!(values[&(0x1016, 1)], expected, "{}\n{text}", node.name.value);
}

/// Reads an output file as a device description.
fn read(files: &[OutputFile], name: &str) -> Catalog {
    let file = files.iter().find(|file| file.name == name).expect("a file");
    check(Source::new(name, file.content.clone()), &Options::default()).catalog.expect("a catalog")
}

/// Writes the descriptions of the devices to a folder.
fn descriptions() -> PathBuf {
    let drive = example_file("drive.eds").replace("$NODEID+0x80000280", "$NODEID+0xC0000280");
    let values =
        [("1016sub1", "0x007F0032"), ("1017", "80"), ("1801sub1", "0x401"), ("1801sub2", "3"), ("1014", "0xA0")];
    let dcf = values.into_iter().fold(drive.clone(), |dcf, (object, value)| configured(&dcf, object, value));
    let name = "random-networks";
    let files = [
        ("fifth.eds", with_tpdo_5(&drive)),
        ("drive.eds", drive),
        ("drive.dcf", dcf),
        ("io.eds", example_file("io.eds")),
        ("network.toml", String::new()),
    ];
    compiled(name, &files);
    Path::new(env!("CARGO_TARGET_TMPDIR")).join(name)
}

/// Compiles a network in a folder. Faults on the bus are only warnings. Panics if there is an error, except the error for an RPDO
/// that receives a missing or disabled TPDO.
fn compiled_in(folder: &Path, text: &str) -> Compilation {
    let mut levels = Levels::lenient();
    for number in [13, 17, 18, 19, 20, 21, 22, 23] {
        levels.set(&format!("NET{number:03}"), Level::Warn).expect("a code");
    }
    let compilation = compile(Source::new("network.toml", text.as_bytes().to_vec()).in_folder(folder), levels);
    let mut errors = compilation.diagnostics.list().iter().filter(|found| found.severity == Severity::Error);
    assert!(errors.all(|found| found.code.id == "NET015"), "{:?}\n{text}", compilation.diagnostics.list());
    compilation
}

/// Compares the model with the values of a node.
fn compare_node(node: &NetworkNode, values: &Dictionary, text: &str) {
    let number = |index| values.get(&(index, 0)).copied().unwrap_or(0);
    assert_eq!(u64::from(node.heartbeat.value), number(0x1017), "{text}");
    assert_eq!(u64::from(node.guard_time), number(0x100C), "{text}");
    assert_eq!(u64::from(node.life_time_factor), number(0x100D), "{text}");
    assert_eq!(u64::from(node.emcy_cob_id), number(0x1014), "{text}");
    node.pdos.iter().for_each(|pdo| compare_pdo(node, pdo, values, text));
}

#[test]
fn the_last_values_are_those_of_the_model_and_of_the_master() {
    let folder = descriptions();
    let mut random = Random(30);
    let mut usable = 0;
    for _ in 0..40 {
        let text = random_networks::network(&mut random);
        let compilation = compiled_in(&folder, &text);
        let Some(network) = compilation.usable() else { continue };
        usable += 1;
        let files = files(network);
        let nodes: Vec<(u8, Dictionary)> =
            network.nodes.iter().map(|node| (node.id, configured_dictionary(node, &files))).collect();
        for (node, (id, values)) in network.nodes.iter().zip(&nodes) {
            compare_node(node, values, &text);
            compare_consumer(&compilation, node, values, &text);
            let written = dictionary(&read(&files, &format!("{}.dcf", node.name.value)), *id);
            assert_eq!(&written, values, "{}\n{text}", node.name.value);
        }
        let master = dictionary(&read(&files, "master.dcf"), network.master_id());
        compare_master(network, &master, &nodes, &text);
    }
    assert!(usable >= 20, "{usable}");
}
