//! Tests the operations of CiA 402 with simulated drives: mode, homing, profile position, velocities and cyclic modes.

#![cfg(feature = "std")]

use std::time::Duration;

use lexibus::cia402::{self, CycleError, Cyclic, Inputs, Mode, MotionError, ReadInteger, State, Target, WriteInteger};
use lexibus::sim::{Connection, Device, Fault};
use lexibus::table::Entry;
use lexibus::{
    AbortCode, AsyncClient, CanOpen, Client, CoE, DataType, Error, Item, MachineState, Object, OnCanOpen, Ro, Rw,
};
use lexibus_drives::{demo_drive, eco, vector_step};

#[path = "support/entry.rs"]
mod entry;
use entry::entry;

const DEADLINE: Duration = Duration::from_secs(2);
const ENABLED: u16 = 0x0237;

const fn ms(time: u64) -> Duration {
    Duration::from_millis(time)
}

/// Returns the reason for a failed access.
#[track_caller]
fn reason<T: std::fmt::Debug, E: std::fmt::Debug>(result: Result<T, MotionError<E>>) -> Error<E> {
    match result {
        Err(MotionError::Access(error)) => error.error,
        other => panic!("no failed access: {other:?}"),
    }
}

/// The objects of the drive in most tests.
struct Full;

const CONTROLWORD: Item<u16, Rw, OnCanOpen> = Item::object(0x6040, 0, "");
const STATUSWORD: Item<u16, Ro, OnCanOpen> = Item::object(0x6041, 0, "");
const MODE: Item<i8, Rw, OnCanOpen> = Item::object(0x6060, 0, "");
const ACTIVE_MODE: Item<i8, Ro, OnCanOpen> = Item::object(0x6061, 0, "");
const POSITION: Item<i32, Ro, OnCanOpen> = Item::object(0x6064, 0, "");
const ERROR_CODE: Item<u16, Ro, OnCanOpen> = Item::object(0x603F, 0, "");
const FOLLOWING_ERROR: Item<i32, Ro, OnCanOpen> = Item::object(0x60F4, 0, "");
const TARGET_POSITION: Item<i32, Rw, OnCanOpen> = Item::object(0x607A, 0, "");
const TARGET_VELOCITY: Item<i32, Rw, OnCanOpen> = Item::object(0x60FF, 0, "");
const QUICK_STOP_OPTION: Item<i16, Rw, OnCanOpen> = Item::object(0x605A, 0, "");
const HOMING_METHOD: Item<i8, Rw, OnCanOpen> = Item::object(0x6098, 0, "");

impl cia402::Objects<CanOpen> for Full {
    fn controlword() -> impl ReadInteger<CanOpen> + WriteInteger<CanOpen> {
        CONTROLWORD
    }
    fn statusword() -> impl ReadInteger<CanOpen> {
        STATUSWORD
    }
    fn modes_of_operation() -> impl WriteInteger<CanOpen> {
        MODE
    }
    fn modes_of_operation_display() -> impl ReadInteger<CanOpen> {
        ACTIVE_MODE
    }
    fn error_code() -> impl ReadInteger<CanOpen> {
        ERROR_CODE
    }
    fn following_error() -> impl ReadInteger<CanOpen> {
        FOLLOWING_ERROR
    }
}

impl cia402::Positioning<CanOpen> for Full {
    fn target_position() -> impl WriteInteger<CanOpen> {
        TARGET_POSITION
    }
}

impl cia402::Velocity<CanOpen> for Full {
    fn target_velocity() -> impl WriteInteger<CanOpen> {
        TARGET_VELOCITY
    }
}

impl cia402::Homing<CanOpen> for Full {
    fn homing_method() -> impl WriteInteger<CanOpen> {
        HOMING_METHOD
    }
}

const ENTRIES: [Entry; 18] = [
    entry(0x603F, DataType::Unsigned16),
    entry(0x6040, DataType::Unsigned16),
    entry(0x6041, DataType::Unsigned16),
    entry(0x605A, DataType::Integer16),
    entry(0x6060, DataType::Integer8),
    entry(0x6061, DataType::Integer8),
    entry(0x6064, DataType::Integer32),
    entry(0x6065, DataType::Unsigned32),
    entry(0x606C, DataType::Integer32),
    entry(0x607A, DataType::Integer32),
    entry(0x607C, DataType::Integer32),
    entry(0x607F, DataType::Unsigned32),
    entry(0x6081, DataType::Unsigned32),
    entry(0x6083, DataType::Unsigned32),
    entry(0x6098, DataType::Integer8),
    entry(0x60F4, DataType::Integer32),
    entry(0x60FF, DataType::Integer32),
    entry(0x6502, DataType::Unsigned32),
];

/// An action on the drive during a test.
type Event = Box<dyn FnMut(&mut Rig)>;

/// A client of a drive. Events can happen while the driver waits, and statuswords can differ from those of the drive.
struct Rig {
    drive: Connection<CanOpen>,
    /// Simulated time in milliseconds.
    time: u64,
    /// Events with their times, in order.
    events: Vec<(u64, Event)>,
    /// Bits of the statusword that are always 1, and bits that are always 0.
    set: u16,
    cleared: u16,
    /// Number of upcoming reads of the statusword that will fail.
    broken: u32,
    /// Controlword that the drive returns instead of the written one.
    shown: Option<u16>,
    has_clock: bool,
    /// All written values.
    writes: Vec<(u16, i32)>,
    /// Number of reads of the controlword.
    control_reads: usize,
}

