//! Generates random networks of corpus devices in the format `bus.yml`.

use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::ir::{Access, Catalog, Device, Item, Type};
use lexibus_codegen::source::Source;

use crate::random::Random;

/// A device of the corpus that both dcf-tools and Lexibus accept.
pub struct Model {
    /// File name of the device description.
    pub file: String,
    catalog: Catalog,
}

impl Model {
    /// Creates a model from a description. Returns `None` if Lexibus cannot use the description, or if it does not describe exactly one
    /// device.
    pub fn new(file: String, bytes: Vec<u8>) -> Option<Self> {
        let compilation = check(Source::new(file.as_str(), bytes), &Options::default());
        let catalog = compilation.usable()?.clone();
        (catalog.devices.len() == 1).then_some(Model { file, catalog })
    }

    fn device(&self) -> &Device {
        &self.catalog.devices[0]
    }

    fn has(&self, index: u16, sub_index: u8) -> bool {
        self.device().entry(index, sub_index).is_some_and(|item| item.access.writable())
    }
}

/// Returns the `bus.yml` of a random network, and the model of each node.
pub fn network<'m>(models: &'m [Model], random: &mut Random) -> (String, Vec<&'m Model>) {
    let mut text = String::new();
    if random.chance(40) {
        text += &format!("options:\n  dcf_path: \"config\"\n  retry_factor: {}\n", random.below(10));
    }
    let mut ids: Vec<usize> = (1..=127).collect();
    let mut id = |random: &mut Random| ids.swap_remove(random.below(ids.len()));
    text += &master(id(random), random);
    let mut used = Vec::new();
    for number in 0..1 + random.below(5) {
        let model = random.choose(models);
        text += &format!("node_{number}:\n  node_id: {}\n  dcf: \"{}\"\n", id(random), model.file);
        text += &node(model, random);
        used.push(model);
    }
    (text, used)
}

fn master(id: usize, random: &mut Random) -> String {
    let mut text = format!("master:\n  node_id: {id}\n  baudrate: {}\n", random.choose(&[125, 250, 500, 1000]));
    let heartbeat = 10 * random.below(100);
    let lines = [
        format!("sync_period: {}", 1000 * random.below(1000)),
        format!("sync_overflow: {}", random.below(241)),
        format!("heartbeat_producer: {heartbeat}"),
        "heartbeat_consumer: false".to_owned(),
        "heartbeat_multiplier: 2.5".to_owned(),
        format!("vendor_id: {:#x}", random.below(1 << 32)),
        format!("product_code: {}", random.below(1 << 32)),
        format!("serial_number: {}", random.below(1 << 32)),
        format!("emcy_inhibit_time: {}", random.below(1 << 16)),
        format!("error_behavior: {{1: {}, 2: 1}}", random.below(3)),
        "start: false".to_owned(),
        "start_nodes: 0".to_owned(),
        "start_all_nodes: true".to_owned(),
        "stop_all_nodes: true".to_owned(),
        format!("boot_time: {}", random.below(10_000)),
    ];
    for line in lines {
        if random.chance(35) {
            text += &format!("  {line}\n");
        }
    }
    text
}

fn node(model: &Model, random: &mut Random) -> String {
    let mut lines = vec![
        (true, format!("revision_number: {}", random.below(1 << 32))),
        (true, format!("serial_number: {}", random.below(1 << 32))),
        (true, "mandatory: true".to_owned()),
        (true, "boot: false".to_owned()),
        (true, "reset_communication: false".to_owned()),
        (true, format!("retry_factor: {}", random.below(256))),
        (true, format!("software_version: {}", random.below(1 << 32))),
        (true, "software_file: \"program.bin\"".to_owned()),
        (model.has(0x1011, 1), "restore_configuration: 1".to_owned()),
        (model.has(0x1016, 1), "heartbeat_consumer: true".to_owned()),
        (model.has(0x1029, 1), format!("error_behavior: {{1: {}}}", random.below(3))),
    ];
    match random.chance(50) {
        true => lines.push((model.has(0x1017, 0), format!("heartbeat_producer: {}", 10 * random.below(500)))),
        false => {
            lines.push((model.has(0x100C, 0), format!("guard_time: {}", random.below(1000))));
            lines.push((model.has(0x100D, 0), format!("life_time_factor: {}", random.below(10))));
        }
    }
    let mut text = String::new();
    for (is_possible, line) in lines {
        if is_possible && random.chance(30) {
            text += &format!("  {line}\n");
        }
    }
    for (key, first) in [("rpdo", 0x1400u16), ("tpdo", 0x1800)] {
        text += &pdos(model, key, first, random);
    }
    text + &values(model, random)
}

