//! Tests the constants for the effects of commands in each state.

use lexibus::message::Outcome;
use lexibus_drives::hsd::messages::*;
use lexibus_drives::hsd::types::State;

#[test]
fn commands_in_each_state() {
    assert_eq!(CmdJogN::OUTCOMES.of(State::Stopped), [Outcome::States(&[State::Jogging])]);
    assert_eq!(CmdJogN::OUTCOMES.accepts(State::Alarm), Some(false));
    // The manual's cell for this command lists a sequence of states. The motor stays in the last state.
    assert_eq!(
        CmdAzz::OUTCOMES.of(State::Stopped),
        [Outcome::Refused, Outcome::States(&[State::Homing, State::Stopping, State::Stopped])]
    );
    assert_eq!(CmdAzz::OUTCOMES.accepts(State::Stopped), None);
    // The cell for CmdNoReg in the state of electrical homing is empty in the manual.
    assert!(CmdNoReg::OUTCOMES.of(State::ElectricalHoming).is_empty());
    assert_eq!(CmdChgPar::OUTCOMES.accepts(State::Released), Some(true));
}

#[test]
fn two_commands_of_one_row() {
    for state in [State::Released, State::Alarm, State::Stopped, State::Jogging] {
        assert_eq!(CmdReg::OUTCOMES.of(state), CmdRegWait::OUTCOMES.of(state));
    }
    assert_eq!(CmdReg::OUTCOMES.of(State::Released), [Outcome::States(&[State::ElectricalHoming, State::Stopped])]);
}
