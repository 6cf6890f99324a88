//! PROFINET IO: cyclic data with status, parameter records, diagnosis, and slot plans.
//!
//! Bindings that are generated from a GSDML file use this module:
//!
//! - [`Dap`], [`Module`] and [`Submodule`] describe a device as constants.
//! - A [`Plan`] assigns modules to slots. The plan returns the expected configuration and the start-up records.
//! - The inputs, outputs and records of a submodule are generated structs. These structs implement [`IoData`] or
//!   [`RecordData`].
//!
//! All numbers are big-endian. The device sends inputs to the controller. The controller sends outputs to the device.
//!
//! A controller library transfers the bytes. An adapter to this library implements [`RecordClient`] for records and
//! [`ImageClient`] for the process image, or [`AsyncRecordClient`] and [`AsyncImageClient`].
//!
//! - [`RecordAccess`] accesses records as structs, and individual items in records, through a record client.
//!   [`parameter_access`] accesses PROFIdrive parameters through a record client.
//! - [`Cyclic`] accesses items in the cyclic data of a submodule through an image client. [`Plan::layout`] returns the
//!   offsets of the data of all submodules.
//!
//! ```
//! use lexibus::profinet::{Dap, IoLengths, Module, ModuleUse, Places, Plan, PlanError, Submodule, SubmoduleUse};
//!
//! // Generated code for a device with one type of module, which has 4 bytes of inputs and fits into the slots 1 to 3:
//! static COUNTER: Submodule = Submodule {
//!     ident: 0x31,
//!     api: 0,
//!     name: "Counter",
//!     input_len: Some(4),
//!     output_len: None,
//!     provider_len: 1,
//!     consumer_len: 1,
//!     records: &[],
//! };
//! static COUNTER_MODULE: Module = Module {
//!     ident: 0x30,
//!     name: "Counter",
//!     submodules: &[SubmoduleUse::new(&COUNTER, Places::fixed(&[(1, 1)]))],
//!     subslots: &[],
//! };
//! static DEVICE: Submodule = Submodule { ident: 1, name: "Device", input_len: None, ..COUNTER };
//! static DAP: Dap = Dap {
//!     vendor_id: 0x1234,
//!     device_id: 0x0001,
//!     slot: 0,
//!     module: Module {
//!         ident: 0x10,
//!         name: "Device",
//!         submodules: &[SubmoduleUse::new(&DEVICE, Places::fixed(&[(1, 1)]))],
//!         subslots: &[],
//!     },
//!     slots: &[(0, 3)],
//!     modules: &[ModuleUse::new(&COUNTER_MODULE, Places::allowed(&[(1, 3)]))],
//!     max_lengths: IoLengths { input: Some(64), output: Some(64), data: None },
//!     max_record_size: 4068,
//! };
//!
//! let mut plan: Plan<8> = Plan::new(&DAP)?;
//! plan.plug(2, &COUNTER_MODULE)?;
//! assert_eq!(plan.plug(4, &COUNTER_MODULE), Err(PlanError::NoSuchSlot));
//! let places: [(u16, u16, u32); 2] = core::array::from_fn(|at| {
//!     let expected = plan.expected().nth(at).unwrap();
//!     (expected.slot, expected.subslot, expected.module_ident)
//! });
//! assert_eq!(places, [(0, 1, 0x10), (2, 1, 0x30)]);
//! # Ok::<(), PlanError>(())
//! ```

pub mod be;
mod cyclic;
mod descriptor;
mod diagnosis;
mod f_parameters;
mod f_record;
mod image;
mod io;
pub mod parameter_access;
mod plan;
mod record;
mod record_access;
mod record_client;
mod status;

pub use cyclic::Cyclic;
pub use descriptor::{Dap, IoLengths, Module, ModuleUse, Places, Record, Submodule, SubmoduleUse};
pub use diagnosis::{
    ChannelDiagnoses, ChannelDiagnosis, ChannelDirection, ChannelError, ChannelProperties, ChannelSpecifier,
    ExtendedDiagnosis, ExtendedError, Maintenance, UserStructure,
};
pub use f_parameters::{FCrcLength, FParameters, FPassivation, Sil};
pub use f_record::{FField, FLimit, FRecord};
pub use image::{AsyncImageClient, ImageClient, IoSpan, SubmoduleIo};
pub use io::{FTrailer, IoData, IoObject, IoObjectMut, IoStatus, WithStatus};
pub use plan::{Expected, Plan, PlanError, RecordWrite, Records, Replacement};
pub use record::{check, NotAllowed, RecordData, RecordError};
pub use record_access::RecordAccess;
pub use record_client::{AsyncRecordClient, RecordAddress, RecordClient, SubmoduleAddress};
pub use status::PnioStatus;
