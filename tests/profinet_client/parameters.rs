//! Tests the access to PROFIdrive parameters.

use lexibus::profinet::parameter_access::{
    change_request, read_request, Answer, Change, ErrorNumber, Format, ParameterAccess, ParameterAddress,
    ParameterError, ParameterValue, Refusal, API, GLOBAL,
};
use lexibus::profinet::{PnioStatus, RecordAddress, RecordClient, SubmoduleAddress};
use lexibus::{Error, LengthError};

use super::device::{Async, Device, STATE_CONFLICT};
use super::now::now;

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
        let expected = values.to_vec();
        let mut parameters = ParameterAccess::new(Device::default(), 1, 1);
        parameters.write_array(1, 2000, 5, values).unwrap();
        values.reverse();
        parameters.read_array(1, 2000, 5, values).unwrap();
        assert_eq!(values, expected);
        assert_eq!(parameters.read::<T>(1, 2000, 6), Ok(expected[1]));
        now(async {
            let mut parameters = ParameterAccess::new(Async(parameters.into_client()), 1, 1);
            parameters.write_async(1, 2000, 6, expected[2]).await.unwrap();
            parameters.write_array_async(1, 2000, 8, &expected[..2]).await.unwrap();
            assert_eq!(parameters.read_async::<T>(1, 2000, 6).await, Ok(expected[2]));
            parameters.read_array_async(1, 2000, 8, &mut values[1..]).await.unwrap();
        });
        assert_eq!(values[1..], expected[..2]);
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
        Error::ParameterAccess(ParameterError::Refused(Refusal {
            parameter: 0,
            number,
            information: Some(information),
        }))
    };
    assert_eq!(parameters.write(1, 100, 0, 3001_u16), Err(refused(ErrorNumber::LIMITS, 0)));
    let error = parameters.read::<u16>(1, 100, 7).unwrap_err();
    assert_eq!(error, refused(ErrorNumber::NO_SUBINDEX, 7));
    let text = "the drive refused: 0x0003: there is no such subindex (7)";
    assert_eq!(error.to_string(), text);
    parameters.write(1, 100, 0, 5_i16).unwrap();
    let format = Err(Error::ParameterAccess(ParameterError::Format(Format::INTEGER16)));
    assert_eq!(parameters.read::<u16>(1, 100, 0), format);
    assert_eq!(parameters.read_array::<u16>(1, 100, 0, &mut []), Err(values(Format::UNSIGNED16)));
    assert_eq!(parameters.write_array(1, 100, 0, &[0_u64; 31]), Err(values(Format::UNSIGNED64)));
    assert_eq!(parameters.write_array(1, 100, 0, &[0_u8; 229]), Err(Error::Length(LengthError::new(242, 240))));
}

fn values(format: Format) -> Error<PnioStatus> {
    Error::ParameterAccess(ParameterError::Values(format))
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
        let late = if is_empty { Error::Timeout } else { Error::Client(STATE_CONFLICT) };
        assert_eq!(parameters.read::<u8>(1, 7, 0), Err(late));
        assert_eq!(parameters.client().pauses, 6, "no pause after the last attempt");

        device.drive.delay = 2;
        let mut parameters = ParameterAccess::new(Async(device), 1, 1).with_polls(3);
        assert_eq!(now(parameters.read_async::<u8>(1, 7, 0)), Ok(9));
        parameters.client().0.drive.delay = 3;
        assert_eq!(now(parameters.read_async::<u8>(1, 7, 0)), Err(late));
    }
}

/// A client that never treats an error as a busy device.
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
