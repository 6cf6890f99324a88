//! The controller side of a PROFINET drive: start-up records, process image and PROFIdrive parameters.
//!
//!     cargo run --example profinet --features macros
//!
//! The drive is simulated in this program. Its data is invalid in one cycle. For a real drive, replace `Servo` with an
//! adapter for a controller library.

use std::collections::BTreeMap;
use std::error;
use std::thread;
use std::time::Duration;

use lexibus::profinet::parameter_access::{ParameterAccess, LOCAL};
use lexibus::profinet::{
    ImageClient, IoStatus, Plan, PnioStatus, RecordAccess, RecordAddress, RecordClient, Replacement, SubmoduleIo,
};
use lexibus::Error;

lexibus::dictionary! {
    /// A servo drive with the PROFIdrive profile.
    pub mod servo = "examples/servo.gsdml.xml";
}

use servo::submodules::module_access_point::LimitsRecord;
use servo::submodules::standard_telegram_1::{Inputs, Outputs};

/// Maximum number of consecutive cycles with invalid data.
const MOST_INVALID: u32 = 1;
/// Number of the cycle in which the simulated drive marks its data as invalid, from 0.
const FAULTY_CYCLE: u32 = 3;

type AnyResult = Result<(), Box<dyn error::Error>>;

fn main() -> AnyResult {
    let plan = Plan::<8>::with_defaults(&servo::DAP)?;
    let mut drive = Servo::new(&plan)?;
    start_up(&plan, &mut drive)?;
    records(&plan, &mut drive)?;
    parameters(&mut drive)?;
    turn(&plan, &mut drive)
}

/// Sends the start-up records once, before the data exchange starts.
fn start_up(plan: &Plan<8>, drive: &mut Servo) -> AnyResult {
    for place in plan.expected() {
        println!("slot {} subslot {:#06x}: submodule {:#06x}", place.slot, place.subslot, place.submodule_ident);
    }
    let limits = LimitsRecord { ramp_time_ms: 200, ..LimitsRecord::DEFAULT }.encode()?;
    for record in plan.records_with(&[Replacement::new(1, 1, LimitsRecord::INDEX, &limits)])? {
        println!("start-up record {} of slot {}: {:02x?}", record.index, record.slot, record.data);
        drive.write_record(record.address(), record.data)?;
    }
    Ok(())
}

/// Reads and writes a record as a struct.
fn records(plan: &Plan<8>, drive: &mut Servo) -> AnyResult {
    let axis = plan.address(1, 1).ok_or("no submodule")?;
    let mut records = RecordAccess::<_, 64>::new(drive);
    let limits = records.read::<LimitsRecord>(axis)?;
    println!("limits: {limits:?}");
    let refused = records.write(axis, &LimitsRecord { maximum_speed_rpm: 7000, ..limits });
    println!("7000 rpm: {}", refused.err().ok_or("it isn't allowed")?);
    records.write(axis, &LimitsRecord { maximum_speed_rpm: 6000, ..limits })?;
    Ok(())
}

/// Reads parameters of axis 1, which are not in the device description.
fn parameters(drive: &mut Servo) -> AnyResult {
    let mut parameters = ParameterAccess::new(drive, 1, 1);
    let telegram: u16 = parameters.read(1, 922, 0)?;
    parameters.write(1, 2000, 0, 3000.0_f32)?;
    let speed: f32 = parameters.read(1, 2000, 0)?;
    println!("telegram {telegram}, reference speed {speed} rpm");
    println!("PNU 7: {}", parameters.read::<u16>(1, 7, 0).err().ok_or("it doesn't exist")?);
    Ok(())
}

/// Switches on the axis and turns it for a few cycles. Ignores invalid data, but not for several cycles.
fn turn(plan: &Plan<8>, drive: &mut Servo) -> AnyResult {
    let axis = plan.submodule_io(1, 2).ok_or("no telegram")?;
    let (inputs_len, outputs_len) = plan.lengths();
    let (mut inputs, mut outputs) = (vec![0; inputs_len as usize], vec![0; outputs_len as usize]);
    plan.set_status(&mut outputs, IoStatus::GOOD)?;
    let mut invalid = 0;
    for cycle in 0..5 {
        let half = 1 << 13; // half of the reference speed, which is 2^14
        let data = Outputs {
            on: cycle > 0,
            no_coast_stop: true,
            no_quick_stop: true,
            enable_operation: cycle > 1,
            control_by_plc: true,
            nsoll_a: half,
        };
        axis.write(&mut outputs, data, IoStatus::GOOD)?;
        drive.cycle(&outputs, &mut inputs)?;
        let read = axis.read::<Inputs>(&inputs)?;
        if !read.provider.is_good() || !axis.consumer(&inputs).is_good() {
            invalid += 1;
            println!("cycle {cycle}: the data of the drive is invalid and is ignored");
            if invalid > MOST_INVALID {
                return Err("the drive doesn't exchange valid data".into());
            }
            continue;
        }
        invalid = 0;
        let Inputs { operation_enabled, nist_a, .. } = read.data;
        println!("cycle {cycle}: enabled {operation_enabled}, {} % of the reference speed", f32::from(nist_a) / 163.84);
    }
    Ok(())
}

