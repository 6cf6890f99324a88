use std::string::ToString;
use std::vec::Vec;

use super::*;
use crate::value_error::LengthError;

const ONE: ParameterAddress = ParameterAddress::value(0x0123, 0x0004);

fn read(parameters: &[ParameterAddress]) -> Vec<u8> {
    read_request(&mut [0; 240], 7, 2, parameters).unwrap().to_vec()
}

fn change(changes: &[Change<'_>]) -> Vec<u8> {
    change_request(&mut [0; 600], 7, 2, changes).unwrap().to_vec()
}

#[test]
fn requests_that_read() {
    assert_eq!(read(&[ONE]), [7, 0x01, 2, 1, 0x10, 1, 0x01, 0x23, 0x00, 0x04]);
    let more = [ParameterAddress::values(947, 0, 8), ONE.of(Attribute::Description), ONE.of(Attribute::Text)];
    let addresses = [[0x10, 8, 0x03, 0xB3, 0, 0], [0x20, 1, 0x01, 0x23, 0x00, 0x04], [0x30, 1, 0x01, 0x23, 0x00, 0x04]];
    let request = read(&more);
    assert_eq!(request[..4], [7, 0x01, 2, 3]);
    assert_eq!(request[4..], addresses.concat());
}

#[test]
fn requests_that_change_have_all_addresses_first() {
    let (ramp, flags) = (1500_u16.to_be_bytes(), [1, 0, 1]);
    let changes =
        [Change::new(ONE, u16::FORMAT, &ramp), Change::new(ParameterAddress::values(2, 0, 3), Format::BOOLEAN, &flags)];
    let request = [
        &[7, 0x02, 2, 2][..],
        &[0x10, 1, 0x01, 0x23, 0x00, 0x04],
        &[0x10, 3, 0x00, 0x02, 0x00, 0x00],
        &[0x06, 1, 0x05, 0xDC],
        // Three values, followed by a padding byte.
        &[0x01, 3, 1, 0, 1, 0],
    ];
    assert_eq!(change(&changes), request.concat());
}

#[test]
fn formats_of_the_types_of_rust() {
    fn written<T: ParameterValue>(value: T) -> Vec<u8> {
        change(&[Change::new(ONE, T::FORMAT, value.to_bytes().as_ref())])[10..].to_vec()
    }
    assert_eq!(written(true), [0x01, 1, 1, 0]);
    assert_eq!(written(-2_i8), [0x02, 1, 0xFE, 0]);
    assert_eq!(written(-2_i16), [0x03, 1, 0xFF, 0xFE]);
    assert_eq!(written(-2_i32), [0x04, 1, 0xFF, 0xFF, 0xFF, 0xFE]);
    assert_eq!(written(0xAB_u8), [0x05, 1, 0xAB, 0]);
    assert_eq!(written(0xABCD_u16), [0x06, 1, 0xAB, 0xCD]);
    assert_eq!(written(0x0102_0304_u32), [0x07, 1, 1, 2, 3, 4]);
    assert_eq!(written(1.5_f32), [0x08, 1, 0x3F, 0xC0, 0, 0]);
    assert_eq!(written(1.5_f64), [0x0F, 1, 0x3F, 0xF8, 0, 0, 0, 0, 0, 0]);
    assert_eq!(written(-2_i64), [0x37, 1, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFE]);
    assert_eq!(written(0x0102_0304_0506_0708_u64), [0x38, 1, 1, 2, 3, 4, 5, 6, 7, 8]);
}

#[test]
fn requests_that_there_are_not() {
    let mut buffer = [0; 600];
    let mut reading = |reference, count| read_request(&mut buffer, reference, 1, &[ONE; 40][..count]).map(<[u8]>::len);
    assert_eq!(reading(1, 39), Ok(4 + 39 * 6));
    assert_eq!(reading(1, 40), Err(ParameterError::Count(40)));
    assert_eq!(reading(1, 0), Err(ParameterError::Count(0)));
    assert_eq!(reading(0, 1), Err(ParameterError::NoRequest));
    let short = read_request(&mut buffer[..9], 1, 1, &[ONE]);
    assert_eq!(short, Err(ParameterError::Length(LengthError::new(10, 9))));
    let mut changing =
        |format, values: &[u8]| change_request(&mut buffer, 1, 1, &[Change::new(ONE, format, values)]).map(<[u8]>::len);
    assert_eq!(changing(Format::WORD, &[1, 2, 3]), Err(ParameterError::Values(Format::WORD)));
    assert_eq!(changing(Format::WORD, &[]), Err(ParameterError::Values(Format::WORD)));
    assert_eq!(changing(Format::BYTE, &[0; 256]), Err(ParameterError::Values(Format::BYTE)));
    assert_eq!(changing(Format(11), &[1, 2]), Err(ParameterError::Values(Format(11))));
    assert_eq!(changing(Format::BYTE, &[0; 255]), Ok(10 + 2 + 256));
    let error = changing(Format(11), &[1, 2]).unwrap_err();
    assert_eq!(error.to_string(), "the bytes are not 1 to 255 values of format 11 (unknown)");
}

/// The response to a request for three parameters. The response contains a double word, a string of five characters,
/// and a refusal with a subindex.
const MIXED: [u8; 26] = [
    7, 0x81, 2, 3, 0x43, 1, 0x12, 0x34, 0x56, 0x78, 0x09, 5, b'm', b'o', b't', b'o', b'r', 0, 0x44, 2, 0x00, 0x03,
    0x00, 0x09, 0xEE, 0xEE,
];

#[test]
fn responses_with_several_parameters() {
    let request = read(&[ONE, ONE, ONE]);
    let response = Response::decode(&request, &MIXED).unwrap();
    assert_eq!((response.count(), response.is_negative()), (3, true));
    let answers: Vec<Answer<'_>> = response.answers().collect();
    let Answer::Values(word) = answers[0] else { panic!("{answers:?}") };
    assert_eq!((word.get::<u32>(0), word.get::<i32>(0)), (Ok(0x1234_5678), Ok(0x1234_5678)));
    assert_eq!(word.get::<u32>(1), Err(ParameterError::NoValue));
    assert_eq!(word.get::<u16>(0), Err(ParameterError::Format(Format::DOUBLE_WORD)));
    let Answer::Values(text) = answers[1] else { panic!("{answers:?}") };
    assert_eq!((text.format, text.bytes), (Format::VISIBLE_STRING, &b"motor"[..]));
    let refusal = Refusal { parameter: 2, number: ErrorNumber::NO_SUBINDEX, information: Some(9) };
    assert_eq!(answers[2], Answer::Refused(refusal));
    assert_eq!((response.refusal(), response.done()), (Some(refusal), Err(ParameterError::Refused(refusal))));
    let text = "the drive refused the parameter at position 2 of the request: 0x0003: there is no such subindex (9)";
    assert_eq!(refusal.to_string(), text);
}

#[test]
fn changes_that_were_made_and_not() {
    let value = [0, 1];
    let request = change(&[Change::new(ONE, Format::WORD, &value); 2]);
    let made = Response::decode(&request, &[7, 0x02, 2, 2]).unwrap();
    assert_eq!((made.done(), made.answers().count()), (Ok(()), 2));
    // The drive changed the first parameter. The second value exceeds a limit.
    let half = [7, 0x82, 2, 2, 0x40, 0, 0x44, 1, 0x00, 0x02];
    let half = Response::decode(&request, &half).unwrap();
    let refusal = Refusal { parameter: 1, number: ErrorNumber::LIMITS, information: None };
    assert_eq!(half.answers().collect::<Vec<_>>(), [Answer::Done, Answer::Refused(refusal)]);
    assert_eq!(half.done(), Err(ParameterError::Refused(refusal)));
    // A refusal without a parameter and without an error number.
    let silent = Response::decode(&request, &[7, 0x82, 2, 1, 0x40, 0]).unwrap();
    assert_eq!(silent.done(), Err(ParameterError::NoValue));
    assert_eq!(Response::decode(&request, &[7, 0x82, 2, 1, 0x44, 0]), Err(ParameterError::NoValue));
}

#[test]
fn every_response_that_ends_too_early_says_so() {
    let request = read(&[ONE, ONE, ONE]);
    for length in 0..24 {
        let ParameterError::Length(error) = Response::decode(&request, &MIXED[..length]).unwrap_err() else {
            panic!("{length}")
        };
        assert!(error.actual == length && error.expected > length && error.expected <= 24, "{error:?}");
    }
    assert!(Response::decode(&request, &MIXED[..24]).is_ok());
    // Only the padding byte is missing.
    assert!(Response::decode(&read(&[ONE]), &[7, 1, 2, 1, 0x05, 1, 9]).is_ok());
}

#[test]
fn responses_to_something_else() {
    let request = read(&[ONE, ONE]);
    let refused = |header: [u8; 4]| {
        Response::decode(&request, &[&header[..], &[0x42, 1, 0, 1, 0x42, 1, 0, 2]].concat()).map(|_| ())
    };
    assert_eq!(refused([7, 0x01, 2, 2]), Ok(()));
    assert_eq!(refused([8, 0x01, 2, 2]), Err(ParameterError::OtherReference { expected: 7, actual: 8 }));
    assert_eq!(refused([7, 0x02, 2, 2]), Err(ParameterError::ResponseId(0x02)));
    assert_eq!(refused([7, 0x82, 2, 2]), Err(ParameterError::ResponseId(0x82)));
    assert_eq!(refused([7, 0x01, 3, 2]), Err(ParameterError::OtherAxis { expected: 2, actual: 3 }));
    for actual in [0, 1, 3] {
        assert_eq!(refused([7, 0x01, 2, actual]), Err(ParameterError::ParameterCount { expected: 2, actual }));
    }
    // A response that would become too long is truncated and contains a refusal.
    assert_eq!(refused([7, 0x81, 2, 1]), Ok(()));
    assert_eq!(Response::decode(&[1, 2, 3], &MIXED), Err(ParameterError::NoRequest));
}

#[test]
fn formats_of_unknown_length() {
    // Twelve bytes in a format of unknown length. All of these bytes belong to the last parameter.
    let data = [7, 1, 2, 2, 0x42, 1, 0, 9, 12, 2, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12];
    let response = Response::decode(&read(&[ONE, ONE]), &data).unwrap();
    let Some(Answer::Values(time)) = response.answers().nth(1) else { panic!() };
    assert_eq!((time.format, time.count, time.bytes.len()), (Format::TIME_OF_DAY, 2, 12));
    assert_eq!(time.get::<u16>(0), Err(ParameterError::Format(Format::TIME_OF_DAY)));
    let data = [7, 1, 2, 2, 12, 1, 0, 9, 0x42, 1, 0, 9];
    let first = Response::decode(&read(&[ONE, ONE]), &data);
    assert_eq!(first, Err(ParameterError::Format(Format::TIME_OF_DAY)));
}

#[test]
fn values_of_other_formats_of_the_same_kind() {
    let get = |format: u8| {
        let data = [7, 1, 2, 1, format, 2, 0xFF, 0xFE, 0x00, 0x05];
        let response = Response::decode(&read(&[ONE]), &data).unwrap();
        let values = response.values().unwrap();
        (values.get::<u16>(0).ok(), values.get::<i16>(0).ok(), values.get::<i16>(1).ok())
    };
    assert_eq!(get(Format::WORD.0), (Some(0xFFFE), Some(-2), Some(5)));
    assert_eq!(get(Format::N2.0), (None, Some(-2), Some(5)));
    assert_eq!(get(Format::V2.0), (Some(0xFFFE), None, None));
    assert_eq!((Format(113), Format(124)), (Format::N2, Format::X4));
}

/// Returns pseudo-random bytes from a seed.
fn noise(seed: &mut u32) -> u8 {
    *seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
    (*seed >> 24) as u8
}

#[test]
fn whatever_a_drive_sends_is_read_or_refused() {
    let request = read(&[ONE; 5]);
    let (mut seed, mut decoded) = (1, 0);
    for _ in 0..20_000 {
        let mut data = std::vec![7, 0x81, 2, noise(&mut seed) % 7];
        for _ in 0..noise(&mut seed) % 40 {
            let formats = [0x40, 0x41, 0x42, 0x43, 0x44, 9, 3, noise(&mut seed)];
            data.extend([formats[usize::from(noise(&mut seed) % 8)], noise(&mut seed) % 4, noise(&mut seed)]);
        }
        if let Ok(response) = Response::decode(&request, &data) {
            decoded += 1;
            assert_eq!(response.answers().count(), usize::from(response.count()));
            for answer in response.answers() {
                let Answer::Values(values) = answer else { continue };
                let size = values.format.size().unwrap_or(1);
                assert!(values.format.size().is_none() || values.bytes.len() == size * usize::from(values.count));
            }
        }
    }
    assert!(decoded > 100, "{decoded}");
}
