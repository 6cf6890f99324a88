//! A controller's side of PROFINET with a simulated device: typed records, items within records, process images, and
//! parameters of PROFIdrive.
#![cfg(feature = "macros")]

use std::collections::HashMap;
use std::future::Future;
use std::pin::pin;
use std::sync::Arc;
use std::task::{Context, Poll, Wake};

use lexibus::profinet::parameter_access::{
    change_request, read_request, Answer, Change, ErrorNumber, Format, ParameterAccess, ParameterAddress,
    ParameterError, ParameterValue, Refusal, API, GLOBAL, LOCAL,
};
use lexibus::profinet::{
    AsyncImageClient, AsyncRecordClient, FTrailer, ImageClient, IoObject, IoPlace, IoSpan, IoStatus, NotAllowed, Plan,
    PnioStatus, RecordAccess, RecordAddress, RecordClient, SubmoduleAddress,
};
use lexibus::{AbortCode, Error, Flags, Initial, Item, LengthError, OnProfinet, Range, Record, Rw, VisibleString};

lexibus::dictionary! {
    /// A station with a PROFIsafe module.
    pub mod safe = "tests/data/safe.gsdml.xml";
}

lexibus::dictionary! {
    /// A servo drive that follows PROFIdrive.
    pub mod drive = "tests/data/drive.gsdml.xml";
}

use safe::submodules::safe_inputs::{InputFilterRecord, Inputs, Outputs};
use safe::values::VMode;

const INPUTS: SubmoduleAddress = SubmoduleAddress::new(0, 2, 1);
const INVALID_INDEX: PnioStatus = PnioStatus(0xDE80_B000);
const STATE_CONFLICT: PnioStatus = PnioStatus(0xDE80_B500);

/// A device in memory: its records, and what a drive would do with those of parameters.
#[derive(Default)]
struct Device {
    records: HashMap<RecordAddress, Vec<u8>>,
    writes: Vec<(RecordAddress, Vec<u8>)>,
    drive: Drive,
    pauses: u32,
}

/// Parameters by axis, number and subindex, with format and bytes; a limit of 3000 for parameter 100.
#[derive(Default)]
struct Drive {
    values: HashMap<(u8, u16, u16), (Format, Vec<u8>)>,
    response: Vec<u8>,
    /// So often the response isn't there yet.
    delay: u32,
    /// Whether it is an empty record meanwhile, and no error.
    is_empty: bool,
}

impl Drive {
    fn request(&mut self, request: &[u8]) {
        let (kind, axis, count) = (request[1], request[2], usize::from(request[3]));
        let addresses = request[4..].chunks_exact(6).take(count);
        let mut values = &request[4 + 6 * count..];
        let (mut answers, mut is_negative) = (Vec::new(), false);
        for address in addresses {
            let (pnu, first) =
                (u16::from_be_bytes([address[2], address[3]]), u16::from_be_bytes([address[4], address[5]]));
            let subindices = first..first + u16::from(address[1]);
            let answer = match kind {
                1 => self.read(axis, pnu, subindices),
                _ => {
                    let size = Format(values[0]).size().expect("a known format");
                    let (own, rest) = values[2..].split_at(size * usize::from(values[1]));
                    let answer = self.change(axis, pnu, subindices, (Format(values[0]), own));
                    values = &rest[own.len() % 2..];
                    answer
                }
            };
            is_negative |= answer.is_err();
            let mut answer = answer.unwrap_or_else(|(number, at)| vec![0x44, 2, 0, number, 0, at]);
            answer.resize(answer.len().next_multiple_of(2), 0);
            answers.extend(answer);
        }
        self.response = vec![request[0], kind | if is_negative { 0x80 } else { 0 }, axis, request[3]];
        if kind == 1 || is_negative {
            self.response.extend(answers);
        }
    }

    fn read(&self, axis: u8, pnu: u16, subindices: std::ops::Range<u16>) -> Result<Vec<u8>, (u8, u8)> {
        let mut answer = vec![0, subindices.len() as u8];
        for subindex in subindices {
            let (format, bytes) = self.values.get(&(axis, pnu, subindex)).ok_or((3, subindex as u8))?;
            answer[0] = format.0;
            answer.extend(bytes);
        }
        Ok(answer)
    }