impl Rig {
    /// Creates a drive that is enabled in this mode.
    fn enabled(mode: i8) -> Self {
        let device = Device::new(&ENTRIES).with_cia402();
        let mut rig = Self {
            drive: device.into_client(),
            time: 0,
            events: Vec::new(),
            set: 0,
            cleared: 0,
            broken: 0,
            shown: None,
            has_clock: true,
            writes: Vec::new(),
            control_reads: 0,
        };
        rig.write(0x6060, &mode.to_le_bytes());
        rig.write(0x6081, &1000_u32.to_le_bytes());
        rig.write(0x6083, &10_000_u32.to_le_bytes());
        for control in [6, 7, 0x0F_u16] {
            rig.drive.device().step(ms(2));
            rig.write(0x6040, &control.to_le_bytes());
        }
        rig.drive.device().step(ms(2));
        assert_eq!(rig.drive.device().get(STATUSWORD).map(State::from_raw), Ok(Some(State::OperationEnabled)));
        assert_eq!(rig.drive.device().get(ACTIVE_MODE), Ok(mode));
        rig.writes.clear();
        rig
    }

    fn at(mut self, time: u64, event: impl FnMut(&mut Rig) + 'static) -> Self {
        self.events.push((time, Box::new(event)));
        self
    }

    fn write(&mut self, index: u16, data: &[u8]) {
        Client::write(self, Object::new(index, 0), data).unwrap();
    }

    fn motion(&mut self) -> cia402::Drive<'_, Self, Full> {
        cia402::Drive::new(self)
    }

    /// Returns the values that were written to the controlword.
    fn controls(&self) -> Vec<i32> {
        self.writes.iter().filter(|(index, _)| *index == 0x6040).map(|(_, value)| *value).collect()
    }

    fn control(&mut self) -> u16 {
        self.drive.device().get(CONTROLWORD).unwrap()
    }

    fn position(&mut self) -> i32 {
        self.drive.device().get(POSITION).unwrap()
    }

    fn fail(&mut self, code: u16) {
        self.drive.device().fail(code).unwrap();
    }
}

impl Client for Rig {
    type Bus = CanOpen;
    type Error = Fault;

    fn read(&mut self, object: Object, buffer: &mut [u8]) -> Result<usize, Error<Fault>> {
        if object.index == 0x6041 && self.broken > 0 {
            self.broken -= 1;
            return Err(Error::Timeout);
        }
        self.control_reads += usize::from(object.index == 0x6040);
        let length = Client::read(&mut self.drive, object, buffer)?;
        if let (0x6040, Some(control)) = (object.index, self.shown) {
            buffer.copy_from_slice(&control.to_le_bytes());
        }
        if let (0x6041, [low, high]) = (object.index, buffer) {
            let status = u16::from_le_bytes([*low, *high]) & !self.cleared | self.set;
            [*low, *high] = status.to_le_bytes();
        }
        Ok(length)
    }

    fn write(&mut self, object: Object, data: &[u8]) -> Result<(), Error<Fault>> {
        let number = data.iter().rev().fold(0, |number, byte| number << 8 | i32::from(*byte));
        self.writes.push((object.index, number));
        Client::write(&mut self.drive, object, data)
    }

    fn wait(&mut self, time: Duration) -> Result<(), Error<Fault>> {
        if !self.has_clock {
            return Err(Error::NoClock);
        }
        self.time += time.as_millis() as u64;
        while self.events.first().is_some_and(|(at, _)| *at <= self.time) {
            let (_, mut event) = self.events.remove(0);
            event(self);
        }
        Client::wait(&mut self.drive, time)
    }
}

impl AsyncClient for Rig {
    type Bus = CanOpen;
    type Error = Fault;

    async fn read(&mut self, object: Object, buffer: &mut [u8]) -> Result<usize, Error<Fault>> {
        Client::read(self, object, buffer)
    }

    async fn write(&mut self, object: Object, data: &[u8]) -> Result<(), Error<Fault>> {
        Client::write(self, object, data)
    }

    async fn wait(&mut self, time: Duration) -> Result<(), Error<Fault>> {
        Client::wait(self, time)
    }
}

#[test]
fn modes() {
    let mut rig = Rig::enabled(1);
    assert_eq!(rig.motion().set_mode(Mode::ProfileVelocity, DEADLINE), Ok(()));
    assert_eq!(rig.motion().mode(), Ok(Mode::ProfileVelocity));
    assert_eq!(rig.motion().set_mode(6_i8, DEADLINE), Ok(()));
    assert_eq!(rig.writes, [(0x6060, 3), (0x6060, 6)]);
    // The drive doesn't activate the mode.
    let refused = MotionError::ModeNotConfirmed { requested: Mode::Unknown(-5), active: Mode::Homing };
    assert_eq!(rig.motion().set_mode(-5_i8, ms(50)), Err(refused));
    assert_eq!(rig.time, 60);
    // The drive refuses the access.
    rig.drive.device().on_write(MODE, |_, _| Err(AbortCode::DEVICE_STATE)).unwrap();
    let refused = rig.motion().set_mode(Mode::ProfilePosition, DEADLINE);
    assert_eq!(reason(refused), Error::Abort(AbortCode::DEVICE_STATE));
}

