//! Compares the printed frames, the availability of commands, and the completion of commands with the register table.

use std::collections::{BTreeMap, BTreeSet};

use lexibus_codegen::ir::{Completion, Message, MessageField};

use super::hsd_support::frames::{self, Byte, Layout};
use super::hsd_support::{device, message, number, table, Manual};

/// Section, name and lengths of the parameter values of each printed message. The manual prints some messages with several
/// lengths.
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

/// Lines of printed frames that the register table corrects. Each correction has a `doubt` entry.
const MISPRINTED: [usize; 5] = [
    249,  // The status is printed next to the node.
    250,  // The status is missing.
    276,  // The status is printed next to the node.
    845,  // PL2 is printed as PL1.
    1446, // The reply to CmdChgPar is called CmdJog.
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
        let actual = message(device, name);
        let mut layout = Layout::new(device);
        if !sizes.is_empty() {
            layout.values = sizes.to_vec();
        }
        // The manual prints the first two samples and the last sample, so the layout repeats the fields three times.
        layout.count = 3;
        let request = if actual.request.is_empty() { Vec::new() } else { layout.request(actual) };
        let (mut request, mut reply) = (request, layout.reply(actual));
        // The manual's 32-bit frame of CmdGetParN lacks the zero before the code.
        if name == "CmdGetParN" && *sizes == [4] {
            assert_eq!((request.remove(4), reply.remove(4)), (Byte::Constant(0), Byte::Constant(0)));
        }
        let rows: Vec<&frames::Row> = frame.rows.iter().filter(|row| row.number != "...").collect();
        let asked = rows.iter().filter(|row| !row.request.is_empty()).map(|row| (row.line, &row.request));
        let answered = rows.iter().filter(|row| !row.reply.is_empty()).map(|row| (row.line, &row.reply));
        assert_eq!((asked.clone().count(), answered.clone().count()), (request.len(), reply.len()), "{name}");
        for ((line, cell), byte) in asked.zip(&request).chain(answered.zip(&reply)) {
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
    // Line 238 contains `09x`, and the other lines contain the CmdGetParN frame without its zero.
    assert_eq!(odd, [238, 908, 909, 910, 911, 912, 913]);
}

#[test]
fn opcodes_are_the_printed_ones_and_all_different() {
    let compilation = table();
    let device = device(&compilation);
    let requests: Vec<_> = device.messages.iter().filter(|message| !message.request.is_empty()).collect();
    let nulls = requests.iter().filter(|request| request.name.starts_with("Poll ")).count();
    assert_eq!((requests.len() - nulls + 1, nulls, device.messages.len()), (37, 4, 41));
    let obsolete = requests
        .iter()
        .filter(|request| request.availability.as_ref().is_some_and(|availability| availability.replaced_by.is_some()));
    assert_eq!(obsolete.count(), 6);
    let mut echoed = (0, 0);
    for entry in requests.iter().filter(|request| !request.name.starts_with("Poll ")) {
        let reply = Layout::new(device).reply(entry);
        let is_echo = reply.len() == 9
            && !entry
                .reply
                .iter()
                .any(|field| matches!(field, MessageField::Value(value) if value.item.name != "status"));
        let is_value = reply.len() == 9 && matches!(entry.reply.last(), Some(MessageField::Value(_)));
        echoed = (echoed.0 + usize::from(is_echo), echoed.1 + usize::from(is_value));
    }
    // Of the replies with nine bytes, 26 contain no value except the status, and six end with a value. The other messages are
    // CmdTrajVel, null, CmdGetDistMicroZero, CmdGetParN and CmdGetSamp.
    assert_eq!(echoed, (26, 6));
}

/// Compares the models that support each command with the notes in the manual. A note restricts a command to all motors except
/// the SM137 before revision C, or to the SM140.
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
    for message in &device.messages {
        let models = message.availability.as_ref().map_or(0, |availability| availability.models.len());
        assert_eq!(models, noted.get(message.name.as_str()).copied().unwrap_or(0), "{}", message.name);
    }
}

#[test]
fn null_replies_and_what_selects_them() {
    let Some(manual) = Manual::read() else { return };
    let compilation = table();
    let device = device(&compilation);
    let printed: Vec<String> = manual.rows(657, 660).into_iter().map(|(_, cells)| cells[0].clone()).collect();
    let polls: Vec<_> = device.messages.iter().filter(|message| message.name.starts_with("Poll ")).collect();
    let selected: Vec<&str> = polls.iter().map(|poll| poll.after.as_ref().expect("a selection").as_str()).collect();
    assert_eq!(selected, printed);
    let defaults: Vec<bool> = polls.iter().map(|poll| poll.by_default).collect();
    assert_eq!(defaults, [true, false, false, false]);
    let layout = Layout::new(device);
    let same = |message: &&Message| layout.request(message) == layout.request(polls[0]) && message.error.is_none();
    assert!(polls.iter().all(same));
}

#[test]
fn completion_is_at_once_polled_or_late() {
    let compilation = table();
    let device = device(&compilation);
    let by = |is: &dyn Fn(&Completion) -> bool| {
        let messages = device.messages.iter().filter(|message| is(&message.completion));
        messages.map(|entry| entry.name.as_str()).collect::<Vec<_>>()
    };
    let polled = |certain: bool| move |completion: &Completion| matches!(completion, Completion::Polled { in_reply, .. } if *in_reply == certain);
    assert_eq!(by(&polled(true)), ["CmdReg", "CmdHold", "CmdAzz", "CmdTraj", "CmdTrajVel"]);
    assert_eq!(by(&polled(false)), ["CmdAzzEl"]);
    let late = ["CmdSaveParFl", "CmdAdcOff", "CmdRegWait", "CmdHoldWait", "CmdAzzElWait"];
    assert_eq!(by(&|completion| *completion == Completion::Reply), late);
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
        let byte = |cell: &str| cell.split('(').nth(1).and_then(|entry| number(entry.trim_end_matches(')')));
        assert_eq!(byte(&cells[1]), Some(i128::from(*escaped)));
        assert_eq!(byte(&cells[3]), framing.escape.map(i128::from));
        assert_eq!(byte(&cells[4]), Some(i128::from(escaped ^ framing.escape_xor)));
    }
    assert_eq!(framing.escaped, [0x02, 0x03, 0x1B]);
    assert_eq!((framing.start, framing.end, framing.escape), (Some(0x02), Some(0x03), Some(0x1B)));
    assert_eq!((framing.check.as_str(), framing.check_seed, framing.check_escaped), ("xor", 0xFF, true));
    assert!(manual.line(185).contains("68") && framing.max_data == Some(68));
}

/// Compares encoded frames with the frames that the notes on the manual contain.
#[test]
fn frames_on_the_wire() {
    let compilation = table();
    let device = device(&compilation);
    let framing = device.framing.as_ref().expect("a framing");
    type Given<'a> = &'a [(&'a str, u32)];
    let wire = |name: &str, is_reply: bool, given: Given<'_>| {
        let (layout, actual) = (Layout::new(device), message(device, name));
        let frame = if is_reply { layout.reply(actual) } else { layout.request(actual) };
        let value = |field: &str, at: usize| {
            let (_, value) = given.iter().find(|(given, _)| *given == field).unwrap_or_else(|| panic!("{field}"));
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
    // The reply CmdNACK contains bytes 3 to 5 of the CmdJogN request above.
    let nack = [("node", 1), ("status", 2), ("byte 3", 0x00), ("byte 4", 0xFD), ("byte 5", 0xBE)];
    assert_eq!(wire("CmdNACK", true, &nack), "02 01 1B FD B0 00 FD BE 0F 03");
}
