//! Tests alarms, states, bits, base values, and the table of commands and states.

use std::collections::{BTreeMap, BTreeSet};

use lexibus_codegen::ir::{BitMeaning, EnumValue, Outcome, Shape, Value};

use super::hsd_support::{cells, chapter, device, doubts, line, number, original, table, values, Manual};

#[test]
fn alarms_and_warnings() {
    let Some(manual) = Manual::read() else { return };
    let compilation = table();
    let device = device(&compilation);
    let pages = [(0, vec![(2129, 2138), (2140, 2152), (2154, 2159)], 23, 8), (1, vec![(2175, 2188)], 12, 3)];
    for (at, pages, count, starred) in pages {
        let code_tables = &device.code_tables[at];
        let rows: Vec<_> = pages.iter().flat_map(|(from, to)| manual.rows(*from, *to)).collect();
        let rows: Vec<_> = rows.into_iter().filter(|(_, cells)| cells[0].starts_with("0x")).collect();
        assert_eq!((rows.len(), code_tables.rows.len()), (count, count));
        let mut with_mark = 0;
        for ((at, cells), row) in rows.iter().zip(&code_tables.rows) {
            assert_eq!(number(&cells[0]), Some(row.code));
            assert_eq!(line(row.documentation.as_ref().and_then(|documentation| documentation.cite.as_deref())), *at);
            // In the extracted text, the mark (*) after a name is `()`.
            let raw = manual.line(*at);
            let name = cells[1].replace(['(', ')'], "").replace("1", "").replace("2 INTERP", "2INTERP");
            let name = if row.code == 0x400B { name.replace('2', "") } else { name };
            let is_misspelled = name.trim() == "ALWROGSETP";
            assert!(original(&row.names) == name.trim() || is_misspelled, "{name} {}", original(&row.names));
            let models = row.availability.as_ref().map_or(&[][..], |availability| &availability.models);
            let is_marked = raw.split('|').nth(2).is_some_and(|cell| cell.replace("**", "").contains('*'));
            with_mark += usize::from(is_marked);
            let expected = match () {
                () if is_marked => 2,
                () if matches!(row.code, 0x4009 | 0x400A) => 1,
                () => 0,
            };
            assert_eq!(models.len(), expected, "{name}");
            assert!(matches!(&row.cells[..], [Value::Text(remedy)] if !remedy.is_empty()));
        }
        assert_eq!(with_mark, starred);
    }
}

#[test]
fn states_homing_states_and_types() {
    let Some(manual) = Manual::read() else { return };
    let compilation = table();
    let device = device(&compilation);
    let check = |name: &str, from, to, count: usize, code: usize, label: usize| {
        let rows: Vec<_> =
            manual.rows(from, to).into_iter().filter(|(_, cells)| number(&cells[code]).is_some()).collect();
        let values = values(device, name);
        assert_eq!((rows.len(), values.len()), (count, count), "{name}");
        for ((_, cells), value) in rows.iter().zip(values) {
            let is_misspelled = cells[label] == "SARCHINGTACCA";
            assert_eq!(number(&cells[code]), Some(value.value), "{name}");
            assert!(original(&value.names) == cells[label] || is_misspelled || name == "MotorType", "{}", cells[label]);
        }
    };
    check("State", 1959, 1974, 14, 0, 2);
    check("HomingState", 2107, 2114, 6, 0, 1);
    check("MotorType", 1213, 1221, 6, 0, 2);
    for (_, cells) in manual.rows(2109, 2114) {
        let value =
            values(device, "HomingState").iter().find(|value| number(&cells[0]) == Some(value.value)).expect("a value");
        let types: Vec<i128> = cells[3].split(" - ").filter_map(number).collect();
        let when: Vec<i128> = value.when.as_ref().expect("types").values.iter().filter_map(Value::as_int).collect();
        // The manual's table prints other homing types for homing state 6. However, the text of the manual restricts this state
        // to the homing types 0 and 2.
        assert!(types == when || (value.value == 6 && when == [0, 2]), "{cells:?} {when:?}");
    }
    for (_, cells) in manual.rows(1215, 1221).iter().filter(|(_, cells)| !cells[0].is_empty()) {
        let value =
            values(device, "MotorType").iter().find(|value| number(&cells[0]) == Some(value.value)).expect("a value");
        assert_eq!(value.name, format!("{} {}", cells[1], cells[2]));
    }
    // Section 4.9 of the manual lists the same six homing states in a different order.
    let section: BTreeSet<_> = manual
        .rows(1005, 1012)
        .into_iter()
        .filter_map(|(_, cells)| {
            let (name, rest) = cells[0].split_once('(')?;
            Some((number(rest.split(')').next()?)?, name.trim().to_owned()))
        })
        .collect();
    let names = values(device, "HomingState").iter().map(|value| (value.value, original(&value.names).to_owned()));
    assert_eq!(section, names.collect());
}

