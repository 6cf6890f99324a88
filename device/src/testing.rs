//! Descriptions for unit tests.

use lexibus_codegen::compile::Options;
use lexibus_codegen::source::Source;

use crate::address::Network;
use crate::description::Description;

const TABLE: &str = r#"
lexibus = 1
[device]
name = "Heater"
buses = ["modbus"]
[spaces.register]
modbus = { table = "holding", first = 0 }
[[chapters]]
title = "Values"
defaults = { access = "rw" }
[chapters.registers]
Temperature = { reg = 0, type = "i16", unit = "°C", scale = 0.1, na = { 0x7FFF = "no sensor" } }
Speed = { reg = 1, type = "i16", unit = "rpm", min = -3000, max = 3000 }
Mode = { reg = 2, type = "u16", enum = "Mode" }
Gain = { reg = 3, type = "f32", unit = "V" }
Offset = { reg = 5, type = "f32", unit = "mV", scale = 0.1 }
Period = { reg = 7, type = "f64", unit = "Hz", scale = { reciprocal = 2.0 } }
[enums.Mode.values]
0 = "manual"
1 = "automatic"
"#;

const CLOCK: &str = "\
[MandatoryObjects]\nSupportedObjects=1\n1=0x1000\n[1000]\nParameterName=Device type\nDataType=0x0007\nAccessType=ro\n\
[ManufacturerObjects]\nSupportedObjects=1\n1=0x2000\n[2000]\nParameterName=Running time\nDataType=0x000D\nAccessType=rw\n";

/// Returns the description of a CANopen device with an object of the type TIME_DIFFERENCE.
pub(crate) fn clock() -> Description {
    described(Source::new("clock.eds", CLOCK.into()), Network::CanOpen)
}

/// Returns the description of a register table with scaled values, values with units, and an enumeration.
pub(crate) fn table() -> Description {
    described(Source::new("heater.toml", TABLE.into()), Network::Modbus)
}

/// Returns the description of the pump, an example of the book.
pub(crate) fn pump() -> Description {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/examples/pump.eds");
    described(Source::read(path.as_ref()).expect("an example"), Network::CanOpen)
}

pub(crate) fn described(source: Source, network: Network) -> Description {
    Description::compile(source, network, &Options::default()).unwrap_or_else(|error| panic!("{error}"))
}