fn pdos(model: &Model, key: &str, first: u16, random: &mut Random) -> String {
    let numbers: Vec<u16> = (0..512).filter(|number| model.has(first + number, 1)).collect();
    let mut text = String::new();
    for number in numbers {
        if !random.chance(40) || text.lines().count() > 40 {
            continue;
        }
        text += &format!("    {}:\n      cob_id: auto\n", number + 1);
        if model.has(first + number, 2) && random.chance(60) {
            text += &format!("      transmission: {}\n", random.choose(&[0, 1, 3, 240, 254, 255]));
        }
        let timers = [(3, "inhibit_time"), (5, "event_timer"), (6, "sync_start")];
        for (sub_index, timer) in timers {
            if (key == "rpdo" || model.has(first + number, sub_index)) && random.chance(25) {
                text += &format!("      {timer}: {}\n", random.below(200));
            }
        }
        if model.has(first + 0x200 + number, 0) && random.chance(70) {
            text += &mapping(model, key == "tpdo", first + 0x200 + number, random);
        }
        if random.chance(10) {
            text += "      enabled: false\n";
        }
    }
    if text.is_empty() {
        text
    } else {
        format!("  {key}:\n{text}")
    }
}

fn mapping(model: &Model, is_tpdo: bool, index: u16, random: &mut Random) -> String {
    let is_able = |item: &&Item| {
        item.object().is_some_and(|(index, _)| index >= 0x1000)
            && if is_tpdo { item.mappable.tpdo } else { item.mappable.rpdo }
    };
    let bits = |item: &Item| lexibus_codegen::facts::types::basic(&model.device().types, item.object_type()).bits();
    let able: Vec<&Item> = model.device().items().filter(is_able).collect();
    let (mut text, mut free, mut sub_index) = (String::from("      mapping:\n"), 64, 1);
    for _ in 0..if able.is_empty() { 0 } else { random.below(5) } {
        let item = random.choose(&able);
        let Some(length) = bits(item).filter(|length| *length <= free) else { continue };
        if !model.has(index, sub_index) {
            break;
        }
        let (object, sub) = item.object().expect("an object");
        text += &format!("        - {{index: {object:#06x}, sub_index: {sub}}}\n");
        (free, sub_index) = (free - length, sub_index + 1);
    }
    if text.lines().count() == 1 {
        "      mapping: []\n".to_owned()
    } else {
        text
    }
}

/// Returns random values within the limits of the description, for writable integer objects from index 0x2000 on.
fn values(model: &Model, random: &mut Random) -> String {
    let is_writable = |item: &&Item| {
        let (index, _) = item.object().unwrap_or((0, 0));
        index >= 0x2000 && matches!(item.access, Access::ReadWrite | Access::WriteOnly | Access::ReadWriteOutput)
    };
    let items: Vec<&Item> = model.device().items().filter(is_writable).collect();
    let mut text = String::new();
    for _ in 0..if items.is_empty() { 0 } else { random.below(6) } {
        let item = random.choose(&items);
        let ty = lexibus_codegen::facts::types::basic(&model.device().types, item.object_type());
        let Some((low, high)) = ty.integer_range().filter(|_| !matches!(ty, Type::Boolean)) else { continue };
        let (lowest, highest) = item.limits.integers();
        let (low, high) = (lowest.unwrap_or(low).max(low), highest.unwrap_or(high).min(high));
        if low > high || !item.limits.allowed.is_empty() {
            continue;
        }
        let value = low + i128::from(random.next()) % (high - low + 1);
        let (index, sub_index) = item.object().expect("an object");
        text += &format!("    - {{index: {index:#06x}, sub_index: {sub_index}, value: {value}}}\n");
    }
    if text.is_empty() {
        text
    } else {
        format!("  sdo:\n{text}")
    }
}