    fn change(
        &mut self,
        axis: u8,
        pnu: u16,
        subindices: std::ops::Range<u16>,
        (format, bytes): (Format, &[u8]),
    ) -> Result<Vec<u8>, (u8, u8)> {
        if pnu == 100 && bytes > &3000_u16.to_be_bytes()[..] {
            return Err((2, 0));
        }
        let size = format.size().expect("a known format");
        for (subindex, bytes) in subindices.zip(bytes.chunks(size)) {
            self.values.insert((axis, pnu, subindex), (format, bytes.to_vec()));
        }
        Ok(vec![0x40, 0])
    }
}

impl Device {
    fn with_parameters(values: &[(u8, u16, u16, Format, &[u8])]) -> Self {
        let mut device = Self::default();
        let entries =
            values.iter().map(|(axis, pnu, sub, format, bytes)| ((*axis, *pnu, *sub), (*format, bytes.to_vec())));
        device.drive.values.extend(entries);
        device
    }
}

impl RecordClient for Device {
    type Error = PnioStatus;

    fn read_record(&mut self, address: RecordAddress, buffer: &mut [u8]) -> Result<usize, Error<PnioStatus>> {
        let data = match address.index {
            LOCAL | GLOBAL if self.drive.delay > 0 => {
                self.drive.delay -= 1;
                return if self.drive.is_empty { Ok(0) } else { Err(Error::Client(STATE_CONFLICT)) };
            }
            LOCAL | GLOBAL => &self.drive.response,
            _ => self.records.get(&address).ok_or(Error::Client(INVALID_INDEX))?,
        };
        // What is too long is cut: its length says so.
        buffer.iter_mut().zip(data).for_each(|(to, from)| *to = *from);
        Ok(data.len())
    }

    fn write_record(&mut self, address: RecordAddress, data: &[u8]) -> Result<(), Error<PnioStatus>> {
        self.writes.push((address, data.to_vec()));
        match address.index {
            LOCAL | GLOBAL => self.drive.request(data),
            _ => drop(self.records.insert(address, data.to_vec())),
        }
        Ok(())
    }

    fn is_busy(&self, error: &PnioStatus) -> bool {
        error.is_busy()
    }

    fn pause(&mut self) {
        self.pauses += 1;
    }
}

/// The same without blocking.
struct Async(Device);

impl AsyncRecordClient for Async {
    type Error = PnioStatus;

    async fn read_record(&mut self, address: RecordAddress, buffer: &mut [u8]) -> Result<usize, Error<PnioStatus>> {
        self.0.read_record(address, buffer)
    }

    async fn write_record(&mut self, address: RecordAddress, data: &[u8]) -> Result<(), Error<PnioStatus>> {
        self.0.write_record(address, data)
    }

    fn is_busy(&self, error: &PnioStatus) -> bool {
        error.is_busy()
    }

    async fn pause(&mut self) {
        self.0.pause();
    }
}

fn now<F: Future>(future: F) -> F::Output {
    struct Silent;
    impl Wake for Silent {
        fn wake(self: Arc<Self>) {}
    }
    let waker = Arc::new(Silent).into();
    match pin!(future).poll(&mut Context::from_waker(&waker)) {
        Poll::Ready(output) => output,
        Poll::Pending => panic!("the future waits"),
    }
}

const FILTER: InputFilterRecord = InputFilterRecord { mode: VMode::Long, invert: false, gain: 10.0 };
const FILTER_BYTES: [u8; 9] = [0x5A, 0x01, 0x06, 0x41, 0x20, 0x00, 0x00, 0xEE, 0x07];

#[test]
fn records_as_structs() {
    let mut device = Device::default();
    let mut records = RecordAccess::<_, 16>::new(&mut device);
    records.write(INPUTS, &FILTER).unwrap();
    assert_eq!(records.read::<InputFilterRecord>(INPUTS), Ok(FILTER));
    let elsewhere = SubmoduleAddress::new(0, 3, 1);
    assert_eq!(records.read::<InputFilterRecord>(elsewhere), Err(Error::Client(INVALID_INDEX)));
    let refused = records.write(INPUTS, &InputFilterRecord { gain: 0.25, ..FILTER });
    assert_eq!(refused, Err(Error::NotAllowed(NotAllowed { field: "Gain" })));
    let address = INPUTS.record(InputFilterRecord::INDEX);
    assert_eq!(device.writes, [(address, FILTER_BYTES.to_vec())], "what isn't allowed isn't sent");

    // A device whose record is too short, and one whose is too long for the buffer.
    for (length, expected) in [(8, 9), (17, 16)] {
        device.records.insert(address, vec![0; length]);
        let read = RecordAccess::<_, 16>::new(&mut device).read::<InputFilterRecord>(INPUTS);
        assert_eq!(read, Err(Error::Length(LengthError::new(expected, length))));
    }
}

