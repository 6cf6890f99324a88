//! Generates the bindings of the descriptions that the chapters use.

use lexibus_codegen::{BuildError, Builder, Presence};

fn main() -> Result<(), BuildError> {
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
