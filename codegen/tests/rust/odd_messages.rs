//! Tests unusual messages. The code for such messages must compile without warnings. Messages without generated code
//! must be reported.

use crate::compile_support;

use compile_support::{compile, document};
use lexibus_codegen::compile::{check, Compilation, Options};
use lexibus_codegen::source::Source;
use lexibus_codegen::{Presence, RustOptions};

const HEAD: &str = "lexibus = 1\n[device]\nname = \"X\"\nbuses = [\"serial\"]\n";

/// Compiles a table that contains `lines`. Returns the compilation and its diagnostics.
fn read(lines: &str) -> (Compilation, Vec<String>) {
    let rust = RustOptions { table: Presence::Always, ..RustOptions::default() };
    let options = Options { rust, no_profiles: true, ..Options::default() };
    let compilation = check(Source::new("t.toml", format!("{HEAD}{lines}").into()), &options);
    let messages = compilation.diagnostics.list().iter().map(|diagnostic| compilation.one_line(diagnostic)).collect();
    (compilation, messages)
}

/// Returns the Rust code for a table that contains `lines`. The code must compile.
fn rust(name: &str, lines: &str) -> String {
    let (compilation, messages) = read(lines);
    let mut text = String::new();
    for accessors in [false, true] {
        let options = RustOptions { accessors, table: Presence::Always, ..RustOptions::default() };
        text = compilation.rust(&options).unwrap_or_else(|| panic!("{messages:#?}"));
        compile(name, &text).unwrap_or_else(|message| panic!("{message}\n{text}"));
    }
    document(name, &[&text]).unwrap_or_else(|message| panic!("{message}\n{text}"));
    assert_eq!(messages, Vec::<String>::new(), "{name}");
    text
}

/// Compiles a table that contains `lines`. Returns the diagnostics, one per line.
fn reported(lines: &str) -> String {
    let (_, messages) = read(lines);
    messages.iter().map(|line| format!("{line}\n")).collect()
}

#[test]
fn names_of_messages_that_mislead() {
    let names = ["E", "self", "Option", "Protocol", "request", "2nd", "?!", "on", "C", "entry", "MAX DATA"];
    let one = |(at, name): (usize, &&str)| {
        format!("[[messages]]\nname = \"{name}\"\nrequest = [{{ bytes = [{at}] }}]\nreply = [{{ bytes = [{at}] }}]\n")
    };
    let messages: String = names.iter().enumerate().map(one).collect();
    rust(
        "names",
        &format!(
            "[[chapters]]\n[chapters.registers]\n\
             on = {{ param = 1, type = \"u8\", access = \"rw\" }}\nafter_power_on = {{ param = 2, type = \"u8\", access = \"rw\" }}\n\
             messages = {{ param = 3, type = \"u8\", access = \"rw\" }}\n{messages}"
        ),
    );
}

#[test]
fn names_of_fields_that_mislead() {
    let text = rust(
        "fields",
        "[spaces.9]\nparameter = { read = \"Read\", write = \"Write\" }\n\
         [[chapters]]\n[chapters.registers]\nGain = { reg = 1, type = \"i16\", access = \"rw\" }\n\
         [[messages]]\nname = \"Samples\"\nrequest = [{ bytes = [1] }]\n\
         reply = [{ field = \"entries\", type = \"u8\" }, { repeat = { count = \"entries\", max = 3, fields = [{ field = \"own\", type = \"i16\" }] } }, \
         { field = \"settings\", type = \"i16\" }, { field = \"NAME\", type = \"i16\", unit = \"mm\", scale = 0.1 }]\n\
         [[messages]]\nname = \"Play\"\nrequest = [{ bytes = [2] }, { field = \"entries\", type = \"u16\" }, { field = \"completion\", type = \"i16\", unit = \"mm\", scale = 0.1 }, \
         { repeat = { max = 3, fields = [{ field = \"self\", type = \"u8\" }] } }]\n\
         [[messages]]\nname = \"Read\"\nrequest = [{ bytes = [3] }, { code = \"9\", type = \"u8\" }]\n\
         reply = [{ field = \"value\", type = \"u8\" }, { value_of = \"9\" }]\n\
         [[messages]]\nname = \"Write\"\nrequest = [{ bytes = [4] }, { code = \"9\", type = \"u8\" }, { value_of = \"9\" }]\n\
         reply = [{ field = \"setting\", type = \"u8\" }, { field = \"parameter\", type = \"u8\" }, { code = \"9\", type = \"u8\" }, { value_of = \"9\" }]\n",
    );
    // The reply repeats the parameter number. The parameter number has one byte, as in the request.
    assert!(text.contains("from.clone().echo(request, 1, 1)?;"));
    assert!(text.contains("code_bits: 8,"));
}

