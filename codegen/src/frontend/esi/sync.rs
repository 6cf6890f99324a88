//! Reads FMMUs, sync managers and sync units.

use super::reader::Reader;
use crate::diagnostics::codes;
use crate::frontend::xml::{Given, Read};
use crate::ir::{Direction, EtherCatSettings, Fmmu, Pdo, SyncManager, SyncManagerPurpose, SyncUnit};
use crate::syntax::xml::Tag;
use crate::text::brief;

/// Reads an `Fmmu` element.
pub(super) fn fmmu<'a>(reader: &mut Reader<'a, '_>, tag: &Tag<'a>, settings: &mut EtherCatSettings) -> Read<()> {
    let [op_only, sm, su] = reader.attributes(tag, ["OpOnly", "Sm", "Su"])?;
    let fmmu = Fmmu {
        op_only: reader.flag(&op_only),
        sync_manager: reader.int(&sm, "sync manager number"),
        sync_unit: reader.int(&su, "sync unit number"),
        purpose: reader.content()?.compact(),
    };
    settings.fmmus.push(fmmu);
    Ok(())
}

/// Reads an `Su` element, which describes a sync unit.
pub(super) fn sync_unit<'a>(reader: &mut Reader<'a, '_>, tag: &Tag<'a>, settings: &mut EtherCatSettings) -> Read<()> {
    const NAMES: [&str; 4] = ["SeparateSu", "SeparateFrame", "DependOnInputState", "FrameRepeatSupport"];
    let [separate, frame, state, repeat] = reader.attributes(tag, NAMES)?;
    let unit = SyncUnit {
        separate: reader.flag(&separate),
        separate_frame: reader.flag(&frame),
        depends_on_input_state: reader.flag(&state),
        frame_repeat: reader.flag(&repeat),
        name: reader.content()?.compact(),
    };
    settings.sync_units.push(unit);
    Ok(())
}

/// Reads an `Sm` element. [`settle`] determines the purpose after all sync managers are read.
pub(super) fn sync_manager<'a>(
    reader: &mut Reader<'a, '_>,
    tag: &Tag<'a>,
    list: &mut Vec<(SyncManager, Given<'a>)>,
) -> Read<()> {
    const NAMES: [&str; 8] =
        ["MinSize", "MaxSize", "DefaultSize", "StartAddress", "ControlByte", "Enable", "OpOnly", "Virtual"];
    let origin = reader.origin(tag);
    let fields = reader.attributes(tag, NAMES)?;
    let [min, max, size, start, control, enable, op_only, is_virtual] = &fields;
    let given = reader.content()?;
    let number = u8::try_from(list.len()).unwrap_or(u8::MAX);
    if list.len() > usize::from(number) {
        reader.report(&codes::ESI_VALUE, tag.span, "the device has more than 256 sync managers", "left out");
        return Ok(());
    }
    // The bits of Enable are those of the SII (ETG.2010, table 11): bit 0 = enabled, bit 2 = virtual, bit 3 = enabled only in Op.
    let enable = reader.int::<u32>(enable, "value of the enable register").unwrap_or(0);
    let manager = SyncManager {
        number,
        purpose: SyncManagerPurpose::Inputs,
        label: given.compact(),
        start_address: reader.int(start, "address").unwrap_or(0),
        default_size: reader.int(size, "size in bytes"),
        size_range: (reader.int(min, "size in bytes"), reader.int(max, "size in bytes")),
        control: reader.int(control, "control byte").unwrap_or(0),
        enable: enable & 1 != 0,
        op_only: reader.flag(op_only) || enable & 8 != 0,
        is_virtual: reader.flag(is_virtual) || enable & 4 != 0,
        origin,
    };
    list.push((manager, given));
    Ok(())
}

/// Determines the purpose of each sync manager from its text, otherwise from the PDOs that name it, otherwise from its
/// control byte or position.
pub(super) fn settle(
    reader: &mut Reader<'_, '_>,
    list: Vec<(SyncManager, Given<'_>)>,
    pdos: &[Pdo],
) -> Vec<SyncManager> {
    use SyncManagerPurpose::{Inputs, MailboxIn, MailboxOut, Outputs};
    // A device with a mailbox has at least four sync managers. The first two sync managers are for the mailbox.
    let has_mailbox = list.len() >= 4;
    let mut managers = Vec::with_capacity(list.len());
    for (position, (mut manager, given)) in list.into_iter().enumerate() {
        // In the control register, bits 0 and 1 are the mode (2 = mailbox). Bits 2 and 3 of this register are the
        // direction (1 = written by the master).
        let (is_mailbox, is_written) = match manager.control {
            0 => (has_mailbox && position < 2, position == 0 || (has_mailbox && position == 2)),
            control => (control & 0b11 == 2, control & 0b1100 == 0b0100),
        };
        let by_position = match (is_mailbox, is_written) {
            (true, true) => MailboxOut,
            (true, false) => MailboxIn,
            (false, true) => Outputs,
            (false, false) => Inputs,
        };
        let by_text = by_text(&given.text);
        let by_pdos = by_pdos(manager.number, pdos);
        manager.purpose = by_text.or(by_pdos).unwrap_or(by_position);
        if by_text.is_none() {
            let message = match given.text.as_ref() {
                "" => "this sync manager does not state its purpose".to_owned(),
                text => format!("`{}` is not a valid purpose of a sync manager", brief(text)),
            };
            let reason = if by_pdos.is_some() {
                "because of the PDOs that name it"
            } else {
                "because of its control byte or position"
            };
            let label = format!("read as {} {reason}", manager.purpose.label());
            let span = given.span.or(manager.origin.span);
            reader.report(&codes::SYNC_MANAGER_PURPOSE, span, message, label);
        }
        managers.push(manager);
    }
    managers
}

/// Returns the purpose of a sync manager according to its PDOs, if all of them have the same direction.
fn by_pdos(number: u8, pdos: &[Pdo]) -> Option<SyncManagerPurpose> {
    let mut directions = pdos.iter().filter(|pdo| pdo.sync_manager == Some(number)).map(|pdo| pdo.direction);
    let first = directions.next()?;
    let purpose = match first {
        Direction::Receive => SyncManagerPurpose::Outputs,
        Direction::Transmit => SyncManagerPurpose::Inputs,
    };
    directions.all(|direction| direction == first).then_some(purpose)
}

fn by_text(text: &str) -> Option<SyncManagerPurpose> {
    const NAMES: [SyncManagerPurpose; 4] = [
        SyncManagerPurpose::MailboxOut,
        SyncManagerPurpose::MailboxIn,
        SyncManagerPurpose::Outputs,
        SyncManagerPurpose::Inputs,
    ];
    NAMES.into_iter().find(|purpose| purpose.label().eq_ignore_ascii_case(text))
}
