//! Tests simulated drives: the state machine, the modes and the motion of CiA 402.

#![cfg(feature = "std")]

use std::time::Duration;

use lexibus::sim::{Device, Fault};
use lexibus::table::{Bound, Entry};
use lexibus::{AbortCode, CanOpen, Client, CoE, DataType, NodeId, Object, Pdo, WalkError};
use lexibus_drives::demo_drive::types::{Controlword, ModesOfOperation, State};
use lexibus_drives::demo_drive::{self, objects, pdo, DemoDrive};
use lexibus_drives::vector_step;

#[path = "support/entry.rs"]
mod entry;
use entry::entry;
#[cfg(feature = "canopen")]
#[path = "support/now.rs"]
mod now;

const DEADLINE: Duration = Duration::from_secs(2);
const NODE: NodeId = match NodeId::new(5) {
    Some(node) => node,
    None => unreachable!(),
};

const fn ms(time: u64) -> Duration {
    Duration::from_millis(time)
}

/// Additional objects for these tests, which the demo drive lacks.
const MORE: [Entry; 33] = [
    entry(0x603F, DataType::Unsigned16),
    entry(0x6042, DataType::Integer16),
    entry(0x6043, DataType::Integer16),
    entry(0x6044, DataType::Integer16),
    sub_entry(0x6046, 1, DataType::Unsigned32),
    sub_entry(0x6046, 2, DataType::Unsigned32),
    sub_entry(0x6048, 1, DataType::Unsigned32),
    sub_entry(0x6048, 2, DataType::Unsigned16),
    sub_entry(0x6049, 1, DataType::Unsigned32),
    sub_entry(0x6049, 2, DataType::Unsigned16),
    sub_entry(0x604A, 1, DataType::Unsigned32),
    sub_entry(0x604A, 2, DataType::Unsigned16),
    entry(0x605A, DataType::Integer16),
    entry(0x605D, DataType::Integer16),
    entry(0x605E, DataType::Integer16),
    entry(0x6065, DataType::Unsigned32),
    entry(0x606C, DataType::Integer32),
    entry(0x6071, DataType::Integer16),
    entry(0x6072, DataType::Unsigned16),
    entry(0x6077, DataType::Integer16),
    entry(0x607C, DataType::Integer32),
    entry(0x607F, DataType::Unsigned32),
    entry(0x6084, DataType::Unsigned32),
    entry(0x6085, DataType::Unsigned32),
    entry(0x6098, DataType::Integer8),
    entry(0x6087, DataType::Unsigned32),
    sub_entry(0x60C1, 1, DataType::Integer32),
    sub_entry(0x60C2, 1, DataType::Unsigned8),
    sub_entry(0x60C2, 2, DataType::Integer8),
    entry(0x60F2, DataType::Unsigned16),
    entry(0x60F4, DataType::Integer32),
    entry(0x60FF, DataType::Integer32),
    entry(0x6502, DataType::Unsigned32),
];

const fn sub_entry(index: u16, sub_index: u8, data_type: DataType) -> Entry {
    Entry { object: Some(Object::new(index, sub_index)), ..entry(index, data_type) }
}

fn drive() -> Device {
    let mut entries = demo_drive::ENTRIES.to_vec();
    entries.extend(MORE);
    // The description of the demo drive limits the mode to at most 8, but these tests use higher modes.
    let mode = entries.iter_mut().find(|entry| entry.object == Some(Object::new(0x6060, 0))).unwrap();
    mode.high = Bound::Unlimited;
    Device::new(&entries).with_node_id(NODE).with_cia402()
}

/// Returns a drive in the state "Operation enabled" and in this mode.
fn enabled(mode: i64) -> Device {
    let mut device = drive();
    write(&mut device, 0x6060, mode);
    DemoDrive::new(device.client::<CanOpen>()).walk(State::OperationEnabled, DEADLINE).unwrap();
    assert_eq!(number(&device, 0x6061), mode);
    device
}

/// Writes an object as a client does.
fn write(device: &mut Device, index: u16, value: i64) {
    write_sub(device, (index, 0), value);
}

fn write_sub(device: &mut Device, object: (u16, u8), value: i64) {
    let (index, sub_index) = object;
    let object = Object::new(index, sub_index);
    let length = device.bytes(object).unwrap().len();
    device.client::<CanOpen>().write(object, &value.to_le_bytes()[..length]).unwrap();
}

