//! State machines: the states that a status tells, and the commands that a control word gives.

use std::collections::HashMap;

use super::bit_field::BitFieldModel;
use super::code::{Data, Doc};
use super::context::Context;
use super::doc_table;
use super::docs;
use super::enumeration::EnumerationModel;
use super::links::Here;
use super::naming::machines::NamedMachine;
use super::options::RustOptions;
use super::value_type;
use crate::facts::pattern;
use crate::ir::{ItemRef, MessageRef, Pattern, Shape, StateMachine, SubjectKind, Transition, Type, TypeId};
use crate::names::{self, Case};

/// A state machine, ready to be written.
pub(super) struct MachineModel {
    pub states: Option<PatternsModel>,
    pub commands: Option<PatternsModel>,
    /// Transitions between states by commands, where there are any.
    pub transitions: Option<Doc>,
}

impl MachineModel {
    fn types(&self) -> impl Iterator<Item = &PatternsModel> {
        self.states.iter().chain(&self.commands)
    }

    /// The types of states and of commands.
    pub(super) fn names(&self) -> impl Iterator<Item = &str> {
        self.types().map(|own| own.name.as_str())
    }

    /// The bit fields that it adds methods to.
    pub(super) fn bit_fields(&self) -> impl Iterator<Item = &str> {
        self.types().filter_map(|own| Some(own.bits.as_ref()?.0.as_str()))
    }

    /// Whether there is a list of transitions.
    pub(super) fn has_transitions(&self) -> bool {
        self.states.is_some() && self.commands.is_some() && self.transitions.is_some()
    }
}

/// States or commands.
pub(super) struct PatternsModel {
    pub name: String,
    pub docs: Vec<String>,
    pub derives: Vec<String>,
    /// The type of the numbers that have the bits.
    pub native: &'static str,
    pub patterns: Vec<PatternModel>,
    /// The bit field that has the bits, and its method.
    pub bits: Option<(String, String)>,
}

impl PatternsModel {
    /// The variants by their names in the source.
    pub(super) fn by_name(&self) -> HashMap<String, String> {
        self.patterns.iter().map(|own| (own.original.clone(), own.name.clone())).collect()
    }
}

/// A state or a command.
pub(super) struct PatternModel {
    pub name: String,
    /// Its name in the source.
    original: String,
    pub docs: String,
    /// What it is, in a cell.
    meaning: String,
    /// `xxxx xxxx x1xx 0000`.
    pub bits: String,
    pub mask: String,
    pub value: String,
    /// Whether the bits are all those of the number.
    pub is_whole: bool,
}

pub(super) fn models(
    context: &Context<'_>,
    bit_fields: &[(u32, BitFieldModel)],
    enumerations: &[(u32, EnumerationModel)],
    options: &RustOptions,
) -> Vec<MachineModel> {
    let model = |named: &NamedMachine<'_>| {
        let machine = named.machine;
        let patterns = |name, list, item, method| patterns(context, name, list, (item, method), bit_fields, options);
        // The values of an enumeration have a type already.
        let own_states = if machine.state_type.is_some() { &[] } else { &*machine.states };
        let mut states = patterns(&named.states, own_states, &machine.status_item, &named.getter);
        let mut commands = patterns(&named.commands, &machine.commands, &machine.control_item, &named.command_setter);
        let transitions = states
            .as_ref()
            .zip(commands.as_ref())
            .and_then(|(states, commands)| steps(&machine.transitions, states, commands));
        let named = Named {
            context,
            states: states_of(context, machine, states.as_ref(), enumerations),
            commands: commands.as_ref().map(|own| (own.name.clone(), own.by_name())),
        };
        let listed = named.transitions(machine);
        let has_commands = commands.is_some();
        if let Some(own) = &mut commands {
            own.docs = documentation(context, machine, ("Commands", &machine.control_item, "takes"), own);
            own.docs.extend(listed.iter().cloned());
        }
        if let Some(own) = &mut states {
            own.docs = documentation(context, machine, ("States", &machine.status_item, "tells"), own);
            own.docs.extend(listed.into_iter().filter(|_| !has_commands));
        }
        MachineModel { states, commands, transitions }
    };
    context.names.types.machines.iter().map(model).collect()
}

