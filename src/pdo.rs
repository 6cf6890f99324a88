//! Process data objects: their identifiers, their mapping and the words that carry them (CiA 301 7.2.2).

mod cob_id;
mod mapping;
mod sdo_write;
mod word;

pub use cob_id::CobId;
pub use mapping::{MappedEntry, Pdo};
pub use sdo_write::SdoWrite;
pub use word::{from_bytes, mask, sign_extend, to_bytes};
