//! The forms that real ESI files have, row by row of the table of quirks: what each is read as, and whether there is a
//! diagnostic.

#[path = "quirks_esi/dictionary.rs"]
mod dictionary;
#[path = "quirks_esi/files.rs"]
mod files;
#[path = "quirks_esi/process_data.rs"]
mod process_data;
#[path = "quirks_esi/rest.rs"]
mod rest;
#[path = "quirks_esi/support.rs"]
mod support;
#[path = "quirks_esi/values.rs"]
mod values;
