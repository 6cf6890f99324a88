//! Tests the new format through the public API of the crate.

use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::diagnostics::Levels;
use lexibus_codegen::source::Source;

const VALVE: &str = "device Valve\n0x2000 opening u8 rw\n0x2001 pressure u16 ro\n";

fn options() -> Options {
    let mut levels = Levels::lenient();
    levels.set("EDS063", lexibus_codegen::Level::Allow).unwrap();
    Options { levels, ..Options::default() }
}

#[test]
#[cfg(feature = "pins")]
fn a_file_becomes_rust() {
    let options = options();
    let compilation = check(Source::new("valve.pins", VALVE.into()), &options);
    assert!(compilation.diagnostics.list().is_empty(), "{:?}", compilation.diagnostics.list());
    assert_eq!(compilation.format, Some(lexibus_codegen::ir::Format::Pins));
    let rust = compilation.rust(&options.rust).unwrap();
    for expected in ["pub struct Valve<C>", "pub fn opening(&mut self)", "pub fn pressure(&mut self)"] {
        assert!(rust.contains(expected), "{expected}");
    }
}

#[test]
#[cfg(feature = "pins")]
fn diagnostics_are_those_of_the_front_end_and_of_lints() {
    let source = Source::new("valve.pins", format!("{VALVE}nonsense\n").into());
    let compilation = check(source, &Options::default());
    let found: Vec<&str> = compilation.diagnostics.list().iter().map(|diagnostic| diagnostic.code.id).collect();
    assert_eq!(found, ["EDS063", "EDS063", "EDS063", "IO002"]);
}

#[test]
#[cfg(not(feature = "pins"))]
fn without_the_feature_the_error_names_it() {
    let compilation = check(Source::new("valve.pins", VALVE.into()), &options());
    assert!(compilation.catalog.is_none());
    let [error] = compilation.diagnostics.list() else { panic!("one error") };
    assert!(error.message.contains("without the feature `pins`"), "{}", error.message);
}
