//! The Eco's alarms and other codes, named values, inputs and outputs, held against the text of its manual.

mod eco_support;

use std::collections::BTreeSet;

use eco_support::*;
use lexibus_codegen::ir::{
    BitFieldEntry, BitMeaning, Bus, CodeRow, CodeTable, Device, EnumValue, Shape, Trigger, Value, Zone,
};

fn codes<'d>(device: &'d Device, name: &str) -> &'d CodeTable {
    device.code_tables.iter().find(|own| own.name == name).expect("a table of codes")
}

fn fields<'d>(device: &'d Device, name: &str) -> &'d [BitFieldEntry] {
    let definition = device.types.iter().find(|own| own.name == name).expect("a type");
    let Shape::BitField { fields, .. } = &definition.shape else { panic!("{name}") };
    fields
}

fn values<'d>(device: &'d Device, name: &str) -> &'d [EnumValue] {
    let definition = device.types.iter().find(|own| own.name == name).expect("a type");
    let Shape::Enumeration { values, .. } = &definition.shape else { panic!("{name}") };
    values
}

fn text(value: Option<&Value>) -> String {
    match value {
        Some(Value::Text(text)) => text.to_string(),
        Some(Value::Int(code)) => format!("0x{code:04X}"),
        Some(Value::Bool(flag)) => flag.to_string(),
        _ => String::new(),
    }
}

#[test]
fn alarms_are_the_printed_ones() {
    let (Some(rows), Some(manual)) = (rows("alarms"), manual()) else { return };
    let compilation = table();
    let device = device(&compilation);
    let tables =
        [("general", "general_alarms", 19), ("ethercat", "ethercat_alarms", 28), ("profinet", "profinet_alarms", 5)];
    assert_eq!(rows.len(), 52);
    for (kind, name, count) in tables {
        let own: Vec<&Vec<String>> = rows.iter().filter(|row| row[1] == kind).collect();
        let table = codes(device, name);
        assert_eq!((own.len(), table.rows.len()), (count, count), "{name}");
        for (printed, row) in own.iter().zip(&table.rows) {
            let line: usize = printed[0].parse().expect("a line");
            assert_eq!(printed[2], row.code.to_string(), "L{line}");
            assert!(cites(row.documentation.as_deref(), line), "L{line}");
            let cell = text(row.cells.first());
            match kind {
                "general" => assert_eq!(cell, reaction(&manual, line), "L{line}"),
                "ethercat" => assert_eq!(cell, printed[3].trim_matches([' ', '-']), "L{line}"),
                _ => assert_eq!(cell == "true", printed[4].trim().ends_with("SI"), "L{line}"),
            }
        }
    }
    // Many alarms have one code, so that there is no way back.
    let of_alarms: Vec<String> =
        codes(device, "ethercat_alarms").rows.iter().map(|row| text(row.cells.first())).collect();
    assert_eq!(of_alarms.iter().filter(|own| !own.is_empty()).collect::<BTreeSet<_>>().len(), 18);
    let buses = |name| codes(device, name).buses.iter().map(Bus::name).collect::<Vec<_>>();
    assert_eq!((buses("ethercat_alarms"), buses("profinet_alarms")), (vec!["ethercat"], vec!["profinet"]));
}

/// The reaction of a general alarm: the first line behind its title that names an action.
fn reaction(manual: &[String], line: usize) -> &'static str {
    let found = lines(manual, line, line + 8)
        .map(|(_, text)| text)
        .find(|text| text.starts_with("Azione"))
        .expect("a reaction");
    match found {
        text if text.contains("rilasciato immediatamente") => "released at once",
        text if text.contains("rampa di emergenza") => "emergency ramp, then free",
        _ => "",
    }
}

