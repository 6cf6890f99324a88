//! Fields of fixed process images.

use crate::backend::rust::scope::Scope;
use crate::ir::{Binding, Direction, ImageBinding, Type};

/// A field of a fixed process image.
#[derive(Clone, Copy, Debug)]
pub(super) struct Field<'i> {
    pub image: &'i str,
    pub first: u32,
    pub bits: u32,
    pub ty: Option<Type>,
    /// True if the field is an output, that is, data that the device receives.
    pub is_output: bool,
    big_endian: bool,
}

impl<'i> Field<'i> {
    /// Creates the field of a value of type `base` from a binding. Returns `None` if the binding does not refer to a
    /// process image of the device, or if the runtime cannot read the field.
    pub fn of(scope: &Scope<'_>, base: Type, binding: &'i Binding) -> Option<Self> {
        let Binding::Image(binding) = binding else { return None };
        let ImageBinding { image, bit_offset, bits, ty } = &**binding;
        let process_image = scope.image(image).filter(|_| is_field(base, *bit_offset, *bits))?;
        Some(Field {
            image,
            first: *bit_offset,
            bits: *bits,
            ty: *ty,
            is_output: process_image.direction == Direction::Receive,
            big_endian: process_image.big_endian,
        })
    }

    /// Returns the code that creates the field.
    pub fn code(self, is_bytes: bool) -> String {
        let direction = if self.is_output { "output" } else { "input" };
        let code = format!("rt::ImageField::{direction}({}, {})", self.first, self.bits);
        match (is_bytes, self.big_endian) {
            (true, _) => format!("{code}.ordered(rt::ImageOrder::Bytes)"),
            (false, false) => format!("{code}.ordered(rt::ImageOrder::LittleEndian)"),
            (false, true) => code,
        }
    }
}

/// Returns whether the runtime can read the value from an image. The value must be a number within 8 bytes, or a
/// sequence of bytes that starts at a byte boundary and has at most 65,535 bits.
fn is_field(ty: Type, first: u32, bits: u32) -> bool {
    match ty {
        Type::VisibleString(_) | Type::OctetString(_) | Type::Opaque(_) => {
            first.is_multiple_of(8) && bits <= u16::MAX.into()
        }
        Type::UnicodeString(_) | Type::Domain => false,
        _ => first % 8 + bits <= 64,
    }
}
