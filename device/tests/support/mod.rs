//! Descriptions and changes of values for tests.
#![allow(dead_code)]

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

/// Writes another valid value to a parameter. Returns whether the device accepted it.
pub fn change(parameter: &Parameter<'_>, node_id: u8, connection: &mut impl Connection) -> bool {
    let Ok(Some(value)) = parameter.read(connection).map(|reading| reading.value) else { return false };
    let candidates = match (parameter.basic(), value) {
        (Type::Boolean, Value::Bool(value)) => vec![Value::Bool(!value)],
        (Type::Integer(_) | Type::Unsigned(_), Value::Int(number)) => {
            [number + 1, number - 1, number + 2].map(Value::Int).to_vec()
        }
        (Type::Real32 | Type::Real64, Value::Real(number)) => vec![Value::Real(number + 1.5)],
        (Type::VisibleString(_), Value::Text(_)) => vec![Value::Text("x".into())],
        _ => Vec::new(),
    };
    candidates.into_iter().any(|value| {
        let write = Write::new(*parameter, value, Some(node_id));
        write.is_ok_and(|write| write.execute(connection).is_ok())
    })
}
