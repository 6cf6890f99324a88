//! Tests clients on faulty buses in simulated time. No fault may produce a wrong value, and the next request must work.

#[path = "../support/now.rs"]
mod now;

mod can;
mod matrix;
mod modbus;
mod random;
mod serial;
