//! Unit numbers: a power of ten, a unit, and a denominator unit (ETG.1004, CiA 303-2).

use compact_str::{format_compact, CompactString};

/// Returns the symbol of the unit with this number, or `None` if a unit in the number is unknown or the last byte is not 0. `units`
/// contains the units that the dictionary defines.
pub fn text(number: u32, units: &[(u32, CompactString)]) -> Option<CompactString> {
    let [exponent, numerator, denominator, rest] = number.to_be_bytes();
    if rest != 0 {
        return None;
    }
    let symbol = |notation: u8| {
        let defined = || units.iter().find(|(number, _)| *number == u32::from(notation));
        symbol(notation).or_else(|| defined().map(|(_, symbol)| symbol.as_str()))
    };
    let numerator = match numerator {
        0 if denominator != 0 => "1",
        0 => return None,
        known => symbol(known)?,
    };
    let mut text = prefixed(exponent as i8, numerator);
    if denominator != 0 {
        text.push('/');
        text.push_str(symbol(denominator)?);
    }
    Some(text)
}

/// Returns the number of the unit with the symbol `unit` (see [`text`]).
pub fn number(unit: &str) -> Option<u32> {
    let units = || (1..=u8::MAX).filter(|notation| symbol(*notation).is_some());
    for exponent in -12i8..=9 {
        for numerator in units() {
            for denominator in std::iter::once(0).chain(units()) {
                let number = u32::from_be_bytes([exponent.to_be_bytes()[0], numerator, denominator, 0]);
                if text(number, &[]).as_deref() == Some(unit) {
                    return Some(number);
                }
            }
        }
    }
    let inverse = |denominator: u8| (u32::from(denominator) << 8, text(u32::from(denominator) << 8, &[]));
    units().map(inverse).find(|(_, text)| text.as_deref() == Some(unit)).map(|(number, _)| number)
}

/// Returns the symbol of a unit by its notation index, if it is known.
fn symbol(notation: u8) -> Option<&'static str> {
    Some(match notation {
        0x01 => "m",
        0x02 => "kg",
        0x03 => "s",
        0x04 => "A",
        0x05 => "K",
        0x06 => "mol",
        0x07 => "cd",
        0x10 => "rad",
        0x20 => "Hz",
        0x21 => "N",
        0x22 => "Pa",
        0x23 => "J",
        0x24 => "W",
        0x25 => "C",
        0x26 => "V",
        0x27 => "F",
        0x28 => "Ω",
        0x2D => "°C",
        0x41 => "°",
        0x47 => "min",
        0x48 => "h",
        0xB4 => "rev",
        _ => return None,
    })
}

fn prefixed(exponent: i8, symbol: &str) -> CompactString {
    let prefix = match exponent {
        0 => "",
        -12 => "p",
        -9 => "n",
        -6 => "µ",
        -3 => "m",
        -2 => "c",
        -1 => "d",
        3 => "k",
        6 => "M",
        9 => "G",
        _ => "·",
    };
    // Some units get a power of ten instead of a prefix: kilograms already have a prefix, and millidegrees are unusual.
    let plain = symbol.starts_with(|letter: char| letter.is_ascii_alphabetic() || letter == 'Ω');
    match prefix {
        "" => symbol.into(),
        "·" => format_compact!("10^{exponent} {symbol}"),
        _ if symbol == "kg" || symbol == "rev" || symbol == "min" || symbol == "h" || !plain => {
            format_compact!("10^{exponent} {symbol}")
        }
        _ => format_compact!("{prefix}{symbol}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_put_together() {
        let unit = |number| text(number, &[(0xA1, "mG".into())]);
        assert_eq!(unit(0xF703_0000).as_deref(), Some("ns"));
        assert_eq!(unit(0x0026_0000).as_deref(), Some("V"));
        assert_eq!(unit(0xFD01_0300).as_deref(), Some("mm/s"));
        assert_eq!(unit(0x00B4_4700).as_deref(), Some("rev/min"));
        assert_eq!(unit(0xFD2D_0000).as_deref(), Some("10^-3 °C"));
        assert_eq!(unit(0x00A1_0000).as_deref(), Some("mG"));
        assert_eq!(unit(0x0000_4700).as_deref(), Some("1/min"));
        for known in [0xF703_0000, 0x0026_0000, 0xFD01_0300, 0x00B4_4700, 0xFD2D_0000, 0x0000_4700] {
            assert_eq!(unit(known).and_then(|text| number(&text)), Some(known), "{known:#x}");
        }
        assert_eq!((number("mG"), number("")), (None, None));
        for unknown in [0, 0x00F1_0000, 0x0026_F100, 0x0026_0001] {
            assert_eq!(unit(unknown), None, "{unknown:#x}");
        }
    }
}