#[test]
fn bits_are_the_printed_ones() {
    let Some(manual) = Manual::read() else { return };
    let compilation = table();
    let device = device(&compilation);
    let fields = |name: &str| match &device.types.iter().find(|definition| definition.name == name).expect("bits").shape
    {
        Shape::BitField { fields, .. } => fields,
        other => panic!("{other:?}"),
    };
    let rows: Vec<_> = [(1618, 1631), (1633, 1635)].iter().flat_map(|(from, to)| manual.rows(*from, *to)).collect();
    let rows: Vec<_> = rows.into_iter().filter(|(_, cells)| number(&cells[0]).is_some()).collect();
    assert_eq!((rows.len(), fields("BitA").len()), (13, 13));
    let items = &chapter(device, "Parameters").items;
    let default = &items.iter().find(|item| item.name == "BIT_A").expect("the parameter").default;
    for (at, cells) in &rows {
        let field =
            fields("BitA").iter().find(|field| Some(i128::from(field.offset)) == number(&cells[0])).expect("a bit");
        let availability = field.availability.as_ref();
        let (models, since) = (
            availability.map_or(0, |availability| availability.models.len()),
            availability.and_then(|availability| availability.since.as_deref()),
        );
        let text = &cells[2];
        assert_eq!(matches!(field.meaning, BitMeaning::Reserved { .. }), text.starts_with("Riservato."), "line {at}");
        // The second column of the printed table contains the default value.
        let default = default.as_ref().and_then(Value::as_int).expect("a default");
        assert_eq!(number(&cells[1]), Some(default >> field.offset & 1), "line {at}");
        let only = match () {
            () if text.starts_with("Solo per SM140 e SM137 rev. C") => 2,
            () if text.starts_with("Solo per SM140") => 1,
            () => 0,
        };
        assert_eq!(models, only, "line {at}");
        assert_eq!(since, text.contains("ersione 119").then_some("119"), "line {at}");
    }
    for (name, from, to, count) in [("BitStato", 2202, 2205, 4), ("InvertedInputs", 2231, 2233, 3)] {
        let rows = manual.rows(from, to);
        assert_eq!((rows.len(), fields(name).len()), (count, count));
        for (_, cells) in rows {
            let bit = number(cells[0].trim_start_matches("Bit "));
            let field = fields(name).iter().find(|field| Some(i128::from(field.offset)) == bit).expect("a bit");
            assert!(name != "BitStato" || original(&field.names) == cells[1], "{cells:?}");
        }
    }
}

/// Compares the manual's table of input levels with the register table. Each row contains the INVDIN bit, the voltage at the input,
/// and the resulting level.
#[test]
fn levels_of_inputs_are_the_printed_ones() {
    let Some(manual) = Manual::read() else { return };
    let compilation = table();
    let device = device(&compilation);
    let rows = manual.rows(2237, 2240);
    assert_eq!(rows.len(), 4);
    let definition = device.types.iter().find(|definition| definition.name == "InvertedInputs").expect("bits");
    let doc = definition.documentation.as_ref().expect("a text");
    assert!(doc.text.contains("If a bit is 1, its input is inverted: 0 V is high, and 24 V is low."));
    assert_eq!(doc.cite.as_deref(), Some("2225-2262"));
    for (at, cells) in rows {
        let is_inverted = number(&cells[0]) == Some(1);
        // The manual prints 1 V in one cell, which has a `doubt` entry.
        let is_odd = cells[1] == "1";
        assert_eq!(is_odd, at == 2237, "line {at}");
        assert!(!is_odd || doubts(device).iter().any(|doubt| doubt.contains("Its first row contains 0, 1 V and low")));
        let has_voltage = number(&cells[1]) == Some(24);
        assert_eq!(cells[2], if has_voltage != is_inverted { "Alto" } else { "Basso" }, "line {at}");
    }
}

/// Compares the bit patterns of interpolation commands and of interpolation states.
#[test]
fn patterns_of_interpolation_are_the_printed_ones() {
    let Some(manual) = Manual::read() else { return };
    let compilation = table();
    let machine =
        device(&compilation).machines.iter().find(|machine| machine.name == "interpolation").expect("the machine");
    let tables = [(2275, 2283, &machine.commands, 8), (2288, 2298, &machine.states, 10)];
    for (from, to, entry, count) in tables {
        let rows = manual.rows(from, to);
        // The header lists the bit numbers.
        let over: Vec<u32> = manual.rows(from - 1, from - 1)[0].1[1..]
            .iter()
            .filter_map(|cell| cell.strip_prefix("Bit ").and_then(|bit| bit.parse().ok()))
            .collect();
        assert_eq!((rows.len(), entry.len()), (count, count), "line {from}");
        for ((at, cells), row) in rows.iter().zip(entry) {
            assert_eq!(line(row.documentation.as_ref().and_then(|documentation| documentation.cite.as_deref())), *at);
            let (mut mask, mut value) = (0, 0);
            for (bit, cell) in over.iter().zip(&cells[1..]) {
                mask |= u32::from(cell != "x") << bit;
                value |= u32::from(cell == "1") << bit;
            }
            // In the manual, the row of state S6 does not specify bit 2 and has the same pattern as the second row of S5. The
            // row of S6 has a `doubt` entry.
            if *at == 2296 {
                assert_eq!((mask, value), (0xF2, 0x82));
                (mask, value) = (0xF6, 0x86);
            }
            assert_eq!((row.mask, row.value), (mask, value), "line {at} {}", row.name);
            assert_eq!(original(&row.names), cells.last().expect("a cell"), "line {at}");
        }
    }
}

