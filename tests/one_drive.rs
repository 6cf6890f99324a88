//! Tests the bindings of one device on several buses. The accessors that are generated from `data/one-drive.toml` use objects,
//! windows, registers and a process image.

#![cfg(all(feature = "macros", feature = "std"))]

use std::convert::Infallible;
use std::future::Future;
use std::pin::pin;
use std::task::{Context, Poll, Waker};
use std::time::Duration;

use lexibus::profinet::{AsyncImageClient, Cyclic, ImageClient, IoSpan, IoStatus, SubmoduleIo};
use lexibus::sim::Device;
use lexibus::{
    AbortCode, AsyncClient, Axes, Axis, AxisRange, AxisStep, CanOpen, Client, CoE, Error, Esc, EscMemory, Modbus,
    Object, OutOfRange, Timed,
};

lexibus::dictionary! {
    /// A fictitious drive.
    #[allow(deprecated)]
    pub mod one = "tests/data/one-drive.toml" { table: true }
}

use one::types::Modes;
use one::{objects, OneDrive, ENTRIES};

/// Returns the result of a future that must be ready immediately.
fn now<F: Future>(future: F) -> F::Output {
    struct Silent;
    impl std::task::Wake for Silent {
        fn wake(self: std::sync::Arc<Self>) {}
    }
    let waker = Waker::from(std::sync::Arc::new(Silent));
    match pin!(future).poll(&mut Context::from_waker(&waker)) {
        Poll::Ready(output) => output,
        Poll::Pending => panic!("the future is not ready"),
    }
}

/// Returns a simulated drive on CANopen. Three registers can be read through a window, and one of them can be written through
/// another window.
fn node() -> Device {
    let mut device = Device::new(ENTRIES);
    device
        .on_write(objects::reading::READ_ADDRESS, |device, number| {
            let value = match number {
                0x8001 => device.get(objects::MODE)?.raw(),
                0x8017 => i32::from(device.get(objects::MASTER_SPEED)?),
                0x8033 => device.get(objects::GAIN)? as i32,
                _ => return Err(AbortCode::INVALID_VALUE),
            };
            device.set(objects::reading::READ_VALUE, value)?;
            device.set(objects::reading::READ_ADDRESS, 0)
        })
        .unwrap();
    device
        .on_write(objects::writing::WRITE_ADDRESS, |device, number| {
            let value = device.get(objects::writing::WRITE_VALUE)?;
            match number {
                0x8033 => device.set(objects::GAIN, value as u32)?,
                _ => return Err(AbortCode::INVALID_VALUE),
            }
            device.set(objects::writing::WRITE_ADDRESS, 0)
        })
        .unwrap();
    device
}

#[test]
fn windows_are_as_addresses() {
    let mut device = node();
    device.set(objects::MASTER_SPEED, -5).unwrap();
    let mut drive = OneDrive::new(device.client::<CanOpen>());
    drive.gain().write(70_000).unwrap();
    assert_eq!(drive.gain().read(), Ok(70_000));
    assert_eq!(drive.master_speed().read(), Ok(-5));
    now(drive.gain().write_async(70_001)).unwrap();
    assert_eq!(now(drive.gain().read_async()), Ok(70_001));
    // An accessor that uses the window also checks the range of the item.
    assert_eq!(drive.gain().write(100_001).map_err(Error::from), Err(Error::OutOfRange(OutOfRange)));
    // An item that has its own object must not use the window.
    drive.target_position().write(60_000).unwrap();
    assert_eq!(device.bytes(Object::new(0x607A, 0)), Ok(60_000_i32.to_le_bytes().as_slice()));
    assert_eq!(device.bytes(Object::new(0x2006, 2)), Ok(70_001_i32.to_le_bytes().as_slice()));
}

