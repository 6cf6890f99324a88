//! Compares the Eco's alarms and other codes, named values, inputs and outputs with the text of its manual.

use crate::eco_support;

use std::collections::BTreeSet;

use eco_support::*;
use lexibus_codegen::ir::{
    BitFieldEntry, BitMeaning, Bus, CodeRow, CodeTable, Device, EnumValue, Shape, Trigger, Value, Zone,
};

fn codes<'d>(device: &'d Device, name: &str) -> &'d CodeTable {
    device.code_tables.iter().find(|table| table.name == name).expect("a table of codes")
}

fn fields<'d>(device: &'d Device, name: &str) -> &'d [BitFieldEntry] {
    let definition = device.types.iter().find(|definition| definition.name == name).expect("a type");
    let Shape::BitField { fields, .. } = &definition.shape else { panic!("{name}") };
    fields
}

fn values<'d>(device: &'d Device, name: &str) -> &'d [EnumValue] {
    let definition = device.types.iter().find(|definition| definition.name == name).expect("a type");
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
        let rows: Vec<&Vec<String>> = rows.iter().filter(|row| row[1] == kind).collect();
        let table = codes(device, name);
        assert_eq!((rows.len(), table.rows.len()), (count, count), "{name}");
        for (printed, row) in rows.iter().zip(&table.rows) {
            let line: usize = printed[0].parse().expect("a line");
            assert_eq!(printed[2], row.code.to_string(), "line {line}");
            assert!(cites(row.documentation.as_deref(), line), "line {line}");
            let cell = text(row.cells.first());
            match kind {
                "general" => assert_eq!(cell, reaction(&manual, line), "line {line}"),
                "ethercat" => assert_eq!(cell, printed[3].trim_matches([' ', '-']), "line {line}"),
                _ => assert_eq!(cell == "true", printed[4].trim().ends_with("SI"), "line {line}"),
            }
        }
    }
    // Several alarms have the same code, so codes cannot be mapped back to alarms.
    let of_alarms: Vec<String> =
        codes(device, "ethercat_alarms").rows.iter().map(|row| text(row.cells.first())).collect();
    assert_eq!(of_alarms.iter().filter(|entry| !entry.is_empty()).collect::<BTreeSet<_>>().len(), 18);
    let buses = |name| codes(device, name).buses.iter().map(Bus::name).collect::<Vec<_>>();
    assert_eq!((buses("ethercat_alarms"), buses("profinet_alarms")), (vec!["ethercat"], vec!["profinet"]));
}

/// Returns the reaction to a general alarm, or an empty text for an unknown reaction. In the lines from the
/// alarm's title on, the first line that starts with "Azione" describes the reaction.
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
    let values = |name: &str| values(device, name).iter().map(|value| value.value).collect::<BTreeSet<i128>>();
    let of_lines = |first, last| -> BTreeSet<i128> {
        let numbers =
            lines(&manual, first, last).map(|(_, text)| text.split([' ', ':']).next().unwrap_or_default().to_owned());
        numbers.filter_map(|number| number.parse().ok()).collect()
    };
    let in_registers: BTreeSet<i128> = lines(&manual, 75, 79)
        .flat_map(|(_, text)| {
            text.split_whitespace()
                .filter_map(|word| word.split_once(':'))
                .map(|entry| entry.0.parse())
                .collect::<Vec<_>>()
        })
        .filter_map(Result::ok)
        .collect();
    assert_eq!(in_registers, BTreeSet::from([-127, -50, -2, -1, 1, 3, 6, 7]));
    // On EtherCAT, the drive also has mode 8 (cyclic synchronous position).
    let with_csp = |mut list: BTreeSet<i128>| {
        list.insert(8);
        list
    };
    assert_eq!(values("Mode"), with_csp(in_registers));
    // Returns the allowed values of 0x6060 on a bus.
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
            assert_eq!(rows.len(), count, "line {first}");
            for (line, pin, bit) in rows {
                let field = bits_of(name).iter().find(|entry| u32::from(entry.offset) == bit).expect("a bit");
                let text = field.documentation.as_ref().map_or("", |documentation| &*documentation.text);
                let begin = format!("Pin {pin}");
                let rest = text.strip_prefix(&begin).unwrap_or_else(|| panic!("line {line} pin {pin}: {text}"));
                assert!(!rest.starts_with(|c: char| c.is_ascii_digit()), "line {line} pin {pin}: {text}");
                assert!(cites(field.documentation.as_deref(), line), "line {line} bit {bit}");
            }
        }
    }
}

