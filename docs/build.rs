//! Generates the bindings of the descriptions that the chapters use.

use std::path::Path;

use lexibus_codegen::diagnostics::Levels;
use lexibus_codegen::source::Source;
use lexibus_codegen::{BuildError, Builder, Presence, RustOptions};
use lexibus_network::compile::compile;
use lexibus_network::output::rust;

fn main() -> Result<(), BuildError> {
    network();
    let builder = Builder::new().table(Presence::Always);
    for description in ["examples/pump.eds", "examples/motor.toml", "../examples/inverter.toml"] {
        builder.compile(description)?;
    }
    // Allow warnings, because the following descriptions have warnings on purpose.
    let lenient = builder.allow("warnings");
    lenient.compile_as("examples/station.gsdml.xml", "station.rs")?;
    lenient.compile_as("../tests/ui/configuration/order-of-a-dcf/input.dcf", "conveyor.rs")?;
    lenient.compile("../tests/data/press.toml")?;
    lenient.compile_as("../tests/data/coupler.esi.xml", "coupler.rs")?;
    lenient.compile_as("../tests/data/one-drive.toml", "one_drive.rs")?;
    lenient.compile_as("../tests/data/safe.gsdml.xml", "safe.rs")
}

/// Generates the modules of the example network.
fn network() {
    println!("cargo::rerun-if-changed=../examples/network");
    let source = Source::read(Path::new("../examples/network/network.toml")).expect("the example network");
    let compilation = compile(source, Levels::lenient());
    let network = compilation.usable().expect("a network without errors");
    let out = std::env::var("OUT_DIR").expect("the folder of the build script");
    std::fs::create_dir_all(Path::new(&out).join("network")).expect("a folder");
    let options = RustOptions { table: Presence::Always, ..RustOptions::default() };
    for (name, text) in rust(network, &options) {
        std::fs::write(Path::new(&out).join(name), text).expect("a module");
    }
}
