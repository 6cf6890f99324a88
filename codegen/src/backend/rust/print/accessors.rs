//! The type of a device: a method for each value, and for each request.

use super::objects::access;
use crate::backend::rust::code::{call, generic, line, list, open, seq, Code, Doc};
use crate::backend::rust::messages::{CallModel, ProtocolModel};
use crate::backend::rust::model::Model;
use crate::backend::rust::objects::ObjectModel;

pub(super) fn write(code: &mut Code, model: &Model) {
    if !model.has_accessors {
        return;
    }
    code.doc(&format!("Typed access to {} through a client of its bus.", model.title));
    code.lines(&model.accessor_derives);
    structure(code, model);
    if let Some(protocol) = &model.protocol {
        requests(code, model, protocol);
    }
    methods(code, model);
}

/// What the type of a device is followed by where it knows which request was sent last.
fn selected(model: &Model) -> &'static str {
    if model.selects() {
        ", S"
    } else {
        ""
    }
}

fn structure(code: &mut Code, model: &Model) {
    let name = &model.device_name;
    if !model.selects() {
        open!(code, "pub struct ", name, "<C> {");
        line!(code, "client: C,");
        code.close("}");
        return;
    }
    open!(code, "pub struct ", name, "<C, S = rt::message::Unselected> {");
    line!(code, "client: C,");
    line!(code, "state: core::marker::PhantomData<S>,");
    code.close("}");
    open!(code, "impl<C> ", name, "<C> {");
    code.doc("The device that `client` talks to.");
    open!(code, "pub const fn new(client: C) -> Self {");
    open!(code, "Self {");
    line!(code, "client,");
    line!(code, "state: core::marker::PhantomData,");
    code.close("}");
    code.close("}");
    code.close("}");
}

fn methods(code: &mut Code, model: &Model) {
    let (name, state) = (&model.device_name, selected(model));
    code.lines(&model.method_allow);
    open!(code, "impl<C", state, "> ", name, "<C", state, "> {");
    if !model.selects() {
        code.doc("The device that `client` talks to.");
        open!(code, "pub const fn new(client: C) -> Self {");
        line!(code, "Self { client }");
        code.close("}");
    }
    code.doc("The client.");
    open!(code, "pub fn client(&mut self) -> &mut C {");
    line!(code, "&mut self.client");
    code.close("}");
    code.doc("Gives the client back.");
    open!(code, "pub fn into_client(self) -> C {");
    line!(code, "self.client");
    code.close("}");
    if let Some(axes) = &model.axes {
        code.doc(&format!(
            "Axis `number`{}, from 1. What the axes share is the same through each of them.",
            axes.models
        ));
        let axis = generic!("rt::Axis", "&mut C");
        open!(code, call!("pub fn axis", "&mut self", "number: u8"), " -> ", generic!(name, axis), " {");
        line!(code, call!(seq![name, "::new"], call!("rt::Axis::new", "&mut self.client", "&AXES", "number")));
        code.close("}");
    }
    model.objects.iter().for_each(|object| accessor(code, object));
    code.close("}");
}

fn accessor(code: &mut Code, object: &ObjectModel) {
    let name = &object.name;
    let function = call!(seq!["pub fn ", name], "&mut self");
    if object.is_module {
        code.doc(&object.heading);
        code.doc(&format!("Constants: {}.", object.constants));
        let result = generic!(seq!["objects::", name, "::Accessors"], "'_", "C");
        open!(code, function, " -> ", result, " {");
        open!(code, "objects::", name, "::Accessors {");
        line!(code, "client: &mut self.client,");
        code.close("}");
        code.close("}");
        return;
    }
    for item in &object.items {
        code.docs(&item.method_docs);
        let result = access("objects::", item.access, &item.arguments_at_top);
        open!(code, function, " -> ", result, " {");
        line!(code, item.at_client());
        code.close("}");
    }
}

/// The methods that send requests.
fn requests(code: &mut Code, model: &Model, protocol: &ProtocolModel) {
    if protocol.calls.is_empty() {
        return;
    }
    let (name, state) = (&model.device_name, selected(model));
    open!(code, "impl<X> ", name, "<rt::Parameters<X, messages::Protocol, { messages::MAX_DATA }>> {");
    let (about, parameters, own) = match protocol.has_station {
        true => ("The device with this number, over", "exchange: X, station: u32", "messages::Protocol { station }"),
        false => ("The device, over", "exchange: X", "messages::Protocol"),
    };
    code.doc(&format!("{about} what exchanges the data of messages."));
    open!(code, "pub const fn on(", parameters, ") -> Self {");
    line!(code, "Self::new(", call!("rt::Parameters::new", "exchange", own), ")");
    code.close("}");
    code.close("}");
    let calls = |is_own: &dyn Fn(&&CallModel) -> bool, code: &mut Code| {
        protocol.calls.iter().filter(is_own).for_each(|own| request(code, own));
    };
    if protocol.has_free() {
        open!(code, "impl<C", state, "> ", name, "<C", state, "> {");
        calls(&|own| own.after.is_none() && !own.is_selector, code);
        code.close("}");
    }
    if model.selects() {
        code.doc("What decides the meaning of later requests. `select` sends it, and gives the device that has these.");
        open!(code, "impl<C> ", name, "<C> {");
        calls(&|own| own.is_selector && own.after.is_none(), code);
        if let Some(default) = &protocol.by_default {
            after_power_on(code, name, &default.selector);
        }
        code.close("}");
    }
    for own in &protocol.calls {
        if let Some(after) = &own.after {
            open!(code, "impl<C> ", name, "<C, messages::", after, "> {");
            request(code, own);
            code.close("}");
        }
    }
}

fn after_power_on(code: &mut Code, name: &str, selector: &str) {
    code.doc("The device as it is after power-on. As long as that is in use, no request can be sent that decides what others mean; that");
    code.doc("none was sent before, only the program knows.");
    let result = generic!(name, "&mut C", seq!["messages::", selector]);
    open!(code, call!("pub fn after_power_on", "&mut self"), " -> ", result, " {");
    open!(code, name, " {");
    line!(code, "client: &mut self.client,");
    line!(code, "state: core::marker::PhantomData,");
    code.close("}");
    code.close("}");
}

fn request(code: &mut Code, own: &CallModel) {
    code.docs(&own.docs);
    if let Some(note) = &own.deprecated {
        line!(code, "#[deprecated(note = ", note, ")]");
    }
    let (generics, receiver, lifetime) =
        if own.borrows { ("<'a>", "&'a mut self", "'a") } else { ("", "&mut self", "'_") };
    let parameters = std::iter::once(Doc::from(receiver)).chain(own.arguments.iter().map(|argument| seq![argument]));
    let function = list(&format!("pub fn {}{generics}(", own.method), parameters, ")");
    open!(code, function, " -> ", generic!("rt::message::Call", lifetime, "C", own.ty), " {");
    if own.arguments.is_empty() {
        line!(code, call!("rt::message::Call::new", "&mut self.client", own.build));
    } else {
        if own.build.text() != "message" {
            line!(code, "let message = ", own.build, ";");
        }
        line!(code, call!("rt::message::Call::new", "&mut self.client", "message"));
    }
    code.close("}");
}
