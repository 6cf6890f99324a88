//! Generated functions for the bits of a word and for enumerations, each paired with a handwritten function.

use lexibus_drives::demo_drive::types::{Controlword, ModesOfOperation, Statusword};

/// Bits of a control word.
mod controlword {
    use super::*;

    pair!(with, frame,
        ours (raw: u16 = u16::from(frame[0])) -> u16 {
            Controlword::from_raw(raw).with_enable_operation(true).with_fault_reset(false).raw()
        }
        hand (raw: u16 = u16::from(frame[0])) -> u16 { raw & !0x80 | 8 }
        same (left, right) left == right);

    pair!(with_field, frame,
        ours (value: (u16, u8) = (0x1234, frame[0])) -> u16 {
            Controlword::from_raw(value.0).with_manufacturer_specific(value.1).raw()
        }
        hand (value: (u16, u8) = (0x1234, frame[0])) -> u16 { value.0 & 0x7FF | u16::from(value.1) << 11 }
        same (left, right) left == right);
}

/// Bits of a status word.
mod statusword {
    use super::*;

    pair!(flags, frame,
        ours (raw: u16 = u16::from(frame[0])) -> bool {
            let word = Statusword::from_raw(raw);
            word.operation_enabled() && !word.fault() && !word.in_profile_position().following_error()
        }
        hand (raw: u16 = u16::from(frame[0])) -> bool { raw & 0x200C == 4 }
        same (left, right) left == right);
}

/// Named values.
mod modes {
    use super::*;

    fn is_cyclic(mode: ModesOfOperation) -> bool {
        matches!(
            mode,
            ModesOfOperation::CyclicSynchronousPosition
                | ModesOfOperation::CyclicSynchronousVelocity
                | ModesOfOperation::CyclicSynchronousTorque
        )
    }

    pair!(matches, frame,
        ours (raw: i8 = frame[0] as i8 & 0xF) -> bool { super::is_cyclic(ModesOfOperation::from_raw(raw)) }
        hand (raw: i8 = frame[0] as i8 & 0xF) -> bool { matches!(raw, 8..=10) }
        same (left, right) left == right);
}

list! {
    controlword: with, with_field;
    statusword: flags;
    modes: matches;
}
