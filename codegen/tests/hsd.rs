//! The table of the HSD SM137 and SM140, held against the text of their manual: every frame byte by byte, every parameter with its
//! size, unit, scale, default and range per model, alarms, states, bits, and the table of commands and states cell by cell. What
//! the table deliberately reads otherwise is in a list here, and has a doubt.

mod hsd_support;

use std::collections::{BTreeMap, BTreeSet};

use hsd_support::frames::{self, Byte, Layout};
use hsd_support::{cells, chapter, code, device, line, message, number, original, table, underlying, values, Manual};
use lexibus_codegen::ir::{BitMeaning, Completion, Device, Item, Outcome, Scale, Shape, Type, Value};

#[test]
fn the_table_has_no_findings() {
    let compilation = table();
    let found: Vec<String> = compilation.diagnostics.list().iter().map(|found| compilation.one_line(found)).collect();
    assert_eq!(found, Vec::<String>::new());
}

/// The message of a section, and how long its parameters are: the manual has some frames for several lengths.
const FRAMES: [(&str, &str, &[usize]); 41] = [
    ("3.2", "CmdReset", &[]),
    ("3.3", "CmdNoReg", &[]),
    ("3.4", "CmdReg", &[]),
    ("3.5", "CmdHold", &[]),
    ("3.6", "CmdMazz", &[]),
    ("3.7", "CmdAzz", &[]),
    ("3.8", "CmdJogN", &[]),
    ("3.9", "CmdTraj", &[]),
    ("3.10", "CmdTrajVel", &[]),
    ("3.11", "Poll position", &[]),
    ("4.1", "CmdEmerg", &[]),
    ("4.2", "CmdSetOverr", &[]),
    ("4.3", "CmdGetOverr", &[]),
    ("4.4", "CmdChgParN", &[2]),
    ("4.4", "CmdChgParN", &[4]),
    ("4.4", "CmdChgParN", &[2, 4, 4]),
    ("4.5", "CmdGetParN", &[2]),
    ("4.5", "CmdGetParN", &[4]),
    ("4.6", "CmdSaveParFl", &[]),
    ("4.7", "CmdAdcOff", &[]),
    ("4.8", "CmdAzzEl", &[]),
    ("4.9", "CmdGetStatAzz", &[]),
    ("4.10", "CmdGetDistMicroZero", &[]),
    ("4.11", "CmdGetPos", &[]),
    ("4.12", "CmdGetPosT", &[]),
    ("4.13", "CmdGetVel", &[]),
    ("4.14", "CmdGetTor", &[]),
    ("4.15", "CmdGetAlarm", &[]),
    ("4.16", "CmdGetVer", &[]),
    ("4.17", "CmdGetType", &[]),
    ("4.18", "CmdGetSmStat", &[]),
    ("4.19", "CmdSampleVar", &[]),
    ("4.20", "CmdSampleMem", &[]),
    ("4.21", "CmdGetSamp", &[]),
    ("5.1", "CmdRegWait", &[]),
    ("5.2", "CmdHoldWait", &[]),
    ("5.3", "CmdJog", &[]),
    ("5.4", "CmdChgPar", &[]),
    ("5.5", "CmdAzzElWait", &[]),
    ("5.6", "CmdSample", &[]),
    ("", "CmdNACK", &[]),
];

/// Lines of frames that the table reads otherwise, each with its doubt.
const MISPRINTED: [usize; 5] = [
    249,  // the status beside the node
    250,  // and not where it is
    276,  // the status beside the node, too
    845,  // PL2 for PL1
    1446, // the reply to CmdChgPar is called CmdJog
];

#[test]
fn every_frame_is_there_byte_by_byte() {
    let Some(manual) = Manual::read() else { return };
    let compilation = table();
    let device = device(&compilation);
    let framing = device.framing.as_ref().expect("a framing");
    let printed = frames::printed(&manual);
    assert_eq!(printed.len(), 41);
    let mut wrong = BTreeSet::new();
    for (frame, (section, name, sizes)) in printed.iter().zip(FRAMES) {
        assert!(section.is_empty() || frame.title == section, "{} is {name}", frame.title);
        let own = message(device, name);
        let mut layout = Layout::new(device);
        if !sizes.is_empty() {
            layout.values = sizes.to_vec();
        }
        // Samples 1, 2, … N.
        layout.count = 3;
        let request = if own.request.is_empty() { Vec::new() } else { layout.request(own) };
        let (mut request, mut reply) = (request, layout.reply(own));
        // The frame of CmdGetParN for 32 bits lacks the zero in front of the code.
        if name == "CmdGetParN" && *sizes == [4] {
            assert_eq!((request.remove(4), reply.remove(4)), (Byte::Constant(0), Byte::Constant(0)));
        }
        let rows: Vec<&frames::Row> = frame.rows.iter().filter(|row| row.number != "...").collect();
        let asked = rows.iter().filter(|row| !row.request.is_empty()).map(|row| (row.line, &row.request));
        let told = rows.iter().filter(|row| !row.reply.is_empty()).map(|row| (row.line, &row.reply));
        assert_eq!((asked.clone().count(), told.clone().count()), (request.len(), reply.len()), "{name}");
        for ((line, cell), byte) in asked.zip(&request).chain(told.zip(&reply)) {
            let is_copy = cell.starts_with("Byte 0")
                && matches!(byte, Byte::Of(name, ..) if cell[5..7].parse() == name[5..].parse::<u8>().map(|at| at + 2));
            if !is_copy && !frames::meant(cell).is(byte, framing) {
                wrong.insert(line);
            }
        }
    }
    assert_eq!(wrong.into_iter().collect::<Vec<_>>(), MISPRINTED);
}

