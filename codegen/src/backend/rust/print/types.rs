//! Prints enumerations, bit fields and state machines.

use super::{bit_field, section};
use crate::backend::rust::code::{call, generic, line, list, open, seq, Code, Data, Doc};
use crate::backend::rust::enumeration::{EnumerationModel, VariantModel};
use crate::backend::rust::literal;
use crate::backend::rust::machine::{MachineModel, PatternModel, PatternsModel, StepModel};
use crate::backend::rust::model::Model;
use crate::backend::rust::reexport::Section;

pub(in crate::backend::rust) fn write(code: &mut Code, model: &Model) {
    let types = &model.types;
    let heading = match types.has_bit_fields {
        false => "Enumerations of named values.",
        true => "Enumerations of named values, and bit fields with named bits.",
    };
    let names_runtime = (!types.is_empty()).then(|| types.names_runtime());
    section::write(code, model, Section::Types, heading, names_runtime, |code| {
        types.enumerations.iter().for_each(|(_, enumeration)| self::enumeration(code, enumeration));
        types.bit_fields.iter().for_each(|(_, bits)| bit_field::write(code, bits));
        types.machines.iter().for_each(|machine| self::machine(code, machine));
    });
}

pub(in crate::backend::rust) fn enumeration(code: &mut Code, enumeration: &EnumerationModel) {
    let (name, native) = (&enumeration.name, enumeration.native);
    code.docs(&enumeration.docs);
    code.lines(&enumeration.derives);
    open!(code, "pub enum ", name, " {");
    for variant in &enumeration.variants {
        code.doc(&variant.docs);
        line!(code, variant.name, ",");
    }
    if enumeration.complete.is_none() {
        code.doc("A number that no other variant represents.");
        line!(code, "Unknown(", native, "),");
    }
    code.close("}");
    open!(code, "impl ", name, " {");
    code.doc("All values with names.");
    let all: Vec<Doc> = enumeration.variants.iter().map(|variant| seq!["Self::", variant.name]).collect();
    line!(code, "pub const ALL: [Self; ", all.len().to_string(), "] = ", list("[", &all, "]"), ";");
    from_raw(code, enumeration);
    code.doc("Returns the number of the variant.");
    open!(code, "pub const fn raw(self) -> ", native, " {");
    open!(code, "match self {");
    for variant in &enumeration.variants {
        line!(code, "Self::", variant.name, " => ", variant.value, ",");
    }
    if enumeration.complete.is_none() {
        line!(code, "Self::Unknown(other) => other,");
    }
    code.close("}");
    code.close("}");
    code.close("}");
    open!(code, "impl rt::Enumeration for ", name, " {");
    line!(code, "type Base = ", enumeration.base, ";");
    open!(code, "fn from_native(native: ", native, ") -> Self {");
    line!(code, "Self::from_raw(native)");
    code.close("}");
    open!(code, "fn native(self) -> ", native, " {");
    line!(code, "self.raw()");
    code.close("}");
    code.close("}");
    conversions(code, enumeration);
    if let Some(gate) = &enumeration.equality {
        equality(code, name, gate, ["self.raw()", "other.raw()"]);
    }
    if let Some(gate) = &enumeration.texts {
        texts(code, enumeration, gate);
    }
}

/// Writes the conversion to the number and, if the enumeration has the variant `Unknown`, the conversion from any
/// number.
fn conversions(code: &mut Code, enumeration: &EnumerationModel) {
    let (name, native) = (&enumeration.name, enumeration.native);
    open!(code, "impl core::convert::From<", name, "> for ", native, " {");
    open!(code, "fn from(value: ", name, ") -> Self {");
    line!(code, "value.raw()");
    code.close("}");
    code.close("}");
    if enumeration.complete.is_none() {
        open!(code, "impl core::convert::From<", native, "> for ", name, " {");
        open!(code, "fn from(raw: ", native, ") -> Self {");
        line!(code, "Self::from_raw(raw)");
        code.close("}");
        code.close("}");
    }
}

/// Writes the implementations of `PartialEq`, `Eq` and `Hash`. `raw` and `other` are the expressions for the numbers of
/// the two compared values.
pub(in crate::backend::rust) fn equality(code: &mut Code, name: &str, gate: &[String], [raw, other]: [&str; 2]) {
    code.lines(gate);
    open!(code, "impl core::cmp::PartialEq for ", name, " {");
    open!(code, "fn eq(&self, other: &Self) -> bool {");
    line!(code, raw, " == ", other);
    code.close("}");
    code.close("}");
    code.lines(gate);
    line!(code, "impl core::cmp::Eq for ", name, " {}");
    code.lines(gate);
    open!(code, "impl core::hash::Hash for ", name, " {");
    open!(code, "fn hash<H: core::hash::Hasher>(&self, state: &mut H) {");
    line!(code, "core::hash::Hash::hash(&", raw, ", state);");
    code.close("}");
    code.close("}");
}

