//! Tests the Rust code for register tables. The code must compile without warnings with all options and have the format
//! of `prettyplease`.

use crate::compile_support;
use crate::corpus_support::lane;
use crate::form_support;

use std::path::Path;

use compile_support::{compile, document};
use form_support::canonical;
use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::source::Source;
use lexibus_codegen::{Presence, RustOptions};

fn file(name: &str) -> Source {
    Source::read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(name)).expect("the table")
}

fn bindings(source: Source, rust: RustOptions) -> String {
    let options = Options { rust, ..Options::default() };
    let compilation = check(source, &options);
    let lines =
        || compilation.diagnostics.list().iter().map(|diagnostic| compilation.one_line(diagnostic)).collect::<Vec<_>>();
    compilation.rust(&options.rust).unwrap_or_else(|| panic!("{:#?}", lines()))
}

fn everything() -> RustOptions {
    RustOptions { table: Presence::Always, ..RustOptions::default() }
}

const TABLES: [&str; 7] = [
    "tests/data/press.toml",
    "tests/data/hoist.toml",
    "tests/data/one-drive.toml",
    "dictionaries/aec-vector-step.toml",
    "dictionaries/eco.toml",
    "dictionaries/hsd-sm137-sm140.toml",
    "dictionaries/kollmorgen-akd.toml",
];

#[test]
fn tables_compile() {
    for name in TABLES {
        // In the fast lane, skip the drives, because the crate `lexibus-drives` already compiles their generated code.
        if name.starts_with("dictionaries") && !lane::is_full() {
            continue;
        }
        for accessors in [true, false] {
            let text = bindings(file(name), RustOptions { accessors, ..everything() });
            compile(name, &text).unwrap_or_else(|message| panic!("{message}"));
        }
    }
}

#[test]
fn tables_have_the_form_of_prettyplease() {
    for name in TABLES {
        let text = bindings(file(name), everything());
        assert_eq!(canonical(name, &text), Ok(()));
    }
}

#[test]
fn implementations_of_bit_fields_are_gated() {
    let rust = RustOptions {
        debug: Presence::Feature("debug".into()),
        partial_eq: Presence::Never,
        serde: Presence::Feature("serde".into()),
        ..RustOptions::default()
    };
    let text = bindings(file(TABLES[0]), rust);
    assert!(text.contains(
        "    #[derive(Clone, Copy)]\n    #[cfg_attr(feature = \"serde\", derive(serde::Serialize, serde::Deserialize))]\n    \
         pub struct Control(u16);"
    ));
    assert!(text.contains("    #[cfg(feature = \"debug\")]\n    impl core::fmt::Debug for Control {"));
    // Suppress the rustc warning about features that the crate does not declare.
    compile("gated", &format!("#[allow(unexpected_cfgs)]\nmod inner {{\n{text}\n}}\npub use inner::*;\n"))
        .unwrap_or_else(|message| panic!("{message}"));
}