#[test]
fn records_without_blocking() {
    now(async {
        let mut records = RecordAccess::<_, 9>::new(Async(Device::default()));
        records.write_async(INPUTS, &FILTER).await.unwrap();
        assert_eq!(records.read_async::<InputFilterRecord>(INPUTS).await, Ok(FILTER));
        assert_eq!(records.into_client().0.records[&INPUTS.record(2)], FILTER_BYTES);
    });
}

const fn part(offset: u16) -> Record {
    Record::new(2, 1, InputFilterRecord::INDEX, offset)
}

const fn item<V: lexibus::Value>(place: Record, name: &'static str) -> Item<V, Rw, OnProfinet> {
    Item::new(OnProfinet::record(place), name, Range::Full, Initial::Unknown, "", Flags::NONE)
}

const GAIN: Item<f32, Rw, OnProfinet> = item(part(3), "Gain");
const LAST: Item<u16, Rw, OnProfinet> = item(part(7), "Last");
const BEHIND: Item<u16, Rw, OnProfinet> = item(part(8), "Behind");
const NAME: Item<VisibleString, Rw, OnProfinet> = item(part(2).bytes(), "Name");

#[test]
fn items_are_parts_of_records() {
    let mut device = Device::default();
    let address = INPUTS.record(InputFilterRecord::INDEX);
    device.records.insert(address, FILTER_BYTES.to_vec());
    let mut records = RecordAccess::<_, 16>::new(&mut device);
    assert_eq!((GAIN.at(&mut records).read(), LAST.at(&mut records).read()), (Ok(10.0), Ok(0xEE07)));
    GAIN.at(&mut records).write(1.5).unwrap();
    let beyond = Err(Error::Length(LengthError::new(10, 9)));
    assert_eq!(BEHIND.at(&mut records).read(), beyond);
    assert_eq!(BEHIND.at(&mut records).write(1), beyond.map(drop));
    NAME.at(&mut records).write("ab").unwrap();
    let mut text = [0; 2];
    assert_eq!(NAME.at(&mut records).read_into(&mut text), Ok("ab"));
    assert_eq!(device.records[&address], [0x5A, 0x01, b'a', b'b', 0xC0, 0x00, 0x00, 0xEE, 0x07]);

    let mut records = RecordAccess::<_, 16>::new(Async(device));
    now(async {
        LAST.at(&mut records).write_async(0x1234).await.unwrap();
        assert_eq!(LAST.at(&mut records).read_async().await, Ok(0x1234));
    });
    assert_eq!(records.client().0.records[&address][7..], [0x12, 0x34]);
}

#[test]
fn start_up_records_have_their_addresses() {
    let mut plan = Plan::<8>::new(&safe::DAP).unwrap();
    plan.plug(2, &safe::modules::safe_inputs::MODULE).unwrap();
    assert_eq!((plan.address(2, 1), plan.address(2, 2)), (Some(INPUTS), None));
    let mut device = Device::default();
    for record in plan.records() {
        device.write_record(record.address(), record.data).unwrap();
    }
    let written: Vec<_> = device.writes.iter().map(|(address, data)| (*address, data.len())).collect();
    assert_eq!(written, [(INPUTS.record(2), 9), (INPUTS.record(0x100), 10)]);
}

