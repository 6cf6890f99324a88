//! Prints diagnostics and summaries.

mod info;
mod limited;
mod reporter;
mod statistics;

pub(super) use info::{info_text, summary_line};
pub(crate) use reporter::json_line;
pub(super) use reporter::Reporter;
