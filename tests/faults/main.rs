//! Clients on buses with faults, in simulated time. No fault gives a wrong value, and the next request is right.

#[path = "../support/now.rs"]
mod now;

mod can;
mod matrix;
mod modbus;
mod random;
mod serial;
