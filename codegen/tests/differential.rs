//! Compares the facts that Lexibus reads from corpus files with the facts that independent readers find: Python's `canopen`
//! for EDS and DCF, and lxml's XPath for ESI and GSDML. Each difference must have a reason: a row of the table of quirks, or a
//! known limitation of the independent reader. See `differential/README.md`.

mod corpus_support;
#[path = "differential/eds.rs"]
mod eds;
#[path = "differential/eds_expected.rs"]
mod eds_expected;
#[path = "differential/eds_reasons.rs"]
mod eds_reasons;
#[path = "differential/esi.rs"]
mod esi;
#[path = "differential/esi_objects.rs"]
mod esi_objects;
#[path = "differential/esi_reasons.rs"]
mod esi_reasons;
#[path = "differential/facts.rs"]
mod facts;
#[path = "differential/gsdml.rs"]
mod gsdml;
#[path = "differential/gsdml_data.rs"]
mod gsdml_data;
#[path = "differential/gsdml_reasons.rs"]
mod gsdml_reasons;
#[path = "differential/peer.rs"]
mod peer;
#[path = "differential/tally.rs"]
mod tally;
#[path = "differential/values.rs"]
mod values;
