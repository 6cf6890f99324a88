//! Tests the bindings of the Eco on EtherCAT: slots, the window of parameters, and saving, as its manual describes them.

#![cfg(feature = "eco")]

use std::collections::BTreeMap;
use std::convert::Infallible;
use std::time::Duration;

use lexibus::ethercat::{Assignment, Direction};
use lexibus::{Client, CoE, Error, Object, OutOfRange, Pdo, Range, SdoWrite};
use lexibus_drives::eco::objects::{rx_pdo_assign, tx_pdo_assign};
use lexibus_drives::eco::types::{Controlword, DriveCommand, Mode};
use lexibus_drives::eco::{image, objects, pdo, procedures, Eco, DEVICE};

type Answer<T> = Result<T, Error<Infallible>>;

/// A drive that records the writes. Objects are 0 until they are written, unless they have a prepared answer.
#[derive(Default)]
struct Slave {
    log: Vec<String>,
    answers: BTreeMap<Object, u32>,
}

impl Client for Slave {
    type Bus = CoE;
    type Error = Infallible;

    fn read(&mut self, object: Object, buffer: &mut [u8]) -> Answer<usize> {
        self.log.push(format!("read {object}, {} bytes", buffer.len()));
        let value = self.answers.get(&object).copied().unwrap_or_default().to_le_bytes();
        buffer.copy_from_slice(&value[..buffer.len()]);
        Ok(buffer.len())
    }

    fn write(&mut self, object: Object, data: &[u8]) -> Answer<()> {
        self.log.push(format!("write {object} {data:02X?}"));
        let mut value = [0; 4];
        value[..data.len()].copy_from_slice(data);
        self.answers.insert(object, u32::from_le_bytes(value));
        Ok(())
    }

    fn wait(&mut self, time: Duration) -> Answer<()> {
        self.log.push(format!("wait {time:?}"));
        Ok(())
    }
}

/// The window of parameters: write the address, wait 3 ms, read the value; or write the value and the address, and wait 3 ms.
#[test]
fn parameters_and_registers_by_their_window() -> Answer<()> {
    let mut slave = Slave::default();
    slave.answers.insert(Object::new(0x2005, 2), 80);
    assert_eq!(objects::D1.at(&mut slave).read()?, 80);
    objects::D2.at(&mut slave).write(40)?;
    // R01 and R00, with their Modbus addresses.
    slave.answers.insert(Object::new(0x2005, 2), -127_i32 as u32);
    assert_eq!(objects::MODES_OF_OPERATION.at(&mut slave).read()?, Mode::AnalogReference);
    objects::CONTROL_WORD.at(&mut slave).write(DriveCommand::from_raw(0x03))?;
    let expected = [
        "write 0x2005:01 [01, 00]",
        "wait 3ms",
        "read 0x2005:02, 4 bytes",
        "write 0x2006:02 [28, 00, 00, 00]",
        "write 0x2006:01 [02, 00]",
        "wait 3ms",
        "write 0x2005:01 [01, 80]",
        "wait 3ms",
        "read 0x2005:02, 4 bytes",
        "write 0x2006:02 [03, 00, 00, 00]",
        "write 0x2006:01 [00, 80]",
        "wait 3ms",
    ];
    assert_eq!(slave.log, expected);
    Ok(())
}

/// Saving: disable the axis, then write 0x11 to 0x2007. The user must check the display.
#[test]
fn saving_on_ethercat() -> Answer<()> {
    let mut drive = Eco::new(Slave::default());
    drive.controlword().write(Controlword::from_raw(0x0002))?;
    drive.save_parameters().write(0x11)?;
    assert_eq!(drive.client().log, ["write 0x6040:00 [02, 00]", "write 0x2007:00 [11]"]);
    // The mode that saves registers is not a mode of 0x6060.
    drive.client().log.clear();
    assert_eq!(
        drive.modes_of_operation().write(Mode::SaveAndLoad).map_err(Error::from),
        Err(Error::OutOfRange(OutOfRange))
    );
    assert!(drive.client().log.is_empty());
    Ok(())
}

fn logged(procedure: &[SdoWrite]) -> Vec<String> {
    let mut slave = Slave::default();
    for write in procedure {
        write.send(&mut slave).expect("it takes anything");
    }
    slave.log
}