#[test]
fn bases_of_fractions_are_those_of_the_models() {
    let Some(manual) = Manual::read() else { return };
    let compilation = table();
    let device = device(&compilation);
    let rows = manual.rows(1937, 1940);
    let names = ["voltage_base", "current_base", "speed_base", "acceleration_base"];
    assert_eq!(rows.len(), 4);
    for ((_, cells), name) in rows.iter().zip(names) {
        for model in &device.variants {
            let (_, constants) = model.constants.iter().find(|(constant, _)| constant == name).expect("a constant");
            let printed = &cells[if model.name == "SM140" { 2 } else { 1 }];
            assert_eq!(constants.as_real(), printed.parse().ok(), "{} {name}", model.name);
        }
    }
}

/// Compares all cells of the table of commands and states. The manual prints the table in two halves.
#[test]
fn commands_and_states() {
    let Some(manual) = Manual::read() else { return };
    let compilation = table();
    let device = device(&compilation);
    let machine = device.machines.iter().find(|machine| machine.name == "axis").expect("the machine");
    let states = values(device, "State");
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    let mut starred = BTreeSet::new();
    let mut at = 0;
    for (from, first, count) in [(1990, 0, 7), (2028, 7, 6)] {
        let head = cells(manual.line(from - 1)).expect("the states");
        for (row, outcome) in machine.outcomes.iter().enumerate() {
            let cells = cells_with_stars(manual.line(from + row));
            if cells[0].ends_with('*') && !cells[0].contains("INTER*")
                || cells[0].contains("INTERP*")
                || cells[0].contains("INTER*")
            {
                starred.insert(row);
            }
            for column in 0..count {
                let name = head[1 + column].split(['(', ' ']).next().unwrap_or_default();
                let cell = &outcome.cells[first + column];
                let state = states.iter().find(|state| state.name == cell.state).expect("the state");
                assert_eq!(original(&state.names), name);
                let (kind, expected) = outcomes(&cells[1 + column], states);
                assert_eq!(cell.outcomes, expected, "{} {name}", outcome.name);
                *counts.entry(kind).or_default() += 1;
                at += 1;
            }
        }
    }
    assert_eq!((machine.outcomes.len(), at, starred.len()), (34, 442, 13));
    let expected = [("accepted", 204), ("blank", 13), ("conditional", 2), ("refused", 223)];
    assert_eq!(counts.into_iter().collect::<Vec<_>>(), expected);
    let with_models = machine.outcomes.iter().filter(|row| row.availability.is_some()).count();
    assert_eq!(with_models, 13);
    let undescribed = machine.outcomes.iter().filter(|row| row.commands.is_empty()).count();
    assert_eq!(undescribed, 7);
    assert_eq!(machine.initial.as_ref().map(|state| state.as_str()), Some("alarm"));
    assert_eq!(machine.faults, ["braking to alarm", "alarm"]);
}

fn cells_with_stars(line: &str) -> Vec<String> {
    line.trim().trim_matches('|').split('|').map(|cell| cell.trim().to_owned()).collect()
}

/// Returns the kind of a cell of the manual, and the outcomes that the cell lists.
fn outcomes(cell: &str, states: &[EnumValue]) -> (&'static str, Vec<Outcome>) {
    let cell = cell.replace("Effettua l'azzeramento manuale", "");
    let plain: String = cell.chars().filter(|c| !"(0123456789)".contains(*c)).collect();
    let one = |text: &str| match text.trim() {
        "=" | "==" => Outcome::Unchanged,
        "= errore" | "== errore" => Outcome::Refused,
        chain => Outcome::States(
            chain
                .split('⇒')
                .map(|state| {
                    let entry = states.iter().find(|entry| original(&entry.names) == state.trim());
                    entry.unwrap_or_else(|| panic!("{state}")).name.clone().into()
                })
                .collect(),
        ),
    };
    if plain.trim().is_empty() {
        return ("blank", Vec::new());
    }
    let found: Vec<Outcome> = plain.split("oppure").map(one).collect();
    let kind = match found.as_slice() {
        [Outcome::Refused] => "refused",
        [_] => "accepted",
        _ => "conditional",
    };
    (kind, found)
}
