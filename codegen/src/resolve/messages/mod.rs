//! What the frames of a command protocol consist of: steps of known length one after the other, of which at most one is as long
//! as the data.
//!
//! | file | subject |
//! |---|---|
//! | `frame` | constants and lengths of a frame |
//! | `step`, `shaper` | the steps of a request or reply |
//! | `shape` | the messages that have such steps |
//! | `parameters` | the messages that carry numbered parameters |

mod frame;
mod parameters;
mod shape;
mod shaper;
mod step;

pub(crate) use frame::Frame;
pub(crate) use parameters::{carrier_problems, carriers, numbered, LONGEST};
pub(crate) use shape::{is_told, problem, refusal, shapes, Problem, Shaped};
pub(crate) use step::{tail, Step};
