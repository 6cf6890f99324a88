//! Requests and replies.

use super::accessors::selected;
use crate::backend::rust::code::{call, generic, line, list, open, seq, Code, Data, Doc, Stop};
use crate::backend::rust::links;
use crate::backend::rust::messages::{
    Arm, CallModel, DataModel, EntryModel, Field, MessageModel, ParametersModel, ProtocolModel, Statements,
};
use crate::backend::rust::model::Model;

pub(super) fn write(code: &mut Code, model: &Model) {
    let Some(protocol) = &model.protocol else { return };
    code.doc("Requests and replies.");
    if protocol.has_real_limits() {
        line!(code, "#[allow(clippy::approx_constant)]");
    }
    open!(code, "pub mod messages {");
    code.use_runtime();
    constants(code, protocol);
    if let Some(parameters) = &protocol.parameters {
        self::parameters(code, parameters, protocol.has_station);
    }
    for rule in &protocol.rules {
        code.doc(&rule.docs);
        open!(code, "pub const ", rule.name, ": rt::message::SettingsRule = rt::message::SettingsRule {");
        line!(code, "code_bits: ", rule.code_bits, ",");
        line!(code, "order: &[", rule.order, "],");
        line!(code, "lengths: ", list("&[", &rule.lengths, "]"), ",");
        code.close("};");
    }
    for message in &protocol.messages {
        if let Some(own) = &message.request {
            request(code, model, message, own);
        }
        if let Some(own) = &message.reply {
            reply(code, own);
        }
    }
    if !protocol.requests.is_empty() {
        requests(code, protocol);
    }
    code.close("}");
}

fn constants(code: &mut Code, protocol: &ProtocolModel) {
    if let Some(framing) = &protocol.framing {
        code.docs(&protocol.framing_docs);
        line!(code, "pub const FRAMING: rt::framing::Delimited = ", framing, ";");
    }
    code.doc("The greatest length of the data of a message, in bytes.");
    line!(code, "pub const MAX_DATA: usize = ", protocol.max_data, ";");
    code.doc(match protocol.has_station {
        true => "The messages that carry parameters, and the number of the device.",
        false => "The messages that carry parameters.",
    });
    code.lines(&protocol.derives);
    if protocol.has_station {
        open!(code, "pub struct Protocol {");
        code.doc("The number of the device.");
        line!(code, "pub station: u32,");
        code.close("}");
    } else {
        line!(code, "pub struct Protocol;");
    }
    open!(code, "impl rt::message::Station for Protocol {");
    open!(code, "fn station(&self) -> u32 {");
    line!(code, if protocol.has_station { "self.station" } else { "0" });
    code.close("}");
    code.close("}");
}

/// A function whose parameters have a line each.
fn function(code: &mut Code, start: &str, parameters: &[&str], result: &str) {
    open!(code, start, "(");
    for parameter in parameters {
        line!(code, parameter, ",");
    }
    code.reopen(&format!(") -> {result} {{"));
}

const WRITTEN: &str = "Result<usize, rt::message::WriteError>";