#[test]
fn places_in_the_frames() {
    let mut plan = Plan::<8>::new(&safe::DAP).unwrap();
    plan.plug(2, &safe::modules::safe_inputs::MODULE).unwrap();
    // Head, interface and port have a provider status each, and get a consumer status each.
    let span = |offset, length| Some(IoSpan { offset, length });
    let module = plan.io_place(2, 1).unwrap();
    let place = IoPlace {
        slot: 2,
        subslot: 1,
        inputs: span(3, 8),
        outputs: span(4, 6),
        inputs_consumer: span(3, 1),
        outputs_consumer: span(11, 1),
    };
    assert_eq!(module, place);
    assert_eq!(plan.lengths(), (12, 10));
    assert_eq!(plan.io_place(3, 1), None);

    let mut outputs = [0; 10];
    plan.set_status(&mut outputs, IoStatus::GOOD).unwrap();
    assert_eq!(outputs, [0x80, 0x80, 0x80, 0x80, 0, 0, 0, 0, 0, 0x80]);
    module.write(&mut outputs, Outputs { command: 0x5A }, IoStatus::BAD).unwrap();
    module.set_consumer(&mut outputs, IoStatus::BAD).unwrap();
    assert_eq!(outputs, [0x80, 0x80, 0x80, 0, 0x5A, 0, 0, 0, 0, 0]);

    let inputs = [0x80, 0x80, 0x80, 0x09, 0xFF, 0xFE, 0x20, 0xA1, 0xB2, 0xC3, 0x80, 0x80];
    let read = module.read::<Inputs>(&inputs).unwrap();
    assert_eq!((read.data.speed, read.provider, module.consumer(&inputs)), (-2, IoStatus::GOOD, IoStatus::GOOD));
    let trailer = IoObject::of::<Inputs>(&inputs[3..]).unwrap().trailer;
    assert_eq!(FTrailer::from_bytes(trailer).map(|trailer| trailer.status), Ok(0x20));

    // Frames that are too short, data of another submodule, and a submodule without outputs.
    assert_eq!(module.read::<Inputs>(&inputs[..10]), Err(LengthError::new(11, 10)));
    assert_eq!(module.consumer(&inputs[..11]), IoStatus::BAD);
    assert_eq!(module.set_consumer(&mut outputs[..3], IoStatus::GOOD), Err(LengthError::new(4, 3)));
    assert!(plan.set_status(&mut outputs[..9], IoStatus::GOOD).is_err());
    type Telegram = drive::submodules::standard_telegram_1::Inputs;
    assert_eq!(module.read::<Telegram>(&inputs), Err(LengthError::new(5, 8)));
    let head = plan.io_place(0, 1).unwrap();
    assert_eq!(head.write(&mut outputs, Outputs { command: 0 }, IoStatus::GOOD), Err(LengthError::new(6, 0)));
}

#[test]
fn layouts_are_as_long_as_a_plan_says() {
    for plan in [Plan::<8>::with_defaults(&safe::DAP).unwrap(), Plan::with_defaults(&drive::DAP).unwrap()] {
        let (mut inputs, mut outputs) = (0, 0);
        for place in plan.layout() {
            for span in [place.inputs, place.outputs_consumer].into_iter().flatten() {
                assert_eq!(span.offset, inputs);
                inputs += span.length;
            }
            for span in [place.inputs_consumer, place.outputs].into_iter().flatten() {
                assert_eq!(span.offset, outputs);
                outputs += span.length;
            }
        }
        assert_eq!((inputs as u32, outputs as u32), plan.lengths());
    }
}

/// A device that sends back what it gets.
struct Mirror;

impl ImageClient for Mirror {
    type Error = PnioStatus;

    fn cycle(&mut self, outputs: &[u8], inputs: &mut [u8]) -> Result<(), Error<PnioStatus>> {
        inputs.iter_mut().zip(outputs).for_each(|(to, from)| *to = *from);
        Ok(())
    }
}

impl AsyncImageClient for Mirror {
    type Error = PnioStatus;

    async fn cycle(&mut self, outputs: &[u8], inputs: &mut [u8]) -> Result<(), Error<PnioStatus>> {
        ImageClient::cycle(self, outputs, inputs)
    }
}

#[test]
fn borrowed_image_clients() {
    fn cycle(mut client: impl ImageClient<Error = PnioStatus>, inputs: &mut [u8]) -> Result<(), Error<PnioStatus>> {
        client.cycle(&[1, 2], inputs)
    }
    async fn cycle_async(mut client: impl AsyncImageClient, inputs: &mut [u8]) -> bool {
        client.cycle(&[3, 4], inputs).await.is_ok()
    }
    let mut inputs = [0; 2];
    cycle(&mut Mirror, &mut inputs).unwrap();
    assert_eq!(inputs, [1, 2]);
    assert!(now(cycle_async(&mut Mirror, &mut inputs)));
    assert_eq!(inputs, [3, 4]);
}

