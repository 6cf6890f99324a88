//! Tests how an item is accessed on each bus: windows, process images, widths and access rights on a single bus, and memory
//! of slave controllers.

use lexibus_codegen::compile::{check, Compilation, Options};
use lexibus_codegen::ir::{Access, Binding, Bus, Item, Type};
use lexibus_codegen::source::Source;
use lexibus_codegen::RustOptions;

const HEAD: &str = r#"
lexibus = 1
[device]
name = "Drive"
buses = ["canopen", "modbus", "profinet"]
[spaces.cells]
bits = 32
modbus = { table = "holding" }
"#;

const WINDOW: &str = r#"
indirect = { write_address = "Number", numbers = "0x8000..0x8FFF", timeout = 20, read = "Value", write = { value = "New value", first = "value" } }
"#;

const OBJECTS: &str = r#"
[[chapters]]
title = "Window"
[chapters.objects]
0x2005 = { name = "Number", type = "u16", access = "rw", clears = true }
0x2006 = { name = "Value", type = "i32", access = "ro" }
0x2007 = { name = "New value", type = "i32", access = "wo" }
"#;

fn read(text: &str) -> Compilation {
    let options = Options { no_profiles: true, ..Options::default() };
    check(Source::new("t.toml", text.into()), &options)
}

fn table(window: &str, rows: &str, more: &str) -> String {
    let window = window.trim();
    format!("{HEAD}{window}\n{OBJECTS}[[chapters]]\ntitle = \"Cells\"\nspace = \"cells\"\n[chapters.registers]\n{rows}\n{more}")
}

/// Returns the diagnostics of a table. Diagnostics about missing CANopen objects are left out.
fn reported(text: &str) -> Vec<String> {
    let compilation = read(text);
    let lines = compilation.diagnostics.list().iter().map(|diagnostic| compilation.one_line(diagnostic));
    lines.filter(|line| !line.contains("EDS063")).collect()
}

fn item<'c>(compilation: &'c Compilation, name: &str) -> &'c Item {
    let devices = compilation.catalog.iter().flat_map(|catalog| &catalog.devices);
    let items: Vec<&Item> = devices.flat_map(|device| &device.groups).flat_map(|group| &group.items).collect();
    items.into_iter().find(|item| item.name == name).expect("the item")
}

fn rust(text: &str) -> String {
    assert_eq!(reported(text), [""; 0]);
    read(text).rust(&RustOptions { accessors: false, ..RustOptions::default() }).expect("code")
}

/// Returns the lines of `text` from the first line that contains `from` to the next line that contains `to`.
fn part(text: &str, from: &str, to: &str) -> String {
    let lines = text.lines().skip_while(|line| !line.contains(from));
    let mut part: Vec<&str> = Vec::new();
    for line in lines {
        part.push(line);
        if line.contains(to) {
            break;
        }
    }
    assert!(!part.is_empty(), "no `{from}` in {text}");
    part.join("\n")
}

#[test]
fn code_of_a_window() {
    let rows = "Gain = { reg = 0x8033, type = \"u32\", access = \"rw\" }\n\
                \"Other gain\" = { reg = 0x8034, type = \"u32\", access = \"rw\" }\n\
                Speed = { reg = 0x8017, type = \"i16\", access = \"ro\" }\n\
                Far = { reg = 0x9000, type = \"i32\", access = \"rw\" }";
    let text = rust(&table(WINDOW, rows, ""));
    insta::assert_snapshot!("window", part(&text, "pub mod windows", "pub mod objects"));
    insta::assert_snapshot!("maker", part(&text, "const fn location_1", "    }"));
    insta::assert_snapshot!("behind_a_window", part(&text, "    /// Gain:", "pub const FAR"));
}

#[test]
fn the_procedure_tells_what_the_window_does_not() {
    let window = "indirect = { write_address = \"Cell\", read = \"Value\", procedure = \"settle\" }";
    let rows = "Gain = { reg = 0x8033, type = \"u32\", access = \"ro\" }";
    let settle = |step: &str| {
        format!(
            "[[chapters]]\ntitle = \"More\"\n[chapters.objects]\n0x2008 = {{ name = \"Cell\", type = \"u16\", access = \"rw\" }}\n\
             [procedures.settle]\narguments = [\"n\"]\nsteps = [{{ write = \"Cell\", argument = \"n\" }}, {step}, {{ read = \"Value\" }}]\n"
        )
    };
    let handshake = |step: &str| part(&rust(&table(window, rows, &settle(step))), "handshake:", "handshake:");
    let code = handshake("{ wait = \"Cell\", value = 0, timeout = 50 }");
    assert_eq!(code.trim(), "handshake: rt::Handshake::cleared(50),");
    assert_eq!(handshake("{ delay = 3 }").trim(), "handshake: rt::Handshake::after(3),");
}

