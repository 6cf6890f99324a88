//! Checks of a resolved network.

mod bus_load;
mod cob_ids;
mod heartbeat;
mod partners;
mod restricted;
mod run;
mod sync;
mod sync_producers;

pub use bus_load::{bus_load, frame_bits, BusLoad, Traffic};
pub use run::check;
