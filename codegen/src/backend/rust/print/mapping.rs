//! Prints the modules that `lexibus::pdo!` uses: PDOs with a writable mapping, and items, each of which is marked as
//! mappable or not mappable.

use crate::backend::rust::code::{line, list, open, Code, Stop};
use crate::backend::rust::model::Model;
use crate::backend::rust::remap::RemappableModel;

pub(super) fn write(code: &mut Code, model: &Model) {
    if model.remappable.is_empty() {
        return;
    }
    code.doc("PDOs with a writable mapping, for use by the macro `lexibus::pdo!`.");
    open!(code, "pub mod remappable {");
    code.use_runtime();
    model.remappable.iter().for_each(|remappable| self::remappable(code, remappable));
    code.close("}");
    mappable(code, model);
}

fn remappable(code: &mut Code, remappable: &RemappableModel) {
    code.doc(&remappable.title);
    line!(code, "pub enum ", remappable.name, " {}");
    open!(code, "impl rt::Remappable for ", remappable.name, " {");
    line!(code, "type Direction = ", remappable.direction, ";");
    line!(code, "type CobId = ", remappable.cob_id, ";");
    for constant in &remappable.constants {
        line!(code, "const ", constant, ";");
    }
    code.close("}");
}

fn mappable(code: &mut Code, model: &Model) {
    code.doc(
        "Items for use by the macro `lexibus::pdo!`, and whether they can be mapped. Their names are those of the accessors.",
    );
    line!(code, "#[allow(missing_docs, non_camel_case_types)]");
    open!(code, "pub mod mappable {");
    code.use_runtime();
    let stop = Stop;
    for object in model.objects.iter().filter(|object| object.is_in_mappable()) {
        if object.has_entries() {
            open!(code, "pub mod ", object.name, " {");
            line!(code, "use super::rt;");
        }
        for item in &object.items {
            let name = if object.has_entries() { item.mappable_name() } else { object.name.clone() };
            match &item.mappable {
                Some(arguments) => {
                    line!(code, "pub type ", name, " = ", stop, list("rt::Mappable<", arguments, ">"), ";")
                }
                None => line!(code, "pub type ", name, " = rt::pdo::NotMappable;"),
            }
        }
        if object.has_entries() {
            code.close("}");
        }
    }
    code.close("}");
}
