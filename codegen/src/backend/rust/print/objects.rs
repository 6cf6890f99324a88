//! Prints the handles of objects and registers.

use super::section;
use crate::backend::rust::code::{call, generic, line, list, open, seq, Code, Doc, Stop};
use crate::backend::rust::item::ItemModel;
use crate::backend::rust::model::Model;
use crate::backend::rust::objects::ObjectModel;
use crate::backend::rust::reexport::Section;

/// Prints the handles, and then removes the code and documentation of all handles from the model.
pub(super) fn write(code: &mut Code, model: &mut Model) {
    if model.objects.is_empty() {
        return;
    }
    let heading = format!("A handle for every {}.", model.handles[0]);
    let mut objects = std::mem::take(&mut model.objects);
    if objects.iter().any(|object| object.has_entries() && !object.is_reexported) {
        line!(code, "#[allow(non_camel_case_types)]");
    }
    section::write(code, model, Section::Objects, &heading, Some(true), |code| {
        locations(code, model);
        handle_types(code, model);
        for object in &mut objects {
            if !object.is_reexported {
                self::object(code, model, object);
            }
            object.drop_handles();
        }
    });
    model.objects = objects;
}

/// Writes the location types that are not part of the runtime, and the functions that create the locations of several
/// items.
fn locations(code: &mut Code, model: &Model) {
    for (name, docs, fields) in &model.locations {
        open!(code, "rt::location! {");
        code.doc(docs);
        open!(code, "pub struct ", name, " {");
        for field in fields {
            line!(code, field, ",");
        }
        code.close("}");
        code.close("}");
    }
    for (name, parameters, ty, body) in &model.makers {
        code.block(seq![list(&format!("const fn {name}("), parameters, ")"), " -> ", ty], body);
    }
}

fn handle_types(code: &mut Code, model: &Model) {
    let [_, noun] = model.handles;
    let parameter = seq!["L = ", model.location];
    let stop = Stop;
    for alias in &model.aliases {
        code.doc(&format!("Handle of a {} {noun}.", alias.text));
        let (parameters, location) = match model.has_locations {
            true => (generic!(alias.name, "V", parameter), "L"),
            false => (generic!(alias.name, "V"), model.location.as_str()),
        };
        line!(code, "pub type ", parameters, " = ", stop, generic!("rt::Item", "V", alias.marker, location), ";");
    }
    for (name, access, value) in &model.handle_types {
        line!(code, "type ", name, " = ", list(&format!("{access}<"), value, ">"), ";");
    }
    for alias in model.aliases.iter().filter(|_| model.has_accessors) {
        code.doc(&format!("Accessor of a {} {noun}.", alias.text));
        let name = seq![alias.name, "Access"];
        let (parameters, location) = match model.has_locations {
            true => (generic!(name, "'c", "C", "V", parameter), "L"),
            false => (generic!(name, "'c", "C", "V"), model.location.as_str()),
        };
        let accessor = generic!("rt::Accessor", "'c", "C", "V", alias.marker, location);
        line!(code, "pub type ", parameters, " = ", stop, accessor, ";");
    }
}

/// Writes the handle of an object's only value. If the object has entries, writes a type whose constants are the handles
/// of the entries, and the accessors of the entries.
///
/// The type is named like a module would be. It is not a module, because `rustc` evaluates each constant of a module
/// whenever it checks the crate, but evaluates a constant of a type only where it is used.
pub(in crate::backend::rust) fn object(code: &mut Code, model: &Model, object: &ObjectModel) {
    let Some(name) = &object.accessors else {
        return object.items.iter().for_each(|item| handle(code, item));
    };
    code.docs(&object.docs);
    line!(code, "pub enum ", object.name, " {}");
    open!(code, "impl ", object.name, " {");
    object.items.iter().for_each(|item| handle(code, item));
    code.close("}");
    if model.has_accessors {
        accessors(code, model, object, name);
    }
}

/// Writes the type with the accessors of an object's entries.
fn accessors(code: &mut Code, model: &Model, object: &ObjectModel, name: &str) {
    code.doc(&format!("Accessors for the entries of the object. {}", object.heading));
    open!(code, "pub struct ", name, "<'c, C> {");
    // Methods of the device create the accessors, so the field must be visible in the device's module. If the file has
    // several devices, methods of any device may create the accessors.
    let users = if model.is_one_of_several { "in super::super" } else { "super" };
    line!(code, "pub(", users, ") client: &'c mut C,");
    code.close("}");
    code.lines(&object.method_allow);
    open!(code, "impl<C> ", name, "<'_, C> {");
    for item in &object.items {
        code.docs(&item.method_docs);
        let result = access("", item.access, &item.arguments);
        let function = call!(seq!["pub fn ", item.method], "&mut self");
        code.block(seq![function, " -> ", result], item.at(&object.name, "self.client"));
    }
    code.close("}");
}

/// Returns the type that gives access to an item.
pub(super) fn access(outer: &str, access: &str, arguments: &[Doc]) -> Doc {
    let client = ["'_", "C"].map(Doc::from);
    list(&format!("{outer}{access}Access<"), client.iter().chain(arguments), ">")
}

/// Writes the handle of an item.
fn handle(code: &mut Code, item: &ItemModel) {
    code.docs(&item.docs);
    if item.real {
        line!(code, "#[allow(clippy::approx_constant)]");
    }
    let ty = list(&format!("{}<", item.access), &item.arguments, ">");
    let stop = Stop;
    line!(code, "pub const ", item.constant, ": ", ty, " = ", stop, item.alias, "::", item.constructor, ";");
}