/// Compares the functions of the miniECO's inputs, the bits of these functions, and the values of parameter c8 that
/// select them. The section is "digital_inputs su MiniECO standard o miniECO PLUS".
#[test]
fn inputs_of_the_mini_eco_are_the_printed_ones() {
    let Some(manual) = manual() else { return };
    let compilation = table();
    let device = device(&compilation);
    let words = ["negative limit", "positive limit", "homeswitch", "position latch", "start move", "input enable"];
    let actual =
        ["negative limit switch", "positive limit switch", "home switch", "position latch", "start", "input enable"];
    let bits = ["8", "9", "10", "0", "1", "-"];
    for (first, last) in [(1852, 1900), (4657, 4705)] {
        let cells = lines(&manual, first, last).filter(|(_, text)| text.contains("--")).map(|(line, text)| {
            let lower = text.to_lowercase();
            let at = words.iter().position(|word| lower.contains(word)).unwrap_or_else(|| panic!("line {line}"));
            let bit = text.split_whitespace().skip_while(|word| !["DIR", "PULSE", "IEN"].contains(word)).nth(1);
            assert_eq!(bit, Some(bits[at]), "line {line}");
            actual[at].to_owned()
        });
        let cells: Vec<String> = cells.collect();
        assert_eq!(cells.len(), 21);
        let table = codes(device, "mini_inputs");
        let there: Vec<String> =
            table.rows.iter().flat_map(|row| row.cells.iter().map(|cell| text(Some(cell)))).collect();
        assert_eq!(there, cells, "line {first}");
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
        assert_eq!(words[0], row.code.to_string(), "line {line}");
        assert_eq!(words[1].to_lowercase(), text(row.cells.first()), "line {line}");
        assert_eq!(words.len() > 2, row.cells.len() > 1, "line {line}");
    }
}

/// Compares the values of parameter c9, which select a bus, and the values of parameter E3 with all lines that print
/// such a value.
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
        let values = values(device(&compilation), name);
        assert_eq!((printed.len(), values.len()), (count, count), "{parameter}");
        for (value, line) in printed {
            let entry = values.iter().find(|entry| entry.value == value).unwrap_or_else(|| panic!("line {line}"));
            assert!(cites(entry.documentation.as_deref(), line), "line {line}");
        }
    }
}

/// Words in the lines about bits, each with the number of the mode of operation that it denotes.
const MODES: [(&str, i128); 6] = [
    ("Posizionatore", 1),
    ("Controllo Velocità", 3),
    ("Zero ", 6),
    ("Interpolatore", 7),
    ("Asse elettrico", -2),
    ("Save/load", -50),
];

/// Compares the bits of the vendor's control word and status word, and their meanings in each mode.
#[test]
fn bits_of_control_and_status_word_are_the_printed_ones() {
    let Some(manual) = manual() else { return };
    let compilation = table();
    for (name, first, last, counts, edges) in
        [("DriveCommand", 47, 67, (8, 13), 4), ("DriveStatus", 142, 162, (8, 15), 0)]
    {
        let fields = fields(device(&compilation), name);
        let (mut bit, mut bits, mut meanings, mut rising) = (0, BTreeSet::new(), 0, 0);
        for (line, text) in lines(&manual, first, last) {
            let mode = MODES.iter().find(|(word, _)| text.contains(word)).map(|entry| entry.1);
            let begins = text.strip_prefix("bit ").and_then(|rest| rest.split(' ').next());
            bit = begins.map_or(bit, |digits| digits.parse().expect("a bit"));
            // Skip a line that continues the previous line.
            if begins.is_none() && mode.is_none() {
                continue;
            }
            let found = fields.iter().find(|entry| entry.offset == bit && cites(entry.documentation.as_deref(), line));
            let found = found.unwrap_or_else(|| panic!("line {line}: {name} has no bit {bit}"));
            let when: Vec<i128> =
                found.when.iter().flat_map(|condition| &condition.values).filter_map(Value::as_int).collect();
            assert_eq!(when, Vec::from_iter(mode), "line {line}");
            let label = found.names.first().map_or("", |name| name.text.as_str()).replace(' ', "").to_lowercase();
            assert!(text.replace(' ', "").to_lowercase().contains(&label), "line {line} {label}");
            let is_edge = text.contains("0 \u{FFFD} 1") || text.contains("0\u{FFFD} 1");
            assert_eq!(found.trigger == Some(Trigger::Rising), is_edge, "line {line}");
            rising += usize::from(is_edge);
            bits.insert(bit);
            meanings += 1;
        }
        assert_eq!(((bits.len(), meanings), rising), (counts, edges), "{name}");
        let named = fields.iter().filter(|entry| !matches!(entry.meaning, BitMeaning::Reserved { .. }));
        assert_eq!(named.count(), meanings, "{name}");
    }
}

