//! Faults of byte streams in the table of faults.

use lexibus::sim::{FaultyStream, StreamFault};

/// Applies this fault, or none, to the next message of the device.
pub fn set<S, W>(stream: &mut FaultyStream<S, W>, fault: impl Into<Option<StreamFault>>) {
    stream.clear_faults();
    if let Some(fault) = fault.into() {
        stream.inject_nth(fault, 1);
    }
}
