//! Tests the bindings of the Vector Step: one table for CANopen, EtherCAT and Modbus, with one axis and with three.

#![cfg(feature = "vector-step")]

use std::collections::HashMap;
use std::convert::Infallible;
use std::marker::PhantomData;

use lexibus::{Bus, CanOpen, Client, CoE, Error, Modbus, Object, OutOfRange, Register, Step};
use lexibus_drives::vector_step::types::{
    Controlword, DriveCommand, EepromCommand, ModesOfOperation, State, Statusword,
};
use lexibus_drives::vector_step::{codes, objects, pdo, VectorStep, IDENTITY};

/// Objects with any value.
struct Objects<B>(HashMap<Object, Vec<u8>>, PhantomData<B>);

impl<B> Objects<B> {
    fn new() -> Self {
        Self(HashMap::new(), PhantomData)
    }
}

impl<B: Bus<Address = Object>> Client for Objects<B> {
    type Bus = B;
    type Error = Object;

    fn read(&mut self, object: Object, buffer: &mut [u8]) -> Result<usize, Error<Object>> {
        let value = self.0.get(&object).ok_or(Error::Client(object))?;
        buffer.iter_mut().zip(value).for_each(|(to, from)| *to = *from);
        Ok(value.len())
    }

    fn write(&mut self, object: Object, data: &[u8]) -> Result<(), Error<Object>> {
        self.0.insert(object, data.to_vec());
        Ok(())
    }
}

/// Holding registers.
struct Words([u16; 0x4000]);

impl Client for Words {
    type Bus = Modbus;
    type Error = Infallible;

    fn read(&mut self, register: Register, buffer: &mut [u8]) -> Result<usize, Error<Infallible>> {
        let first = usize::from(register.address);
        Ok(register.decode(&self.0[first..first + usize::from(register.count)], buffer)?)
    }

    fn write(&mut self, register: Register, data: &[u8]) -> Result<(), Error<Infallible>> {
        let first = usize::from(register.address);
        Ok(register.encode(data, &mut self.0[first..first + usize::from(register.count)])?)
    }
}

#[test]
fn a_register_is_an_object_and_two_words() {
    let mut canopen = VectorStep::new(Objects::<CanOpen>::new());
    let mut ethercat = VectorStep::new(Objects::<CoE>::new());
    let mut modbus = VectorStep::new(Words([0; 0x4000]));
    canopen.rpostarg().write(-100_000).unwrap();
    ethercat.rpostarg().write(-100_000).unwrap();
    modbus.rpostarg().write(-100_000).unwrap();
    // Register 8 is object 0x2008:01, and its lower word comes first.
    assert_eq!(canopen.client().0[&Object::new(0x2008, 1)], (-100_000_i32).to_le_bytes());
    assert_eq!(ethercat.client().0[&Object::new(0x2008, 1)], (-100_000_i32).to_le_bytes());
    assert_eq!(modbus.client().0[8..10], [0x7960, 0xFFFE]);
    assert_eq!(modbus.rpostarg().read(), Ok(-100_000));
    modbus.rloadsav().write(EepromCommand::from_raw(129)).unwrap();
    assert_eq!(modbus.client().0[194], 129);
}

#[test]
fn profile_objects_have_units_bits_and_states() {
    let mut drive = VectorStep::new(Objects::<CanOpen>::new());
    drive.modes_of_operation().write(ModesOfOperation::ProfilePosition).unwrap();
    drive.profile_velocity().write_scaled(15.0).unwrap();
    assert_eq!(drive.client().0[&Object::new(0x6081, 0)], 1500_u32.to_le_bytes());
    drive.client().0.insert(Object::new(0x6041, 0), vec![0x37, 0x02]);
    let status = drive.statusword().read().unwrap();
    assert_eq!(status.state(), Some(State::OperationEnabled));
    assert_eq!(Statusword::from_raw(0x0240).state(), Some(State::SwitchOnDisabled));
    let control = Controlword::new().with_command(DriveCommand::EnableOperation);
    assert_eq!(control.raw() & 0x8F, 0x0F);
    assert_eq!(lexibus::codes::find(codes::EMERGENCY, 0x8110).map(|code| code.first), Some(0x8110));
    assert_eq!(IDENTITY.vendor_id, Some(0xBC));
}

#[test]
fn one_step_at_a_time_to_operation() {
    // The drive answers each command according to its state machine.
    let mut state = State::Fault;
    let mut commands = Vec::new();
    loop {
        match state.toward(State::OperationEnabled) {
            Step::Command(command) => {
                commands.push(command);
                state = match command {
                    DriveCommand::FaultReset => State::SwitchOnDisabled,
                    DriveCommand::Shutdown => State::ReadyToSwitchOn,
                    DriveCommand::SwitchOn => State::SwitchedOn,
                    DriveCommand::EnableOperation => State::OperationEnabled,
                    other => panic!("{other:?}"),
                };
            }
            step => break assert_eq!(step, Step::Reached),
        }
    }
    let expected =
        [DriveCommand::FaultReset, DriveCommand::Shutdown, DriveCommand::SwitchOn, DriveCommand::EnableOperation];
    assert_eq!(commands, expected);
    assert_eq!(State::NotReadyToSwitchOn.toward(State::OperationEnabled), Step::Wait);
    assert_eq!(State::OperationEnabled.toward(State::Fault), Step::Unreachable);
}

#[test]
fn each_of_three_axes_has_its_objects() {
    let mut drive = VectorStep::new(Objects::<CanOpen>::new());
    for axis in 1..=3 {
        drive.axis(axis).target_position().write(i32::from(axis) * 100).unwrap();
        drive.axis(axis).rpostarg().write(i32::from(axis)).unwrap();
    }
    let objects = &drive.client().0;
    // 607A, 687A and 707A ("INDIRIZZAMENTO REGISTRI STANDARD DSP-402"). The sub-index is the axis ("INDIRIZZAMENTO REGISTRI
    // PROPRIETARI AEC").
    let positions = [0x607A, 0x687A, 0x707A].map(|index| objects[&Object::new(index, 0)].clone());
    assert_eq!(positions, [100, 200, 300].map(|position: i32| position.to_le_bytes().to_vec()));
    let targets = [1, 2, 3].map(|axis| objects[&Object::new(0x2008, axis)][0]);
    assert_eq!(targets, [1, 2, 3]);
    // The EEPROM belongs to the drive.
    drive.axis(3).rloadsav().write(EepromCommand::from_raw(129)).unwrap();
    assert!(drive.client().0.contains_key(&Object::new(0x20C2, 1)));
    let missing = drive.axis(4).target_position().write(0);
    assert!(matches!(missing.map_err(Error::from), Err(Error::NoSuchAxis { axis: 4, .. })));
}

#[test]
fn ranges_and_pdos() {
    let mut drive = VectorStep::new(Objects::<CanOpen>::new());
    assert_eq!(drive.end_velocity().write_scaled(1e9).map_err(Error::from), Err(Error::OutOfRange(OutOfRange)));
    let frame = pdo::RxPdo2 { controlword: Controlword::from_raw(0x0F), target_position: -2 }.pack();
    assert_eq!(frame, [0x0F, 0, 0xFE, 0xFF, 0xFF, 0xFF]);
    assert_eq!(objects::RPOSTARG.location().modbus, Register::low_first(8, 2));
}
