//! Changes a description as the options ask, and completes it. After the front ends, only this stage changes the IR. `resolve` runs
//! before the checks. The selection of objects is a separate step after the checks.
//!
//! | file | subject |
//! |---|---|
//! | `run` | order of the steps, including the overlays, which the front end for register tables applies |
//! | `selection`, `removal` | removes elements that are not selected, and updates ids |
//! | `conditions` | signs of the values in conditions |
//! | `profiles` | facts of standards about the objects of all devices that follow them |
//! | `references`, `mentions` | ids for the names in references |
//! | `message_fields` | ids of the fields of messages |
//! | `identity` | identity numbers of object 0x1018 |
//! | `implicit_pdos` | objects of PDOs that an EDS or DCF counts but does not describe |
//! | `pdo_mapping` | PDOs from mapping objects |
//! | `pdo_entries`, `mapped_objects` | entries of EtherCAT PDOs, and objects that only these entries describe |
//! | `messages` | layout of the frames of a command protocol; computed on request and not stored in the IR |

mod conditions;
mod identity;
mod implicit_pdos;
mod mapped_objects;
mod mentions;
mod message_fields;
#[cfg(feature = "messages")]
pub(crate) mod messages;
mod pdo_entries;
mod pdo_mapping;
pub(crate) mod profiles;
mod references;
mod removal;
mod run;
mod selection;

pub(crate) use identity::in_object as identity_in_object;
pub(crate) use pdo_entries::address;
pub(crate) use pdo_mapping::{
    announced_count, is_dummy, is_multiplexed, mapping_values, MappableItems, MappingValue, MappingWord, PdoObjects,
};
pub use profiles::is_device_of_number;
pub use run::{resolve, Changes, Profiles};
pub use selection::select_objects;
