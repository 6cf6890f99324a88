//! Bit fields: integers whose bits have names.

use core::fmt;

use crate::enumeration::Enumeration;
use crate::value::Value;

/// An integer whose bits have names. Generated bit fields implement this trait.
pub trait BitField: Enumeration
where
    <Self::Base as Value>::Native: Into<u64>,
{
    /// Name of the type, and names and masks of its fields, in the format of the argument `layout` of [`debug_bits`].
    const LAYOUT: &'static str;

    /// Returns the names of the flags that are set, in the order of the device description. An active-low flag is set
    /// if its bit is 0. The iterator skips fields of several bits and fields with an enumeration type.
    fn set_flags(self) -> SetFlags {
        SetFlags { raw: self.as_is().into(), fields: fields(Self::LAYOUT).1.split_terminator(' ') }
    }
}

/// Iterator over the names of the set flags of a bit field.
#[derive(Clone, Debug)]
pub struct SetFlags {
    raw: u64,
    fields: core::str::SplitTerminator<'static, char>,
}

impl Iterator for SetFlags {
    type Item = &'static str;

    fn next(&mut self) -> Option<&'static str> {
        let raw = self.raw;
        self.fields.find_map(|text| {
            let field = Field::parse(text);
            (!field.is_value && field.mask.count_ones() == 1 && field.is_set(raw)).then_some(field.name)
        })
    }
}

/// An element of a layout.
struct Field<'l> {
    name: &'l str,
    mask: u64,
    /// True if the flag is active low, that is, active while its bit is 0.
    is_inverted: bool,
    /// True if the field has an enumeration type.
    is_value: bool,
}

impl<'l> Field<'l> {
    fn parse(text: &'l str) -> Self {
        let (name, mask) = text.split_once(':').unwrap_or((text, ""));
        let mask = u64::from_str_radix(mask, 16).unwrap_or(0);
        let (inverted, value) = (name.strip_prefix('!'), name.strip_prefix('?'));
        let name = inverted.or(value).unwrap_or(name);
        Field { name, mask, is_inverted: inverted.is_some(), is_value: value.is_some() }
    }

    fn is_set(&self, raw: u64) -> bool {
        (raw & self.mask != 0) != self.is_inverted
    }
}

/// Splits a layout into the name of the type and the fields.
fn fields(layout: &str) -> (&str, &str) {
    layout.split_once(' ').unwrap_or((layout, ""))
}

/// Formats a bit field for `Debug`. The output contains the flags that are set and the fields with their values. Set
/// bits that belong to no field follow in hexadecimal. Generated code calls this function.
///
/// `layout` is the name of the type, followed by `name:mask` for every field, separated by spaces. Masks are
/// hexadecimal. A field with a mask of one bit is a flag, and a field with a mask of several bits is a number.
/// `!name:mask` is a flag that is set if its bit is 0. For `?name:mask`, the output contains the next element of
/// `values` instead of the bits.
///
/// # Errors
///
/// Returns the errors of the formatter.
///
/// ```
/// use core::fmt;
///
/// struct Status(u16);
///
/// impl fmt::Debug for Status {
///     fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
///         let mode = ['a', 'b', 'c', 'd'][usize::from(self.0 >> 5 & 3)];
///         lexibus::debug_bits(f, self.0.into(), "Status running:1 level:c !fault:10 ?mode:60", &[&mode])
///     }
/// }
///
/// assert_eq!(format!("{:?}", Status(0x8025)), "Status { running, level: 1, fault, mode: 'b', 0x8000 }");
/// ```
pub fn debug_bits(f: &mut fmt::Formatter<'_>, raw: u64, layout: &str, values: &[&dyn fmt::Debug]) -> fmt::Result {
    let (title, fields) = fields(layout);
    f.write_str(title)?;
    let mut entries = Entries { f, any: false };
    let (mut named, mut values) = (0, values.iter());
    for text in fields.split_terminator(' ') {
        let field = Field::parse(text);
        let Field { name, mask, is_inverted, is_value } = field;
        named |= mask;
        if is_value {
            if let Some(value) = values.next() {
                entries.write(format_args!("{name}: {value:?}"))?;
            }
        } else if is_inverted || mask.count_ones() < 2 {
            entries.flag(name, field.is_set(raw))?;
        } else {
            entries.write(format_args!("{name}: {}", (raw & mask) >> mask.trailing_zeros()))?;
        }
    }
    if raw & !named != 0 {
        entries.write(format_args!("{:#X}", raw & !named))?;
    }
    entries.f.write_str(if entries.any { " }" } else { "" })
}

