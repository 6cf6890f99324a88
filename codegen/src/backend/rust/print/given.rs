//! What models of a device have of their own, and numbers that only whoever builds the machine knows.

use crate::backend::rust::code::{call, line, open, seq, Code, Stop};
use crate::backend::rust::device_models::DeviceModel;
use crate::backend::rust::given::{GivenModel, UnitModel};

pub(super) fn models(code: &mut Code, models: &[DeviceModel]) {
    if models.is_empty() {
        return;
    }
    code.doc("What the models of the device have of their own: numbers, and items with their range and initial value.");
    open!(code, "pub mod models {");
    for model in models {
        code.docs(&model.docs);
        line!(code, "#[allow(clippy::approx_constant)]");
        open!(code, "pub mod ", model.name, " {");
        for (name, docs, value) in &model.constants {
            code.doc(docs);
            line!(code, "pub const ", name, ": f64 = ", value, ";");
        }
        if !model.items.is_empty() {
            items(code, model);
        }
        code.close("}");
    }
    code.close("}");
}

fn items(code: &mut Code, model: &DeviceModel) {
    code.doc("Handles of items in whose values models differ.");
    open!(code, "pub mod objects {");
    code.use_runtime();
    line!(code, "use super::super::super::objects;");
    if model.names_types() {
        line!(code, "use super::super::super::types;");
    }
    for own in &model.items {
        code.doc(&own.docs);
        let value = call!("rt::Item::of_model", seq!["objects::", own.name], own.range, own.initial);
        line!(code, "pub const ", own.name, ": ", own.ty, " = ", Stop, value, ";");
    }
    code.close("}");
}

pub(super) fn machine(code: &mut Code, given: Option<&GivenModel>) {
    let Some(given) = given else { return };
    code.doc("What only whoever builds the machine knows, and units that depend on it.");
    open!(code, "pub mod machine {");
    code.doc("The numbers of a machine.");
    code.lines(&given.derives);
    open!(code, "pub struct Machine {");
    for number in &given.numbers {
        code.docs(&number.docs);
        line!(code, "pub ", number.name, ": f64,");
    }
    code.close("}");
    if !given.units.is_empty() {
        open!(code, "impl Machine {");
        for UnitModel { to, back, symbols: [from, own] } in &given.units {
            conversion(code, to, [own, from]);
            conversion(code, back, [from, own]);
        }
        code.close("}");
    }
    code.close("}");
}

fn conversion(code: &mut Code, [name, expression]: &[String; 2], [to, from]: [&str; 2]) {
    code.doc(&format!("A value in {to}, from one in {from}."));
    open!(code, call!(seq!["pub fn ", name], "&self", "value: f64"), " -> f64 {");
    line!(code, expression);
    code.close("}");
}
