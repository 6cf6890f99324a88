//! Compares the register table of the Kollmorgen AKD with the text of its manual. Each printed row must be in the register table,
//! cite its line, and have the properties in the printed cells. Each deliberate difference must have a `doubt` entry.

use crate::manual_text;

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use lexibus_codegen::compile::{self, Compilation, Options};
use lexibus_codegen::ir::{
    Access, Binding, BitFieldEntry, BitMeaning, Device, Direction, Documentation, EnumValue, Item, MessageField,
    Pattern, Pdo, PdoEntryKind, Shape, StateMachine, Step, Type, Value,
};
use lexibus_codegen::source::Source;

fn table() -> Compilation {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../dictionaries/kollmorgen-akd.toml");
    let options = Options { no_profiles: true, ..Options::default() };
    compile::check(Source::read(&path).expect("the table"), &options)
}

fn manual() -> Option<Vec<String>> {
    Some(manual_text::text("kollmorgen-akd-ethercat.it.txt")?.lines().map(str::to_owned).collect())
}

fn device(compilation: &Compilation) -> &Device {
    &compilation.catalog.as_ref().expect("a catalog").devices[0]
}

/// Returns the cells of the manual's lines from `first` to `last`, each with its line number.
fn rows(manual: &[String], first: usize, last: usize) -> Vec<(usize, Vec<&str>)> {
    (first..=last).map(|line| (line, manual[line - 1].split('\t').map(str::trim).collect())).collect()
}

/// Returns the manual lines that the documentation cites.
fn cited(documentation: Option<&Documentation>) -> BTreeSet<usize> {
    let cite = documentation.and_then(|documentation| documentation.cite.as_deref()).unwrap_or_default();
    let mut lines = BTreeSet::new();
    for part in cite.split(',').map(str::trim) {
        let mut ends = part.split('-').filter_map(|end| end.parse::<usize>().ok());
        if let Some(first) = ends.next() {
            lines.extend(first..=ends.next().unwrap_or(first));
        }
    }
    lines
}

fn item<'d>(device: &'d Device, name: &str) -> &'d Item {
    let mut items = device.groups.iter().flat_map(|group| &group.items);
    items.find(|item| item.name == name).unwrap_or_else(|| panic!("no item {name}"))
}

fn fields<'d>(device: &'d Device, name: &str) -> &'d [BitFieldEntry] {
    let found =
        device.types.iter().find(|definition| definition.name == name).unwrap_or_else(|| panic!("no type {name}"));
    let Shape::BitField { fields, .. } = &found.shape else { panic!("{name} is not a bit field") };
    fields
}

fn values<'d>(device: &'d Device, name: &str) -> &'d [EnumValue] {
    let found =
        device.types.iter().find(|definition| definition.name == name).unwrap_or_else(|| panic!("no type {name}"));
    let Shape::Enumeration { values, .. } = &found.shape else { panic!("{name} is not an enumeration") };
    values
}

/// Parses a hexadecimal number with an optional prefix `0x` or suffix `h`: `0x204`, `2050`, `6060h`.
fn hex(text: &str) -> u32 {
    let digits = text.trim().trim_start_matches("0x").trim_start_matches("0X").trim_end_matches('h');
    u32::from_str_radix(digits, 16).unwrap_or_else(|_| panic!("{text} is not a number"))
}

/// Parses a bit range such as `Da 3 a 0`, `0..7`, `5-7` or `4`. Returns the first bit and the number of bits.
fn bits(text: &str) -> (u8, u8) {
    let numbers: Vec<u8> =
        text.split(|c: char| !c.is_ascii_digit()).filter(|part| !part.is_empty()).map(|n| n.parse().unwrap()).collect();
    let (low, high) = (numbers.iter().min().expect("a bit"), numbers.iter().max().expect("a bit"));
    (*low, high - low + 1)
}

#[test]
fn the_table_has_no_findings() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../dictionaries/kollmorgen-akd.toml");
    let compilation = compile::check(Source::read(&path).expect("the table"), &Options::default());
    let found: Vec<String> = compilation.diagnostics.list().iter().map(|found| compilation.one_line(found)).collect();
    assert_eq!(found, Vec::<String>::new());
}