/// The slots (section "PDO"): one PDO in each direction, and the mode. The procedure and the items write the same values.
#[test]
fn slots() -> Answer<()> {
    let slots: [(&[SdoWrite], u16, u16, Mode); 3] = [
        (&procedures::SLOT_POSITION, pdo::Position::INDEX, pdo::ActualPosition::INDEX, Mode::Positioner),
        (
            &procedures::SLOT_INTERPOLATED,
            pdo::InterpolatedPosition::INDEX,
            pdo::ActualPosition::INDEX,
            Mode::Interpolator,
        ),
        (&procedures::SLOT_VELOCITY, pdo::Velocity::INDEX, pdo::ActualVelocity::INDEX, Mode::Velocity),
    ];
    let indices = slots.map(|(_, out, back, mode)| (out, back, mode.raw()));
    assert_eq!(indices, [(0x1602, 0x1A02, 1), (0x1600, 0x1A02, 7), (0x1603, 0x1A03, 3)]);
    for (procedure, out, back, mode) in slots {
        let mut slave = Slave::default();
        rx_pdo_assign::NUMBER_OF_RX_PDOS.at(&mut slave).write(0)?;
        rx_pdo_assign::FIRST_RX_PDO.at(&mut slave).write(out)?;
        rx_pdo_assign::NUMBER_OF_RX_PDOS.at(&mut slave).write(1)?;
        tx_pdo_assign::NUMBER_OF_TX_PDOS.at(&mut slave).write(0)?;
        tx_pdo_assign::FIRST_TX_PDO.at(&mut slave).write(back)?;
        tx_pdo_assign::NUMBER_OF_TX_PDOS.at(&mut slave).write(1)?;
        objects::MODES_OF_OPERATION.at(&mut slave).write(mode)?;
        assert_eq!(logged(procedure), slave.log);
    }
    Ok(())
}

/// PDOs of the slots: two bytes of control or status, and four of a position or velocity.
#[test]
fn pdos_of_the_slots() {
    let entries = |index| {
        let pdo = DEVICE.pdos.iter().find(|pdo| pdo.index == index).expect("a PDO of the drive");
        (pdo.direction, pdo.mapping.iter().map(|entry| entry.word()).collect::<Vec<_>>())
    };
    for (index, direction, words) in [
        (0x1602, Direction::Output, [0x6040_0010, 0x607A_0020]),
        (0x1600, Direction::Output, [0x6040_0010, 0x60C1_0120]),
        (0x1603, Direction::Output, [0x6040_0010, 0x60FF_0020]),
        (0x1A02, Direction::Input, [0x6041_0010, 0x6064_0020]),
        (0x1A03, Direction::Input, [0x6041_0010, 0x606C_0020]),
    ] {
        assert_eq!(entries(index), (direction, words.to_vec()), "{index:#06X}");
    }
    let controlword = Controlword::from_raw(0x001F);
    assert_eq!(pdo::Position { controlword, target_position: 60_000 }.pack(), [0x1F, 0, 0x60, 0xEA, 0, 0]);
    assert_eq!(pdo::Velocity { controlword, target_velocity: -1000 }.pack(), [0x1F, 0, 0x18, 0xFC, 0xFF, 0xFF]);
    let back = pdo::ActualVelocity::unpack(&[0x37, 0x16, 0x18, 0xFC, 0xFF, 0xFF]).expect("six bytes");
    assert_eq!((back.statusword.raw(), back.velocity_actual_value), (0x1637, -1000));
    // The default is the interpolator slot.
    assert_eq!((image::Outputs::LEN, image::Inputs::LEN), (6, 6));
    let by_default = Assignment::<8>::by_default(&DEVICE).expect("they go together");
    assert_eq!(by_default.pdos().map(|pdo| pdo.pdo.index).collect::<Vec<_>>(), [0x1600, 0x1A02]);
}

/// The mode in separate PDOs, in addition to those of a slot.
#[test]
fn the_mode_in_a_pdo() {
    let all = [pdo::Position::INDEX, pdo::Mode::INDEX, pdo::ActualPosition::INDEX, pdo::ModeDisplay::INDEX];
    assert_eq!(all, [0x1602, 0x1601, 0x1A02, 0x1A01]);
    let mode =
        pdo::Mode { controlword: Controlword::from_raw(0x0F), modes_of_operation: Mode::CyclicSynchronousPosition };
    assert_eq!(mode.pack(), [0x0F, 0, 8, 0]);
    let shown = pdo::ModeDisplay::unpack(&[0, 0, 7, 0]).expect("four bytes");
    assert_eq!(shown.modes_of_operation_display, Mode::Interpolator);
}

#[test]
fn any_pdos_of_a_mode_are_assigned() {
    // The manual assigns sync managers to two PDOs. The others use the sync manager of their direction.
    let assigned: Result<Assignment, _> = Assignment::new(&DEVICE, &[0x1602, 0x1601, 0x1A02, 0x1A01]);
    assert!(assigned.is_ok(), "{assigned:?}");
    assert_eq!(DEVICE.pdos.len(), 8);
}

#[test]
fn what_alone_may_be_written() {
    assert_eq!(objects::SAVE_PARAMETERS.range(), &Range::OneOf(&[(0x11, 0x11)]));
}