/// Writes the implementations of `Display`, `FromStr` and `rt::Named`. The implementation of `rt::Named` contains the
/// names of the values.
fn texts(code: &mut Code, enumeration: &EnumerationModel, gate: &[String]) {
    let name = &enumeration.name;
    code.lines(gate);
    open!(code, "impl rt::Named for ", name, " {");
    let named = |variant: &VariantModel| list("(", &[seq!["Self::", variant.name], variant.title.clone().into()], ")");
    let names: Vec<Doc> = enumeration.variants.iter().map(named).collect();
    line!(code, "const NAMES: &'static [(Self, &'static str)] = ", list("&[", &names, "]"), ";");
    code.close("}");
    bit_field::format(code, gate, "Display", name, call!("rt::display_name", "*self", "f"));
    from_str(code, gate, name, "rt", call!("rt::parse_name", "text"));
}

fn from_str(code: &mut Code, gate: &[String], name: &str, runtime: &str, body: Doc) {
    code.lines(gate);
    open!(code, "impl core::str::FromStr for ", name, " {");
    line!(code, "type Err = ", runtime, "::UnknownName;");
    open!(code, "fn from_str(text: &str) -> Result<Self, ", runtime, "::UnknownName> {");
    line!(code, body);
    code.close("}");
    code.close("}");
}

fn from_raw(code: &mut Code, enumeration: &EnumerationModel) {
    code.doc(match enumeration.complete {
        Some(_) => "Returns the variant for this number. Bits beyond the width of the enumeration are ignored.",
        None => "Returns the variant for this number.",
    });
    open!(code, "pub const fn from_raw(raw: ", enumeration.native, ") -> Self {");
    match &enumeration.complete {
        Some(mask) => open!(code, "match raw & ", mask, " {"),
        None => open!(code, "match raw {"),
    }
    for (left, variant) in (0..enumeration.variants.len()).rev().zip(&enumeration.variants) {
        let is_rest = left == 0 && enumeration.complete.is_some();
        let pattern = if is_rest { "_" } else { variant.value.as_str() };
        line!(code, pattern, " => Self::", variant.name, ",");
    }
    if enumeration.complete.is_none() {
        line!(code, "other => Self::Unknown(other),");
    }
    code.close("}");
    code.close("}");
}

pub(in crate::backend::rust) fn machine(code: &mut Code, machine: &MachineModel) {
    if let Some(states) = &machine.states {
        self::states(code, states);
    }
    let both = machine.states.as_ref().zip(machine.commands.as_ref()).filter(|_| machine.has_transitions());
    if let Some((states, commands)) = both {
        open!(code, "impl ", states.name, " {");
        code.doc("Returns the next step from this state toward `target`. The path enters neither a fault state nor an energized state on the way.");
        let result = generic!("rt::Step", commands.name);
        open!(code, call!("pub fn toward", "self", "target: Self"), " -> ", result, " {");
        line!(code, call!("rt::Step::toward", "self", "target"));
        code.close("}");
        code.close("}");
        machine_state(code, machine, states, commands);
    }
    if let Some(commands) = &machine.commands {
        self::commands(code, commands);
    }
}

/// Writes the implementation of the trait with which the runtime leads a machine to a state.
fn machine_state(code: &mut Code, machine: &MachineModel, states: &PatternsModel, commands: &PatternsModel) {
    let state = |name: &str| Doc::from(format!("Self::{name} as u8"));
    let step = |step: &StepModel| {
        let command = step.command.as_ref().map_or_else(
            || Doc::from("None"),
            |name| Data::call("Some", vec![Doc::from(format!("{}::{name}", commands.name))]),
        );
        Data::call("rt::Transition::new", vec![state(&step.from), state(&step.to), command])
    };
    let transitions = Data::slice(machine.steps.iter().map(step));
    open!(code, "impl rt::MachineState for ", states.name, " {");
    line!(code, "type Command = ", commands.name, ";");
    line!(code, "const TRANSITIONS: &'static [rt::Transition<", commands.name, ">] = ", &transitions, ";");
    let faults: Vec<String> = machine.faults.iter().map(|fault| format!("Self::{fault} as u8")).collect();
    line!(code, "const FAULTS: &'static [u8] = ", list("&[", &faults, "]"), ";");
    if let Some(state) = &machine.energized {
        line!(code, "const ENERGIZED: &'static [u8] = &[Self::", state, " as u8];");
    }
    open!(code, "fn of_status(bits: u32) -> Option<Self> {");
    // Clippy reports casts to the same type.
    let cast = |from: &str, to: &str| if from == to { String::new() } else { format!(" as {to}") };
    line!(code, "Self::from_raw(bits", cast("u32", states.native), ")");
    code.close("}");
    open!(code, "fn number(self) -> u8 {");
    line!(code, "self as u8");
    code.close("}");
    open!(code, "fn name(self) -> &'static str {");
    line!(code, "Self::NAMES[self as usize].1");
    code.close("}");
    open!(code, "fn pattern(command: ", commands.name, ") -> (u32, u32) {");
    let cast = cast(commands.native, "u32");
    line!(code, "(command.mask()", cast, ", command.value()", cast, ")");
    code.close("}");
    code.close("}");
}

