//! State machines: states that a status word encodes, and commands that a controlword encodes.

use crate::collections::HashMap;
use crate::number::hex;

use super::bit_field::BitFieldModel;
use super::context::Context;
use super::doc_table;
use super::docs;
use super::enumeration::EnumerationModel;
use super::links::DocModule;
use super::naming::machines::NamedMachine;
use super::options::RustOptions;
use super::value_type::{self, native, native_bits};
use crate::facts::machine::{fault_states, is_energized};
use crate::facts::pattern;
use crate::ir::stated::is_of_profile;
use crate::ir::{
    CommandId, CommandRef, Documentation, ItemRef, Pattern, Shape, StateMachine, StateRef, Transition, Type, TypeId,
};
use crate::names::{self, Case};

/// A state machine, ready to be printed.
pub(super) struct MachineModel {
    pub states: Option<PatternsModel>,
    pub commands: Option<PatternsModel>,
    /// The transitions that a program can trigger or wait for. The list is empty if the states or the commands are not
    /// bit patterns.
    pub steps: Vec<StepModel>,
    /// Variants of the states that the device enters because of a fault.
    pub faults: Vec<String>,
    /// Variant of the state "Operation enabled" of CiA 402, in which the drive is energized.
    pub energized: Option<String>,
    /// True if a profile states the state machine.
    pub is_of_profile: bool,
}

impl MachineModel {
    fn types(&self) -> impl Iterator<Item = &PatternsModel> {
        self.states.iter().chain(&self.commands)
    }

    /// Returns the names of the state type and the command type.
    pub(super) fn names(&self) -> impl Iterator<Item = &str> {
        self.types().map(|patterns| patterns.name.as_str())
    }

    /// Returns the names of the bit fields to which the machine adds methods.
    pub(super) fn bit_fields(&self) -> impl Iterator<Item = &str> {
        self.types().filter_map(|patterns| Some(patterns.bits.as_ref()?.0.as_str()))
    }

    /// Returns whether the code of the machine uses the import `rt`, regardless of the enabled features.
    pub(super) fn uses_runtime(&self) -> bool {
        self.has_transitions() || self.types().any(|patterns| patterns.texts.as_ref().is_some_and(Vec::is_empty))
    }

    /// Returns whether the machine has transitions that a program can trigger or wait for.
    pub(super) fn has_transitions(&self) -> bool {
        !self.steps.is_empty()
    }
}

/// A transition that a program can trigger or wait for. States and commands are names of variants.
pub(super) struct StepModel {
    pub from: String,
    pub to: String,
    /// `None` if the device itself causes the transition.
    pub command: Option<String>,
}

/// The type of states or commands.
pub(super) struct PatternsModel {
    pub name: String,
    pub docs: Vec<String>,
    pub derives: Vec<String>,
    /// Line with the `cfg` attribute of the implementations of `Display` and `FromStr`, or no line if they are
    /// unconditional. `None` if these implementations are not generated.
    pub texts: Option<Vec<String>>,
    /// Path of the runtime in `FromStr`. If a feature enables `FromStr`, this is the full path, because the import `rt`
    /// could be unused without the feature.
    pub runtime: String,
    /// Primitive integer that holds the bits.
    pub native: &'static str,
    pub patterns: Vec<PatternModel>,
    /// Name of the bit field that contains the bits, and names of its functions that read and write the state or command.
    pub bits: Option<(String, [String; 2])>,
}

impl PatternsModel {
    /// Returns the variant of the state or command at this position in the description.
    fn variant(&self, position: u32) -> Option<&str> {
        let at = self.patterns.binary_search_by_key(&position, |pattern| pattern.position).ok()?;
        self.patterns.get(at).map(|pattern| pattern.name.as_str())
    }

    /// Returns the variant of a state.
    pub(super) fn state(&self, state: &StateRef) -> Option<&str> {
        self.variant(state.id?.0)
    }

    /// Returns the variants, keyed by the positions of the states or commands in the description.
    fn variants(&self) -> HashMap<u32, String> {
        self.patterns.iter().map(|pattern| (pattern.position, pattern.name.clone())).collect()
    }
}

