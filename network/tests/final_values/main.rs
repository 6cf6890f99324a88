//! The value that an object of a node has after the configuration is that of the last write.

mod heartbeat;
#[path = "../support/mod.rs"]
mod support;
