//! The data types of the application process (CiA 311, dataTypeList).

use super::application::{dangling, insert, Application};
use super::reader::{integer, note, Given, Read, Reader, Texts};
use crate::diagnostics::{codes, Diagnostic};
use crate::ir::{CompactString, Device, EnumValue, Field, Shape, Type, TypeDef, TypeId};
use crate::limits;
use crate::source::{Origin, Span};
use crate::syntax::xml::Tag;

/// The type of a parameter, element or field.
#[derive(Clone, Debug)]
pub(super) enum TypeRef<'a> {
    /// `<UDINT/>`
    Basic(Type, Span),
    /// `<dataTypeIDRef uniqueIDRef="…"/>`
    Named(Given<'a>),
}

impl TypeRef<'_> {
    pub fn span(&self) -> Span {
        match self {
            TypeRef::Basic(_, span) => *span,
            TypeRef::Named(given) => given.span,
        }
    }
}

/// A type as the file has it.
pub(super) struct RawType<'a> {
    name: CompactString,
    texts: Texts,
    kind: Kind<'a>,
    origin: Origin,
}

enum Kind<'a> {
    Array {
        dimensions: Vec<(i32, u32)>,
        element: Option<TypeRef<'a>>,
    },
    /// Positions of the variables among the parameters.
    Struct(Vec<usize>),
    Enum {
        base: Option<TypeRef<'a>>,
        values: Vec<EnumValue>,
    },
    Derived {
        base: Option<TypeRef<'a>>,
        count: Option<u32>,
    },
}

/// The basic types of IEC 61131-3 as CiA 311 maps them to those of CiA 301.
fn basic(name: &str) -> Option<Type> {
    Some(match name {
        "BOOL" => Type::Boolean,
        "SINT" => Type::Integer(8),
        "INT" => Type::Integer(16),
        "DINT" => Type::Integer(32),
        "LINT" => Type::Integer(64),
        "USINT" | "BYTE" | "CHAR" => Type::Unsigned(8),
        "UINT" | "WORD" => Type::Unsigned(16),
        "UDINT" | "DWORD" => Type::Unsigned(32),
        "ULINT" | "LWORD" => Type::Unsigned(64),
        "REAL" => Type::Real32,
        "LREAL" => Type::Real64,
        "STRING" => Type::VisibleString(None),
        "WSTRING" => Type::UnicodeString(None),
        "BITSTRING" => Type::OctetString(None),
        _ => return None,
    })
}

/// The type that an element names, where it names one.
pub(super) fn reference<'a>(reader: &mut Reader<'a, '_>, tag: &Tag<'a>) -> Read<Option<TypeRef<'a>>> {
    if let Some(ty) = basic(tag.name) {
        return Ok(Some(TypeRef::Basic(ty, tag.span)));
    }
    if tag.name == "dataTypeIDRef" {
        return Ok(reader.field(tag, "uniqueIDRef")?.map(TypeRef::Named));
    }
    Ok(None)
}

/// Reads an element of dataTypeList.
pub(super) fn read<'a>(
    reader: &mut Reader<'a, '_>,
    tag: &Tag<'a>,
    application: &mut Application<'a>,
    device: &mut Device,
) -> Read<()> {
    if !matches!(tag.name, "array" | "struct" | "enum" | "derived") {
        return reader.unknown(tag, &mut device.extensions);
    }
    let origin = reader.cursor.origin(tag);
    let [id, name, size] = reader.fields(tag, &["uniqueID", "name", "size"], &mut device.extensions)?;
    // The size of an enumeration repeats what its values and its type say.
    note("enum@size", size.as_ref(), &mut device.extensions);
    let position = application.types.len();
    let mut texts = Texts::default();
    let kind = match tag.name {
        "array" => array(reader, tag, &mut texts, device)?,
        "struct" => structure(reader, tag, position, &mut texts, application, device)?,
        "enum" => enumeration(reader, tag, &mut texts, device)?,
        _ => derived(reader, tag, &mut texts, device)?,
    };
    insert(reader, &mut application.type_ids, id, position);
    let name = name.map_or_else(|| texts.label(), |name| name.text.into());
    application.types.push(RawType { name, texts, kind, origin });
    Ok(())
}