#[test]
fn other_codes_are_the_printed_ones() {
    let Some(manual) = manual() else { return };
    let compilation = table();
    let device = device(&compilation);
    let abort: Vec<String> = lines(&manual, 2644, 2651).map(|(_, text)| text[2..10].to_lowercase()).collect();
    let of_row = |row: &CodeRow| match row.last {
        Some(_) => format!("{:07x}x", row.code >> 4),
        None => format!("{:08x}", row.code),
    };
    assert_eq!(codes(device, "sdo_abort").rows.iter().map(of_row).collect::<Vec<_>>(), abort);
    let is_class =
        |text: &&str| text.len() >= 4 && text[..4].ends_with('x') && text[..1].bytes().all(|c| c.is_ascii_hexdigit());
    let classes = lines(&manual, 2895, 2924).map(|(_, text)| text).filter(is_class);
    let classes: Vec<String> = classes.map(|text| text[..4].to_owned()).collect();
    let of_class = |row: &CodeRow| {
        let digits = format!("{:04X}", row.code);
        let free = format!("{:X}", row.last.expect("a range") - row.code).len();
        digits[..4 - free].to_owned() + &"x".repeat(free)
    };
    assert_eq!(codes(device, "emergency").rows.iter().map(of_class).collect::<Vec<_>>(), classes);
    assert_eq!(classes.len(), 12);
    let states: Vec<i128> = codes(device, "nmt_state").rows.iter().map(|row| row.code).collect();
    let printed: Vec<i128> = hex_numbers(&manual[3121], 2).into_iter().map(i128::from).collect();
    assert_eq!((states, printed.len()), (printed.clone(), 4));
}

#[test]
fn modes_profiles_and_bit_rates_are_the_printed_ones() {
    let Some(manual) = manual() else { return };
    let compilation = table();
    let device = device(&compilation);
    let values = |name: &str| values(device, name).iter().map(|own| own.value).collect::<BTreeSet<i128>>();
    let of_lines = |first, last| -> BTreeSet<i128> {
        let numbers =
            lines(&manual, first, last).map(|(_, text)| text.split([' ', ':']).next().unwrap_or_default().to_owned());
        numbers.filter_map(|number| number.parse().ok()).collect()
    };
    let in_registers: BTreeSet<i128> = lines(&manual, 75, 79)
        .flat_map(|(_, text)| {
            text.split_whitespace().filter_map(|word| word.split_once(':')).map(|own| own.0.parse()).collect::<Vec<_>>()
        })
        .filter_map(Result::ok)
        .collect();
    assert_eq!(in_registers, BTreeSet::from([-127, -50, -2, -1, 1, 3, 6, 7]));
    // EtherCAT has one more.
    let with_csp = |mut list: BTreeSet<i128>| {
        list.insert(8);
        list
    };
    assert_eq!(values("Mode"), with_csp(in_registers));
    // What 0x6060 takes on each bus.
    let there = |bus: Bus| -> BTreeSet<i128> {
        let limits = item(device, "modes_of_operation").limits_on(bus).expect("limits");
        limits.allowed.iter().filter_map(|(value, _)| value.as_int()).collect()
    };
    assert_eq!(there(Bus::CanOpen), of_lines(3946, 3952));
    assert_eq!(there(Bus::EtherCat), with_csp(of_lines(3946, 3952)));
    assert_eq!(values("MotionProfile"), of_lines(3969, 3972));
    let rates = lines(&manual, 3422, 3429).filter_map(|(_, text)| text.split_whitespace().nth(2)?.parse::<i128>().ok());
    assert_eq!(values("BitRate"), rates.collect::<BTreeSet<i128>>());
    assert_eq!(values("BitRate").len(), 8);
}

