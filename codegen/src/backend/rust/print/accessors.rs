//! Prints the Rust type of a device, which has methods for objects, registers, requests and state machines.

use super::objects::access;
use crate::backend::rust::code::{call, generic, line, open, seq, Code};
use crate::backend::rust::docs;
use crate::backend::rust::literal;
use crate::backend::rust::method_names::method_allow;
use crate::backend::rust::model::Model;
use crate::backend::rust::objects::ObjectModel;
use crate::backend::rust::walk::WalkModel;

/// Prints the device's type with its methods, and drops the documentation of the methods.
pub(super) fn write(code: &mut Code, model: &mut Model) {
    if !model.has_accessors {
        return;
    }
    code.doc(&format!("Typed access to {} through a client of its bus.", model.title));
    code.docs(&model.example);
    code.lines(&model.accessor_derives);
    structure(code, model);
    #[cfg(feature = "messages")]
    super::messages::methods(code, model);
    methods(code, model);
}

/// Returns the second type parameter of the device type, after that of the client. The parameter exists if the device's
/// type tracks which selecting request was sent last.
pub(super) fn selected(model: &Model) -> &'static str {
    if model.selects() {
        ", S"
    } else {
        ""
    }
}

fn structure(code: &mut Code, model: &Model) {
    let name = &model.device_name;
    if !model.selects() {
        code.block(seq!["pub struct ", name, "<C>"], "client: C,");
        return;
    }
    open!(code, "pub struct ", name, "<C, S = rt::message::Unselected> {");
    line!(code, "client: C,");
    line!(code, "state: core::marker::PhantomData<S>,");
    code.close("}");
    open!(code, "impl<C> ", name, "<C> {");
    code.doc("Creates a driver that talks to the device through `client`.");
    open!(code, "pub const fn new(client: C) -> Self {");
    open!(code, "Self {");
    line!(code, "client,");
    line!(code, "state: core::marker::PhantomData,");
    code.close("}");
    code.close("}");
    code.close("}");
}

fn methods(code: &mut Code, model: &mut Model) {
    let (state, name) = (selected(model), &model.device_name);
    open!(code, "impl<C", state, "> ", name, "<C", state, "> {");
    if !model.selects() {
        code.doc("Creates a driver that talks to the device through `client`.");
        code.block("pub const fn new(client: C) -> Self", "Self { client }");
    }
    code.doc("Returns the client.");
    code.block("pub fn client(&mut self) -> &mut C", "&mut self.client");
    code.doc("Returns the client and drops the driver.");
    code.block("pub fn into_client(self) -> C", "self.client");
    if let Some(models) = &model.axes {
        code.doc(&format!(
            "Returns the driver for axis `number`{models}. The first axis has the number 1. Objects that all axes share have the same address on every axis."
        ));
        let driver = generic!(name, generic!("rt::Axis", "&mut C"));
        let axis = call!("rt::Axis::new", "&mut self.client", "&AXES", "number");
        let function = seq![call!("pub fn axis", "&mut self", "number: u8"), " -> ", driver];
        code.block(function, call!(seq![name, "::new"], axis));
    }
    for walk in &model.walks {
        self::walk(code, walk, false);
        self::walk(code, walk, true);
    }
    if let Some(cia402) = &model.cia402 {
        super::cia402::method(code, name, cia402);
    }
    code.close("}");
    if let Some(cia402) = &model.cia402 {
        super::cia402::objects(code, name, cia402);
    }
    for objects in model.objects.chunk_by_mut(|one, other| one.area == other.area) {
        code.docs(objects.first().map(|object| docs::sentence(&docs::escape(&object.area))).as_slice());
        code.lines(method_allow(objects.iter().map(|object| object.name.as_str())));
        open!(code, "impl<C", state, "> ", name, "<C", state, "> {");
        for object in objects {
            accessor(code, object);
            object.drop_method_docs();
        }
        code.close("}");
    }
}

/// Writes the blocking or async method that leads a state machine to a state.
fn walk(code: &mut Code, walk: &WalkModel, is_async: bool) {
    let (suffix, keyword, client, done) =
        if is_async { ("_async", "async ", "rt::AsyncClient", ".await") } else { ("", "", "rt::Client", "") };
    // Write the handle on a separate line, because a long method chain would be broken into several lines.
    let handle = |code: &mut Code, path: &str| line!(code, "let item = ", path, ";");
    let read = seq!["item.at(&mut self.client).read", suffix, "()", done];
    match is_async {
        false => code.docs(&walk.docs),
        true => code.doc(&format!("Does the same as [`{0}`](Self::{0}) without blocking.", walk.method)),
    }
    let target = seq!["target: types::", walk.states];
    let name = seq!["pub ", keyword, "fn ", walk.method, suffix];
    let error = generic!("rt::WalkError", seq!["types::", walk.states], "C::Error");
    let parameters = call!(name, "&mut self", target, "deadline: core::time::Duration");
    line!(code, parameters, " -> ", generic!("Result", "()", error));
    open!(code, "where");
    line!(code, "C: ", client, ",");
    code.lines(&walk.bounds);
    code.reopen("{");
    if walk.reads_control {
        handle(code, &walk.control);
        line!(code, "let control = ", read.clone(), "?;");
    } else {
        line!(code, "let control = rt::StateWord::from_bits(0);");
    }
    line!(code, "let machine = ", call!("rt::Machine::new", walk.status, walk.control), ";");
    let arguments = call!(seq!["machine.walk", suffix], "&mut self.client", "control", "target", "deadline");
    match &walk.code {
        None => line!(code, arguments, done),
        Some(path) => {
            open!(code, "match ", arguments, done, " {");
            open!(code, "Err(error) if error.is_fault() => {");
            handle(code, path);
            line!(code, "let code = ", read, ";");
            line!(code, "Err(error.with_code(code))");
            code.close("}");
            line!(code, "walked => walked,");
            code.close("}");
        }
    }
    code.close("}");
}

fn accessor(code: &mut Code, object: &ObjectModel) {
    let name = &object.name;
    let function = call!(seq!["pub fn ", name], "&mut self");
    let aliases: Vec<String> = object.aliases.iter().map(|alias| literal::string(alias)).collect();
    let alias = (!aliases.is_empty()).then(|| format!("#[doc(alias({}))]", aliases.join(", ")));
    if let Some(accessors) = &object.accessors {
        code.doc(&object.heading);
        code.doc(&format!("The constants for the object's entries are in {}.", object.constants));
        code.lines(&alias);
        let result = generic!(seq!["objects::", accessors], "'_", "C");
        open!(code, function, " -> ", result, " {");
        code.block(seq!["objects::", accessors], "client: &mut self.client,");
        code.close("}");
        return;
    }
    for item in &object.items {
        code.docs(&item.method_docs);
        code.lines(&alias);
        let result = access("objects::", item.access, &item.arguments_at_top);
        code.block(seq![function, " -> ", result], item.at("objects", "&mut self.client"));
    }
}