#[test]
fn the_numbers_of_bytes_count_on_but_where_a_doubt_says() {
    let Some(manual) = Manual::read() else { return };
    let mut odd = Vec::new();
    for frame in frames::printed(&manual) {
        for (row, expected) in frame.rows.iter().zip(1usize..) {
            if row.number.parse() != Ok(expected) && !row.number.starts_with("8+4 N") && row.number != "..." {
                odd.push(row.line);
            }
        }
    }
    // `09x`, and the frame of CmdGetParN without its zero.
    assert_eq!(odd, [238, 908, 909, 910, 911, 912, 913]);
}

#[test]
fn opcodes_are_the_printed_ones_and_all_different() {
    let compilation = table();
    let device = device(&compilation);
    let requests: Vec<_> = device.messages.iter().filter(|own| !own.request.is_empty()).collect();
    let nulls = requests.iter().filter(|own| own.name.starts_with("Poll ")).count();
    assert_eq!((requests.len() - nulls + 1, nulls, device.messages.len()), (37, 4, 41));
    let obsolete = requests.iter().filter(|own| own.availability.as_ref().is_some_and(|own| own.replaced_by.is_some()));
    assert_eq!(obsolete.count(), 6);
    let mut echoed = (0, 0);
    for own in requests.iter().filter(|own| !own.name.starts_with("Poll ")) {
        let reply = Layout::new(device).reply(own);
        let is_echo = reply.len() == 9
            && !own.reply.iter().any(
                |field| matches!(field, lexibus_codegen::ir::MessageField::Value(value) if value.item.name != "status"),
            );
        let is_value =
            reply.len() == 9 && matches!(own.reply.last(), Some(lexibus_codegen::ir::MessageField::Value(_)));
        echoed = (echoed.0 + usize::from(is_echo), echoed.1 + usize::from(is_value));
    }
    // CmdTrajVel, null, CmdGetDistMicroZero, CmdGetParN and CmdGetSamp are the others.
    assert_eq!(echoed, (26, 6));
}

/// The notes on who has a command, in the order of the manual: all motors but the SM137 before revision C, or the SM140 alone.
#[test]
fn who_has_a_command_is_as_its_note_says() {
    let Some(manual) = Manual::read() else { return };
    let compilation = table();
    let device = device(&compilation);
    let frames = frames::printed(&manual);
    let mut noted: BTreeMap<&str, usize> = BTreeMap::new();
    for (at, text) in manual.lines(1, manual.len()) {
        if text.trim().starts_with("N.B.: questo comando è utilizzabile") {
            let next = frames.iter().position(|frame| frame.rows[0].line > at).expect("a frame");
            noted.insert(FRAMES[next].1, if text.contains("solamente sul motore SM140") { 1 } else { 2 });
        }
    }
    assert_eq!((noted.len(), noted.values().filter(|&&models| models == 1).count()), (16, 1));
    for own in &device.messages {
        let models = own.availability.as_ref().map_or(0, |own| own.models.len());
        assert_eq!(models, noted.get(own.name.as_str()).copied().unwrap_or(0), "{}", own.name);
    }
}

#[test]
fn null_replies_and_what_selects_them() {
    let Some(manual) = Manual::read() else { return };
    let compilation = table();
    let device = device(&compilation);
    let printed: Vec<String> = manual.rows(657, 660).into_iter().map(|(_, cells)| cells[0].clone()).collect();
    let polls: Vec<_> = device.messages.iter().filter(|own| own.name.starts_with("Poll ")).collect();
    let selected: Vec<&str> = polls.iter().map(|own| own.after.as_deref().expect("a selection")).collect();
    assert_eq!(selected, printed);
    let defaults: Vec<bool> = polls.iter().map(|own| own.by_default).collect();
    assert_eq!(defaults, [true, false, false, false]);
    let layout = Layout::new(device);
    let same =
        |own: &&lexibus_codegen::ir::Message| layout.request(own) == layout.request(polls[0]) && own.error.is_none();
    assert!(polls.iter().all(same));
}

#[test]
fn completion_is_at_once_polled_or_late() {
    let compilation = table();
    let device = device(&compilation);
    let by = |is: &dyn Fn(&Completion) -> bool| {
        let own = device.messages.iter().filter(|own| is(&own.completion));
        own.map(|own| own.name.as_str()).collect::<Vec<_>>()
    };
    let polled = |certain: bool| move |own: &Completion| matches!(own, Completion::Polled { in_reply, .. } if *in_reply == certain);
    assert_eq!(by(&polled(true)), ["CmdReg", "CmdHold", "CmdAzz", "CmdTraj", "CmdTrajVel"]);
    assert_eq!(by(&polled(false)), ["CmdAzzEl"]);
    let late = ["CmdSaveParFl", "CmdAdcOff", "CmdRegWait", "CmdHoldWait", "CmdAzzElWait"];
    assert_eq!(by(&|own| *own == Completion::Reply), late);
    let times = ["CmdRegWait", "CmdAzzElWait"].map(|name| message(device, name).reply_time);
    assert_eq!(times, [Some(100), Some(100)]);
}

