//! Bit fields: integers whose bits have names.

use core::fmt;

/// Writes a bit field for `Debug`: the flags that are set, the fields with their values, and in hexadecimal what else is
/// set. Generated code calls it.
///
/// ```
/// use core::fmt;
/// use lexibus::DebugBits;
///
/// struct Status(u16);
///
/// impl fmt::Debug for Status {
///     fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
///         DebugBits::new(f, "Status", self.0.into())
///             .plain(&[("running", 0x1), ("level", 0xC)])
///             .inverted("fault", 0x10)
///             .field("mode", 0x60, &['a', 'b', 'c', 'd'][usize::from(self.0 >> 5 & 3)])
///             .finish()
///     }
/// }
///
/// assert_eq!(format!("{:?}", Status(0x8025)), "Status { running, level: 1, fault, mode: 'b', 0x8000 }");
/// ```
pub struct DebugBits<'f, 'a> {
    f: &'f mut fmt::Formatter<'a>,
    raw: u64,
    /// The bits that have a name.
    known: u64,
    any: bool,
    result: fmt::Result,
}

impl<'f, 'a> DebugBits<'f, 'a> {
    /// Starts with the name of the type.
    pub fn new(f: &'f mut fmt::Formatter<'a>, name: &str, raw: u64) -> Self {
        let result = f.write_str(name);
        Self { f, raw, known: 0, any: false, result }
    }

    /// Flags and plain numbers, by the bits that they have: one bit is a flag, several are a number.
    ///
    /// Most fields are such, and the compiler checks one list much faster than a call for each.
    #[must_use]
    pub fn plain(mut self, fields: &[(&str, u64)]) -> Self {
        for &(name, mask) in fields {
            let bits = self.raw & mask;
            self = match mask.count_ones() {
                0 | 1 => self.named(name, mask, bits != 0),
                _ => self.field(name, mask, &(bits >> mask.trailing_zeros())),
            };
        }
        self
    }

    /// A flag that is set while its bit is 0.
    #[must_use]
    pub fn inverted(self, name: &str, mask: u64) -> Self {
        let is_set = self.raw & mask == 0;
        self.named(name, mask, is_set)
    }

    /// A field with its value.
    #[must_use]
    pub fn field(mut self, name: &str, mask: u64, value: &dyn fmt::Debug) -> Self {
        self.known |= mask;
        self.entry(format_args!("{name}: {value:?}"));
        self
    }

    /// Ends with the bits that have no name.
    ///
    /// # Errors
    ///
    /// Those of the formatter.
    pub fn finish(mut self) -> fmt::Result {
        let rest = self.raw & !self.known;
        if rest != 0 {
            self.entry(format_args!("{rest:#X}"));
        }
        self.result?;
        self.f.write_str(if self.any { " }" } else { "" })
    }

    fn named(mut self, name: &str, mask: u64, is_set: bool) -> Self {
        self.known |= mask;
        if is_set {
            self.entry(format_args!("{name}"));
        }
        self
    }

    fn entry(&mut self, text: fmt::Arguments<'_>) {
        if self.result.is_ok() {
            let start = if self.any { ", " } else { " { " };
            self.any = true;
            self.result = self.f.write_str(start).and_then(|()| self.f.write_fmt(text));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::format;

    struct Bits(u64);

    impl fmt::Debug for Bits {
        fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            DebugBits::new(f, "Bits", self.0).plain(&[("a", 1), ("b", 0xF0)]).finish()
        }
    }

    struct None(u64);

    impl fmt::Debug for None {
        fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            DebugBits::new(f, "None", self.0).plain(&[("a", 1), ("nothing", 0)]).finish()
        }
    }

    #[test]
    fn names_what_is_set() {
        assert_eq!(format!("{:?}", Bits(0)), "Bits { b: 0 }");
        assert_eq!(format!("{:?}", Bits(0x8000_0000_0000_0031)), "Bits { a, b: 3, 0x8000000000000000 }");
        assert_eq!(format!("{:?} {:?}", None(0), None(2)), "None None { 0x2 }");
    }
}