#[test]
fn numbers_that_are_narrower_than_their_type() {
    let text = rust(
        "narrow",
        "[bits.Flags]\nbase = \"u4\"\n[bits.Flags.at]\n0 = \"on\"\n[enums.Mode]\nbase = \"u4\"\n[enums.Mode.values]\n1 = \"a\"\n2 = \"b\"\n\
         [[messages]]\nname = \"Go\"\n\
         request = [{ bytes = [1] }, { field = \"mode\", type = \"u4\", enum = \"Mode\" }, { field = \"flags\", type = \"u4\", bits = \"Flags\" }, \
         { field = \"far\", type = \"u20\", min = 5, max = 70000 }, { field = \"near\", type = \"i4\", min = -3 }]\n",
    );
    for check in [
        "rt::message::check::<u8>(self.mode.raw(), &range)?;",
        "rt::message::check::<u8>(self.flags.raw(), &range)?;",
        "let range = rt::Range::Between(5, 70000);",
        "let range = rt::Range::Between(-3, 7);",
    ] {
        assert!(text.contains(check), "{check}\n{text}");
    }
}

#[test]
fn orders_that_are_carried_out_later() {
    let polled = |field: &str, rest: &str| {
        format!(
            "[[messages]]\nname = \"Go\"\nrequest = [{{ bytes = [1] }}]\nreply = [{field}]\ncompletion = {{ poll = {rest}, in_reply = true }}\n"
        )
    };
    let complete = |lines: String| {
        let text = rust("complete", &lines);
        let (_, behind) = text.split_once("pub const fn is_complete(&self) -> bool {\n").unwrap_or(("", "none\n"));
        behind.lines().next().unwrap_or_default().trim().to_owned()
    };
    let actual = |ty: &str, rest: &str| {
        complete(polled(&format!("{{ fixed = 0, type = \"u8\" }}, {{ field = \"a\", type = \"{ty}\" }}"), rest))
    };
    assert_eq!(actual("u16", "\"a\", value = 3"), "self.a == 0x3");
    assert_eq!(actual("u16", "\"a\", mask = 0x8000, value = 0x8000"), "self.a & 0x8000 == 0x8000");
    // The mask and the value are outside the range of the type.
    assert_eq!(actual("i16", "\"a\", mask = 0x8000, value = 0x8000"), "none");
    assert_eq!(actual("i24", "\"a\", value = 3"), "self.a == 0x3");
    assert_eq!(actual("f32", "\"a\", value = 3"), "none");
    // Only the field `a` outside of the repeated fields is compared with the value.
    let fields = "{ field = \"count\", type = \"u8\" }, { field = \"b\", type = \"u8\" }, { field = \"a\", type = \"u8\" }, { repeat = { count = \"count\", fields = [{ field = \"a\", type = \"u8\" }] } }";
    assert_eq!(complete(polled(fields, "\"a\", value = 3")), "self.a == 0x3");
}

#[test]
fn messages_of_little() {
    // The tables contain a read-only space, a message that the device sends without a request, and long texts.
    let space = "[spaces.p]\nparameter = { read = \"Read\" }\n[[chapters]]\n[chapters.registers]\ngain = { reg = 1, type = \"u8\", access = \"ro\" }\n\
                 [[messages]]\nname = \"Read\"\nrequest = [{ code = \"p\", type = \"u8\" }]\nreply = [{ value_of = \"p\" }]\n";
    rust("read only", space);
    rust("device only", "[[messages]]\nname = \"Hello\"\nreply = [{ bytes = [1] }, { field = \"angle\", type = \"f32\", min = 3.14, max = 6.28 }]\n");
    let text = rust(
        "long",
        "[[messages]]\nname = \"Name\"\nrequest = [{ bytes = [1] }, { field = \"text\", type = \"str(40)\" }]\n\
         reply = [{ field = \"to zero\", type = \"u8\" }, { repeat = { max = 2, fields = [{ field = \"text\", type = \"str(40)\" }] } }]\n",
    );
    assert!(text.contains("pub text: [u8; 40],"));
}

#[test]
fn a_number_of_the_device_in_another_order() {
    let text = rust(
        "station",
        "[framing]\nend = 3\naddress = \"node\"\n[[messages]]\nname = \"Go\"\n\
         request = [{ bytes = [1] }, { field = \"node\", type = \"u16\", order = \"BA\", min = 1, max = 300 }]\nreply = [{ echo = \"node\" }]\n",
    );
    assert!(text.contains("to.ordered(&[1, 0], station.into())?;"), "{text}");
    assert!(text.contains("let station = from.ordered(&[1, 0])? as u32;"));
}