#[test]
fn what_the_device_refuses_comes_through_a_window() {
    let mut device = node();
    device.fail_next(AbortCode::HARDWARE);
    assert_eq!(
        OneDrive::new(device.client::<CanOpen>()).gain().read().map_err(Error::from),
        Err(Error::Abort(AbortCode::HARDWARE))
    );
    // The device never clears the number in the window.
    let mut dead = Device::new(ENTRIES);
    assert_eq!(OneDrive::new(dead.client::<CanOpen>()).gain().read().map_err(Error::from), Err(Error::Timeout));
    assert_eq!(
        now(OneDrive::new(dead.client::<CanOpen>()).gain().read_async()).map_err(Error::from),
        Err(Error::Timeout)
    );
    assert_eq!(OneDrive::new(dead.client::<CanOpen>()).gain().write(1).map_err(Error::from), Err(Error::Timeout));
}

#[test]
fn a_window_of_bytes_takes_what_fits() {
    let mut device = Device::new(ENTRIES);
    device
        .on_write(objects::parameter_window::PARAMETER_WRITE, |device, number| {
            let value = device.get(objects::parameter_window::PARAMETER_WRITE_VALUE)?;
            assert_eq!((number, value), (58, 199));
            device.set(objects::parameter_window::PARAMETER_WRITE, 0)
        })
        .unwrap();
    device
        .on_write(objects::parameter_window::PARAMETER_READ, |device, number| {
            device.set(objects::parameter_window::PARAMETER_READ_VALUE, number + 150)?;
            device.set(objects::parameter_window::PARAMETER_READ, 0)
        })
        .unwrap();
    let mut drive = OneDrive::new(device.client::<CanOpen>());
    drive.station().write(199).unwrap();
    assert_eq!(drive.station().read(), Ok(208));
    assert_eq!(drive.station().write(201).map_err(Error::from), Err(Error::OutOfRange(OutOfRange)));
}

/// A simulated drive on EtherCAT that logs all accesses.
#[derive(Default)]
struct Slave {
    log: Vec<String>,
    mode: [u8; 2],
}

impl Client for Slave {
    type Bus = CoE;
    type Error = Infallible;

    fn read(&mut self, object: Object, buffer: &mut [u8]) -> Result<usize, Error<Infallible>> {
        self.log.push(format!("read {object}, {} bytes", buffer.len()));
        match object.index {
            0x6060 => buffer.copy_from_slice(&self.mode),
            _ => buffer.fill(0xFF),
        }
        Ok(buffer.len())
    }

    fn write(&mut self, object: Object, data: &[u8]) -> Result<(), Error<Infallible>> {
        self.log.push(format!("write {object} {data:02X?}"));
        if object.index == 0x6060 {
            self.mode.copy_from_slice(data);
        }
        Ok(())
    }

    fn wait(&mut self, time: Duration) -> Result<(), Error<Infallible>> {
        self.log.push(format!("wait {time:?}"));
        Ok(())
    }
}

impl AsyncClient for Slave {
    type Bus = CoE;
    type Error = Infallible;

    async fn read(&mut self, object: Object, buffer: &mut [u8]) -> Result<usize, Error<Infallible>> {
        Client::read(self, object, buffer)
    }

    async fn write(&mut self, object: Object, data: &[u8]) -> Result<(), Error<Infallible>> {
        Client::write(self, object, data)
    }
}

#[test]
fn the_same_window_in_another_order() {
    let mut drive = OneDrive::new(Slave::default());
    drive.gain().write(0x1_0203).unwrap();
    let log = std::mem::take(&mut drive.client().log);
    assert_eq!(log, ["write 0x2006:01 [33, 80]", "write 0x2006:02 [03, 02, 01, 00]", "wait 3ms"]);
    assert_eq!(drive.master_speed().read(), Ok(-1));
    let log = std::mem::take(&mut drive.client().log);
    assert_eq!(log, ["write 0x2005:01 [17, 80]", "wait 3ms", "read 0x2005:02, 4 bytes"]);
}

#[test]
fn each_axis_has_its_windows() {
    static AXES: Axes = Axes {
        count: 2,
        ranges: &[
            AxisRange { first: 0x2005, last: 0x2005, step: AxisStep::SubIndexStride(2) },
            AxisRange { first: 0x6000, last: 0x67FF, step: AxisStep::Index(0x800) },
        ],
        shared: &[],
    };
    let mut slave = Slave::default();
    let mut drive = OneDrive::new(Axis::new(&mut slave, &AXES, 2));
    assert_eq!(drive.master_speed().read(), Ok(-1));
    drive.target_position().write(1).unwrap();
    let mut third = OneDrive::new(Axis::new(&mut slave, &AXES, 3));
    assert!(matches!(third.master_speed().read().map_err(Error::from), Err(Error::NoSuchAxis { axis: 3, .. })));
    assert_eq!(
        slave.log,
        ["write 0x2005:03 [17, 80]", "wait 3ms", "read 0x2005:04, 4 bytes", "write 0x687A:00 [01, 00, 00, 00]"]
    );
}

