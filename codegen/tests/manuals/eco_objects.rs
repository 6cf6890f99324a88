//! Compares the Eco's objects, PDOs, process images and sequences with the text of its manual.

use crate::eco_support;

use std::collections::{BTreeMap, BTreeSet};

use eco_support::*;
use lexibus_codegen::ir::{Access, Binding, Bus, Direction, ObjectBuses, PdoEntryKind, Step};

/// A printed row of an object or sub-index.
struct Printed {
    line: usize,
    place: (u16, Option<u8>),
    access: Option<Access>,
    mappable: bool,
    bytes: Option<u32>,
}

/// Returns the printed rows of the object tables.
fn objects(manual: &[String]) -> Vec<Printed> {
    let mut rows: Vec<(usize, u16, Option<u8>, String)> = Vec::new();
    for (line, text) in lines(manual, 3454, 3898) {
        let index = hex_numbers(text.get(..6).unwrap_or_default(), 4).first().map(|entry| *entry as u16);
        let sub =
            text.strip_prefix("sub ").and_then(|rest| rest.split(' ').next()).and_then(|entry| entry.parse().ok());
        match (index, sub, rows.last()) {
            (Some(index), _, _) => rows.push((line, index, None, text.to_owned())),
            (None, Some(sub), Some(&(_, index, ..))) => rows.push((line, index, Some(sub), text.to_owned())),
            (None, None, Some(_)) => {
                let row = &mut rows.last_mut().expect("a row").3;
                row.push(' ');
                row.push_str(text);
            }
            _ => {}
        }
    }
    let found = rows.into_iter().map(|(line, index, sub, text)| {
        // The length of an object is printed as `4 B`. A `B` that starts a longer word does not mark a length.
        let is_length = |at: usize| {
            let goes_on = text[at + 2..].starts_with(|c: char| c.is_alphabetic());
            text[..at].ends_with(|c: char| c.is_ascii_digit()) && !goes_on
        };
        let bytes_at = text.match_indices(" B").find(|(at, _)| is_length(*at));
        let actual = &text[..bytes_at.map_or(text.len(), |(at, _)| at)];
        let words: Vec<&str> = actual.split_whitespace().collect();
        let access = words.iter().find_map(|word| match *word {
            "ro" => Some(Access::ReadOnly),
            "rw" => Some(Access::ReadWrite),
            "wo" => Some(Access::WriteOnly),
            "const" | "cons" => Some(Access::Constant),
            _ => None,
        });
        Printed {
            line,
            place: (index, sub),
            access,
            mappable: words.contains(&"Mappabile"),
            bytes: bytes_at.and_then(|_| words.last()?.parse().ok()),
        }
    });
    found.collect()
}

/// Objects for whose sub-index 0 the manual prints a length of four bytes.
const LONG: [u16; 4] = [0x1003, 0x1010, 0x6092, 0x6099];

