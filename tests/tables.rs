//! Tests the bindings of a register table: which requests the accessors send to the device, and which values they
//! return. The bindings are generated from `data/press.toml`, and each bus has a simulated client.

#![cfg(feature = "macros")]

use std::collections::HashMap;
use std::convert::Infallible;

use lexibus::{
    codes, CanOpen, Client, CoE, Error, Modbus, Object, OutOfRange, Parameter, Register, RegisterTable, Serial,
    Stopped, Walker,
};

lexibus::dictionary! {
    /// A fictitious press.
    #[allow(deprecated)]
    pub mod press = "tests/data/press.toml";
}

use press::types::{Command, Control, ControlDirection, ControlRamp, Mode, State, Status};
use press::{objects, Press};

/// A client for objects on CANopen or EtherCAT.
struct Objects<B> {
    entries: HashMap<Object, Vec<u8>>,
    bus: std::marker::PhantomData<B>,
}

impl<B: lexibus::Bus<Address = Object>> Client for Objects<B> {
    type Bus = B;
    type Error = Object;

    fn read(&mut self, address: Object, buffer: &mut [u8]) -> Result<usize, Error<Object>> {
        let value = self.entries.get(&address).ok_or(Error::Client(address))?;
        buffer.iter_mut().zip(value).for_each(|(to, from)| *to = *from);
        Ok(value.len())
    }

    fn write(&mut self, address: Object, data: &[u8]) -> Result<(), Error<Object>> {
        self.entries.insert(address, data.to_vec());
        Ok(())
    }
}

fn objects_on<B>() -> Objects<B> {
    Objects { entries: HashMap::new(), bus: std::marker::PhantomData }
}

/// A client for registers, which are words and bits with addresses.
#[derive(Default)]
struct Registers {
    words: HashMap<(RegisterTable, u16), u16>,
    bits: HashMap<(RegisterTable, u16), bool>,
}

impl Registers {
    fn words(&self, register: Register) -> Vec<u16> {
        let addresses = register.address..register.address + register.count;
        addresses.map(|address| self.words.get(&(register.table, address)).copied().unwrap_or(0)).collect()
    }
}

impl Client for Registers {
    type Bus = Modbus;
    type Error = Infallible;

    fn read(&mut self, register: Register, buffer: &mut [u8]) -> Result<usize, Error<Infallible>> {
        match register.table {
            RegisterTable::Coil | RegisterTable::DiscreteInput => {
                let bit = self.bits.get(&(register.table, register.address));
                buffer[0] = u8::from(bit.copied().unwrap_or(false));
                Ok(1)
            }
            _ => Ok(register.decode(&self.words(register), buffer)?),
        }
    }

    fn write(&mut self, register: Register, data: &[u8]) -> Result<(), Error<Infallible>> {
        if register.table == RegisterTable::Coil {
            self.bits.insert((register.table, register.address), data[0] != 0);
            return Ok(());
        }
        let mut words = self.words(register);
        register.encode(data, &mut words)?;
        for (address, word) in (register.address..).zip(words) {
            self.words.insert((register.table, address), word);
        }
        Ok(())
    }
}

/// A client for numbered parameters.
#[derive(Default)]
struct Parameters(HashMap<Parameter, Vec<u8>>);

impl Client for Parameters {
    type Bus = Serial;
    type Error = ();

    fn read(&mut self, number: Parameter, buffer: &mut [u8]) -> Result<usize, Error<()>> {
        let value = self.0.get(&number).ok_or(Error::Client(()))?;
        buffer[..value.len()].copy_from_slice(value);
        Ok(value.len())
    }

    fn write(&mut self, number: Parameter, data: &[u8]) -> Result<(), Error<()>> {
        self.0.insert(number, data.to_vec());
        Ok(())
    }
}

const HOLDING: RegisterTable = RegisterTable::Holding;

#[test]
fn one_device_on_every_bus() {
    let mut canopen = Press::new(objects_on::<CanOpen>());
    let mut ethercat = Press::new(objects_on::<CoE>());
    let mut modbus = Press::new(Registers::default());
    canopen.velocity().write(0x1234).unwrap();
    ethercat.velocity().write(0x1234).unwrap();
    modbus.velocity().write(0x1234).unwrap();
    let object = Object::new(0x200A, 1);
    assert_eq!(canopen.client().entries[&object], [0x34, 0x12, 0, 0]);
    assert_eq!(ethercat.client().entries[&object], [0x34, 0x12, 0, 0]);
    assert_eq!(modbus.client().words[&(HOLDING, 10)], 0x1234);
    assert_eq!(modbus.client().words[&(HOLDING, 11)], 0);
    assert_eq!(canopen.velocity().read(), Ok(0x1234));
    assert_eq!(modbus.velocity().read(), Ok(0x1234));
    let mut serial = Press::new(Parameters::default());
    serial.tool().write(7).unwrap();
    assert_eq!((serial.tool().read(), serial.client().0[&Parameter(70_000)].as_slice()), (Ok(7), [7, 0].as_slice()));
}

