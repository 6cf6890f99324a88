//! The forms that real EDS and DCF files have, row by row of the table of quirks: what each is read as, and whether
//! there is a diagnostic. Every vector is read with each line end, with and without a byte order mark, and in UTF-8 and
//! Windows-1252, and what it compiles to passes `rustc` and clippy.

mod compile_support;
#[path = "quirks_eds/numbers.rs"]
mod numbers;
#[path = "quirks_eds/objects.rs"]
mod objects;
#[path = "quirks_eds/rest.rs"]
mod rest;
#[path = "quirks_eds/support.rs"]
mod support;
#[path = "quirks_eds/text.rs"]
mod text;
#[path = "quirks_eds/types.rs"]
mod types;
