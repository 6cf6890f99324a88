//! Bit fields and their views.

use crate::backend::rust::bit_field::{BitFieldModel, DebugModel, FieldModel, ViewModel};
use crate::backend::rust::code::{call, line, open, seq, Code};
use crate::backend::rust::links;

pub(in crate::backend::rust) fn write(code: &mut Code, own: &BitFieldModel) {
    code.docs(&own.docs);
    code.lines(&own.derives);
    line!(code, "pub struct ", own.name, "(", own.native, ");");
    methods(code, own);
    open!(code, "impl Default for ", own.name, " {");
    open!(code, "fn default() -> Self {");
    line!(code, "Self::new()");
    code.close("}");
    code.close("}");
    conversions(code, own);
    if let Some(debug) = &own.debug {
        self::debug(code, &own.name, debug);
    }
    own.views.iter().for_each(|view| self::view(code, own, view));
}

fn methods(code: &mut Code, own: &BitFieldModel) {
    code.lines(&own.allow);
    open!(code, "impl ", own.name, " {");
    code.doc(match own.initial.as_str() {
        "0" => "No bit set.",
        _ => "No bit but reserved ones that have to be set.",
    });
    open!(code, "pub const fn new() -> Self {");
    line!(code, "Self(", own.initial, ")");
    code.close("}");
    code.doc("All bits as a device sends them.");
    open!(code, "pub const fn from_raw(raw: ", own.native, ") -> Self {");
    line!(code, "Self(", own.cut, ")");
    code.close("}");
    code.doc("All bits as they are.");
    open!(code, "pub const fn raw(self) -> ", own.native, " {");
    line!(code, "self.0");
    code.close("}");
    own.fields.iter().for_each(|own| field(code, own));
    for view in &own.views {
        code.doc(&format!("The bits that have their meaning {}.", view.title));
        open!(code, call!(seq!["pub const fn ", view.method], "self"), " -> ", view.name, " {");
        line!(code, view.name, "(self.0)");
        code.close("}");
    }
    code.close("}");
}

fn field(code: &mut Code, own: &FieldModel) {
    code.doc(&own.docs);
    open!(code, call!(seq!["pub const fn ", own.getter], "self"), " -> ", own.ty, " {");
    line!(code, own.get);
    code.close("}");
    code.doc(&format!("The same with another {}.", own.title));
    line!(code, "#[must_use]");
    open!(code, call!(seq!["pub const fn ", own.setter], "self", seq!["value: ", own.ty]), " -> Self {");
    line!(code, own.set);
    code.close("}");
}

fn conversions(code: &mut Code, own: &BitFieldModel) {
    open!(code, "impl rt::Enumeration for ", own.name, " {");
    line!(code, "type Base = ", own.base, ";");
    open!(code, "fn from_native(native: ", own.native, ") -> Self {");
    line!(code, "Self::from_raw(native)");
    code.close("}");
    open!(code, "fn native(self) -> ", own.native, " {");
    line!(code, own.written.as_deref().unwrap_or("self.0"));
    code.close("}");
    if own.written.is_some() {
        open!(code, "fn as_is(self) -> ", own.native, " {");
        line!(code, "self.0");
        code.close("}");
    }
    code.close("}");
}

fn debug(code: &mut Code, name: &str, debug: &DebugModel) {
    code.lines(&debug.gate);
    open!(code, "impl core::fmt::Debug for ", name, " {");
    open!(code, "fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {");
    line!(code, "let bits = ", call!("rt::DebugBits::new", "f", debug.title, debug.raw), ";");
    for own in &debug.calls {
        line!(code, "let bits = rt::DebugBits::", own, ";");
    }
    line!(code, "bits.finish()");
    code.close("}");
    code.close("}");
}

fn view(code: &mut Code, own: &BitFieldModel, view: &ViewModel) {
    code.doc(&format!("{} {}.", links::beside(&own.name), view.title));
    line!(code, "#[derive(Clone, Copy)]");
    line!(code, "pub struct ", view.name, "(", own.native, ");");
    code.lines(&view.allow);
    open!(code, "impl ", view.name, " {");
    code.doc("All bits.");
    open!(code, call!(seq!["pub const fn ", view.back], "self"), " -> ", own.name, " {");
    line!(code, own.name, "(self.0)");
    code.close("}");
    view.fields.iter().for_each(|own| field(code, own));
    code.close("}");
}
