//! `lexibus new`: creates a register table with example rows, or a drive crate.

mod command;
mod files;
mod layout;
mod objects;
mod package;
mod profinet;
mod table;
mod text;

pub(super) use command::run;