/// Compares the manual's table of hardware revisions with the register table. Each revision must be a model whose
/// documentation lists the software versions.
#[test]
fn revisions_of_the_hardware() {
    let Some(manual) = manual() else { return };
    let compilation = table();
    let printed = rows(&manual, 34, 36);
    let models = &device(&compilation).variants;
    assert_eq!((printed.len(), models.len()), (3, 3));
    for ((line, cells), model) in printed.iter().zip(models) {
        assert_eq!(model.name, format!("revision {}", cells[0]), "line {line}");
        assert!(cited(model.documentation.as_deref()).contains(line), "line {line}");
        let text = model.documentation.as_ref().map_or("", |documentation| &*documentation.text);
        // The letters in `01.06.xx.yyy` and `1.6.0.zzzzz` are placeholders.
        let version = |cell: &str| {
            cell.split(".x").next().and_then(|entry| entry.split(".z").next()).unwrap_or_default().to_owned()
        };
        for (name, cell) in [("firmware", cells[2]), ("WorkBench", cells[3]), ("KAS IDE", cells[4])] {
            let shown = format!("{name} {}", version(cell)).to_lowercase();
            assert_eq!(text.to_lowercase().contains(&shown), cell != "-", "line {line} {shown}");
        }
        let is_pdmm = text.contains(&format!("called {} on AKD PDMM", cells[1]));
        assert_eq!(is_pdmm, cells[1] != "-", "line {line}");
    }
}

#[test]
fn registers_of_the_slave_controller() {
    let Some(manual) = manual() else { return };
    let compilation = table();
    let device = device(&compilation);
    let items: Vec<&Item> = device.groups.iter().flat_map(|group| &group.items).collect();
    let access = |cell: &str| match cell {
        "R/W" => Access::ReadWrite,
        "R/O" => Access::ReadOnly,
        other => panic!("{other}"),
    };
    let printed = rows(&manual, 533, 550);
    for (line, cells) in &printed {
        let item = items.iter().find(|item| cited(item.documentation.as_deref()).contains(line));
        let actual = item.unwrap_or_else(|| panic!("line {line} has no row"));
        let length = cells[1].trim_start_matches("Massimo ").parse().expect("a length");
        let address = hex(cells[0]) as u16;
        assert_eq!(actual.bindings.as_slice(), [Binding::EscMemory { address, length }], "line {line}");
        let pdi = actual.behavior.as_ref().and_then(|behavior| behavior.pdi_access);
        assert_eq!((actual.access, pdi), (access(cells[3]), Some(access(cells[4]))), "line {line}");
        let named = actual.names.iter().find(|name| name.language == "it").expect("a name in Italian");
        assert!(cells[2].starts_with(named.text.as_str()), "line {line}: {}", named.text);
    }
    let in_memory = |item: &&&Item| item.bindings.iter().any(|binding| matches!(binding, Binding::EscMemory { .. }));
    assert_eq!((printed.len(), items.iter().filter(in_memory).count()), (18, 18));
}

/// Misprinted lines in the manual's bit tables: line number, text of the printed cell, and the correct first bit and number of
/// bits.
const CORRECTED: [(usize, &str, (u8, u8)); 4] =
    [(573, "Da 3 a 7", (6, 2)), (593, "0x201", (10, 1)), (594, "0x201", (11, 1)), (596, "SyncManager 7", (12, 4))];

/// Compares a bit field with printed rows, which contain a parameter, an address and bits. Returns the number of compared rows.
fn table_of_bits(manual: &[String], device: &Device, name: &str, first: usize, last: usize, base: u32) -> usize {
    let fields = fields(device, name);
    let mut held = 0;
    for (line, cells) in rows(manual, first, last) {
        // Skip additional values of the previous field, incomplete names, and bits outside the register.
        if cells[0].starts_with("0x") || [595, 597, 598].contains(&line) {
            continue;
        }
        let place = match CORRECTED.iter().find(|(corrected, ..)| *corrected == line) {
            Some((_, printed, place)) => {
                assert!(cells.iter().any(|cell| cell.contains(printed)), "line {line}");
                *place
            }
            None => {
                let (low, count) = bits(cells[2]);
                ((hex(cells[1]) - base) as u8 * 8 + low, count)
            }
        };
        let entry = fields.iter().find(|entry| cited(entry.documentation.as_deref()).contains(&line));
        let entry = entry.unwrap_or_else(|| panic!("line {line}: {name} has no field"));
        assert_eq!((entry.offset, entry.bits), place, "line {line}");
        let is_reserved = matches!(entry.meaning, BitMeaning::Reserved { .. });
        let says_so = cells[0] == "Riserva" || cells.last().is_some_and(|cell| *cell == "Riserva");
        assert_eq!(is_reserved, says_so, "line {line}");
        held += 1;
    }
    held
}

