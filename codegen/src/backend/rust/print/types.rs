//! Prints enumerations, bit fields and state machines.

use super::{bit_field, section};
use crate::backend::rust::code::{call, generic, line, list, open, seq, Code, Data, Doc, Piece};
use crate::backend::rust::enumeration::EnumerationModel;
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
    let unknown = enumeration.complete.is_none().then_some(("A number that no other variant represents.", native));
    variants(code, name, enumeration.variants.iter().map(|variant| (&variant.docs, &variant.name)), unknown);
    open!(code, "impl ", name, " {");
    code.doc("All values with names.");
    let all: Vec<Doc> = enumeration.variants.iter().map(|variant| seq!["Self::", variant.name]).collect();
    line!(code, "pub const ALL: [Self; ", all.len().to_string(), "] = ", list("[", &all, "]"), ";");
    from_raw(code, enumeration);
    code.doc("Returns the number of the variant.");
    let numbers = enumeration.variants.iter().map(|variant| (seq!["Self::", variant.name], variant.value.as_str()));
    let unknown = unknown.map(|_| (Doc::from("Self::Unknown(other)"), "other"));
    matching(code, seq!["pub const fn raw(self) -> ", native], "self", numbers.chain(unknown));
    code.close("}");
    open!(code, "impl rt::Enumeration for ", name, " {");
    line!(code, "type Base = ", enumeration.base, ";");
    code.block(seq!["fn from_native(native: ", native, ") -> Self"], "Self::from_raw(native)");
    code.block(seq!["fn native(self) -> ", native], "self.raw()");
    code.close("}");
    conversions(code, enumeration);
    if let Some(gate) = &enumeration.equality {
        equality(code, name, gate, ["self.raw()", "other.raw()"]);
    }
    if let Some(gate) = &enumeration.texts {
        texts(code, enumeration, gate);
    }
}

/// Writes an enum. `all` contains the documentation and the code of each variant. `unknown` contains the documentation
/// and the type of the variant `Unknown`, if the enum has it.
pub(super) fn variants<'v, P: Piece>(
    code: &mut Code,
    name: &str,
    all: impl Iterator<Item = (&'v String, P)>,
    unknown: Option<(&str, &str)>,
) {
    open!(code, "pub enum ", name, " {");
    for (docs, variant) in all {
        code.doc(docs);
        line!(code, variant, ",");
    }
    if let Some((docs, native)) = unknown {
        code.doc(docs);
        line!(code, "Unknown(", native, "),");
    }
    code.close("}");
}

/// Writes a function that matches `subject`. Each of the arms consists of a pattern and an expression.
pub(super) fn matching<P: Piece, E: Piece>(
    code: &mut Code,
    function: impl Piece,
    subject: impl Piece,
    arms: impl Iterator<Item = (P, E)>,
) {
    open!(code, function, " {");
    open!(code, "match ", subject, " {");
    for (pattern, expression) in arms {
        line!(code, pattern, " => ", expression, ",");
    }
    code.close("}");
    code.close("}");
}

/// Writes the conversion to the number and, if the enumeration has the variant `Unknown`, the conversion from any
/// number.
fn conversions(code: &mut Code, enumeration: &EnumerationModel) {
    let (name, native) = (&enumeration.name, enumeration.native);
    let from = |ty: &str| seq!["core::convert::From<", ty, ">"];
    code.implementation(from(name), native, seq!["fn from(value: ", name, ") -> Self"], "value.raw()");
    if enumeration.complete.is_none() {
        code.implementation(from(native), name, seq!["fn from(raw: ", native, ") -> Self"], "Self::from_raw(raw)");
    }
}

/// Writes the implementations of `PartialEq`, `Eq` and `Hash`. `raw` and `other` are the expressions for the numbers of
/// the two compared values.
pub(in crate::backend::rust) fn equality(code: &mut Code, name: &str, gate: &[String], [raw, other]: [&str; 2]) {
    code.lines(gate);
    code.implementation("core::cmp::PartialEq", name, "fn eq(&self, other: &Self) -> bool", seq![raw, " == ", other]);
    code.lines(gate);
    line!(code, "impl core::cmp::Eq for ", name, " {}");
    code.lines(gate);
    let function = "fn hash<H: core::hash::Hasher>(&self, state: &mut H)";
    code.implementation("core::hash::Hash", name, function, seq!["core::hash::Hash::hash(&", raw, ", state);"]);
}

/// Writes the implementations of `Display`, `FromStr` and `rt::Named`. The implementation of `rt::Named` contains the
/// names of the values.
fn texts(code: &mut Code, enumeration: &EnumerationModel, gate: &[String]) {
    let name = &enumeration.name;
    code.lines(gate);
    open!(code, "impl rt::Named for ", name, " {");
    let named = enumeration.variants.iter().map(|variant| (&variant.name, variant.title.clone()));
    line!(code, "const NAMES: &'static [(Self, &'static str)] = ", names(named), ";");
    code.close("}");
    bit_field::format(code, gate, "Display", name, call!("rt::display_name", "*self", "f"));
    from_str(code, gate, name, "rt", call!("rt::parse_name", "text"));
}

/// Returns the list of variants, each with the literal of its name.
fn names<'v>(named: impl Iterator<Item = (&'v String, String)>) -> Doc {
    list("&[", named.map(|(variant, name)| list("(", [seq!["Self::", variant], name.into()], ")")), "]")
}

