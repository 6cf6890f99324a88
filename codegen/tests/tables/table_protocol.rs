//! Tests messages, process images, state machines and procedures in register tables.

use lexibus_codegen::compile::{check, Compilation, Options};
use lexibus_codegen::ir::{
    Binding, Completion, Device, Direction, GroupKind, ImageBinding, MessageField, Shape, Step, Type, Value,
};
use lexibus_codegen::source::Source;

use crate::table_support;

fn read(text: &str) -> Compilation {
    check(Source::new("t.toml", text.into()), &Options { no_profiles: true, ..Options::default() })
}

fn reported(compilation: &Compilation) -> Vec<String> {
    compilation.diagnostics.list().iter().map(|diagnostic| compilation.one_line(diagnostic)).collect()
}

fn device(compilation: &Compilation) -> &Device {
    &compilation.catalog.as_ref().expect("a device").devices[0]
}

const HEAD: &str =
    "lexibus = 1\n[device]\nname = \"M\"\nbuses = [\"serial\"]\n[spaces.p]\nparameter = true\n[[chapters]]\n\
                    [chapters.registers]\nSpeed = { reg = 1, type = \"i16\", access = \"rw\" }\n";

/// Returns the diagnostics of a table that contains `lines` after a row. File names are left out.
fn findings(lines: &str) -> Vec<String> {
    reported(&read(&format!("{HEAD}{lines}")))
}

/// Compiles the example of messages in the documentation.
fn example() -> Compilation {
    let blocks = table_support::examples();
    let block = blocks.iter().find(|(_, block)| block.contains("[[messages]]") && block.contains("lexibus = 1"));
    read(&block.expect("the example").1)
}

#[test]
fn messages_have_typed_fields() {
    let compilation = example();
    assert_eq!(reported(&compilation), Vec::<String>::new());
    let device = device(&compilation);
    let message = |name: &str| device.messages.iter().find(|message| message.name == name).expect("a message");
    let actual = message("Move");
    let MessageField::Value(target) = &actual.request[2] else { panic!("{:?}", actual.request) };
    assert_eq!(
        (target.item.name.as_str(), target.item.ty, target.byte_order.as_slice()),
        ("target", Type::Integer(32), &[2, 3, 0, 1][..])
    );
    assert_eq!(target.item.limits.high, Some(Value::Int(1_000_000)));
    assert!(target.item.bindings.is_empty());
    let MessageField::Value(status) = &actual.reply[2] else { panic!("{:?}", actual.reply) };
    let Type::Named(id) = status.item.ty else { panic!("{:?}", status.item.ty) };
    let definition = &device.types[id.0 as usize];
    assert!(matches!(&definition.shape, Shape::BitField { base: Type::Unsigned(4), fields } if fields.len() == 2));
    assert_eq!(actual.reply[4], MessageField::Echo { field: "target".into(), bytes: Some((1, 3)) });
    let polled =
        Completion::Polled { item: "status.done".into(), mask: None, value: Some(Value::Int(1)), in_reply: true };
    assert_eq!((&actual.completion, actual.error.as_ref().map(|error| error.as_str())), (&polled, Some("Refused")));
    assert_eq!((actual.accepted_in[0].as_str(), actual.accepted_when[0].item.as_str()), ("stopped", "gain"));
    assert_eq!(actual.reply[1], MessageField::FixedBits { bits: 4, value: 0 });
    assert_eq!(
        (message("PollSpeed").after.as_ref().map(|message| message.as_str()), message("PollSpeed").by_default),
        (Some("SelectSpeed"), false)
    );
    assert!(message("PollPosition").by_default);
    assert_eq!((&message("Store").completion, message("Store").reply_time), (&Completion::Reply, Some(100)));
    assert_eq!(message("Refused").reply[4], MessageField::Copy { first: 3, last: 5 });
    assert_eq!(message("GetState").side_effects.len(), 1);
}

#[test]
fn parameters_are_carried_by_messages() {
    let compilation = example();
    let device = device(&compilation);
    let space = &device.parameter_spaces[0];
    let messages =
        [&space.read, &space.write, &space.store].map(|item| item.as_ref().map_or("", |entry| entry.as_str()));
    assert_eq!(
        (messages, space.byte_order.as_slice()),
        (["ReadParameter", "WriteParameters", "Store"], &[2, 3, 0, 1][..])
    );
    let gain = &device.groups[0].items[0];
    assert_eq!(gain.bindings[0], Binding::parameter("parameter", 0x105));
    let request = &device.messages.iter().find(|message| message.name == "WriteParameters").expect("a message").request;
    let read = &device.messages.iter().find(|message| message.name == "ReadParameter").expect("a message").request;
    assert_eq!(read[3], MessageField::ItemPadding { space: "parameter".into() });
    let MessageField::Repeat { count: None, fields, .. } = &request[2] else { panic!("{request:?}") };
    let space = || "parameter".into();
    assert_eq!(
        *fields,
        [MessageField::ItemCode { space: space(), bits: 16 }, MessageField::ItemValue { space: space() }]
    );
    let framing = device.framing.as_ref().expect("a framing");
    assert_eq!(
        (framing.check.as_str(), framing.check_from.as_deref(), framing.check_escaped),
        ("xor", Some("node"), true)
    );
}

