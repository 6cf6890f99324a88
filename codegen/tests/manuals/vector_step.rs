//! Compares the register table of the AEC Vector Step with the text of its manual. Each printed row must be in the register table
//! once, cite its line, and have the properties in the printed cells. Each deliberate difference must have a `doubt` entry.

use crate::manual_text;

use std::collections::BTreeMap;
use std::path::Path;

use lexibus_codegen::compile::{self, Compilation, Options};
use lexibus_codegen::ir::{Access, Binding, Catalog, Device, Group, GroupKind, Item, Shape, Storage, Type, TypeId};
use lexibus_codegen::source::Source;

fn table() -> Compilation {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../dictionaries/aec-vector-step.toml");
    compile::check(Source::read(&path).expect("the table"), &Options::default())
}

fn manual() -> Option<Vec<String>> {
    Some(manual_text::text("aec-vector-step-canopen.it.txt")?.lines().map(str::to_owned).collect())
}

fn device(compilation: &Compilation) -> &Device {
    &compilation.catalog.as_ref().expect("a catalog").devices[0]
}

fn chapters(device: &Device) -> impl Iterator<Item = &Group> {
    device.groups.iter().filter(|group| matches!(group.kind, GroupKind::Chapter))
}

fn registers(device: &Device) -> impl Iterator<Item = &Item> {
    chapters(device).flat_map(|group| &group.items)
}

/// Returns the manual line that describes an item: the first line that the item cites.
fn line(item: &Item) -> Option<usize> {
    let cite = item.documentation.as_ref()?.cite.as_deref()?;
    cite.split([',', '-']).next()?.trim().parse().ok()
}

/// Returns the register address of an item, from its Modbus register or its object index.
fn number(item: &Item) -> Option<u16> {
    item.bindings.iter().find_map(|binding| match binding {
        Binding::Register(register) => Some(register.address),
        Binding::Object { index, .. } => index.checked_sub(0x2000),
        _ => None,
    })
}

fn base(device: &Device, ty: Type) -> Type {
    let Type::Named(TypeId(id)) = ty else { return ty };
    match &device.types[id as usize].shape {
        Shape::BitField { base, .. } | Shape::Enumeration { base, .. } => *base,
        Shape::Array { element, .. } => *element,
        _ => ty,
    }
}

/// A row of the manual's register tables.
struct Printed<'m> {
    line: usize,
    first: u16,
    cells: Vec<&'m str>,
}

/// Returns the rows of all register tables. A row starts with an address or a range of addresses. The second cell is
/// empty or contains an object index.
fn printed(manual: &[String]) -> Vec<Printed<'_>> {
    let mut rows = Vec::new();
    for (position, line) in manual.iter().enumerate() {
        let cells: Vec<&str> = line.split('\t').map(str::trim).collect();
        let number = cells[0].split('-').next().unwrap_or_default();
        let is_number = number.len() >= 4 && number.bytes().all(|digit| digit.is_ascii_digit());
        let has_index = cells.get(1).is_some_and(|cell| cell.is_empty() || cell.to_lowercase().starts_with("0x"));
        if is_number && has_index && cells.len() >= 6 {
            rows.push(Printed { line: position + 1, first: number.parse().expect("a number"), cells });
        }
    }
    rows
}

#[test]
fn the_table_has_no_findings() {
    let compilation = table();
    let found: Vec<String> = compilation.diagnostics.list().iter().map(|found| compilation.one_line(found)).collect();
    assert_eq!(found, Vec::<String>::new());
}

#[test]
fn every_printed_row_is_there_at_its_line() {
    let Some(manual) = manual() else { return };
    let compilation = table();
    let device = device(&compilation);
    let printed = printed(&manual);
    let by_line: BTreeMap<usize, &Item> = registers(device).filter_map(|item| Some((line(item)?, item))).collect();
    assert_eq!(printed.len(), 586, "rows of the manual");
    assert_eq!(registers(device).count(), 585, "10104-5 is printed twice");
    let mut wrong = Vec::new();
    for row in &printed {
        // The manual prints this row a second time, with a truncated description.
        if row.line == 2981 {
            continue;
        }
        let Some(item) = by_line.get(&row.line) else {
            wrong.push(format!("line {}: no row", row.line));
            continue;
        };
        let letters = |text: &str| text.chars().filter(|c| c.is_alphanumeric()).collect::<String>().to_lowercase();
        let same_name = letters(&item.name).starts_with(&letters(row.cells[2])) || !item.doubts.is_empty();
        let is_double = row.cells[0].contains('-');
        let bits = base(device, item.ty).bits();
        let same_length = (bits == Some(32)) == is_double || row.first == 2011;
        if number(item) != Some(row.first) || !same_length || !same_name {
            wrong.push(format!("line {}: {} at {:?}, {bits:?} bits", row.line, item.name, number(item)));
        }
    }
    assert_eq!(wrong, Vec::<String>::new());
}

