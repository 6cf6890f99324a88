//! Tests the standard traits of enumerations, bit fields and states.

#![cfg(all(feature = "demo-drive", feature = "vector-step"))]

use std::collections::HashSet;

use lexibus::{BitField, UnknownName};
use lexibus_drives::demo_drive::types::{Command, Controlword, ModesOfOperation, State, Statusword};
use lexibus_drives::vector_step::types::Alarm;

#[test]
fn every_number_of_an_enumeration_is_one_value() {
    let mut seen = HashSet::new();
    for raw in i8::MIN..=i8::MAX {
        let value = ModesOfOperation::from(raw);
        assert_eq!((i8::from(value), value), (raw, ModesOfOperation::Unknown(raw)));
        assert!(seen.insert(value), "{raw}");
        assert!(seen.contains(&ModesOfOperation::Unknown(raw)), "equal values have equal hashes");
        assert_eq!(value.to_string().parse(), Ok(value));
        let is_named = !matches!(value, ModesOfOperation::Unknown(_));
        assert_eq!(ModesOfOperation::ALL.contains(&value), is_named);
        assert_eq!(value.to_string().parse::<i8>().is_err(), is_named);
    }
}

#[test]
fn texts_of_values_are_the_names_of_the_source() {
    assert_eq!(ModesOfOperation::ProfilePosition.to_string(), "profile position");
    assert_eq!(format!("{:>8}|{:<8}|", ModesOfOperation::Homing, ModesOfOperation::Unknown(99)), "  homing|99      |");
    assert_eq!("Profile Position".parse(), Ok(ModesOfOperation::ProfilePosition));
    assert_eq!("6".parse(), Ok(ModesOfOperation::Homing));
    for text in ["", "no such mode", "128", "6 "] {
        assert_eq!(text.parse::<ModesOfOperation>(), Err(UnknownName), "{text:?}");
    }
}

#[test]
fn flags_combine_and_have_names() {
    let (one, other) = (Alarm::from_raw(0b01), Alarm::from_raw(0b10));
    assert_eq!((one | other).raw(), 0b11);
    assert_eq!((one & other).raw(), 0);
    assert_eq!(!!one, one);
    let all = Alarm::new() | !Alarm::new();
    assert_eq!(all.set_flags().count(), all.raw().count_ones() as usize);
    assert_eq!(
        one.set_flags().chain(other.set_flags()).collect::<Vec<_>>(),
        (one | other).set_flags().collect::<Vec<_>>()
    );
    assert_eq!(Alarm::new().set_flags().next(), None);
}

#[test]
fn bit_fields_print_their_raw_bits() {
    let word = Statusword::from_raw(0x1237);
    assert_eq!(format!("{word:x} {word:#06X} {word:b}"), "1237 0x1237 1001000110111");
    let flags: Vec<_> = word.set_flags().collect();
    assert!(flags.contains(&"quick_stop") == word.quick_stop(), "{flags:?}");
}

#[test]
fn states_and_commands_are_read_and_written() {
    for state in [State::SwitchOnDisabled, State::ReadyToSwitchOn, State::OperationEnabled, State::Fault] {
        assert_eq!(Statusword::from_state(state).state(), Some(state));
    }
    for command in
        [Command::Shutdown, Command::SwitchOn, Command::EnableOperation, Command::QuickStop, Command::FaultReset]
    {
        assert_eq!(Controlword::new().with_command(command).command(), Some(command));
    }
    // "Disable operation" and "switch on" have the same bits.
    assert_eq!(Controlword::new().with_command(Command::DisableOperation).command(), Some(Command::SwitchOn));
}