#[test]
fn mistakes_in_messages() {
    let lines = "[[messages]]\nrequest = []\n\
                 [[messages]]\nname = \"A\"\nrequest = [{ field = \"x\", type = \"i32\", order = \"BA\" }, { bytes = [1], pad = 1 }]\n\
                 reply = [{ echo = \"y\" }, { repeat = { count = \"n\", fields = [] } }, { code = \"q\" }, \
                 { fixed = 16, type = \"u4\" }, { fixed = 1 }, { copy = \"5..3\" }, { zeros_for = \"p2\" }]\n\
                 completion = { poll = \"Sped\" }\naccepted_in = [\"stopped\"]\nerror = \"B\"\n\
                 [[messages]]\nname = \"A\"\ncompletion = \"soon\"\nreplaced_by = \"C\"\n\
                 [framing]\ncheck = \"crc17\"\ncheck_from = \"node\"\n";
    insta::assert_snapshot!(findings(lines).join("\n"));
}

#[test]
fn units_of_the_machine_and_halves_of_numbers() {
    let lines = "Low = { reg = 2, type = \"u16\", access = \"rw\", upper = \"High\", unit = \"position\", same_quantity = \"Lowest\" }\n\
                 [given]\n\"screw pitch\" = { unit = \"mm/turns\", models = { X1 = 5, X2 = \"five\" } }\n\
                 [units]\nposition = { symbol = \"count\", machine = { unit = \"feet\", times = [\"pitch\"], over = [\"counts\"] } }\n\
                 [[models]]\nname = \"X1\"\n";
    insta::assert_snapshot!(findings(lines).join("\n"));
}

#[test]
fn images_have_items_and_fields_of_their_own() {
    let lines = "[[images]]\nname = \"in\"\ndirection = \"tx\"\nbytes = 8\norder = \"little\"\n[images.fields]\n\
                 Speed = { at = 1 }\nready = { at = 0, bit = 3, type = \"bool\", doc = \"It can go\" }\n\
                 text = { at = 3, type = \"str(4)\" }\n";
    let compilation = read(&format!("{HEAD}{lines}"));
    assert_eq!(reported(&compilation), Vec::<String>::new());
    let device = device(&compilation);
    let image = &device.process_data.images[0];
    assert_eq!((image.direction, image.length, image.big_endian), (Direction::Transmit, 8, false));
    let places: Vec<_> = image.fields.iter().map(|field| (field.name.as_str(), field.bit_offset, field.bits)).collect();
    assert_eq!(places, [("ready", 3, 1), ("Speed", 8, 16), ("text", 24, 32)]);
    let actual = device.groups.iter().find(|group| matches!(group.kind, GroupKind::Image { .. })).expect("a group");
    assert_eq!(actual.items.iter().map(|item| item.name.as_str()).collect::<Vec<_>>(), ["ready", "text"]);
    let speed = device.groups.iter().flat_map(|group| &group.items).find(|item| item.name == "Speed").expect("Speed");
    let image = ImageBinding { image: "in".into(), bit_offset: 8, bits: 16, ty: None };
    assert_eq!(speed.bindings[1], Binding::Image(Box::new(image)));
}

#[test]
fn mistakes_in_images() {
    let lines = "[[images]]\nname = \"a\"\nbytes = 2\n\
                 [[images]]\nname = \"b\"\ndirection = \"tx\"\nbytes = 4\norder = \"middle\"\n[images.fields]\n\
                 Speed = { at = 1, unit = \"rpm\" }\nlate = { at = 3, type = \"u16\" }\nover = { at = 2, type = \"u8\" }\n\
                 nowhere = { type = \"u8\" }\nlong = { at = 0, type = \"domain\" }\n";
    insta::assert_snapshot!(findings(lines).join("\n"));
}

