//! Derives facts from a description. After front ends and overlays have run, only this stage changes the IR.
//!
//! | file | subject |
//! |---|---|
//! | `run` | order of the steps |
//! | `conditions` | signs of the values in conditions |
//! | `references` | ids for the names in references |
//! | `identity` | identity numbers of object 0x1018 |
//! | `implicit_pdos` | objects of PDOs that a device counts but does not describe |
//! | `pdo_mapping` | PDOs from mapping objects |
//! | `pdo_entries`, `mapped_objects` | entries of EtherCAT PDOs, and objects that only these entries describe |
//! | `messages` | layout of the frames of a command protocol; computed on request and not stored in the IR |

mod conditions;
mod identity;
mod implicit_pdos;
mod mapped_objects;
#[cfg(feature = "messages")]
pub(crate) mod messages;
mod pdo_entries;
mod pdo_mapping;
mod references;
mod run;

pub(crate) use identity::IdentityNumber;
pub(crate) use pdo_entries::address;
pub(crate) use pdo_mapping::{
    announced_count, is_dummy, is_multiplexed, mapping_values, MappableItems, MappingValue, MappingWord, PdoObjects,
};
pub use run::resolve;
pub(crate) use run::resolve_references;
