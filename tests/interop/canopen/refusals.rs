//! Tests accesses that the node or the accessor rejects. The accessor must report the node's abort codes, and must not
//! send values that it rejects itself.
//!
//! The library checks access rights, lengths, and whether objects exist. The script checks limits, which the library
//! reads from the exported EDS.

use lexibus::{AbortCode, Fixed, Item, OnCanOpen, Rw};
use serde_json::json;

use super::all_types::AllTypes;
use super::{start, Error, Node};

const FILE: &str = "tests/interop/all-types.toml";

/// An item without the access rights and limits of its object, so that the node has to reject an invalid access.
pub type Naive<V> = Item<V, Rw, OnCanOpen>;

pub const fn naive<V: Fixed>(index: u16, sub_index: u8) -> Naive<V> {
    Naive::object(index, sub_index, "")
}

#[track_caller]
pub fn assert_aborted<T: std::fmt::Debug>(result: Result<T, impl Into<Error>>, code: AbortCode) {
    let result = result.map_err(Into::into);
    assert!(matches!(result, Err(Error::Abort(got)) if got == code), "{result:?} instead of {code}");
}

#[test]
fn values_out_of_range() -> Result<(), Error> {
    let Some((mut script, node)) = start("out-of-range", FILE) else { return Ok(()) };
    let mut device = AllTypes::new(node);
    // The library must read the limits from the exported EDS.
    assert_eq!(script.ask(json!({ "do": "limits", "index": 0x2203 })), json!([-100, 200]));
    assert_eq!(script.ask(json!({ "do": "limits", "index": 0x2204 })), json!([10, 0xFFFF_FFF0_u32]));
    for value in [-100, 200] {
        device.limited_signed().write(value)?;
        assert_eq!(script.get(0x2203, 0), value);
    }
    for value in [10, 0xFFFF_FFF0] {
        device.limited_unsigned().write(value)?;
        assert_eq!(script.get(0x2204, 0), value);
    }
    // The accessor rejects values outside the limits without sending a request.
    assert!(matches!(device.limited_signed().write(-101).map_err(Error::from), Err(Error::OutOfRange(_))));
    assert!(matches!(device.limited_unsigned().write(9).map_err(Error::from), Err(Error::OutOfRange(_))));
    // The device rejects values outside the limits if a request contains them.
    let signed: Naive<i16> = naive(0x2203, 0);
    let unsigned: Naive<u32> = naive(0x2204, 0);
    assert_aborted(signed.at(device.client()).write(-101), AbortCode::TOO_LOW);
    assert_aborted(signed.at(device.client()).write(201), AbortCode::TOO_HIGH);
    assert_aborted(unsigned.at(device.client()).write(9), AbortCode::TOO_LOW);
    assert_aborted(unsigned.at(device.client()).write(u32::MAX), AbortCode::TOO_HIGH);
    // The rejected writes must not change the values.
    assert_eq!(device.limited_signed().read()?, 200);
    assert_eq!(device.limited_unsigned().read()?, 0xFFFF_FFF0);
    Ok(())
}

#[test]
fn rights() -> Result<(), Error> {
    let Some((mut script, node)) = start("rights", FILE) else { return Ok(()) };
    let mut device = AllTypes::new(node);
    assert_eq!(device.fixed().read()?, 0x1234);
    assert_eq!(device.measured().read()?, -5);
    device.password().write(0xC0DE_CAFE)?;
    assert_eq!(script.get(0x2202, 0), 0xC0DE_CAFE_u32);
    // The generated accessors have no methods for these accesses.
    assert_aborted(naive::<u16>(0x2200, 0).at(device.client()).write(1), AbortCode::READ_ONLY);
    assert_aborted(naive::<i32>(0x2201, 0).at(device.client()).write(1), AbortCode::READ_ONLY);
    assert_aborted(naive::<u32>(0x2202, 0).at(device.client()).read(), AbortCode::WRITE_ONLY);
    // The node aborts after the last segment, because the Python library checks access rights at the end of a transfer.
    let text = lexibus::Object { index: 0x1008, sub_index: 0 };
    let written = lexibus::Client::write(device.client(), text, b"something longer than a frame");
    assert_aborted(written, AbortCode::READ_ONLY);
    Ok(())
}

#[test]
fn what_is_not_there() -> Result<(), Error> {
    let Some((mut script, node)) = start("not-there", FILE) else { return Ok(()) };
    let mut device = AllTypes::new(node);
    let node: &mut Node = device.client();
    assert_aborted(naive::<u8>(0x2FFF, 0).at(node).read(), AbortCode::NO_OBJECT);
    assert_aborted(naive::<u64>(0x2FFF, 0).at(node).write(1), AbortCode::NO_OBJECT);
    assert_aborted(naive::<u32>(0x1018, 5).at(node).read(), AbortCode::NO_SUB_INDEX);
    assert_aborted(naive::<u16>(0x1400, 3).at(node).write(1), AbortCode::NO_SUB_INDEX);
    assert_aborted(device.never_set().read(), AbortCode::NO_RESOURCE);
    script.set(0x2206, 0, json!(""));
    assert_aborted(device.empty().read_into(&mut [0; 10]).map(str::len), AbortCode::NO_DATA);
    Ok(())
}

#[test]
fn lengths() -> Result<(), Error> {
    let Some((mut script, node)) = start("lengths", FILE) else { return Ok(()) };
    let mut device = AllTypes::new(node);
    assert_aborted(naive::<u16>(0x2007, 0).at(device.client()).write(1), AbortCode::LENGTH);
    assert_aborted(naive::<u64>(0x2007, 0).at(device.client()).write(1), AbortCode::LENGTH);
    script.set(0x2007, 0, json!(0x1234_5678));
    let short = naive::<u16>(0x2007, 0).at(device.client()).read().map_err(Error::from);
    assert!(matches!(short, Err(Error::Length(error)) if (error.expected, error.actual) == (2, 4)), "{short:?}");
    // The text is longer than the buffer. The next transfer must succeed.
    script.set(0x2009, 0, json!("a text of thirty letters, say."));
    let long = device.visible_string().read_into(&mut [0; 10]).map(str::len).map_err(Error::from);
    assert!(matches!(long, Err(Error::Length(error)) if (error.expected, error.actual) == (10, 30)), "{long:?}");
    assert_eq!(device.unsigned32().read()?, 0x1234_5678);
    Ok(())
}
