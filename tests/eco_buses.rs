//! Tests the bindings of the Eco drive on two buses with the manual's example of a positioner: configuration, homing,
//! positioning. The same generated code must send the bytes in "Esempio di configurazione dell'asse" on Modbus, and
//! those in "Esempio posizionamento punto a punto" on PROFINET.

use std::convert::Infallible;
use std::time::Duration;

use lexibus::profinet::{Cyclic, ImageClient, IoSpan, IoStatus, SubmoduleIo};
use lexibus::{Client, Error, Modbus, OutOfRange, Register};
use lexibus_drives::eco::objects::{self, feed_constant, homing_speeds};
use lexibus_drives::eco::types::{DriveCommand, HomingMethod, Mode, MotionProfile};

type Outcome<T> = Result<T, Error<Infallible>>;

/// The command that enables torque and motion in both examples.
const ENABLED: DriveCommand = DriveCommand::new().with_torque_enable(true).with_motion_enable(true);

/// Configures, homes and positions the drive. The client can use any bus that has these items.
macro_rules! configure_home_position {
    ($client:expr) => {{
        let client = $client;
        feed_constant::FEED_CONSTANT.at(&mut *client).write(60)?;
        objects::PROFILE_ACCELERATION.at(&mut *client).write(100)?;
        objects::PROFILE_DECELERATION.at(&mut *client).write(100)?;
        objects::PROFILE_VELOCITY.at(&mut *client).write(1000)?;
        objects::MOTION_PROFILE_TYPE.at(&mut *client).write(MotionProfile::Trapezoidal)?;
        objects::HOMING_METHOD.at(&mut *client).write(HomingMethod::MarkerBackwards)?;
        objects::HOME_OFFSET.at(&mut *client).write(0)?;
        homing_speeds::HOMING_SLOW_SPEED.at(&mut *client).write(10)?;
        objects::HOMING_ACCELERATION.at(&mut *client).write(100)?;

        objects::CONTROL_WORD.at(&mut *client).write(DriveCommand::new().with_alarm_reset(true))?;
        objects::MODES_OF_OPERATION.at(&mut *client).write(Mode::Homing)?;
        objects::CONTROL_WORD.at(&mut *client).write(ENABLED)?;
        objects::CONTROL_WORD.at(&mut *client).write(ENABLED.in_homing().with_homing(true).drive_command())?;
        while !objects::STATUS_WORD.at(&mut *client).read()?.in_homing().homing_done() {}

        objects::MODES_OF_OPERATION.at(&mut *client).write(Mode::Positioner)?;
        objects::TARGET_POSITION.at(&mut *client).write(6000)?;
        objects::CONTROL_WORD.at(&mut *client).write(ENABLED)?;
        let start = ENABLED.in_positioner().with_start_positioning(true).drive_command();
        objects::CONTROL_WORD.at(&mut *client).write(start)?;
        objects::POSITION_ACTUAL_VALUE.at(&mut *client).read()?
    }};
}

/// A simulated drive on Modbus. The simulated drive records write requests (function 16) without the CRC.
#[derive(Default)]
struct Serial {
    frames: Vec<String>,
    looked: usize,
}

impl Client for Serial {
    type Bus = Modbus;
    type Error = Infallible;

    fn read(&mut self, register: Register, buffer: &mut [u8]) -> Outcome<usize> {
        let value: u32 = match register.address {
            // The first two reads report that homing is not yet completed.
            0x8005 => {
                self.looked += 1;
                if self.looked > 2 {
                    0x40
                } else {
                    0
                }
            }
            0x8006 => 6000,
            other => panic!("0x{other:04X} is read"),
        };
        Ok(register.decode(&[(value >> 16) as u16, value as u16], buffer)?)
    }

    fn write(&mut self, register: Register, data: &[u8]) -> Outcome<()> {
        let mut words = vec![0; register.count.into()];
        register.encode(data, &mut words)?;
        let head = [register.address, register.count].into_iter().chain(words);
        let mut bytes: Vec<u8> = head.flat_map(u16::to_be_bytes).collect();
        bytes.insert(4, 2 * register.count as u8);
        bytes.splice(0..0, [0x01, 0x10]);
        self.frames.push(hex(&bytes));
        Ok(())
    }
}

fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02X}")).collect::<Vec<_>>().join(" ")
}