#[test]
fn every_object_is_there_at_its_line() {
    let Some(manual) = manual() else { return };
    let compilation = table();
    let device = device(&compilation);
    let printed = objects(&manual);
    let indices: BTreeSet<u16> = printed.iter().map(|row| row.place.0).collect();
    let leaves: Vec<&Printed> = printed.iter().filter(|row| row.access.is_some()).collect();
    let bare =
        |row: &&Printed| row.access.is_none() && !printed.iter().any(|entry| entry.place == (row.place.0, Some(0)));
    let bare: Vec<usize> = printed.iter().filter(bare).map(|row| row.line).collect();
    assert_eq!(bare, Vec::<usize>::new(), "rows without access");
    let having = |access: Access| leaves.iter().filter(|row| row.access == Some(access)).count();
    assert_eq!((indices.len(), leaves.len()), (92, 204));
    let accesses = [Access::ReadWrite, Access::ReadOnly, Access::WriteOnly, Access::Constant].map(having);
    assert_eq!(accesses, [157, 39, 4, 4]);
    assert_eq!(leaves.iter().filter(|row| row.mappable).count(), 58);
    let mut sizes: BTreeMap<u32, usize> = BTreeMap::new();
    for row in &leaves {
        *sizes.entry(row.bytes.unwrap_or_else(|| panic!("line {}: no length", row.line))).or_default() += 1;
    }
    assert_eq!(sizes, BTreeMap::from([(1, 50), (2, 33), (4, 116), (6, 3), (14, 1), (18, 1)]));

    let mut wrong = Vec::new();
    for row in &leaves {
        let (index, sub) = row.place;
        let Some(item) = object(device, index, sub.unwrap_or(0)) else {
            wrong.push(format!("line {}: no object 0x{index:04X}:{sub:?}", row.line));
            continue;
        };
        let is_long = sub == Some(0) && LONG.contains(&index);
        let facts = [
            ("line", item_cites(item, row.line)),
            ("access", Some(item.access_on(Bus::CanOpen)) == row.access),
            ("mappable", item.mappable.any() == row.mappable),
            ("length", Some(bytes(device, item)) == row.bytes || is_long && !item.doubts.is_empty()),
        ];
        let missing: Vec<_> = facts.into_iter().filter(|(_, holds)| !holds).map(|(fact, _)| fact).collect();
        if !missing.is_empty() {
            wrong.push(format!("line {} {}: {missing:?}", row.line, item.name));
        }
    }
    for row in printed.iter().filter(|row| row.access.is_none()) {
        let group = device.object(row.place.0);
        if !group.is_some_and(|group| cites(group.documentation.as_deref(), row.line)) {
            wrong.push(format!("line {}: 0x{:04X}", row.line, row.place.0));
        }
    }
    assert_eq!(wrong, Vec::<String>::new());
    // The register table contains all printed CANopen objects, and four other objects, which exist only on EtherCAT.
    let all: BTreeSet<u16> = items(device).filter_map(|item| item.object()).map(|object| object.0).collect();
    assert_eq!(all.difference(&indices).copied().collect::<Vec<_>>(), [0x1C12, 0x1C13, 0x2007, 0x603F]);
    assert!(indices.is_subset(&all));
}

#[test]
fn what_only_ethercat_has_is_not_on_canopen() {
    let compilation = table();
    let device = device(&compilation);
    for (index, sub) in [(0x603F, 0), (0x2007, 0), (0x1C12, 1), (0x1C13, 1)] {
        let item = object(device, index, sub).expect("an object");
        let on = item.bindings.iter().find_map(|binding| match binding {
            Binding::Object { buses, .. } => Some(*buses),
            _ => None,
        });
        assert_eq!(on, Some(ObjectBuses::COE), "0x{index:04X}");
    }
}

/// Compares the lengths of the fields in the process images with the manual (section "Mappatura memoria condivisa"). Each field
/// must be within one group of eight bytes.
#[test]
fn images_are_the_printed_ones() {
    let Some(manual) = manual() else { return };
    let compilation = table();
    let device = device(&compilation);
    let fields = lines(&manual, 6077, 6139).filter_map(|(line, text)| {
        let (name, rest) = text.split_once(" (")?;
        let bytes: u32 = rest.split_once("B)")?.0.parse().ok()?;
        Some((line, name.to_owned(), bytes))
    });
    let fields: Vec<(usize, String, u32)> = fields.collect();
    assert_eq!(fields.len(), 18);
    let images = &device.process_data.images;
    assert_eq!(images.iter().map(|image| (image.length, image.fields.len())).collect::<Vec<_>>(), [(32, 10), (32, 8)]);
    assert!(images.iter().all(|entry| entry.big_endian));
    assert_eq!(
        images.iter().map(|image| image.direction).collect::<Vec<_>>(),
        [Direction::Receive, Direction::Transmit]
    );
    // The register table must contain each field length as often as the manual prints it.
    let sorted = |mut list: Vec<u32>| {
        list.sort_unstable();
        list
    };
    let actual = images.iter().flat_map(|image| &image.fields).map(|field| field.bits / 8).collect();
    assert_eq!(sorted(actual), sorted(fields.iter().map(|field| field.2).collect()));
    let unused: Vec<u32> = images
        .iter()
        .map(|image| image.length - image.fields.iter().map(|field| field.bits / 8).sum::<u32>())
        .collect();
    assert_eq!(unused, [1, 2 + 8]);
    for image in images {
        for field in &image.fields {
            assert_eq!(
                field.bit_offset / 64,
                (field.bit_offset + field.bits - 1) / 64,
                "{} is in one group",
                field.name
            );
        }
    }
}