fn from_str(code: &mut Code, gate: &[String], name: &str, runtime: &str, body: Doc) {
    code.lines(gate);
    open!(code, "impl core::str::FromStr for ", name, " {");
    line!(code, "type Err = ", runtime, "::UnknownName;");
    code.block(seq!["fn from_str(text: &str) -> Result<Self, ", runtime, "::UnknownName>"], body);
    code.close("}");
}

fn from_raw(code: &mut Code, enumeration: &EnumerationModel) {
    code.doc(match enumeration.complete {
        Some(_) => "Returns the variant for this number. Bits beyond the width of the enumeration are ignored.",
        None => "Returns the variant for this number.",
    });
    let mask = enumeration.complete.as_ref().map(|mask| seq![" & ", mask]);
    let unknown = mask.is_none().then(|| ("other", Doc::from("Self::Unknown(other)")));
    let arms = (0..enumeration.variants.len()).rev().zip(&enumeration.variants).map(|(left, variant)| {
        let is_rest = left == 0 && enumeration.complete.is_some();
        (if is_rest { "_" } else { variant.value.as_str() }, seq!["Self::", variant.name])
    });
    let function = seq!["pub const fn from_raw(raw: ", enumeration.native, ") -> Self"];
    matching(code, function, seq!["raw", mask], arms.chain(unknown));
}

pub(in crate::backend::rust) fn machine(code: &mut Code, machine: &MachineModel) {
    if let Some(states) = &machine.states {
        self::states(code, states);
    }
    let both = machine.states.as_ref().zip(machine.commands.as_ref()).filter(|_| machine.has_transitions());
    if let Some((states, commands)) = both {
        open!(code, "impl ", states.name, " {");
        code.doc("Returns the next step from this state toward `target`. The path enters neither a fault state nor an energized state on the way.");
        let function =
            seq![call!("pub fn toward", "self", "target: Self"), " -> ", generic!("rt::Step", commands.name)];
        code.block(function, call!("rt::Step::toward", "self", "target"));
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
        let command = step.command.as_ref().map(|name| seq![commands.name, "::", name]);
        Data::call("rt::Transition::new", vec![state(&step.from), state(&step.to), Data::optional(command)])
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
    // Clippy reports casts to the same type.
    let cast = |from: &str, to: &str| if from == to { String::new() } else { format!(" as {to}") };
    let state = seq!["Self::from_raw(bits", cast("u32", states.native), ")"];
    code.block("fn of_status(bits: u32) -> Option<Self>", state);
    code.block("fn number(self) -> u8", "self as u8");
    code.block("fn name(self) -> &'static str", "Self::NAMES[self as usize].1");
    let cast = cast(commands.native, "u32");
    let pattern = seq!["(command.mask()", cast, ", command.value()", cast, ")"];
    code.block(seq!["fn pattern(command: ", commands.name, ") -> (u32, u32)"], pattern);
    code.close("}");
}

/// Writes the type of states or commands, and the names of its variants. `noun` is `states` or `commands`.
fn patterns(code: &mut Code, patterns: &PatternsModel, noun: &str) {
    let name = &patterns.name;
    code.docs(&patterns.docs);
    code.lines(&patterns.derives);
    variants(code, name, patterns.patterns.iter().map(|pattern| (&pattern.docs, &pattern.name)), None);
    open!(code, "impl ", name, " {");
    code.doc(&format!("All {noun} with their names, in the order of the variants. The names are those of the description, with blanks instead of underscores."));
    let named = patterns.patterns.iter().map(|pattern| (&pattern.name, literal::string(&pattern.title)));
    line!(code, "pub const NAMES: &'static [(Self, &'static str)] = ", names(named), ";");
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
        let function = call!(seq!["pub const fn ", constructor], seq!["state: ", patterns.name]);
        code.block(seq![function, " -> Self"], "Self(state.value())");
        code.close("}");
    }
}

/// Writes the method of a bit field that returns the state or command.
fn getter(code: &mut Code, patterns: &PatternsModel, getter: &str, noun: &str) {
    code.doc(&format!("Returns the {noun}, or `None` if the bits match no {noun}."));
    let function = seq![call!(seq!["pub const fn ", getter], "self"), " -> Option<", patterns.name, ">"];
    code.block(function, seq![patterns.name, "::from_raw(self.0)"]);
}

/// Writes the function that returns the first matching pattern.
fn decoder<'p>(code: &mut Code, model: &PatternsModel, patterns: impl Iterator<Item = &'p PatternModel>) {
    open!(code, "pub const fn from_raw(raw: ", model.native, ") -> Option<Self> {");
    for pattern in patterns {
        let masked = if pattern.is_whole { seq![] } else { seq![" & ", pattern.mask] };
        code.block(seq!["if raw", masked, " == ", pattern.value], seq!["return Some(Self::", pattern.name, ");"]);
    }
    line!(code, "None");
    code.close("}");
}

/// Writes a function that returns a number for each pattern.
fn arms(code: &mut Code, patterns: &PatternsModel, function: &str, number: impl Fn(&PatternModel) -> &String) {
    let arms = patterns.patterns.iter().map(|pattern| (seq!["Self::", pattern.name], number(pattern)));
    matching(code, seq!["pub const fn ", function, "(self) -> ", patterns.native], "self", arms);
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
        let function = call!(seq!["pub const fn ", setter], "self", seq!["command: ", patterns.name]);
        code.block(seq![function, " -> Self"], "Self((self.0 & !command.mask()) | command.value())");
        code.close("}");
    }
}