#[test]
fn on_modbus() -> Outcome<()> {
    let mut drive = Serial::default();
    let position = configure_home_position!(&mut drive);
    assert_eq!(position, 6000);
    let printed = [
        "01 10 80 02 00 02 04 00 00 00 3C",
        "01 10 80 0A 00 02 04 00 00 00 64",
        "01 10 80 0B 00 02 04 00 00 00 64",
        "01 10 80 0C 00 02 04 00 00 03 E8",
        "01 10 80 1B 00 02 04 00 00 00 00",
        "01 10 80 12 00 02 04 00 00 00 21",
        "01 10 80 13 00 02 04 00 00 00 00",
        "01 10 80 15 00 02 04 00 00 00 0A",
        "01 10 80 16 00 02 04 00 00 00 64",
        "01 10 80 00 00 02 04 00 00 00 08",
        "01 10 80 01 00 02 04 00 00 00 06",
        "01 10 80 00 00 02 04 00 00 00 03",
        "01 10 80 00 00 02 04 00 00 00 43",
        "01 10 80 01 00 02 04 00 00 00 01",
        "01 10 80 09 00 02 04 00 00 17 70",
        "01 10 80 00 00 02 04 00 00 00 03",
        "01 10 80 00 00 02 04 00 00 00 23",
    ];
    assert_eq!(drive.frames, printed);
    Ok(())
}

/// Saves all parameters by writing registers. Disables the torque before saving, as the manual requires.
macro_rules! save {
    ($client:expr) => {{
        let client = $client;
        objects::CONTROL_WORD.at(&mut *client).write(DriveCommand::new())?;
        objects::MODES_OF_OPERATION.at(&mut *client).write(Mode::SaveAndLoad)?;
        let save = DriveCommand::new().in_save_and_load().with_save(true).drive_command();
        objects::CONTROL_WORD.at(&mut *client).write(save)?;
    }};
}

/// Section "Primo metodo di salvataggio". The first step disables the torque, as the section "Salvataggio su flash di
/// parametri e registri" requires.
#[test]
fn saving_by_registers_on_modbus() -> Outcome<()> {
    let mut drive = Serial::default();
    save!(&mut drive);
    let printed =
        ["01 10 80 00 00 02 04 00 00 00 00", "01 10 80 01 00 02 04 FF FF FF CE", "01 10 80 00 00 02 04 00 00 00 20"];
    assert_eq!(drive.frames, printed);
    Ok(())
}

/// Section "Secondo metodo di salvataggio", with 16-bit and 32-bit access. Both items must accept only the printed
/// value.
#[test]
fn saving_by_an_address_on_modbus() -> Outcome<()> {
    let mut drive = Serial::default();
    objects::CONTROL_WORD.at(&mut drive).write(DriveCommand::new())?;
    objects::SAVE_TO_FLASH.at(&mut drive).write(0x0011)?;
    objects::SAVE_TO_FLASH_32.at(&mut drive).write(0x0000_0011)?;
    let refused = Err(Error::OutOfRange(OutOfRange));
    assert_eq!(objects::SAVE_TO_FLASH.at(&mut drive).write(0x0012).map_err(Error::from), refused);
    assert_eq!(objects::SAVE_TO_FLASH_32.at(&mut drive).write(0).map_err(Error::from), refused);
    // In this test, a write of one register also uses function 16. The test program `frames` tests function 6.
    let printed =
        ["01 10 80 00 00 02 04 00 00 00 00", "01 10 38 02 00 01 02 00 11", "01 10 38 02 00 02 04 00 00 00 11"];
    assert_eq!(drive.frames, printed);
    Ok(())
}

/// A simulated drive on PROFINET. The simulated drive records the byte offset and the content of each changed field.
struct Cyclically {
    before: [u8; 32],
    changes: Vec<(usize, String)>,
    /// The item number and the value in the window, for each cycle in which one of these two fields changed.
    pairs: Vec<String>,
}

/// Returns the positions of the 32 data bytes and their status. The positions are the same in both directions.
fn place() -> SubmoduleIo {
    let span = Some(IoSpan { offset: 0, length: 33 });
    SubmoduleIo { slot: 1, subslot: 1, inputs: span, outputs: span, inputs_consumer: None, outputs_consumer: None }
}

/// Offset and length in bytes of each output field (section "Mappatura memoria condivisa").
const FIELDS: [(usize, usize); 10] =
    [(0, 2), (2, 1), (3, 4), (8, 4), (12, 4), (16, 4), (20, 4), (24, 2), (26, 2), (28, 4)];

impl ImageClient for Cyclically {
    type Error = Infallible;