/// A mapped object: index, sub-index and number of bits.
type Mapped = (u16, u8, u32);

#[test]
fn pdos_of_ethercat_are_the_printed_ones() {
    let Some(manual) = manual() else { return };
    let compilation = table();
    let device = device(&compilation);
    let mut printed: Vec<(u16, Vec<Mapped>)> = Vec::new();
    for (_, text) in lines(&manual, 5540, 5574) {
        let indices = hex_numbers(text, 4);
        if text.starts_with("oggetto 0x") {
            printed.push((indices[0] as u16, Vec::new()));
        } else if let (Some(index), Some((_, rest))) = (indices.first(), text.split_once('(')) {
            let bytes: u32 = rest[..1].parse().expect("bytes");
            let sub = text.rsplit("sub").next().and_then(|entry| entry[..1].parse().ok()).expect("a sub-index");
            printed.last_mut().expect("a PDO").1.push((*index as u16, sub, bytes * 8));
        }
    }
    assert_eq!((printed.len(), printed.iter().map(|row| row.1.len()).sum::<usize>()), (8, 15));
    let of_ethercat = |pdo: &&lexibus_codegen::ir::Pdo| pdo.buses == Some(ObjectBuses::COE);
    let pdos: Vec<_> = device.process_data.pdos.iter().filter(of_ethercat).collect();
    assert_eq!(pdos.len(), 8);
    for (index, entries) in &printed {
        let pdo = pdos.iter().find(|pdo| pdo.mapping_index == *index).expect("a PDO");
        let mut there: Vec<Mapped> = Vec::new();
        for entry in &pdo.entries {
            match entry.kind {
                // A mode of operation is one byte long, and a padding byte follows. The manual prints two bytes (item E3 of the notes
                // on the manual).
                PdoEntryKind::Padding => there.last_mut().expect("an entry").2 += entry.bits,
                _ => there.push((entry.index, entry.sub_index, entry.bits)),
            }
        }
        assert_eq!(there, *entries, "0x{index:04X}");
    }
    let assigned: Vec<u16> =
        pdos.iter().filter(|pdo| pdo.sync_manager.is_some()).map(|pdo| pdo.mapping_index).collect();
    assert_eq!(assigned, [0x1600, 0x1A02]);
    // PDOs on CANopen have the same indices, but the manual does not print their mappings.
    let canopen = device.process_data.pdos.iter().filter(|pdo| pdo.buses == Some(ObjectBuses::CANOPEN));
    assert!(canopen.clone().all(|pdo| pdo.entries.is_empty() && pdo.communication.is_some()));
    assert_eq!(canopen.count(), 8);
}

/// A printed slot of the ESI with its PDOs and their entries.
struct Slot {
    name: String,
    line: usize,
    pdos: Vec<(u16, Vec<Mapped>)>,
}

