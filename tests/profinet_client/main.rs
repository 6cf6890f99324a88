//! Tests the controller side of PROFINET with a simulated device: typed records, items in records, process images and
//! PROFIdrive parameters.
#![cfg(feature = "macros")]

mod device;
#[path = "../support/now.rs"]
mod now;
mod parameters;

use device::{Async, Device, INVALID_INDEX};
use lexibus::profinet::{
    AsyncImageClient, FTrailer, ImageClient, IoObject, IoSpan, IoStatus, NotAllowed, Plan, PnioStatus, RecordAccess,
    RecordClient, SubmoduleAddress, SubmoduleIo,
};
use lexibus::{Error, Flags, Initial, Item, LengthError, OnProfinet, Range, Record, Rw, VisibleString};
use now::now;

lexibus::dictionary! {
    /// A station with a PROFIsafe module.
    pub mod safe = "tests/data/safe.gsdml.xml";
}

lexibus::dictionary! {
    /// A servo drive with the PROFIdrive profile.
    pub mod drive = "tests/data/drive.gsdml.xml";
}

use safe::submodules::safe_inputs::{InputFilterRecord, Inputs, Outputs};
use safe::values::VMode;

const INPUTS: SubmoduleAddress = SubmoduleAddress::new(0, 2, 1);

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
    assert_eq!(device.writes, [(address, FILTER_BYTES.to_vec())], "the invalid record was not sent");

    // Test a record that is too short, and a record that exceeds the buffer.
    for (length, expected) in [(8, 9), (17, 16)] {
        device.records.insert(address, vec![0; length]);
        let read = RecordAccess::<_, 16>::new(&mut device).read::<InputFilterRecord>(INPUTS);
        assert_eq!(read, Err(Error::Length(LengthError::new(expected, length))));
    }
}

/// Tests the code that `lexibus docs` shows for an item of a record.
#[test]
fn one_field_of_a_record() -> Result<(), Error<PnioStatus>> {
    use safe::submodules;
    let (address, mut records) = (INPUTS, RecordAccess::<_, 16>::new(Device::default()));
    records.write(address, &FILTER)?;
    let value = records.read::<submodules::safe_inputs::InputFilterRecord>(address)?.gain / 2.0;
    let record = submodules::safe_inputs::InputFilterRecord { gain: value, ..records.read(address)? };
    records.write(address, &record)?;
    assert_eq!(records.read(address), Ok(InputFilterRecord { gain: 5.0, ..FILTER }));
    Ok(())
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
    assert_eq!(BEHIND.at(&mut records).read().map_err(Error::from), beyond);
    assert_eq!(BEHIND.at(&mut records).write(1).map_err(Error::from), beyond.map(drop));
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
    // Head, interface and port each have a provider status and a consumer status.
    let span = |offset, length| Some(IoSpan { offset, length });
    let module = plan.submodule_io(2, 1).unwrap();
    let place = SubmoduleIo {
        slot: 2,
        subslot: 1,
        inputs: span(3, 8),
        outputs: span(4, 6),
        inputs_consumer: span(3, 1),
        outputs_consumer: span(11, 1),
    };
    assert_eq!(module, place);
    assert_eq!(plan.lengths(), (12, 10));
    assert_eq!(plan.submodule_io(3, 1), None);

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

    // Test frames that are too short, data of another submodule, and a submodule without outputs.
    assert_eq!(module.read::<Inputs>(&inputs[..10]), Err(LengthError::new(11, 10)));
    assert_eq!(module.consumer(&inputs[..11]), IoStatus::BAD);
    assert_eq!(module.set_consumer(&mut outputs[..3], IoStatus::GOOD), Err(LengthError::new(4, 3)));
    assert!(plan.set_status(&mut outputs[..9], IoStatus::GOOD).is_err());
    type Telegram = drive::submodules::standard_telegram_1::Inputs;
    assert_eq!(module.read::<Telegram>(&inputs), Err(LengthError::new(5, 8)));
    let head = plan.submodule_io(0, 1).unwrap();
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

/// A device whose inputs equal its outputs.
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