/// The lines about states or commands, and their table.
fn documentation(
    context: &Context<'_>,
    machine: &StateMachine,
    (what, item, does): (&str, &ItemRef, &str),
    own: &PatternsModel,
) -> Vec<String> {
    let item = match item.is_empty() {
        true => String::new(),
        false => {
            let item = context.link(item, Here::TYPES).unwrap_or_else(|| docs::escape(item));
            format!(", as {item} {does} them")
        }
    };
    let mut lines = vec![format!("{what} of {}{item}.", docs::escape(&machine.name))];
    docs::described(machine.documentation.as_deref(), &context.manual, &mut lines);
    docs::doubts_about(context, SubjectKind::Machine, &machine.name, &mut lines);
    let row =
        |own: &PatternModel| [format!("[`{0}`](Self::{0})", own.name), format!("`{}`", own.bits), own.meaning.clone()];
    let rows: Vec<[String; 3]> = own.patterns.iter().map(row).collect();
    lines.extend(doc_table::table([what.trim_end_matches('s'), "Bits", "Meaning"], &rows));
    lines
}

/// The name of a type, and its variants by the names that the source has for them.
pub(super) type Variants = (String, HashMap<String, String>);

/// The type of a machine's states: its own one, or an enumeration.
pub(super) fn states_of(
    context: &Context<'_>,
    machine: &StateMachine,
    own: Option<&PatternsModel>,
    enumerations: &[(u32, EnumerationModel)],
) -> Option<Variants> {
    let Some(state_type) = &machine.state_type else {
        let own = own?;
        return Some((own.name.clone(), own.by_name()));
    };
    let TypeId(id) = state_type.id?;
    let (at, own) = enumerations.iter().find(|(at, _)| *at == id)?;
    let Shape::Enumeration { values, .. } = &context.types.get(*at as usize)?.shape else { return None };
    let variant = |number: i128| {
        let number = value_type::number(number, number > 0);
        own.variants.iter().find(|variant| variant.value == number).map(|variant| variant.name.clone())
    };
    let named = values.iter().filter_map(|value| Some((value.name.to_string(), variant(value.value)?)));
    Some((own.name.clone(), named.collect()))
}

/// What transitions name.
struct Named<'n, 's> {
    context: &'n Context<'s>,
    states: Option<Variants>,
    commands: Option<Variants>,
}

impl Named<'_, '_> {
    /// A link to a variant, among the types; the name alone where there is none.
    fn variant(own: Option<&Variants>, name: &str) -> Option<String> {
        let (ty, variants) = own?;
        let variant = variants.get(name)?;
        Some(format!("[`{variant}`]({ty}::{variant})"))
    }

    fn state(&self, name: &str) -> String {
        Named::variant(self.states.as_ref(), name).unwrap_or_else(|| docs::escape(name))
    }

    /// A command, or the message that is one.
    fn command(&self, name: &MessageRef) -> String {
        let message = || self.context.link(name, Here::TYPES);
        Named::variant(self.commands.as_ref(), name).or_else(message).unwrap_or_else(|| docs::escape(name))
    }

    /// The lines of the table of all transitions.
    fn transitions(&self, machine: &StateMachine) -> Vec<String> {
        let row = |own: &Transition| {
            let text = own.documentation.as_ref().map_or("", |own| own.text.as_str());
            [
                own.number.map(|number| number.to_string()).unwrap_or_default(),
                own.from.as_ref().map_or_else(|| "any state".to_owned(), |name| self.state(name)),
                self.state(&own.to),
                own.command.as_ref().map_or_else(|| "itself".to_owned(), |name| self.command(name)),
                if text.is_empty() { String::new() } else { docs::sentence(&docs::escape(text)) },
            ]
        };
        let rows: Vec<[String; 5]> = machine.transitions.iter().map(row).collect();
        let table = doc_table::whole(["No.", "From", "To", "By", "Meaning"], &rows);
        if table.is_empty() {
            return table;
        }
        [String::new(), "Transitions:".to_owned()].into_iter().chain(table).collect()
    }
}