/// Compares the printed slots of the ESI: the mode of operation, one PDO in each direction, and the entries of these PDOs. The
/// slots are printed in section "PDO" of "Parametrizzazione EtherCAT per drive".
#[test]
fn slots_of_ethercat_are_the_printed_ones() {
    let Some(manual) = manual() else { return };
    let compilation = table();
    let device = device(&compilation);
    let mut printed: Vec<Slot> = Vec::new();
    let mut modes: BTreeMap<String, i128> = BTreeMap::new();
    for (line, text) in lines(&manual, 5598, 5649) {
        let indices = hex_numbers(text, 4);
        if let Some((name, value)) = text.strip_prefix("- 0x6060 per ").and_then(|rest| rest.split_once('=')) {
            modes.insert(name.trim().to_owned(), value.trim().parse().expect("a mode"));
        } else if let Some((name, _)) = text.strip_prefix("- ").and_then(|rest| rest.split_once(':')) {
            printed.push(Slot { name: name.to_owned(), line, pdos: Vec::new() });
        } else if text.starts_with("oggetto 0x") {
            printed.last_mut().expect("a slot").pdos.push((indices[0] as u16, Vec::new()));
        } else if let Some((_, rest)) = text.split_once('(') {
            let bytes: u32 = rest[..1].parse().expect("bytes");
            let sub = text.rsplit("sub").next().and_then(|entry| entry[..1].parse().ok()).expect("a sub-index");
            let pdo = printed.last_mut().and_then(|row| row.pdos.last_mut()).expect("a PDO");
            pdo.1.push((indices[0] as u16, sub, bytes * 8));
        }
    }
    assert_eq!((printed.len(), modes.len()), (3, 4));
    let slots = device.procedures.iter().filter(|procedure| procedure.name.starts_with("slot_"));
    assert_eq!(slots.clone().count(), 3);
    for (slot, Slot { name, line, pdos }) in slots.zip(&printed) {
        assert_eq!(slot.names.first().map(|name| name.text.as_str()), Some(name.as_str()), "line {line}");
        assert!(cites(slot.documentation.as_deref(), *line), "line {line}");
        let written = |item: &str| {
            let write = |step: &Step| match step {
                Step::Write(entry, value) if entry == item => value.as_int(),
                _ => None,
            };
            slot.steps.iter().filter_map(write).collect::<Vec<_>>()
        };
        assert_eq!(written("modes_of_operation"), [modes[name]], "line {line}");
        // The manual prints the TxPDO before the RxPDO.
        assert_eq!(pdos.len(), 2, "line {line}");
        for ((index, entries), assign) in pdos.iter().zip(["0x1C13", "0x1C12"]) {
            assert_eq!(written(&format!("{assign}:0")), [0, 1], "line {line}");
            assert_eq!(written(&format!("{assign}:1")), [i128::from(*index)], "line {line}");
            let is_it =
                |pdo: &&lexibus_codegen::ir::Pdo| pdo.mapping_index == *index && pdo.buses == Some(ObjectBuses::COE);
            let pdo = device.process_data.pdos.iter().find(is_it).expect("a PDO");
            let actual: Vec<Mapped> =
                pdo.entries.iter().map(|entry| (entry.index, entry.sub_index, entry.bits)).collect();
            assert_eq!(actual, *entries, "line {line} 0x{index:04X}");
        }
    }
}