#[test]
fn inputs_and_outputs_are_the_printed_ones() {
    let Some(manual) = manual() else { return };
    let compilation = table();
    let device = device(&compilation);
    let bits_of = |name: &str| fields(device, name);
    for (name, tables, count) in
        [("DigitalInputs", [(1812, 1827), (4621, 4636)], 12), ("DigitalOutputs", [(1924, 1927), (4720, 4723)], 4)]
    {
        for (first, last) in tables {
            let rows = lines(&manual, first, last).filter_map(|(line, text)| {
                let mut words = text.split_whitespace();
                let pin: u32 = words.next()?.parse().ok()?;
                Some((line, pin, words.next()?.parse::<u32>().ok()?))
            });
            let rows: Vec<(usize, u32, u32)> = rows.collect();
            assert_eq!(rows.len(), count, "L{first}");
            for (line, pin, bit) in rows {
                let field = bits_of(name).iter().find(|own| u32::from(own.offset) == bit).expect("a bit");
                let text = field.documentation.as_ref().map_or("", |own| own.text.as_str());
                let begin = format!("Pin {pin}");
                let rest = text.strip_prefix(&begin).unwrap_or_else(|| panic!("L{line} pin {pin}: {text}"));
                assert!(!rest.starts_with(|c: char| c.is_ascii_digit()), "L{line} pin {pin}: {text}");
                assert!(cites(field.documentation.as_deref(), line), "L{line} bit {bit}");
            }
        }
    }
}

/// Functions of the inputs of the miniECO by c8, and the bits that they have (L1841-1900, again L4646-4705).
#[test]
fn inputs_of_the_mini_eco_are_the_printed_ones() {
    let Some(manual) = manual() else { return };
    let compilation = table();
    let device = device(&compilation);
    let words = ["negative limit", "positive limit", "homeswitch", "position latch", "start move", "input enable"];
    let own =
        ["negative limit switch", "positive limit switch", "home switch", "position latch", "start", "input enable"];
    let bits = ["8", "9", "10", "0", "1", "-"];
    for (first, last) in [(1852, 1900), (4657, 4705)] {
        let cells = lines(&manual, first, last).filter(|(_, text)| text.contains("--")).map(|(line, text)| {
            let lower = text.to_lowercase();
            let at = words.iter().position(|word| lower.contains(word)).unwrap_or_else(|| panic!("L{line}"));
            let bit = text.split_whitespace().skip_while(|word| !["DIR", "PULSE", "IEN"].contains(word)).nth(1);
            assert_eq!(bit, Some(bits[at]), "L{line}");
            own[at].to_owned()
        });
        let cells: Vec<String> = cells.collect();
        assert_eq!(cells.len(), 21);
        let table = codes(device, "mini_inputs");
        let there: Vec<String> =
            table.rows.iter().flat_map(|row| row.cells.iter().map(|cell| text(Some(cell)))).collect();
        assert_eq!(there, cells, "L{first}");
    }
}

#[test]
fn pins_of_cn2_are_the_printed_ones() {
    let Some(manual) = manual() else { return };
    let compilation = table();
    let rows = lines(&manual, 1720, 1735).map(|(line, text)| (line, text.split_whitespace().collect::<Vec<_>>()));
    let table = codes(device(&compilation), "cn2_pins");
    assert_eq!(table.rows.len(), 16);
    for ((line, words), row) in rows.zip(&table.rows) {
        assert_eq!(words[0], row.code.to_string(), "L{line}");
        assert_eq!(words[1].to_lowercase(), text(row.cells.first()), "L{line}");
        assert_eq!(words.len() > 2, row.cells.len() > 1, "L{line}");
    }
}

/// The values of c9 that choose a bus, and those of E3, wherever they are printed.
#[test]
fn values_of_c9_and_e3_are_the_printed_ones() {
    let Some(manual) = manual() else { return };
    let compilation = table();
    for (parameter, name, count) in [("c9", "Network", 4), ("e3", "Exceptions", 2)] {
        let printed = lines(&manual, 1, manual.len()).filter_map(|(line, text)| {
            let text = text.to_lowercase();
            let (_, behind) = text.split_once(&format!("{parameter} = "))?;
            let digits: String = behind.chars().take_while(char::is_ascii_digit).collect();
            Some((digits.parse::<i128>().expect("a value"), line))
        });
        let printed: Vec<(i128, usize)> = printed.collect();
        let own = values(device(&compilation), name);
        assert_eq!((printed.len(), own.len()), (count, count), "{parameter}");
        for (value, line) in printed {
            let own = own.iter().find(|own| own.value == value).unwrap_or_else(|| panic!("L{line}"));
            assert!(cites(own.documentation.as_deref(), line), "L{line}");
        }
    }
}