fn array<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, texts: &mut Texts, device: &mut Device) -> Read<Kind<'a>> {
    let (mut dimensions, mut element) = (Vec::new(), None);
    while let Some(tag) = reader.cursor.child(parent)? {
        if tag.name == "subrange" {
            let fields = reader.fields(&tag, &["lowerLimit", "upperLimit"], &mut device.extensions)?;
            let [low, high] =
                fields.each_ref().map(|given| given.as_ref().and_then(|given| given.text.parse::<i32>().ok()));
            match (low, high) {
                (Some(low), Some(high)) if low <= high => {
                    let count = i64::from(high) - i64::from(low) + 1;
                    dimensions.push((low, u32::try_from(count).unwrap_or(u32::MAX)));
                }
                _ => {
                    let message = "lowerLimit and upperLimit are no range of whole numbers";
                    reader.diagnostics.push(Diagnostic::new(&codes::XDD_VALUE, tag.span, message).label("left out"));
                }
            }
        } else if let Some(ty) = reference(reader, &tag)? {
            element = Some(ty);
        } else if !reader.texts(&tag, texts)? {
            reader.keep(&tag, &mut device.extensions)?;
        }
    }
    Ok(Kind::Array { dimensions, element })
}

fn structure<'a>(
    reader: &mut Reader<'a, '_>,
    parent: &Tag<'a>,
    position: usize,
    texts: &mut Texts,
    application: &mut Application<'a>,
    device: &mut Device,
) -> Read<Kind<'a>> {
    let mut variables = Vec::new();
    while let Some(tag) = reader.cursor.child(parent)? {
        if tag.name == "varDeclaration" {
            let field = (position, variables.len());
            variables.push(application.variable(reader, &tag, field)?);
        } else if !reader.texts(&tag, texts)? {
            reader.keep(&tag, &mut device.extensions)?;
        }
    }
    Ok(Kind::Struct(variables))
}

fn enumeration<'a>(
    reader: &mut Reader<'a, '_>,
    parent: &Tag<'a>,
    texts: &mut Texts,
    device: &mut Device,
) -> Read<Kind<'a>> {
    let (mut base, mut values) = (None, Vec::new());
    let mut next = 0i128;
    while let Some(tag) = reader.cursor.child(parent)? {
        if tag.name == "enumValue" {
            let [given] = reader.fields(&tag, &["value"], &mut device.extensions)?;
            let mut own = Texts::default();
            while let Some(inner) = reader.cursor.child(&tag)? {
                if !reader.texts(&inner, &mut own)? {
                    reader.keep(&inner, &mut device.extensions)?;
                }
            }
            // Without a number, the values count up as in C.
            let value = match &given {
                Some(given) => integer(&given.text),
                None => Some(next),
            };
            match (value, given) {
                (Some(value), _) => {
                    next = value.saturating_add(1);
                    values.push(enum_value(value, &own));
                }
                (None, Some(given)) => reader.bad(&given, "number of an enumeration's value", "left out"),
                (None, None) => {}
            }
        } else if let Some(ty) = reference(reader, &tag)? {
            base = Some(ty);
        } else if !reader.texts(&tag, texts)? {
            reader.keep(&tag, &mut device.extensions)?;
        }
    }
    Ok(Kind::Enum { base, values })
}

/// A value of an enumeration with its labels.
pub(super) fn enum_value(value: i128, texts: &Texts) -> EnumValue {
    let name = texts.label();
    let (names, documentation) = (texts.names(&name), texts.documentation());
    EnumValue { names, documentation, ..EnumValue::new(name, value) }
}

fn derived<'a>(
    reader: &mut Reader<'a, '_>,
    parent: &Tag<'a>,
    texts: &mut Texts,
    device: &mut Device,
) -> Read<Kind<'a>> {
    let (mut base, mut count) = (None, None);
    while let Some(tag) = reader.cursor.child(parent)? {
        if tag.name == "count" {
            while let Some(inner) = reader.cursor.child(&tag)? {
                if inner.name == "defaultValue" {
                    let given = reader.field(&inner, "value")?;
                    count = reader.unsigned(given.as_ref(), u32::MAX, "number of elements");
                } else {
                    reader.keep(&inner, &mut device.extensions)?;
                }
            }
        } else if let Some(ty) = reference(reader, &tag)? {
            base = Some(ty);
        } else if !reader.texts(&tag, texts)? {
            reader.keep(&tag, &mut device.extensions)?;
        }
    }
    Ok(Kind::Derived { base, count })
}

/// The types of the application process as types of the device, in the same order.
pub(super) fn lower<'a>(reader: &mut Reader<'a, '_>, application: &mut Application<'a>) -> Vec<TypeDef> {
    let order = Order::new(application);
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
        name: raw.name,
        code: None,
        shape: shape.unwrap_or(Shape::Alias(Type::Opaque(None))),
        bits,
        documentation: raw.texts.documentation(),
        origin: raw.origin,
    })
    .collect()
}

