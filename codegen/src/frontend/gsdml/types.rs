//! Types of the catalog: named numbers and strings of GSDML, and the enumerations in the value list.

use std::borrow::Cow;
use std::sync::Arc;

use super::data_type::{DataType, NumberType, StringType};
use super::links::unresolved;
use crate::collections::HashMap;
use crate::diagnostics::{codes, Diagnostics};
use crate::frontend::xml::Given;
use crate::ir::{CompactString, Documentation, EnumValue, Field, Scale, Shape, Type, TypeDef, TypeId};
use crate::limits;
use crate::source::Origin;

#[derive(Default)]
pub(super) struct Types<'a> {
    defs: Vec<TypeDef>,
    /// Named types, by name and length in bytes.
    named: HashMap<(&'static str, u32), TypeId>,
    /// Enumerations, by the identifier of their `ValueItem` element and their base type.
    enumerations: HashMap<(Cow<'a, str>, Type), TypeId>,
    /// First reference to each enumeration, with its base type.
    wanted: Vec<(Given<'a>, Type, TypeId)>,
    items: Vec<ValueItem>,
    by_id: HashMap<Cow<'a, str>, usize>,
}

/// Contents of a `ValueItem` element.
#[derive(Default)]
pub(super) struct ValueItem {
    pub id: CompactString,
    pub documentation: Option<Arc<Documentation>>,
    pub values: Vec<EnumValue>,
    pub origin: Origin,
    used: bool,
}

impl<'a> Types<'a> {
    fn push(&mut self, name: &str, shape: Shape, bits: Option<u32>) -> TypeId {
        let id = TypeId(u32::try_from(self.defs.len()).unwrap_or(u32::MAX));
        self.defs.push(TypeDef::new(name, shape, bits));
        id
    }

    fn named(&mut self, name: &'static str, bytes: u32, shape: impl FnOnce() -> Shape) -> Type {
        if let Some(&id) = self.named.get(&(name, bytes)) {
            return Type::Named(id);
        }
        let id = self.push(name, shape(), Some(bytes.saturating_mul(8)));
        self.named.insert((name, bytes), id);
        Type::Named(id)
    }

    /// Returns the number of `ValueItem` elements that were read.
    pub fn value_items(&self) -> usize {
        self.items.len()
    }

    /// Adds a `ValueItem` element. The first element takes precedence if an identifier is repeated.
    pub fn add_values(&mut self, id: &Given<'a>, item: ValueItem) {
        if !id.is_missing() {
            self.by_id.entry(id.text.clone()).or_insert(self.items.len());
        }
        self.items.push(item);
    }

    /// Returns the enumeration that the `ValueItem` called `target` defines, with the underlying integer type `base`.
    pub fn enumeration(&mut self, target: &Given<'a>, base: Type) -> Type {
        let key = (target.text.clone(), base);
        if let Some(&id) = self.enumerations.get(&key) {
            return Type::Named(id);
        }
        let id = self.push(&target.text, Shape::Alias(base), base.bits());
        self.enumerations.insert(key, id);
        self.wanted.push((target.clone(), base, id));
        Type::Named(id)
    }

    /// Resolves the enumerations and returns all types. The value list must have been read.
    pub fn finish(mut self, diagnostics: &mut Diagnostics) -> Vec<TypeDef> {
        let mut budget = limits::MAX_DERIVED_ITEMS;
        for (target, base, TypeId(id)) in std::mem::take(&mut self.wanted) {
            let item = self.by_id.get(&target.text).and_then(|&at| self.items.get_mut(at));
            let Some(item) = item else {
                unresolved("ValueItem", &target, diagnostics);
                continue;
            };
            // Each further base type for the same `ValueItem` needs another copy of its values.
            let copies = if std::mem::replace(&mut item.used, true) { item.values.len() } else { 0 };
            let Some(rest) = budget.checked_sub(copies) else {
                too_many(&target, diagnostics);
                continue;
            };
            budget = rest;
            if let Some(def) = self.defs.get_mut(id as usize) {
                def.shape = Shape::Enumeration { base, values: item.values.clone(), closed: false };
                (def.documentation, def.origin) = (item.documentation.clone(), item.origin);
            }
        }
        for item in std::mem::take(&mut self.items).into_iter().filter(|item| !item.used) {
            let ValueItem { id: name, documentation, values, origin, .. } = item;
            let base = narrowest(&values);
            let shape = Shape::Enumeration { base, values, closed: false };
            self.defs.push(TypeDef { documentation, origin, ..TypeDef::new(name, shape, base.bits()) });
        }
        self.defs
    }
}

fn too_many(target: &Given<'_>, diagnostics: &mut Diagnostics) {
    let message = "the value lists are used with more types than the limit allows";
    diagnostics.push(codes::INPUT_TOO_LARGE.at(target.span, message).label("the values have no names"));
}

/// Returns the shortest integer type for the values of an enumeration to which nothing refers.
fn narrowest(values: &[EnumValue]) -> Type {
    let least = values.iter().map(|value| value.value).min().unwrap_or(0);
    let greatest = values.iter().map(|value| value.last.unwrap_or(value.value)).max().unwrap_or(0);
    let all = [8, 16, 32].into_iter().map(|bits| if least < 0 { Type::Integer(bits) } else { Type::Unsigned(bits) });
    let fits = |ty: &Type| ty.integer_range().is_some_and(|(low, high)| low <= least && greatest <= high);
    all.into_iter().find(fits).unwrap_or(if least < 0 { Type::Integer(64) } else { Type::Unsigned(64) })
}

impl DataType {
    /// Returns the IR type and the length in bytes of a data type. `length` is the declared length.
    pub fn lower(self, length: Option<u32>, types: &mut Types<'_>) -> (Type, u32) {
        let bytes = self.bytes().or(length).unwrap_or(0);
        let ty = match self {
            DataType::Basic(ty) => ty,
            DataType::String(StringType::Visible) => Type::VisibleString(Some(bytes)),
            DataType::String(StringType::Octet) => Type::OctetString(Some(bytes)),
            DataType::String(StringType::Named(name)) => {
                types.named(name, bytes, || Shape::Alias(Type::OctetString(Some(bytes))))
            }
            DataType::Number(&NumberType { name, base, factor }) => types.named(name, bytes, || match factor {
                Some(factor) => Shape::Scaled { base, scale: Scale::Linear { factor, offset: 0.0 } },
                None => Shape::Alias(base),
            }),
            DataType::Pair(pair) => types.named(pair.name, bytes, || {
                let field = |name: &str, ty, bits, bit_offset| {
                    let name = name.into();
                    Field { name, sub_index: None, ty, bits, bit_offset }
                };
                let bits = pair.first_bits();
                Shape::Record(vec![field("value", pair.first, bits, 0), field(pair.suffix, pair.second, 8, bits)])
            }),
            DataType::OctetsWithStatus | DataType::Trailer(_) => Type::OctetString(Some(bytes)),
            DataType::Bit | DataType::BitArea => Type::Boolean,
        };
        (ty, bytes)
    }
}
