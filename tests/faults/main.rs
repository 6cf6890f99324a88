//! Tests clients on faulty buses in simulated time. No fault may produce a wrong value, and the next request must work.

#[path = "../support/now.rs"]
mod now;

mod boot;
mod can;
#[cfg(all(feature = "ethercat", feature = "macros"))]
mod coe;
#[cfg(all(feature = "ethercat", feature = "macros"))]
#[path = "../../examples/support/ethercat/mod.rs"]
#[allow(dead_code, unused_imports)] // the application of the servo
mod ethercat;
mod faulty;
mod faulty_stream;
mod guarding;
mod heartbeat;
#[path = "../support/lane.rs"]
mod lane;
mod lss;
mod matrix;
mod modbus;
mod modbus_rows;
mod random;
#[cfg(all(feature = "ethercat", feature = "macros"))]
#[path = "../support/segment.rs"]
#[allow(dead_code)] // the segment without faults
mod segment;
mod serial;
mod soak;
mod sync;

#[cfg(all(feature = "ethercat", feature = "macros"))]
lexibus::dictionary! {
    /// The bindings of the demo servo.
    pub mod servo = "examples/support/servo.esi.xml" { table: true, strict: true }
}
