//! Tests for compiled networks of the example's devices.

mod cob_ids;
mod heartbeat;
mod parameters;
mod properties;
#[path = "../dcfgen/random.rs"]
mod random;
mod random_networks;
#[path = "../support/mod.rs"]
mod support;
mod traffic;