#[test]
fn machines_and_procedures() {
    let lines = "[[messages]]\nname = \"Reset\"\n\
                 [machines.m]\nstatus = \"Speed\"\ncontrol = \"Speed\"\ndoc = \"How it moves\"\n\
                 [machines.m.states]\nstill = { mask = 1, value = 0, doc = \"Nothing moves\", orig = \"fermo\" }\n\
                 moving = { mask = 1, value = 1 }\n[machines.m.commands]\ngo = { mask = 1, value = 1 }\n\
                 [[machines.m.transitions]]\nfrom = [\"still\", \"moving\"]\nto = \"still\"\ncommand = \"Reset\"\ndoc = \"At once\"\n\
                 [procedures.read]\narguments = [\"speed\"]\n\
                 steps = [{ write = \"Speed\", argument = \"speed\" }, { write = \"Speed\", mask = 2, value = 2 }, \
                 { wait = \"Speed\", value = 3, timeout = 10 }, { read = \"Speed\" }]\n";
    let compilation = read(&format!("{HEAD}{lines}"));
    assert_eq!(reported(&compilation), Vec::<String>::new());
    let device = device(&compilation);
    let machine = &device.machines[0];
    let text = |item: &Option<std::sync::Arc<lexibus_codegen::ir::Documentation>>| {
        item.as_ref().map(|entry| entry.text.clone())
    };
    assert_eq!(text(&machine.documentation).as_deref(), Some("How it moves"));
    assert_eq!(text(&machine.states[0].documentation).as_deref(), Some("Nothing moves"));
    let transitions: Vec<_> = machine
        .transitions
        .iter()
        .map(|transition| (transition.number, transition.from.as_ref().map(|from| from.as_str())))
        .collect();
    assert_eq!(transitions, [(None, Some("still")), (None, Some("moving"))]);
    assert_eq!(text(&machine.transitions[0].documentation).as_deref(), Some("At once"));
    assert_eq!(
        device.procedures[0].steps,
        [
            Step::WriteArgument("Speed".into(), "speed".into()),
            Step::WriteBits("Speed".into(), 2, Value::Int(2)),
            Step::WaitFor("Speed".into(), u64::MAX, Value::Int(3), Some(10)),
            Step::Read("Speed".into()),
        ]
    );
    let rust = compilation.rust(&Options::default().rust).expect("bindings");
    assert!(rust.contains("still: `xxxx xxxx xxxx xxx0`. Nothing moves."), "{rust}");
}

#[test]
fn mistakes_in_machines_and_procedures() {
    let lines = "[machines.m]\nstatus = \"Spede\"\nfaults = [\"b\", \"d\"]\n[machines.m.states]\na = { mask = 1 }\nb = { mask = 1, value = 1 }\n\
                 [[machines.m.transitions]]\nfrom = \"c\"\ncommand = \"go\"\n\
                 [procedures.p]\nsteps = [{ write = \"Speed\" }, { write = \"Speed\", argument = \"x\" }, { delay = 3, value = 1 }, \
                 { read = \"Speed\", wait = \"Speed\", value = 1 }, { send = \"Reset\" }]\n";
    insta::assert_snapshot!(findings(lines).join("\n"));
}

#[test]
fn fault_states_of_machines() {
    let machine = |faults: &str| {
        let state = |at: usize| format!("s{at} = {{ mask = 7, value = {at} }}\n");
        let states: String = (0..6).map(state).collect();
        let transition = |(from, to): (&str, &str)| format!("[[machines.m.transitions]]\n{from}to = \"s{to}\"\n");
        let transitions: String =
            [("from = \"s4\"\n", "0"), ("", "2"), ("from = \"s2\"\n", "3")].map(transition).concat();
        read(&format!(
            "{HEAD}[machines.m]\nstatus = \"Speed\"\ncontrol = \"Speed\"\nfaults = {faults}\n[machines.m.states]\n{states}\
             [machines.m.commands]\ngo = {{ mask = 1, value = 1 }}\n\
             [[machines.m.transitions]]\nfrom = \"s0\"\nto = \"s1\"\ncommand = \"go\"\n{transitions}"
        ))
    };
    let faults = |given: &str| {
        let compilation = machine(given);
        assert_eq!(reported(&compilation), Vec::<String>::new());
        let rust = compilation.rust(&Options::default().rust).expect("bindings");
        let list = rust.split_once("const FAULTS: &'static [u8] = &[").expect("a list").1;
        let list = list.split_once("];").expect("the end of the list").0;
        list.split(',')
            .filter_map(|state| state.trim().strip_prefix("Self::")?.strip_suffix(" as u8").map(str::to_owned))
            .collect::<Vec<_>>()
    };
    assert_eq!(faults("[]"), ["S2", "S3"]);
    // A transition from a listed state does not make its target a fault state.
    assert_eq!(faults("[\"s4\", \"s3\", \"s4\"]"), ["S2", "S3", "S4"]);
    let unknown = machine("[\"s5\", \"s44\"]");
    assert_eq!(reported(&unknown), ["t.toml:13:17: no state has the name `s44` [TAB005]"]);
    assert_eq!(unknown.diagnostics.list()[0].help.as_deref(), Some("did you mean `s4`?"));
}

#[test]
fn a_sync_manager_is_that_of_an_assigned_pdo() {
    let found = findings("[[pdos]]\nindex = 0x1A00\ndirection = \"tx\"\nentries = [\"pad/8\"]\nsm = 3\n");
    assert!(found[0].contains("`sm` applies only to a PDO that is assigned by default"), "{found:?}");
}