#[test]
fn code_of_an_image() {
    let rows = "Target = { reg = 0x8009, type = \"i32\", access = \"rw\" }\n\
                Mode = { reg = 0x8001, obj = \"0x6060\", type = \"i32\", access = \"rw\", variants = [{ buses = [\"canopen\"], type = \"i8\", access = \"wo\", allowed = [\"-2..3\"] }] }\n\
                Alarm = { reg = 0x802E, type = \"u8\", access = \"ro\", esc = 0x0F80 }";
    let images = "[[images]]\nname = \"out\"\ndirection = \"rx\"\nbytes = 8\n[images.fields]\nTarget = { at = 3 }\nMode = { at = 2, type = \"i8\" }\n\
                  [[images]]\nname = \"in\"\ndirection = \"tx\"\nbytes = 8\norder = \"little\"\n[images.fields]\nAlarm = { at = 7 }\nTorque = { at = 1, type = \"i16\" }\n";
    let text = rust(&table("", rows, images));
    insta::assert_snapshot!("image", part(&text, "pub mod objects", "Handle of a read-only register or entry."));
    insta::assert_snapshot!("widths", part(&text, "    /// Mode:", "    /// Alarm:"));
    let compilation = read(&table("", rows, images));
    let mode = item(&compilation, "Mode");
    assert_eq!((mode.type_on(Bus::CanOpen), mode.access_on(Bus::CanOpen)), (Type::Integer(8), Access::WriteOnly));
    assert_eq!((mode.type_on(Bus::Modbus), mode.access_on(Bus::Modbus)), (Type::Integer(32), Access::ReadWrite));
    assert!(mode.limits_on(Bus::CanOpen).is_some() && mode.limits_on(Bus::Modbus).is_none());
    let is_narrow = |binding: &Binding| matches!(binding, Binding::Image(binding) if binding.bits == 8 && binding.ty == Some(Type::Integer(8)));
    assert!(mode.bindings.iter().any(is_narrow));
}

#[test]
fn mistakes() {
    let rows = "Gain = { reg = 0x8033, type = \"u32\", access = \"rw\" }";
    let window = |text: &str| reported(&table(text, rows, ""));
    #[track_caller]
    fn has(found: &[String], words: &str) {
        assert!(found.iter().any(|line| line.contains(words)), "{words}: {found:#?}");
    }
    assert_eq!(window(WINDOW), [""; 0]);
    has(&window("indirect = {}"), "for the value (`read`, `write`)");
    has(&window("indirect = { read = \"Value\" }"), "an item for the number");
    has(&window("indirect = { write_address = \"Numbr\", read = \"Value\" }"), "no item has the name `Numbr`");
    has(&window(&WINDOW.replace("0x8000..0x8FFF", "all")), "`all` is not a range of numbers");
    has(&window(&WINDOW.replace("first = \"value\"", "first = \"both\"")), "`both` is not a valid order of writes");
    has(
        &window("indirect = { write_address = \"Number\", read = { value = \"Value\", first = \"value\" } }"),
        "reading always writes the number first",
    );
    has(&window(&WINDOW.replace("indirect = {", "indirect = { buses = [\"can\"],")), "`can` is not a valid bus");
    let far = reported(&table(
        "indirect = { write_address = \"Number\", read = \"Value\" }",
        "Far = { reg = 0x18000, type = \"u32\", access = \"ro\", buses = [\"canopen\"] }",
        "",
    ));
    has(&far, "the register number 98304 of `Far` does not fit `Number`, which has 16 bits");
    let text = reported(&table(
        "indirect = { write_address = \"Number\", read = \"Value\" }",
        "Name = { reg = 0x8000, type = \"str(4)\", access = \"ro\", buses = [\"canopen\"] }",
        "",
    ));
    has(&text, "`Name` is accessible only through a window");
    let variant = |text: &str| {
        reported(&table(
            "",
            &format!("Mode = {{ reg = 0x8001, type = \"i32\", access = \"rw\", variants = [{{ {text} }}] }}"),
            "[[models]]\nname = \"A\"\n",
        ))
    };
    assert_eq!(variant("buses = [\"modbus\"], type = \"i16\""), [""; 0]);
    has(&variant("buses = [\"modbus\"], type = \"f32\""), "only change the length of an integer");
    has(&variant("buses = [\"modbus\"], access = \"r\""), "`r` is not a valid access right");
    has(&variant("models = [\"A\"], type = \"i16\""), "of a variant need `buses`");
}