#[test]
fn bits_of_the_registers() {
    let Some(manual) = manual() else { return };
    let compilation = table();
    let device = device(&compilation);
    assert_eq!(table_of_bits(&manual, device, "InterruptEnable", 567, 578, 0x204), 12);
    // The manual's table has twelve rows. The last row describes bits outside the register, and bit 1 has no row.
    assert_eq!(table_of_bits(&manual, device, "AlEventRequest", 585, 598, 0x220), 11);
    assert_eq!(fields(device, "AlEventRequest").len(), 12);
    assert_eq!(table_of_bits(&manual, device, "AlControl", 609, 616, 0x120), 4);
    assert_eq!(table_of_bits(&manual, device, "AlStatus", 621, 628, 0x130), 4);
    let states = values(device, "CommunicationState");
    for (first, last) in [(609, 613), (621, 625)] {
        let printed = rows(&manual, first, last);
        let number = |cells: &[&str]| {
            let cell = cells.iter().find(|cell| cell.contains(": ")).expect("a value");
            i128::from(hex(cell.split(':').next().unwrap()))
        };
        let found: Vec<_> = printed.iter().map(|(line, cells)| (*line, number(cells))).collect();
        let states: Vec<_> = states
            .iter()
            .map(|value| (*cited(value.documentation.as_deref()).range(first..=last).next().unwrap(), value.value))
            .collect();
        assert_eq!(states, found);
    }
    for name in ["InterruptEnable", "AlEventRequest", "AlControl", "AlStatus", "ControlWord", "StatusWord"] {
        let all = fields(device, name).iter().fold(0u32, |all, entry| all | ((1 << entry.bits) - 1) << entry.offset);
        assert_eq!(all, 0xFFFF, "{name}");
    }
}

#[test]
fn status_codes_and_transitions_of_the_communication() {
    let Some(manual) = manual() else { return };
    let compilation = table();
    let device = device(&compilation);
    let codes = device.code_tables.iter().find(|table| table.name == "al_status").expect("the codes");
    let named = values(device, "AlStatusCode");
    let printed = rows(&manual, 637, 639);
    assert_eq!((codes.rows.len(), named.len(), printed.len()), (3, 3, 3));
    for ((row, value), (line, cells)) in codes.rows.iter().zip(named).zip(&printed) {
        assert_eq!((row.code, value.value), (hex(cells[0]).into(), hex(cells[0]).into()), "line {line}");
        let changes = |text: &str| text.replace("->", "to").replace("Tutti", "all");
        assert_eq!(row.cells[0], Value::Text(changes(cells[2]).into()), "line {line}");
        let result = cells[3].replace("Stato corrente", "current").replace("+ E", "and error");
        assert_eq!(row.cells[1], Value::Text(result.into()), "line {line}");
    }
    assert!(device.types.iter().any(|definition| matches!(definition.shape, Shape::Enumeration { closed: true, .. })));
    let machine = device.machines.iter().find(|machine| machine.name == "al").expect("the machine");
    let letter = |letter: char| match letter {
        'I' => "init",
        'P' => "pre_operational",
        'B' => "bootstrap",
        'S' => "safe_operational",
        'O' => "operational",
        other => panic!("{other}"),
    };
    let printed = rows(&manual, 649, 659);
    assert_eq!((machine.transitions.len(), printed.len()), (11, 11));
    for (item, (line, cells)) in machine.transitions.iter().zip(&printed) {
        let letters: Vec<char> = cells[0].chars().filter(|c| c.is_ascii_alphabetic()).collect();
        assert_eq!(
            (item.from.as_ref().map(|from| from.as_str()), item.to.as_str()),
            (Some(letter(letters[0])), letter(letters[1])),
            "line {line}"
        );
        let command = item.command.as_deref().expect("a command");
        let value = machine.commands.iter().find(|entry| entry.name == command).expect("its pattern").value;
        // Line 650 (from bootstrap to init) contains no printed value. The expected value is 1, which is the value for the state
        // init.
        let expected = if *line == 650 { 1 } else { hex(cells[1]) };
        assert_eq!((value, cited(item.documentation.as_deref()).contains(line)), (expected, true), "line {line}");
    }
}

/// Returns the mask and value of cells that contain `0`, `1` or `X`. `over` lists the bit number of each cell.
fn pattern(cells: &[&str], over: &[u32]) -> (u32, u32) {
    cells.iter().zip(over).fold((0, 0), |(mask, value), (cell, bit)| match *cell {
        "0" => (mask | 1 << bit, value),
        "1" => (mask | 1 << bit, value | 1 << bit),
        "X" => (mask, value),
        other => panic!("{other}"),
    })
}

fn at_line(patterns: &[Pattern], line: usize) -> &Pattern {
    let found = patterns.iter().find(|pattern| cited(pattern.documentation.as_deref()).contains(&line));
    found.unwrap_or_else(|| panic!("line {line} has no pattern"))
}

fn numbers(machine: &StateMachine, command: &str) -> BTreeSet<u16> {
    let transitions = machine
        .transitions
        .iter()
        .filter(|transition| transition.command.as_ref().is_some_and(|name| *name == *command));
    transitions.filter_map(|entry| entry.number).collect()
}