/// Returns the value of an object. Treats all values as signed.
fn number(device: &Device, index: u16) -> i64 {
    match *device.bytes(Object::new(index, 0)).unwrap() {
        [low] => i64::from(low as i8),
        [low, high] => i64::from(i16::from_le_bytes([low, high])),
        [a, b, c, d] => i64::from(i32::from_le_bytes([a, b, c, d])),
        ref other => panic!("{other:?}"),
    }
}

fn state(device: &Device) -> State {
    device.get(objects::STATUSWORD).unwrap().state().unwrap()
}

/// Returns whether a bit of the statusword is 1.
fn bit(device: &Device, bit: u32) -> bool {
    device.get(objects::STATUSWORD).unwrap().raw() >> bit & 1 == 1
}

/// Returns bits 10, 12 and 13 of the statusword.
fn bits(device: &Device) -> [bool; 3] {
    [10, 12, 13].map(|at| bit(device, at))
}

/// Sends a set-point with the handshake. `bits` are further bits of the controlword.
fn set_point(device: &mut Device, target: i64, bits: i64) {
    write(device, 0x607A, target);
    write(device, 0x6040, 0x1F | bits);
    assert!(bit(device, 12), "the set-point is acknowledged");
    write(device, 0x6040, 0x0F | bits);
}

/// Advances the time until the condition is true, and returns the elapsed time in milliseconds.
fn until(device: &mut Device, condition: impl Fn(&Device) -> bool) -> u64 {
    (0..20_000)
        .find(|_| {
            let is_met = condition(device);
            if !is_met {
                device.step(ms(1));
            }
            is_met
        })
        .expect("the condition becomes true")
}

#[test]
fn a_walk_from_power_on() {
    let mut device = drive();
    assert_eq!(state(&device), State::NotReadyToSwitchOn);
    let mut client = DemoDrive::new(device.client::<CanOpen>());
    assert_eq!(client.walk(State::OperationEnabled, DEADLINE), Ok(()));
    assert_eq!(client.walk(State::ReadyToSwitchOn, DEADLINE), Ok(()));
    assert_eq!(client.walk(State::SwitchedOn, DEADLINE), Ok(()));
    assert_eq!(client.walk(State::SwitchOnDisabled, DEADLINE), Ok(()));
    device.power_cycle();
    assert_eq!(state(&device), State::NotReadyToSwitchOn);
}

#[test]
fn every_command() {
    let mut device = drive();
    device.step(ms(1));
    let rows = [
        (0x0F, State::SwitchOnDisabled),
        (0x06, State::ReadyToSwitchOn),
        (0x02, State::SwitchOnDisabled),
        (0x06, State::ReadyToSwitchOn),
        (0x07, State::SwitchedOn),
        (0x06, State::ReadyToSwitchOn),
        (0x07, State::SwitchedOn),
        (0x0F, State::OperationEnabled),
        (0x07, State::SwitchedOn),
        (0x00, State::SwitchOnDisabled),
        (0x06, State::ReadyToSwitchOn),
        (0x0F, State::SwitchedOn),
    ];
    for (control, expected) in rows {
        write(&mut device, 0x6040, control);
        assert_eq!(state(&device), expected, "0x{control:02X}");
    }
    // In "Ready to switch on", the command "Enable operation" moves the drive through "Switched on" within one step.
    device.step(ms(1));
    assert_eq!(state(&device), State::OperationEnabled);
    write(&mut device, 0x6040, 0x06);
    assert_eq!(state(&device), State::ReadyToSwitchOn);
}

#[test]
fn a_walk_from_a_fault_with_the_reset_bit_set() {
    let mut device = drive();
    device.set(objects::CONTROLWORD, Controlword::from_raw(0x80)).unwrap();
    device.fail(0x8611).unwrap();
    assert_eq!(state(&device), State::FaultReactionActive);
    device.step(ms(1));
    assert_eq!(state(&device), State::Fault);
    // Without a rising edge, bit 7 does not reset the fault.
    write(&mut device, 0x6040, 0x80);
    device.step(ms(10));
    assert_eq!(state(&device), State::Fault);
    let mut client = DemoDrive::new(device.client::<CanOpen>());
    assert_eq!(client.walk(State::OperationEnabled, DEADLINE), Ok(()));
    let emergencies: Vec<_> = device.take_emergencies().map(|emergency| (emergency.code, emergency.register)).collect();
    assert_eq!(emergencies, [(0x8611, 0x21), (0, 0)]);
}

