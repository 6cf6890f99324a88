//! Tests the dictionaries against the manuals from which they were transcribed.

#[path = "../table_support/cases.rs"]
mod cases;
#[path = "../hsd/codes.rs"]
mod codes;
#[path = "../table_support/doubts.rs"]
mod doubts;
#[path = "../eco_support/mod.rs"]
mod eco_support;
#[path = "../hsd/examples.rs"]
mod examples;
#[path = "../hsd/frames.rs"]
mod frames;
#[path = "../hsd_support/mod.rs"]
mod hsd_support;
#[path = "../table_support/items.rs"]
mod items;
#[path = "../table_support/manual.rs"]
mod manual_text;
#[path = "../hsd/parameters.rs"]
mod parameters;

mod akd;
mod akd_items;
mod dictionaries;
mod eco;
mod eco_codes;
mod eco_items;
mod eco_objects;
mod hsd;
mod hsd_items;
mod manual_items;
mod vector_step;