#[test]
fn the_drives_state_machine() {
    let Some(manual) = manual() else { return };
    let compilation = table();
    let device = device(&compilation);
    let machine = device.machines.iter().find(|machine| machine.name == "drive").expect("the machine");
    assert_eq!((machine.states.len(), machine.commands.len()), (8, 7));
    for (line, cells) in rows(&manual, 743, 750) {
        let states = at_line(&machine.states, line);
        assert_eq!((states.mask, states.value), pattern(&cells[1..7], &[6, 5, 3, 2, 1, 0]), "line {line}");
    }
    for (line, cells) in rows(&manual, 696, 702) {
        let commands = at_line(&machine.commands, line);
        assert_eq!((commands.mask, commands.value), pattern(&cells[1..6], &[7, 3, 2, 1, 0]), "line {line}");
        let printed: BTreeSet<u16> = cells[6].split(',').map(|number| number.trim().parse().unwrap()).collect();
        assert_eq!(numbers(machine, &commands.name), printed, "line {line}");
    }
    for line in 670..=677 {
        at_line(&machine.states, line);
    }
    let (words, last) = ([("ControlWord", 684), ("StatusWord", 731)], 7);
    for (name, first) in words {
        let fields = fields(device, name);
        for (line, cells) in rows(&manual, first, first + last) {
            for pair in cells.chunks(2) {
                let bit: u8 = pair[0].parse().expect("a bit");
                let contains_bit = |entry: &&BitFieldEntry| (entry.offset..entry.offset + entry.bits).contains(&bit);
                let found: Vec<_> = fields.iter().filter(contains_bit).collect();
                assert!(!found.is_empty(), "line {line} {bit}");
                let cites = |entry: &&BitFieldEntry| cited(entry.documentation.as_deref()).contains(&line);
                let by_mode = pair[1].contains("Modalità di funzionamento specifica") && name == "ControlWord";
                assert!(by_mode || found.iter().any(cites), "line {line} {bit}");
                let says_so =
                    pair[1].contains("iserva") || pair[1].contains("sempre 1") || pair[1].contains("produttore");
                let is_reserved = found.iter().all(|entry| matches!(entry.meaning, BitMeaning::Reserved { .. }));
                assert!(by_mode || is_reserved == says_so, "line {line} {bit}");
            }
        }
    }
    modes(&manual, device);
}

/// Compares bits 4, 5 and 6 of the control word in each mode of operation with the manual.
fn modes(manual: &[String], device: &Device) {
    let named = values(device, "ModesOfOperation");
    let printed = rows(manual, 711, 716);
    assert_eq!((named.len(), printed.len()), (6, 6));
    for (line, cells) in printed {
        let mode = Value::Int(hex(cells[1]).into());
        assert!(named.iter().any(|entry| Value::Int(entry.value) == mode), "line {line}");
        for (cell, bit) in cells[2..5].iter().zip(4u8..) {
            let fields = fields(device, "ControlWord").iter().filter(|field| field.offset == bit);
            let mut values = fields.filter(|entry| entry.when.as_ref().is_some_and(|when| when.values.contains(&mode)));
            match (*cell, values.next().map(|entry| &entry.meaning)) {
                ("", None) | ("riserva", Some(BitMeaning::Reserved { .. })) => {}
                (name, Some(meaning)) if !name.is_empty() && name != "riserva" => {
                    assert!(!matches!(meaning, BitMeaning::Reserved { .. }), "line {line} {bit}");
                }
                other => panic!("line {line} bit {bit}: {other:?}"),
            }
        }
    }
}

/// Returns the printed rows of the cyclic values: line, name, object and type.
fn cyclic(manual: &[String]) -> Vec<(usize, String, (u16, u8), Type)> {
    let both = rows(manual, 982, 987).into_iter().chain(rows(manual, 992, 1001));
    both.map(|(line, cells)| {
        let (index, sub) = cells[1].split_once(" sottoindice ").expect("an object");
        let (kind, bits) = cells[2].split_at(cells[2].find(|c: char| c.is_ascii_digit()).expect("a width"));
        let bits: u8 = bits.parse().expect("a width");
        let ty = if kind == "INT" { Type::Integer(bits) } else { Type::Unsigned(bits) };
        (line, cells[0].to_lowercase(), (hex(index) as u16, sub.parse().expect("a sub-index")), ty)
    })
    .collect()
}

fn basic(device: &Device, ty: Type) -> Type {
    let Type::Named(id) = ty else { return ty };
    match &device.types[id.0 as usize].shape {
        Shape::BitField { base, .. } | Shape::Enumeration { base, .. } => *base,
        _ => ty,
    }
}

#[test]
fn cyclic_values() {
    let Some(manual) = manual() else { return };
    let compilation = table();
    let device = device(&compilation);
    let printed = cyclic(&manual);
    assert_eq!(printed.len(), 16);
    for (line, _, (index, sub), ty) in printed {
        let actual = device.entry(index, sub).unwrap_or_else(|| panic!("line {line}: no 0x{index:04X}:{sub}"));
        assert_eq!(basic(device, actual.ty), ty, "line {line}");
        assert!(cited(actual.documentation.as_deref()).contains(&line), "line {line}");
        let receives = (982..=987).contains(&line);
        assert_eq!((actual.mappable.rpdo, actual.mappable.tpdo), (receives, !receives), "line {line}");
    }
}