#[test]
fn time_has_to_come_from_somewhere() {
    let mut drive = OneDrive::new(Slave::default());
    assert_eq!(now(drive.gain().read_async()).map_err(Error::from), Err(Error::NoClock));
    let mut waited = Duration::ZERO;
    let clock = |time| {
        waited += time;
        std::future::ready(())
    };
    let mut drive = OneDrive::new(Timed::new(Slave::default(), clock));
    assert_eq!(now(drive.master_speed().read_async()), Ok(-1));
    assert_eq!(drive.into_client().into_client().log.len(), 2);
    assert_eq!(waited, Duration::from_millis(3));
}

#[test]
fn each_bus_has_its_own_width() {
    // The item has 16 bits on EtherCAT.
    let mut drive = OneDrive::new(Slave::default());
    drive.mode().write(Modes::SaveParameters).unwrap();
    assert_eq!(drive.client().log, ["write 0x6060:00 [CE, FF]"]);
    assert_eq!(drive.mode().read(), Ok(Modes::SaveParameters));
    // The item has 8 bits on CANopen. On CANopen, the mode for saving does not exist, and reads use the window.
    let mut device = node();
    let mut drive = OneDrive::new(device.client::<CanOpen>());
    assert_eq!(drive.mode().write(Modes::SaveParameters).map_err(Error::from), Err(Error::OutOfRange(OutOfRange)));
    drive.mode().write(Modes::Torque).unwrap();
    assert_eq!(drive.mode().read(), Ok(Modes::Torque));
    assert_eq!(device.bytes(Object::new(0x6060, 0)), Ok([0xFF].as_slice()));
    // The item has 32 bits on Modbus.
    let mut drive = OneDrive::new(device.client::<Modbus>());
    drive.mode().write(Modes::SaveParameters).unwrap();
    assert_eq!(drive.mode().read(), Ok(Modes::SaveParameters));
    assert_eq!(device.bytes(objects::MODE.location().modbus), Ok((-50_i32).to_le_bytes().as_slice()));
}

/// A simulated drive with a process image of 16 bytes in each direction. Its parameter channel answers in the second
/// cycle that contains the same request.
#[derive(Default)]
struct Controller {
    cycles: usize,
    asked: Option<u16>,
    gain: i32,
    /// All values that were written to the gain.
    gains: Vec<i32>,
    is_bad: bool,
}

impl Controller {
    fn exchange(&mut self, outputs: &[u8], inputs: &mut [u8]) {
        self.cycles += 1;
        let number = |at: usize| u16::from_be_bytes([outputs[at], outputs[at + 1]]);
        let value = i32::from_be_bytes(outputs[9..13].try_into().unwrap());
        if number(7) == 0x8033 {
            self.gain = value;
            self.gains.push(value);
        }
        inputs.fill(0);
        // The actual position equals the target position.
        inputs[1..5].copy_from_slice(&outputs[1..5]);
        inputs[9..11].copy_from_slice(&(-300_i16).to_be_bytes());
        inputs[11] = 0b1000;
        inputs[16] = if self.is_bad { 0 } else { 0x80 };
        if let Some(asked) = self.asked.replace(number(5)).filter(|asked| *asked == number(5)) {
            let answer = match asked {
                0x8033 => self.gain,
                0x8001 => i32::from(outputs[0] as i8),
                _ => 0,
            };
            inputs[5..9].copy_from_slice(&answer.to_be_bytes());
        }
    }
}

impl ImageClient for Controller {
    type Error = Infallible;

    fn cycle(&mut self, outputs: &[u8], inputs: &mut [u8]) -> Result<(), Error<Infallible>> {
        self.exchange(outputs, inputs);
        Ok(())
    }
}

impl AsyncImageClient for Controller {
    type Error = Infallible;

