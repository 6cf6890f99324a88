use std::vec::Vec;

use super::*;

const TARGET: Object = Object::new(0x607A, 2);

/// Returns a mailbox message from the device with this CoE service.
fn message(kind: u8, service: u8, sdo: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::from([sdo.len() as u8 + 2, 0, 0, 0, 0, kind, 0, service << 4]);
    bytes.extend(sdo);
    // Fill the unused part of the mailbox.
    bytes.resize(64, 0xEE);
    bytes
}

fn answer(sdo: &[u8]) -> Vec<u8> {
    message(0x13, 3, sdo)
}

#[test]
fn requests_to_read() {
    let head = [10, 0, 0, 0, 0, 3, 0, 0x20, 0x40, 0x7A, 0x60, 2, 0, 0, 0, 0];
    assert_eq!(upload(TARGET, false).head(), head);
    assert_eq!(upload(TARGET, true).head()[8], 0x50);
    assert_eq!(upload_segment(true).head()[8..], [0x70, 0, 0, 0, 0, 0, 0, 0]);
}

#[test]
fn requests_to_write() {
    let (expedited, sent) = download(TARGET, false, &[1, 2, 3], 128);
    assert_eq!((expedited.command(), sent), (Command::Short, 3));
    assert_eq!(expedited.head(), [10, 0, 0, 0, 0, 3, 0, 0x20, 0x27, 0x7A, 0x60, 2, 1, 2, 3, 0]);

    // Downloads of a whole value, of a part of a value, and of an empty value, which also has a length.
    let (normal, sent) = download(TARGET, true, &[0; 20], 128);
    assert_eq!((normal.command(), sent), (Command::Normal, 20));
    assert_eq!(normal.head(), [30, 0, 0, 0, 0, 3, 0, 0x20, 0x31, 0x7A, 0x60, 2, 20, 0, 0, 0]);
    let (first, sent) = download(TARGET, false, &[0; 300], 128);
    assert_eq!((&first.head()[..2], &first.head()[12..], sent), (&[122, 0][..], &[0x2C, 1, 0, 0][..], 112));
    let (empty, sent) = download(TARGET, false, &[], 128);
    assert_eq!((empty.head()[0], empty.head()[8], sent), (10, 0x21, 0));
}

#[test]
fn segments_to_write() {
    let part = |toggle, rest| {
        let (request, length) = download_segment(toggle, rest, 128);
        (request.head()[0], request.head()[8], length)
    };
    assert_eq!(part(false, 300), (122, 0x00, 119));
    assert_eq!(part(true, 119), (122, 0x11, 119));
    // Segments with less than seven bytes are padded to seven.
    assert_eq!(part(false, 7), (10, 0x01, 7));
    assert_eq!(part(true, 3), (10, 0x19, 3));
}

#[test]
fn values() {
    let bytes = answer(&[0x4B, 0x7A, 0x60, 2, 7, 8, 0, 0]);
    assert_eq!(Answer::parse(&bytes), Answer::Upload { object: TARGET, size: Some(2), data: &[7, 8] });
    let bytes = answer(&[0x42, 0x7A, 0x60, 2, 7, 8, 9, 10]);
    assert_eq!(Answer::parse(&bytes), Answer::Upload { object: TARGET, size: None, data: &[7, 8, 9, 10] });
    let bytes = answer(&[0x41, 0x7A, 0x60, 2, 5, 0, 0, 0, 1, 2, 3, 4, 5]);
    assert_eq!(Answer::parse(&bytes), Answer::Upload { object: TARGET, size: Some(5), data: &[1, 2, 3, 4, 5] });
    // The reply contains the first part of a value.
    let bytes = answer(&[0x41, 0x7A, 0x60, 2, 9, 0, 0, 0, 1, 2]);
    assert_eq!(Answer::parse(&bytes), Answer::Upload { object: TARGET, size: Some(9), data: &[1, 2] });
}

#[test]
fn parts_of_values() {
    let bytes = answer(&[0x10, 1, 2, 3, 4, 5, 6, 7, 8]);
    let long = Answer::UploadSegment { toggle: true, last: false, data: &[1, 2, 3, 4, 5, 6, 7, 8] };
    assert_eq!(Answer::parse(&bytes), long);
    let bytes = answer(&[0x09, 1, 2, 3, 0, 0, 0, 0]);
    assert_eq!(Answer::parse(&bytes), Answer::UploadSegment { toggle: false, last: true, data: &[1, 2, 3] });
}

#[test]
fn acknowledgements() {
    let bytes = answer(&[0x60, 0x7A, 0x60, 2, 0, 0, 0, 0]);
    assert_eq!(Answer::parse(&bytes), Answer::Download { object: TARGET });
    let bytes = answer(&[0x30, 0, 0, 0, 0, 0, 0, 0]);
    assert_eq!(Answer::parse(&bytes), Answer::DownloadSegment { toggle: true });
    for service in [2, 3] {
        let bytes = message(3, service, &[0x80, 0x7A, 0x60, 2, 0x11, 0, 0x09, 0x06]);
        assert_eq!(Answer::parse(&bytes), Answer::Abort { object: TARGET, code: AbortCode::NO_SUB_INDEX });
    }
}

#[test]
fn what_comes_unasked() {
    let bytes = message(3, 1, &[0x10, 0x32, 0x05, 1, 2, 3, 4, 5]);
    let emergency = Emergency { code: 0x3210, register: 5, vendor: [1, 2, 3, 4, 5] };
    assert_eq!(Answer::parse(&bytes), Answer::Emergency(emergency));
    // Messages of Ethernet over EtherCAT and of the SDO information service are ignored.
    assert_eq!(Answer::parse(&message(2, 3, &[0; 8])), Answer::Foreign);
    assert_eq!(Answer::parse(&message(3, 8, &[0; 8])), Answer::Foreign);
}

#[test]
fn mailbox_errors() {
    // Protocol 0, type 1 and code 2 mean that the protocol isn't supported.
    assert_eq!(Answer::parse(&[4, 0, 0, 0, 0, 0, 1, 0, 2, 0]), Answer::MailboxError(2));
    assert_eq!(Answer::parse(&[2, 0, 0, 0, 0, 0, 1, 0]), Answer::Malformed);
}

#[test]
fn what_is_no_message() {
    assert_eq!(Answer::parse(&[]), Answer::Malformed);
    assert_eq!(Answer::parse(&[0; 128]), Answer::Malformed);
    // A mailbox error of another type, a wrong length, and messages that are too short are invalid.
    assert_eq!(Answer::parse(&message(0, 3, &[0x4B, 0x7A, 0x60, 2, 7, 8, 0, 0])), Answer::Malformed);
    assert_eq!(Answer::parse(&[255, 255, 0, 0, 0, 3, 0, 0x30, 0x4B]), Answer::Malformed);
    for length in 0..8 {
        let whole = [0x41, 0x7A, 0x60, 2, 5, 0, 0, 0];
        assert_eq!(Answer::parse(&answer(&whole[..length])), Answer::Malformed);
    }
}
