//! Prints a message protocol: requests, replies, encoding rules, and the methods that send requests.

use super::accessors::selected;
use crate::backend::rust::code::{call, generic, line, list, open, seq, Code, Data, Doc, Stop};
use crate::backend::rust::links;
use crate::backend::rust::messages::{
    Arm, CallModel, DataModel, EntryModel, Field, MessageModel, ParametersModel, ProtocolModel, Statements,
};
use crate::backend::rust::model::Model;

/// Takes the protocol from the model, and drops each message as soon as it is printed.
pub(super) fn write(code: &mut Code, model: &mut Model) {
    let Some(mut protocol) = model.protocol.take() else { return };
    code.doc("Requests and replies of the message protocol.");
    if protocol.has_real_limits() {
        line!(code, "#[allow(clippy::approx_constant)]");
    }
    open!(code, "pub mod messages {");
    code.use_runtime();
    constants(code, &protocol);
    if let Some(parameters) = &protocol.parameters {
        self::parameters(code, parameters, protocol.has_station);
    }
    code.declare(protocol.rules.iter().map(|rule| &rule.constant));
    let device = (!protocol.calls.is_empty()).then_some(model.device_name.as_str());
    for message in std::mem::take(&mut protocol.messages) {
        if let Some(data) = &message.request {
            request(code, &message, data, device);
        }
        if let Some(data) = &message.reply {
            reply(code, data);
        }
    }
    if !protocol.requests.is_empty() {
        requests(code, &protocol);
    }
    code.close("}");
}

fn constants(code: &mut Code, protocol: &ProtocolModel) {
    code.declare(&protocol.framing);
    code.doc("Maximum length of the data in a message, in bytes.");
    line!(code, "pub const MAX_DATA: usize = ", protocol.max_data, ";");
    code.doc(match protocol.has_station {
        true => "Messages that read and write parameters of the device with this station address.",
        false => "Messages that read and write parameters.",
    });
    code.lines(&protocol.derives);
    if protocol.has_station {
        open!(code, "pub struct Protocol {");
        code.doc("Station address of the device.");
        line!(code, "pub station: u32,");
        code.close("}");
    } else {
        line!(code, "pub struct Protocol;");
    }
    let station = if protocol.has_station { "self.station" } else { "0" };
    code.implementation("rt::message::Station", "Protocol", "fn station(&self) -> u32", station);
}

/// Writes the first lines of a function. Each parameter has its own line.
fn function(code: &mut Code, start: &str, parameters: &[&str], result: &str) {
    open!(code, start, "(");
    for parameter in parameters {
        line!(code, parameter, ",");
    }
    code.reopen(&format!(") -> {result} {{"));
}

const WRITTEN: &str = "Result<usize, rt::message::WriteError>";

fn parameters(code: &mut Code, model: &ParametersModel, has_station: bool) {
    open!(code, "impl rt::ParameterMessages for Protocol {");
    let given = ["&self", "parameter: rt::Parameter", "_: usize", "request: &mut [u8]"];
    function(code, "fn read_request", &given, WRITTEN);
    line!(code, "let mut to = rt::message::Writer::new(request);");
    sent(code, &model.read, has_station, "parameter", |arm| format!("{}.length(parameter).is_some()", arm.rule));

    let given = ["&self", "parameter: rt::Parameter", "request: &[u8]", "reply: &[u8]", "value: &mut [u8]"];
    function(code, "fn read_reply<E>", &given, "Result<usize, rt::Error<E>>");
    received(code, &model.read, "parameter, request, reply, value", "reply", |arm| &arm.value);

    let given = ["&self", "parameter: rt::Parameter", "value: &[u8]", "request: &mut [u8]"];
    function(code, "fn write_request", &given, WRITTEN);
    line!(code, "let setting = ", call!("rt::message::Setting::of", "parameter", "value"), ";");
    line!(code, "let settings = [setting.ok_or(rt::message::WriteError::NoMessage)?];");
    line!(code, "let mut to = rt::message::Writer::new(request);");
    sent(code, &model.write, has_station, "settings", |arm| format!("{}.takes(&settings[0])?", arm.rule));

    let given = ["&self", "parameter: rt::Parameter", "request: &[u8]", "reply: &[u8]"];
    function(code, "fn write_reply<E>", &given, "Result<(), rt::Error<E>>");
    received(code, &model.write, "parameter, request, reply", "_", |_| "Ok(())");
    code.close("}");
}

