//! Profiles: what standards say of the objects of every device that follows them.
//!
//! They are tables with `[profile]`, written like overlays (`dictionaries/README.md`). The compiler contains what they state in a
//! shorter form, so that it applies them without the front end of register tables. A profile is applied last, when everything that a
//! device and its overlays say of an object is known: it never changes any of it, and no check needs what it adds.
//!
//! | file | subject |
//! |---|---|
//! | `profile` | a profile as plain data |
//! | `stored`, `stored/*.txt` | the same as text, and how it is written and read |
//! | `apply` | the profiles, and the devices and modules that follow them |
//! | `complete` | adds what a description leaves unsaid |

mod apply;
mod complete;
mod profile;
mod stored;

pub(crate) use apply::apply;
#[cfg(test)]
pub(crate) use complete::Completion;
#[cfg(test)]
pub(crate) use profile::{Described, Profile, Signal, Telegram};
