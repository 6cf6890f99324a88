//! Tests the bindings of the HSD motors: parameters of both chapters, their units, bits and codes.

#![cfg(feature = "hsd")]

use std::collections::HashMap;

use lexibus::{Client, Error, Parameter, Serial};
use lexibus_drives::hsd::types::{BitA, HomingType};
use lexibus_drives::hsd::{codes, objects, HsdMotor, IDENTITY};

/// A motor that stores the bytes of its parameters.
#[derive(Default)]
struct Motor(HashMap<u32, Vec<u8>>);

impl Client for Motor {
    type Bus = Serial;
    type Error = u32;

    fn read(&mut self, parameter: Parameter, buffer: &mut [u8]) -> Result<usize, Error<u32>> {
        let value = self.0.get(&parameter.0).ok_or(Error::Client(parameter.0))?;
        buffer.iter_mut().zip(value).for_each(|(to, from)| *to = *from);
        Ok(value.len())
    }

    fn write(&mut self, parameter: Parameter, data: &[u8]) -> Result<(), Error<u32>> {
        self.0.insert(parameter.0, data.to_vec());
        Ok(())
    }
}

#[test]
fn parameters_are_in_their_units_and_ranges() {
    let mut motor = HsdMotor::new(Motor::default());
    motor.pimax_i().write_scaled(19.4).expect("19.4 V");
    assert_eq!(motor.pimax_i().read(), Ok(194));
    assert_eq!(motor.client().0[&0x0104].len(), 2);
    motor.amax().write_scaled(480_000.0).expect("counts/s²");
    assert_eq!(motor.amax().read(), Ok(48));
    assert!(motor.pimax_pos().write(5001).is_err(), "at most 5000 rpm");
    motor.low_slim().write(-2_147_418_112).expect("the default");
    assert_eq!(motor.client().0[&0x011C].len(), 4);
    // 5 A of 11.3137 A, rounded to the nearest raw value.
    assert_eq!(objects::KVELLIMAX.raw_by(5.0, 11.3137), Ok(14_482));
    assert_eq!((objects::KIQDPIMANT.name(), IDENTITY.vendor_name), ("KIQDPIMANT", "HSD S.p.A."));
}

#[test]
fn bits_values_and_codes() {
    let bits = BitA::new().with_software_limits(true).with_alarm_at_limit_cams(true);
    assert_eq!(bits.raw(), 0x0401);
    assert_eq!(HomingType::from_raw(2), HomingType::SwitchAndIndex);
    let find = |table, code| lexibus::codes::find(table, code).map(|code: &lexibus::codes::Code| code.name);
    assert_eq!(find(codes::ALARM, 8), Some("communication error"));
    assert_eq!(find(codes::WARNING, 0x400B), Some("motion too long"));
    assert_eq!((codes::ALARM.len(), codes::WARNING.len()), (23, 12));
}