/// Writes code that encodes the message of the first arm whose condition is true. Also writes the end of the function.
fn sent(code: &mut Code, arms: &[Arm], has_station: bool, unused: &str, condition: impl Fn(&Arm) -> String) {
    if arms.is_empty() {
        line!(code, "let _ = (", unused, ", &mut to);");
    }
    let station = if has_station { "self.station" } else { "0" };
    for arm in arms {
        open!(code, "if ", condition(arm), " {");
        line!(code, "let message = ", Data::fields(&arm.message, arm.build.clone()), ";");
        line!(code, call!("rt::message::Message::write", "&message", station, "&mut to"), "?;");
        line!(code, "return Ok(to.len());");
        code.close("}");
    }
    line!(code, "Err(rt::message::WriteError::NoMessage)");
    code.close("}");
}

/// Writes code that decodes the reply to the message of the first arm whose rule contains the parameter. Also writes the
/// end of the function. `unused` contains the parameters of a function without arms, and `reply` is the name of the
/// decoded reply.
fn received(code: &mut Code, arms: &[Arm], unused: &str, reply: &str, result: impl Fn(&Arm) -> &str) {
    if arms.is_empty() {
        line!(code, "let _ = (", unused, ");");
    }
    for arm in arms {
        open!(code, "if ", arm.rule, ".length(parameter).is_some() {");
        let read = call!(generic!("rt::message::read::", arm.message, "E"), "request", "reply");
        line!(code, "let ", reply, " = ", read, "?;");
        line!(code, "return ", result(arm), ";");
        code.close("}");
    }
    line!(code, "Err(rt::Error::NoMessage)");
    code.close("}");
}

/// Returns the lifetime argument of a message type that borrows from the data, or an empty text.
fn lifetime(data: &DataModel) -> &'static str {
    if data.borrows {
        "<'a>"
    } else {
        ""
    }
}

/// `device` is the type of the device if it has methods that send requests.
fn request(code: &mut Code, message: &MessageModel, data: &DataModel, device: Option<&str>) {
    self::data(code, data);
    let (name, lifetime) = (&data.name, lifetime(data));
    open!(code, "impl", lifetime, " rt::message::Message for ", name, lifetime, " {");
    match &message.reply {
        Some(reply) => {
            let lifetime = if reply.borrows { "<'r>" } else { "" };
            line!(code, "type Reply<'r> = ", reply.name, lifetime, ";");
        }
        None => line!(code, "type Reply<'r> = &'r [u8];"),
    }
    line!(code, "type Refusal = ", message.refusal, ";");
    line!(code, "const NAME: &'static str = ", message.title, ";");
    line!(code, "const COMPLETION: rt::message::Completion = ", message.completion, ";");
    let station = if data.code.uses_station { "station" } else { "_" };
    writes(code, &format!("{station}: u32"), &data.code);
    code.close("}");
    open!(code, "impl<'a> rt::message::Request<'a> for ", name, lifetime, " {");
    open!(code, "fn parse(from: &mut rt::message::Reader<'a>) -> Option<(u32, Self)> {");
    reads(code, &data.code);
    line!(code, "Some((", if data.code.uses_station { "station" } else { "0" }, ", parsed))");
    code.close("}");
    code.close("}");
    if !message.outcomes.is_empty() {
        open!(code, "impl", lifetime, " ", name, lifetime, " {");
        code.declare(&message.outcomes);
        code.close("}");
    }
    if let Some(device) = device.filter(|_| message.is_selector) {
        selector(code, name, device);
    }
}

fn selector(code: &mut Code, name: &str, device: &str) {
    open!(code, "impl rt::message::Selector for ", name, " {");
    line!(code, "type Device<C> = ", generic!(seq!["super::", device], "C", "Self"), ";");
    open!(code, "fn device<C>(client: C) -> Self::Device<C> {");
    open!(code, "super::", device, " {");
    line!(code, "client,");
    line!(code, "state: core::marker::PhantomData,");
    code.close("}");
    code.close("}");
    code.close("}");
}

