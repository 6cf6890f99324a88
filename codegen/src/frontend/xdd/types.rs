//! Converts the data types of the application process to types of the device.

use super::application::{dangling, Application};
use super::data_type::{DataTypeKind, TypeRef};
use super::reader::Reader;
use crate::diagnostics::codes;
use crate::frontend::xml::Order;
use crate::ir::{Field, Shape, Type, TypeDef, TypeId};

/// Converts the data types of the application process to types of the device, in the same order.
pub(super) fn lower<'a>(reader: &mut Reader<'a, '_>, application: &mut Application<'a>) -> Vec<TypeDef> {
    let order = Order::new(application.types.len(), |at| parts(application, at));
    let mut bits: Vec<Option<u32>> = vec![None; application.types.len()];
    let mut shapes: Vec<Option<Shape>> = vec![None; application.types.len()];
    for &at in &order.sequence {
        let mut types = Types { reader, application, order: &order, bits: &bits, at };
        let (shape, length) = types.shape();
        (shapes[at], bits[at]) = (Some(shape), length);
    }
    let raw = std::mem::take(&mut application.types);
    let defs = raw.into_iter().zip(shapes).zip(bits);
    defs.map(|((raw, shape), bits)| TypeDef {
        documentation: raw.texts.documentation(),
        origin: raw.origin,
        ..TypeDef::new(raw.name, shape.unwrap_or(Shape::Alias(Type::Opaque(None))), bits)
    })
    .collect()
}

/// Returns the positions of the data types that the data type at `at` refers to.
fn parts<'p, 'a>(application: &'p Application<'a>, at: usize) -> impl Iterator<Item = usize> + use<'p, 'a> {
    let (variables, part) = match &application.types[at].kind {
        DataTypeKind::Struct(variables) => (variables.as_slice(), None),
        DataTypeKind::Array { element: part, .. }
        | DataTypeKind::Enum { base: part, .. }
        | DataTypeKind::Derived { base: part, .. } => (&[][..], part.as_ref()),
    };
    let of_variables = variables.iter().filter_map(|&variable| application.parameters[variable].ty.as_ref());
    of_variables.chain(part).filter_map(|ty| match ty {
        TypeRef::Named(given) => application.type_ids.get(given.text.as_ref()).copied(),
        TypeRef::Basic(..) => None,
    })
}

/// State for lowering the data type at `at`. `bits` contains the lengths of the types that were lowered before.
struct Types<'t, 'a, 'd> {
    reader: &'t mut Reader<'a, 'd>,
    application: &'t Application<'a>,
    order: &'t Order,
    bits: &'t [Option<u32>],
    at: usize,
}

impl<'t, 'a> Types<'t, 'a, '_> {
    fn shape(&mut self) -> (Shape, Option<u32>) {
        let application = self.application;
        match &application.types[self.at].kind {
            DataTypeKind::Array { dimensions, element } => {
                let element = self.part(element.as_ref());
                let count = dimensions.iter().try_fold(1u32, |count, dimension| count.checked_mul(dimension.1));
                let bits = self.length(element).zip(count).and_then(|(bits, count)| bits.checked_mul(count));
                (Shape::Array { element, dimensions: dimensions.clone() }, bits)
            }
            DataTypeKind::Struct(variables) => self.record(variables),
            DataTypeKind::Enum { base, values } => {
                let base = self.part(base.as_ref());
                let bits = self.length(base);
                (Shape::Enumeration { base, values: values.clone(), closed: false }, bits)
            }
            DataTypeKind::Derived { base, count } => {
                let base = self.part(base.as_ref());
                derived_shape(base, *count, self.length(base))
            }
        }
    }

    fn record(&mut self, variables: &[usize]) -> (Shape, Option<u32>) {
        let (mut fields, mut offset, mut known) = (Vec::with_capacity(variables.len()), 0u32, true);
        for &variable in variables {
            let variable = &self.application.parameters[variable];
            let ty = self.part(variable.ty.as_ref());
            let bits = self.length(ty);
            known &= bits.is_some();
            let bits = bits.unwrap_or(0);
            fields.push(Field { name: variable.texts.labels.name(), sub_index: None, ty, bits, bit_offset: offset });
            offset = offset.saturating_add(bits);
        }
        (Shape::Record(fields), known.then_some(offset))
    }

    /// Returns the type to which the reference `ty` of the data type refers. A circular or too deeply nested reference
    /// becomes raw bytes.
    fn part(&mut self, ty: Option<&TypeRef<'a>>) -> Type {
        let Some(ty) = ty else { return Type::Opaque(None) };
        let resolved = self.application.resolve(self.reader, ty);
        if let Type::Named(TypeId(part)) = resolved {
            if self.order.is_endless(self.at) && self.order.is_endless(part as usize) {
                let message = "the data type contains itself or is nested too deeply";
                self.reader.report(&codes::XDD_VALUE, ty.span(), message, "kept as raw bytes");
                return Type::Opaque(None);
            }
        }
        resolved
    }

    fn length(&self, ty: Type) -> Option<u32> {
        match ty {
            Type::Named(TypeId(part)) => self.bits[part as usize],
            basic => basic.bits(),
        }
    }
}

/// Returns the shape and the length in bits of a type derived from `base`: a string of `count` characters or bytes, or
/// an array of `count` elements. Without a count, or for a single element, returns an alias of `base`.
fn derived_shape(base: Type, count: Option<u32>, bits: Option<u32>) -> (Shape, Option<u32>) {
    let Some(count) = count.filter(|&count| count > 0) else { return (Shape::Alias(base), bits) };
    match base {
        Type::VisibleString(_) => (Shape::Alias(Type::VisibleString(Some(count))), None),
        Type::OctetString(_) => (Shape::Alias(Type::OctetString(Some(count))), None),
        Type::UnicodeString(_) => (Shape::Alias(Type::UnicodeString(Some(count))), None),
        _ if count == 1 => (Shape::Alias(base), bits),
        _ => {
            let bits = bits.and_then(|bits| bits.checked_mul(count));
            (Shape::Array { element: base, dimensions: vec![(0, count)] }, bits)
        }
    }
}

impl<'a> Application<'a> {
    /// Returns the type to which `ty` refers. Reports a reference to an unknown type, and returns raw bytes.
    pub fn resolve(&self, reader: &mut Reader<'_, '_>, ty: &TypeRef<'a>) -> Type {
        match ty {
            TypeRef::Basic(ty, _) => *ty,
            TypeRef::Named(given) => match self.type_ids.get(given.text.as_ref()) {
                Some(&at) => Type::Named(TypeId(at as u32)),
                None => {
                    dangling(reader, given, "data type");
                    Type::Opaque(None)
                }
            },
        }
    }
}
