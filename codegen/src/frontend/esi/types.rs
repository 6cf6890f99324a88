//! Converts the data types of a dictionary to types of the IR.

use std::borrow::Cow;

use compact_str::format_compact;
use smallvec::SmallVec;
use thin_vec::ThinVec;

use super::data_type::{Dimension, RawField, RawType};
use super::reader::{Names, Reader};
use crate::collections::{HashMap, HashMapExt};
use crate::diagnostics::{codes, Diagnostics};
use crate::etg::type_name::{self, Basic, Spelling};
use crate::frontend::xml::{Given, Order};
use crate::ir::owner::Owner;
use crate::ir::{BitFieldEntry, BitMeaning, CompactString, EnumValue, Field, Shape, Type, TypeDef, TypeId};
use crate::source::Span;
use crate::text::brief;

/// Types of a device, module or dictionary.
#[derive(Default)]
pub(super) struct Types<'a> {
    /// Enumeration values of each data type. They are removed when the data type is converted.
    values: Vec<ThinVec<EnumValue>>,
    by_name: HashMap<Cow<'a, str>, u32>,
    links: Links,
    /// Order of conversion. After `new`, only [`Order::is_endless`] is used, and the sequence is empty.
    order: Order,
    /// IR type for each data type of the file. For an alias, this is the type that the alias names.
    meaning: Vec<Type>,
    /// Types in the order of the file, followed by types that a name such as `BITARR8` defines.
    defs: Vec<TypeDef>,
    made: HashMap<CompactString, Type>,
}

/// References between data types, as positions in the list of data types.
#[derive(Default)]
struct Links {
    bases: Vec<Option<u32>>,
    /// Position of each field's data type, for the fields of all data types; `None` for a type that the file does not
    /// define.
    fields: Vec<Option<u32>>,
    /// Position in `fields` of the first field of each data type.
    first: Vec<usize>,
}

impl Links {
    fn new<'r>(raw: &'r [RawType<'_>], by_name: &HashMap<Cow<'_, str>, u32>) -> Self {
        let mut links = Links::default();
        // The last result is cached because adjacent fields often have the same type.
        let mut last = ("", None);
        let mut find = |name: &'r str| {
            if last.0 != name {
                last = (name, by_name.get(name).copied());
            }
            last.1
        };
        for (at, ty) in raw.iter().enumerate() {
            let base = find(&ty.base.text);
            // A basic type may name itself as its base type.
            let is_basic = base == Some(at as u32) && type_name::basic(&ty.name.text).is_some();
            links.bases.push(base.filter(|_| !is_basic));
            links.first.push(links.fields.len());
            links.fields.extend(ty.fields.iter().map(|field| find(&field.ty.text)));
        }
        links.fields.shrink_to_fit();
        links
    }

    /// Returns the positions of the data types that the data type at `at` refers to.
    fn parts(&self, at: usize) -> impl Iterator<Item = usize> + '_ {
        let start = self.first.get(at).copied().unwrap_or(0);
        let end = self.first.get(at + 1).copied().unwrap_or(self.fields.len());
        let fields = self.fields.get(start..end).unwrap_or(&[]).iter();
        fields.chain(self.bases.get(at)).filter_map(|part| part.map(|part| part as usize))
    }

    fn field(&self, at: usize, field: usize) -> Option<u32> {
        self.first.get(at).and_then(|first| self.fields.get(first + field).copied()).flatten()
    }
}

impl<'a> Types<'a> {
    /// Lowers all data types in `raw`.
    ///
    /// `values` contains the enumeration values of each data type.
    pub fn new(reader: &mut Reader<'_, '_>, raw: &[RawType<'a>], values: Vec<ThinVec<EnumValue>>) -> Self {
        let mut types = Types { values, by_name: HashMap::with_capacity(raw.len()), ..Types::default() };
        for (at, ty) in raw.iter().enumerate() {
            types.note_name(reader, raw, at, ty);
        }
        types.links = Links::new(raw, &types.by_name);
        let opaque = Type::Opaque(None);
        types.meaning = vec![opaque; raw.len()];
        let empty = |ty: &RawType<'_>| TypeDef {
            code: ty.code,
            documentation: ty.comment.as_deref().and_then(Names::documentation),
            origin: ty.origin,
            ..TypeDef::new(ty.name.compact(), Shape::Alias(opaque), ty.bits)
        };
        types.defs = raw.iter().map(empty).collect();
        types.order = Order::new(raw.len(), |at| types.links.parts(at));
        for at in std::mem::take(&mut types.order.sequence) {
            let Some(ty) = raw.get(at) else { continue };
            let (shape, bits) = types.shape(reader, at, ty);
            if let Some(meaning) = types.meaning.get_mut(at) {
                *meaning = match shape {
                    Shape::Alias(ty) => ty,
                    _ => Type::Named(TypeId(at as u32)),
                };
            }
            if let Some(def) = types.defs.get_mut(at) {
                (def.shape, def.bits) = (shape, bits);
            }
        }
        types.values = Vec::new();
        types
    }

