//! State machines and procedures.

use super::{
    Availability, CompactString, Direction, Documentation, ItemRef, MessageRef, SharedList, Texts, TypeRef, Value,
};
use crate::source::{Origin, Span};

/// A state machine.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct StateMachine {
    /// Its name.
    pub name: CompactString,
    /// The item that tells the state, or `Message.field` where a reply does.
    pub status_item: ItemRef,
    /// The item that commands it.
    pub control_item: ItemRef,
    /// The enumeration whose values are the states, where the source has one.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub state_type: Option<TypeRef>,
    /// States, by the bits of the status item; with a `state_type`, one for each of its values.
    pub states: SharedList<Pattern>,
    /// The state after power-on.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub initial: Option<CompactString>,
    /// Commands, by the bits of the control item.
    pub commands: SharedList<Pattern>,
    /// From which state to which.
    pub transitions: SharedList<Transition>,
    /// What commands do in each state, where the source has a table of that.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Vec::is_empty"))]
    pub outcomes: Vec<CommandOutcomes>,
    /// What the source says about it.
    pub documentation: Option<Box<Documentation>>,
}

/// What a command does in each state: a row of a table of commands and states.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CommandOutcomes {
    /// Its name in that table.
    pub name: CompactString,
    /// The messages, or commands of the machine, that the row is about; none where the source describes it nowhere else.
    pub commands: Vec<CompactString>,
    /// Who has it.
    pub availability: Option<Box<Availability>>,
    /// What it does, state by state.
    pub cells: Vec<StateOutcome>,
    /// What the source says about it.
    pub documentation: Option<Box<Documentation>>,
    /// Where it is declared.
    pub origin: Origin,
}

/// What a command does in one state.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct StateOutcome {
    /// The state in which it comes.
    pub state: CompactString,
    /// What happens, one of these; none where the source says nothing.
    pub outcomes: Vec<Outcome>,
    /// On what it depends, and what happens besides.
    pub documentation: Option<Box<Documentation>>,
}

/// What happens to a command.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Outcome {
    /// It is carried out, and the state stays.
    Unchanged,
    /// The device refuses it.
    Refused,
    /// It leads to the first of these states, which leads by itself to the next.
    States(Vec<CompactString>),
}

/// A state or a command: bits that have to have a value.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Pattern {
    /// Its name.
    pub name: CompactString,
    /// The bits that count.
    pub mask: u32,
    /// The value that they have.
    pub value: u32,
    /// The name in other languages.
    pub names: Texts,
    /// What the source says about it.
    pub documentation: Option<Box<Documentation>>,
}

/// A change from one state to another.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Transition {
    /// Its number in the source.
    pub number: Option<u16>,
    /// The state that it leaves; `None` = any.
    pub from: Option<CompactString>,
    /// The state that it leads to.
    pub to: CompactString,
    /// The command or the message that causes it; `None` where the device does. Only a message has an id.
    pub command: Option<MessageRef>,
    /// What the source says about it.
    pub documentation: Option<Box<Documentation>>,
}

/// A sequence of steps.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Procedure {
    /// Its name.
    pub name: CompactString,
    /// The name in other languages.
    pub names: Texts,
    /// What its caller gives: names that steps write.
    pub arguments: Vec<CompactString>,
    /// Its steps.
    pub steps: Vec<Step>,
    /// Where its steps stand.
    pub step_spans: Vec<Span>,
    /// What the source says about it.
    pub documentation: Option<Box<Documentation>>,
    /// Where it is declared.
    pub origin: Origin,
}

impl Procedure {
    /// The steps, each with its place; without one of its own, that of the procedure.
    pub fn spanned(&self) -> impl Iterator<Item = (&Step, Span)> {
        let span = |at: usize| self.step_spans.get(at).copied().unwrap_or_default().or(self.origin.span);
        self.steps.iter().enumerate().map(move |(at, step)| (step, span(at)))
    }
}

/// A step of a procedure.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Step {
    /// Write a value to an item.
    Write(ItemRef, Value),
    /// Write a value to some bits of an item, and leave the others as they are: item, mask, value.
    WriteBits(ItemRef, u64, Value),
    /// Write to an item what the caller gives: item, name of the argument.
    WriteArgument(ItemRef, CompactString),
    /// Read an item: its value is what the procedure gives.
    Read(ItemRef),
    /// Wait until an item, under a mask, has a value; at most so many milliseconds, where the source says.
    WaitFor(ItemRef, u64, Value, Option<u32>),
    /// Wait so many milliseconds.
    Delay(u32),
    /// Send a message.
    Send(MessageRef),
    /// Exchange process data once in this direction.
    Exchange(Direction),
    /// Something a person has to do.
    Manual(String),
}

impl Step {
    /// The item that it writes, reads or waits for.
    pub fn item(&self) -> Option<&ItemRef> {
        match self {
            Step::Write(item, _) | Step::WriteBits(item, ..) | Step::WriteArgument(item, _) => Some(item),
            Step::Read(item) | Step::WaitFor(item, ..) => Some(item),
            Step::Delay(_) | Step::Send(_) | Step::Exchange(_) | Step::Manual(_) => None,
        }
    }
}
