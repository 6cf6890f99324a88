//! Tests values of all data types in both directions. Generated accessors encode and decode the values on one side, and
//! the Python library on the other side.

use lexibus::{TimeDifference, TimeOfDay};
use serde_json::{json, Value};

use super::all_types::AllTypes;
use super::{start, Error};

const FILE: &str = "tests/interop/all-types.toml";

/// Writes `$value` and checks that the node contains `$json`. Also sets `$json` on the node and checks that reading
/// returns `$value`.
macro_rules! exchange {
    ($script:ident, $device:ident, $($accessor:ident at $index:literal: [$($value:expr => $json:expr),* $(,)?];)*) => {$(
        $(
            $device.$accessor().write($value)?;
            assert_eq!($script.get($index, 0), json!($json), "{} written", stringify!($accessor));
        )*
        $(
            $script.set($index, 0, json!($json));
            assert_eq!($device.$accessor().read()?, $value, "{} read", stringify!($accessor));
        )*
    )*};
}

#[test]
fn booleans_and_integers_of_usual_widths() -> Result<(), Error> {
    let Some((mut script, node)) = start("usual-widths", FILE) else { return Ok(()) };
    let mut device = AllTypes::new(node);
    exchange! { script, device,
        boolean at 0x2001: [true => true, false => false];
        integer8 at 0x2002: [i8::MIN => -128, -2 => -2, 5 => 5, i8::MAX => 127];
        integer16 at 0x2003: [i16::MIN => -32768, -2 => -2, 0x1234 => 0x1234, i16::MAX => 32767];
        integer32 at 0x2004: [i32::MIN => i32::MIN, -2 => -2, 0x1234_5678 => 0x1234_5678, i32::MAX => i32::MAX];
        integer64 at 0x2015: [
            i64::MIN => i64::MIN,
            -2 => -2,
            0x0123_4567_89AB_CDEF => 0x0123_4567_89AB_CDEF_u64,
            i64::MAX => i64::MAX,
        ];
        unsigned8 at 0x2005: [0 => 0, 0xA5 => 0xA5, u8::MAX => 255];
        unsigned16 at 0x2006: [0 => 0, 0xA55A => 0xA55A, u16::MAX => 65535];
        unsigned32 at 0x2007: [0 => 0, 0x89AB_CDEF => 0x89AB_CDEF_u32, u32::MAX => u32::MAX];
        unsigned64 at 0x201B: [0 => 0, 0xFEDC_BA98_7654_3210 => 0xFEDC_BA98_7654_3210_u64, u64::MAX => u64::MAX];
    }
    Ok(())
}

#[test]
fn integers_of_odd_widths() -> Result<(), Error> {
    let Some((mut script, node)) = start("odd-widths", FILE) else { return Ok(()) };
    let mut device = AllTypes::new(node);
    exchange! { script, device,
        integer24 at 0x2010: [-0x80_0000 => -0x80_0000, -2 => -2, 0x12_3456 => 0x12_3456, 0x7F_FFFF => 0x7F_FFFF];
        integer40 at 0x2012: [
            -0x80_0000_0000 => -0x80_0000_0000_i64,
            -2 => -2,
            0x12_3456_789A => 0x12_3456_789A_i64,
            0x7F_FFFF_FFFF => 0x7F_FFFF_FFFF_i64,
        ];
        integer48 at 0x2013: [
            -0x8000_0000_0000 => -0x8000_0000_0000_i64,
            -2 => -2,
            0x1234_5678_9ABC => 0x1234_5678_9ABC_i64,
            0x7FFF_FFFF_FFFF => 0x7FFF_FFFF_FFFF_i64,
        ];
        integer56 at 0x2014: [
            -0x80_0000_0000_0000 => -0x80_0000_0000_0000_i64,
            -2 => -2,
            0x12_3456_789A_BCDE => 0x12_3456_789A_BCDE_i64,
            0x7F_FFFF_FFFF_FFFF => 0x7F_FFFF_FFFF_FFFF_i64,
        ];
        unsigned24 at 0x2016: [0 => 0, 0x89_ABCD => 0x89_ABCD, 0xFF_FFFF => 0xFF_FFFF];
        unsigned40 at 0x2018: [0 => 0, 0x89_ABCD_EF01 => 0x89_ABCD_EF01_u64, 0xFF_FFFF_FFFF => 0xFF_FFFF_FFFF_u64];
        unsigned48 at 0x2019: [0 => 0, 0x89AB_CDEF_0123 => 0x89AB_CDEF_0123_u64, 0xFFFF_FFFF_FFFF => 0xFFFF_FFFF_FFFF_u64];
        unsigned56 at 0x201A: [
            0 => 0,
            0x89_ABCD_EF01_2345 => 0x89_ABCD_EF01_2345_u64,
            0xFF_FFFF_FFFF_FFFF => 0xFF_FFFF_FFFF_FFFF_u64,
        ];
    }
    Ok(())
}