fn parameters(code: &mut Code, own: &ParametersModel, has_station: bool) {
    open!(code, "impl rt::ParameterMessages for Protocol {");
    let given = ["&self", "parameter: rt::Parameter", "_: usize", "request: &mut [u8]"];
    function(code, "fn read_request", &given, WRITTEN);
    line!(code, "let mut to = rt::message::Writer::new(request);");
    sent(code, &own.read, has_station, "parameter", |arm| format!("{}.length(parameter).is_some()", arm.rule));

    let given = ["&self", "parameter: rt::Parameter", "request: &[u8]", "reply: &[u8]", "value: &mut [u8]"];
    function(code, "fn read_reply<E>", &given, "Result<usize, rt::Error<E>>");
    if own.read.is_empty() {
        line!(code, "let _ = (parameter, request, reply, value);");
    }
    for arm in &own.read {
        open!(code, "if ", arm.rule, ".length(parameter).is_some() {");
        line!(code, "let reply = ", received(arm), "?;");
        line!(code, "return ", arm.value, ";");
        code.close("}");
    }
    line!(code, "Err(rt::Error::NoMessage)");
    code.close("}");

    let given = ["&self", "parameter: rt::Parameter", "value: &[u8]", "request: &mut [u8]"];
    function(code, "fn write_request", &given, WRITTEN);
    line!(code, "let setting = ", call!("rt::message::Setting::of", "parameter", "value"), ";");
    line!(code, "let settings = [setting.ok_or(rt::message::WriteError::NoMessage)?];");
    line!(code, "let mut to = rt::message::Writer::new(request);");
    sent(code, &own.write, has_station, "settings", |arm| format!("{}.takes(&settings[0])?", arm.rule));

    let given = ["&self", "parameter: rt::Parameter", "request: &[u8]", "reply: &[u8]"];
    function(code, "fn write_reply<E>", &given, "Result<(), rt::Error<E>>");
    if own.write.is_empty() {
        line!(code, "let _ = (parameter, request, reply);");
    }
    for arm in &own.write {
        open!(code, "if ", arm.rule, ".length(parameter).is_some() {");
        line!(code, "let _ = ", received(arm), "?;");
        line!(code, "return Ok(());");
        code.close("}");
    }
    line!(code, "Err(rt::Error::NoMessage)");
    code.close("}");
    code.close("}");
}

/// What writes the first message whose condition holds, and the end of the function.
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

fn received(arm: &Arm) -> Doc {
    call!(generic!("rt::message::read::", arm.message, "E"), "request", "reply")
}

/// The lifetime behind the name of what borrows from the data.
fn lifetime(own: &DataModel) -> &'static str {
    if own.borrows {
        "<'a>"
    } else {
        ""
    }
}

