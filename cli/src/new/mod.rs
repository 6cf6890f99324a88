//! `lexibus new`: creates a register table with example rows, or a drive crate.

mod files;
mod layout;
mod objects;
mod package;
mod profinet;
mod table;
mod text;

use super::args::New;
use super::Failure;

pub(super) fn run(new: &New) -> Result<bool, Failure> {
    match (&new.crate_name, &new.from, &new.name) {
        (Some(name), Some(description), _) => package::run(new, name, description),
        (.., Some(name)) => table::run(new, name),
        // The argument parser requires one of the two forms.
        _ => Err(Failure::Usage("expected the name of a device, or --crate NAME with --from FILE".into())),
    }
}