#[test]
fn a_fault_whose_cause_persists() {
    let mut device = drive();
    device.fail_persistently(0x3210).unwrap();
    let mut client = DemoDrive::new(device.client::<CanOpen>());
    let late = client.walk(State::OperationEnabled, ms(50));
    assert_eq!(late, Err(WalkError::Fault { state: State::Fault, code: Some(0x3210) }));
    device.clear_cause().unwrap();
    device.step(ms(1));
    assert_eq!(state(&device), State::Fault);
    let mut client = DemoDrive::new(device.client::<CanOpen>());
    assert_eq!(client.walk(State::OperationEnabled, ms(50)), Ok(()));
}

#[test]
fn a_profile_position_move() {
    let mut device = enabled(1);
    assert!(bit(&device, 10));
    write(&mut device, 0x607A, 500);
    device.step(ms(50));
    assert_eq!(number(&device, 0x6064), 0, "the move needs a set-point");
    write(&mut device, 0x6040, 0x1F);
    assert_eq!(bits(&device), [false, true, false]);
    device.step(ms(200));
    assert_eq!((bits(&device), number(&device, 0x606C)), ([false, true, false], 1000));
    write(&mut device, 0x6040, 0x0F);
    assert_eq!(bits(&device), [false; 3]);
    // A move of 500 units at 1000 units/s with ramps of 10000 units/s² takes 0.6 s.
    let time = 200 + until(&mut device, |device| bit(device, 10));
    assert!((590..=610).contains(&time), "{time}");
    assert_eq!((number(&device, 0x6064), number(&device, 0x606C)), (500, 0));
}

#[test]
fn set_points_wait_or_replace() {
    let mut device = enabled(1);
    set_point(&mut device, 300, 0);
    device.step(ms(50));
    set_point(&mut device, -100, 0x40);
    assert!(bit(&device, 12), "a set-point waits, so that a further one is not accepted");
    write(&mut device, 0x607A, 7);
    write(&mut device, 0x6040, 0x1F);
    until(&mut device, |device| !bit(device, 12));
    assert_eq!((number(&device, 0x6064), bit(&device, 10)), (300, false));
    write(&mut device, 0x6040, 0x0F);
    // The waiting set-point is relative to the last target.
    until(&mut device, |device| bit(device, 10));
    assert_eq!(number(&device, 0x6064), 200);
    // "Change set immediately" replaces the active set-point, so the axis moves back.
    set_point(&mut device, 900, 0);
    device.step(ms(300));
    set_point(&mut device, 250, 0x20);
    until(&mut device, |device| bit(device, 10));
    assert_eq!(number(&device, 0x6064), 250);
    // If 0x60F2 is 2, a set-point during a move is relative to the actual position.
    write(&mut device, 0x60F2, 2);
    set_point(&mut device, 900, 0);
    device.step(ms(300));
    let position = number(&device, 0x6064);
    set_point(&mut device, 200, 0x60);
    until(&mut device, |device| bit(device, 10));
    assert!((number(&device, 0x6064) - position - 200).abs() <= 1);
}

#[test]
fn a_target_outside_the_position_limits() {
    let mut device = enabled(1);
    device.set(objects::software_position_limit::MAX_POSITION_LIMIT, 100).unwrap();
    set_point(&mut device, 5000, 0);
    until(&mut device, |device| bit(device, 10));
    assert_eq!((number(&device, 0x6064), bit(&device, 11)), (100, true));
}

#[test]
fn velocity_ramps() {
    let mut device = enabled(3);
    assert_eq!(bits(&device), [true, true, false]);
    write(&mut device, 0x6084, 5000);
    write(&mut device, 0x60FF, 1000);
    assert!(!bit(&device, 10));
    device.step(ms(50));
    assert_eq!((number(&device, 0x606C), bits(&device)), (500, [false; 3]));
    assert_eq!(until(&mut device, |device| bit(device, 10)), 50);
    assert_eq!(number(&device, 0x606C), 1000);
    write(&mut device, 0x60FF, -500);
    // The axis decelerates for 0.2 s, then accelerates in the other direction for 0.05 s.
    device.step(ms(200));
    assert_eq!((number(&device, 0x606C), bit(&device, 12)), (0, true));
    assert_eq!(until(&mut device, |device| bit(device, 10)), 50);
    write(&mut device, 0x607F, 200);
    assert_eq!(until(&mut device, |device| number(device, 0x606C) == -200), 60);
    assert!(bit(&device, 11) && !bit(&device, 10));
}