/// Tests bits, values, states and items whose names are empty or also occur in the surrounding code.
#[test]
fn names_that_mislead() {
    let bits: String = [
        "raw",
        "from raw",
        "new",
        "default",
        "state",
        "command",
        "type",
        "self",
        "not",
        "is moving",
        "as one",
        "to zero",
        "from here",
        "into there",
        "with new",
        "new",
        "clone",
        "fmt",
        "in idle",
        "wild",
        "?!",
        "2nd",
    ]
    .iter()
    .enumerate()
    .map(|(bit, name)| format!("{bit} = \"{name}\"\n"))
    .collect();
    let table = format!(
        "lexibus = 1\n[device]\nname = \"Self\"\n[spaces.register]\nmodbus = {{ table = \"holding\" }}\n\
         [[chapters]]\ntitle = \"«¦» */\"\n[chapters.registers]\n\
         type = {{ reg = \"0-1\", type = \"u32\", access = \"rw\", bits = \"Wild\", default = 0x80000000 }}\n\
         self = {{ reg = 2, type = \"i8\", access = \"rw\", bits = \"Signed\", default = -1, min = -1, max = 5 }}\n\
         client = {{ reg = 3, type = \"i16\", access = \"rw\", enum = \"Result\", doubt = {{ says = \"*a* «\", chose = \"`b`\", why = \"<c>\" }} }}\n\
         u16 = {{ reg = \"4-7\", type = \"u64\", access = \"rw\", bits = \"Wide\" }}\n\
         rt = {{ reg = \"8-9\", type = \"u24\", access = \"rw\", bits = \"Odd\" }}\n\
         f32 = {{ reg = \"10-11\", type = \"f32\", access = \"rw\", unit = \"V\", scale = 0.001, min = -1.5 }}\n\
         small = {{ reg = 12, type = \"i16\", access = \"rw\", unit = \"m\", scale = 1e-300 }}\n\
         odd = {{ reg = \"13-14\", type = \"i24\", access = \"rw\", unit = \"m\", scale = -0.30000000000000004, offset = 273.15, na = {{ -8388608 = \"none\" }} }}\n\
         words = {{ reg = \"20-29\", type = \"u16[10]\", access = \"ro\" }}\n\
         [bits.Wild.at]\n{bits}\"31-24\" = {{ name = \"rest\", values = {{ 0 = \"Unknown\", 1 = \"Self\", 255 = \"unknown\" }} }}\n\
         [bits.Signed.at]\n\"7-0\" = {{ name = \"all\", number = true }}\n\
         [bits.Wide.at]\n\"63-0\" = {{ name = \"all\", number = true }}\n\
         [bits.Odd.at]\n\"23-16\" = {{ name = \"top\", number = true }}\n0 = [ {{ name = \"wild\", when = {{ client = [1, 7] }} }}, {{ name = \"wild\", when = {{ client = [0] }} }} ]\n\
         [enums.Result.values]\n-32768 = \"Option\"\n0 = \"\"\n1 = \"Ok\"\n\
         [machines.state]\nstatus = \"type\"\ncontrol = \"client\"\n\
         [machines.state.states]\nself = {{ mask = 0x1, value = 0x1 }}\nother = {{ mask = 0x80000001, value = 0x80000000 }}\n\
         [machines.state.commands]\nself = {{ mask = 0x1, value = 0x1 }}\nwide = {{ mask = 0x10000, value = 0 }}\n\
         [codes.self.rows]\n-1 = \"«¦»\"\n\"1..3\" = \"a\\\"b\\\\\"\n"
    );
    for accessors in [true, false] {
        let text = bindings(Source::new("wild.toml", table.clone().into()), RustOptions { accessors, ..everything() });
        compile("wild", &text).unwrap_or_else(|message| panic!("{message}\n{text}"));
        document("wild", &[&text]).unwrap_or_else(|message| panic!("{message}\n{text}"));
    }
}

#[test]
fn rust_of_a_small_table() {
    let readme = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../dictionaries/README.md"));
    let readme = readme.expect("the description of the format");
    let example = readme.split("```toml\n").nth(1).and_then(|rest| rest.split("```").next()).expect("its example");
    let text = bindings(Source::new("pump.toml", example.into()), RustOptions::default());
    insta::assert_snapshot!(text);
}

/// A command changes only its own bits of the control item if the item can be read. Otherwise, it sets the other bits to 0.
#[test]
fn walks_state_the_other_bits_of_the_control_item() {
    let walk = |access: &str| {
        let text = format!(
            "lexibus = 1\n[device]\nname = \"Press\"\nvendor = \"Example\"\n\
             [machines.press]\nstatus = \"status\"\ncontrol = \"control\"\n\
             [machines.press.states]\nopen = {{ mask = 0x1, value = 0 }}\nclosed = {{ mask = 0x1, value = 0x1 }}\n\
             [machines.press.commands]\nclose = {{ mask = 0x1, value = 0x1 }}\n\
             [[machines.press.transitions]]\nfrom = \"open\"\nto = \"closed\"\ncommand = \"close\"\n\
             [spaces.register]\nmodbus = {{ table = \"holding\" }}\n[[chapters]]\ntitle = \"State\"\n[chapters.registers]\n\
             status = {{ reg = 1, type = \"u16\", access = \"ro\" }}\n\
             control = {{ reg = 2, type = \"u16\", access = \"{access}\" }}\n"
        );
        let text = bindings(Source::new("press.toml", text.into()), RustOptions::default());
        text.replace("///", "").split_whitespace().collect::<Vec<_>>().join(" ")
    };
    assert!(walk("rw").contains("do not change. Use") && walk("rw").contains("let control = item"));
    assert!(walk("wo").contains("are 0. Use") && walk("wo").contains("StateWord::from_bits(0)"));
}
