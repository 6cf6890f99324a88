//! Prints bit fields and their views.

use crate::backend::rust::bit_field::{BitFieldModel, DebugModel, FieldModel, ViewModel};
use crate::backend::rust::code::{call, line, open, seq, slice, Code, Doc};
use crate::backend::rust::links;

pub(in crate::backend::rust) fn write(code: &mut Code, bits: &BitFieldModel) {
    code.docs(&bits.docs);
    code.lines(&bits.derives);
    line!(code, "pub struct ", bits.name, "(", bits.native, ");");
    methods(code, bits);
    open!(code, "impl Default for ", bits.name, " {");
    open!(code, "fn default() -> Self {");
    line!(code, "Self::new()");
    code.close("}");
    code.close("}");
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
    open!(code, "pub const fn new() -> Self {");
    line!(code, "Self(", bits.initial, ")");
    code.close("}");
    code.doc("Creates the value from its raw bits.");
    open!(code, "pub const fn from_raw(raw: ", bits.native, ") -> Self {");
    line!(code, "Self(", bits.cut, ")");
    code.close("}");
    code.doc("Returns the raw bits.");
    open!(code, "pub const fn raw(self) -> ", bits.native, " {");
    line!(code, "self.0");
    code.close("}");
    bits.fields.iter().for_each(|field| self::field(code, field));
    for view in &bits.views {
        code.doc(&format!("Returns a view of the bits that are defined {}.", view.title));
        open!(code, call!(seq!["pub const fn ", view.method], "self"), " -> ", view.name, " {");
        line!(code, view.name, "(self.0)");
        code.close("}");
    }
    code.close("}");
}

fn field(code: &mut Code, field: &FieldModel) {
    code.doc(&field.docs);
    open!(code, call!(seq!["pub const fn ", field.getter], "self"), " -> ", field.ty, " {");
    line!(code, field.get);
    code.close("}");
    code.doc(&format!("Returns a copy with {} set to `value`.", field.title));
    line!(code, "#[must_use]");
    open!(code, call!(seq!["pub const fn ", field.setter], "self", seq!["value: ", field.ty]), " -> Self {");
    line!(code, field.set);
    code.close("}");
}

fn conversions(code: &mut Code, bits: &BitFieldModel) {
    open!(code, "impl rt::Enumeration for ", bits.name, " {");
    line!(code, "type Base = ", bits.base, ";");
    open!(code, "fn from_native(native: ", bits.native, ") -> Self {");
    line!(code, "Self::from_raw(native)");
    code.close("}");
    open!(code, "fn native(self) -> ", bits.native, " {");
    line!(code, bits.written.as_deref().unwrap_or("self.0"));
    code.close("}");
    if bits.written.is_some() {
        open!(code, "fn as_is(self) -> ", bits.native, " {");
        line!(code, "self.0");
        code.close("}");
    }
    code.close("}");
}

fn texts(code: &mut Code, name: &str, debug: &DebugModel) {
    code.lines(&debug.gate);
    open!(code, "impl rt::BitField for ", name, " {");
    line!(code, "const LAYOUT: &'static str = ", debug.layout, ";");
    code.close("}");
    let values = slice(&debug.values);
    format(
        code,
        &debug.gate,
        "Debug",
        name,
        call!("rt::debug_bits", "f", debug.raw, "<Self as rt::BitField>::LAYOUT", values),
    );
    for name_of_trait in ["LowerHex", "UpperHex", "Binary"] {
        format(
            code,
            &debug.gate,
            name_of_trait,
            name,
            call!(seq!["core::fmt::", name_of_trait, "::fmt"], "&self.0", "f"),
        );
    }
}

/// Writes the implementation of a trait of `core::fmt`.
pub(super) fn format(code: &mut Code, gate: &[String], name_of_trait: &str, name: &str, body: Doc) {
    code.lines(gate);
    open!(code, "impl core::fmt::", name_of_trait, " for ", name, " {");
    open!(code, "fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {");
    line!(code, body);
    code.close("}");
    code.close("}");
}

/// Writes the operators of a bit field that consists only of flags.
fn operators(code: &mut Code, name: &str, mask: &str) {
    for (operator, method, sign) in [("BitOr", "bitor", "|"), ("BitAnd", "bitand", "&")] {
        open!(code, "impl core::ops::", operator, " for ", name, " {");
        line!(code, "type Output = Self;");
        open!(code, "fn ", method, "(self, other: Self) -> Self {");
        line!(code, "Self(self.0 ", sign, " other.0)");
        code.close("}");
        code.close("}");
    }
    open!(code, "impl core::ops::Not for ", name, " {");
    line!(code, "type Output = Self;");
    open!(code, "fn not(self) -> Self {");
    line!(code, "Self(self.0 ^ ", mask, ")");
    code.close("}");
    code.close("}");
}

fn view(code: &mut Code, bits: &BitFieldModel, view: &ViewModel) {
    code.doc(&format!("View of {} with the bits that are defined {}.", links::sibling(&bits.name), view.title));
    line!(code, "#[derive(Clone, Copy)]");
    line!(code, "pub struct ", view.name, "(", bits.native, ");");
    code.lines(&view.allow);
    open!(code, "impl ", view.name, " {");
    code.doc("Returns the whole bit field.");
    open!(code, call!(seq!["pub const fn ", view.back], "self"), " -> ", bits.name, " {");
    line!(code, bits.name, "(self.0)");
    code.close("}");
    view.fields.iter().for_each(|field| self::field(code, field));
    code.close("}");
}
