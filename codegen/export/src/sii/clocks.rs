//! The category "DC": the modes of operation of the distributed clocks (ETG.2010, table 15).

use lexibus_codegen::ir::ClockMode;

use super::general::fitting;
use super::Context;
use crate::note::{NoteKind, Subject};

/// Returns the content of the category, which is empty for a device without modes of the distributed clocks.
pub(super) fn content(context: &mut Context<'_>) -> Vec<u8> {
    let modes = context.settings.clocks.iter().flat_map(|clocks| &clocks.modes);
    let mut bytes = Vec::new();
    for mode in modes {
        let subject = Subject::Named(&mode.name);
        bytes.extend(mode.cycle_sync0.nanoseconds.to_le_bytes());
        bytes.extend(mode.shift_sync0.nanoseconds.to_le_bytes());
        bytes.extend(mode.shift_sync1.nanoseconds.to_le_bytes());
        bytes.extend(fitting::<i16>(mode.cycle_sync1.factor.unwrap_or(0), &mut context.notes, subject).to_le_bytes());
        bytes.extend(fitting::<u16>(mode.assign_activate, &mut context.notes, subject).to_le_bytes());
        bytes.extend(fitting::<i16>(mode.cycle_sync0.factor.unwrap_or(0), &mut context.notes, subject).to_le_bytes());
        bytes.push(context.texts.number(&mode.name, &mut context.notes));
        bytes.push(context.texts.number(&mode.description, &mut context.notes));
        bytes.extend([0; 4]);
        context.notes.add_many(NoteKind::Setting, unsupported(mode), subject);
    }
    bytes
}

/// Returns how many settings of a mode have no field in the category.
fn unsupported(mode: &ClockMode) -> usize {
    let times = [mode.cycle_sync0, mode.shift_sync0, mode.cycle_sync1, mode.shift_sync1];
    times.iter().filter(|time| time.input).count()
        + usize::from(mode.cycle_sync1.nanoseconds != 0)
        + [mode.shift_sync0, mode.shift_sync1].iter().filter(|time| time.factor.is_some()).count()
        + mode.sync_managers.len()
}
