//! The category "general" (ETG.2010, table 7).

use super::Context;
use crate::note::{NoteKind, Notes, Subject};

/// Length of the category in bytes.
const LENGTH: usize = 32;

/// Returns the content of the category.
pub(super) fn content(context: &mut Context<'_>) -> Vec<u8> {
    let Context { device, settings, notes, texts, .. } = context;
    let mut bytes = [0; LENGTH];
    let group = texts.number(settings.group.as_ref(), notes);
    bytes[0] = group;
    bytes[2] = texts.number(&device.identity.order_code, notes);
    bytes[3] = texts.number(&device.name, notes);
    if let Some(mailbox) = &settings.mailbox {
        bytes[5] = mailbox.coe.as_ref().map_or(0, |coe| {
            bits(&[true, coe.sdo_info, coe.pdo_assign, coe.pdo_config, coe.pdo_upload, coe.complete_access])
        });
        bytes[6] = mailbox.foe.is_some().into();
        bytes[7] = mailbox.eoe.is_some().into();
    }
    bytes[11] = bits(&[
        settings.safe_op_without_sync,
        settings.without_lrw,
        settings.mailbox.as_ref().is_some_and(|mailbox| mailbox.data_link_layer),
        settings.identification_in_al_status,
        settings.identification_register.is_some(),
    ]);
    let current: i16 = fitting(settings.ebus_current.unwrap_or(0), notes, Subject::Named("EBusCurrent"));
    bytes[12..14].copy_from_slice(&current.to_le_bytes());
    bytes[14] = group;
    bytes[16..18].copy_from_slice(&ports(&settings.physics, notes).to_le_bytes());
    bytes[18..20].copy_from_slice(&settings.identification_register.unwrap_or(0).to_le_bytes());
    bytes.to_vec()
}

/// Returns a byte that contains the flags. The first flag is the lowest bit.
pub(super) fn bits(flags: &[bool]) -> u8 {
    flags.iter().rev().fold(0, |bits, flag| bits << 1 | u8::from(*flag))
}

/// Returns a value that fits into its field, or 0 and a note if it does not fit.
pub(super) fn fitting<T: Default>(value: impl TryInto<T>, notes: &mut Notes, subject: Subject<'_>) -> T {
    value.try_into().unwrap_or_else(|_| {
        notes.add(NoteKind::Value, subject);
        T::default()
    })
}

/// Returns the physical layers of the ports, four bits for each port.
fn ports(physics: &str, notes: &mut Notes) -> u16 {
    let mut all = 0;
    for (port, letter) in physics.chars().enumerate() {
        let layer = match letter {
            'Y' => 1,
            'K' => 3,
            'H' => 4,
            ' ' => 0,
            _ => {
                notes.add(NoteKind::Spelling, Subject::Named("Physics"));
                0
            }
        };
        match port {
            0..4 => all |= layer << (4 * port),
            _ => notes.add_many(NoteKind::Spelling, layer != 0, Subject::Named("Physics")),
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers() {
        let mut notes = Notes::default();
        assert_eq!([ports("YKY", &mut notes), ports("K HY", &mut notes)], [0x0131, 0x1403]);
        let current = |milliamperes: i32, notes: &mut Notes| fitting::<i16>(milliamperes, notes, Subject::Device);
        assert_eq!(current(-2000, &mut notes), -2000);
        assert_eq!(bits(&[true, false, true]), 5);
        assert!(notes.finish().is_empty());
        let mut notes = Notes::default();
        assert_eq!((ports("YYYYY?", &mut notes), current(40_000, &mut notes)), (0x1111, 0));
        assert_eq!(notes.finish().iter().map(|note| note.count).collect::<Vec<_>>(), [1, 2]);
    }
}