/// A state or command that is a bit pattern.
pub(super) struct PatternModel {
    pub name: String,
    /// Position of the state or command in the description.
    position: u32,
    /// Name of the state or command in the description.
    original: String,
    /// The same name in words, with spaces instead of underscores.
    pub title: String,
    pub docs: String,
    /// Meaning of the state or command, for a table cell.
    meaning: String,
    /// Bit pattern of the state or command, such as `xxxx xxxx x1xx 0000`.
    pub bits: String,
    pub mask: String,
    pub value: String,
    /// True if the mask covers all bits of the integer.
    pub is_whole: bool,
    /// Number of bits that the state or command defines.
    pub defined_bits: u32,
}

pub(super) fn models(
    context: &Context<'_>,
    bit_fields: &[(u32, BitFieldModel)],
    enumerations: &[(u32, EnumerationModel)],
    options: &RustOptions,
) -> Vec<MachineModel> {
    let model = |named: &NamedMachine<'_>| {
        let machine = named.machine;
        let patterns = |name, list, item, methods| patterns(context, name, list, item, methods, bit_fields, options);
        // States that are values of an enumeration already have a Rust type.
        let bit_states = if machine.state_type.is_some() { &[] } else { &*machine.states };
        let mut states = patterns(&named.states, bit_states, &machine.status_item, [&named.getter, &named.constructor]);
        let mut commands = patterns(
            &named.commands,
            &machine.commands,
            &machine.control_item,
            [&named.command_getter, &named.command_setter],
        );
        let faults = states.as_ref().map(|states| faults(machine, states)).unwrap_or_default();
        let both = states.as_ref().zip(commands.as_ref());
        let steps = both.map_or_else(Vec::new, |(states, commands)| steps(machine, states, commands, &faults));
        let named = Named {
            context,
            states: states_of(context, machine, states.as_ref(), enumerations),
            commands: commands.as_ref().map(|commands| (commands.name.clone(), commands.variants())),
        };
        let listed = named.transitions(machine);
        let has_commands = commands.is_some();
        if let Some(commands) = &mut commands {
            commands.docs = documentation(context, machine, "Commands", &machine.control_item, "written to", commands);
            commands.docs.extend(listed.iter().cloned());
        }
        if let Some(states) = &mut states {
            states.docs = documentation(context, machine, "States", &machine.status_item, "read from", states);
            states.docs.extend(listed.into_iter().filter(|_| !has_commands));
        }
        let energized = states.as_ref().and_then(energized);
        let is_of_profile = is_of_profile(machine.stated_by.as_deref());
        MachineModel { states, commands, steps, faults, energized, is_of_profile }
    };
    context.names.types.machines.iter().map(model).collect()
}

/// Returns the documentation of states or commands, including a table of them.
fn documentation(
    context: &Context<'_>,
    machine: &StateMachine,
    noun: &str,
    item: &ItemRef,
    verb: &str,
    patterns: &PatternsModel,
) -> Vec<String> {
    let item = match item.is_empty() {
        true => String::new(),
        false => {
            let item = context.link(item, DocModule::TYPES).unwrap_or_else(|| docs::escape(item));
            format!(", {verb} {item}")
        }
    };
    let mut lines = vec![format!("{noun} of {}{item}.", docs::escape(&machine.name))];
    lines.extend(docs::described(machine.documentation.as_deref(), &context.manual));
    lines.extend(docs::WORDS.defined_by(machine.stated_by.as_deref(), machine.documentation.as_deref()));
    lines.extend(docs::doubts(&machine.doubts, &context.manual));
    let mut lines = docs::paragraphs(lines);
    let row = |pattern: &PatternModel| {
        [format!("[`{0}`](Self::{0})", pattern.name), format!("`{}`", pattern.bits), pattern.meaning.clone()]
    };
    let rows: Vec<[String; 3]> = patterns.patterns.iter().map(row).collect();
    lines.extend(doc_table::table([noun.trim_end_matches('s'), "Bits", "Meaning"], &rows));
    lines
}

/// The name of a type, and its variants keyed by the positions of the states or commands in the description.
pub(super) type Variants = (String, HashMap<u32, String>);