#[test]
fn a_new_mode_starts_nothing() {
    // Bit 4 is "new set-point" in mode 1, and "homing operation start" in mode 6.
    let mut rig = Rig::enabled(1);
    rig.write(0x6040, &0x887F_u16.to_le_bytes());
    rig.motion().set_mode(Mode::Homing, DEADLINE).unwrap();
    assert_eq!(rig.control(), 0x880F);
    // Bit 4 is also cleared if the drive is not enabled yet, so that the drive starts nothing when it is enabled later.
    rig.write(0x6040, &0x0017_u16.to_le_bytes());
    rig.drive.device().step(ms(2));
    rig.writes.clear();
    assert_eq!(rig.motion().set_mode(Mode::ProfilePosition, DEADLINE), Ok(()));
    assert_eq!(rig.writes, [(0x6040, 7), (0x6060, 1)]);
    // "Enable operation" isn't written to a drive that isn't enabled.
    rig.shown = Some(0x1F);
    rig.writes.clear();
    assert_eq!(rig.motion().set_mode(Mode::Homing, DEADLINE), Ok(()));
    assert_eq!(rig.writes, [(0x6060, 6)]);
}

#[test]
fn homing() {
    let mut rig = Rig::enabled(1);
    rig.write(0x607C, &[10, 0, 0, 0]);
    rig.write(0x6040, &0x080F_u16.to_le_bytes());
    rig.writes.clear();
    assert_eq!(rig.motion().home(DEADLINE), Ok(()));
    assert_eq!(rig.writes, [(0x6060, 6), (0x6040, 0x081F), (0x6040, 0x080F)]);
    assert_eq!(rig.position(), 10);
    // The bit "homing attained" of the first procedure must not be taken as the result of the second one.
    let begin = rig.time;
    assert_eq!(rig.motion().home_with(35, DEADLINE), Ok(()));
    assert!((100..=110).contains(&(rig.time - begin)), "{}", rig.time);
    assert_eq!(rig.drive.device().get(HOMING_METHOD), Ok(35));
    // A homing method outside the range of its type is not sent.
    let refused = rig.motion().home_with(200, DEADLINE);
    assert!(matches!(reason(refused), Error::OutOfRange(_)));
}

#[test]
fn a_start_bit_that_is_already_set() {
    let mut rig = Rig::enabled(6);
    // Mode 6 is active, and the start bit (bit 4) is still 1 after a completed procedure.
    rig.write(0x6040, &0x001F_u16.to_le_bytes());
    rig.drive.device().step(ms(200));
    rig.writes.clear();
    assert_eq!(rig.motion().home(DEADLINE), Ok(()));
    assert_eq!(rig.controls(), [0x0F, 0x1F, 0x0F]);
}

#[test]
fn results_of_an_earlier_homing_procedure() {
    // The drive needs 40 ms to clear the bits of an earlier procedure.
    let late = |rig: &mut Rig| rig.set = 0;
    let mut rig = Rig::enabled(6).at(40, late);
    rig.set = 1 << 12 | 1 << 10;
    assert_eq!(rig.motion().home(DEADLINE), Ok(()));
    assert!(rig.time > 100, "{}", rig.time);
    // The error bit of an earlier procedure must not be taken as the result either.
    let mut rig = Rig::enabled(6).at(40, late);
    rig.set = 1 << 13;
    assert_eq!(rig.motion().home(DEADLINE), Ok(()));
    // If the bits do not change in time, they are taken as the result of the new procedure.
    let mut rig = Rig::enabled(6);
    rig.set = 1 << 13;
    assert_eq!(rig.motion().home(DEADLINE), Err(MotionError::Homing));
    assert!((90..=110).contains(&rig.time), "{}", rig.time);
}

#[test]
fn homing_that_fails() {
    // The simulated drive reports an error for the reserved method 36.
    let mut rig = Rig::enabled(1);
    assert_eq!(rig.motion().home_with(36, DEADLINE), Err(MotionError::Homing));
    assert_eq!(rig.control(), 0x0F, "the start bit is cleared");

    let mut rig = Rig::enabled(1);
    assert!(matches!(rig.motion().home(ms(50)), Err(MotionError::Deadline { status: ENABLED })));
    assert_eq!(rig.control(), 0x0F, "the drive aborts homing");
    rig.drive.device().step(DEADLINE);
    assert_eq!(rig.drive.device().get(STATUSWORD), Ok(ENABLED | 1 << 10));

    // Homing without "target reached" isn't complete.
    let mut rig = Rig::enabled(1);
    rig.cleared = 1 << 10;
    assert!(matches!(rig.motion().home(ms(300)), Err(MotionError::Deadline { status: 0x1237 })));

    let mut rig = Rig::enabled(1);
    rig.write(0x6502, &[1, 0, 0, 0]);
    let refused = MotionError::ModeNotConfirmed { requested: Mode::Homing, active: Mode::ProfilePosition };
    assert_eq!(rig.motion().home(ms(50)), Err(refused));
}

