//! Prints enumerations.

use crate::backend::rust::code::{line, open, Code};
use crate::backend::rust::profinet::Enumeration;

pub(super) fn write(code: &mut Code, enumeration: &Enumeration) {
    code.docs(&enumeration.docs);
    code.lines(&enumeration.derives);
    open!(code, "pub enum ", enumeration.name, " {");
    for variant in &enumeration.variants {
        code.doc(&variant.docs);
        line!(code, variant.name, ",");
    }
    code.doc("A number that is not in the device description.");
    line!(code, "Unknown(", enumeration.native, "),");
    code.close("}");
    open!(code, "impl ", enumeration.name, " {");
    code.doc("Returns the variant for this number.");
    open!(code, "pub const fn from_raw(raw: ", enumeration.native, ") -> Self {");
    open!(code, "match raw {");
    for variant in &enumeration.variants {
        line!(code, variant.value, " => Self::", variant.name, ",");
    }
    line!(code, "_ => Self::Unknown(raw),");
    code.close("}");
    code.close("}");
    code.doc("Returns the number of the variant.");
    open!(code, "pub const fn raw(self) -> ", enumeration.native, " {");
    open!(code, "match self {");
    for variant in &enumeration.variants {
        line!(code, "Self::", variant.name, " => ", variant.value, ",");
    }
    line!(code, "Self::Unknown(raw) => raw,");
    code.close("}");
    code.close("}");
    code.close("}");
}