#[test]
fn the_result_does_not_depend_on_the_steps() {
    let run = |steps: &[u64]| {
        let mut device = enabled(3);
        write(&mut device, 0x60FF, 12_345);
        steps.iter().for_each(|step| device.step(Duration::from_micros(*step)));
        (number(&device, 0x6064), number(&device, 0x606C))
    };
    let all = run(&[150_000]);
    assert_eq!(all.1, 1500);
    assert_eq!(run(&[500; 300]), all);
    assert_eq!(run(&[1, 99_999, 49_000, 1000]), all);
}

#[test]
fn homing() {
    let mut device = enabled(6);
    assert_eq!(bits(&device), [true, false, false]);
    device.set(objects::POSITION_ACTUAL_VALUE, 777).unwrap();
    write(&mut device, 0x607C, -20);
    write(&mut device, 0x6040, 0x1F);
    assert_eq!(bits(&device), [false; 3]);
    device.step(ms(50));
    assert_eq!((bits(&device), number(&device, 0x6064)), ([false; 3], 777));
    let time = until(&mut device, |device| bit(device, 12));
    assert!((40..=60).contains(&time), "{time}");
    assert_eq!((bits(&device), number(&device, 0x6064)), ([true, true, false], -20));
    // The controller can abort homing.
    write(&mut device, 0x6040, 0x0F);
    assert!(bit(&device, 12));
    write(&mut device, 0x6040, 0x1F);
    device.step(ms(50));
    write(&mut device, 0x6040, 0x0F);
    device.step(ms(100));
    assert_eq!(bits(&device), [true, false, false]);
    // Method 36 is reserved.
    write(&mut device, 0x6098, 36);
    write(&mut device, 0x6040, 0x1F);
    device.step(ms(1));
    assert_eq!(bits(&device), [true, false, true]);
}

#[test]
fn halt_and_resume() {
    let mut device = enabled(1);
    set_point(&mut device, 1000, 0);
    device.step(ms(300));
    write(&mut device, 0x6040, 0x10F);
    assert!(!bit(&device, 10));
    // The profile acceleration is also the profile deceleration, because 0x6084 is 0.
    assert_eq!(until(&mut device, |device| bit(device, 10)), 100);
    let position = number(&device, 0x6064);
    device.step(ms(100));
    assert_eq!((number(&device, 0x6064), number(&device, 0x606C)), (position, 0));
    write(&mut device, 0x6040, 0x0F);
    assert!(!bit(&device, 10));
    until(&mut device, |device| bit(device, 10));
    assert_eq!(number(&device, 0x6064), 1000);
}

#[test]
fn quick_stop() {
    let mut device = enabled(3);
    write(&mut device, 0x60FF, 1000);
    device.step(ms(200));
    write(&mut device, 0x6085, 20_000);
    write(&mut device, 0x6040, 0x02);
    assert_eq!(state(&device), State::QuickStopActive);
    assert_eq!(until(&mut device, |device| state(device) != State::QuickStopActive), 50);
    assert_eq!((state(&device), number(&device, 0x606C)), (State::SwitchOnDisabled, 0));
    // With option 6, the drive stays in "Quick stop active", and "Enable operation" resumes the motion.
    write(&mut device, 0x605A, 6);
    DemoDrive::new(device.client::<CanOpen>()).walk(State::OperationEnabled, DEADLINE).unwrap();
    device.step(ms(200));
    write(&mut device, 0x6040, 0x02);
    device.step(ms(500));
    assert_eq!((state(&device), bit(&device, 10)), (State::QuickStopActive, true));
    write(&mut device, 0x6040, 0x0F);
    device.step(ms(200));
    assert_eq!((state(&device), number(&device, 0x606C)), (State::OperationEnabled, 1000));
    // Without power, the axis coasts with a quarter of the profile deceleration.
    write(&mut device, 0x6040, 0);
    assert_eq!(state(&device), State::SwitchOnDisabled);
    assert_eq!(until(&mut device, |device| number(device, 0x606C) == 0), 400);
}

#[test]
fn a_fault_during_motion() {
    let mut device = enabled(1);
    set_point(&mut device, 10_000, 0);
    device.step(ms(300));
    device.fail(0x2310).unwrap();
    assert_eq!((state(&device), number(&device, 0x603F)), (State::FaultReactionActive, 0x2310));
    let code = objects::pre_defined_error_field::PRE_DEFINED_ERROR_FIELD1;
    assert_eq!(device.get(code).map(|entry| entry.raw()), Ok(0x2310));
    assert_eq!(device.take_emergencies().map(|emergency| emergency.code).collect::<Vec<_>>(), [0x2310]);
    // The default quick-stop deceleration is ten times the profile deceleration.
    assert_eq!(until(&mut device, |device| state(device) == State::Fault), 10);
    let position = number(&device, 0x6064);
    // The fault reset discards the set-point.
    DemoDrive::new(device.client::<CanOpen>()).walk(State::OperationEnabled, DEADLINE).unwrap();
    device.step(ms(500));
    assert_eq!(number(&device, 0x6064), position);
}