#[test]
fn parameters_byte_by_byte() {
    let mut device = Device::with_parameters(&[(2, 953, 0, Format::UNSIGNED16, &[0x12, 0x34])]);
    let mut parameters = ParameterAccess::new(&mut device, 2, 1);
    assert_eq!(parameters.read::<u16>(2, 953, 0), Ok(0x1234));
    parameters.write(2, 100, 0, 3000_u16).unwrap();
    let record = SubmoduleAddress::new(API, 2, 1).record(0xB02E);
    let read = vec![0x01, 0x01, 2, 1, 0x10, 1, 0x03, 0xB9, 0, 0];
    let change = vec![0x02, 0x02, 2, 1, 0x10, 1, 0x00, 0x64, 0, 0, 0x06, 1, 0x0B, 0xB8];
    assert_eq!(device.writes, [(record, read), (record, change)]);
    assert_eq!(device.drive.response, [0x02, 0x02, 2, 1]);
    assert_eq!(device.pauses, 0);
}

#[test]
fn every_type_comes_back() {
    fn there_and_back<T: ParameterValue + Copy + PartialEq + std::fmt::Debug>(values: &mut [T]) {
        let own = values.to_vec();
        let mut parameters = ParameterAccess::new(Device::default(), 1, 1);
        parameters.write_array(1, 2000, 5, values).unwrap();
        values.reverse();
        parameters.read_array(1, 2000, 5, values).unwrap();
        assert_eq!(values, own);
        assert_eq!(parameters.read::<T>(1, 2000, 6), Ok(own[1]));
        now(async {
            let mut parameters = ParameterAccess::new(Async(parameters.into_client()), 1, 1);
            parameters.write_async(1, 2000, 6, own[2]).await.unwrap();
            parameters.write_array_async(1, 2000, 8, &own[..2]).await.unwrap();
            assert_eq!(parameters.read_async::<T>(1, 2000, 6).await, Ok(own[2]));
            parameters.read_array_async(1, 2000, 8, &mut values[1..]).await.unwrap();
        });
        assert_eq!(values[1..], own[..2]);
    }
    there_and_back(&mut [true, false, false]);
    there_and_back(&mut [u8::MAX, 0, 7]);
    there_and_back(&mut [u16::MAX, 0, 7]);
    there_and_back(&mut [u32::MAX, 0, 7]);
    there_and_back(&mut [u64::MAX, 0, 7]);
    there_and_back(&mut [i8::MIN, -1, 7]);
    there_and_back(&mut [i16::MIN, -1, 7]);
    there_and_back(&mut [i32::MIN, -1, 7]);
    there_and_back(&mut [i64::MIN, -1, 7]);
    there_and_back(&mut [f32::MIN, -1.5, 7.0]);
    there_and_back(&mut [f64::MIN, -1.5, 7.0]);
}

#[test]
fn refusals_have_their_numbers() {
    let mut parameters = ParameterAccess::new(Device::default(), 1, 1);
    let refused = |number, information| {
        Error::Parameter(ParameterError::Refused(Refusal { parameter: 0, number, information: Some(information) }))
    };
    assert_eq!(parameters.write(1, 100, 0, 3001_u16), Err(refused(ErrorNumber::LIMITS, 0)));
    let error = parameters.read::<u16>(1, 100, 7).unwrap_err();
    assert_eq!(error, refused(ErrorNumber::NO_SUBINDEX, 7));
    let text = "the drive refused: 0x0003: there is no such subindex (7)";
    assert_eq!(error.to_string(), text);
    parameters.write(1, 100, 0, 5_i16).unwrap();
    let format = Err(Error::Parameter(ParameterError::Format(Format::INTEGER16)));
    assert_eq!(parameters.read::<u16>(1, 100, 0), format);
    assert_eq!(parameters.read_array::<u16>(1, 100, 0, &mut []), Err(values(Format::UNSIGNED16)));
    assert_eq!(parameters.write_array(1, 100, 0, &[0_u64; 31]), Err(values(Format::UNSIGNED64)));
    assert_eq!(parameters.write_array(1, 100, 0, &[0_u8; 229]), Err(Error::Length(LengthError::new(242, 240))));
}

fn values(format: Format) -> Error<PnioStatus> {
    Error::Parameter(ParameterError::Values(format))
}