#[test]
fn a_fault_during_homing() {
    let mut rig = Rig::enabled(6).at(50, |rig| rig.fail(0x7305));
    let fault = MotionError::Fault { state: State::Fault, code: Some(0x7305) };
    assert_eq!(rig.motion().home(DEADLINE), Err(fault));
    // Bit 4 is cleared, so that a drive that is enabled again doesn't continue homing.
    assert_eq!(rig.controls(), [0x1F, 0x0F]);
}

#[test]
fn the_start_bit_after_an_error_of_the_bus() {
    let mut rig = Rig::enabled(6).at(50, |rig| rig.broken = 1);
    assert_eq!(reason(rig.motion().home(DEADLINE)), Error::Timeout);
    assert_eq!(rig.controls(), [0x1F, 0x0F]);
    let mut rig = Rig::enabled(1).at(20, |rig| rig.broken = 1);
    rig.cleared = 1 << 12;
    assert_eq!(reason(rig.motion().move_to(Target::absolute(5), DEADLINE)), Error::Timeout);
    assert_eq!(rig.controls(), [0x1F, 0x0F]);
}

#[test]
fn a_client_that_cannot_wait_starts_nothing() {
    for mode in [1, 6] {
        let mut rig = Rig::enabled(mode);
        rig.has_clock = false;
        let moved =
            if mode == 1 { rig.motion().move_to(Target::absolute(5), DEADLINE) } else { rig.motion().home(DEADLINE) };
        assert_eq!(moved, Err(MotionError::Wait(Error::NoClock)));
        assert_eq!(rig.controls(), [0; 0]);
    }
}

#[test]
fn a_drive_that_another_source_commands() {
    let mut rig = Rig::enabled(6);
    rig.shown = Some(0);
    assert_eq!(rig.motion().home(DEADLINE), Err(MotionError::OtherSource { control: 0 }));
    assert_eq!(rig.writes, []);
}

#[test]
fn a_halt_during_the_wait_for_a_free_place() {
    let mut rig = Rig::enabled(1).at(20, |rig| {
        rig.set = 0;
        rig.write(0x6040, &[0x0F, 0x01]);
    });
    rig.set = 1 << 12;
    assert_eq!(rig.motion().move_to(Target::absolute(5), DEADLINE), Err(MotionError::Halted));
    assert_eq!(rig.controls(), [0x10F]);
}

#[test]
fn moves() {
    let mut rig = Rig::enabled(1);
    rig.write(0x6040, &0x084F_u16.to_le_bytes());
    rig.writes.clear();
    assert_eq!(rig.motion().move_to(Target::absolute(500), DEADLINE), Ok(()));
    assert_eq!(rig.writes, [(0x607A, 500), (0x6040, 0x081F), (0x6040, 0x080F)]);
    assert!(rig.position() < 100, "the method doesn't wait for the end of the move");
    assert_eq!(rig.motion().wait_reached(DEADLINE), Ok(()));
    assert_eq!(rig.position(), 500);
    assert_eq!(rig.motion().move_to(Target::relative(-20), DEADLINE), Ok(()));
    assert_eq!(rig.motion().wait_reached(DEADLINE), Ok(()));
    assert_eq!((rig.position(), rig.control()), (480, 0x084F));
}

#[test]
fn set_points_wait_or_replace() {
    let mut rig = Rig::enabled(1);
    rig.motion().move_to(Target::absolute(300), DEADLINE).unwrap();
    // During a move, the drive can store one further set-point. It accepts another set-point only when the move ends.
    let begin = rig.time;
    rig.motion().move_to(Target::absolute(200), DEADLINE).unwrap();
    assert_eq!(rig.time, begin + 5, "the pause before the edge of the start bit");
    rig.motion().move_to(Target::absolute(100), DEADLINE).unwrap();
    assert!((350..=450).contains(&(rig.time - begin)), "{}", rig.time);
    rig.motion().wait_reached(DEADLINE).unwrap();
    assert_eq!(rig.position(), 100);
    // A set-point that replaces all others is sent even if another set-point is waiting. Its start bit stays 1 for 100 ms, because
    // bit 12 is already 1 and therefore doesn't acknowledge the edge.
    rig.motion().move_to(Target::absolute(5000), DEADLINE).unwrap();
    rig.motion().move_to(Target::absolute(6000), DEADLINE).unwrap();
    let begin = rig.time;
    rig.motion().move_to(Target::absolute(0).immediately(), DEADLINE).unwrap();
    assert!(rig.time - begin <= 215, "{}", rig.time - begin);
    rig.motion().wait_reached(DEADLINE).unwrap();
    assert_eq!(rig.position(), 0);
}

#[test]
fn set_points_that_the_drive_does_not_acknowledge() {
    let mut rig = Rig::enabled(1);
    rig.cleared = 1 << 12;
    assert!(matches!(rig.motion().move_to(Target::absolute(500), ms(50)), Err(MotionError::Deadline { .. })));
    assert_eq!(rig.controls(), [0x1F, 0x0F], "the bit is cleared");
    // If the drive cannot store another set-point, no set-point is sent.
    let mut rig = Rig::enabled(1);
    rig.set = 1 << 12;
    assert!(matches!(rig.motion().move_to(Target::absolute(500), ms(50)), Err(MotionError::Deadline { .. })));
    assert_eq!(rig.writes, []);
    // The move takes longer than the deadline.
    let mut rig = Rig::enabled(1);
    rig.motion().move_to(Target::absolute(500), DEADLINE).unwrap();
    assert_eq!(rig.motion().wait_reached(ms(100)), Err(MotionError::Deadline { status: ENABLED }));
}