/// Compares the SDO writes in the manual's examples with procedures and values of items.
#[test]
fn what_the_examples_write_can_be_written() {
    let Some(rows) = rows("pseudo_sdo") else { return };
    let compilation = table();
    let device = device(&compilation);
    let mut types: BTreeMap<String, usize> = BTreeMap::new();
    let mut reads = 0;
    for row in &rows {
        let numbers = row[1].replace(',', " ");
        let words: Vec<&str> = numbers.split_whitespace().collect();
        let after =
            |word: &str| words.iter().position(|entry| *entry == word).and_then(|at| words.get(at + 1)).copied();
        let index = u16::from_str_radix(after("object").expect("an object"), 16).expect("an index");
        let sub: u8 = after("sub").and_then(|message| message.parse().ok()).expect("a sub-index");
        let ty = after("value:").or(after("value")).expect("a type");
        let item = object(device, index, sub).unwrap_or_else(|| panic!("line {} 0x{index:04X}:{sub}", row[0]));
        assert_eq!(bytes(device, item) * 8, ty[1..].parse::<u32>().expect("bits"), "line {}", row[0]);
        let is_write = row[1].contains("write object");
        match is_write {
            true => *types.entry(ty.to_owned()).or_default() += 1,
            false => reads += 1,
        }
        assert!(
            if is_write { item.access_on(Bus::CanOpen).writable() } else { item.access.readable() },
            "line {}",
            row[0]
        );
    }
    assert_eq!((rows.len(), reads), (109, 3));
    let counts: Vec<(String, usize)> = types.into_iter().collect();
    let expected = [("i32", 5), ("i8", 6), ("u16", 48), ("u32", 22), ("u8", 25)];
    assert_eq!(counts, expected.map(|(ty, count)| (ty.to_owned(), count)));
}

#[test]
fn sequences_write_what_the_examples_write() {
    let Some(rows) = rows("pseudo_sdo") else { return };
    let compilation = table();
    let device = device(&compilation);
    let written = |name: &str| {
        let procedure = device.procedures.iter().find(|procedure| procedure.name == name).expect("a procedure");
        let writes = procedure.steps.iter().filter_map(|step| match step {
            Step::Write(item, value) => Some((item.to_string(), value.as_int().expect("a number"))),
            _ => None,
        });
        let place = |name: String| {
            let found = items(device).find(|item| item.name == name).and_then(|item| item.object());
            found.unwrap_or_else(|| {
                (u16::from_str_radix(&name[2..6], 16).expect("an index"), name[7..].parse().expect("a sub-index"))
            })
        };
        writes.map(|(name, value)| (place(name), value)).collect::<Vec<_>>()
    };
    let printed = |first: usize, last: usize| {
        let rows = rows.iter().filter(|row| {
            (first..=last).contains(&row[0].parse().expect("a line")) && row.len() > 2 && !row[2].is_empty()
        });
        rows.map(|row| {
            let bytes: Vec<u8> = row[2].split(' ').map(|byte| u8::from_str_radix(byte, 16).expect("a byte")).collect();
            let raw = i32::from_le_bytes([bytes[4], bytes[5], bytes[6], bytes[7]]);
            let is_signed = row[1].contains("i32") || row[1].contains("i8");
            let value = if is_signed { i128::from(raw) } else { i128::from(raw as u32) };
            ((u16::from_le_bytes([bytes[1], bytes[2]]), bytes[3]), value)
        })
        .collect::<Vec<_>>()
    };
    assert_eq!(written("enable"), printed(4284, 4289));
    assert_eq!(written("enable"), printed(4543, 4548));
    assert_eq!(written("disable"), printed(4252, 4252));
    assert_eq!(written("guard"), printed(4239, 4242));
    assert_eq!(written("stop_guarding"), printed(4245, 4246));
    assert_eq!(written("home_by_402"), [printed(4258, 4275), printed(4299, 4300)].concat());
    assert_eq!(written("position_by_402"), [printed(4305, 4318), printed(4336, 4340)].concat());
    assert_eq!(written("velocity_by_402"), [printed(4354, 4364), printed(4377, 4377)].concat());
    assert_eq!(written("save_on_canopen"), printed(4383, 4397));
    // The manual prints the second entry of the TPDO with the sub-index of the first entry (item D7 of the notes on the manual).
    let mut mapping = [printed(4423, 4427), printed(4439, 4443)].concat();
    assert_eq!(mapping[8].0, (0x1A00, 1));
    mapping[8].0 = (0x1A00, 2);
    assert_eq!(written("map_interpolator"), mapping);
    assert_eq!(written("interpolate"), [printed(4410, 4417), printed(4462, 4462)].concat());
}