#[test]
fn cyclic_position_over_pdos() {
    let mut device = enabled(8);
    for write in pdo::RxPdo2::configuration(NODE).iter().chain(&pdo::TxPdo2::configuration(NODE)) {
        write.send(&mut device.client::<CanOpen>()).unwrap();
    }
    for cycle in 1..=100 {
        let output = pdo::RxPdo2 { controlword: Controlword::from_raw(0x0F), target_position: 3 * cycle };
        device.receive_pdo(pdo::RxPdo2::INDEX, &output.pack()).unwrap();
        device.step(ms(1));
        let input = pdo::TxPdo2::unpack(&device.transmit_pdo(pdo::TxPdo2::INDEX).unwrap()).unwrap();
        assert_eq!((input.position_actual_value, bits(&device)), (3 * cycle, [false, true, false]));
    }
    assert_eq!(number(&device, 0x606C), 3000);
    device.step(ms(1));
    assert_eq!((number(&device, 0x6064), number(&device, 0x606C)), (300, 0));
    // A low maximum velocity (0x607F) causes a following error.
    write(&mut device, 0x607F, 1000);
    write(&mut device, 0x6065, 50);
    write(&mut device, 0x607A, 400);
    device.step(ms(10));
    assert_eq!((number(&device, 0x6064), number(&device, 0x60F4)), (310, 90));
    assert!(bit(&device, 13) && bit(&device, 11));
    device.step(ms(100));
    assert_eq!((number(&device, 0x6064), bit(&device, 13)), (400, false));
}

#[test]
fn cyclic_velocity_and_torque() {
    let mut device = enabled(9);
    write(&mut device, 0x60FF, -2000);
    device.step(ms(10));
    assert_eq!((number(&device, 0x606C), number(&device, 0x6064)), (-2000, -20));
    write(&mut device, 0x60FF, 0);
    device.step(ms(1));
    write(&mut device, 0x6060, 10);
    device.step(ms(1));
    write(&mut device, 0x6071, 500);
    device.step(ms(10));
    let (velocity, torque) = (number(&device, 0x606C), number(&device, 0x6077));
    assert!((45..=50).contains(&velocity) && (495..=505).contains(&torque), "{velocity} {torque}");
    // At half of the rated torque, friction limits the velocity to five times the profile velocity.
    device.step(Duration::from_secs(60));
    assert_eq!((number(&device, 0x606C), number(&device, 0x6077)), (5000, 500));
}

#[test]
fn velocity_of_frequency_converters() {
    let mut device = enabled(2);
    write(&mut device, 0x6042, 1000);
    device.step(ms(100));
    // Without the ramp bits of the controlword, the axis stands still.
    assert_eq!((number(&device, 0x6044), number(&device, 0x6064)), (0, 0));
    // Set the acceleration to 5,000 and the deceleration to 10,000 units per second squared.
    for (object, value) in [((0x6048, 1), 5000), ((0x6048, 2), 1), ((0x6049, 1), 20_000), ((0x6049, 2), 2)] {
        write_sub(&mut device, object, value);
    }
    write(&mut device, 0x6040, 0x7F);
    assert_eq!(until(&mut device, |device| number(device, 0x6044) == 1000), 200);
    // The mode-specific bits of the statusword are reserved in this mode.
    assert_eq!(bits(&device), [false; 3]);
    write(&mut device, 0x6042, -300);
    assert_eq!(until(&mut device, |device| number(device, 0x6044) == -300), 160);
    // Without "unlock ramp", the axis keeps its velocity.
    write(&mut device, 0x6042, 0);
    write(&mut device, 0x6040, 0x5F);
    device.step(ms(100));
    assert_eq!((number(&device, 0x6044), number(&device, 0x6043)), (-300, -300));
    // Without "reference ramp", the axis stops. Halt also stops the axis.
    write(&mut device, 0x6042, 400);
    write(&mut device, 0x6040, 0x3F);
    assert_eq!(until(&mut device, |device| number(device, 0x6044) == 0), 30);
    write(&mut device, 0x6040, 0x7F);
    device.step(ms(200));
    // Set the limits of the absolute value of the velocity (0x6046).
    write_sub(&mut device, (0x6046, 1), 100);
    write_sub(&mut device, (0x6046, 2), 350);
    device.step(ms(100));
    assert_eq!((number(&device, 0x6044), bit(&device, 11)), (350, true));
    write(&mut device, 0x6042, -20);
    device.step(ms(200));
    assert_eq!((number(&device, 0x6044), bit(&device, 11)), (-100, true));
    write(&mut device, 0x6040, 0x17F);
    device.step(ms(200));
    assert_eq!((number(&device, 0x6044), bit(&device, 10)), (0, false));
}