/// The mode that a meaning of a bit is of, by the words of its line.
const MODES: [(&str, i128); 6] = [
    ("Posizionatore", 1),
    ("Controllo Velocità", 3),
    ("Zero ", 6),
    ("Interpolatore", 7),
    ("Asse elettrico", -2),
    ("Save/load", -50),
];

/// Bits of the vendor's control word and status word: the bits, and their meanings by mode.
#[test]
fn bits_of_control_and_status_word_are_the_printed_ones() {
    let Some(manual) = manual() else { return };
    let compilation = table();
    for (name, first, last, counts, edges) in
        [("DriveCommand", 47, 67, (8, 13), 4), ("DriveStatus", 142, 162, (8, 15), 0)]
    {
        let own = fields(device(&compilation), name);
        let (mut bit, mut bits, mut meanings, mut rising) = (0, BTreeSet::new(), 0, 0);
        for (line, text) in lines(&manual, first, last) {
            let mode = MODES.iter().find(|(word, _)| text.contains(word)).map(|own| own.1);
            let begins = text.strip_prefix("bit ").and_then(|rest| rest.split(' ').next());
            bit = begins.map_or(bit, |digits| digits.parse().expect("a bit"));
            // The rest of the line above.
            if begins.is_none() && mode.is_none() {
                continue;
            }
            let found = own.iter().find(|own| own.offset == bit && cites(own.documentation.as_deref(), line));
            let found = found.unwrap_or_else(|| panic!("L{line}: {name} has no bit {bit}"));
            let when: Vec<i128> = found.when.iter().flat_map(|own| &own.values).filter_map(Value::as_int).collect();
            assert_eq!(when, Vec::from_iter(mode), "L{line}");
            let label = found.names.first().map_or("", |own| own.text.as_str()).replace(' ', "").to_lowercase();
            assert!(text.replace(' ', "").to_lowercase().contains(&label), "L{line} {label}");
            let is_edge = text.contains("0 \u{FFFD} 1") || text.contains("0\u{FFFD} 1");
            assert_eq!(found.trigger == Some(Trigger::Rising), is_edge, "L{line}");
            rising += usize::from(is_edge);
            bits.insert(bit);
            meanings += 1;
        }
        assert_eq!(((bits.len(), meanings), rising), (counts, edges), "{name}");
        let named = own.iter().filter(|own| !matches!(own.meaning, BitMeaning::Reserved { .. }));
        assert_eq!(named.count(), meanings, "{name}");
    }
}

/// Bits of 0x6040 and 0x6041 that are the vendor's.
#[test]
fn bits_of_the_vendor_in_words_of_402_are_the_printed_ones() {
    let Some(manual) = manual() else { return };
    let compilation = table();
    for (name, first, last, expected) in
        [("Controlword", 3911, 3921, [11, 12, 14]), ("Statusword", 3923, 3939, [8, 14, 15])]
    {
        let printed = lines(&manual, first, last).filter_map(|(line, text)| {
            let rest = text.strip_prefix("o bit ")?;
            Some((line, rest.split(':').next()?.parse::<u8>().expect("a bit")))
        });
        let printed: Vec<(usize, u8)> = printed.collect();
        assert_eq!(printed.iter().map(|own| own.1).collect::<Vec<_>>(), expected, "{name}");
        for (line, bit) in printed {
            let own = fields(device(&compilation), name).iter().find(|own| own.offset == bit).expect("a bit");
            assert!(cites(own.documentation.as_deref(), line), "L{line}");
            assert!(!matches!(own.meaning, BitMeaning::Reserved { .. }), "L{line}");
            // A transition is printed of bit 14 only.
            let is_edge = manual[line - 1].contains("transizione da 0 a 1") && name == "Controlword";
            assert_eq!(own.trigger == Some(Trigger::Rising), is_edge, "L{line}");
        }
    }
}