#[test]
fn places_of_modbus() {
    let mut press = Press::new(Registers::default());
    press.total().write(0x1234_5678).unwrap();
    assert_eq!((press.client().words[&(HOLDING, 104)], press.client().words[&(HOLDING, 105)]), (0x3412, 0x7856));
    assert_eq!(press.total().read(), Ok(0x1234_5678));
    press.label().write("Ram 7").unwrap();
    assert_eq!((press.client().words[&(HOLDING, 100)], press.client().words[&(HOLDING, 102)]), (0x5261, 0x3700));
    assert_eq!(press.label().read_into(&mut [0; 8]), Ok("Ram 7"));
    press.client().words.insert((HOLDING, 106), 0xABCD);
    assert_eq!(press.upper().read(), Ok(0xAB));
    press.upper().write(0x12).unwrap();
    assert_eq!(press.client().words[&(HOLDING, 106)], 0x12CD);
    press.client().words.insert((RegisterTable::Input, 3), 24);
    assert_eq!(press.voltage().read(), Ok(24));
    press.client().bits.insert((RegisterTable::DiscreteInput, 1), true);
    assert_eq!(press.door().read(), Ok(true));
    press.valve().write(true).unwrap();
    assert!(press.client().bits[&(RegisterTable::Coil, 2)]);
}

#[test]
fn texts_in_registers() {
    let mut press = Press::new(Registers::default());
    let mut buffer = [0; 16];
    // Each 16-bit character occupies one register.
    press.title().write("Äb", &mut buffer).unwrap();
    assert_eq!((press.client().words[&(HOLDING, 129)], press.client().words[&(HOLDING, 130)]), (0xC4, 0x62));
    assert_eq!(press.title().read_into(&mut buffer).unwrap(), "Äb");
    // The type has no length, so the register addresses determine the length of the text.
    press.note().write("ABCDEFG").unwrap();
    assert_eq!(press.client().words[&(HOLDING, 141)], 0x4546);
    assert_eq!(press.note().read_into(&mut buffer), Ok("ABCDEFG"));
}

#[test]
fn only_values_that_are_allowed_are_written() {
    let mut press = Press::new(Registers::default());
    assert_eq!(press.stroke().write(5), Ok(()));
    assert_eq!(press.stroke().write(15), Ok(()));
    assert_eq!(press.stroke().write(6).map_err(Error::from), Err(Error::OutOfRange(OutOfRange)));
    assert_eq!(press.sizes().write(Mode::Eject), Ok(()));
    assert_eq!(press.sizes().write(Mode::Unknown(3)).map_err(Error::from), Err(Error::OutOfRange(OutOfRange)));
}

#[test]
fn equal_names_have_their_addresses() {
    assert_eq!(objects::POSITION_8.location().canopen, Object::new(0x2008, 1));
    assert_eq!(objects::POSITION_107.location().modbus, Register::holding(107));
}

#[test]
fn further_axes() {
    let mut press = Press::new(objects_on::<CoE>());
    press.axis(1).target_position().write(1).unwrap();
    press.axis(2).target_position().write(2).unwrap();
    press.axis(2).velocity().write(20).unwrap();
    // All axes of the press share one gain object (0x200D:1).
    press.axis(2).gain().write(3).unwrap();
    let entries = &press.client().entries;
    assert_eq!(entries[&Object::new(0x607A, 0)], [1, 0, 0, 0]);
    assert_eq!(entries[&Object::new(0x687A, 0)], [2, 0, 0, 0]);
    assert_eq!(entries[&Object::new(0x200A, 2)], [20, 0, 0, 0]);
    assert_eq!(entries[&Object::new(0x200D, 1)], [3, 0]);
    assert_eq!(press.axis(2).velocity().read_scaled(), Ok(Some(2.0)));
    let object = Object::new(0x607A, 0);
    assert_eq!(press.axis(3).target_position().read().map_err(Error::from), Err(Error::NoSuchAxis { axis: 3, object }));
}

#[test]
fn scaled_values() {
    let mut press = Press::new(Registers::default());
    press.velocity().write_scaled(12.34).unwrap();
    assert_eq!(press.velocity().read(), Ok(123));
    assert_eq!(press.velocity().read_scaled(), Ok(Some(12.3)));
    assert_eq!(press.velocity().write_scaled(500.1).map_err(Error::from), Err(Error::OutOfRange(OutOfRange)));
    // The value 0 means that the ram is off, so it is not a valid velocity.
    assert_eq!(press.velocity().write_scaled(0.0).map_err(Error::from), Err(Error::OutOfRange(OutOfRange)));
    press.velocity().write(0).unwrap();
    assert_eq!(press.velocity().read_scaled(), Ok(None));
    assert_eq!(objects::POSITION_8.physical(-1234), -12.34);

    press.frequency().write_scaled(10_000.0).unwrap();
    assert_eq!((press.frequency().read(), press.frequency().read_scaled()), (Ok(2500), Ok(10_000.0)));
    press.client().words.insert((HOLDING, 12), 60);
    let gain = press.gain().read().unwrap_or(0).max(10);
    assert_eq!(press.force().read_scaled_by(gain.into()), Ok(3.0));
    press.client().words.insert((HOLDING, 15), 0x4000);
    assert_eq!(press.current().read_scaled_by(11.0), Ok(5.5));
    press.client().words.insert((HOLDING, 16), 7);
    assert_eq!(press.energy().read_scaled_by(3.0), Ok(7000.0));
    press.client().words.insert((HOLDING, 17), 655);
    assert_eq!(press.temperature().read_scaled(), Ok(Some(25.5)));
    press.client().words.insert((HOLDING, 17), 0xFFFE);
    assert_eq!(press.temperature().read_scaled(), Ok(None));
}