#[test]
fn stops_of_frequency_converters() {
    let mut device = enabled(2);
    // Set the deceleration to 5,000 units per second squared, and to 2,500 for the quick stop.
    for (object, value) in [((0x6049, 1), 5000), ((0x6049, 2), 1), ((0x604A, 1), 5000), ((0x604A, 2), 2)] {
        write_sub(&mut device, object, value);
    }
    let start = |device: &mut Device| {
        DemoDrive::new(device.client::<CanOpen>()).walk(State::OperationEnabled, DEADLINE).unwrap();
        write(device, 0x6042, 1000);
        write(device, 0x6040, 0x7F);
        until(device, |device| number(device, 0x6044) == 1000);
    };
    start(&mut device);
    write(&mut device, 0x6040, 0x17F);
    assert_eq!(until(&mut device, |device| number(device, 0x6044) == 0), 200, "halt");
    write(&mut device, 0x6040, 0x7F);
    start(&mut device);
    write(&mut device, 0x6040, 0x02);
    assert_eq!(until(&mut device, |device| number(device, 0x6044) == 0), 400, "quick stop");
}

#[test]
fn bit_10_of_a_halted_axis() {
    for (mode, is_defined) in
        [(1, true), (3, true), (4, true), (6, true), (7, true), (8, false), (9, false), (10, false)]
    {
        let mut device = enabled(mode);
        write(&mut device, 0x6040, 0x10F);
        device.step(ms(10));
        assert_eq!(bit(&device, 10), is_defined, "mode {mode}");
    }
}

#[test]
fn profile_torque() {
    let mut device = enabled(4);
    assert!(bit(&device, 10), "the target torque is 0");
    write(&mut device, 0x6087, 2000);
    write(&mut device, 0x6071, 500);
    device.step(ms(100));
    let torque = number(&device, 0x6077);
    assert!((195..=205).contains(&torque) && !bit(&device, 10), "{torque}");
    assert_eq!(until(&mut device, |device| bit(device, 10)), 150);
    assert!(number(&device, 0x606C) > 100);
    // Friction limits the velocity, as in the mode "cyclic synchronous torque".
    device.step(Duration::from_secs(60));
    assert_eq!((number(&device, 0x606C), number(&device, 0x6077)), (5000, 500));
    write(&mut device, 0x6072, 300);
    device.step(ms(200));
    assert_eq!((number(&device, 0x6077), bit(&device, 10), bit(&device, 11)), (300, false, true));
    write(&mut device, 0x6040, 0x10F);
    let time = until(&mut device, |device| number(device, 0x606C) == 0);
    assert!(bit(&device, 10) && time > 100, "{time}");
    write(&mut device, 0x6072, 1000);
    write(&mut device, 0x6040, 0x0F);
    device.step(ms(10));
    assert!(number(&device, 0x6077) < 100, "the torque starts at 0 after halt");
}

#[test]
fn interpolated_position() {
    let mut device = enabled(7);
    // Set the interpolation period to 10 ms.
    write_sub(&mut device, (0x60C2, 1), 10);
    write_sub(&mut device, (0x60C2, 2), -3);
    write_sub(&mut device, (0x60C1, 1), 50);
    device.step(ms(50));
    assert_eq!((number(&device, 0x6064), bits(&device)), (0, [false; 3]), "interpolation isn't enabled");
    write(&mut device, 0x6040, 0x1F);
    for record in [50, 100, 130] {
        write_sub(&mut device, (0x60C1, 1), record);
        device.step(ms(10));
        assert_eq!((number(&device, 0x6064), bit(&device, 12)), (record, true));
    }
    assert_eq!(number(&device, 0x606C), 3000);
    device.step(ms(1));
    assert_eq!(bits(&device), [true, true, false]);
    write_sub(&mut device, (0x60C1, 1), 1130);
    device.step(ms(5));
    write(&mut device, 0x6040, 0x0F);
    assert!(until(&mut device, |device| number(device, 0x606C) == 0) > 0, "the axis stops on a ramp");
    assert!(!bit(&device, 12) && number(&device, 0x6064) > 600);
}

