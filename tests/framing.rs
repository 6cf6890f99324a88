//! Tests how byte streams are split into frames: delimiters, escapes and errors.

use lexibus::framing::{Check, Delimited, FrameError, Framing};
use lexibus::LengthError;

/// The framing of a real drive on RS-485. A frame consists of STX, data, checksum and ETX. The bytes 0x02, 0x03 and
/// 0x1B are replaced with 0x1B and their complement.
const DRIVE: Delimited = Delimited::new(Some(0x02), 0x03)
    .with_escape(0x1B, 0xFF, &[0x02, 0x03, 0x1B])
    .with_check(Check::Xor(0xFF))
    .with_max_data(68);

/// Decodes a stream. Returns the frames and errors.
fn decoded(framing: &Delimited, stream: &[u8]) -> Vec<Result<Vec<u8>, FrameError>> {
    let (mut decoder, mut data, mut found) = (framing.decoder(), [0; 80], Vec::new());
    for byte in stream {
        match framing.decode(&mut decoder, *byte, &mut data) {
            Ok(None) => {}
            Ok(Some(length)) => found.push(Ok(data[..length].to_vec())),
            Err(error) => found.push(Err(error)),
        }
    }
    found
}

fn encoded(framing: &Delimited, data: &[u8]) -> Vec<u8> {
    let mut frame = [0; 200];
    let length = framing.encode(data, &mut frame).expect("it fits");
    frame[..length].to_vec()
}

/// Messages with their frames. The checksums were calculated by hand.
const FRAMES: [(&[u8], &[u8]); 7] = [
    (&[0x05, 0x08, 0x9C, 0, 0, 0], &[0x02, 0x05, 0x08, 0x9C, 0, 0, 0, 0x6E, 0x03]),
    (&[0x01, 0x02, 0x6F, 0x9E, 0x00, 0x1B], &[0x02, 0x01, 0x1B, 0xFD, 0x6F, 0x9E, 0x00, 0x1B, 0xE4, 0x16, 0x03]),
    (&[0x01, 0x01, 0xAB, 0x34, 0x01, 0x02], &[0x02, 0x01, 0x01, 0xAB, 0x34, 0x01, 0x1B, 0xFD, 0x63, 0x03]),
    (&[0x01, 0x08, 0xE0, 0x00, 0xFD, 0xBE], &[0x02, 0x01, 0x08, 0xE0, 0x00, 0xFD, 0xBE, 0x55, 0x03]),
    (&[0x01, 0x08, 0x00], &[0x02, 0x01, 0x08, 0x00, 0xF6, 0x03]),
    (&[0x01, 0x02, 0x10, 0xAB, 0x09, 0xC1], &[0x02, 0x01, 0x1B, 0xFD, 0x10, 0xAB, 0x09, 0xC1, 0x8F, 0x03]),
    (&[0x01, 0x02, 0xB0, 0x00, 0xFD, 0xBE], &[0x02, 0x01, 0x1B, 0xFD, 0xB0, 0x00, 0xFD, 0xBE, 0x0F, 0x03]),
];

#[test]
fn byte_by_byte() {
    for (data, frame) in FRAMES {
        assert_eq!(encoded(&DRIVE, data), frame);
        assert_eq!(decoded(&DRIVE, frame), [Ok(data.to_vec())]);
    }
    let stream: Vec<u8> = FRAMES.iter().flat_map(|(_, frame)| frame.iter().copied()).collect();
    let all: Vec<_> = FRAMES.iter().map(|(data, _)| Ok(data.to_vec())).collect();
    assert_eq!(decoded(&DRIVE, &stream), all);
}

/// Returns framings with all kinds of checksums, with and without a start byte. They escape special bytes, so the data
/// can contain any byte.
fn framings() -> Vec<Delimited> {
    let mut all = Vec::new();
    for check in [Check::None, Check::Xor(0), Check::Sum(7), Check::Lrc(0), Check::Crc16(0xFFFF)] {
        // These framings XOR escaped bytes with 0, 0xFF or 0x20. One framing has the same start and end byte.
        let framings = [
            Delimited::new(Some(0x02), 0x03).with_escape(0x10, 0x00, &[0x02, 0x03, 0x10]),
            Delimited::new(Some(0x02), 0x03).with_escape(0x1B, 0xFF, &[0x02, 0x03, 0x1B]),
            Delimited::new(Some(0x7E), 0x7E).with_escape(0x7D, 0x20, &[0x7E, 0x7D]),
            Delimited::new(None, 0x0D).with_escape(0x1B, 0x20, &[0x0D, 0x1B]),
        ];
        all.extend(framings.map(|framing| framing.with_check(check)));
    }
    let from = |check_from| move |framing: Delimited| Delimited { check_from, ..framing };
    let more: Vec<_> = all.iter().copied().map(from(1)).chain(all.iter().copied().map(from(9))).collect();
    all.extend(more);
    all
}