#[test]
fn framing_is_that_of_chapter_2() {
    let Some(manual) = Manual::read() else { return };
    let compilation = table();
    let framing = device(&compilation).framing.as_ref().expect("a framing");
    let rows = manual.rows(160, 162);
    assert_eq!(rows.len(), 3);
    for ((_, cells), escaped) in rows.iter().zip(&framing.escaped) {
        let byte = |cell: &str| cell.split('(').nth(1).and_then(|own| number(own.trim_end_matches(')')));
        assert_eq!(byte(&cells[1]), Some(i128::from(*escaped)));
        assert_eq!(byte(&cells[3]), framing.escape.map(i128::from));
        assert_eq!(byte(&cells[4]), Some(i128::from(escaped ^ framing.escape_xor)));
    }
    assert_eq!(framing.escaped, [0x02, 0x03, 0x1B]);
    assert_eq!((framing.start, framing.end, framing.escape), (Some(0x02), Some(0x03), Some(0x1B)));
    assert_eq!((framing.check.as_str(), framing.check_seed, framing.check_escaped), ("xor", 0xFF, true));
    assert!(manual.line(185).contains("68") && framing.max_data == Some(68));
}

/// The frames that the notes on the manual compute, in their order: message, values by field, bytes on the wire.
#[test]
fn frames_on_the_wire() {
    let compilation = table();
    let device = device(&compilation);
    let framing = device.framing.as_ref().expect("a framing");
    type Given<'a> = &'a [(&'a str, u32)];
    let wire = |name: &str, is_reply: bool, given: Given<'_>| {
        let (layout, own) = (Layout::new(device), message(device, name));
        let frame = if is_reply { layout.reply(own) } else { layout.request(own) };
        let value = |field: &str, at: usize| {
            let (_, value) = given.iter().find(|(own, _)| *own == field).unwrap_or_else(|| panic!("{field}"));
            value.to_le_bytes()[at]
        };
        let bytes = frames::wire(framing, &frame, &value);
        bytes.iter().map(|byte| format!("{byte:02X}")).collect::<Vec<_>>().join(" ")
    };
    assert_eq!(wire("CmdReset", false, &[("node", 5)]), "02 05 08 9C 00 00 00 6E 03");
    let target = [("node", 1), ("target", 1_798_046)];
    assert_eq!(wire("CmdTraj", false, &target), "02 01 1B FD 6F 9E 00 1B E4 16 03");
    let position = [("node", 1), ("position", 0x0102_AB34)];
    assert_eq!(wire("CmdMazz", false, &position), "02 01 01 AB 34 01 1B FD 63 03");
    let speed = [("node", 1), ("speed", 0xFDBE)];
    assert_eq!(wire("CmdJogN", false, &speed), "02 01 08 E0 00 FD BE 55 03");
    assert_eq!(wire("Poll position", false, &[("node", 1)]), "02 01 08 00 F6 03");
    let real = [("node", 1), ("status", 2), ("real position", 0x09C1_10AB)];
    assert_eq!(wire("Poll position", true, &real), "02 01 1B FD 10 AB 09 C1 8F 03");
    // Bytes 3 to 5 of the data of the jog above come back.
    let nack = [("node", 1), ("status", 2), ("byte 3", 0x00), ("byte 4", 0xFD), ("byte 5", 0xBE)];
    assert_eq!(wire("CmdNACK", true, &nack), "02 01 1B FD B0 00 FD BE 0F 03");
}

/// A parameter as the manual prints it: the lines of SM137 and SM140, and the cells of both.
struct Printed {
    lines: [usize; 2],
    code: u32,
    name: String,
    size: String,
    unit: String,
    /// Default and range, of SM137 and of SM140.
    values: [[String; 2]; 2],
}

/// The parameters of some lines; `has_size` where there are columns of size and unit. A parameter without a second line has none.
fn parameters(manual: &Manual, from: usize, to: usize, has_size: bool) -> Vec<Printed> {
    let mut found: Vec<Printed> = Vec::new();
    for (at, cells) in manual.rows(from, to) {
        let tail = |at: usize| cells.get(cells.len() - 2 + at).cloned().unwrap_or_default();
        match number(&cells[0]).filter(|_| cells[0].starts_with("0x")) {
            Some(code) => found.push(Printed {
                lines: [at, 0],
                code: code as u32,
                name: cells[2].clone(),
                size: if has_size { cells[3].clone() } else { String::new() },
                unit: if has_size { cells[4].clone() } else { String::new() },
                values: [[tail(0), tail(1)], Default::default()],
            }),
            None => match found.last_mut() {
                Some(own) if own.lines == [at - 1, 0] && cells[0].is_empty() && cells[2].is_empty() => {
                    (own.lines[1], own.values[1]) = (at, [tail(0), tail(1)]);
                }
                _ => {}
            },
        }
    }
    found
}

/// What a model has of a parameter: default, least and greatest value.
fn of_model(item: &Item, model: &str) -> [Option<i128>; 3] {
    let variant = item.variants.iter().find(|own| own.models.iter().any(|own| own == model));
    let int = |value: Option<&Value>| value.and_then(Value::as_int);
    let own = |of: &dyn Fn(&lexibus_codegen::ir::ItemVariant) -> Option<i128>, base| variant.and_then(of).or(base);
    [
        own(&|own| int(own.default.as_ref()), int(item.default.as_ref())),
        own(&|own| int(own.limits.low.as_ref()), int(item.limits.low.as_ref())),
        own(&|own| int(own.limits.high.as_ref()), int(item.limits.high.as_ref())),
    ]
}

/// The two numbers of a range: `0 / 32767`, `-(2^{31})-1/(2^{31}-1)`.
fn range(cell: &str) -> Option<[i128; 2]> {
    let plain = cell.replace(['$', '{', '}', ' '], "").replace("2³¹", "2^31");
    let (low, high) = plain.split_once('/')?;
    let one = |text: &str| match text {
        "-(2^31)-1" => Some(-(1 << 31) - 1),
        "(2^31-1)" | "(2^31)-1" => Some((1 << 31) - 1),
        other => other.parse().ok(),
    };
    Some([one(low)?, one(high)?])
}

/// What of its printed cells a row of the table reads otherwise.
fn differences(printed: &Printed, item: &Item) -> Vec<String> {
    let mut found = Vec::new();
    // Some have one line for both models.
    let lines = if printed.lines[1] == 0 { 1 } else { 2 };
    for (model, cells) in ["SM137 rev. C", "SM140"].into_iter().zip(&printed.values).take(lines) {
        let own = of_model(item, model);
        let given = cells[0].strip_prefix("8 EnetX ").map(|own| own.replace(" RS485", "")).unwrap_or(cells[0].clone());
        match number(&given) {
            Some(default) if own[0] == Some(default) => {}
            None if cells[0].is_empty() && own[0].is_none() => {}
            None if cells[0] == "--" && own[0].is_none() => {}
            _ => found.push(format!("{model} default {:?}", cells[0])),
        }
        match range(&cells[1]) {
            Some(range) if range.map(Some) == own[1..] => {}
            None if matches!(cells[1].as_str(), "" | "--") && own[1..] == [None, None] => {}
            _ => found.push(format!("{model} range {:?}", cells[1])),
        }
    }
    found
}

/// Holds parameters against their rows; returns what is read otherwise, each with its doubts.
fn compare(device: &Device, title: &str, printed: &[Printed]) -> Vec<(String, Vec<String>)> {
    let group = chapter(device, title);
    assert_eq!(group.items.len(), printed.len());
    let mut wrong = Vec::new();
    for (item, own) in group.items.iter().zip(printed) {
        assert_eq!(
            (code(item), line(item.documentation.as_ref().and_then(|own| own.cite.as_deref()))),
            (own.code, own.lines[0])
        );
        let name = if original(&item.names).is_empty() { item.name.as_str() } else { original(&item.names) };
        assert_eq!(name, own.name, "L{}", own.lines[0]);
        let differences = differences(own, item);
        if !differences.is_empty() {
            assert!(!item.doubts.is_empty() || item.availability.is_some(), "{name}: {differences:?}");
            wrong.push((item.name.to_string(), differences));
        }
    }
    wrong
}

#[test]
fn parameters_of_chapter_6() {
    let Some(manual) = Manual::read() else { return };
    let compilation = table();
    let device = device(&compilation);
    let pages = [(1510, 1535, 11), (1537, 1564, 12), (1566, 1601, 20), (1603, 1614, 4)];
    let mut printed = Vec::new();
    for (from, to, count) in pages {
        let page = parameters(&manual, from, to, true);
        assert_eq!(page.len(), count, "L{from}");
        printed.extend(page);
    }
    let holes: Vec<u32> = (0x100..=0x130).filter(|code| !printed.iter().any(|own| own.code == *code)).collect();
    assert_eq!((printed.len(), holes.as_slice()), (47, &[0x102, 0x129][..]));
    let sizes = |size: &str| printed.iter().filter(|own| own.size == size).count();
    assert_eq!((sizes("16bit"), sizes("32bit"), sizes("")), (32, 4, 11));
    let wrong = compare(device, "Parameters", &printed);
    let names: Vec<&str> = wrong.iter().map(|(name, _)| name.as_str()).collect();
    let expected = ["ORIG_AZZ", "LOW_SLIM", "HIGH_SLIM", "RESERVED4", "TIMEOUTFB", "INVDIN", "TIPOAZZ", "VAZZOUTMIC"];
    assert_eq!(names, expected, "{wrong:#?}");
    for (item, own) in chapter(device, "Parameters").items.iter().zip(&printed) {
        let bits = underlying(device, item.ty).bits();
        let is_tuned = matches!(own.code, 0x120..=0x123);
        match own.size.as_str() {
            "16bit" => assert_eq!(bits, Some(16), "{}", item.name),
            "32bit" => assert_eq!(bits, Some(32), "{}", item.name),
            _ => assert_eq!(bits, is_tuned.then_some(16), "{}", item.name),
        }
        assert_eq!(
            unit(item, own.code),
            own.unit.to_lowercase().replace("x ", "x").replace(" ²", "²"),
            "{}",
            item.name
        );
    }
}

/// The unit of a parameter as the manual would print it; empty where it prints none.
fn unit(item: &Item, code: u32) -> String {
    let Some(quantity) = item.quantity.as_ref() else { return String::new() };
    let symbol = match quantity.unit.as_str() {
        "V" => "volt ",
        "A" => "a",
        "ms" => "msec",
        "count" => "cnt",
        "count/s²" => return "10000 cnt/sec²".to_owned(),
        other => other,
    };
    match &quantity.scale {
        // RESERVED1 and TIMEOUTFB have units in the text only.
        _ if matches!(code, 0x120 | 0x12D) => String::new(),
        Some(Scale::Linear { factor, .. }) => format!("{symbol}x{factor}"),
        _ => symbol.to_owned(),
    }
}

#[test]
fn low_level_parameters() {
    let Some(manual) = Manual::read() else { return };
    let compilation = table();
    let device = device(&compilation);
    let printed = parameters(&manual, 1760, 1864, false);
    assert_eq!(printed.len(), 46);
    let low: Vec<u32> = printed.iter().map(|own| own.code & 0xFFF).collect();
    assert_eq!(low, (0..=0x2D).collect::<Vec<_>>());
    let wrong = compare(device, "Low-level parameters", &printed);
    let names: Vec<&str> = wrong.iter().map(|(name, _)| name.as_str()).collect();
    // The line of the SM140 is empty.
    assert_eq!(names, ["KIQDLIMIN"], "{wrong:#?}");
    let chapters = ["Parameters", "Low-level parameters"].map(|title| chapter(device, title));
    assert_eq!(chapters.map(|group| group.items.len()).iter().sum::<usize>(), 93);
    let printed = |item: &Item| match original(&item.names) {
        "" => item.name.to_string(),
        name => name.to_owned(),
    };
    let names = chapters.map(|group| group.items.iter().map(printed).collect::<BTreeSet<_>>());
    assert_eq!(names[0].intersection(&names[1]).count(), 12);
    let low_halves = chapters[1].items.iter().filter(|item| item.extensions.iter().any(|own| own.key == "upper_half"));
    assert_eq!(low_halves.count(), 4);
}

#[test]
fn alarms_and_warnings() {
    let Some(manual) = Manual::read() else { return };
    let compilation = table();
    let device = device(&compilation);
    let pages = [(0, vec![(2129, 2138), (2140, 2152), (2154, 2159)], 23, 8), (1, vec![(2175, 2188)], 12, 3)];
    for (at, pages, count, starred) in pages {
        let own = &device.code_tables[at];
        let rows: Vec<_> = pages.iter().flat_map(|(from, to)| manual.rows(*from, *to)).collect();
        let rows: Vec<_> = rows.into_iter().filter(|(_, cells)| cells[0].starts_with("0x")).collect();
        assert_eq!((rows.len(), own.rows.len()), (count, count));
        let mut with_mark = 0;
        for ((at, cells), row) in rows.iter().zip(&own.rows) {
            assert_eq!(number(&cells[0]), Some(row.code));
            assert_eq!(line(row.documentation.as_ref().and_then(|own| own.cite.as_deref())), *at);
            // What `cells` makes of (*) is ().
            let raw = manual.line(*at);
            let name = cells[1].replace(['(', ')'], "").replace("1", "").replace("2 INTERP", "2INTERP");
            let name = if row.code == 0x400B { name.replace('2', "") } else { name };
            let is_misspelt = name.trim() == "ALWROGSETP";
            assert!(original(&row.names) == name.trim() || is_misspelt, "{name} {}", original(&row.names));
            let models = row.availability.as_ref().map_or(&[][..], |own| &own.models);
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
        let own = values(device, name);
        assert_eq!((rows.len(), own.len()), (count, count), "{name}");
        for ((_, cells), value) in rows.iter().zip(own) {
            let is_misspelt = cells[label] == "SARCHINGTACCA";
            assert_eq!(number(&cells[code]), Some(value.value), "{name}");
            assert!(original(&value.names) == cells[label] || is_misspelt || name == "MotorType", "{}", cells[label]);
        }
    };
    check("State", 1959, 1974, 14, 0, 2);
    check("HomingState", 2107, 2114, 6, 0, 1);
    check("MotorType", 1213, 1221, 6, 0, 2);
    for (_, cells) in manual.rows(2109, 2114) {
        let own = values(device, "HomingState").iter().find(|own| number(&cells[0]) == Some(own.value)).expect("it");
        let types: Vec<i128> = cells[3].split(" - ").filter_map(number).collect();
        let when: Vec<i128> = own.when.as_ref().expect("types").values.iter().filter_map(Value::as_int).collect();
        // Index in types 0 and 2, by the text.
        assert!(types == when || (own.value == 6 && when == [0, 2]), "{cells:?} {when:?}");
    }
    for (_, cells) in manual.rows(1215, 1221).iter().filter(|(_, cells)| !cells[0].is_empty()) {
        let own = values(device, "MotorType").iter().find(|own| number(&cells[0]) == Some(own.value)).expect("it");
        assert_eq!(own.name, format!("{} {}", cells[1], cells[2]));
    }
    // The same six states in section 4.9, in another order.
    let section: BTreeSet<_> = manual
        .rows(1005, 1012)
        .into_iter()
        .filter_map(|(_, cells)| {
            let (name, rest) = cells[0].split_once('(')?;
            Some((number(rest.split(')').next()?)?, name.trim().to_owned()))
        })
        .collect();
    let own = values(device, "HomingState").iter().map(|own| (own.value, original(&own.names).to_owned()));
    assert_eq!(section, own.collect());
}

#[test]
fn bits_are_the_printed_ones() {
    let Some(manual) = Manual::read() else { return };
    let compilation = table();
    let device = device(&compilation);
    let fields = |name: &str| match &device.types.iter().find(|own| own.name == name).expect("bits").shape {
        Shape::BitField { fields, .. } => fields,
        other => panic!("{other:?}"),
    };
    let rows: Vec<_> = [(1618, 1631), (1633, 1635)].iter().flat_map(|(from, to)| manual.rows(*from, *to)).collect();
    let rows: Vec<_> = rows.into_iter().filter(|(_, cells)| number(&cells[0]).is_some()).collect();
    assert_eq!((rows.len(), fields("BitA").len()), (13, 13));
    for (at, cells) in &rows {
        let own = fields("BitA").iter().find(|own| Some(i128::from(own.offset)) == number(&cells[0])).expect("a bit");
        let availability = own.availability.as_ref();
        let (models, since) =
            (availability.map_or(0, |own| own.models.len()), availability.and_then(|own| own.since.as_deref()));
        let text = &cells[2];
        assert_eq!(matches!(own.meaning, BitMeaning::Reserved { .. }), text.starts_with("Riservato."), "L{at}");
        let only = match () {
            () if text.starts_with("Solo per SM140 e SM137 rev. C") => 2,
            () if text.starts_with("Solo per SM140") => 1,
            () => 0,
        };
        assert_eq!(models, only, "L{at}");
        assert_eq!(since, text.contains("ersione 119").then_some("119"), "L{at}");
    }
    for (name, from, to, count) in [("BitStato", 2202, 2205, 4), ("InvertedInputs", 2231, 2233, 3)] {
        let rows = manual.rows(from, to);
        assert_eq!((rows.len(), fields(name).len()), (count, count));
        for (_, cells) in rows {
            let bit = number(cells[0].trim_start_matches("Bit "));
            let own = fields(name).iter().find(|own| Some(i128::from(own.offset)) == bit).expect("a bit");
            assert!(name != "BitStato" || original(&own.names) == cells[1], "{cells:?}");
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
            let (_, own) = model.constants.iter().find(|(own, _)| own == name).expect("a constant");
            let printed = &cells[if model.name == "SM140" { 2 } else { 1 }];
            assert_eq!(own.as_real(), printed.parse().ok(), "{} {name}", model.name);
        }
    }
}

/// The table of commands and states, cell by cell, from both of its halves.
#[test]
fn commands_and_states() {
    let Some(manual) = Manual::read() else { return };
    let compilation = table();
    let device = device(&compilation);
    let machine = device.machines.iter().find(|own| own.name == "axis").expect("the machine");
    let states = values(device, "State");
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    let mut starred = BTreeSet::new();
    let mut at = 0;
    for (from, first, count) in [(1990, 0, 7), (2028, 7, 6)] {
        let head = cells(manual.line(from - 1)).expect("the states");
        for (row, own) in machine.outcomes.iter().enumerate() {
            let cells = cells_with_stars(manual.line(from + row));
            if cells[0].ends_with('*') && !cells[0].contains("INTER*")
                || cells[0].contains("INTERP*")
                || cells[0].contains("INTER*")
            {
                starred.insert(row);
            }
            for column in 0..count {
                let name = head[1 + column].split(['(', ' ']).next().unwrap_or_default();
                let cell = &own.cells[first + column];
                let state = states.iter().find(|state| state.name == cell.state).expect("the state");
                assert_eq!(original(&state.names), name);
                let (kind, expected) = outcomes(&cells[1 + column], states);
                assert_eq!(cell.outcomes, expected, "{} {name}", own.name);
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
    assert_eq!(machine.initial.as_deref(), Some("alarm"));
}

fn cells_with_stars(line: &str) -> Vec<String> {
    line.trim().trim_matches('|').split('|').map(|cell| cell.trim().to_owned()).collect()
}

/// What a cell of the manual means, and its kind.
fn outcomes(cell: &str, states: &[lexibus_codegen::ir::EnumValue]) -> (&'static str, Vec<Outcome>) {
    let cell = cell.replace("Effettua l'azzeramento manuale", "");
    let plain: String = cell.chars().filter(|c| !"(0123456789)".contains(*c)).collect();
    let one = |text: &str| match text.trim() {
        "=" | "==" => Outcome::Unchanged,
        "= errore" | "== errore" => Outcome::Refused,
        chain => Outcome::States(
            chain
                .split('⇒')
                .map(|state| {
                    let own = states.iter().find(|own| original(&own.names) == state.trim());
                    own.unwrap_or_else(|| panic!("{state}")).name.clone()
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

/// What raw numbers are in physical units, by the facts of the table: the worked examples of the manual that are right, and those
/// that are right once their misprint is repaired.
#[test]
fn worked_examples() {
    let compilation = table();
    let device = device(&compilation);
    let given = |name: &str| device.given.iter().find(|own| own.name == name).expect("a given number");
    let model = |own: &lexibus_codegen::ir::GivenNumber, name: &str| {
        own.models.iter().find(|(own, _)| own == name).and_then(|(_, value)| value.as_real())
    };
    assert_eq!(model(given("counts per turn"), "SM137 rev. C"), Some(800.0));
    assert_eq!(model(given("counts per turn"), "SM140"), Some(2000.0));
    let (pitch, turn) = (0.32, 800.0);
    let field = |name: &str, is_reply: bool, field: &str| {
        let own = message(device, name);
        let fields = if is_reply { &own.reply } else { &own.request };
        fields
            .iter()
            .find_map(|own| match own {
                lexibus_codegen::ir::MessageField::Value(value) if value.item.name == field => Some(value.item.clone()),
                _ => None,
            })
            .expect("the field")
    };
    let machine = |item: &Item, raw: f64, turn: f64| {
        physical(device, item, "SM137 rev. C", raw, &[("screw pitch", pitch), ("counts per turn", turn)])
    };
    // L365 (6780.8465 mm, not L361's 6766.8176), L546 (00 1B 6F 9E, not L550's 01), L498 and L617: truncated, as the rule says.
    let position = field("CmdMazz", false, "position");
    assert_eq!((6780.8465 / machine(&position, 1.0, turn)) as i64, 0x0102_AB34);
    let target = field("CmdTraj", false, "target");
    assert_eq!((1150.75 / machine(&target, 1.0, 500.0)) as i64, 0x001B_6F9E);
    let speed = field("CmdJogN", false, "speed");
    assert_eq!((-185.0 / machine(&speed, 1.0, turn)) as i16, 0xFDBEu16 as i16);
    let speed = field("CmdTrajVel", false, "speed");
    assert_eq!((150.0 / machine(&speed, 1.0, turn)) as u16, 0x01D4);
    // L668, L680, L682: positions and speeds that are read.
    let close = |one: f64, other: f64| assert!((one - other).abs() < 0.000_06, "{one} {other}");
    close(machine(&field("Poll theoretical position", true, "theoretical position"), 163_647_659.0, turn), 65_459.0636);
    close(machine(&field("Poll speeds", true, "theoretical speed"), 0x09C1 as f64, turn), 195.0781);
    close(machine(&field("Poll speeds", true, "real speed"), 0x10AB as f64, turn), 333.3594);
    // L1427: -185 mm/min as a fraction of 8000 rpm.
    let speed = field("CmdJog", false, "speed");
    assert_eq!((-185.0 / machine(&speed, 1.0, turn)) as i16, 0xF6C0u16 as i16);
    // L732: 90 %; L1185: firmware 103.
    assert_eq!(physical(device, &field("CmdSetOverr", false, "override"), "SM140", 0x5A as f64, &[]), 90.0);
    assert_eq!(physical(device, &field("CmdGetVer", true, "version"), "SM140", 0x67 as f64, &[]), 103.0);
    // L1708: 200 is 48.8 rpm. L1882: 5 A; the 11.313 A printed there give 14482, the base 14481.
    let items =
        |title: &str, name: &str| chapter(device, title).items.iter().find(|own| own.name == name).expect("it").clone();
    let rpm = physical(device, &items("Parameters", "RESERVED1"), "SM140", 200.0, &[]);
    assert_eq!((rpm * 10.0).trunc() / 10.0, 48.8);
    let amperes = physical(device, &items("Low-level parameters", "KVELLIMAX"), "SM137 rev. C", 1.0, &[]);
    assert_eq!(((5.0 / amperes) as i32, (5.0 / 11.313 * 32768.0) as i32), (14_481, 14_482));
    // L1892: 15.5 in two ways. L1917-1929: 0.58, 15 %, and 0.08 / 0.58, which is printed rounded.
    let Some(Scale::Exponent { base: 2, fraction: 15, exponent }) =
        &items("Low-level parameters", "KVELPIMANT").quantity.expect("a scale").scale.clone()
    else {
        panic!("mantissa and exponent");
    };
    assert_eq!(exponent, "KVELPIEXP");
    let me15 = |mantissa: f64, exponent: i32| mantissa / 32768.0 * 2f64.powi(exponent);
    assert_eq!((me15(31_744.0, 4), me15(15_872.0, 5)), (15.5, 15.5));
    assert_eq!((0.58 / me15(1.0, 0)) as i32, 19_005);
    assert_eq!((15.0 / physical(device, &items("Low-level parameters", "KVELKFF"), "SM140", 1.0, &[])) as i32, 4915);
    assert_eq!(
        (0.08 / 0.58 / physical(device, &items("Low-level parameters", "KVELKCOR"), "SM140", 1.0, &[])) as i32,
        4519
    );
    // L1949: 430 mm/s² are 17 whole steps of 78.125 turns/s², 425 mm/s².
    assert_eq!((430.0 / pitch / 78.125_f64).trunc() * 78.125 * pitch, 425.0);
    // L532, L593: the way is at most 67108863 counts from 1000.
    assert_eq!((1000 - 67_108_863, 1000 + 67_108_863), (-67_107_863, 67_109_863));
}

/// The physical number of a raw one, in the machine's unit where `numbers` gives what it takes.
fn physical(device: &Device, item: &Item, model: &str, raw: f64, numbers: &[(&str, f64)]) -> f64 {
    let Some(quantity) = item.quantity.as_ref() else { return raw };
    let constant = |name: &str| {
        let model = device.variants.iter().find(|own| own.name == model).expect("the model");
        let (_, value) = model.constants.iter().find(|(own, _)| own == name).expect("a constant");
        value.as_real().expect("a number")
    };
    let physical = match &quantity.scale {
        None => raw,
        Some(Scale::Linear { factor, offset }) => raw * factor + offset,
        Some(Scale::Fraction { bits, base }) => raw / f64::from(1u32 << bits) * constant(base),
        other => panic!("{other:?}"),
    };
    let given = |name: &str| numbers.iter().find(|(own, _)| *own == name).map(|(_, value)| *value);
    let Some(machine) = quantity.machine.as_ref().filter(|_| !numbers.is_empty()) else { return physical };
    let product = |list: &[lexibus_codegen::ir::CompactString]| {
        list.iter().map(|name| given(name).expect("given")).product::<f64>()
    };
    physical * product(&machine.times) / product(&machine.over)
}

/// The defaults of both sets of parameters say the same of one quantity, within a thousandth, but where a doubt says otherwise.
#[test]
fn defaults_of_both_chapters_agree() {
    let compilation = table();
    let device = device(&compilation);
    let value = |title: &str, name: &str, model: &str| {
        let item = chapter(device, title).items.iter().find(|own| own.name == name).expect("a parameter");
        let raw = of_model(item, model)[0].expect("a default") as f64;
        physical_of(device, item, title, model, raw)
    };
    let (mut compared, mut wrong) = (0, Vec::new());
    for model in ["SM137 rev. C", "SM140"] {
        let high = |name: &str| value("Parameters", name, model);
        let low = |name: &str| value("Low-level parameters", name, model);
        let turn = if model == "SM140" { 2000.0 } else { 800.0 };
        let pairs = [
            ("KIQDPIMANT", high("KP_I") + high("KI_I"), low("KIQDPIMANT")),
            ("KIQDKCOR", high("KI_I") / (high("KP_I") + high("KI_I")), low("KIQDKCOR")),
            ("KVELPIMANT", high("KP_VEL") + high("KI_VEL"), low("KVELPIMANT")),
            ("KVELKCOR", high("KI_VEL") / (high("KP_VEL") + high("KI_VEL")), low("KVELKCOR")),
            ("KPOSPIMANT", high("KP_POS") + high("KI_POS"), low("KPOSPIMANT")),
            ("KPOSKCOR", high("KI_POS") / (high("KP_POS") + high("KI_POS")), low("KPOSKCOR")),
            ("KVELKFF", high("KFF_VEL"), low("KVELKFF")),
            ("KPOSKFF", high("KFF_POS"), low("KPOSKFF")),
            ("KIQDLIMIN", high("PIMIN_I"), low("KIQDLIMIN")),
            ("KIQDLIMAX", high("PIMAX_I"), low("KIQDLIMAX")),
            ("KVELLIMIN", high("PIMIN_VEL"), low("KVELLIMIN")),
            ("KVELLIMAX", high("PIMAX_VEL"), low("KVELLIMAX")),
            ("KPOSLIMMIN", high("PIMIN_POS"), low("KPOSLIMMIN")),
            ("KPOSLIMAX", high("PIMAX_POS"), low("KPOSLIMAX")),
            ("AMAXHOLD", high("AMAX") / turn, low("AMAXHOLD")),
            ("AMAXTRAJ", high("AMAXPOS") / turn, low("AMAXTRAJ")),
            ("VMAXTRAJ", high("VMAXPOS"), low("VMAXTRAJ")),
            ("MAXERRORV", high("MAXERRORV"), low("MAXERRORV_LOW")),
            ("MAXTORQUE", high("MAXTORQ"), low("MAXTORQUE")),
            ("TIMEOUTMAXTORQUE", high("TIM_MAXTORQ"), low("TIMEOUTMAXTORQUE")),
        ];
        for (name, high, low) in pairs {
            compared += 1;
            if (high - low).abs() > 0.001 * high.abs().max(low.abs()) {
                wrong.push((model, name));
            }
        }
    }
    // 19.5 V and the whole of 19.6 V: a doubt of PIMIN_I and PIMAX_I.
    assert_eq!((compared, wrong), (40, vec![("SM140", "KIQDLIMIN"), ("SM140", "KIQDLIMAX")]));
}

/// A default in physical units, with the exponent that goes with a mantissa.
fn physical_of(device: &Device, item: &Item, title: &str, model: &str, raw: f64) -> f64 {
    match item.quantity.as_ref().and_then(|own| own.scale.as_ref()) {
        Some(Scale::Exponent { exponent, base: 2, fraction }) => {
            let other = chapter(device, title).items.iter().find(|own| own.name == *exponent).expect("the exponent");
            let exponent = of_model(other, model)[0].expect("a default") as i32;
            raw / f64::from(1u32 << fraction) * 2f64.powi(exponent)
        }
        _ => physical(device, item, model, raw, &[]),
    }
}

#[test]
fn what_is_doubted_stands_in_the_manual() {
    let Some(manual) = Manual::read() else { return };
    let compilation = table();
    let doubts = hsd_support::doubts(device(&compilation));
    assert!(doubts.len() > 100, "{}", doubts.len());
    for doubt in &doubts {
        let mut rest = doubt.as_str();
        while let Some(at) = rest.find("(L") {
            let lines = rest[at + 1..].split(')').next().unwrap_or_default();
            for own in lines.split([',', '-', ' ']).filter_map(|own| own.trim_start_matches('L').parse::<usize>().ok())
            {
                assert!(own >= 1 && own <= manual.len() && !manual.line(own).trim().is_empty(), "L{own}: {doubt}");
            }
            rest = &rest[at + 2..];
        }
    }
    let types = device(&compilation)
        .types
        .iter()
        .filter(|own| matches!(own.shape, Shape::Enumeration { base: Type::Unsigned(16), .. }));
    assert!(types.count() >= 4);
}