#[test]
fn interpolation_starts_with_a_full_period() {
    // The axis is stopped by halt, or by clearing bit 4.
    for stop in [0x11F, 0x0F] {
        let mut device = enabled(7);
        write(&mut device, 0x6084, 1_000_000);
        write_sub(&mut device, (0x60C2, 1), 100);
        write_sub(&mut device, (0x60C2, 2), -3);
        write_sub(&mut device, (0x60C1, 1), 1000);
        write(&mut device, 0x6040, 0x1F);
        device.step(ms(50));
        write(&mut device, 0x6040, stop);
        until(&mut device, |device| number(device, 0x606C) == 0);
        let begin = number(&device, 0x6064);
        assert!((500..1000).contains(&begin), "{begin}");
        write(&mut device, 0x6040, 0x1F);
        assert_eq!(until(&mut device, |device| number(device, 0x6064) == 1000), 100);
    }
}

#[test]
fn torque_with_commutation_angle() {
    let mut device = enabled(11);
    write(&mut device, 0x6071, 500);
    device.step(Duration::from_secs(60));
    assert_eq!((number(&device, 0x606C), number(&device, 0x6077), bits(&device)), (5000, 500, [false, true, false]));
}

#[test]
fn the_mode_follows_in_the_next_step() {
    let mut device = enabled(1);
    write(&mut device, 0x6060, 3);
    assert_eq!(number(&device, 0x6061), 1);
    device.step(ms(1));
    assert_eq!(number(&device, 0x6061), 3);
    // The drive supports neither the reserved mode 5, nor modes that 0x6502 excludes, nor manufacturer-specific modes.
    write(&mut device, 0x6502, 0b1_0101);
    for mode in [5, 8, -5] {
        write(&mut device, 0x6060, mode);
        device.step(ms(2));
        assert_eq!(number(&device, 0x6061), 3, "mode {mode}");
    }
}

#[test]
fn a_mode_needs_its_target() {
    let target = |object: Object, data_type| Entry { object: Some(object), ..entry(object.index, data_type) };
    for (modes, object) in [
        (&[1, 8][..], Object::new(0x607A, 0)),
        (&[2], Object::new(0x6042, 0)),
        (&[3, 9], Object::new(0x60FF, 0)),
        (&[4, 10, 11], Object::new(0x6071, 0)),
        (&[7], Object::new(0x60C1, 1)),
        (&[6], Object::new(0x6098, 0)),
    ] {
        let entries = [
            entry(0x6040, DataType::Unsigned16),
            entry(0x6041, DataType::Unsigned16),
            entry(0x6060, DataType::Integer8),
            entry(0x6061, DataType::Integer8),
            target(object, DataType::Integer16),
        ];
        let mut device = Device::new(&entries).with_cia402();
        let mut supported = Vec::new();
        for mode in 1..=11 {
            write(&mut device, 0x6060, mode);
            device.step(ms(2));
            if number(&device, 0x6061) == mode {
                supported.push(mode);
            }
        }
        // The drive also supports homing (mode 6), because homing needs no target object.
        let mut expected = [modes, &[6]].concat();
        expected.sort_unstable();
        expected.dedup();
        assert_eq!(supported, expected, "0x{:04X}", object.index);
    }
}

#[test]
fn tables_with_few_objects() {
    let entries = [entry(0x6040, DataType::Unsigned16), entry(0x6041, DataType::Unsigned16)];
    let mut device = Device::new(&entries).with_cia402();
    for control in [6, 7, 0x0F, 0x1F, 0x10F, 2, 0x80] {
        write(&mut device, 0x6040, control);
        device.step(ms(10));
    }
    device.fail(0xFFFF).unwrap();
    device.step(Duration::MAX);
    assert_eq!(number(&device, 0x6041), 0x0208);
    // A device without a controlword isn't a drive.
    let mut device = Device::new(&entries[1..]).with_cia402();
    assert_eq!(device.fail(1), Err(AbortCode::NO_OBJECT));
    device.step(DEADLINE);
    assert_eq!(number(&device, 0x6041), 0);
}

#[test]
fn each_axis_is_a_drive() {
    let mut device = Device::new(vector_step::ENTRIES).with_cia402().with_axes(&vector_step::AXES);
    device.step(ms(1));
    device.client::<CoE>().write(Object::new(0x7040, 0), &[6, 0]).unwrap();
    let status = |device: &Device, index| device.bytes(Object::new(index, 0)).map(|bytes| bytes[0]);
    assert_eq!(status(&device, 0x7041), Ok(0x31));
    assert_eq!(status(&device, 0x6041), Ok(0x40));
    device.axis(3).fail(0x7320).unwrap();
    device.step(ms(1));
    assert_eq!((status(&device, 0x7041), status(&device, 0x6041)), (Ok(0x08), Ok(0x40)));
    assert_eq!(device.axis(9).fail(1), Err(AbortCode::NO_OBJECT));
}

