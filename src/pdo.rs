//! Process data objects: COB-IDs, mapping and data (CiA 301 7.2.2).

mod cob_id;
mod configuration;
#[doc(hidden)]
pub mod custom;
mod custom_macro;
mod field;
mod mapping;
mod parameters;
mod sdo_write;
mod word;

#[cfg(any(feature = "canopen", feature = "std"))]
pub(crate) use cob_id::is_restricted;
pub use cob_id::CobId;
#[cfg(feature = "canopen")]
pub(crate) use cob_id::{can_id, is_can_id, EXTENDED};
pub use configuration::PdoConfiguration;
pub use custom::{AnyPdo, Mappable, Mapped, NoCobId, NotMappable, OnEtherCat, Remappable, Rpdo, Tpdo};
pub use field::Field;
pub use mapping::{MappedEntry, Pdo};
pub use parameters::{PdoParameterError, PdoParameters, TransmissionType};
pub(crate) use sdo_write::Hexadecimal;
pub use sdo_write::{SdoWrite, SdoWriteError};
pub use word::{from_bytes, mask, sign_extend, to_bytes};