/// Returns the names and bit lengths of the entries in a printed mapping, and the printed total length in bytes, if any.
fn printed_entries(text: &str) -> (Vec<(String, u32)>, Option<u32>) {
    let (mut entries, mut total) = (Vec::new(), None);
    for part in text.split("),") {
        let Some((name, bytes)) = part.split_once('(') else { continue };
        let bytes: u32 = bytes.chars().take_while(char::is_ascii_digit).collect::<String>().parse().expect("bytes");
        let name = name.trim().trim_start_matches(',').trim().to_lowercase();
        match name.as_str() {
            "totale" | "total" => total = Some(bytes),
            _ => entries.push((name, bytes * 8)),
        }
    }
    (entries, total)
}

fn pdo(device: &Device, index: u16) -> &Pdo {
    let found = device.process_data.pdos.iter().find(|pdo| pdo.mapping_index == index);
    found.unwrap_or_else(|| panic!("no PDO 0x{index:04X}"))
}

#[test]
fn fixed_mappings() {
    let Some(manual) = manual() else { return };
    let compilation = table();
    let device = device(&compilation);
    let objects: BTreeMap<String, (u16, u8)> =
        cyclic(&manual).into_iter().map(|(_, name, object, _)| (name, object)).collect();
    let lines = (780..=791).chain(795..=796).chain([800]);
    // Each printed name must have the same object in all mappings.
    let mut names: BTreeMap<String, (u16, u8, String)> = BTreeMap::new();
    let (mut mappings, mut entries) = ([0, 0], [0, 0]);
    for (line, cells) in lines.flat_map(|line| rows(&manual, line, line)) {
        let actual = pdo(device, hex(cells[0]) as u16);
        let (printed, total) = printed_entries(cells[1]);
        let bits: Vec<u32> = printed.iter().map(|(_, bits)| *bits).collect();
        assert_eq!(actual.entries.iter().map(|entry| entry.bits).collect::<Vec<_>>(), bits, "line {line}");
        assert!(total.is_none_or(|bytes| bytes * 8 == actual.bits()), "line {line}");
        assert!(actual.fixed && cited(actual.documentation.as_deref()).contains(&line), "line {line}");
        for (entry, (name, _)) in actual.entries.iter().zip(&printed) {
            if let Some(object) = objects.get(name) {
                assert_eq!((entry.index, entry.sub_index), *object, "line {line}: {name}");
            }
            let meaning = (entry.index, entry.sub_index, entry.name.to_string());
            assert_eq!(*names.entry(name.clone()).or_insert(meaning.clone()), meaning, "line {line}: {name}");
            assert_eq!(entry.kind == PdoEntryKind::Unnumbered, entry.index == 0, "line {line}: {name}");
        }
        let direction = usize::from(actual.direction == Direction::Transmit);
        mappings[direction] += 1;
        entries[direction] += printed.len();
    }
    assert_eq!((mappings, entries), ([8, 7], [29, 38]));
    assert_eq!(names.len(), 25, "{names:#?}");
    assert_eq!(names.keys().filter(|name| objects.contains_key(*name)).count(), 7);
    assert_eq!(device.process_data.pdos.iter().filter(|pdo| pdo.fixed).count(), 15);
    assert_eq!(names.values().filter(|(index, ..)| *index == 0).count(), 7);
}

#[test]
fn what_the_tool_shows_of_pdos() {
    let Some(manual) = manual() else { return };
    let compilation = table();
    let device = device(&compilation);
    let cells = |line: usize| -> Vec<&str> { manual[line - 1].split('\t').map(str::trim).collect() };
    for (first, last) in [(832, 842), (870, 880)] {
        for line in first..=last {
            let row = cells(line);
            let actual = pdo(device, hex(row[0]) as u16);
            assert_eq!(format!("{}.0", actual.bytes()), row[1], "line {line}");
            assert_eq!(
                (actual.direction == Direction::Receive, actual.fixed),
                (row[2] == "Outputs", row[3] == "F"),
                "line {line}"
            );
            let assigned = row.get(4).and_then(|cell| cell.parse::<u8>().ok());
            assert_eq!(actual.sync_manager, assigned, "line {line}");
            assert!(cited(actual.documentation.as_deref()).contains(&line), "line {line}");
        }
    }
    for (first, last) in [(826, 829), (863, 866)] {
        for line in first..=last {
            let row = cells(line);
            let number: u8 = row[0].parse().expect("a number");
            let sync_managers = &device.process_data.sync_managers[usize::from(number)];
            assert_eq!(
                (sync_managers.number, sync_managers.default_size),
                (number, row[1].parse().ok()),
                "line {line}"
            );
            let purpose = [("MbxOut", 0), ("MbxIn", 1), ("Outputs", 2), ("Inputs", 3)];
            assert!(purpose.contains(&(row[2], number)), "line {line}");
        }
    }
    let excluded = |line: usize| manual[line - 1].contains("(excluded by 0x1701)");
    for line in (844..=850).chain(882..=889) {
        let index = hex(manual[line - 1].split("0x").nth(1).expect("an index").get(..4).expect("four digits")) as u16;
        if index != 0x1704 {
            assert_eq!(
                pdo(device, 0x1701).conflicts_with(pdo(device, index)),
                excluded(line) || index == 0x1701,
                "line {line}"
            );
        }
    }
}