#[test]
fn types_access_mapping_and_saving_are_the_printed_ones() {
    let Some(manual) = manual() else { return };
    let compilation = table();
    let device = device(&compilation);
    let by_number: BTreeMap<u16, &Item> = registers(device).filter_map(|item| Some((number(item)?, item))).collect();
    let mut wrong = Vec::new();
    for row in printed(&manual) {
        let Some(item) = by_number.get(&row.first) else { continue };
        let all = row.cells[3..].join(" ").to_uppercase();
        let words = row.cells.last().unwrap_or(&"").to_uppercase().replace(['-', '_'], " ");
        let says = |word: &str| words.split_whitespace().any(|entry| entry == word);
        let ty = [("SIGNED16", 16), ("SIGNED32", 32), ("UNSIGNED16", 16), ("UNSIGNED32", 32)];
        let printed_bits = ty.iter().find(|(name, _)| all.contains(name)).map(|&(_, bits)| bits);
        let type_bits = base(device, item.ty).bits();
        let mut facts = vec![
            ("RO", !says("RO") || says("RW") || item.access == Access::ReadOnly),
            ("WO", !says("WO") || item.access == Access::WriteOnly),
            ("NO MAP", !words.contains("NO MAP") || !item.mappable.any()),
            ("MAP READ", !words.contains("MAP READ") || item.mappable.tpdo),
            ("MAP WRITE", !words.contains("MAP WRITE") || item.mappable.rpdo),
        ];
        let storage = item.behavior.as_ref().map(|behavior| &behavior.storage);
        let is_saved = matches!(storage, Some(Storage::OnCommand(_) | Storage::Immediate));
        facts.push(("SAVE", !says("SAVE") || is_saved));
        facts.push(("type", printed_bits.is_none() || type_bits == printed_bits || row.first == 2011));
        let missing: Vec<_> = facts.into_iter().filter(|(_, holds)| !holds).map(|(fact, _)| fact).collect();
        if !missing.is_empty() && item.doubts.is_empty() {
            wrong.push(format!("line {} {}: {missing:?}", row.line, item.name));
        }
    }
    assert_eq!(wrong, Vec::<String>::new());
}

/// Number of rows in each chapter, according to section 3.2 of the notes on the manual.
const CHAPTERS: [usize; 36] = [
    7, 3, 3, 19, 9, 14, 3, 2, 4, 2, 45, 45, 25, 4, 16, 26, 1, 29, 5, 11, 90, 8, 9, 17, 69, 4, 5, 26, 4, 8, 15, 16, 2,
    10, 9, 20,
];

#[test]
fn chapters_and_objects_are_complete() {
    let compilation = table();
    let device = device(&compilation);
    let counts: Vec<usize> = chapters(device).map(|group| group.items.len()).filter(|&count| count > 0).collect();
    assert_eq!(counts, CHAPTERS);
    let objects = |first: u16, last: u16| {
        let in_range = move |group: &&Group| group.index().is_some_and(|index| (first..=last).contains(&index));
        let groups: Vec<&Group> = device.groups.iter().filter(in_range).collect();
        (groups.len(), groups.iter().map(|group| group.items.len()).sum::<usize>())
    };
    assert_eq!(objects(0x1000, 0x1FFF), (33, 135), "DS-301");
    // The count includes the 55 described entries, and five entries with sub-index 0 that the manual's boxes omit.
    assert_eq!(objects(0x6000, 0x67FF), (44, 60), "DSP-402");
    assert_eq!(objects(0x23E8, 0x23E8), (1, 7), "user variables");
    let saved = registers(device).filter_map(|item| item.behavior.as_ref());
    assert_eq!(saved.filter(|entry| matches!(entry.storage, Storage::OnCommand(_) | Storage::Immediate)).count(), 319);
    let codes: BTreeMap<&str, usize> =
        device.code_tables.iter().map(|table| (table.name.as_str(), table.rows.len())).collect();
    assert_eq!(codes["emergency"], 19);
    assert_eq!((device.machines[0].states.len(), device.machines[0].commands.len()), (8, 7));
    assert_eq!(device.machines[0].transitions.len(), 16);
    let of_registers = |name: &str| device.types.iter().find(|def| def.name == name).expect("a type");
    let Shape::Enumeration { values, .. } = &of_registers("HomingMethod").shape else { panic!("homing methods") };
    assert_eq!(values.len(), 19);
    let of_device = lexibus_codegen::facts::doubts::of_device(&Catalog::default(), device).len();
    assert!(of_device + registers(device).map(|item| item.doubts.len()).sum::<usize>() > 200);
}
