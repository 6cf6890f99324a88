//! Tests the functions 22 and 23 of a simulated device.

use lexibus::modbus::{AsyncRegisterClient, RegisterClient};
use lexibus::sim::{Device, Exception, Fault};
use lexibus::{
    AccessRights, Bound, DataType, Entry, Error, Flags, Item, Modbus, OnModbus, RawInitial, Register, Ro, Rw,
};

type RegisterItem<V, A> = Item<V, A, OnModbus>;

const CONTROL: RegisterItem<u16, Rw> = RegisterItem::register(Register::holding(10), "Control", Flags::NONE);
const TARGET: RegisterItem<i32, Rw> = RegisterItem::register(Register::high_first(11, 2), "Target", Flags::NONE);
const LOW: RegisterItem<u8, Rw> = RegisterItem::register(Register::holding(13).part(0, 8), "Low", Flags::NONE);
const HIGH: RegisterItem<u8, Ro> = RegisterItem::register(Register::holding(13).part(8, 8), "High", Flags::NONE);

const fn entry(register: Register, data_type: DataType, access: AccessRights, low: Bound, high: Bound) -> Entry {
    Entry {
        object: None,
        register: Some(register),
        name: "",
        data_type,
        access,
        flags: Flags::NONE,
        initial: RawInitial::Unknown,
        configured: None,
        low,
        high,
        unit: "",
    }
}

fn device() -> Device {
    let free = |register, data_type, access| entry(register, data_type, access, Bound::Unlimited, Bound::Unlimited);
    let limited = Register::high_first(11, 2);
    Device::new(&[
        free(Register::holding(10), DataType::Unsigned16, AccessRights::ReadWrite),
        entry(limited, DataType::Integer32, AccessRights::ReadWrite, Bound::Unlimited, Bound::Signed(1000)),
        free(Register::holding(13).part(0, 8), DataType::Unsigned8, AccessRights::ReadWrite),
        free(Register::holding(13).part(8, 8), DataType::Unsigned8, AccessRights::ReadOnly),
        free(Register::holding(20), DataType::Unsigned16, AccessRights::ReadOnly),
    ])
}

#[test]
fn mask_writes() {
    let mut device = device();
    device.set(CONTROL, 0x0012).unwrap();
    // The example for function 22 in the Modbus specification.
    assert_eq!(device.mask_word(10, 0x00F2, 0x0025), Ok(()));
    assert_eq!(device.get(CONTROL), Ok(0x0017));
    assert_eq!(device.mask_word(20, 0, 1), Err(Exception::IllegalDataAddress));
    assert_eq!(device.mask_word(99, 0, 1), Err(Exception::IllegalDataAddress));
    device.set(HIGH, 0x55).unwrap();
    device.client::<Modbus>().write_masked(LOW, 0x0A, 0x0F).unwrap();
    assert_eq!((device.get(LOW), device.get(HIGH)), (Ok(0x0A), Ok(0x55)));
    // Bits of a read-only item don't change.
    assert_eq!(device.mask_word(13, 0, 0xFFFF), Ok(()));
    assert_eq!((device.get(LOW), device.get(HIGH)), (Ok(0xFF), Ok(0x55)));
}

#[tokio::test]
async fn exchanges() {
    let mut device = device();
    let mut client = device.client::<Modbus>();
    assert_eq!(client.exchange((CONTROL, TARGET), (3, -4), (TARGET, CONTROL)), Ok((-4, 3)));
    assert_eq!(client.exchange_async((CONTROL,), (5,), (TARGET, CONTROL)).await, Ok((-4, 5)));
    assert_eq!(client.write_block((CONTROL, TARGET), (6, 7)), Ok(()));
    // The device refuses the value. The control word in the same request isn't written either.
    let refused = client.exchange((CONTROL, TARGET), (8, 1001), (CONTROL,)).map_err(Error::from);
    assert_eq!(refused, Err(Error::Client(Fault::Exception(Exception::IllegalDataValue))));
    assert_eq!((device.get(CONTROL), device.get(TARGET)), (Ok(6), Ok(7)));
    // If the registers cannot be read, nothing is written.
    assert_eq!(device.exchange_words(10, &[9], 14, 1), Err(Exception::IllegalDataAddress));
    assert_eq!(device.exchange_words(10, &[0; 122], 10, 1), Err(Exception::IllegalDataValue));
    assert_eq!(device.exchange_words(10, &[9], 10, 126), Err(Exception::IllegalDataValue));
    assert_eq!(device.get(CONTROL), Ok(6));
    assert_eq!(device.exchange_words(10, &[9], 10, 2), Ok(vec![9, 0]));
    device.fail_next(Fault::Bus);
    let mut client = device.client::<Modbus>();
    let failed = client.exchange((CONTROL,), (1,), (CONTROL,)).map_err(Error::from);
    assert_eq!(failed, Err(Error::Client(Fault::Bus)));
    assert_eq!(device.get(CONTROL), Ok(9));
}
