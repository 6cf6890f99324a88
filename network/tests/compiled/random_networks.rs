//! Generates random networks of the example's devices in the format `network.toml`.

use crate::random::Random;

/// A device description with its PDOs, and with the objects that can be mapped into RPDOs (`received`) and TPDOs (`sent`).
struct Model {
    file: &'static str,
    pdos: &'static [(&'static str, u16)],
    received: &'static [&'static str],
    sent: &'static [&'static str],
}

const DRIVE: Model = Model {
    file: "drive.eds",
    pdos: &[("rpdo", 1), ("rpdo", 2), ("tpdo", 1), ("tpdo", 2)],
    received: &["0x6040", "0x607A", "0x60FF", "0x0005"],
    sent: &["0x6041", "0x6064", "0x606C"],
};

/// A drive whose description is a DCF with configured values.
const CONFIGURED: Model = Model { file: "drive.dcf", ..DRIVE };

/// A drive with TPDO 5 instead of TPDO 2.
const FIFTH: Model = Model { file: "fifth.eds", pdos: &[("rpdo", 1), ("rpdo", 2), ("tpdo", 1), ("tpdo", 5)], ..DRIVE };

const IO: Model = Model { file: "io.eds", pdos: &[("rpdo", 1), ("tpdo", 1), ("tpdo", 2)], received: &[], sent: &[] };

/// Returns a random network with 3 to 6 nodes and a master. The nodes have node-IDs from 1 on, and the master has node-ID 127.
pub fn network(random: &mut Random) -> String {
    let count = 3 + random.below(4);
    let models: Vec<&Model> = (0..count).map(|_| *random.choose(&[&DRIVE, &DRIVE, &CONFIGURED, &FIFTH, &IO])).collect();
    let mut text = String::from("[master]\nid = 127\n");
    for line in ["heartbeat = 100", "sync_period = 10_000", "time_cob_id = 0x680", "heartbeat_consumer = false"] {
        if random.chance(40) {
            text += &format!("{line}\n");
        }
    }
    for (model, id) in models.iter().zip(1..) {
        text += &format!("\n[nodes.node{id}]\nid = {id}\ndevice = \"{}\"\n", model.file);
        text += &node(model, &models, random);
    }
    text
}

fn node(model: &Model, models: &[&Model], random: &mut Random) -> String {
    let lines = [
        format!("heartbeat = {}", 50 * random.below(10)),
        "heartbeat_consumer = true".to_owned(),
        format!("guard_time = {}", random.below(100)),
        format!("life_time_factor = {}", random.below(5)),
        format!("parameters = {{ {} }}", parameters(model, random).join(", ")),
    ];
    let mut text: String = lines.into_iter().filter(|_| random.chance(50)).map(|line| line + "\n").collect();
    for (kind, number) in model.pdos {
        if random.chance(60) {
            text += &format!("{kind}.{number} = {{ {} }}\n", pdo(model, kind, models, random).join(", "));
        }
    }
    text
}

fn parameters(model: &Model, random: &mut Random) -> Vec<String> {
    let mut list = vec![
        format!("\"0x1017\" = {}", 30 * random.below(10)),
        format!("\"0x1014\" = {}", random.choose(&["0x90", "0x80000081", "0x682", "\"$NODEID+0x80\""])),
        format!("\"0x1016:1\" = {}", random.choose(&["0", "0x007F0100", "0x00020200"])),
        format!("\"0x100C\" = {}", random.below(100)),
    ];
    for (kind, number) in model.pdos {
        let index = number - 1 + if *kind == "rpdo" { 0x1400 } else { 0x1800 };
        let cob_id = ["0x80000201", "0x684", "0x40000685", "\"$NODEID+0x200\"", "0x20012345"];
        list.push(format!("\"0x{index:04X}:1\" = {}", random.choose(&cob_id)));
        list.push(format!("\"0x{index:04X}:2\" = {}", random.choose(&[0, 1, 240, 254, 255])));
        list.push(format!("\"0x{:04X}:0\" = {}", index + 0x200, random.below(2)));
        list.push(format!("\"0x{index:04X}:5\" = {}", random.below(1000)));
    }
    list.retain(|_| random.chance(20));
    list
}

fn pdo(model: &Model, kind: &str, models: &[&Model], random: &mut Random) -> Vec<String> {
    let able = if kind == "tpdo" { model.sent } else { model.received };
    let map: Vec<String> =
        (0..random.below(3)).filter(|_| !able.is_empty()).map(|_| format!("\"{}\"", random.choose(able))).collect();
    let mut list = vec![
        format!("transmission = {}", random.choose(&[0, 1, 240, 254, 255])),
        format!("event_timer = {}", random.below(500)),
        format!("event_deadline = {}", random.below(500)),
        format!("inhibit_time = {}", random.below(500)),
        format!("sync_start = {}", random.below(240)),
        format!("enabled = {}", random.chance(70)),
    ];
    if !able.is_empty() {
        list.push(format!("map = [{}]", map.join(", ")));
    }
    list.retain(|_| random.chance(40));
    match random.below(4) {
        0 => list.push("cob_id = \"auto\"".to_owned()),
        1 => list.push(format!("cob_id = {}", random.choose(&["0x181", "0x40000681", "0x80000182", "0x20012345"]))),
        2 if kind == "rpdo" => {
            let sender = random.below(models.len());
            let numbers: Vec<u16> = models[sender].pdos.iter().filter(|pdo| pdo.0 == "tpdo").map(|pdo| pdo.1).collect();
            list.push(format!("cob_id = \"node{}.tpdo{}\"", sender + 1, random.choose(&numbers)));
        }
        _ => {}
    }
    list
}