#[test]
fn drivers_that_do_not_wait() {
    let poll = |device: Device| {
        let mut drive = DemoDrive::new(device.into_client::<CanOpen>());
        drive.walk(State::OperationEnabled, DEADLINE)?;
        drive.modes_of_operation().write(ModesOfOperation::ProfilePosition)?;
        drive.target_position().write(30)?;
        drive.controlword().write(Controlword::from_raw(0x1F))?;
        while !drive.statusword().read()?.target_reached() {}
        assert_eq!(drive.position_actual_value().read(), Ok(30));
        Ok::<(), WalkError<State, Fault>>(())
    };
    assert_eq!(poll(drive().with_access_time(ms(1))), Ok(()));
    assert_eq!(poll(drive().with_real_time()), Ok(()));
    let mut device = drive();
    device.fail_next(AbortCode::DEVICE_STATE);
    let refused = DemoDrive::new(device.client::<CanOpen>()).walk(State::OperationEnabled, DEADLINE);
    let Err(WalkError::Access(refused)) = refused else { panic!("{refused:?}") };
    let text = "read Controlword (0x6040:00): the device refused: 0x08000022: ";
    assert!(refused.to_string().starts_with(text), "{refused}");
}

/// Tests a drive as a node on a CAN bus.
#[cfg(feature = "canopen")]
mod frames {
    use lexibus::clients::canopen::{Buffered, CanPort, NmtCommand, NmtState, Node};
    use lexibus::sim::CanNode;
    use lexibus_drives::demo_drive::codes::DriveErrors;

    use super::now::now;
    use super::*;

    #[test]
    fn a_drive_on_a_can_bus() {
        let mut drive = DemoDrive::new(Node::new(CanNode::new(drive()), NODE));
        drive.walk(State::OperationEnabled, DEADLINE).unwrap();
        drive.client().nmt(NmtCommand::Start).unwrap();
        drive.target_position().write(100).unwrap();
        drive.controlword().write(Controlword::from_raw(0x1F)).unwrap();
        // While the driver waits for a frame, the axis moves. The event-driven TPDO 1 reports the end of the move.
        let is_reached = |drive: &mut DemoDrive<Node<CanNode>>| {
            let frame = drive.client().receive_pdo(pdo::TxPdo1::COB_ID, DEADLINE).unwrap();
            pdo::TxPdo1::unpack(frame.data()).unwrap().statusword.target_reached()
        };
        (0..10).find(|_| is_reached(&mut drive)).expect("the target is reached");
        assert_eq!(drive.position_actual_value().read(), Ok(100));
        drive.client().port().device().fail(0x8611).unwrap();
        let emergency = drive.client().emergency(ms(10)).unwrap().unwrap();
        assert_eq!(emergency.alarm::<DriveErrors>(), DriveErrors::FollowingError);
        drive.client().nmt(NmtCommand::ResetNode).unwrap();
        drive.client().wait_for(NmtState::BootUp, ms(10)).unwrap();
        assert_eq!(drive.position_actual_value().read(), Ok(0));
    }

    /// The clock of the interface measures the pauses of a walk. A walk over an async interface needs no other timer.
    #[test]
    fn a_walk_waits_with_the_interface() {
        let port = |device| Buffered::<_, 16>::new(CanNode::new(device));
        let mut enabled = DemoDrive::new(Node::new(port(drive()), NODE));
        assert_eq!(now(enabled.walk_async(State::OperationEnabled, DEADLINE)), Ok(()));

        let mut device = drive();
        device.fail_persistently(0x8611).unwrap();
        let mut drive = DemoDrive::new(Node::new(port(device), NODE));
        let walked = now(drive.walk_async(State::OperationEnabled, DEADLINE));
        assert!(walked.is_err_and(|error| error.is_fault()));
        let waited = CanPort::now(drive.client().port()).unwrap();
        assert!(waited >= DEADLINE && waited < DEADLINE + ms(50), "{waited:?}");
        // The buffer keeps the frames that arrive during the walk.
        let emergency = drive.client().emergency(ms(0)).unwrap().unwrap();
        assert_eq!(emergency.alarm::<DriveErrors>(), DriveErrors::FollowingError);
    }
}
