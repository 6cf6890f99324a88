//! Tests for the heartbeat consumers of nodes.

use crate::support::{compiled, configured, example_file, messages, node, valid, written};

/// Object 0x1016, sub-index 1.
const CONSUMER: (u16, u8) = (0x1016, 1);

/// Value of a consumer entry for the master (node-ID 127) with a consumer time of 300 ms.
const OF_MASTER: u64 = 127 << 16 | 300;

fn network(node: &str) -> String {
    format!("[master]\nid = 127\nheartbeat = 100\n\n[nodes.axis]\nid = 1\ndevice = \"axis.dcf\"\n{node}\n")
}

#[test]
fn the_time_for_the_master_replaces_that_of_a_dcf() {
    let dcf = configured(&example_file("drive.eds"), "1016sub1", "0x007F0032");
    let compilation =
        compiled("heartbeat-dcf", &[("axis.dcf", dcf.clone()), ("network.toml", network("heartbeat_consumer = true"))]);
    let axis = node(valid(&compilation), "axis");
    assert_eq!(written(axis, CONSUMER), [127 << 16 | 50, OF_MASTER]);
    assert_eq!(axis.values().get(CONSUMER), Some(OF_MASTER.into()));
    // Without `heartbeat_consumer`, the node does not monitor the master.
    let compilation = compiled("heartbeat-dcf-off", &[("axis.dcf", dcf), ("network.toml", network(""))]);
    assert_eq!(written(node(valid(&compilation), "axis"), CONSUMER).last(), Some(&(127 << 16)));
}

#[test]
fn an_entry_of_a_dcf_is_not_free() {
    let dcf = configured(&example_file("drive.eds"), "1016sub1", "0x00020032");
    let other = "heartbeat_consumer = true\n[nodes.other]\nid = 2\ndevice = \"axis.dcf\"\nheartbeat = 20\n";
    let compilation = compiled("heartbeat-used", &[("axis.dcf", dcf), ("network.toml", network(other))]);
    assert_eq!(messages(&compilation), ["NET020 the node `axis` cannot monitor the heartbeat of the master"]);
}

#[test]
fn an_entry_that_parameters_set_is_not_free() {
    let other = "heartbeat_consumer = true\nparameters = { \"0x1016:1\" = 0x00020032 }\n\
                 [nodes.other]\nid = 2\ndevice = \"axis.dcf\"\nheartbeat = 20\n";
    let compilation =
        compiled("heartbeat-parameters", &[("axis.dcf", example_file("drive.eds")), ("network.toml", network(other))]);
    assert_eq!(messages(&compilation), ["NET020 the node `axis` cannot monitor the heartbeat of the master"]);
    let axis = node(compilation.network.as_ref().expect("a network"), "axis");
    assert_eq!(written(axis, CONSUMER), [2 << 16 | 50]);
    // An entry that `parameters` set to 0 is not free, either.
    let cleared = network("heartbeat_consumer = true\nparameters = { \"0x1016:1\" = 0 }");
    let compilation =
        compiled("heartbeat-cleared", &[("axis.dcf", example_file("drive.eds")), ("network.toml", cleared)]);
    assert_eq!(messages(&compilation), ["NET020 the node `axis` cannot monitor the heartbeat of the master"]);
}

#[test]
fn parameters_can_set_the_time_for_the_master() {
    for consumer in ["true", "false"] {
        let text = format!("heartbeat_consumer = {consumer}\nparameters = {{ \"0x1016:1\" = 0x007F01F4 }}");
        let compilation =
            compiled("heartbeat-own", &[("axis.dcf", example_file("drive.eds")), ("network.toml", network(&text))]);
        assert_eq!(written(node(valid(&compilation), "axis"), CONSUMER), [127 << 16 | 500]);
    }
    let short = network("parameters = { \"0x1016:1\" = 0x007F0064 }");
    let compilation = compiled("heartbeat-short", &[("axis.dcf", example_file("drive.eds")), ("network.toml", short)]);
    assert_eq!(messages(&compilation), ["NET020 `axis` expects a heartbeat from node 127 every 100 ms"]);
}

#[test]
fn only_final_values_are_checked() {
    let dcf = configured(&example_file("drive.eds"), "1016sub1", "0x00020032");
    let compilation = compiled("heartbeat-final", &[("axis.dcf", dcf.clone()), ("network.toml", network(""))]);
    assert_eq!(messages(&compilation), ["NET020 `axis` expects a heartbeat from node 2 every 50 ms"]);
    let cleared = network("parameters = { \"0x1016:1\" = 0 }");
    let compilation = compiled("heartbeat-final", &[("axis.dcf", dcf), ("network.toml", cleared)]);
    valid(&compilation);
}
