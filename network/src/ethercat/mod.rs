//! EtherCAT segments: the section `segment` of a network file, and the configuration of its SubDevices.

mod assignment;
mod clock;
mod declared;
mod frontend;
mod modules;
mod parameters;
mod process_data;
mod resolve;
mod segment;
mod startup;
mod sync_managers;

pub use declared::{DeclaredModule, DeclaredSegment, DeclaredSubDevice};
pub(crate) use frontend::{read, MODULE, SECTION, SUBDEVICE};
pub(crate) use resolve::resolve;
pub(crate) use segment::direction_name;
pub use segment::{
    AssignedPdo, Clock, ClockSignal, ClockSyncManager, Fmmu, Identity, PluggedModule, Segment, StartupCommand,
    SubDevice, SyncManager,
};
