//! Compiled networks of the example's devices.

mod heartbeat;
#[path = "../support/mod.rs"]
mod support;
mod traffic;