/// Returns the type of a machine's states (a generated type or an enumeration), and its variants. Returns `None` if no
/// such type is generated.
pub(super) fn states_of(
    context: &Context<'_>,
    machine: &StateMachine,
    generated: Option<&PatternsModel>,
    enumerations: &[(u32, EnumerationModel)],
) -> Option<Variants> {
    let Some(state_type) = &machine.state_type else {
        let generated = generated?;
        return Some((generated.name.clone(), generated.variants()));
    };
    let TypeId(id) = state_type.id?;
    let (at, enumeration) = enumerations.iter().find(|(at, _)| *at == id)?;
    let Shape::Enumeration { values, .. } = &context.types.get(*at as usize)?.shape else { return None };
    let variant = |number: i128| {
        let number = value_type::number(number, number > 0);
        enumeration.variants.iter().find(|variant| variant.value == number).map(|variant| variant.name.clone())
    };
    let single = || values.iter().filter(|value| value.last.is_none());
    let value_of = |state: &Pattern| single().find(|value| value.value as u32 & state.mask == state.value);
    let named = (0..).zip(&machine.states).filter_map(|(at, state)| Some((at, variant(value_of(state)?.value)?)));
    Some((enumeration.name.clone(), named.collect()))
}

/// The types of the states and commands that transitions refer to.
struct Named<'n, 's> {
    context: &'n Context<'s>,
    states: Option<Variants>,
    commands: Option<Variants>,
}

impl Named<'_, '_> {
    /// Returns a link to a variant in the module of types. Returns `None` if there is no such variant.
    fn variant(variants: Option<&Variants>, position: u32) -> Option<String> {
        let (ty, variants) = variants?;
        let variant = variants.get(&position)?;
        Some(format!("[`{variant}`]({ty}::{variant})"))
    }

    fn state(&self, state: &StateRef) -> String {
        let variant = state.id.and_then(|id| Named::variant(self.states.as_ref(), id.0));
        variant.unwrap_or_else(|| docs::escape(state))
    }

    /// Returns a link to a command. If the command is a message, the link leads to the message. Returns the name of the
    /// command if there is no such link.
    fn command(&self, command: &CommandRef) -> String {
        let link = command.id.and_then(|id| match id {
            CommandId::Pattern(position) => Named::variant(self.commands.as_ref(), position),
            CommandId::Message(id) => self.context.link_to(id.into(), &command.name, DocModule::TYPES),
        });
        link.unwrap_or_else(|| docs::escape(command))
    }

    /// Returns the lines of a table that lists all transitions, or no lines if there are no transitions.
    fn transitions(&self, machine: &StateMachine) -> Vec<String> {
        let row = |transition: &Transition| {
            let text = Documentation::text_of(transition.documentation.as_deref());
            [
                transition.number.map(|number| number.to_string()).unwrap_or_default(),
                transition.from.as_ref().map_or_else(|| "any state".to_owned(), |name| self.state(name)),
                self.state(&transition.to),
                transition.command.as_ref().map_or_else(|| "automatic".to_owned(), |name| self.command(name)),
                if text.is_empty() { String::new() } else { docs::sentence(&docs::escape(text)) },
            ]
        };
        let rows: Vec<[String; 5]> = machine.transitions.iter().map(row).collect();
        let table = doc_table::whole(["No.", "From", "To", "Command", "Meaning"], &rows);
        if table.is_empty() {
            return table;
        }
        [String::new(), "Transitions:".to_owned()].into_iter().chain(table).collect()
    }
}

/// Returns the transitions that a program can trigger or wait for. Leaves out automatic transitions with which the
/// device reacts to an error: those from any state, and those to a fault state (`faults`) from a state that is not a
/// fault state. Also leaves out transitions if a state or the command has no generated variant.
fn steps(
    machine: &StateMachine,
    states: &PatternsModel,
    commands: &PatternsModel,
    faults: &[String],
) -> Vec<StepModel> {
    let is_fault = |variant: &str| faults.iter().any(|fault| fault == variant);
    let mut steps = Vec::new();
    for transition in machine.transitions.iter() {
        let command = transition.command.as_ref().map(|command| match command.id {
            Some(CommandId::Pattern(position)) => commands.variant(position),
            _ => None,
        });
        // Leave out the transition if its target state or its command has no variant.
        let (Some(to), false) = (states.state(&transition.to), command == Some(None)) else { continue };
        let command = command.flatten();
        let from = match &transition.from {
            Some(from) => states.state(from).into_iter().collect(),
            None if command.is_some() => states.patterns.iter().map(|state| state.name.as_str()).collect(),
            None => Vec::new(),
        };
        let possible = from.into_iter().filter(|from| command.is_some() || !is_fault(to) || is_fault(from));
        steps.extend(possible.map(|from| StepModel {
            from: from.to_owned(),
            to: to.to_owned(),
            command: command.map(str::to_owned),
        }));
    }
    steps
}