    fn cycle(&mut self, outputs: &[u8], inputs: &mut [u8]) -> Outcome<()> {
        for (at, length) in FIELDS {
            let field = at..at + length;
            if outputs[field.clone()] != self.before[field.clone()] {
                self.changes.push((at, hex(&outputs[field])));
            }
        }
        if outputs[26..32] != self.before[26..32] {
            self.pairs.push(hex(&outputs[26..32]));
        }
        self.before.copy_from_slice(&outputs[..32]);
        // The simulated drive reports completed homing as soon as homing is started, and in positioner mode. Bytes 3 to
        // 6 are the actual position.
        let done = if self.before[1] == 0x43 || self.before[2] == 1 { 0x40 } else { 0 };
        inputs[..2].copy_from_slice(&[0, done]);
        inputs[3..7].copy_from_slice(&6000_i32.to_be_bytes());
        IoStatus::GOOD.write(&mut inputs[32..]);
        Ok(())
    }

    fn wait(&mut self, _: Duration) -> Outcome<()> {
        Ok(())
    }
}

/// Returns a client of a drive that has not yet received any outputs.
fn cyclically() -> Cyclic<Cyclically, [u8; 33], [u8; 33]> {
    let drive = Cyclically { before: [0; 32], changes: Vec::new(), pairs: Vec::new() };
    let mut outputs = [0; 33];
    IoStatus::GOOD.write(&mut outputs[32..]);
    Cyclic::new(drive, place(), outputs, [0; 33])
}

/// Tests saving all parameters by writing registers through the process image. The section "Registri" lists the mode
/// for saving for all buses, but the manual prints no example for PROFINET.
#[test]
fn saving_by_registers_on_profinet() -> Outcome<()> {
    let mut drive = cyclically();
    objects::CONTROL_WORD.at(&mut drive).write(ENABLED)?;
    save!(&mut drive);
    let expected = [(0, "00 03"), (0, "00 00"), (2, "CE"), (0, "00 20")];
    let changes = &drive.image().changes;
    assert_eq!(changes.iter().map(|(at, field)| (*at, field.as_str())).collect::<Vec<_>>(), expected);
    assert!(drive.image().pairs.is_empty(), "no window is needed");
    Ok(())
}

#[test]
fn on_profinet() -> Outcome<()> {
    let mut drive = cyclically();
    let position = configure_home_position!(&mut drive);
    assert_eq!(position, 6000);
    // Items without a field in the image are accessed through the window of the image.
    let expected = [
        (26, "80 02"),
        (28, "00 00 00 3C"),
        (16, "00 00 00 64"),
        (20, "00 00 00 64"),
        (8, "00 00 03 E8"),
        (26, "80 1B"),
        (28, "00 00 00 00"),
        (26, "80 12"),
        (28, "00 00 00 21"),
        (26, "80 13"),
        (28, "00 00 00 00"),
        (26, "80 15"),
        (28, "00 00 00 0A"),
        (26, "80 16"),
        (28, "00 00 00 64"),
        (0, "00 08"),
        (2, "06"),
        (0, "00 03"),
        (0, "00 43"),
        (2, "01"),
        (3, "00 00 17 70"),
        (0, "00 03"),
        (0, "00 23"),
    ];
    let changes = &drive.image().changes;
    assert_eq!(changes.iter().map(|(at, field)| (*at, field.as_str())).collect::<Vec<_>>(), expected);
    // The item number and the value in the window must change in the same cycle. Otherwise, the drive would write the
    // value to a wrong item.
    let pairs = [
        "80 02 00 00 00 3C",
        "80 1B 00 00 00 00",
        "80 12 00 00 00 21",
        "80 13 00 00 00 00",
        "80 15 00 00 00 0A",
        "80 16 00 00 00 64",
    ];
    assert_eq!(drive.image().pairs, pairs);
    Ok(())
}

/// Tests reading parameter d1 and a register without a field through the window of the image (section "Accesso
/// asincrono a registri e parametri").
#[test]
fn what_the_image_lacks_is_read_through_its_window() -> Outcome<()> {
    struct Window;

    impl ImageClient for Window {
        type Error = Infallible;

        fn cycle(&mut self, outputs: &[u8], inputs: &mut [u8]) -> Outcome<()> {
            let value: i32 = match (outputs[24], outputs[25]) {
                (0x00, 0x01) => 80,
                (0x80, 0x1B) => -2,
                _ => 0,
            };
            inputs[16..20].copy_from_slice(&value.to_be_bytes());
            IoStatus::GOOD.write(&mut inputs[32..]);
            Ok(())
        }

        fn wait(&mut self, time: Duration) -> Outcome<()> {
            assert!(time <= Duration::from_millis(3));
            Ok(())
        }
    }

    let mut drive = Cyclic::new(Window, place(), [0; 33], [0; 33]);
    assert_eq!(objects::D1.at(&mut drive).read()?, 80);
    assert_eq!(objects::MOTION_PROFILE_TYPE.at(&mut drive).read()?, MotionProfile::SineRamp);
    Ok(())
}
