//! Prints the machine constants, and the differences between the models of a device.

use crate::backend::rust::code::{call, line, open, seq, Code};
use crate::backend::rust::device_models::DeviceModel;
use crate::backend::rust::given::{GivenModel, UnitModel};

pub(super) fn models(code: &mut Code, models: &[DeviceModel]) {
    if models.is_empty() {
        return;
    }
    code.doc("Constants of the device's models, and items whose range or initial value differs between the models.");
    open!(code, "pub mod models {");
    for model in models {
        code.docs(&model.docs);
        line!(code, "#[allow(clippy::approx_constant)]");
        open!(code, "pub mod ", model.name, " {");
        code.declare(&model.constants);
        if !model.items.is_empty() {
            items(code, model);
        }
        code.close("}");
    }
    code.close("}");
}

fn items(code: &mut Code, model: &DeviceModel) {
    code.doc("Handles of items whose range or initial value differs between models.");
    open!(code, "pub mod objects {");
    code.use_runtime();
    line!(code, "use super::super::super::objects;");
    if model.names_types() {
        line!(code, "use super::super::super::types;");
    }
    code.declare(model.items.iter().map(|item| &item.constant));
    code.close("}");
}

pub(super) fn machine(code: &mut Code, given: Option<&GivenModel>) {
    let Some(given) = given else { return };
    code.doc("Constants of the machine, and unit conversions that depend on these constants.");
    open!(code, "pub mod machine {");
    code.doc("Constants of the machine that are not stored in the device.");
    code.lines(&given.derives);
    open!(code, "pub struct Machine {");
    for number in &given.numbers {
        code.docs(&number.docs);
        line!(code, "pub ", number.name, ": f64,");
    }
    code.close("}");
    if !given.units.is_empty() {
        open!(code, "impl Machine {");
        for UnitModel { to, back, symbols: [from, machine] } in &given.units {
            conversion(code, to, [from, machine]);
            conversion(code, back, [machine, from]);
        }
        code.close("}");
    }
    code.close("}");
}

/// Writes the function that converts a value between two units.
fn conversion(code: &mut Code, function: &[String; 2], units: [&str; 2]) {
    let ([name, expression], [from, to]) = (function, units);
    code.doc(&format!("Converts a value from {from} to {to}."));
    code.block(seq![call!(seq!["pub fn ", name], "&self", "value: f64"), " -> f64"], expression);
}
