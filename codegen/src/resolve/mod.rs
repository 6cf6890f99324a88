//! The only stage that changes the IR after front ends and overlays: it computes what follows from a description.
//!
//! | file | subject |
//! |---|---|
//! | `run` | the order of the steps |
//! | `conditions` | signs of the values in conditions |
//! | `references` | names of items to ids |
//! | `identity` | identity numbers of object 0x1018 |
//! | `implicit_pdos` | objects of PDOs that a device only announces |
//! | `pdo_mapping` | PDOs of mapping objects |
//! | `pdo_entries`, `mapped_objects` | entries of EtherCAT's PDOs; objects that nothing but an entry describes |
//! | `messages` | what the frames of a command protocol consist of; computed on request, not kept in the IR |

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