/// Writes the type of states or commands, and the names of its variants. `noun` is `states` or `commands`.
fn patterns(code: &mut Code, patterns: &PatternsModel, noun: &str) {
    let name = &patterns.name;
    code.docs(&patterns.docs);
    code.lines(&patterns.derives);
    open!(code, "pub enum ", name, " {");
    for pattern in &patterns.patterns {
        code.doc(&pattern.docs);
        line!(code, pattern.name, ",");
    }
    code.close("}");
    open!(code, "impl ", name, " {");
    code.doc(&format!("All {noun} with their names, in the order of the variants. The names are those of the description, with blanks instead of underscores."));
    let named = |pattern: &PatternModel| {
        list("(", &[seq!["Self::", pattern.name], literal::string(&pattern.title).into()], ")")
    };
    let names: Vec<Doc> = patterns.patterns.iter().map(named).collect();
    line!(code, "pub const NAMES: &'static [(Self, &'static str)] = ", list("&[", &names, "]"), ";");
    code.close("}");
    if let Some(gate) = &patterns.texts {
        bit_field::format(code, gate, "Display", name, call!("f.pad", "Self::NAMES[*self as usize].1"));
        let runtime = &patterns.runtime;
        from_str(code, gate, name, runtime, call!(seq![runtime, "::find_name"], "Self::NAMES", "text"));
    }
}

fn states(code: &mut Code, patterns: &PatternsModel) {
    self::patterns(code, patterns, "states");
    open!(code, "impl ", patterns.name, " {");
    code.doc("Returns the state that these bits encode, or `None` if the bits match no state.");
    decoder(code, patterns, patterns.patterns.iter());
    code.doc("Returns the bits that are 1 in the state.");
    arms(code, patterns, "value", |pattern| &pattern.value);
    code.close("}");
    if let Some((bits, [getter, constructor])) = &patterns.bits {
        open!(code, "impl ", bits, " {");
        self::getter(code, patterns, getter, "state");
        code.doc("Returns the bits of a state. All bits on which the state does not depend are 0.");
        let state = seq!["state: ", patterns.name];
        open!(code, call!(seq!["pub const fn ", constructor], state), " -> Self {");
        line!(code, "Self(state.value())");
        code.close("}");
        code.close("}");
    }
}

/// Writes the method of a bit field that returns the state or command.
fn getter(code: &mut Code, patterns: &PatternsModel, getter: &str, noun: &str) {
    code.doc(&format!("Returns the {noun}, or `None` if the bits match no {noun}."));
    open!(code, call!(seq!["pub const fn ", getter], "self"), " -> Option<", patterns.name, "> {");
    line!(code, patterns.name, "::from_raw(self.0)");
    code.close("}");
}

/// Writes the function that returns the first matching pattern.
fn decoder<'p>(code: &mut Code, model: &PatternsModel, patterns: impl Iterator<Item = &'p PatternModel>) {
    open!(code, "pub const fn from_raw(raw: ", model.native, ") -> Option<Self> {");
    for pattern in patterns {
        let masked = if pattern.is_whole { seq![] } else { seq![" & ", pattern.mask] };
        open!(code, "if raw", masked, " == ", pattern.value, " {");
        line!(code, "return Some(Self::", pattern.name, ");");
        code.close("}");
    }
    line!(code, "None");
    code.close("}");
}

/// Writes a function that returns a number for each pattern.
fn arms(code: &mut Code, patterns: &PatternsModel, function: &str, number: impl Fn(&PatternModel) -> &String) {
    open!(code, "pub const fn ", function, "(self) -> ", patterns.native, " {");
    open!(code, "match self {");
    for pattern in &patterns.patterns {
        line!(code, "Self::", pattern.name, " => ", number(pattern), ",");
    }
    code.close("}");
    code.close("}");
}

fn commands(code: &mut Code, patterns: &PatternsModel) {
    self::patterns(code, patterns, "commands");
    open!(code, "impl ", patterns.name, " {");
    code.doc("Returns the command that these bits encode, or `None` if the bits match no command.");
    code.doc("");
    code.doc("If several commands match, the function returns the first of those whose masks have the most bits.");
    let mut by_bits: Vec<&PatternModel> = patterns.patterns.iter().collect();
    by_bits.sort_by_key(|pattern| std::cmp::Reverse(pattern.defined_bits));
    decoder(code, patterns, by_bits.into_iter());
    code.doc("Returns the mask of all bits that the command sets or clears.");
    arms(code, patterns, "mask", |pattern| &pattern.mask);
    code.doc("Returns the bits that the command sets.");
    arms(code, patterns, "value", |pattern| &pattern.value);
    code.close("}");
    if let Some((bits, [getter, setter])) = &patterns.bits {
        open!(code, "impl ", bits, " {");
        self::getter(code, patterns, getter, "command");
        code.doc("Returns a copy that encodes `command`. All bits outside the mask of the command are unchanged.");
        line!(code, "#[must_use]");
        let command = seq!["command: ", patterns.name];
        open!(code, call!(seq!["pub const fn ", setter], "self", command), " -> Self {");
        line!(code, "Self((self.0 & !command.mask()) | command.value())");
        code.close("}");
        code.close("}");
    }
}
