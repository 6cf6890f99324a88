//! Message protocols: types for requests and replies, the encoding of parameters, and the framing.

mod completion;
mod device;
mod field;
mod framing;
mod outcomes;
mod parameters;
mod protocol;
mod rules;
mod steps;

pub(super) use device::CallModel;
pub(super) use field::Field;
pub(super) use parameters::{Arm, ParametersModel};
pub(super) use protocol::{DataModel, EntryModel, MessageModel, ProtocolModel};
pub(super) use steps::Statements;
