//! State machines and procedures.

use std::sync::Arc;

use super::{
    Availability, CommandRef, CompactString, Direction, Documentation, Doubts, FactOrigin, ItemRef, MessageRef,
    SharedList, StateRef, Texts, TypeRef, Value,
};
use crate::source::{Origin, Span};

/// A state machine of a device.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct StateMachine {
    /// Name of the state machine.
    pub name: CompactString,
    /// Item that contains the state, or `Message.field` for a field of a reply.
    pub status_item: ItemRef,
    /// Item to which the commands are written.
    pub control_item: ItemRef,
    /// Enumeration of the states, if the source has one.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub state_type: Option<TypeRef>,
    /// States as bit patterns of the status item. If the machine has a `state_type`, the states are the single values of that type
    /// that are neither reserved nor vendor-specific.
    pub states: SharedList<Pattern>,
    /// State after power-on.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub initial: Option<StateRef>,
    /// Fault states that the source lists. The list can omit states that always count as fault states. These are the target of an
    /// automatic transition that starts in any state, and the states that automatically follow this target.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Vec::is_empty"))]
    pub faults: Vec<StateRef>,
    /// Commands as bit patterns of the control item.
    pub commands: SharedList<Pattern>,
    /// Transitions between states.
    pub transitions: SharedList<Transition>,
    /// Effects of commands in each state, if the source has a table of them.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Vec::is_empty"))]
    pub outcomes: Vec<CommandOutcomes>,
    /// Description of the state machine from the source.
    pub documentation: Option<Arc<Documentation>>,
    /// Ambiguities in the source about the state machine and its commands, with the assumptions made.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Doubts::is_empty"))]
    pub doubts: Doubts,
    /// Origin of the state machine; `None` = the description itself.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub stated_by: Option<Box<FactOrigin>>,
}

/// Effects of a command in each state: a row of a table of commands and states.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CommandOutcomes {
    /// Name of the row, as the source spells it.
    pub name: CompactString,
    /// Messages or commands of the row; empty if the source does not describe the command elsewhere. A reference to a message has
    /// an id, and a reference to a command has none.
    pub commands: Vec<MessageRef>,
    /// Models and firmware versions that have the command.
    pub availability: Option<Box<Availability>>,
    /// Effects of the command, with one entry for each column (state) of the matrix.
    pub cells: Vec<StateOutcome>,
    /// Description of the command from the source.
    pub documentation: Option<Arc<Documentation>>,
    /// Location of the command in the source.
    pub origin: Origin,
}

/// Effect of a command in one state.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct StateOutcome {
    /// State in which the device receives the command.
    pub state: StateRef,
    /// Possible outcomes of the command in this state; empty if the source does not state any.
    pub outcomes: Vec<Outcome>,
    /// Conditions and further effects of the command in this state.
    pub documentation: Option<Arc<Documentation>>,
}

/// An outcome of a command in one state.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Outcome {
    /// The device executes the command, and its state does not change.
    Unchanged,
    /// The device rejects the command.
    Refused,
    /// The device changes to the first state of the list, and automatically from each state of the list to the next.
    States(Vec<StateRef>),
}

/// A state or a command as a pattern of bits.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Pattern {
    /// Name of the state or command.
    pub name: CompactString,
    /// Mask of the bits that the pattern includes.
    pub mask: u32,
    /// Value of the masked bits.
    pub value: u32,
    /// Name of the state or command in other languages.
    pub names: Texts,
    /// Description of the state or command from the source.
    pub documentation: Option<Arc<Documentation>>,
}

/// A transition from one state to another.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Transition {
    /// Number of the transition in the source.
    pub number: Option<u16>,
    /// State before the transition; `None` = any state.
    pub from: Option<StateRef>,
    /// State after the transition.
    pub to: StateRef,
    /// Command or message that causes the transition; `None` = the device itself causes it.
    pub command: Option<CommandRef>,
    /// Description of the transition from the source.
    pub documentation: Option<Arc<Documentation>>,
}

/// A procedure: a sequence of steps.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Procedure {
    /// Name of the procedure.
    pub name: CompactString,
    /// Name of the procedure in other languages.
    pub names: Texts,
    /// Names of the arguments. The caller provides their values, and steps write these values.
    pub arguments: Vec<CompactString>,
    /// Steps of the procedure, in order.
    pub steps: Vec<Step>,
    /// Locations of the steps in the source.
    pub step_spans: Vec<Span>,
    /// Description of the procedure from the source.
    pub documentation: Option<Arc<Documentation>>,
    /// Ambiguities in the source about the procedure, with the assumptions made.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Doubts::is_empty"))]
    pub doubts: Doubts,
    /// Location of the procedure in the source.
    pub origin: Origin,
}

impl Procedure {
    /// Returns the steps with their locations in the source. A step without a location has the location of the procedure.
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
    /// Write a value to some bits of an item and keep the other bits: item, mask, value.
    WriteBits(ItemRef, u64, Value),
    /// Write an argument to an item: item, name of the argument.
    WriteArgument(ItemRef, CompactString),
    /// Read an item and return its value to the caller.
    Read(ItemRef),
    /// Wait until the masked bits of an item have a value: item, mask, value, timeout in milliseconds if the source states one.
    WaitFor(ItemRef, u64, Value, Option<u32>),
    /// Wait for a time in milliseconds.
    Delay(u32),
    /// Send a message.
    Send(MessageRef),
    /// Exchange process data once, in this direction.
    Exchange(Direction),
    /// Instruct a person to do something.
    Manual(String),
}

impl Step {
    /// Returns the item that the step writes, reads or waits for.
    pub fn item(&self) -> Option<&ItemRef> {
        match self {
            Step::Write(item, _) | Step::WriteBits(item, ..) | Step::WriteArgument(item, _) => Some(item),
            Step::Read(item) | Step::WaitFor(item, ..) => Some(item),
            Step::Delay(_) | Step::Send(_) | Step::Exchange(_) | Step::Manual(_) => None,
        }
    }
}
