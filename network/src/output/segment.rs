//! The EtherCAT segment as JSON.

use crate::ethercat::Segment;

/// Returns a segment as indented JSON.
pub fn segment_json(segment: &Segment) -> String {
    serde_json::to_string_pretty(segment).unwrap_or_else(|error| format!("\"{error}\"")) + "\n"
}
