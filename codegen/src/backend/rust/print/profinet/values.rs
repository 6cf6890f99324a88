//! Prints enumerations.

use crate::backend::rust::code::{open, seq, Code, Doc};
use crate::backend::rust::print::types;
use crate::backend::rust::profinet::Enumeration;

pub(super) fn write(code: &mut Code, enumeration: &Enumeration) {
    code.docs(&enumeration.docs);
    code.lines(&enumeration.derives);
    let (native, all) = (enumeration.native, || enumeration.variants.iter());
    let unknown = Some(("A number that is not in the device description.", native));
    types::variants(code, &enumeration.name, all().map(|variant| (&variant.docs, &variant.name)), unknown);
    open!(code, "impl ", enumeration.name, " {");
    code.doc("Returns the variant for this number.");
    let arms = all().map(|variant| (variant.value.to_string(), seq!["Self::", variant.name]));
    let unknown = ("_".to_owned(), Doc::from("Self::Unknown(raw)"));
    types::matching(code, seq!["pub const fn from_raw(raw: ", native, ") -> Self"], "raw", arms.chain([unknown]));
    code.doc("Returns the number of the variant.");
    let numbers = all().map(|variant| (seq!["Self::", variant.name], variant.value.to_string()));
    let unknown = (Doc::from("Self::Unknown(raw)"), "raw".to_owned());
    types::matching(code, seq!["pub const fn raw(self) -> ", native], "self", numbers.chain([unknown]));
    code.close("}");
}