#[test]
fn the_start_up_list() {
    let Some(manual) = manual() else { return };
    let compilation = table();
    let device = device(&compilation);
    let list = device.procedures.iter().find(|procedure| procedure.name == "free_mapping").expect("the list");
    let printed = rows(&manual, 924, 946);
    assert_eq!((list.steps.len(), printed.len()), (23, 23));
    let object = |name: &str| match name {
        "Modes of operation" => (0x6060, 0),
        other => {
            let (index, sub) = other.split_once(':').expect("an object");
            (hex(index), hex(sub))
        }
    };
    for (step, (line, cells)) in list.steps.iter().zip(&printed) {
        let Step::Write(name, value) = step else { panic!("line {line}: {step:?}") };
        let (index, sub) = cells[2].split_once(':').expect("an object");
        assert_eq!(object(name), (hex(index), hex(sub)), "line {line}");
        let (number, decimal) = cells[3].split_once(' ').expect("two numbers");
        let number = hex(number);
        assert_eq!(decimal.trim_matches(['(', ')']).parse(), Ok(number), "line {line}");
        // In line 942, the manual assigns the fixed PDO 0x1B01, although its example configures the mapping 0x1A00.
        let expected = if *line == 942 { 0x1A00 } else { number };
        assert_eq!(*value, Value::Int(expected.into()), "line {line}");
    }
    assert_eq!(hex(printed[18].1[3].split(' ').next().unwrap()), 0x1B01);
    let fixed = device.procedures.iter().find(|procedure| procedure.name == "assign_1701").expect("the sequence");
    for (step, line) in fixed.steps.iter().zip(772..=774) {
        let Step::Write(name, Value::Int(value)) = step else { panic!("{step:?}") };
        let text = &manual[line - 1];
        let sub = name.split_once(':').expect("a sub-index").1;
        assert!(text.contains(&format!("0x1C12 sottoindice {sub} ")), "line {line}");
        assert_eq!(i128::from(hex(text.rsplit("0x").next().unwrap())), *value, "line {line}");
    }
}

#[test]
fn modes_and_cycle_times() {
    let Some(manual) = manual() else { return };
    let compilation = table();
    let device = device(&compilation);
    let modes = device.code_tables.iter().find(|table| table.name == "operating_modes").expect("the modes");
    let printed = rows(&manual, 1006, 1008);
    assert_eq!((modes.rows.len(), printed.len()), (3, 3));
    for (mode, (line, cells)) in modes.rows.iter().zip(&printed) {
        let numbers: Vec<i128> = cells[1].split(' ').filter_map(|word| word.parse().ok()).collect();
        let cells_of: Vec<i128> = mode.cells.iter().filter_map(Value::as_int).collect();
        assert_eq!(cells_of, numbers, "line {line}");
        assert!(cells[2].starts_with(&format!("0x6060 sottoindice 0 dati: {}", mode.code)), "line {line}");
    }
    let period = item(device, "Sample period");
    assert_eq!(period.limits.low, Some(Value::Int(4)));
    for (line, cells) in rows(&manual, 1033, 1035) {
        assert!(cells[1].contains("250 μs") && 4.0 * 62.5 == 250.0, "line {line}");
    }
    assert!(manual[1026 - 1].contains("2 ms equivale al valore FBUS.SAMPLEPERIOD di 32"));
    assert!(
        manual[1020 - 1].contains("Indice = -3, Unità = 2") && manual[1024 - 1].contains("Indice = -4, Unità = 20")
    );
}

#[test]
fn latch_words() {
    let Some(manual) = manual() else { return };
    let compilation = table();
    let device = device(&compilation);
    let mut compared = 0;
    for (name, first, last) in [("LatchControl", 1075, 1085), ("LatchStatus", 1090, 1103)] {
        let fields = fields(device, name);
        let mut span = (0, 0);
        for (line, cells) in rows(&manual, first, last) {
            if !cells[0].is_empty() {
                span = bits(cells[0]);
            }
            if cells.get(1).is_none_or(|cell| cell.is_empty()) {
                let place = fields.iter().find(|entry| (entry.offset, entry.bits) == span).expect("bits");
                assert!(matches!(place.meaning, BitMeaning::Reserved { .. }), "line {line}");
                continue;
            }
            let value = u32::from_str_radix(&cells[1].replace(' ', ""), 2).expect("a pattern");
            let digits = cells[2];
            let shown: String = format!("{value:04x}")
                .chars()
                .zip(digits.chars())
                .map(|(digits, z)| if z == 'z' { 'z' } else { digits })
                .collect();
            assert_eq!(shown, digits, "line {line}");
            let holds = fields.iter().any(|entry| holds(device, entry, line, value));
            assert!(holds, "line {line}: no field has {value:#06x}");
            compared += 1;
        }
    }
    assert_eq!(compared, 20);
}