#[test]
fn special_bytes_at_every_position() {
    for framing in framings() {
        for length in 1..6 {
            for place in 0..length {
                for special in [0x02, 0x03, 0x0D, 0x10, 0x1B, 0x7D, 0x7E, 0xFD, 0xFC, 0xE4, 0x00, 0xFF] {
                    for fill in [0x41, 0x02, 0x1B, 0x7E] {
                        let mut data = vec![fill; length];
                        data[place] = special;
                        let frame = encoded(&framing, &data);
                        assert_eq!(decoded(&framing, &frame), [Ok(data.clone())], "{framing:?}");
                        assert_eq!(decoded(&framing, &frame.repeat(3)), vec![Ok(data); 3], "{framing:?}");
                    }
                }
            }
        }
    }
}

#[test]
fn checks_that_have_to_be_escaped() {
    // The checksum of a single data byte is its complement. The checksums of 0xFD, 0xFC and 0xE4 equal the start, end
    // and escape bytes.
    for (byte, escaped) in [(0xFD, 0xFD), (0xFC, 0xFC), (0xE4, 0xE4)] {
        assert_eq!(encoded(&DRIVE, &[byte]), [0x02, byte, 0x1B, escaped, 0x03]);
        assert_eq!(decoded(&DRIVE, &encoded(&DRIVE, &[byte])), [Ok(vec![byte])]);
    }
}

#[test]
fn noise_in_front_and_what_is_cut_off() {
    for (data, frame) in FRAMES {
        for cut in 1..frame.len() {
            // The stream consists of the end of a frame, which is noise, and a complete frame.
            let late = [&frame[cut..], frame].concat();
            let found = decoded(&DRIVE, &late);
            assert_eq!(found.last(), Some(&Ok(data.to_vec())), "{late:02X?}");
            // The stream consists of the start of a frame and a complete frame.
            let early = [&frame[..cut], frame].concat();
            let lost = if frame[cut - 1] == 0x1B { FrameError::Escape } else { FrameError::Interrupted };
            assert_eq!(decoded(&DRIVE, &early), [Err(lost), Ok(data.to_vec())], "{early:02X?}");
        }
    }
    assert_eq!(decoded(&DRIVE, &[0x00, 0xFF, 0x03, 0x1B, 0x03, 0x1B]), []);
}

#[test]
fn every_bit_that_flips_is_noticed_and_the_next_frame_found() {
    let next = [0x07, 0x02, 0x03];
    let mut kinds = [0; 5];
    for (data, frame) in FRAMES {
        for (place, bit) in (0..frame.len()).flat_map(|place| (0..8).map(move |bit| (place, bit))) {
            let mut stream = frame.to_vec();
            stream[place] ^= 1 << bit;
            stream.extend(encoded(&DRIVE, &next));
            let found = decoded(&DRIVE, &stream);
            assert!(!found.contains(&Ok(data.to_vec())), "{stream:02X?}");
            let frames: Vec<_> = found.iter().flatten().collect();
            assert_eq!(frames, [&next.to_vec()], "{stream:02X?}");
            for error in found.iter().filter_map(|found| found.as_ref().err()) {
                kinds[*error as usize] += 1;
            }
        }
    }
    // All kinds of errors must occur except `TooLong`, which another test covers.
    assert!(kinds.iter().enumerate().all(|(kind, count)| (kind == FrameError::TooLong as usize) == (*count == 0)));
}

#[test]
fn lengths() {
    let longest = [0x02; 68];
    let frame = encoded(&DRIVE, &longest);
    assert_eq!(frame.len(), 1 + 2 * 68 + 1 + 1);
    assert_eq!(decoded(&DRIVE, &frame), [Ok(longest.to_vec())]);
    assert_eq!(DRIVE.encode(&[0; 69], &mut [0; 200]), Err(LengthError::new(68, 69)));
    assert_eq!(DRIVE.encode(&longest, &mut [0; 138]), Err(LengthError::new(139, 138)));
    assert_eq!(DRIVE.encode(&[], &mut [0; 3]), Ok(3));

    let any = Delimited { max_data: usize::MAX, ..DRIVE };
    let long = encoded(&any, &[0x41; 69]);
    let stream = [&long[..], &encoded(&DRIVE, &[1])].concat();
    assert_eq!(decoded(&DRIVE, &stream), [Err(FrameError::TooLong), Ok(vec![1])]);
    // The buffer is too short for the frame.
    let (mut decoder, mut data) = (DRIVE.decoder(), [0; 2]);
    let frame = encoded(&DRIVE, &[5, 6, 7]);
    let errors: Vec<_> = frame.iter().filter_map(|byte| DRIVE.decode(&mut decoder, *byte, &mut data).err()).collect();
    assert_eq!(errors, [FrameError::TooLong]);
    for (frame, found) in [
        (&[0x02, 0x03][..], vec![Err(FrameError::TooShort)]),
        // The next frame contains no data.
        (&[0x02, 0xFF, 0x03], vec![Ok(vec![])]),
        (&[0x02, 0x41, 0x1B, 0x03], vec![Err(FrameError::Escape)]),
        (&[0x02, 0x41, 0x1B, 0x41, 0x03], vec![Err(FrameError::Escape)]),
    ] {
        assert_eq!(decoded(&DRIVE, frame), found, "{frame:02X?}");
    }
}

