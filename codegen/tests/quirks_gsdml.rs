//! The quirks of real GSDML files, one test each, named by its number; and the diagnostics that no quirk calls for.

#[path = "quirks_gsdml/support.rs"]
mod support;

#[path = "quirks_gsdml/text.rs"]
mod text;

#[path = "quirks_gsdml/structure.rs"]
mod structure;

#[path = "quirks_gsdml/data.rs"]
mod data;

#[path = "quirks_gsdml/records.rs"]
mod records;

#[path = "quirks_gsdml/lists.rs"]
mod lists;

#[path = "quirks_gsdml/rest.rs"]
mod rest;