#[test]
fn following_errors_of_a_move() {
    let mut rig = Rig::enabled(1).at(100, |rig| rig.set = 1 << 13);
    rig.motion().move_to(Target::absolute(500), DEADLINE).unwrap();
    assert_eq!(rig.motion().wait_reached(DEADLINE), Err(MotionError::FollowingError { error: Some(0) }));
    // No set-point is sent to a drive with a following error.
    rig.writes.clear();
    let refused = rig.motion().move_to(Target::absolute(7), DEADLINE);
    assert_eq!((refused, rig.writes.as_slice()), (Err(MotionError::FollowingError { error: Some(0) }), [].as_slice()));
    // After a following error during the handshake, the start bit is cleared.
    let mut rig = Rig::enabled(1).at(20, |rig| rig.set = 1 << 13);
    rig.cleared = 1 << 12;
    let failed = rig.motion().move_to(Target::absolute(500), DEADLINE);
    assert_eq!((failed, rig.control()), (Err(MotionError::FollowingError { error: Some(0) }), 0x0F));
}

#[test]
fn states_of_all_statuswords() {
    // The patterns of CiA 402-2 10.3.2: mask, value and state.
    let patterns = [
        (0x4F, 0x00, State::NotReadyToSwitchOn),
        (0x4F, 0x40, State::SwitchOnDisabled),
        (0x6F, 0x21, State::ReadyToSwitchOn),
        (0x6F, 0x23, State::SwitchedOn),
        (0x6F, 0x27, State::OperationEnabled),
        (0x6F, 0x07, State::QuickStopActive),
        (0x4F, 0x0F, State::FaultReactionActive),
        (0x4F, 0x08, State::Fault),
    ];
    for status in 0..=u16::MAX {
        let expected = patterns.iter().find(|(mask, value, _)| status & mask == *value).map(|(.., state)| *state);
        assert_eq!(State::from_raw(status), expected, "0x{status:04X}");
    }
}

#[test]
fn every_number_is_a_mode() {
    for number in i8::MIN..=i8::MAX {
        assert_eq!(Mode::from_raw(number).raw(), number);
    }
    assert_eq!((Mode::from_raw(6), Mode::from_raw(-3)), (Mode::Homing, Mode::Unknown(-3)));
}

#[test]
fn a_fault_during_a_move() {
    let mut rig = Rig::enabled(1).at(200, |rig| rig.fail(0x8611));
    rig.motion().move_to(Target::absolute(10_000), DEADLINE).unwrap();
    let failed = rig.motion().wait_reached(DEADLINE);
    let MotionError::Fault { state, code } = failed.unwrap_err() else { panic!("{failed:?}") };
    assert!(state.is_fault());
    assert_eq!(code, Some(0x8611));
    // No operation resets the fault.
    rig.drive.device().step(ms(100));
    rig.writes.clear();
    let fault = Err(MotionError::Fault { state: State::Fault, code: Some(0x8611) });
    assert_eq!(rig.motion().move_to(Target::absolute(0), DEADLINE), fault);
    assert_eq!(rig.motion().home(DEADLINE), fault);
    assert_eq!(rig.motion().set_velocity(1), fault);
    assert_eq!(rig.writes, []);
}

#[test]
fn operations_never_enable_a_drive() {
    for (control, state) in [(0x02, State::SwitchOnDisabled), (0x06, State::ReadyToSwitchOn), (0x07, State::SwitchedOn)]
    {
        let mut rig = Rig::enabled(1);
        rig.write(0x6040, &[control, 0]);
        rig.drive.device().step(ms(100));
        rig.writes.clear();
        let refused = |result| matches!(result, Err(MotionError::NotEnabled { state: Some(s), .. }) if s == state);
        assert!(refused(rig.motion().move_to(Target::absolute(1), DEADLINE)));
        assert!(refused(rig.motion().wait_reached(DEADLINE)));
        assert!(refused(rig.motion().home(DEADLINE)));
        assert!(refused(rig.motion().home_with(1, DEADLINE)));
        assert!(refused(rig.motion().set_velocity(1)));
        assert_eq!(rig.writes, []);
    }
    // After a local quick stop, the controlword still contains "enable operation". The driver must not write it again, because this
    // would enable the drive.
    let mut rig = Rig::enabled(6).at(20, |rig| {
        (rig.set, rig.cleared) = (0, 1 << 5);
    });
    let stopped = MotionError::NotEnabled { state: Some(State::QuickStopActive), status: 0x0217 };
    assert_eq!(rig.motion().home(DEADLINE), Err(stopped));
    assert_eq!(rig.controls(), [0x1F]);
}

