//! Tests the methods of accessors with a minimal client of twenty lines.

use std::collections::HashMap;

use lexibus::{
    AsyncClient, CanOpen, Client, Domain, Error, Flags, Initial, Int, Item, LengthError, NodeId, Object, OnCanOpen,
    OutOfRange, Range, Ro, Rw, SdoWrite, UnicodeString, VisibleString, Wo,
};

#[path = "support/now.rs"]
mod now;
use now::now;

const CONTROLWORD: Item<u16, Rw, OnCanOpen> =
    Item::new(OnCanOpen::canopen(0x6040, 0), "Controlword", Range::Full, Initial::Value(0), "", Flags::RPDO);
const TARGET_POSITION: Item<i32, Rw, OnCanOpen> = Item::new(
    OnCanOpen::canopen(0x607A, 0),
    "Target position",
    Range::Between(-100_000, 100_000),
    Initial::Value(0),
    "inc",
    Flags::RPDO,
);
const ENCODER: Item<Int<24>, Ro, OnCanOpen> =
    Item::new(OnCanOpen::canopen(0x2001, 1), "Encoder", Range::Full, Initial::Unknown, "inc", Flags::TPDO);
const DEVICE_NAME: Item<VisibleString, Rw, OnCanOpen> =
    Item::new(OnCanOpen::canopen(0x1008, 0), "Device name", Range::Full, Initial::Value("Drive"), "", Flags::NONE);
const LABEL: Item<UnicodeString, Rw, OnCanOpen> =
    Item::new(OnCanOpen::canopen(0x2002, 0), "Label", Range::Full, Initial::Unknown, "", Flags::NONE);
const PROGRAM: Item<Domain, Wo, OnCanOpen> =
    Item::new(OnCanOpen::canopen(0x1F50, 1), "Program", Range::Full, Initial::Unknown, "", Flags::NONE);
const COB_ID: Item<u32, Rw, OnCanOpen> =
    Item::new(OnCanOpen::canopen(0x1400, 1), "COB-ID", Range::Full, Initial::NodeId(0x200), "", Flags::NONE);

/// A simulated device: the value of each object. If an object has no value, a read fails with the object's address.
#[derive(Default)]
struct Memory(HashMap<Object, Vec<u8>>);

impl Client for Memory {
    type Bus = CanOpen;
    type Error = Object;

    fn read(&mut self, address: Object, buffer: &mut [u8]) -> Result<usize, Error<Object>> {
        let value = self.0.get(&address).ok_or(Error::Client(address))?;
        buffer.iter_mut().zip(value).for_each(|(to, from)| *to = *from);
        Ok(value.len())
    }

    fn write(&mut self, address: Object, data: &[u8]) -> Result<(), Error<Object>> {
        self.0.insert(address, data.to_vec());
        Ok(())
    }
}

impl AsyncClient for Memory {
    type Bus = CanOpen;
    type Error = Object;

    async fn read(&mut self, address: Object, buffer: &mut [u8]) -> Result<usize, Error<Object>> {
        Client::read(self, address, buffer)
    }

    async fn write(&mut self, address: Object, data: &[u8]) -> Result<(), Error<Object>> {
        Client::write(self, address, data)
    }
}

#[test]
fn what_is_written_is_read() -> Result<(), Error<Object>> {
    let mut device = Memory::default();
    TARGET_POSITION.at(&mut device).write(-2)?;
    assert_eq!(device.0[&Object { index: 0x607A, sub_index: 0 }], [0xFE, 0xFF, 0xFF, 0xFF]);
    assert_eq!(TARGET_POSITION.at(&mut device).read()?, -2);
    let mut controlword = CONTROLWORD.at(&mut device);
    controlword.write(0x0F)?;
    assert_eq!(controlword.read()?, 0x0F);
    Ok(())
}

#[test]
fn the_client_may_be_borrowed() -> Result<(), Error<Object>> {
    let mut device = Memory::default();
    let mut borrowed = &mut device;
    CONTROLWORD.at(&mut borrowed).write(6)?;
    assert_eq!(CONTROLWORD.at(&mut device).read()?, 6);
    Ok(())
}

#[test]
fn errors() {
    let mut device = Memory::default();
    let missing = Object { index: 0x607A, sub_index: 0 };
    assert_eq!(TARGET_POSITION.at(&mut device).write(100_001).map_err(Error::from), Err(Error::OutOfRange(OutOfRange)));
    assert_eq!(TARGET_POSITION.at(&mut device).read().map_err(Error::from), Err(Error::Client(missing)));
    device.0.insert(missing, vec![1, 2, 3, 4, 5]);
    let length = Error::Length(LengthError { expected: 4, actual: 5 });
    assert_eq!(TARGET_POSITION.at(&mut device).read().map_err(Error::from), Err(length));
}

#[test]
fn odd_widths() {
    let mut device = Memory::default();
    device.0.insert(ENCODER.location().canopen, vec![0xFE, 0xFF, 0xFF]);
    assert_eq!(ENCODER.at(&mut device).read(), Ok(-2));
}

#[test]
fn text_and_bytes() -> Result<(), Error<Object>> {
    let mut device = Memory::default();
    let mut buffer = [0; 32];
    DEVICE_NAME.at(&mut device).write("Drive 7")?;
    assert_eq!(DEVICE_NAME.at(&mut device).read_into(&mut buffer)?, "Drive 7");
    LABEL.at(&mut device).write("5 µm", &mut buffer)?;
    assert_eq!(LABEL.at(&mut device).read_into(&mut buffer)?, "5 µm");
    PROGRAM.at(&mut device).write(&[1; 100])?;
    assert_eq!(device.0[&PROGRAM.location().canopen].len(), 100);
    Ok(())
}

#[test]
fn without_blocking() {
    let mut device = Memory::default();
    let refused = now(async {
        let mut buffer = [0; 16];
        DEVICE_NAME.at(&mut device).write_async("Drive").await?;
        assert_eq!(DEVICE_NAME.at(&mut device).read_into_async(&mut buffer).await?, "Drive");
        LABEL.at(&mut device).write_async("µ", &mut buffer).await?;
        assert_eq!(LABEL.at(&mut device).read_into_async(&mut buffer).await?, "µ");
        PROGRAM.at(&mut device).write_async(&[1]).await?;
        TARGET_POSITION.at(&mut device).write_async(5).await?;
        assert_eq!(TARGET_POSITION.at(&mut device).read_async().await?, 5);
        TARGET_POSITION.at(&mut device).write_async(i32::MAX).await
    });
    assert_eq!(refused.map_err(Error::from), Err(Error::OutOfRange(OutOfRange)));
}

#[test]
fn a_configuration_is_written_step_by_step() -> Result<(), Error<Object>> {
    let mut device = Memory::default();
    let node = NodeId::new(5).expect("5 is a node-ID");
    let cob_id = COB_ID.initial().resolve(node).expect("it fits");
    SdoWrite::new_u32(0x1400, 1, cob_id | 1 << 31).send(&mut device)?;
    assert_eq!(COB_ID.at(&mut device).read()?, 0x8000_0205);
    now(SdoWrite::new_u32(0x1400, 1, cob_id).send_async(&mut device))?;
    assert_eq!(COB_ID.at(&mut device).read()?, 0x205);
    Ok(())
}