/// Compares the bits that the vendor defines in 0x6040 and 0x6041.
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
        assert_eq!(printed.iter().map(|row| row.1).collect::<Vec<_>>(), expected, "{name}");
        for (line, bit) in printed {
            let field = fields(device(&compilation), name).iter().find(|field| field.offset == bit).expect("a bit");
            assert!(cites(field.documentation.as_deref(), line), "line {line}");
            assert!(!matches!(field.meaning, BitMeaning::Reserved { .. }), "line {line}");
            // For one bit of the controlword, the manual states that a rising edge triggers the effect.
            let is_edge = manual[line - 1].contains("transizione da 0 a 1") && name == "Controlword";
            assert_eq!(field.trigger == Some(Trigger::Rising), is_edge, "line {line}");
        }
    }
}

#[test]
fn bits_of_the_error_register_are_the_printed_ones() {
    let Some(manual) = manual() else { return };
    let compilation = table();
    let mut printed: Vec<(u8, String, usize)> = Vec::new();
    for (line, text) in lines(&manual, 2978, 2999).filter(|(_, text)| !text.is_empty()) {
        let digits = text.split(' ').next().and_then(|entry| entry.parse().ok());
        match (digits, printed.last_mut()) {
            (Some(bit), _) => printed.push((bit, text[1..].trim().to_lowercase(), line)),
            (None, Some(row)) => row.1 += &format!(" {}", text.to_lowercase()),
            _ => panic!("line {line}"),
        }
    }
    let fields = fields(device(&compilation), "ErrorRegister");
    assert_eq!((printed.len(), fields.len()), (8, 8));
    for ((bit, cause, line), row) in printed.iter().zip(fields) {
        assert!(row.offset == *bit && cites(row.documentation.as_deref(), *line), "line {line}");
        match row.meaning {
            BitMeaning::Reserved { write } => assert_eq!((cause.as_str(), write), ("reserved (always 0)", Some(false))),
            _ => assert_eq!(row.name, cause.trim(), "line {line}"),
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
    let values = values(device(&compilation), "TransmissionType");
    assert_eq!((printed.len(), values.len()), (6, 6));
    for ((line, text), row) in printed.iter().zip(values) {
        let (numbers, kind) = text.split_once(' ').expect("numbers and a kind");
        let ends: Vec<i128> = numbers.split("...").map(|number| number.parse().expect("a type")).collect();
        assert_eq!((row.value, row.last), (ends[0], ends.get(1).copied()), "line {line}");
        assert!(cites(row.documentation.as_deref(), *line), "line {line}");
        match row.zone {
            Some(zone) => assert_eq!((zone, kind), (Zone::Reserved, "reserved"), "line {line}"),
            None => assert_eq!(row.name, kind.replace("RTR only", "on request"), "line {line}"),
        }
    }
}

/// Compares the outputs of the miniECO (section "digital_output in : miniECO e miniECO PLUS"). Two of the four outputs
/// have no function.
#[test]
fn outputs_of_the_mini_eco_are_the_printed_ones() {
    let Some(manual) = manual() else { return };
    let compilation = table();
    let fields = fields(device(&compilation), "DigitalOutputs");
    for (first, last) in [(1941, 1944), (4738, 4741)] {
        let mut without = 0;
        for (line, text) in lines(&manual, first, last) {
            let mut words = text.splitn(3, ' ');
            let mut number = || words.next().and_then(|word| word.parse::<u8>().ok()).expect("a number");
            let (pin, bit) = (number(), number());
            let function = words.next().unwrap_or_default();
            let of_model = |field: &&BitFieldEntry| {
                let models = field.availability.as_ref().map_or(&[][..], |availability| &availability.models);
                field.offset == bit && (models.is_empty() || models.iter().any(|model| model == "miniECO"))
            };
            let found: Vec<_> = fields.iter().filter(of_model).collect();
            assert_eq!(found.len(), 1, "line {line}");
            let doc = found[0].documentation.as_ref().expect("a text");
            assert!(cites(Some(doc), line) && doc.text.starts_with(&format!("Pin {pin}")), "line {line}");
            assert_eq!(doc.text.contains("no function on the miniECO"), function.is_empty(), "line {line}");
            let orig = found[0].names.first().map(|name| name.text.as_str());
            match function {
                "" => without += 1,
                "Brake / Digital Out" => assert_eq!(found[0].name, "brake"),
                function => assert_eq!(orig, Some(function)),
            }
        }
        assert_eq!(without, 2, "line {first}");
    }
}