#[test]
fn a_length_from_what_comes_back() {
    let text = rust(
        "length",
        "[[messages]]\nname = \"Read speed\"\n\
         request = [{ field = \"length\", type = \"u8\", counts = \"node\" }, { field = \"node\", type = \"u8\" }, { bytes = [0x10] }]\n\
         reply = [{ field = \"length\", type = \"u8\", counts = \"node\" }, { echo = \"node\" }, { field = \"speed\", type = \"i16\" }]\n",
    );
    assert!(text.contains("from.counted(1, length)?;"), "{text}");
}

#[test]
fn a_selector_that_is_selected() {
    let text = rust(
        "selectors",
        "[[messages]]\nname = \"Expert\"\nrequest = [{ bytes = [1] }]\n\
         [[messages]]\nname = \"Show load\"\nrequest = [{ bytes = [2] }]\nafter = \"Expert\"\n\
         [[messages]]\nname = \"Poll\"\nrequest = [{ bytes = [3] }]\nreply = [{ field = \"load\", type = \"u8\" }]\nafter = \"Show load\"\n",
    );
    assert_eq!(text.matches("pub fn show_load(").count(), 1);
}

#[test]
fn what_has_no_code_is_reported() {
    let message = |name: &str, request: &str, rest: &str| {
        format!("[[messages]]\nname = \"{name}\"\nrequest = [{request}]\n{rest}")
    };
    let spaces = "[framing]\nstart = 2\ncheck = \"crc8\"\naddress = \"who\"\n[spaces.p]\nparameter = { read = \"Read\", write = \"Write\" }\n[spaces.q]\nparameter = { read = \"Read\" }\n\
                  [[chapters]]\nspace = \"p\"\n[chapters.registers]\ngain = { reg = 1, type = \"u8\", access = \"rw\" }\nname = { reg = 2, type = \"str(20)\", access = \"rw\" }\n\
                  [[chapters]]\nspace = \"q\"\n[chapters.registers]\nother = { reg = 1, type = \"u8\", access = \"rw\" }\n";
    let messages = [
        message("Read", "{ bytes = [1] }, { code = \"p\", type = \"u8\" }, { field = \"how\", type = \"u8\" }", "reply = [{ value_of = \"p\" }]\n"),
        message("Write", "{ bytes = [2] }, { code = \"p\", type = \"u8\" }", ""),
        message("Station", "{ bytes = [3] }, { field = \"who\", type = \"i8\" }", ""),
        message("Odd length", "{ bytes = [4] }, { fixed = 0, type = \"u4\" }, { field = \"n\", type = \"u4\", counts = \"x\" }, { field = \"x\", type = \"u8\" }", ""),
        message("Two", "{ bytes = [5] }, { field = \"n\", type = \"u8\" }, { rest = true }, { repeat = { count = \"n\", fields = [{ field = \"v\", type = \"u8\" }] } }", ""),
        message("Inner count", "{ bytes = [6] }, { repeat = { max = 2, fields = [{ field = \"n\", type = \"u8\" }] } }, { repeat = { count = \"n\", fields = [{ field = \"v\", type = \"u8\" }] } }", ""),
        message("Constants", "{ bytes = [7] }, { repeat = { max = 2, fields = [{ bytes = [0] }] } }", ""),
        message("Copy", "{ bytes = [8] }, { copy = \"0..1\" }", ""),
        message("Wide code", "{ bytes = [9] }, { code = \"p\", type = \"u64\" }", ""),
        message("Bits", "{ bytes = [10] }, { repeat = { max = 2, fields = [{ field = \"n\", type = \"u4\" }] } }", ""),
        message("Long selector", "{ bytes = [11] }, { rest = true }", ""),
        message("After", "{ bytes = [12] }", "after = \"Long selector\"\n"),
        message("After that", "{ bytes = [13] }", "after = \"After\"\n"),
        message("Default", "{ bytes = [14] }", "default = true\nerror = \"Long refusal\"\n"),
        message("Both", "{ bytes = [15] }, { field = \"n\", type = \"u8\" }, { repeat = { count = \"n\", fields = [{ field = \"v\", type = \"u8\" }] } }, { repeat = { fields = [{ field = \"w\", type = \"u8\" }] } }", ""),
        "[[messages]]\nname = \"Long refusal\"\nreply = [{ bytes = [0x80] }, { rest = true }]\n".to_owned(),
    ];
    insta::assert_snapshot!(reported(&format!("{spaces}{}", messages.concat())));
}