#[test]
fn velocities() {
    let mut rig = Rig::enabled(3);
    assert_eq!(rig.motion().set_velocity(-700), Ok(()));
    assert_eq!(rig.motion().wait_reached(DEADLINE), Ok(()));
    assert_eq!(rig.drive.device().get(VELOCITY), Ok(-700));
    assert_eq!(rig.writes, [(0x60FF, -700)]);
    rig.set = 1 << 13;
    assert_eq!(rig.motion().wait_reached(DEADLINE), Err(MotionError::Slippage));
    let mut rig = Rig::enabled(9);
    assert_eq!(rig.motion().set_velocity(5), Ok(()));
    // In the cyclic modes, bit 10 doesn't mean "target reached".
    let wrong = Err(MotionError::WrongMode { active: Mode::CyclicSynchronousVelocity });
    assert_eq!(rig.motion().wait_reached(DEADLINE), wrong);
}

const VELOCITY: Item<i32, Ro, OnCanOpen> = Item::object(0x606C, 0, "");

/// Returns a drive that moves at 700 units per second and needs 70 ms to stop.
fn moving() -> Rig {
    let mut rig = Rig::enabled(3);
    rig.motion().set_velocity(700).unwrap();
    rig.motion().wait_reached(DEADLINE).unwrap();
    rig.writes.clear();
    rig.time = 0;
    rig
}

#[test]
fn a_quick_stop() {
    // The option code selects the state in which the quick stop ends.
    for (option, state) in [(2, State::SwitchOnDisabled), (6, State::QuickStopActive)] {
        let mut rig = moving();
        rig.drive.device().set(QUICK_STOP_OPTION, option).unwrap();
        assert_eq!(rig.motion().quick_stop(DEADLINE), Ok(state));
        assert_eq!((rig.drive.device().get(VELOCITY), rig.controls()), (Ok(0), vec![0x02]));
    }
    // "Quick stop" works in every state, and clears all other bits of the controlword.
    let mut rig = moving();
    rig.write(0x6040, &0x0306_u16.to_le_bytes());
    rig.writes.clear();
    assert_eq!(rig.motion().quick_stop(DEADLINE), Ok(State::SwitchOnDisabled));
    assert_eq!(rig.controls(), [0x02]);
    // The statusword of this drive doesn't show that the axis has stopped.
    let mut rig = moving();
    rig.cleared = 0x0460;
    rig.set = 0x0017;
    let late = rig.motion().quick_stop(ms(200));
    assert!(matches!(late, Err(MotionError::Deadline { status }) if status & 0x6F == 0x17 & 0x6F), "{late:?}");
    assert!(rig.time >= 195, "{}", rig.time);
}

#[test]
fn a_quick_stop_of_a_drive_with_a_fault() {
    let mut rig = moving().at(3, |rig| rig.fail(0x7305));
    let failed = rig.motion().quick_stop(DEADLINE);
    assert!(matches!(failed, Err(MotionError::Fault { code: Some(0x7305), .. })), "{failed:?}");
}

#[test]
fn an_old_bit_10_does_not_end_a_quick_stop() {
    // Bit 10 still shows that the axis has reached its target velocity. With option 5, the axis needs 70 ms to stop.
    let mut rig = moving();
    rig.drive.device().set(QUICK_STOP_OPTION, 5).unwrap();
    rig.set = 1 << 10;
    assert_eq!(rig.motion().quick_stop(DEADLINE), Ok(State::QuickStopActive));
    assert_eq!(rig.drive.device().get(VELOCITY), Ok(0));
    assert!(rig.time >= 95, "{}", rig.time);
    // If bit 10 is already 1, a quick stop waits for 100 ms. A deadline of 50 ms therefore passes even if the axis is at a
    // standstill.
    assert!(matches!(rig.motion().quick_stop(ms(50)), Err(MotionError::Deadline { .. })));
}

#[test]
fn a_quick_stop_is_written_before_any_read() {
    // Homing is in progress. If bit 4 stayed set, homing would start again when the drive is enabled.
    let mut rig = Rig::enabled(6);
    rig.write(0x6040, &0x001F_u16.to_le_bytes());
    rig.writes.clear();
    rig.broken = 1;
    assert_eq!(reason(rig.motion().quick_stop(DEADLINE)), Error::Timeout);
    assert_eq!((rig.controls(), rig.control_reads), (vec![0x02], 0));
}

#[test]
fn halt_and_resume() {
    let mut rig = moving();
    assert_eq!(rig.motion().halt(DEADLINE), Ok(()));
    assert_eq!((rig.drive.device().get(VELOCITY), rig.controls()), (Ok(0), vec![0x010F]));
    // The drive clears bit 10 while the axis slows down, which takes 70 ms.
    assert!((65..95).contains(&rig.time), "{}", rig.time);
    assert_eq!(rig.motion().set_velocity(5), Err(MotionError::Halted));
    assert_eq!(rig.motion().resume(), Ok(()));
    assert_eq!(rig.motion().wait_reached(DEADLINE), Ok(()));
    assert_eq!(rig.drive.device().get(VELOCITY), Ok(700));
    // If `halt` misses its deadline, the halt bit stays 1. Halt isn't possible if the operation isn't enabled.
    rig.cleared = 1 << 10;
    assert!(matches!(rig.motion().halt(ms(100)), Err(MotionError::Deadline { .. })));
    assert_eq!(rig.control(), 0x010F);
    rig.write(0x6040, &[6, 0]);
    rig.writes.clear();
    assert!(matches!(rig.motion().halt(DEADLINE), Err(MotionError::NotEnabled { .. })));
    assert!(matches!(rig.motion().resume(), Err(MotionError::NotEnabled { .. })));
    assert_eq!(rig.writes, []);
}