/// A simulated drive with one axis. The drive delays its answers to parameter requests.
struct Servo {
    axis: SubmoduleIo,
    limits: Vec<u8>,
    parameters: BTreeMap<u16, (u8, Vec<u8>)>,
    response: Vec<u8>,
    is_ready: bool,
    speed: i16,
    cycles: u32,
}

impl Servo {
    fn new(plan: &Plan<8>) -> Result<Self, Box<dyn error::Error>> {
        let telegram = (6, vec![0, 1]);
        Ok(Self {
            axis: plan.submodule_io(1, 2).ok_or("no telegram")?,
            limits: Vec::new(),
            parameters: BTreeMap::from([(922, telegram)]),
            response: Vec::new(),
            is_ready: true,
            speed: 0,
            cycles: 0,
        })
    }

    /// Executes a request for a single parameter that is not an array.
    fn parameter_request(&mut self, request: &[u8]) {
        let [reference, kind, axis, 1, _, _, high, low, _, _, rest @ ..] = request else { return };
        let pnu = u16::from_be_bytes([*high, *low]);
        if let [format, _, value @ ..] = rest {
            self.parameters.insert(pnu, (*format, value.to_vec()));
        }
        self.response = match (self.parameters.get(&pnu), *kind) {
            (None, _) => vec![*reference, kind | 0x80, *axis, 1, 0x44, 1, 0, 0],
            (Some((format, value)), 1) => [&[*reference, 1, *axis, 1, *format, 1], &value[..]].concat(),
            _ => vec![*reference, 2, *axis, 1],
        };
        self.is_ready = false;
    }
}

impl RecordClient for Servo {
    type Error = PnioStatus;

    fn read_record(&mut self, address: RecordAddress, buffer: &mut [u8]) -> Result<usize, Error<PnioStatus>> {
        let data = match address.index {
            LimitsRecord::INDEX => &self.limits,
            LOCAL if self.is_ready => &self.response,
            LOCAL => return Err(Error::Client(PnioStatus(0xDE80_B500))),
            _ => return Err(Error::Client(PnioStatus(0xDE80_B000))),
        };
        buffer.iter_mut().zip(data).for_each(|(to, from)| *to = *from);
        Ok(data.len())
    }

    fn write_record(&mut self, address: RecordAddress, data: &[u8]) -> Result<(), Error<PnioStatus>> {
        match address.index {
            LimitsRecord::INDEX => self.limits = data.to_vec(),
            LOCAL => self.parameter_request(data),
            _ => return Err(Error::Client(PnioStatus(0xDF80_B000))),
        }
        Ok(())
    }

    fn is_busy(&self, error: &PnioStatus) -> bool {
        error.is_busy()
    }

    fn pause(&mut self) {
        thread::sleep(Duration::from_millis(1));
        self.is_ready = true;
    }
}

impl ImageClient for Servo {
    type Error = PnioStatus;

    fn cycle(&mut self, outputs: &[u8], inputs: &mut [u8]) -> Result<(), Error<PnioStatus>> {
        let axis = self.axis.of_device();
        let outputs = axis.read::<Outputs>(outputs)?;
        let order = outputs.data;
        let is_enabled = outputs.provider.is_good() && order.on && order.enable_operation;
        self.speed = if is_enabled { self.speed + (order.nsoll_a - self.speed) / 2 } else { 0 };
        let data = Inputs {
            ready_to_switch_on: true,
            operation_enabled: is_enabled,
            fault: false,
            control_requested: true,
            nist_a: self.speed,
        };
        let status = if self.cycles == FAULTY_CYCLE { IoStatus::BAD } else { IoStatus::GOOD };
        self.cycles += 1;
        axis.write(inputs, data, status)?;
        Ok(axis.set_consumer(inputs, outputs.provider)?)
    }
}