#[test]
fn floating_point_and_times() -> Result<(), Error> {
    let Some((mut script, node)) = start("floats", FILE) else { return Ok(()) };
    let mut device = AllTypes::new(node);
    // 8 January 2024 is day 14617 after 1 January 1984. The last possible date is 6 June 2163.
    let afternoon = ((15 * 60 + 4) * 60 + 5) * 1000 + 678;
    exchange! { script, device,
        real32 at 0x2008: [0.0 => 0.0, -1.5 => -1.5, 16_777_215.0 => 16_777_215.0, f32::MAX => f64::from(f32::MAX)];
        real64 at 0x2011: [0.0 => 0.0, -0.1 => -0.1, 1e300 => 1e300, f64::MIN_POSITIVE => f64::MIN_POSITIVE];
        time_of_day at 0x200C: [
            TimeOfDay::new(0, 0) => "1984-01-01T00:00:00.000",
            TimeOfDay::new(afternoon, 14_617) => "2024-01-08T15:04:05.678",
            TimeOfDay::new(86_399_999, u16::MAX) => "2163-06-06T23:59:59.999",
        ];
        time_difference at 0x200D: [
            TimeDifference::new(0, 0) => 0,
            TimeDifference::new(afternoon, 3) => 3 * 86_400_000_u64 + u64::from(afternoon),
        ];
    }
    Ok(())
}

/// Returns a text of `length` printable ASCII characters.
fn letters(length: usize) -> String {
    ('!'..='~').cycle().take(length).collect()
}

/// Lengths of texts. The list includes the first length that is too long for an expedited transfer, and lengths around
/// changes of the number of segments.
const LENGTHS: [usize; 11] = [1, 3, 4, 5, 7, 8, 14, 15, 127, 300, 399];

#[test]
fn visible_strings_in_segments() -> Result<(), Error> {
    let Some((mut script, node)) = start("visible-strings", FILE) else { return Ok(()) };
    let mut device = AllTypes::new(node);
    let mut buffer = [0; 512];
    assert_eq!(device.device_name().read_into(&mut buffer)?, "A node that has an object of every type");
    for length in LENGTHS {
        let text = letters(length);
        device.visible_string().write(&text)?;
        assert_eq!(script.get(0x2009, 0), text.as_str());
        let text: String = text.chars().rev().collect();
        script.set(0x2009, 0, text.as_str().into());
        assert_eq!(device.visible_string().read_into(&mut buffer)?, text);
    }
    Ok(())
}

#[test]
fn unicode_strings_in_segments() -> Result<(), Error> {
    let Some((mut script, node)) = start("unicode-strings", FILE) else { return Ok(()) };
    let mut device = AllTypes::new(node);
    let (mut scratch, mut buffer) = ([0; 512], [0; 512]);
    for text in ["µ", "Ωm", "5 °C", "Zürich", "日本語のテキスト", "a surrogate pair: 😀", &"→".repeat(200)]
    {
        device.unicode_string().write(text, &mut scratch)?;
        assert_eq!(script.get(0x200B, 0), text);
        let text: String = text.chars().rev().collect();
        script.set(0x200B, 0, text.as_str().into());
        assert_eq!(device.unicode_string().read_into(&mut buffer)?, *text);
    }
    Ok(())
}

/// Formats `data` in the notation of the script.
pub fn hex(data: &[u8]) -> Value {
    data.iter().map(|byte| format!("{byte:02x}")).collect::<String>().into()
}

#[test]
fn bytes_in_segments() -> Result<(), Error> {
    let Some((mut script, node)) = start("bytes", FILE) else { return Ok(()) };
    let mut device = AllTypes::new(node);
    let mut buffer = [0; 512];
    for length in LENGTHS {
        // All bytes are significant, including zeros at the end.
        let data: Vec<u8> = (0..length).rev().map(|at| at as u8).collect();
        let back: Vec<u8> = data.iter().map(|byte| !byte).collect();
        device.octet_string().write(&data)?;
        assert_eq!(script.get(0x200A, 0), hex(&data));
        script.set(0x200A, 0, hex(&back));
        assert_eq!(device.octet_string().read_into(&mut buffer)?, back);
        device.domain().write(&back)?;
        assert_eq!(script.get(0x200F, 0), hex(&back));
        script.set(0x200F, 0, hex(&data));
        assert_eq!(device.domain().read_into(&mut buffer)?, data);
    }
    Ok(())
}