/// The order in which types can be lowered: a type after those that it is made of.
struct Order {
    sequence: Vec<usize>,
    /// Whether a type is made of itself, or of too many layers.
    endless: Vec<bool>,
}

impl Order {
    fn new(application: &Application<'_>) -> Self {
        let count = application.types.len();
        let mut waiting = vec![0usize; count];
        let mut users: Vec<Vec<usize>> = vec![Vec::new(); count];
        for (at, own) in waiting.iter_mut().enumerate() {
            for part in parts(application, at) {
                *own += 1;
                users[part].push(at);
            }
        }
        let mut sequence: Vec<usize> = (0..count).filter(|&at| waiting[at] == 0).collect();
        let (mut depth, mut next) = (vec![0usize; count], 0);
        while let Some(&at) = sequence.get(next) {
            next += 1;
            for &user in &users[at] {
                depth[user] = depth[user].max(depth[at] + 1);
                waiting[user] -= 1;
                if waiting[user] == 0 {
                    sequence.push(user);
                }
            }
        }
        let endless = (0..count).map(|at| waiting[at] > 0 || depth[at] > limits::MAX_XML_DEPTH).collect();
        sequence.extend((0..count).filter(|&at| waiting[at] > 0));
        Order { sequence, endless }
    }
}

/// The types of which a type is made.
fn parts<'p>(application: &'p Application<'_>, at: usize) -> impl Iterator<Item = usize> + 'p {
    let (variables, own) = match &application.types[at].kind {
        Kind::Struct(variables) => (variables.as_slice(), None),
        Kind::Array { element: own, .. } | Kind::Enum { base: own, .. } | Kind::Derived { base: own, .. } => {
            (&[][..], own.as_ref())
        }
    };
    let of_variables = variables.iter().filter_map(|&variable| application.parameters[variable].ty.as_ref());
    of_variables.chain(own).filter_map(|ty| match ty {
        TypeRef::Named(given) => application.type_ids.get(given.text.as_ref()).copied(),
        TypeRef::Basic(..) => None,
    })
}

/// Lowers the type at `at`, of whose parts the lengths are known.
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
            Kind::Array { dimensions, element } => {
                let element = self.part(element.as_ref());
                let count = dimensions.iter().try_fold(1u32, |count, dimension| count.checked_mul(dimension.1));
                let bits = self.length(element).zip(count).and_then(|(bits, count)| bits.checked_mul(count));
                (Shape::Array { element, dimensions: dimensions.clone() }, bits)
            }
            Kind::Struct(variables) => self.record(variables),
            Kind::Enum { base, values } => {
                let base = self.part(base.as_ref());
                let bits = self.length(base);
                (Shape::Enumeration { base, values: values.clone(), closed: false }, bits)
            }
            Kind::Derived { base, count } => {
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
            fields.push(Field { name: variable.texts.label(), sub_index: None, ty, bits, bit_offset: offset });
            offset = offset.saturating_add(bits);
        }
        (Shape::Record(fields), known.then_some(offset))
    }

    /// A part of the type; what would make it endless is cut off.
    fn part(&mut self, ty: Option<&TypeRef<'a>>) -> Type {
        let Some(ty) = ty else { return Type::Opaque(None) };
        let resolved = self.application.resolve(self.reader, ty);
        if let Type::Named(TypeId(part)) = resolved {
            if self.order.endless[self.at] && self.order.endless[part as usize] {
                let message = "the data type is made of itself, or of too many layers";
                self.reader
                    .diagnostics
                    .push(Diagnostic::new(&codes::XDD_VALUE, ty.span(), message).label("kept as raw bytes"));
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

/// A type of `count` units of another: a string of that length, or an array.
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
    /// The type to which a parameter refers.
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

/// The basic type that the values of a type have: what aliases and enumerations stand for.
pub(super) fn underlying(types: &[TypeDef], ty: Type) -> Type {
    let mut ty = ty;
    // Types of the application process have no cycles; the bound is for those that objects define.
    for _ in 0..=limits::MAX_XML_DEPTH {
        let Type::Named(TypeId(at)) = ty else { return ty };
        match types.get(at as usize).map(|def| &def.shape) {
            Some(Shape::Alias(base) | Shape::Enumeration { base, .. } | Shape::Scaled { base, .. }) => ty = *base,
            _ => return ty,
        }
    }
    ty
}