fn reply(code: &mut Code, data: &DataModel) {
    self::data(code, data);
    let (name, lifetime) = (&data.name, lifetime(data));
    if let Some(is_complete) = &data.is_complete {
        open!(code, "impl", lifetime, " ", name, lifetime, " {");
        code.doc("Returns whether the command is completed.");
        code.block("pub const fn is_complete(&self) -> bool", is_complete);
        code.close("}");
    }
    open!(code, "impl<'a> rt::message::Reply<'a> for ", name, lifetime, " {");
    let request = |is_used: bool| format!("{}: &[u8]", if is_used { "request" } else { "_" });
    let from = "from: &mut rt::message::Reader<'a>";
    open!(code, call!("fn read", request(data.code.reads_request), from), " -> Option<Self> {");
    reads(code, &data.code);
    line!(code, "Some(parsed)");
    code.close("}");
    writes(code, &request(data.code.writes_request), &data.code);
    code.close("}");
}

/// Writes the function that writes the message data. `given` is an additional parameter, besides `self` and the writer.
fn writes(code: &mut Code, given: &str, statements: &Statements) {
    let to = if statements.write.is_empty() { "_" } else { "to" };
    let to = format!("{to}: &mut rt::message::Writer<'_>");
    function(code, "fn write", &["&self", given, &to], "Result<(), rt::message::WriteError>");
    code.lines(&statements.write);
    line!(code, "Ok(())");
    code.close("}");
}

/// Writes the statements that read the message data and create the struct.
fn reads(code: &mut Code, statements: &Statements) {
    code.lines(&statements.read);
    line!(code, "let parsed = ", Data::fields("Self", statements.build.clone()), ";");
}

fn requests(code: &mut Code, protocol: &ProtocolModel) {
    let (lifetime, borrow) = if protocol.requests_borrow() { ("<'a>", "'a ") } else { ("", "") };
    code.doc("A request that a simulated device receives.");
    code.lines(&protocol.request_derives);
    open!(code, "pub enum Request", lifetime, " {");
    for (name, borrows) in &protocol.requests {
        code.doc(&format!("{}.", links::sibling(name)));
        line!(code, name, "(", name, if *borrows { "<'a>" } else { "" }, "),");
    }
    code.close("}");
    open!(code, "impl", lifetime, " Request", lifetime, " {");
    code.doc("Decodes a request. Returns the station address of the device and the request, or `None` if the data");
    code.doc("contain no request. Returns the first request if several requests match the data.");
    open!(code, "pub fn parse(data: &", borrow, "[u8]) -> Option<(u32, Self)> {");
    line!(code, "let from = rt::message::Reader::new(data);");
    for (name, _) in &protocol.requests {
        line!(code, "let parsed = rt::message::Request::parse(&mut from.clone());");
        let found = seq!["return Some((station, Self::", name, "(request)));"];
        code.block("if let Some((station, request)) = parsed", found);
    }
    line!(code, "None");
    code.close("}");
    code.close("}");
}

fn data(code: &mut Code, data: &DataModel) {
    if let Some(entry) = &data.entry {
        self::entry(code, entry);
    }
    code.docs(&data.docs);
    code.lines(&data.derives);
    if data.fields.is_empty() {
        line!(code, "pub struct ", data.name, ";");
    } else {
        open!(code, "pub struct ", data.name, lifetime(data), " {");
        fields(code, &data.fields);
        code.close("}");
    }
    scales(code, &data.name, if data.borrows { "<'_>" } else { "" }, &data.fields);
}

fn fields(code: &mut Code, fields: &[Field]) {
    for field in fields {
        code.field(&field.docs, field.attribute.as_ref(), &field.name, &field.ty);
    }
}

fn entry(code: &mut Code, entry: &EntryModel) {
    code.doc(&entry.title);
    code.lines(&entry.derives);
    open!(code, "pub struct ", entry.name, " {");
    fields(code, &entry.fields);
    code.close("}");
    open!(code, "impl rt::message::Group for ", entry.name, " {");
    line!(code, "const LENGTH: usize = ", entry.length, ";");
    let to = "to: &mut rt::message::Writer<'_>";
    open!(code, call!("fn write", "&self", to), " -> Result<(), rt::message::WriteError> {");
    code.lines(&entry.code.write);
    line!(code, "Ok(())");
    code.close("}");
    open!(code, "fn read(from: &mut rt::message::Reader<'_>) -> Option<Self> {");
    reads(code, &entry.code);
    line!(code, "Some(parsed)");
    code.close("}");
    code.close("}");
    scales(code, &entry.name, "", &entry.fields);
}