/// The transitions that a controller can take, or wait for. One that leaves any state by itself is a fault, and no way to go.
fn steps(transitions: &[Transition], states: &PatternsModel, commands: &PatternsModel) -> Option<Doc> {
    let named = |list: &PatternsModel, name: &str| {
        list.patterns.iter().find(|own| own.original == name).map(|own| own.name.clone())
    };
    let mut steps = Vec::new();
    for own in transitions {
        let command = own.command.as_ref().map(|name| named(commands, name));
        let command = match command {
            None => Doc::from("None"),
            Some(Some(name)) => Data::call("Some", vec![Doc::from(format!("{}::{name}", commands.name))]),
            // A message, or a command without bits.
            Some(None) => continue,
        };
        let from = match (&own.from, &own.command) {
            (Some(from), _) => named(states, from).into_iter().collect(),
            (None, Some(_)) => states.patterns.iter().map(|own| own.name.clone()).collect(),
            (None, None) => Vec::new(),
        };
        let Some(to) = named(states, &own.to) else { continue };
        let state = |name: &str| Doc::from(format!("Self::{name} as u8"));
        for from in from {
            steps.push(Data::call("rt::Transition::new", vec![state(&from), state(&to), command.clone()]));
        }
    }
    (!steps.is_empty()).then_some(Data::slice(steps))
}

fn patterns(
    context: &Context<'_>,
    name: &str,
    list: &[Pattern],
    (item, method): (&ItemRef, &str),
    bit_fields: &[(u32, BitFieldModel)],
    options: &RustOptions,
) -> Option<PatternsModel> {
    let ty = context.referred(item).map(|item| item.ty);
    let position = ty.and_then(|ty| context.resolve(ty).1).map(|(position, _)| position);
    let bits = bit_fields.iter().find(|(own, _)| Some(*own) == position).map(|(_, own)| own);
    let native = match (bits, ty.map(|ty| context.base(ty))) {
        (Some(own), _) => own.native,
        (None, Some(Type::Unsigned(8) | Type::Integer(8))) => "u8",
        (None, Some(Type::Unsigned(16) | Type::Integer(16))) => "u16",
        (None, Some(_)) => "u32",
        (None, None) => match pattern::width(None, list) {
            8 => "u8",
            16 => "u16",
            _ => "u32",
        },
    };
    let most: u64 = match native {
        "u8" => u8::MAX.into(),
        "u16" => u16::MAX.into(),
        _ => u32::MAX.into(),
    };
    let is_possible = |mask: u32, value: u32| mask != 0 && u64::from(mask) <= most && value & !mask == 0;
    let list: Vec<&Pattern> = list.iter().filter(|own| is_possible(own.mask, own.value)).collect();
    if list.is_empty() {
        return None;
    }
    let wishes = names::numbered(list.iter().map(|own| own.name.as_str()), "pattern");
    let names = names::unique(&wishes, &["Self"], Case::Pascal);
    let hexadecimal =
        |number: u32| if number == 0 { "0".to_owned() } else { format!("{number:#X}").replacen("0X", "0x", 1) };
    let pattern = |(own, name): (&&Pattern, String)| {
        let (mask, value) = (hexadecimal(own.mask), hexadecimal(own.value));
        let title = docs::escape(&own.name.replace('_', " "));
        let text = own.documentation.as_ref().map_or("", |own| own.text.as_str());
        let text = if text.is_empty() { String::new() } else { format!(" {}", docs::sentence(&docs::escape(text))) };
        let original = own.name.to_string();
        let meaning = doc_table::meaning(&own.name, &name, own.documentation.as_deref());
        let bits = pattern::text(own.mask, own.value, u64::BITS - most.leading_zeros());
        let docs = format!("{title}: `{bits}`.{text}");
        PatternModel { docs, meaning, name, original, bits, mask, value, is_whole: u64::from(own.mask) == most }
    };
    Some(PatternsModel {
        patterns: list.iter().zip(names).map(pattern).collect(),
        name: name.to_owned(),
        docs: Vec::new(),
        derives: options.derives(true),
        native,
        bits: bits.map(|own| (own.name.clone(), method.to_owned())),
    })
}