    fn note_name(&mut self, reader: &mut Reader<'_, '_>, raw: &[RawType<'a>], at: usize, ty: &RawType<'a>) {
        if ty.name.is_empty() {
            reader.report(&codes::ESI_VALUE, ty.origin.span, "this data type has no name", "nothing can refer to it");
            return;
        }
        let first = *self.by_name.entry(ty.name.text.clone()).or_insert(at as u32) as usize;
        if let Some(first) = raw.get(first).filter(|_| first != at) {
            let message = format!("the data type `{}` has two definitions", brief(&ty.name.text));
            let found =
                codes::DUPLICATE_TYPE.at(ty.name.span, message).label("references resolve to the first definition");
            reader.diagnostics.push(found.note_at(first.name.span, "first definition"));
        }
    }

    fn shape(&mut self, reader: &mut Reader<'_, '_>, at: usize, ty: &RawType<'_>) -> (Shape, Option<u32>) {
        if !ty.fields.is_empty() {
            return self.record(reader, at, ty);
        }
        let values = self.values.get_mut(at).map(std::mem::take).unwrap_or_default();
        if !values.is_empty() {
            let base = self.integer_base(reader, at, ty);
            let shape = Shape::Enumeration { base, values: values.into_iter().collect(), closed: false };
            return (shape, ty.bits.or(base.bits()));
        }
        if !ty.dimensions.is_empty() {
            return self.array(reader, at, ty);
        }
        if !ty.base.is_empty() && (self.links.bases.get(at).copied().flatten().is_some() || !self.names_itself(ty)) {
            let base = self.base(reader, at, ty);
            if let Some(array) = self.array_without_info(reader, base, ty) {
                return (array, ty.bits);
            }
            let base = self.sized(reader, base, ty);
            return (Shape::Alias(base), ty.bits.or_else(|| self.bits(base)));
        }
        self.defined_by_name(reader, ty)
    }

    /// Returns whether a data type names itself as its base type.
    fn names_itself(&self, ty: &RawType<'_>) -> bool {
        ty.base.text == ty.name.text
    }

    /// Lowers a data type that is defined only by its name or by its data type index.
    fn defined_by_name(&mut self, reader: &mut Reader<'_, '_>, ty: &RawType<'_>) -> (Shape, Option<u32>) {
        let known = type_name::basic(&ty.name.text);
        let known = known.or_else(|| Some((type_name::by_code(ty.code?)?, Spelling::Standard)));
        let bits = |ty: Type| ty.bits();
        match known {
            Some((Basic::Type(basic), Spelling::Prefix)) if ty.bits.is_some() && bits(basic) != ty.bits => {}
            Some((Basic::Type(basic), spelling)) => {
                // A type name from another standard is not reported if the file declares the same length for it.
                if ty.bits.is_none() || ty.bits != bits(basic) || spelling != Spelling::Alias {
                    spelled(reader.diagnostics, spelling, &ty.name, basic);
                }
                let basic = self.sized(reader, basic, ty);
                return (Shape::Alias(basic), ty.bits.or(basic.bits()));
            }
            Some((Basic::Bits(width), _)) => return (bit_array(width), Some(u32::from(width))),
            Some((Basic::Array(lower, count, element), _)) => {
                let bits = element.bits().and_then(|bits| bits.checked_mul(count));
                return (Shape::Array { element, dimensions: vec![(lower, count)] }, ty.bits.or(bits));
            }
            None => {}
        }
        let message = format!("the definition of the data type `{}` contains only its name", brief(&ty.name.text));
        let found = codes::UNRESOLVED_TYPE.at(ty.name.span.or(ty.origin.span), message).label("kept as raw bytes");
        let help = "add a BaseType, ArrayInfo, SubItems or EnumInfos, or use the name of a basic type";
        reader.diagnostics.push(found.help(help));
        (Shape::Alias(Type::Opaque(ty.code)), ty.bits)
    }

    fn record(&mut self, reader: &mut Reader<'_, '_>, at: usize, ty: &RawType<'_>) -> (Shape, Option<u32>) {
        let (mut fields, mut end) = (Vec::with_capacity(ty.fields.len()), 0u32);
        field_names(reader, &ty.fields);
        for (position, field) in ty.fields.iter().enumerate() {
            let resolved = self.field_type(reader, at, position, field);
            let bits = field.bits.or_else(|| self.bits(resolved)).unwrap_or(0);
            let offset = field.offset.unwrap_or(end);
            end = offset.saturating_add(bits).max(end);
            let name = field.name.compact();
            let sub_index = field.sub_index;
            fields.push(Field { name, sub_index, ty: resolved, bits, bit_offset: offset });
        }
        check_layout(reader, ty, &fields);
        (Shape::Record(fields), ty.bits.or(Some(end)))
    }

    fn field_type(&mut self, reader: &mut Reader<'_, '_>, at: usize, position: usize, field: &RawField<'_>) -> Type {
        if field.ty.is_empty() {
            let message = "this sub-item has no type";
            reader.report(&codes::UNRESOLVED_TYPE, field.origin.span, message, "kept as raw bytes");
            return Type::Opaque(None);
        }
        match self.links.field(at, position) {
            Some(part) => self.part(reader, at, part, &field.ty),
            None => self.basic(reader, &field.ty),
        }
    }

    fn array(&mut self, reader: &mut Reader<'_, '_>, at: usize, ty: &RawType<'_>) -> (Shape, Option<u32>) {
        let element = if ty.base.is_empty() {
            let message = format!("the array `{}` has no BaseType", brief(&ty.name.text));
            reader.report(&codes::MISSING_BASE_TYPE, ty.name.span.or(ty.origin.span), message, "kept as raw bytes");
            Type::Opaque(None)
        } else {
            self.base(reader, at, ty)
        };
        let of_element = self.bits(element);
        let dimensions = dimensions(reader, ty, of_element);
        let count = dimensions.iter().try_fold(1u32, |count, &(_, elements)| count.checked_mul(elements));
        let bits = of_element.zip(count).and_then(|(bits, count)| bits.checked_mul(count));
        if let (Some(size), Some(bits)) = (ty.bits, bits) {
            if size != bits {
                let message = format!("the elements of the array have {bits} bits in total, but BitSize is {size}");
                let span = ty.dimensions.first().map_or(ty.origin.span, |first| first.origin.span);
                reader.report(&codes::ARRAY_BOUNDS, span, message, "the number of elements is used");
            }
        }
        (Shape::Array { element, dimensions }, bits.or(ty.bits))
    }

    /// Returns an array type for an alias whose name ends with `ARR`. The length of the alias must be a multiple of the
    /// length of the base type, and at least twice this length.
    fn array_without_info(&self, reader: &mut Reader<'_, '_>, base: Type, ty: &RawType<'_>) -> Option<Shape> {
        let (size, element) = (ty.bits?, self.bits(base).filter(|&bits| bits > 0)?);
        let count = size / element;
        if count < 2 || size % element != 0 || !ty.name.text.ends_with("ARR") {
            return None;
        }
        let message =
            format!("the data type `{}` has the length of {count} elements, but no ArrayInfo", brief(&ty.name.text));
        let label = format!("read as an array of {count} elements");
        reader.report(&codes::ARRAY_BOUNDS, ty.name.span.or(ty.origin.span), message, label);
        Some(Shape::Array { element: base, dimensions: vec![(1, count)] })
    }

    fn base(&mut self, reader: &mut Reader<'_, '_>, at: usize, ty: &RawType<'_>) -> Type {
        match self.links.bases.get(at).copied().flatten() {
            Some(part) => self.part(reader, at, part, &ty.base),
            None => self.basic(reader, &ty.base),
        }
    }

    /// Returns the integer type on which an enumeration is based.
    fn integer_base(&mut self, reader: &mut Reader<'_, '_>, at: usize, ty: &RawType<'_>) -> Type {
        let by_size = |bits: Option<u32>| Type::Unsigned(bits.and_then(|bits| u8::try_from(bits).ok()).unwrap_or(32));
        let sensible = ty.bits.filter(|bits| (1..=64).contains(bits));
        if ty.base.is_empty() {
            let unsigned = by_size(sensible);
            let message = format!("the enumeration `{}` has no BaseType", brief(&ty.name.text));
            let label = format!("read as {unsigned} from its BitSize");
            reader.report(&codes::MISSING_BASE_TYPE, ty.name.span.or(ty.origin.span), message, label);
            return unsigned;
        }
        let base = self.base(reader, at, ty);
        let base = self.underlying(self.sized(reader, base, ty));
        if base.integer_range().is_some() {
            return base;
        }
        let unsigned = by_size(sensible);
        let message = format!("the base type `{}` of an enumeration is not an integer type", brief(&ty.base.text));
        reader.report(&codes::MISSING_BASE_TYPE, ty.base.span, message, format!("read as {unsigned}"));
        unsigned
    }

    /// Returns the IR type of the data type at `part`, to which the data type at `at` refers. A circular or too deeply
    /// nested reference becomes raw bytes.
    fn part(&mut self, reader: &mut Reader<'_, '_>, at: usize, part: u32, given: &Given<'_>) -> Type {
        if self.order.is_endless(at) && self.order.is_endless(part as usize) {
            let message = format!("the data type `{}` contains itself or is nested too deeply", brief(&given.text));
            reader.report(&codes::ENDLESS_TYPE, given.span, message, "kept as raw bytes");
            return Type::Opaque(None);
        }
        self.meaning.get(part as usize).copied().unwrap_or(Type::Opaque(None))
    }

    /// Returns the type that the name in `given` refers to.
    pub fn resolve(&mut self, reader: &mut Reader<'_, '_>, given: &Given<'_>) -> Type {
        match self.by_name.get(given.text.as_ref()) {
            Some(&at) => self.meaning.get(at as usize).copied().unwrap_or(Type::Opaque(None)),
            None => self.basic(reader, given),
        }
    }

    /// Returns whether `name` is the name of a data type of the file, or the standard name of a basic type.
    pub fn knows(&self, name: &str) -> bool {
        self.by_name.contains_key(name) || matches!(type_name::basic(name), Some((_, Spelling::Standard)))
    }

    /// Returns the position of the data type called `name`. For an alias, returns the position of the data type that it names.
    pub fn position(&self, name: &str) -> Option<usize> {
        let at = *self.by_name.get(name)?;
        match self.meaning.get(at as usize) {
            Some(&Type::Named(TypeId(at))) => Some(at as usize),
            _ => None,
        }
    }

    /// Returns the type of the field at `position` of a record.
    pub fn field(&self, record: Type, position: usize) -> Type {
        let Type::Named(TypeId(at)) = record else { return Type::Opaque(None) };
        match self.defs.get(at as usize).map(|def| &def.shape) {
            Some(Shape::Record(fields)) => fields.get(position).map_or(Type::Opaque(None), |field| field.ty),
            _ => Type::Opaque(None),
        }
    }

    /// Returns the element type, the lower bound of the first dimension, and the total number of elements of an array. Returns
    /// `None` for any other type.
    pub fn elements(&self, ty: Type) -> Option<(Type, i32, u32)> {
        let Type::Named(TypeId(at)) = ty else { return None };
        match &self.defs.get(at as usize)?.shape {
            Shape::Array { element, dimensions } => {
                let count = dimensions.iter().fold(1u32, |count, &(_, elements)| count.saturating_mul(elements));
                Some((*element, dimensions.first().map_or(1, |&(lower, _)| lower), count))
            }
            _ => None,
        }
    }

    fn basic(&mut self, reader: &mut Reader<'_, '_>, given: &Given<'_>) -> Type {
        match type_name::basic(&given.text) {
            Some((known @ (Basic::Bits(_) | Basic::Array(..)), _)) => self.make(&given.text, known),
            found => basic_or_opaque(reader.diagnostics, given, found),
        }
    }

    /// Returns the type that a name such as `BITARR8` defines.
    fn make(&mut self, name: &str, known: Basic) -> Type {
        if let Some(&ty) = self.made.get(name) {
            return ty;
        }
        let (shape, bits) = match known {
            Basic::Type(ty) => return ty,
            Basic::Bits(width) => (bit_array(width), Some(u32::from(width))),
            Basic::Array(lower, count, element) => {
                let bits = element.bits().and_then(|bits| bits.checked_mul(count));
                (Shape::Array { element, dimensions: vec![(lower, count)] }, bits)
            }
        };
        let ty = Type::Named(TypeId(self.defs.len() as u32));
        if self.defs.len() == self.defs.capacity() {
            // Few types have such names. If the list doubled its capacity, most of the memory would be unused.
            self.defs.reserve_exact(self.defs.len() / 8 + 16);
        }
        self.defs.push(TypeDef::new(name, shape, bits));
        self.made.insert(name.into(), ty);
        ty
    }

    /// Returns the basic type `base` with the length that the data type `ty` declares.
    fn sized(&self, reader: &mut Reader<'_, '_>, base: Type, ty: &RawType<'_>) -> Type {
        let Some(bits) = ty.bits.filter(|&bits| bits > 0) else { return base };
        let bytes = Some(bits / 8).filter(|_| bits % 8 == 0);
        match base {
            Type::VisibleString(None) => Type::VisibleString(bytes),
            Type::OctetString(None) => Type::OctetString(bytes),
            Type::UnicodeString(None) => Type::UnicodeString(bytes.map(|bytes| bytes / 2)),
            Type::Integer(width) | Type::Unsigned(width) if u32::from(width) != bits => {
                let message = format!("BitSize is {bits}, but {base} has {width} bits");
                let narrow = u8::try_from(bits).ok().filter(|bits| *bits <= 64);
                let sized = match (base, narrow) {
                    (Type::Integer(_), Some(bits)) => Type::Integer(bits),
                    (_, Some(bits)) => Type::Unsigned(bits),
                    (_, None) => base,
                };
                let span = ty.name.span.or(ty.origin.span);
                reader.report(&codes::BIT_SIZE, span, message, format!("read as {sized}"));
                sized
            }
            _ => base,
        }
    }

    /// Returns the length of a type in bits, or `None` if it is unknown.
    pub fn bits(&self, ty: Type) -> Option<u32> {
        Owner::of_types(&self.defs).fixed_bits(ty)
    }

    /// Returns the integer type of an enumeration or bit field. Returns any other type unchanged.
    pub fn underlying(&self, ty: Type) -> Type {
        Owner::of_types(&self.defs).integer(ty)
    }

    /// Returns the types in the order of the file, followed by types that a name such as `BITARR8` defines.
    pub fn into_defs(self) -> Vec<TypeDef> {
        self.defs
    }
}

/// Reports the name of a basic type if the tables of ETG.1000.6 do not contain this name.
fn spelled(diagnostics: &mut Diagnostics, spelling: Spelling, name: &Given<'_>, ty: Type) {
    let code = match spelling {
        Spelling::Standard => return,
        Spelling::Alias => &codes::TYPE_ALIAS,
        Spelling::Prefix => &codes::GUESSED_TYPE,
    };
    if diagnostics.wants(code) {
        let message = format!("`{}` is not the name of an ESI base data type", brief(&name.text));
        diagnostics.push(code.at(name.span, message).label(format!("read as {}", type_name::name_of(ty))));
    }
}

/// Reports fields without a name or with a repeated name.
fn field_names(reader: &mut Reader<'_, '_>, fields: &[RawField<'_>]) {
    let mut seen = Seen::default();
    for field in fields {
        if field.name.is_empty() {
            let label = "the sub-index is used instead of a name";
            reader.report(&codes::SUB_ITEM_NAME, field.origin.span, "this sub-item has no name", label);
        } else if let Some(earlier) = seen.insert(&field.name) {
            let message = format!("two sub-items have the name `{}`", brief(&field.name.text));
            let found = codes::SUB_ITEM_NAME.at(field.name.span, message).label("distinguished by their sub-indices");
            reader.diagnostics.push(found.note_at(earlier, "first sub-item with this name"));
        }
    }
}

/// Names that occurred so far. The first 16 names are in a list, which is fast to search. Further names are in a map.
#[derive(Default)]
struct Seen<'n> {
    few: SmallVec<[&'n Given<'n>; 16]>,
    many: HashMap<&'n str, Span>,
}

impl<'n> Seen<'n> {
    /// Returns the span of an earlier name with the same text. If there is none, adds the name and returns `None`.
    fn insert(&mut self, name: &'n Given<'_>) -> Option<Span> {
        if let Some(same) = self.few.iter().find(|other| other.text == name.text) {
            return Some(same.span);
        }
        if self.few.len() < self.few.inline_size() {
            self.few.push(name);
            return None;
        }
        let first = *self.many.entry(name.text.as_ref()).or_insert(name.span);
        (first != name.span).then_some(first)
    }
}

/// Reports the first sub-item that overlaps another sub-item, and the first sub-item that ends beyond the end of the
/// data type.
fn check_layout(reader: &mut Reader<'_, '_>, ty: &RawType<'_>, fields: &[Field]) {
    let end = |field: &Field| field.bit_offset.saturating_add(field.bits);
    let mut order: Vec<(&Field, &RawField<'_>)> =
        fields.iter().zip(&ty.fields).filter(|(field, _)| field.bits > 0).collect();
    order.sort_by_key(|(field, _)| field.bit_offset);
    let shared = order.windows(2).find(|pair| matches!(pair, [one, other] if end(one.0) > other.0.bit_offset));
    if let Some([one, other]) = shared {
        let (first, second) = (brief(&one.0.name), brief(&other.0.name));
        let message = format!("the sub-items `{first}` and `{second}` overlap at bits {}", extents(one.0, other.0));
        let found = codes::SUB_ITEM_PLACE.at(other.1.origin.span, message).label("both are kept");
        let found = found.note_at(one.1.origin.span, "other sub-item");
        reader.diagnostics.push(found.help("correct BitOffs or BitSize of one of the two sub-items"));
    }
    let Some(bits) = ty.bits else { return };
    if let Some((field, raw)) = order.iter().find(|(field, _)| end(field) > bits) {
        let name = brief(&field.name);
        let message = format!("the sub-item `{name}` ends at bit {}, but the data type has {bits} bits", end(field));
        let found = codes::SUB_ITEM_PLACE.at(raw.origin.span, message).label("kept unchanged");
        let help = "increase BitSize of the data type, or correct BitOffs or BitSize of the sub-item";
        reader.diagnostics.push(found.help(help));
    }
}

/// Returns the bit ranges of two fields as text.
fn extents(one: &Field, other: &Field) -> String {
    let bits = |field: &Field| {
        let last = field.bit_offset.saturating_add(field.bits).saturating_sub(1);
        format!("{} to {last}", field.bit_offset)
    };
    format!("{} and {}", bits(one), bits(other))
}

/// Returns the lower bound and the number of elements of each dimension, for at most three dimensions. If the array has one
/// dimension and the number is missing or 0, calculates the number from `BitSize`. Reports a missing number, the number 0
/// and further dimensions.
fn dimensions(reader: &mut Reader<'_, '_>, ty: &RawType<'_>, element: Option<u32>) -> Vec<(i32, u32)> {
    const MAX_DIMENSIONS: usize = 3;
    if let Some(more) = ty.dimensions.get(MAX_DIMENSIONS) {
        reader.report(&codes::ARRAY_BOUNDS, more.origin.span, "an array has at most three dimensions", "left out");
    }
    let single = ty.dimensions.len() == 1;
    let by_size = ty.bits.zip(element).filter(|&(_, element)| single && element > 0);
    let by_size = by_size.map(|(bits, element)| bits / element);
    let mut count = |dimension: &Dimension| match dimension.elements {
        Some(elements) if elements > 0 => elements,
        given => {
            let elements = by_size.unwrap_or(0);
            let message = match given {
                Some(_) => "the array declares 0 elements",
                None => "the number of elements of the array is missing",
            };
            let label = format!("read as {elements} elements from BitSize");
            reader.report(&codes::ARRAY_BOUNDS, dimension.origin.span, message, label);
            elements
        }
    };
    ty.dimensions.iter().take(MAX_DIMENSIONS).map(|dimension| (dimension.lower, count(dimension))).collect()
}

/// Returns a bit field of single bits, which are named after their offsets: `Bit 0`, `Bit 1`.
fn bit_array(width: u8) -> Shape {
    let flag = || BitMeaning::Flag { inverted: false };
    let bit = |offset| BitFieldEntry::new(format_compact!("Bit {offset}"), offset, 1, flag());
    Shape::BitField { base: Type::Unsigned(width), fields: (0..width).map(bit).collect() }
}

/// Returns the basic type for a type name that the file does not define, or raw bytes for an unknown name. Reports
/// nonstandard and unknown names.
pub(super) fn guessed(diagnostics: &mut Diagnostics, name: &Given<'_>) -> Type {
    basic_or_opaque(diagnostics, name, type_name::basic(&name.text))
}

fn basic_or_opaque(diagnostics: &mut Diagnostics, name: &Given<'_>, found: Option<(Basic, Spelling)>) -> Type {
    match found {
        Some((Basic::Type(ty), spelling)) => {
            spelled(diagnostics, spelling, name, ty);
            ty
        }
        _ => {
            let message = format!("the data type `{}` is not defined", brief(&name.text));
            let found = codes::UNRESOLVED_TYPE.at(name.span, message).label("kept as raw bytes");
            diagnostics.push(found.help("define the type in DataTypes, or use the name of a basic type such as UINT"));
            Type::Opaque(None)
        }
    }
}
