//! Descriptions and changes of values for tests.

use std::path::{Path, PathBuf};

use lexibus_codegen::compile::Options;
use lexibus_codegen::ir::{Type, Value};
use lexibus_codegen::source::Source;
use lexibus_device::{Connection, Description, Network, Parameter, Write};

/// Returns the path of a file of the repository.
pub fn repository(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(path)
}

/// Returns the description of a device in `dictionaries`.
pub fn dictionary(name: &str, network: Network) -> Description {
    file(&format!("dictionaries/{name}"), network)
}

/// Returns the description in a file of the repository.
pub fn file(path: &str, network: Network) -> Description {
    let source = Source::read(&repository(path)).unwrap_or_else(|error| panic!("{path}: {error}"));
    compiled(source, network)
}

/// Returns the description with this text.
pub fn described(name: &str, text: &str, network: Network) -> Description {
    compiled(Source::new(name, text.as_bytes().to_vec()), network)
}

fn compiled(source: Source, network: Network) -> Description {
    Description::compile(source, network, &Options::default()).unwrap_or_else(|error| panic!("{error}"))
}

/// Mapping entries for objects of the demo drive that PDOs can map: index, sub-index and length in bits.
const MAPPINGS: [i128; 4] = [0x6041_0010, 0x6064_0020, 0x6040_0010, 0x6081_0020];

/// Returns candidates for another value of an integer. For the COB-ID of a PDO, the only candidate toggles bit 31, which
/// disables an enabled PDO. For the number of mapped objects, the only candidate is 0. A device can refuse
/// changes to the mapping unless the PDO is disabled and this number is 0. A candidate that equals the current value is left out.
fn other_integers(parameter: &Parameter<'_>, number: i128) -> Vec<Value> {
    let object = parameter.address().object().map(|object| (object.index, object.sub_index));
    let numbers = match object {
        Some((0x1400..=0x15FF | 0x1800..=0x19FF, 1)) => vec![number ^ 1 << 31],
        Some((0x1600..=0x17FF | 0x1A00..=0x1BFF, 0)) => vec![0],
        Some((0x1600..=0x17FF | 0x1A00..=0x1BFF, _)) => MAPPINGS.to_vec(),
        _ => vec![number + 1, number - 1, number + 2],
    };
    numbers.into_iter().filter(|other| *other != number).map(Value::Int).collect()
}

/// Tries to write other valid values to a parameter until the device accepts one. Returns whether the device accepted a value.
pub fn change(parameter: &Parameter<'_>, node_id: u8, connection: &mut impl Connection) -> bool {
    let Ok(Some(value)) = parameter.read(connection).map(|reading| reading.value) else { return false };
    let candidates = match (parameter.basic(), value) {
        (Type::Boolean, Value::Bool(value)) => vec![Value::Bool(!value)],
        (Type::Integer(_) | Type::Unsigned(_), Value::Int(number)) => other_integers(parameter, number),
        (Type::Real32 | Type::Real64, Value::Real(number)) => vec![Value::Real(number + 1.5)],
        (Type::VisibleString(_), Value::Text(_)) => vec![Value::Text("x".into())],
        _ => Vec::new(),
    };
    candidates.into_iter().any(|value| {
        let write = Write::new(*parameter, value, Some(node_id));
        write.is_ok_and(|write| write.execute(connection).is_ok())
    })
}
