//! Prints bit fields and their views.

use crate::backend::rust::bit_field::{BitFieldModel, DebugModel, FieldModel, ViewModel};
use crate::backend::rust::code::{call, line, open, seq, slice, Code, Doc};
use crate::backend::rust::links;

pub(in crate::backend::rust) fn write(code: &mut Code, bits: &BitFieldModel) {
    code.docs(&bits.docs);
    code.lines(&bits.derives);
    line!(code, "pub struct ", bits.name, "(", bits.native, ");");
    methods(code, bits);
    code.implementation("Default", &bits.name, "fn default() -> Self", "Self::new()");
    conversions(code, bits);
    if let Some(debug) = &bits.debug {
        texts(code, &bits.name, debug);
    }
    if let Some(mask) = &bits.flags {
        operators(code, &bits.name, mask);
    }
    bits.views.iter().for_each(|view| self::view(code, bits, view));
}

fn methods(code: &mut Code, bits: &BitFieldModel) {
    code.lines(&bits.allow);
    open!(code, "impl ", bits.name, " {");
    code.doc(match bits.initial.as_str() {
        "0" => "Creates a value in which all bits are 0.",
        _ => "Creates a value in which all bits are 0, except reserved bits that must be 1.",
    });
    code.block("pub const fn new() -> Self", seq!["Self(", bits.initial, ")"]);
    code.doc("Creates the value from its raw bits.");
    code.block(seq!["pub const fn from_raw(raw: ", bits.native, ") -> Self"], seq!["Self(", bits.cut, ")"]);
    code.doc("Returns the raw bits.");
    code.block(seq!["pub const fn raw(self) -> ", bits.native], "self.0");
    bits.fields.iter().for_each(|field| self::field(code, field));
    for view in &bits.views {
        code.doc(&format!("Returns a view of the bits that are defined {}.", view.title));
        let function = seq![call!(seq!["pub const fn ", view.method], "self"), " -> ", view.name];
        code.block(function, seq![view.name, "(self.0)"]);
    }
    code.close("}");
}

fn field(code: &mut Code, field: &FieldModel) {
    code.doc(&field.docs);
    code.block(seq![call!(seq!["pub const fn ", field.getter], "self"), " -> ", field.ty], &field.get);
    code.doc(&format!("Returns a copy with {} set to `value`.", field.title));
    line!(code, "#[must_use]");
    let setter = call!(seq!["pub const fn ", field.setter], "self", seq!["value: ", field.ty]);
    code.block(seq![setter, " -> Self"], &field.set);
}

fn conversions(code: &mut Code, bits: &BitFieldModel) {
    open!(code, "impl rt::Enumeration for ", bits.name, " {");
    line!(code, "type Base = ", bits.base, ";");
    code.block(seq!["fn from_native(native: ", bits.native, ") -> Self"], "Self::from_raw(native)");
    code.block(seq!["fn native(self) -> ", bits.native], bits.written.as_deref().unwrap_or("self.0"));
    if bits.written.is_some() {
        code.block(seq!["fn as_is(self) -> ", bits.native], "self.0");
    }
    code.close("}");
}

fn texts(code: &mut Code, name: &str, debug: &DebugModel) {
    code.lines(&debug.gate);
    code.block(seq!["impl rt::BitField for ", name], seq!["const LAYOUT: &'static str = ", debug.layout, ";"]);
    let values = slice(&debug.values);
    let bits = call!("rt::debug_bits", "f", debug.raw, "<Self as rt::BitField>::LAYOUT", values);
    format(code, &debug.gate, "Debug", name, bits);
    for name_of_trait in ["LowerHex", "UpperHex", "Binary"] {
        let number = call!(seq!["core::fmt::", name_of_trait, "::fmt"], "&self.0", "f");
        format(code, &debug.gate, name_of_trait, name, number);
    }
}

/// Writes the implementation of a trait of `core::fmt`.
pub(super) fn format(code: &mut Code, gate: &[String], name_of_trait: &str, name: &str, body: Doc) {
    code.lines(gate);
    let function = "fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result";
    code.implementation(seq!["core::fmt::", name_of_trait], name, function, body);
}

/// Writes the operators of a bit field that consists only of flags.
fn operators(code: &mut Code, name: &str, mask: &str) {
    for (operator, method, sign) in [("BitOr", "bitor", "|"), ("BitAnd", "bitand", "&")] {
        open!(code, "impl core::ops::", operator, " for ", name, " {");
        line!(code, "type Output = Self;");
        code.block(seq!["fn ", method, "(self, other: Self) -> Self"], seq!["Self(self.0 ", sign, " other.0)"]);
        code.close("}");
    }
    open!(code, "impl core::ops::Not for ", name, " {");
    line!(code, "type Output = Self;");
    code.block("fn not(self) -> Self", seq!["Self(self.0 ^ ", mask, ")"]);
    code.close("}");
}

fn view(code: &mut Code, bits: &BitFieldModel, view: &ViewModel) {
    code.doc(&format!("View of {} with the bits that are defined {}.", links::sibling(&bits.name), view.title));
    line!(code, "#[derive(Clone, Copy)]");
    line!(code, "pub struct ", view.name, "(", bits.native, ");");
    code.lines(&view.allow);
    open!(code, "impl ", view.name, " {");
    code.doc("Returns the whole bit field.");
    let function = seq![call!(seq!["pub const fn ", view.back], "self"), " -> ", bits.name];
    code.block(function, seq![bits.name, "(self.0)"]);
    view.fields.iter().for_each(|field| self::field(code, field));
    code.close("}");
}