/// Returns whether the field `entry` of a latch word describes `value`. The flag, or the name of the enumeration value, must also
/// cite the line. A flag describes `value` if its bit is the highest bit that is 1. An enumeration describes `value` if it has a
/// name for the bits of `value` from the offset of the field up.
fn holds(device: &Device, entry: &BitFieldEntry, line: usize, value: u32) -> bool {
    let actual = i128::from(value >> entry.offset);
    match entry.meaning {
        BitMeaning::Flag { inverted: false } => cited(entry.documentation.as_deref()).contains(&line) && actual == 1,
        BitMeaning::Enumeration(id) => {
            let Shape::Enumeration { values, .. } = &device.types[id.0 as usize].shape else { return false };
            let is_it =
                |label: &EnumValue| cited(label.documentation.as_deref()).contains(&line) && label.value == actual;
            values.iter().any(is_it)
        }
        _ => false,
    }
}

#[test]
fn mailbox_frames_and_their_example() {
    let Some(manual) = manual() else { return };
    let compilation = table();
    let device = device(&compilation);
    let message = &device.messages[0];
    let bytes = |first: usize| -> Vec<u8> {
        rows(&manual, first, first + 15)
            .into_iter()
            .enumerate()
            .map(|(number, (line, cells))| {
                assert_eq!(cells[0], format!("Byte {number}"), "line {line}");
                hex(cells[1]) as u8
            })
            .collect()
    };
    let example = &message.examples[0];
    assert_eq!(example.request, bytes(1211));
    // The manual prints the wrong length 0x0E and the wrong type 0x20 for the reply. The register table has a `doubt` entry about
    // both numbers.
    let mut reply = bytes(1230);
    assert_eq!((reply[0], reply[7]), (0x0E, 0x20));
    (reply[0], reply[7]) = (0x0A, 0x30);
    assert_eq!(example.reply, reply);
    frame(&manual, device, &message.request, 1137, 1165);
    frame(&manual, device, &message.reply, 1176, 1205);
    let services = values(device, "CoeService");
    for (line, cells) in rows(&manual, 1147, 1155).into_iter().chain(rows(&manual, 1186, 1194)) {
        let cell = cells.iter().rev().find(|cell| cell.contains(':')).expect("a type");
        let number: i128 = cell.split([':', '.']).next().unwrap().trim().parse().expect("a number");
        let service = services.iter().find(|service| service.value == number).unwrap_or_else(|| panic!("line {line}"));
        assert!(cited(service.documentation.as_deref()).contains(&line), "line {line}");
        assert_eq!(service.zone.is_some(), cell.to_lowercase().contains("riserva"), "line {line}");
    }
    assert_eq!(services.len(), 9);
    for (name, lines, count) in [("SdoCommand", 1156..=1158, 5), ("SdoResult", 1195..=1198, 6)] {
        let text: String = lines.map(|line| manual[line - 1].clone()).collect();
        let printed: BTreeSet<u32> = text.split("0x").skip(1).map(|part| hex(&part[..2])).collect();
        let values: BTreeSet<u32> = values(device, name).iter().map(|value| value.value as u32).collect();
        assert_eq!((values.len(), values), (count, printed), "{name}");
    }
}

/// Compares the printed rows `Byte 0` to `Byte 15` of a frame with the message fields that contain these bytes.
fn frame(manual: &[String], device: &Device, fields: &[MessageField], first: usize, last: usize) {
    let mut bytes: Vec<Option<BTreeSet<usize>>> = Vec::new();
    for field in fields {
        let (length, cites) = match field {
            MessageField::Value(value) => {
                let bits = basic(device, value.item.ty).bits().expect("a length");
                (bits / 8, Some(cited(value.item.documentation.as_deref())))
            }
            // The field `index` is two bytes long, and the sub-index is one byte long.
            MessageField::Echo { field, .. } => (if field == "index" { 2 } else { 1 }, None),
            other => panic!("{other:?}"),
        };
        bytes.extend((0..length).map(|_| cites.clone()));
    }
    let printed: Vec<(usize, usize)> = rows(manual, first, last)
        .iter()
        .filter_map(|(line, cells)| Some((cells[0].strip_prefix("Byte ")?.parse().ok()?, *line)))
        .collect();
    assert_eq!(printed.iter().map(|(byte, _)| *byte).collect::<Vec<_>>(), (0..bytes.len()).collect::<Vec<_>>());
    for (byte, line) in printed {
        assert!(bytes[byte].as_ref().is_none_or(|cites| cites.contains(&line)), "line {line}: byte {byte}");
    }
}

