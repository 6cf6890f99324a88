//! Profiles: facts of standards about all devices, modules and submodules that follow these standards.
//!
//! A profile is a table with `[profile]`, written like an overlay (`dictionaries/README.md`). The compiler contains each profile
//! in a compact form, so that profiles do not need the front end of register tables. Profiles are applied after overlays, and do
//! not change facts of a device or its overlays. Each added fact has the origin [`FactOrigin::Standard`](crate::ir::FactOrigin),
//! so that lints judge only the description.
//!
//! | file | subject |
//! |---|---|
//! | `profile` | data of a profile |
//! | `stored`, `stored/*.txt` | profiles as text, with reader and writer |
//! | `apply` | applies profiles to the devices and modules that follow them |
//! | `complete` | adds the facts of a profile that a description lacks |

mod apply;
mod complete;
mod profile;
mod stored;

#[cfg(test)]
pub(crate) use apply::all;
pub(crate) use apply::apply;
pub use apply::is_device_of_number;
#[cfg(test)]
pub(crate) use complete::Completion;
#[cfg(test)]
pub(crate) use profile::{Described, Profile, Signal, Telegram};