#[test]
fn several_parameters_in_one_request() {
    let mut device = Device::with_parameters(&[
        (1, 7, 0, Format::BYTE, &[9]),
        (1, 8, 0, Format::VISIBLE_STRING, b"m"),
        (1, 8, 1, Format::VISIBLE_STRING, b"x"),
    ]);
    let address = SubmoduleAddress::new(0, 1, 1).record(GLOBAL);
    let mut parameters = ParameterAccess::with_record(&mut device, address);
    let (mut request, mut response) = ([0; 64], [0; 64]);
    let all = [ParameterAddress::value(7, 0), ParameterAddress::values(8, 0, 2), ParameterAddress::value(9, 0)];
    let request = read_request(&mut request, parameters.next_reference(), 1, &all).unwrap();
    let answers: Vec<_> = parameters.request(request, &mut response).unwrap().answers().collect();
    let [Answer::Values(byte), Answer::Values(text), Answer::Refused(refusal)] = answers[..] else {
        panic!("{answers:?}")
    };
    assert_eq!((byte.get::<u8>(0), text.bytes), (Ok(9), &b"mx"[..]));
    assert_eq!((refusal.parameter, refusal.number), (2, ErrorNumber::NO_SUBINDEX));

    let (mut request, high) = ([0; 64], 3001_u16.to_be_bytes());
    let changes = [
        Change::new(ParameterAddress::value(100, 0), Format::WORD, &high),
        Change::new(ParameterAddress::value(7, 0), Format::BYTE, &[5]),
    ];
    let request = change_request(&mut request, parameters.next_reference(), 1, &changes).unwrap();
    let answers: Vec<_> = parameters.request(request, &mut response).unwrap().answers().collect();
    assert!(matches!(answers[..], [Answer::Refused(_), Answer::Done]), "{answers:?}");
    assert_eq!(device.drive.values[&(1, 7, 0)].1, [5]);
    assert_eq!(device.writes[1].0.index, 0xB02F);
}

#[test]
fn responses_that_take_their_time() {
    for is_empty in [false, true] {
        let mut device = Device::with_parameters(&[(1, 7, 0, Format::BYTE, &[9])]);
        device.drive.is_empty = is_empty;
        device.drive.delay = 3;
        let mut parameters = ParameterAccess::new(&mut device, 1, 1).with_polls(4);
        assert_eq!(parameters.read::<u8>(1, 7, 0), Ok(9));
        assert_eq!(parameters.client().pauses, 3);
        parameters.client().drive.delay = 4;
        let late = if is_empty { Error::Abort(AbortCode::TIMEOUT) } else { Error::Client(STATE_CONFLICT) };
        assert_eq!(parameters.read::<u8>(1, 7, 0), Err(late));
        assert_eq!(parameters.client().pauses, 6, "no pause behind the last attempt");

        device.drive.delay = 2;
        let mut parameters = ParameterAccess::new(Async(device), 1, 1).with_polls(3);
        assert_eq!(now(parameters.read_async::<u8>(1, 7, 0)), Ok(9));
        parameters.client().0.drive.delay = 3;
        assert_eq!(now(parameters.read_async::<u8>(1, 7, 0)), Err(late));
    }
}

/// A client whose errors are never those of a busy device.
struct Strict(Device);

impl RecordClient for Strict {
    type Error = PnioStatus;

    fn read_record(&mut self, address: RecordAddress, buffer: &mut [u8]) -> Result<usize, Error<PnioStatus>> {
        self.0.read_record(address, buffer)
    }

    fn write_record(&mut self, address: RecordAddress, data: &[u8]) -> Result<(), Error<PnioStatus>> {
        self.0.write_record(address, data)
    }
}

#[test]
fn other_errors_end_it_at_once() {
    let mut parameters = ParameterAccess::new(Strict(Device::default()), 1, 1);
    parameters.client().0.drive.delay = 1;
    assert_eq!(parameters.read::<u8>(1, 7, 0), Err(Error::Client(STATE_CONFLICT)));
}

#[test]
fn references_go_round_without_0() {
    let mut parameters = ParameterAccess::new(Device::default(), 1, 1);
    let all: Vec<u8> = (0..256).map(|_| parameters.next_reference()).collect();
    assert_eq!((all[0], all[254], all[255]), (1, 255, 1));
    assert!(!all.contains(&0));
}

#[test]
fn a_response_that_is_too_long_is_told() {
    let mut device = Device::with_parameters(&[(1, 7, 0, Format::WORD, &[0; 300])]);
    let read = ParameterAccess::new(&mut device, 1, 1).read::<u16>(1, 7, 0);
    assert_eq!(read, Err(Error::Length(LengthError::new(240, 306))));
}