/// Compares the register table with the objects and the names of ASCII parameters in the manual. Section 3.3 of the notes on the
/// manual counts 43 indices, not including 0x1704, and 41 pairs of index and sub-index.
#[test]
fn objects_and_parameters() {
    let compilation = table();
    let device = device(&compilation);
    let mut indices: BTreeSet<u16> = device.groups.iter().filter_map(|group| group.index()).collect();
    indices.extend(device.process_data.pdos.iter().map(|pdo| pdo.mapping_index));
    assert_eq!(indices.len(), 43);
    assert!(!indices.contains(&0x1704));
    let mut pairs: Vec<(u16, u8)> = Vec::new();
    for index in [0x1600, 0x1A00] {
        pairs.extend([(index, 0), (index, 1), (index, 2), (index + 1, 0), (index + 2, 0), (index + 3, 0)]);
    }
    pairs.extend((0..=4).flat_map(|sub| [(0x1C12, sub), (0x1C13, sub)]));
    let plain = [0x6040, 0x6041, 0x6060, 0x6063, 0x606C, 0x6077, 0x60B2, 0x60F4, 0x60FD, 0x60FF];
    pairs.extend(plain.iter().chain(&[0x2050, 0x20A0, 0x20A4, 0x20A5, 0x3470]).map(|&index| (index, 0)));
    pairs.extend([(0x60C1, 1), (0x60C2, 1), (0x60C2, 2), (0x60FE, 1)]);
    assert_eq!(pairs.len(), 41);
    let items: BTreeSet<(u16, u8)> =
        device.groups.iter().flat_map(|group| &group.items).filter_map(Item::object).collect();
    let missing: Vec<_> = pairs.iter().filter(|pair| !items.contains(pair)).collect();
    assert_eq!(missing, [&(0, 0); 0]);
    // The register table can contain more entries of mapping objects than the manual, but at most four per object.
    let more: Vec<_> = items.iter().filter(|pair| !pairs.contains(pair)).collect();
    assert!(more.iter().all(|(index, sub)| matches!(index, 0x1600..=0x1603 | 0x1A00..=0x1A03) && *sub <= 4));
    let mut names: Vec<&str> = Vec::new();
    for binding in device.groups.iter().flat_map(|group| &group.items).flat_map(|item| &item.bindings) {
        if let Binding::Ascii(name) = binding {
            names.push(name);
        }
    }
    assert_eq!(names.len(), 13);
    if let Some(manual) = manual() {
        let text = manual.join("\n");
        assert!(names.iter().all(|name| text.contains(name)), "{names:?}");
    }
}

#[test]
fn every_row_says_where_it_is_printed() {
    let compilation = table();
    let device = device(&compilation);
    let mut missing = Vec::new();
    let mut look = |what: String, documentation: Option<&Documentation>| {
        if cited(documentation).is_empty() {
            missing.push(what);
        }
    };
    for group in &device.groups {
        look(format!("{:?} {}", group.kind, group.name), group.documentation.as_deref());
        group.items.iter().for_each(|item| look(item.name.to_string(), item.documentation.as_deref()));
    }
    for definition in &device.types {
        match &definition.shape {
            Shape::BitField { fields, .. } => {
                fields.iter().for_each(|field| {
                    look(format!("{}/{}", definition.name, field.name), field.documentation.as_deref())
                });
            }
            Shape::Enumeration { values, .. } if definition.documentation.is_some() => {
                values.iter().for_each(|value| {
                    look(format!("{}/{}", definition.name, value.name), value.documentation.as_deref())
                });
            }
            _ => {}
        }
    }
    for machine in &device.machines {
        look(machine.name.to_string(), machine.documentation.as_deref());
        let patterns = machine.states.iter().chain(&machine.commands);
        patterns.for_each(|pattern| look(pattern.name.to_string(), pattern.documentation.as_deref()));
        machine
            .transitions
            .iter()
            .for_each(|transition| look(format!("to {}", transition.to), transition.documentation.as_deref()));
    }
    device.process_data.pdos.iter().for_each(|pdo| look(pdo.name.to_string(), pdo.documentation.as_deref()));
    device.procedures.iter().for_each(|procedure| look(procedure.name.to_string(), procedure.documentation.as_deref()));
    device.messages.iter().for_each(|message| look(message.name.to_string(), message.documentation.as_deref()));
    for table in &device.code_tables {
        table.rows.iter().for_each(|row| look(format!("{} {}", table.name, row.code), row.documentation.as_deref()));
    }
    assert_eq!(missing, [""; 0]);
}
