//! Layout of the frames of a command protocol: a sequence of steps. At most one step has a variable length, in addition to one
//! list with a count.
//!
//! | file | subject |
//! |---|---|
//! | `frame` | constants and lengths of a frame |
//! | `step`, `shaper` | steps of a request or reply |
//! | `shape` | messages with supported steps |
//! | `parameters` | messages that transfer parameters of a parameter space |

mod frame;
mod parameters;
mod shape;
mod shaper;
mod step;

pub(crate) use frame::{fixed_bits, Frame};
pub(crate) use parameters::{carrier_problems, carriers, numbered, LONGEST};
pub(crate) use shape::{is_reported_elsewhere, problem, refusal, shapes, Problem, Shaped};
pub(crate) use step::{tail, Step};
