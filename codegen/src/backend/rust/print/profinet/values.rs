//! Enumerations.

use crate::backend::rust::code::{line, open, Code};
use crate::backend::rust::profinet::Enumeration;

pub(super) fn write(code: &mut Code, own: &Enumeration) {
    code.docs(&own.docs);
    code.lines(&own.derives);
    open!(code, "pub enum ", own.name, " {");
    for variant in &own.variants {
        code.doc(&variant.docs);
        line!(code, variant.name, ",");
    }
    code.doc("A number that the description doesn't list.");
    line!(code, "Unknown(", own.native, "),");
    code.close("}");
    open!(code, "impl ", own.name, " {");
    code.doc("The value with this number.");
    open!(code, "pub const fn from_raw(raw: ", own.native, ") -> Self {");
    open!(code, "match raw {");
    for variant in &own.variants {
        line!(code, variant.value, " => Self::", variant.name, ",");
    }
    line!(code, "_ => Self::Unknown(raw),");
    code.close("}");
    code.close("}");
    code.doc("Its number.");
    open!(code, "pub const fn raw(self) -> ", own.native, " {");
    open!(code, "match self {");
    for variant in &own.variants {
        line!(code, "Self::", variant.name, " => ", variant.value, ",");
    }
    line!(code, "Self::Unknown(raw) => raw,");
    code.close("}");
    code.close("}");
    code.close("}");
}