/// Writer of the entries between the braces.
struct Entries<'f, 'a> {
    f: &'f mut fmt::Formatter<'a>,
    any: bool,
}

impl Entries<'_, '_> {
    fn flag(&mut self, name: &str, is_set: bool) -> fmt::Result {
        match is_set {
            true => self.write(format_args!("{name}")),
            false => Ok(()),
        }
    }

    fn write(&mut self, text: fmt::Arguments<'_>) -> fmt::Result {
        self.f.write_str(if self.any { ", " } else { " { " })?;
        self.any = true;
        self.f.write_fmt(text)
    }
}

/// Defines functions that access the bits of an integer. Generated code calls these functions, because function calls
/// compile faster than operators.
macro_rules! bits {
    ($($module:ident $native:ident)*) => {
        $(
            #[doc(hidden)]
            pub mod $module {
                /// Returns whether at least one bit of the mask is set in `bits`.
                #[inline]
                pub const fn flag(bits: $native, mask: $native) -> bool {
                    bits & mask != 0
                }

                /// Returns `bits` with all bits of the mask set or cleared.
                #[inline]
                #[must_use]
                pub const fn with_flag(bits: $native, mask: $native, value: bool) -> $native {
                    if value {
                        bits | mask
                    } else {
                        bits & !mask
                    }
                }

                /// Returns the number in those bits of `bits` that the mask selects. The bits of the mask must be
                /// adjacent.
                #[inline]
                pub const fn field(bits: $native, mask: $native) -> $native {
                    (bits & mask) >> (mask.trailing_zeros() & ($native::BITS - 1))
                }

                /// Returns `bits` with the low bits of `value` in the bits of the mask. The bits of the mask must be
                /// adjacent.
                #[inline]
                #[must_use]
                pub const fn with_field(bits: $native, mask: $native, value: $native) -> $native {
                    (bits & !mask) | ((value << (mask.trailing_zeros() & ($native::BITS - 1))) & mask)
                }
            }
        )*
    };
}

bits! { bits8 u8 bits16 u16 bits32 u32 bits64 u64 }

#[cfg(test)]
mod tests {
    use super::*;
    use std::format;

    struct Bits(&'static str, u64);

    impl fmt::Debug for Bits {
        fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            debug_bits(f, self.1, self.0, &[&'v'])
        }
    }

    #[test]
    fn names_what_is_set() {
        let layout = "Bits a:1 b:f0";
        assert_eq!(format!("{:?}", Bits(layout, 0)), "Bits { b: 0 }");
        let all = Bits(layout, 0x8000_0000_0000_0031);
        assert_eq!(format!("{all:?}"), "Bits { a, b: 3, 0x8000000000000000 }");
        assert_eq!(format!("{:?} {:?}", Bits("None a:1", 0), Bits("None a:1", 2)), "None None { 0x2 }");
        assert_eq!(format!("{:?} {:?}", Bits("Empty", 0), Bits("Empty", 1)), "Empty Empty { 0x1 }");
        let layout = "Both !off:1 ?mode:6 on:8000000000000000";
        assert_eq!(format!("{:?}", Bits(layout, 0)), "Both { off, mode: 'v' }");
        assert_eq!(format!("{:?}", Bits(layout, 0x8000_0000_0000_0007)), "Both { mode: 'v', on }");
    }

    #[test]
    fn a_field_keeps_the_other_bits() {
        assert!(bits8::flag(0x80, 0x80) && !bits64::flag(1, 2));
        assert_eq!((bits16::with_flag(0x8001, 1, false), bits16::with_flag(0, 0x10, true)), (0x8000, 0x10));
        assert_eq!((bits8::field(0xFF, 0xFF), bits32::field(0x1234_5678, 0xFF_0000)), (0xFF, 0x34));
        assert_eq!(bits64::field(u64::MAX, 0xF << 60), 0xF);
        assert_eq!(bits32::with_field(u32::MAX, 0x70, 0xFD), 0xFFFF_FFDF);
        assert_eq!(bits16::with_field(0xFF, 0x30, 2), 0xEF);
    }
}
