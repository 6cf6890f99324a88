//! Tests for the frames on the bus. Each PDO of the master counts once, and the SYNC of each producer counts.

use lexibus_network::check::{bus_load, frame_bits};

use crate::support::{compiled, example_file, messages, valid, with_object};

/// Compiles a network of devices that can send SYNC.
fn with_sync(name: &str, text: &str) -> lexibus_network::compile::Compilation {
    let device = with_object(&with_object(&example_file("drive.eds"), "1006", "0"), "1007", "0");
    compiled(name, &[("drive.eds", device), ("network.toml", text.to_owned())])
}

const SHARED: &str = "
rpdo.1 = { cob_id = 0x201, transmission = 1, map = [\"Controlword\"] }
tpdo.1.enabled = false
";

#[test]
fn a_pdo_of_the_master_for_several_nodes_counts_once() {
    let nodes: String =
        (1..=3).map(|id| format!("[nodes.axis{id}]\nid = {id}\ndevice = \"drive.eds\"{SHARED}")).collect();
    let text = format!("[network]\nbit_rate = 125\n[master]\nid = 127\nsync_period = 2000\n{nodes}");
    let compilation = with_sync("traffic-shared", &text);
    let load = bus_load(valid(&compilation));
    let sent: Vec<(u32, f64)> = load.traffic.iter().map(|traffic| (traffic.can_id, traffic.rate)).collect();
    assert_eq!(sent, [(0x80, 500.0), (0x201, 500.0)]);
    // SYNC and one PDO take 1040 µs, but SYNC and two PDOs would take more than 1100 µs.
    let bits = frame_bits(0x80, 0) + frame_bits(0x201, 2);
    let period = f64::from(bits) * 8.0;
    assert!(period < 1100.0);
    valid(&with_sync("traffic-shared", &text.replace("sync_period = 2000", "sync_period = 1100")));
    let short = with_sync("traffic-shared", &text.replace("sync_period = 2000", "sync_period = 1000"));
    assert_eq!(
        messages(&short).last(),
        Some(&format!("NET022 SYNC and 1 synchronous PDO take up to {period:.0} µs, but the SYNC period is 1000 µs"))
    );
}

/// A node that sends SYNC every 1000 µs, and a synchronous PDO of 2 bytes.
const PRODUCER: &str = "
[nodes.axis]
id = 1
device = \"drive.eds\"
parameters = { \"0x1005\" = 0x40000080, \"0x1006\" = 1000 }
tpdo.1 = { transmission = 1, map = [\"Statusword\"] }
rpdo.1.enabled = false
";

#[test]
fn sync_of_a_node_counts() {
    let compilation = with_sync("traffic-sync", &format!("[master]\nid = 127\n{PRODUCER}"));
    let load = bus_load(valid(&compilation));
    let sent: Vec<(&str, f64)> = load.traffic.iter().map(|traffic| (traffic.name.as_str(), traffic.rate)).collect();
    assert_eq!(sent, [("SYNC of `axis`", 1000.0), ("TPDO 1 of `axis`", 1000.0)]);
    let slow = format!("[network]\nbit_rate = 125\n[master]\nid = 127\n{PRODUCER}");
    assert_eq!(
        messages(&with_sync("traffic-sync", &slow)),
        [
            "NET021 the bus load is 130 kbit/s, but the bit rate is 125 kbit/s",
            "NET022 SYNC and 1 synchronous PDO take up to 1040 µs, but the SYNC period is 1000 µs"
        ]
    );
    // A node sends no SYNC if bit 30 of 0x1005 is 0, or if the period is 0.
    for (with, without) in [("0x40000080", "0x80"), ("1000", "0")] {
        let text = format!("[master]\nid = 127\n{PRODUCER}").replace(with, without);
        let found = messages(&with_sync("traffic-sync", &text));
        assert_eq!(found, ["NET022 TPDO 1 of `axis` is synchronous, but no node sends SYNC"], "{without}");
    }
}

#[test]
fn two_producers_of_sync_are_a_conflict() {
    let text = format!("[master]\nid = 127\nsync_period = 2000\n{PRODUCER}");
    let compilation = with_sync("traffic-two", &text);
    assert_eq!(messages(&compilation), ["NET019 SYNC of `axis` and SYNC use the same CAN-ID 0x80"]);
    let load = bus_load(compilation.network.as_ref().expect("a network"));
    let rates: Vec<f64> = load.traffic.iter().map(|traffic| traffic.rate).collect();
    assert_eq!(rates, [500.0, 1000.0, 1000.0], "the PDO is sent with the faster SYNC at worst");
    // There is no conflict if the SYNC of the node has another CAN-ID.
    valid(&with_sync("traffic-two", &text.replace("0x40000080", "0x40000090")));
}