#[test]
fn frames_without_a_first_byte() {
    let line = Delimited::new(None, b'\r').with_max_data(8);
    assert_eq!(encoded(&line, b"POS?"), b"POS?\r");
    let found = decoded(&line, b"1234\rtoo long for it\r\r-7\r");
    let text = |text: &[u8]| Ok(text.to_vec());
    assert_eq!(found, [text(b"1234"), Err(FrameError::TooLong), text(b""), text(b"-7")]);
}

#[test]
fn frames_that_share_a_byte() {
    let flags = Delimited::new(Some(0x7E), 0x7E).with_escape(0x7D, 0x20, &[0x7E, 0x7D]);
    let found = decoded(&flags, &[9, 0x7E, 0x7E, 1, 0x7D, 0x5E, 0x7E, 2, 0x7E, 0x7E]);
    assert_eq!(found, [Ok(vec![1, 0x7E]), Ok(vec![2])]);
}

#[test]
fn checks_that_are_not_escaped() {
    let raw = Delimited { is_check_escaped: false, ..DRIVE };
    // The checksums of 0xFD, 0xFC and 0xE4 equal the start, end and escape bytes.
    for (byte, check) in [(0xFD, 0x02), (0xFC, 0x03), (0xE4, 0x1B), (0x41, 0xBE)] {
        assert_eq!(encoded(&raw, &[byte]), [0x02, byte, check, 0x03]);
    }
    for length in 1..5 {
        for byte in 0..=255 {
            let mut data = vec![0x41; length];
            data[length - 1] = byte;
            let stream = [encoded(&raw, &data), encoded(&raw, &[7])].concat();
            assert_eq!(decoded(&raw, &stream), [Ok(data), Ok(vec![7])], "{stream:02X?}");
        }
    }
    let next = encoded(&raw, &[7]);
    for (frame, error) in [
        (&[0x02, 0x41, 0xBF, 0x03][..], FrameError::Check),
        (&[0x02, 0x41, 0x41][..], FrameError::Interrupted),
        (&[0x02, 0x1B, 0x41, 0x41, 0x41, 0x03], FrameError::Escape),
        (&[0x02, 0x03], FrameError::TooShort),
    ] {
        let found = decoded(&raw, &[frame, &next].concat());
        assert_eq!(found, [Err(error), Ok(vec![7])], "{frame:02X?}");
    }
    let crc = Delimited { check: Check::Crc16(0xFFFF), ..raw };
    for byte in 0..=255 {
        let data = vec![0x41, byte];
        assert_eq!(decoded(&crc, &encoded(&crc, &data).repeat(2)), vec![Ok(data); 2], "{byte:02X}");
    }
}

#[test]
fn a_borrowed_framing_frames() {
    fn there_and_back<F: Framing>(framing: F, data: &[u8]) -> Option<Result<usize, FrameError>> {
        let (mut frame, mut back, mut decoder) = ([0; 32], [0; 32], framing.decoder());
        let length = framing.encode(data, &mut frame).expect("it fits");
        frame[..length].iter().find_map(|byte| framing.decode(&mut decoder, *byte, &mut back).transpose())
    }
    let borrowed: &Delimited = &DRIVE;
    assert_eq!(there_and_back(borrowed, &[1, 2, 3]), Some(Ok(3)));
}

/// Returns the next pseudo-random byte and updates the seed.
fn noise(seed: &mut u32) -> u8 {
    *seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
    (*seed >> 24) as u8
}

#[test]
fn whatever_comes_a_frame_behind_it_is_found() {
    let mut seed = 1;
    for framing in framings().into_iter().filter(|framing| framing.start.is_some_and(|start| start != framing.end)) {
        let framing = framing.with_max_data(12);
        for _ in 0..300 {
            let count = usize::from(noise(&mut seed) % 32);
            let mut stream: Vec<u8> = (0..count)
                .map(|_| match noise(&mut seed) {
                    byte @ 0..=127 => [0x02, 0x03, 0x10, 0x1B][usize::from(byte % 4)],
                    byte => byte,
                })
                .collect();
            // Append a byte, because an escape at the end of the noise would consume the first byte of the frame.
            stream.push(0x41);
            let data = vec![0x02, noise(&mut seed), 0x1B];
            stream.extend(encoded(&framing, &data));
            assert_eq!(decoded(&framing, &stream).last(), Some(&Ok(data)), "{framing:?} {stream:02X?}");
        }
    }
}