#[test]
fn bit_fields() {
    const ENABLED: Control = Control::new().with_enable(true).with_direction(ControlDirection::Up);
    assert_eq!(Control::default().raw(), 0x2000);
    assert_eq!(ENABLED.raw(), 0x2201);
    // Bit 1 is active low.
    assert!(ENABLED.stop() && !ENABLED.with_stop(false).stop());
    assert_eq!(ENABLED.with_stop(false).raw(), 0x2203);
    assert_eq!((ENABLED.with_tool(5).tool(), ENABLED.with_tool(9).raw()), (5, 0x2221));
    assert_eq!(Control::from_raw(0x0C00).ramp(), ControlRamp::Unknown(3));
    // The match is exhaustive because all four values of the two bits have names.
    let name = match Control::from_raw(0x0300).direction() {
        ControlDirection::None => "none",
        ControlDirection::Down => "down",
        ControlDirection::Up => "up",
        ControlDirection::Both => "both",
    };
    assert_eq!(name, "both");
    assert_eq!(
        format!("{:?}", Control::from_raw(0x0519)),
        "Control { enable, stop, tool: 0, direction: Down, ramp: Long, 0x18 }"
    );
}

#[test]
fn reserved_bits_are_written_as_the_manual_says() {
    let mut press = Press::new(objects_on::<CanOpen>());
    let object = Object::new(0x2013, 1);
    press.client().entries.insert(object, vec![0x00, 0xD0]);
    let control = press.control().read().unwrap();
    assert_eq!(control.raw(), 0xD000);
    press.control().write(control.with_enable(true)).unwrap();
    assert_eq!(press.client().entries[&object], [0x01, 0xE0]);
}

#[test]
fn bits_that_depend_on_the_mode() {
    let mut press = Press::new(objects_on::<CoE>());
    press.mode().write(Mode::Press).unwrap();
    let control = Control::new().in_press().with_full_force(true).with_hold(true).control();
    assert_eq!((control.raw(), control.in_eject().blow(), control.in_press().hold()), (0x2018, true, true));
    press.control().write(control.in_eject().with_blow(false).control()).unwrap();
    assert_eq!(press.control().read().map(Control::raw), Ok(0x2010));
    press.mode().write(Mode::Unknown(12)).unwrap();
    assert_eq!(press.mode().read(), Ok(Mode::Unknown(12)));
}

/// The table declares the fault state. The transition to this state starts in "running", so without the declaration the state would
/// not be a fault state.
#[test]
fn a_fault_state_of_the_table_stops_the_walker() {
    let mut walker = Walker::new(State::Running);
    assert_eq!(walker.cycle(0x00_u16, 0x00_u16).map(|walked| walked.control), Ok(0x03));
    assert_eq!(walker.cycle(0x01_u16, 0x03_u16).map(|walked| walked.control), Ok(0x07));
    assert_eq!(walker.cycle(0x04_u16, 0x07_u16), Err(Stopped::Fault { state: State::Fault, code: None }));
}

#[test]
fn state_machines() {
    let mut press = Press::new(objects_on::<CanOpen>());
    press.client().entries.insert(Object::new(0x2014, 1), vec![0x03, 0x2A]);
    let status = press.status().read().unwrap();
    assert_eq!((status.state(), status.cycle()), (Some(State::Running), 42));
    assert_eq!(Status::from_raw(0xFF).state(), Some(State::Fault));
    assert_eq!(Status::from_raw(0x02).state(), None);
    let control = Control::from_raw(0xC000).with_command(Command::Start);
    assert_eq!(control.raw(), 0xC007);
    assert_eq!(control.with_command(Command::Enable).raw(), 0xC003);
}

#[test]
fn tables_of_codes() {
    let find = |code| codes::find(press::codes::ALARMS, code);
    assert_eq!(
        find(1).map(|row| (row.name, row.text, row.cells)),
        Some(("door open", "Close the door", &[codes::Cell::Text("A")][..]))
    );
    assert_eq!(find(0x12).map(|row| (row.name, row.cells)), Some(("tool broken", &[codes::Cell::Number(2)][..])));
    assert_eq!(find(0x13).map(|row| row.name), Some("tool"));
    assert_eq!(find(2), None);
}

#[test]
fn process_data_has_the_types() {
    assert_eq!(objects::CONTROL.name(), "control");
    assert_eq!(objects::GAIN.initial(), &lexibus::Initial::Value(10));
}
