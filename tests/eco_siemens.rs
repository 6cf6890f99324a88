//! Tests the second Modbus address map of the Eco drive, which is intended for Siemens controllers. Two options of
//! the register table select this map. The manual prints the fields of the requests ("Esempi di utilizzo dei codici
//! funzione"), but not their bytes.

use std::convert::Infallible;

use lexibus::modbus::{Limits, RegisterClient};
use lexibus::{Client, Error, Modbus, Register};

lexibus::dictionary! {
    /// The Eco with the wire addresses that apply if parameter E3 is 9. A Siemens controller subtracts 1 from each address.
    #[allow(deprecated)]
    pub mod siemens = "dictionaries/eco.toml" { option: "register_base=siemens_plc", option: "parameter_base=siemens_plc" };
}

use siemens::{objects, types};

/// A client that records requests: address, number of registers, and written words.
#[derive(Default)]
struct Probe {
    asked: Vec<(u16, u16)>,
    words: Vec<u16>,
    /// The words that the simulated drive returns if it is read.
    registers: Vec<u16>,
}

impl RegisterClient for Probe {
    fn limits(&self) -> &Limits {
        &siemens::MODBUS
    }
}

impl Client for Probe {
    type Bus = Modbus;
    type Error = Infallible;

    fn read(&mut self, register: Register, buffer: &mut [u8]) -> Result<usize, Error<Infallible>> {
        self.asked.push((register.address, register.count));
        self.registers.resize(register.count.into(), 0);
        Ok(register.decode(&self.registers, buffer)?)
    }

    fn write(&mut self, register: Register, data: &[u8]) -> Result<(), Error<Infallible>> {
        self.asked.push((register.address, register.count));
        self.words = vec![0; register.count.into()];
        Ok(register.encode(data, &mut self.words)?)
    }
}

#[test]
fn the_second_map() -> Result<(), Error<Infallible>> {
    let mut drive = siemens::Eco::new(Probe::default());
    drive.d1().read()?;
    drive.control_word().read()?;
    drive.modes_of_operation().read()?;
    drive.d3().write(10)?;
    assert_eq!(drive.client().words, [0x000A]);
    drive.target_position().write(1000)?;
    assert_eq!(drive.client().words, [0x0000, 0x03E8]);
    let asked = [(0x9C42, 1), (0xAC41, 2), (0xAC42, 2), (0x9C44, 1), (0xAC4A, 2)];
    assert_eq!(drive.client().asked, asked);
    // The address for saving is the same in both address maps.
    drive.save_to_flash().write(0x0011)?;
    assert_eq!(drive.client().asked.last(), Some(&(0x3802, 1)));
    Ok(())
}

/// Tests both examples of section "Codice 0x03": three registers from address 0x9C42, and four registers from address
/// 0xAC41 with the high word first.
#[test]
fn blocks_of_the_second_map() -> Result<(), Error<Infallible>> {
    // The manual prints this response in an example for the first address map.
    let mut drive = Probe { registers: vec![0x0014, 0x0032, 0x0032], ..Probe::default() };
    assert_eq!(drive.read_block((objects::D1, objects::D2, objects::D3))?, (20, 50, 50));
    drive.registers = vec![0x0000, 0x0023, 0xFFFF, 0xFFFE];
    let values = drive.read_block((objects::CONTROL_WORD, objects::MODES_OF_OPERATION))?;
    assert_eq!(values, (types::DriveCommand::from_raw(0x23), types::Mode::ElectricAxis));
    assert_eq!(drive.asked, [(0x9C42, 3), (0xAC41, 4)]);
    Ok(())
}
