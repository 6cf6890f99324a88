//! A field of a fixed process image.

use crate::backend::rust::scope::Scope;
use crate::ir::{Binding, Direction, ImageBinding, Type};

/// A field of a fixed process image.
#[derive(Clone, Copy, Debug)]
pub(super) struct Field<'i> {
    pub image: &'i str,
    pub first: u32,
    pub bits: u32,
    pub ty: Option<Type>,
    /// Whether the device gets it.
    pub is_output: bool,
    big_endian: bool,
}

impl<'i> Field<'i> {
    /// The field of a value of type `base`, where the runtime reads such a one.
    pub fn of(scope: &Scope<'_>, base: Type, binding: &'i Binding) -> Option<Self> {
        let Binding::Image(binding) = binding else { return None };
        let ImageBinding { image, bit_offset, bits, ty } = &**binding;
        let own = scope.image(image).filter(|_| is_field(base, *bit_offset, *bits))?;
        Some(Field {
            image,
            first: *bit_offset,
            bits: *bits,
            ty: *ty,
            is_output: own.direction == Direction::Receive,
            big_endian: own.big_endian,
        })
    }

    /// The code that makes it.
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

/// Whether the runtime reads such a value from an image: a number within 8 bytes, or bytes that lie as they are.
fn is_field(ty: Type, first: u32, bits: u32) -> bool {
    match ty {
        Type::VisibleString(_) | Type::OctetString(_) | Type::Opaque(_) => {
            first.is_multiple_of(8) && bits <= u16::MAX.into()
        }
        Type::UnicodeString(_) | Type::Domain => false,
        _ => first % 8 + bits <= 64,
    }
}
