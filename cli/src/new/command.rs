//! Selects what `lexibus new` creates: a register table or a drive crate.

use super::{package, table};
use crate::args::New;
use crate::Failure;

pub fn run(new: &New) -> Result<bool, Failure> {
    match (&new.crate_name, &new.from, &new.name) {
        (Some(name), Some(description), _) => package::run(new, name, description),
        (.., Some(name)) => table::run(new, name),
        // The argument parser requires one of the two forms.
        _ => Err(Failure::Usage("expected the name of a device, or --crate NAME with --from FILE".into())),
    }
}