fn request(code: &mut Code, model: &Model, message: &MessageModel, own: &DataModel) {
    data(code, own);
    let (name, lifetime) = (&own.name, lifetime(own));
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
    let station = if own.code.uses_station { "station" } else { "_" };
    writes(code, &format!("{station}: u32"), &own.code);
    code.close("}");
    open!(code, "impl<'a> rt::message::Request<'a> for ", name, lifetime, " {");
    open!(code, "fn parse(from: &mut rt::message::Reader<'a>) -> Option<(u32, Self)> {");
    reads(code, &own.code);
    line!(code, "Some((", if own.code.uses_station { "station" } else { "0" }, ", own))");
    code.close("}");
    code.close("}");
    if !message.outcomes.is_empty() {
        open!(code, "impl", lifetime, " ", name, lifetime, " {");
        for own in &message.outcomes {
            code.docs(&own.docs);
            line!(code, "pub const ", own.name, ": rt::message::Outcomes<", own.states, "> = ", own.value, ";");
        }
        code.close("}");
    }
    if message.is_selector && model.protocol.as_ref().is_some_and(|own| !own.calls.is_empty()) {
        selector(code, name, &model.device_name);
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

fn reply(code: &mut Code, own: &DataModel) {
    data(code, own);
    let (name, lifetime) = (&own.name, lifetime(own));
    if let Some(is_complete) = &own.is_complete {
        open!(code, "impl", lifetime, " ", name, lifetime, " {");
        code.doc("Whether the order is carried out.");
        open!(code, "pub const fn is_complete(&self) -> bool {");
        line!(code, is_complete);
        code.close("}");
        code.close("}");
    }
    open!(code, "impl<'a> rt::message::Reply<'a> for ", name, lifetime, " {");
    let request = |is_used: bool| format!("{}: &[u8]", if is_used { "request" } else { "_" });
    let from = "from: &mut rt::message::Reader<'a>";
    open!(code, call!("fn read", request(own.code.reads_request), from), " -> Option<Self> {");
    reads(code, &own.code);
    line!(code, "Some(own)");
    code.close("}");
    writes(code, &request(own.code.writes_request), &own.code);
    code.close("}");
}

/// The function that writes the data; `given` is the parameter beside `self` and the writer.
fn writes(code: &mut Code, given: &str, own: &Statements) {
    let to = if own.write.is_empty() { "_" } else { "to" };
    let to = format!("{to}: &mut rt::message::Writer<'_>");
    function(code, "fn write", &["&self", given, &to], "Result<(), rt::message::WriteError>");
    code.lines(&own.write);
    line!(code, "Ok(())");
    code.close("}");
}

/// The statements that read the data, and the struct that is made of it.
fn reads(code: &mut Code, own: &Statements) {
    code.lines(&own.read);
    line!(code, "let own = ", Data::fields("Self", own.build.clone()), ";");
}

fn requests(code: &mut Code, protocol: &ProtocolModel) {
    let (lifetime, borrow) = if protocol.requests_borrow() { ("<'a>", "'a ") } else { ("", "") };
    code.doc("A request, as a simulated device gets it.");
    code.lines(&protocol.request_derives);
    open!(code, "pub enum Request", lifetime, " {");
    for (name, borrows) in &protocol.requests {
        code.doc(&format!("{}.", links::beside(name)));
        line!(code, name, "(", name, if *borrows { "<'a>" } else { "" }, "),");
    }
    code.close("}");
    open!(code, "impl", lifetime, " Request", lifetime, " {");
    code.doc("The number of the device that is meant, and the request; `None` where the data are none. Of requests that are alike, the");
    code.doc("first is told.");
    open!(code, "pub fn parse(data: &", borrow, "[u8]) -> Option<(u32, Self)> {");
    line!(code, "let from = rt::message::Reader::new(data);");
    for (name, _) in &protocol.requests {
        line!(code, "let own = rt::message::Request::parse(&mut from.clone());");
        open!(code, "if let Some((station, own)) = own {");
        line!(code, "return Some((station, Self::", name, "(own)));");
        code.close("}");
    }
    line!(code, "None");
    code.close("}");
    code.close("}");
}

fn data(code: &mut Code, own: &DataModel) {
    if let Some(entry) = &own.entry {
        self::entry(code, entry);
    }
    code.docs(&own.docs);
    code.lines(&own.derives);
    if own.fields.is_empty() {
        line!(code, "pub struct ", own.name, ";");
    } else {
        open!(code, "pub struct ", own.name, lifetime(own), " {");
        fields(code, &own.fields);
        code.close("}");
    }
    scales(code, &own.name, if own.borrows { "<'_>" } else { "" }, &own.fields);
}

fn fields(code: &mut Code, fields: &[Field]) {
    for field in fields {
        code.field(&field.docs, field.attribute.as_ref(), &field.name, &field.ty);
    }
}

fn entry(code: &mut Code, own: &EntryModel) {
    code.doc(&own.title);
    code.lines(&own.derives);
    open!(code, "pub struct ", own.name, " {");
    fields(code, &own.fields);
    code.close("}");
    open!(code, "impl rt::message::Group for ", own.name, " {");
    line!(code, "const LENGTH: usize = ", own.length, ";");
    let to = "to: &mut rt::message::Writer<'_>";
    open!(code, call!("fn write", "&self", to), " -> Result<(), rt::message::WriteError> {");
    code.lines(&own.code.write);
    line!(code, "Ok(())");
    code.close("}");
    open!(code, "fn read(from: &mut rt::message::Reader<'_>) -> Option<Self> {");
    reads(code, &own.code);
    line!(code, "Some(own)");
    code.close("}");
    code.close("}");
    scales(code, &own.name, "", &own.fields);
}

fn scales(code: &mut Code, name: &str, lifetime: &str, fields: &[Field]) {
    let mut scales = fields.iter().filter_map(|own| Some((own, own.scale.as_ref()?))).peekable();
    if scales.peek().is_none() {
        return;
    }
    open!(code, "impl ", name, lifetime, " {");
    for (field, (constant, ty)) in scales {
        code.doc(&format!("The scale of `{}`.", field.name));
        let ty = generic!("rt::message::Scale", ty);
        line!(code, "pub const ", constant, ": ", ty, " = ", Stop, "rt::message::Scale::new();");
    }
    code.close("}");
}

/// The methods that send requests.
pub(super) fn methods(code: &mut Code, model: &Model) {
    let Some(protocol) = model.protocol.as_ref().filter(|protocol| !protocol.calls.is_empty()) else { return };
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
        protocol.calls.iter().filter(is_own).for_each(|own| method(code, own));
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
            method(code, own);
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

fn method(code: &mut Code, own: &CallModel) {
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