#[test]
fn an_old_bit_10_does_not_end_a_halt() {
    let mut rig = moving();
    rig.set = 1 << 10;
    assert_eq!(rig.motion().halt(DEADLINE), Ok(()));
    assert_eq!(rig.drive.device().get(VELOCITY), Ok(0));
    assert!(rig.time >= 95, "{}", rig.time);
}

#[tokio::test]
async fn stops_without_blocking() {
    let mut rig = moving();
    assert_eq!(rig.motion().halt_async(DEADLINE).await, Ok(()));
    assert_eq!(rig.motion().resume_async().await, Ok(()));
    assert_eq!(rig.motion().wait_reached_async(DEADLINE).await, Ok(()));
    assert!(rig.motion().quick_stop_async(DEADLINE).await.is_ok());
    assert_eq!(rig.drive.device().get(VELOCITY), Ok(0));
}

#[test]
fn operations_in_another_mode_or_with_halt() {
    let mut rig = Rig::enabled(3);
    let wrong = |active| Err(MotionError::WrongMode { active });
    assert_eq!(rig.motion().move_to(Target::absolute(1), DEADLINE), wrong(Mode::ProfileVelocity));
    let mut rig = Rig::enabled(1);
    assert_eq!(rig.motion().set_velocity(1), wrong(Mode::ProfilePosition));
    rig.write(0x6040, &0x010F_u16.to_le_bytes());
    rig.writes.clear();
    assert_eq!(rig.motion().move_to(Target::absolute(1), DEADLINE), Err(MotionError::Halted));
    assert_eq!(rig.motion().wait_reached(DEADLINE), Err(MotionError::Halted));
    assert_eq!(rig.motion().home(DEADLINE), Err(MotionError::Halted));
    assert_eq!(rig.writes, []);
}

#[test]
fn accesses_that_fail() {
    let mut rig = Rig::enabled(1).at(20, |rig| rig.drive.device().fail_next(AbortCode::DEVICE_STATE));
    rig.motion().move_to(Target::absolute(500), DEADLINE).unwrap();
    let Err(MotionError::Access(error)) = rig.motion().wait_reached(DEADLINE) else { panic!("the access fails") };
    assert_eq!(error.error, Error::Abort(AbortCode::DEVICE_STATE));
    assert_eq!((error.address(), error.is_write()), (Some(lexibus::Object::new(0x6041, 0).into()), false));
}

#[tokio::test]
async fn without_blocking() {
    let mut rig = Rig::enabled(1);
    let moves = async {
        rig.motion().home_async(DEADLINE).await?;
        rig.motion().set_mode_async(Mode::ProfilePosition, DEADLINE).await?;
        rig.motion().move_to_async(Target::absolute(300), DEADLINE).await?;
        rig.motion().wait_reached_async(DEADLINE).await?;
        assert_eq!(rig.position(), 300);
        rig.motion().set_mode_async(Mode::ProfileVelocity, DEADLINE).await?;
        rig.motion().set_velocity_async(20).await?;
        rig.motion().home_with_async(36, DEADLINE).await
    };
    assert_eq!(moves.await, Err(MotionError::Homing));
}

/// Runs a cycle of 2 ms with a set-point. Returns whether the drive follows the set-point, or the error.
fn cycle(rig: &mut Rig, cyclic: &mut Cyclic, target: i32) -> Result<bool, CycleError> {
    let device = rig.drive.device();
    device.step(ms(2));
    let inputs = Inputs {
        status: device.get(STATUSWORD).unwrap(),
        mode: device.get(ACTIVE_MODE).ok(),
        actual: device.get(POSITION).unwrap(),
        following_error: device.get(FOLLOWING_ERROR).ok(),
    };
    let control = device.get(CONTROLWORD).unwrap();
    let cycle = cyclic.cycle(inputs, control, target)?;
    device.set(TARGET_POSITION, cycle.target).unwrap();
    device.set(CONTROLWORD, cycle.control).unwrap();
    Ok(cycle.is_following)
}

#[test]
fn cyclic_positions() {
    let mut rig = Rig::enabled(1);
    rig.write(0x607F, &1000_u32.to_le_bytes());
    let mut cyclic = Cyclic::position().with_limit(50);
    // The axis doesn't move before the mode is active.
    for target in 0..10 {
        assert_eq!(cycle(&mut rig, &mut cyclic, 900 + target), Ok(false));
    }
    assert_eq!(rig.position(), 0);
    rig.motion().set_mode(cyclic.mode(), DEADLINE).unwrap();
    for target in 1..=100 {
        assert_eq!(cycle(&mut rig, &mut cyclic, target), Ok(true));
    }
    // The axis cannot move 5 units in 2 ms.
    let error = (1..100).find_map(|step| cycle(&mut rig, &mut cyclic, 100 + 5 * step).err());
    let Some(CycleError::LimitExceeded { error, limit: 50 }) = error else { panic!("{error:?}") };
    assert!((51..=56).contains(&error), "{error}");
    // The drive reports a following error outside its own window (0x6065).
    rig.write(0x6065, &40_u32.to_le_bytes());
    let failed = cycle(&mut rig, &mut Cyclic::position(), 500);
    assert!(matches!(failed, Err(CycleError::FollowingError { error: Some(error) }) if error > 40), "{failed:?}");
    rig.fail(0x8611);
    // `cyclic` has already reported an error, so it returns no further error.
    assert_eq!(cycle(&mut rig, &mut cyclic, 0), Ok(false));
}