    async fn cycle(&mut self, outputs: &[u8], inputs: &mut [u8]) -> Result<(), Error<Infallible>> {
        self.exchange(outputs, inputs);
        Ok(())
    }

    async fn wait(&mut self, _: Duration) -> Result<(), Error<Infallible>> {
        Ok(())
    }
}

type Image = Cyclic<Controller, [u8; 17], [u8; 17]>;

fn image() -> OneDrive<Image> {
    let span = Some(IoSpan { offset: 0, length: 17 });
    let place =
        SubmoduleIo { slot: 1, subslot: 1, inputs: span, outputs: span, inputs_consumer: None, outputs_consumer: None };
    let mut outputs = [0; 17];
    IoStatus::GOOD.write(&mut outputs[16..]);
    OneDrive::new(Cyclic::new(Controller::default(), place, outputs, [0; 17]))
}

#[test]
fn the_image_is_a_bus() {
    let mut drive = image();
    drive.target_position().write(-2).unwrap();
    assert_eq!(drive.client().outputs()[..6], [0, 0xFF, 0xFF, 0xFF, 0xFE, 0]);
    assert_eq!((drive.actual_position().read(), drive.torque().read()), (Ok(-2), Ok(-300)));
    assert_eq!((drive.ready().read(), drive.alarm().read()), (Ok(true), Ok(0)));
    drive.mode().write(Modes::SaveParameters).unwrap();
    assert_eq!(drive.client().outputs()[0], 0xCE);
    // An item whose field is only in the outputs is read through the parameter channel. An item without a field uses
    // the channel for reading and writing.
    assert_eq!(drive.mode().read(), Ok(Modes::SaveParameters));
    drive.gain().write(70_000).unwrap();
    assert_eq!(drive.gain().read(), Ok(70_000));
    assert_eq!(now(drive.gain().read_async()), Ok(70_000));
    // No cycle may combine the number of one item with the value of another item.
    assert!(drive.client().image().gains.iter().all(|gain| *gain == 70_000));
    now(drive.gain().write_async(70_001)).unwrap();
    assert_eq!(drive.client().image().gain, 70_001);
    assert_eq!(now(drive.torque().read_async()), Ok(-300));
}

#[test]
fn fields_of_one_cycle_go_out_together() {
    let mut drive = OneDrive::new(image().into_client().by_hand());
    drive.target_position().write(5).unwrap();
    drive.mode().write(Modes::Position).unwrap();
    assert_eq!(drive.client().image().cycles, 0);
    drive.client().cycle().unwrap();
    assert_eq!((drive.actual_position().read(), drive.client().image().cycles), (Ok(5), 1));
    // An access through the window takes several cycles. The cycles must continue during the access.
    drive.gain().write(9).unwrap();
    assert_eq!((drive.gain().read(), drive.client().image().cycles), (Ok(9), 9));
}

#[test]
fn data_that_are_not_valid_are_no_data() {
    let mut drive = image();
    drive.client().image().is_bad = true;
    assert_eq!(drive.torque().read().map_err(Error::from), Err(Error::InvalidData));
    drive.target_position().write(1).unwrap();
}

/// The memory of a simulated slave controller.
struct Memory([u8; 0x200]);

impl Client for Memory {
    type Bus = Esc;
    type Error = Infallible;

    fn read(&mut self, memory: EscMemory, buffer: &mut [u8]) -> Result<usize, Error<Infallible>> {
        let bytes = &self.0[usize::from(memory.address)..][..usize::from(memory.length)];
        buffer.copy_from_slice(bytes);
        Ok(bytes.len())
    }

    fn write(&mut self, memory: EscMemory, data: &[u8]) -> Result<(), Error<Infallible>> {
        self.0[usize::from(memory.address)..][..usize::from(memory.length)].copy_from_slice(data);
        Ok(())
    }
}

#[test]
fn slave_controllers_have_memory() {
    let mut drive = OneDrive::new(Memory([0; 0x200]));
    drive.al_control().write(0x0008).unwrap();
    drive.client().0[0x130] = 8;
    assert_eq!((drive.al_control().read(), drive.al_status().read()), (Ok(8), Ok(8)));
}
