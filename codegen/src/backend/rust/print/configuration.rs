//! Prints the constant with the configured values.

use crate::backend::rust::code::{line, open, slice, Code};
use crate::backend::rust::model::Model;

pub(super) fn write(code: &mut Code, model: &Model) {
    let Some(configuration) = &model.configuration else { return };
    code.docs(&configuration.docs);
    open!(code, "pub const CONFIGURATION: rt::Configuration = rt::Configuration {");
    for (phase, settings) in &configuration.phases {
        line!(code, phase, ": ", slice(settings), ",");
    }
    line!(code, "..rt::Configuration::EMPTY");
    code.close("};");
}