/// Tests the operations of generated bindings.
#[test]
fn generated_drives() {
    use lexibus_drives::demo_drive::types::ModesOfOperation;

    let mut device = Device::new(demo_drive::ENTRIES).with_cia402();
    let mut drive = demo_drive::DemoDrive::new(device.client::<CanOpen>());
    let disabled = drive.cia402().move_to(Target::absolute(5), DEADLINE);
    assert!(matches!(disabled, Err(MotionError::NotEnabled { .. })), "{disabled:?}");
    drive.walk(demo_drive::types::State::OperationEnabled, DEADLINE).unwrap();
    drive.cia402().set_mode(ModesOfOperation::ProfilePosition, DEADLINE).unwrap();
    drive.cia402().move_to(Target::absolute(-5), DEADLINE).unwrap();
    drive.cia402().wait_reached(DEADLINE).unwrap();
    assert_eq!(drive.position_actual_value().read(), Ok(-5));
    // The description limits the range of the target position, and limits the mode to at most 8.
    let refused = drive.cia402().move_to(Target::absolute(1_000_001), DEADLINE);
    let text = "write 1000001 to Target position (0x607A:00): outside the range -1000000 to 1000000";
    assert_eq!(refused.as_ref().err().map(ToString::to_string).as_deref(), Some(text));
    assert!(matches!(reason(refused), Error::OutOfRange(_)));
    let refused = drive.cia402().set_mode(Mode::CyclicSynchronousVelocity, DEADLINE);
    assert!(matches!(reason(refused), Error::OutOfRange(_)));
    // The error code of this drive is in 0x1003.
    device.fail(0x2310).unwrap();
    let mut drive = demo_drive::DemoDrive::new(device.client::<CanOpen>());
    let fault = drive.cia402().wait_reached(DEADLINE);
    assert!(matches!(fault, Err(MotionError::Fault { code: Some(0x2310), .. })), "{fault:?}");
}

#[test]
fn a_generated_drive_with_several_axes() {
    use lexibus_drives::vector_step::types::State;

    let mut device = Device::new(vector_step::ENTRIES).with_cia402().with_axes(&vector_step::AXES);
    let mut drive = vector_step::VectorStep::new(device.client::<CoE>());
    let mut axis = drive.axis(2);
    axis.walk(State::OperationEnabled, DEADLINE).unwrap();
    axis.cia402().home_with(35, DEADLINE).unwrap();
    axis.cia402().set_mode(Mode::ProfilePosition, DEADLINE).unwrap();
    axis.cia402().move_to(Target::absolute(700), Duration::from_secs(20)).unwrap();
    axis.cia402().wait_reached(Duration::from_secs(20)).unwrap();
    assert_eq!(axis.position_actual_value().read(), Ok(700));
    assert_eq!(drive.position_actual_value().read(), Ok(0));
    let disabled = drive.cia402().home(DEADLINE);
    assert!(matches!(disabled, Err(MotionError::NotEnabled { .. })), "{disabled:?}");
}

#[test]
fn a_generated_drive_with_scaled_values() {
    use lexibus_drives::eco::types::State;

    let mut device = Device::new(eco::ENTRIES).with_cia402();
    let mut drive = eco::Eco::new(device.client::<CoE>());
    drive.walk(State::OperationEnabled, DEADLINE).unwrap();
    drive.cia402().set_mode(Mode::ProfilePosition, DEADLINE).unwrap();
    drive.cia402().move_to(Target::absolute(300), DEADLINE).unwrap();
    drive.cia402().wait_reached(DEADLINE).unwrap();
    assert_eq!(drive.position_actual_value().read(), Ok(300));
    drive.cia402().set_mode(Mode::ProfileVelocity, DEADLINE).unwrap();
    drive.cia402().set_velocity(-40).unwrap();
    drive.cia402().wait_reached(DEADLINE).unwrap();
    assert_eq!(drive.velocity_actual_value().read(), Ok(-40));
}

#[test]
fn states_and_commands_have_names_and_paths() {
    use demo_drive::types::{Command, State};
    assert_eq!(State::SwitchOnDisabled.to_string(), "switch on disabled");
    assert_eq!(format!("{:>17}", Command::FaultReset), "      fault reset");
    // The path out of a quick stop must not energize the motor.
    assert_eq!(State::QuickStopActive.toward(State::SwitchedOn), lexibus::Step::Command(Command::DisableVoltage));
    for (state, name) in State::NAMES {
        assert_eq!((name.parse(), state.to_string().as_str()), (Ok(*state), *name));
    }
    for (command, name) in Command::NAMES {
        assert_eq!((name.to_uppercase().parse(), command.to_string().as_str()), (Ok(*command), *name));
    }
    assert_eq!("switch_on_disabled".parse(), Ok(State::SwitchOnDisabled));
    assert_eq!("on".parse::<State>().unwrap_err().to_string(), "the text is not a value of this type");
}