#[test]
fn bits_of_the_error_register_are_the_printed_ones() {
    let Some(manual) = manual() else { return };
    let compilation = table();
    let mut printed: Vec<(u8, String, usize)> = Vec::new();
    for (line, text) in lines(&manual, 2978, 2999).filter(|(_, text)| !text.is_empty()) {
        let digits = text.split(' ').next().and_then(|own| own.parse().ok());
        match (digits, printed.last_mut()) {
            (Some(bit), _) => printed.push((bit, text[1..].trim().to_lowercase(), line)),
            (None, Some(row)) => row.1 += &format!(" {}", text.to_lowercase()),
            _ => panic!("L{line}"),
        }
    }
    let own = fields(device(&compilation), "ErrorRegister");
    assert_eq!((printed.len(), own.len()), (8, 8));
    for ((bit, cause, line), own) in printed.iter().zip(own) {
        assert!(own.offset == *bit && cites(own.documentation.as_deref(), *line), "L{line}");
        match own.meaning {
            BitMeaning::Reserved { write } => assert_eq!((cause.as_str(), write), ("reserved (always 0)", Some(false))),
            _ => assert_eq!(own.name, cause.trim(), "L{line}"),
        }
    }
}

#[test]
fn transmission_types_are_the_printed_ones() {
    let Some(manual) = manual() else { return };
    let compilation = table();
    let mut printed: Vec<(usize, String)> = Vec::new();
    for (line, text) in lines(&manual, 2749, 2767).filter(|(_, text)| !text.is_empty()) {
        match printed.last_mut() {
            Some(row) if !text.starts_with(|c: char| c.is_ascii_digit()) => row.1 += &format!(" {text}"),
            _ => printed.push((line, text.to_owned())),
        }
    }
    let own = values(device(&compilation), "TransmissionType");
    assert_eq!((printed.len(), own.len()), (6, 6));
    for ((line, text), own) in printed.iter().zip(own) {
        let (numbers, kind) = text.split_once(' ').expect("numbers and a kind");
        let ends: Vec<i128> = numbers.split("...").map(|number| number.parse().expect("a type")).collect();
        assert_eq!((own.value, own.last), (ends[0], ends.get(1).copied()), "L{line}");
        assert!(cites(own.documentation.as_deref(), *line), "L{line}");
        match own.zone {
            Some(zone) => assert_eq!((zone, kind), (Zone::Reserved, "reserved"), "L{line}"),
            None => assert_eq!(own.name, kind.replace("RTR only", "on request"), "L{line}"),
        }
    }
}

/// Outputs of the miniECO (L1941-1944, again L4738-4741): two of the four have no function.
#[test]
fn outputs_of_the_mini_eco_are_the_printed_ones() {
    let Some(manual) = manual() else { return };
    let compilation = table();
    let own = fields(device(&compilation), "DigitalOutputs");
    for (first, last) in [(1941, 1944), (4738, 4741)] {
        let mut without = 0;
        for (line, text) in lines(&manual, first, last) {
            let mut words = text.splitn(3, ' ');
            let mut number = || words.next().and_then(|own| own.parse::<u8>().ok()).expect("a number");
            let (pin, bit) = (number(), number());
            let function = words.next().unwrap_or_default();
            let of_model = |field: &&BitFieldEntry| {
                let models = field.availability.as_ref().map_or(&[][..], |own| &own.models);
                field.offset == bit && (models.is_empty() || models.iter().any(|own| own == "miniECO"))
            };
            let found: Vec<_> = own.iter().filter(of_model).collect();
            assert_eq!(found.len(), 1, "L{line}");
            let doc = found[0].documentation.as_ref().expect("a text");
            assert!(cites(Some(doc), line) && doc.text.starts_with(&format!("Pin {pin}")), "L{line}");
            assert_eq!(doc.text.contains("no function on the miniECO"), function.is_empty(), "L{line}");
            let orig = found[0].names.first().map(|own| own.text.as_str());
            match function {
                "" => without += 1,
                "Brake / Digital Out" => assert_eq!(found[0].name, "brake"),
                function => assert_eq!(orig, Some(function)),
            }
        }
        assert_eq!(without, 2, "L{first}");
    }
}