fn scales(code: &mut Code, name: &str, lifetime: &str, fields: &[Field]) {
    let mut scales = fields.iter().filter_map(|field| Some((field, field.scale.as_ref()?))).peekable();
    if scales.peek().is_none() {
        return;
    }
    open!(code, "impl ", name, lifetime, " {");
    for (field, (constant, ty)) in scales {
        code.doc(&format!("Scale of the field `{}`.", field.name));
        let ty = generic!("rt::message::Scale", ty);
        line!(code, "pub const ", constant, ": ", ty, " = ", Stop, "rt::message::Scale::new();");
    }
    code.close("}");
}

/// Writes the constructor `on` and the methods that send requests.
pub(super) fn methods(code: &mut Code, model: &Model) {
    let Some(protocol) = model.protocol.as_ref().filter(|protocol| !protocol.calls.is_empty()) else { return };
    let (name, state) = (&model.device_name, selected(model));
    open!(code, "impl<X> ", name, "<rt::Parameters<X, messages::Protocol, { messages::MAX_DATA }>> {");
    let (about, parameters, protocol_value) = match protocol.has_station {
        true => (
            "Creates a driver for the device with the station address `station`.",
            "exchange: X, station: u32",
            "messages::Protocol { station }",
        ),
        false => ("Creates a driver for the device.", "exchange: X", "messages::Protocol"),
    };
    code.doc(&format!("{about} The driver sends and receives messages through `exchange`."));
    let driver = seq!["Self::new(", call!("rt::Parameters::new", "exchange", protocol_value), ")"];
    code.block(seq!["pub const fn on(", parameters, ") -> Self"], driver);
    code.close("}");
    let calls = |is_included: &dyn Fn(&&CallModel) -> bool, code: &mut Code| {
        protocol.calls.iter().filter(is_included).for_each(|call| method(code, call));
    };
    if protocol.has_free() {
        open!(code, "impl<C", state, "> ", name, "<C", state, "> {");
        calls(&|call| call.after.is_none() && !call.is_selector, code);
        code.close("}");
    }
    if model.selects() {
        code.doc(
            "Requests that determine the meaning of later requests. `select` sends such a request and returns a driver",
        );
        code.doc("with methods for the later requests.");
        open!(code, "impl<C> ", name, "<C> {");
        calls(&|call| call.is_selector && call.after.is_none(), code);
        if let Some(selector) = &protocol.by_default {
            after_power_on(code, name, selector);
        }
        code.close("}");
    }
    for call in &protocol.calls {
        if let Some(after) = &call.after {
            open!(code, "impl<C> ", name, "<C, messages::", after, "> {");
            method(code, call);
            code.close("}");
        }
    }
}

fn after_power_on(code: &mut Code, name: &str, selector: &str) {
    code.doc("Returns a driver for a device in its state after power-on. Use this driver only if no request that determines the meaning");
    code.doc(
        "of other requests was sent since power-on. No such request can be sent while the returned driver is in use.",
    );
    let result = generic!(name, "&mut C", seq!["messages::", selector]);
    open!(code, call!("pub fn after_power_on", "&mut self"), " -> ", result, " {");
    open!(code, name, " {");
    line!(code, "client: &mut self.client,");
    line!(code, "state: core::marker::PhantomData,");
    code.close("}");
    code.close("}");
}

fn method(code: &mut Code, call: &CallModel) {
    code.docs(&call.docs);
    if let Some(note) = &call.deprecated {
        line!(code, "#[deprecated(note = ", note, ")]");
    }
    let (generics, receiver, lifetime) =
        if call.borrows { ("<'a>", "&'a mut self", "'a") } else { ("", "&mut self", "'_") };
    let parameters = std::iter::once(Doc::from(receiver)).chain(call.arguments.iter().map(|argument| seq![argument]));
    let function = list(&format!("pub fn {}{generics}(", call.method), parameters, ")");
    open!(code, function, " -> ", generic!("rt::message::Call", lifetime, "C", call.ty), " {");
    if call.arguments.is_empty() {
        line!(code, call!("rt::message::Call::new", "&mut self.client", call.build));
    } else {
        if call.build.text() != "message" {
            line!(code, "let message = ", call.build, ";");
        }
        line!(code, call!("rt::message::Call::new", "&mut self.client", "message"));
    }
    code.close("}");
}