/// Returns the variants of the fault states.
fn faults(machine: &StateMachine, states: &PatternsModel) -> Vec<String> {
    fault_states(machine).into_iter().filter_map(|state| states.state(state)).map(str::to_owned).collect()
}

fn energized(states: &PatternsModel) -> Option<String> {
    states.patterns.iter().find(|pattern| is_energized(&pattern.original)).map(|pattern| pattern.name.clone())
}

fn patterns(
    context: &Context<'_>,
    name: &str,
    list: &[Pattern],
    item: &ItemRef,
    methods: [&str; 2],
    bit_fields: &[(u32, BitFieldModel)],
    options: &RustOptions,
) -> Option<PatternsModel> {
    let ty = context.referred(item).map(|item| item.ty);
    let position = ty.and_then(|ty| context.resolve(ty).1).map(|(position, _)| position);
    let bits = bit_fields.iter().find(|(at, _)| Some(*at) == position).map(|(_, model)| model);
    let width = match ty.map(|ty| context.base(ty)) {
        Some(Type::Unsigned(bits @ (8 | 16)) | Type::Integer(bits @ (8 | 16))) => bits.into(),
        Some(_) => 32,
        None => pattern::width(None, list),
    };
    let native = bits.map_or_else(|| native(false, width), |model| model.native);
    // Patterns have at most 32 bits, also in a larger integer.
    let maximum = u64::MAX >> (64 - native_bits(native).min(32));
    let is_possible = |mask: u32, value: u32| mask != 0 && u64::from(mask) <= maximum && value & !mask == 0;
    let list: Vec<(u32, &Pattern)> =
        (0..).zip(list).filter(|(_, pattern)| is_possible(pattern.mask, pattern.value)).collect();
    if list.is_empty() {
        return None;
    }
    let name_requests = names::numbered(list.iter().map(|(_, pattern)| pattern.name.as_str()), "pattern");
    let names = names::unique(name_requests, &["Self"], Case::Pascal);
    let hexadecimal = |number: u32| if number == 0 { "0".to_owned() } else { hex(number) };
    let pattern = |(&(position, definition), name): (&(u32, &Pattern), String)| {
        let (mask, value) = (hexadecimal(definition.mask), hexadecimal(definition.value));
        let plain = definition.name.replace('_', " ");
        let title = docs::escape(&plain);
        let text = Documentation::text_of(definition.documentation.as_deref());
        let text = if text.is_empty() { String::new() } else { format!(" {}", docs::sentence(&docs::escape(text))) };
        let original = definition.name.to_string();
        let meaning = doc_table::meaning(&definition.name, &name, definition.documentation.as_deref());
        let bits = pattern::text(definition.mask, definition.value, u64::BITS - maximum.leading_zeros());
        let docs = format!("{title}: `{bits}`.{text}");
        PatternModel {
            docs,
            meaning,
            name,
            position,
            original,
            title: plain,
            bits,
            mask,
            value,
            is_whole: u64::from(definition.mask) == maximum,
            defined_bits: definition.mask.count_ones(),
        }
    };
    Some(PatternsModel {
        patterns: list.iter().zip(names).map(pattern).collect(),
        name: name.to_owned(),
        docs: Vec::new(),
        derives: options.derives_of_integers(),
        runtime: match options.debug {
            super::Presence::Feature(_) => options.runtime.clone(),
            _ => "rt".to_owned(),
        },
        texts: RustOptions::gate(&options.debug),
        native,
        bits: bits.map(|model| (model.name.clone(), methods.map(str::to_owned))),
    })
}
