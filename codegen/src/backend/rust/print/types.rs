//! Enumerations, bit fields and state machines.

use super::{bit_field, section};
use crate::backend::rust::code::{call, generic, line, open, seq, Code};
use crate::backend::rust::enumeration::EnumerationModel;
use crate::backend::rust::machine::{MachineModel, PatternsModel};
use crate::backend::rust::model::Model;
use crate::backend::rust::reexport::Section;

pub(super) fn write(code: &mut Code, model: &Model) {
    let types = &model.types;
    let heading = match types.has_bit_fields {
        false => "Values that have names.",
        true => "Values and bits that have names.",
    };
    let names_runtime = (!types.is_empty()).then(|| types.names_runtime());
    section::write(code, model, Section::Types, heading, names_runtime, |code| {
        types.enumerations.iter().for_each(|(_, own)| enumeration(code, own));
        types.bit_fields.iter().for_each(|(_, own)| bit_field::write(code, own));
        types.machines.iter().for_each(|own| machine(code, own));
    });
}

pub(in crate::backend::rust) fn enumeration(code: &mut Code, own: &EnumerationModel) {
    let (name, native) = (&own.name, own.native);
    code.docs(&own.docs);
    code.lines(&own.derives);
    open!(code, "pub enum ", name, " {");
    for variant in &own.variants {
        code.doc(&variant.docs);
        line!(code, variant.name, ",");
    }
    if own.complete.is_none() {
        code.doc("Any other number.");
        line!(code, "Unknown(", native, "),");
    }
    code.close("}");
    open!(code, "impl ", name, " {");
    from_raw(code, own);
    code.doc("The number of a value.");
    open!(code, "pub const fn raw(self) -> ", native, " {");
    open!(code, "match self {");
    for variant in &own.variants {
        line!(code, "Self::", variant.name, " => ", variant.value, ",");
    }
    if own.complete.is_none() {
        line!(code, "Self::Unknown(other) => other,");
    }
    code.close("}");
    code.close("}");
    code.close("}");
    open!(code, "impl rt::Enumeration for ", name, " {");
    line!(code, "type Base = ", own.base, ";");
    open!(code, "fn from_native(native: ", native, ") -> Self {");
    line!(code, "Self::from_raw(native)");
    code.close("}");
    open!(code, "fn native(self) -> ", native, " {");
    line!(code, "self.raw()");
    code.close("}");
    code.close("}");
}

fn from_raw(code: &mut Code, own: &EnumerationModel) {
    code.doc(match own.complete {
        Some(_) => "The value of a number; higher bits are ignored.",
        None => "The value of a number.",
    });
    open!(code, "pub const fn from_raw(raw: ", own.native, ") -> Self {");
    match &own.complete {
        Some(mask) => open!(code, "match raw & ", mask, " {"),
        None => open!(code, "match raw {"),
    }
    for (left, variant) in (0..own.variants.len()).rev().zip(&own.variants) {
        let is_rest = left == 0 && own.complete.is_some();
        let pattern = if is_rest { "_" } else { variant.value.as_str() };
        line!(code, pattern, " => Self::", variant.name, ",");
    }
    if own.complete.is_none() {
        line!(code, "other => Self::Unknown(other),");
    }
    code.close("}");
    code.close("}");
}

pub(in crate::backend::rust) fn machine(code: &mut Code, own: &MachineModel) {
    if let Some(own) = &own.states {
        states(code, own);
    }
    if let (Some(states), Some(commands), Some(transitions)) = (&own.states, &own.commands, &own.transitions) {
        let (states, commands) = (&states.name, &commands.name);
        open!(code, "impl ", states, " {");
        line!(code, "const TRANSITIONS: &'static [rt::Transition<", commands, ">] = ", transitions, ";");
        code.doc("What takes the device one step from this state towards `target`.");
        let result = generic!("rt::Step", commands);
        open!(code, call!("pub fn toward", "self", "target: Self"), " -> ", result, " {");
        line!(code, call!("rt::Step::toward", "Self::TRANSITIONS", "self as u8", "target as u8"));
        code.close("}");
        code.close("}");
    }
    if let Some(own) = &own.commands {
        commands(code, own);
    }
}

fn patterns(code: &mut Code, own: &PatternsModel) {
    code.docs(&own.docs);
    code.lines(&own.derives);
    open!(code, "pub enum ", own.name, " {");
    for pattern in &own.patterns {
        code.doc(&pattern.docs);
        line!(code, pattern.name, ",");
    }
    code.close("}");
}

fn states(code: &mut Code, own: &PatternsModel) {
    patterns(code, own);
    open!(code, "impl ", own.name, " {");
    code.doc("The state that these bits tell; `None` where they tell none.");
    open!(code, "pub const fn from_raw(raw: ", own.native, ") -> Option<Self> {");
    for pattern in &own.patterns {
        let masked = if pattern.is_whole { seq![] } else { seq![" & ", pattern.mask] };
        open!(code, "if raw", masked, " == ", pattern.value, " {");
        line!(code, "return Some(Self::", pattern.name, ");");
        code.close("}");
    }
    line!(code, "None");
    code.close("}");
    code.close("}");
    if let Some((bits, method)) = &own.bits {
        open!(code, "impl ", bits, " {");
        code.doc("The state; `None` where the bits tell none.");
        open!(code, call!(seq!["pub const fn ", method], "self"), " -> Option<", own.name, "> {");
        line!(code, own.name, "::from_raw(self.0)");
        code.close("}");
        code.close("}");
    }
}

fn commands(code: &mut Code, own: &PatternsModel) {
    patterns(code, own);
    let arms = |code: &mut Code, function: &str, value: &dyn Fn(usize) -> String| {
        open!(code, "pub const fn ", function, "(self) -> ", own.native, " {");
        open!(code, "match self {");
        for (at, pattern) in own.patterns.iter().enumerate() {
            line!(code, "Self::", pattern.name, " => ", value(at), ",");
        }
        code.close("}");
        code.close("}");
    };
    open!(code, "impl ", own.name, " {");
    code.doc("The bits that the command is made of.");
    arms(code, "mask", &|at| own.patterns[at].mask.clone());
    code.doc("Those of them that are 1.");
    arms(code, "value", &|at| own.patterns[at].value.clone());
    code.close("}");
    if let Some((bits, method)) = &own.bits {
        open!(code, "impl ", bits, " {");
        code.doc("The same with the bits of a command.");
        line!(code, "#[must_use]");
        let command = seq!["command: ", own.name];
        open!(code, call!(seq!["pub const fn ", method], "self", command), " -> Self {");
        line!(code, "Self((self.0 & !command.mask()) | command.value())");
        code.close("}");
        code.close("}");
    }
}
