//! Compares the types of values, including names of bits and values.

use std::collections::HashSet;

use super::change::{Effect, Judgment};
use super::comparison::{compare_fields, fact, fact_as, judged, slices, Comparison, Elements, COMPARED, POSITION};
use super::show::Show;
use super::texts::renamed;
use lexibus_codegen::facts::types::{self, definition};
use lexibus_codegen::facts::words::PLAIN;
use lexibus_codegen::ir::owner::Owner;
use lexibus_codegen::ir::{BitFieldEntry, BitMeaning, EnumValue, Field, Shape, Type, TypeDef, TypeId};

/// Compares the type of the current element. Each pair of definitions is compared only once.
pub(super) fn compare(old: &Type, new: &Type, comparison: &mut Comparison<'_>) {
    let (old_types, new_types) = comparison.types;
    let (old_text, new_text) = (name(old_types, *old), name(new_types, *new));
    let judgment = effects(basic_of(old_types, *old), basic_of(new_types, *new));
    comparison.texts("type", old_text, new_text, judgment);
    compare_definitions(*old, *new, comparison);
}

/// Compares the definitions of named types. Each pair is compared only once.
pub(super) fn compare_definitions(old: Type, new: Type, comparison: &mut Comparison<'_>) {
    let (old_types, new_types) = comparison.types;
    match (definition(old_types, old), definition(new_types, new)) {
        (Some(one), Some(other)) if comparison.is_first_comparison(old, new) => {
            let is_same_type = name(old_types, old) == name(new_types, new);
            definitions(one, other, is_same_type, comparison);
        }
        (Some(_), Some(_)) | (None, None) => {}
        // One type is a basic type, and the other is only a name for this type: any other definition would have a
        // different text.
        (one, other) if name(old_types, old) == name(new_types, new) => {
            let text = |value: Option<&TypeDef>| value.map(|value| value.name.to_string()).unwrap_or_default();
            comparison.push("name of the type", text(one), text(other), Judgment::NONE);
        }
        _ => {}
    }
}

/// Returns a rule that compares two optional types.
pub(super) fn compare_optional(
    fact: &'static str,
    judgment: Judgment,
) -> impl Fn(&Option<Type>, &Option<Type>, &mut Comparison<'_>) {
    move |old, new, comparison| match (old, new) {
        (Some(old), Some(new)) => comparison.within(fact, |comparison| compare(old, new, comparison)),
        (old, new) => {
            let (old_types, new_types) = comparison.types;
            let text = |types, ty: &Option<Type>| ty.map(|ty| name(types, ty)).unwrap_or_default();
            comparison.texts(fact, text(old_types, old), text(new_types, new), judgment);
        }
    }
}

/// Compares the types that no compared element uses. Types are paired by name.
pub(super) fn compare_unused(comparison: &mut Comparison<'_>) {
    let (old_types, new_types) = comparison.types;
    let unused = |types: &[TypeDef], compared: HashSet<Type>| -> Vec<(TypeId, String)> {
        let ids = (0..types.len()).map(|at| TypeId(at as u32)).zip(types);
        let unused = ids.filter(|(id, _)| !compared.contains(&Type::Named(*id)));
        unused.map(|(id, definition)| (id, definition.name.to_string())).collect()
    };
    let (old_compared, new_compared) = comparison.compared_types();
    let (old, new) = (unused(old_types, old_compared), unused(new_types, new_compared));
    let elements = Elements::<(TypeId, String)>::titled(|(_, name)| format!("type {name}"))
        .judged(Judgment::API_COMPATIBLE, Judgment::API);
    slices(
        &old,
        &new,
        &elements,
        |(old, _), (new, _), comparison: &mut Comparison<'_>| {
            compare(&Type::Named(*old), &Type::Named(*new), comparison);
        },
        comparison,
    );
}

/// Returns the text of a type, such as `UNSIGNED16`, `values of UNSIGNED16` or `array [4 from 1] of INTEGER16`.
pub(super) fn name(types: &[TypeDef], ty: Type) -> String {
    let shape = Owner::of_types(types).definition(ty).map(|definition| &definition.shape);
    match shape {
        Some(Shape::BitField { .. }) => format!("bits of {}", types::name(types, ty)),
        Some(Shape::Enumeration { .. }) => format!("values of {}", types::name(types, ty)),
        Some(Shape::Array { element, dimensions }) => {
            let bounds: Vec<String> = dimensions.iter().map(|(low, count)| format!("{count} from {low}")).collect();
            format!("array [{}] of {}", bounds.join("; "), types::name(types, *element))
        }
        Some(Shape::Record(fields)) => format!("record of {} fields", fields.len()),
        Some(Shape::Scaled { .. }) => format!("scaled {}", types::name(types, ty)),
        Some(Shape::Alias(_)) | None => types::name(types, ty),
    }
}

/// Returns the basic type of a type. Returns `None` for arrays, records and unknown types.
fn basic_of(types: &[TypeDef], ty: Type) -> Option<Type> {
    Some(types::basic(types, ty)).filter(|basic| *basic != Type::Opaque(None))
}

/// Returns the effects of a changed type whose old and new basic types are `old` and `new`.
fn effects(old: Option<Type>, new: Option<Type>) -> Judgment {
    let (Some(old), Some(new)) = (old, new) else { return Judgment::API_AND_WIRE };
    match (old, new) {
        // The basic types are equal, but the Rust types can differ: for example, only one of the two types is an enumeration.
        (old, new) if old == new => Judgment::API,
        // The length of a string does not affect the Rust type.
        (Type::VisibleString(_), Type::VisibleString(_))
        | (Type::OctetString(_), Type::OctetString(_))
        | (Type::UnicodeString(_), Type::UnicodeString(_)) => Judgment::BEHAVIOR,
        // Signed and unsigned types of the same length differ only in the meaning of the highest bit.
        (Type::Integer(old), Type::Unsigned(new)) | (Type::Unsigned(old), Type::Integer(new)) if old == new => {
            Judgment { wire: Effect::Compatible, ..Judgment::API }
        }
        _ => Judgment::API_AND_WIRE,
    }
}

/// Returns the effect of a changed type on the encoded bytes.
pub(super) fn wire_effect(old_types: &[TypeDef], old: Type, new_types: &[TypeDef], new: Type) -> Effect {
    match (basic_of(old_types, old), basic_of(new_types, new)) {
        (old, new) if old == new => Effect::Unaffected,
        (old, new) => effects(old, new).wire,
    }
}

/// Compares two definitions. `is_same_type` means that no difference between the types was reported.
fn definitions(old: &TypeDef, new: &TypeDef, is_same_type: bool, comparison: &mut Comparison<'_>) {
    compare_fields!(TypeDef, old, new, comparison, {
        name: judged("name of the type", renamed),
        code: fact("number of the type", Judgment::NONE),
        shape: shapes,
        bits: |old: &Option<u32>, new: &Option<u32>, comparison: &mut Comparison<'_>| {
            if is_same_type {
                fact("length of the type in bits", Judgment::WIRE)(old, new, comparison);
            }
        },
        documentation, doubts, stated_by,
    }, POSITION => [origin]);
}

fn shapes(old: &Shape, new: &Shape, comparison: &mut Comparison<'_>) {
    match (old, new) {
        (Shape::Alias(old), Shape::Alias(new)) => compare(old, new, comparison),
        (Shape::Array { element: old, .. }, Shape::Array { element: new, .. }) => {
            comparison.within("element", |comparison| compare(old, new, comparison));
        }
        (Shape::Record(old), Shape::Record(new)) => fields(old, new, comparison),
        (Shape::BitField { fields: old, base: old_base }, Shape::BitField { fields: new, base: new_base }) => {
            base(old_base, new_base, comparison);
            bit_fields(old, new, comparison);
        }
        (
            Shape::Enumeration { values: old, base: old_base, closed: was_closed },
            Shape::Enumeration { values: new, base: new_base, closed },
        ) => {
            base(old_base, new_base, comparison);
            fact("only listed values", Judgment::API)(was_closed, closed, comparison);
            values(old, new, comparison);
        }
        (Shape::Scaled { scale: old, base: old_base }, Shape::Scaled { scale: new, base: new_base }) => {
            base(old_base, new_base, comparison);
            fact_as("scale", Judgment::API_AND_BEHAVIOR, |scale| PLAIN.scale(scale, ""))(old, new, comparison);
        }
        // The definitions have different kinds.
        _ => comparison.push("kind of the type", kind(old).to_owned(), kind(new).to_owned(), Judgment::API),
    }
}

/// Compares the base types of two definitions if both are named types. The texts of other types already contain the
/// base type.
fn base(old: &Type, new: &Type, comparison: &mut Comparison<'_>) {
    if matches!((old, new), (Type::Named(_), Type::Named(_))) {
        comparison.within("base", |comparison| compare(old, new, comparison));
    }
}

fn kind(shape: &Shape) -> &'static str {
    match shape {
        Shape::Alias(_) => "another name",
        Shape::Array { .. } => "array",
        Shape::Record(_) => "record",
        Shape::BitField { .. } => "bits",
        Shape::Enumeration { .. } => "values",
        Shape::Scaled { .. } => "scaled number",
    }
}

fn fields(old: &[Field], new: &[Field], comparison: &mut Comparison<'_>) {
    let elements = Elements {
        name: |field: &Field| field.name.to_string(),
        position: |field| field.bit_offset.to_string(),
        added: Judgment::API_AND_WIRE,
        ..Elements::titled(|field| format!("field {}", field.name))
    };
    let compare_field = |old: &Field, new: &Field, comparison: &mut Comparison<'_>| {
        compare_fields!(Field, old, new, comparison, {
            name,
            sub_index: fact("sub-index", Judgment::WIRE),
            ty: compare,
            bits: fact("length in bits", Judgment::WIRE),
            bit_offset: fact("first bit", Judgment::WIRE),
        });
    };
    slices(old, new, &elements, compare_field, comparison);
}

fn bit_fields(old: &[BitFieldEntry], new: &[BitFieldEntry], comparison: &mut Comparison<'_>) {
    let elements = Elements {
        name: |field: &BitFieldEntry| match field.when.is_some() {
            true => format!("{} {}", field.name, bits(field)),
            false => field.name.to_string(),
        },
        position: bits,
        label: |field| field.name.to_string(),
        has_effect: |field| !matches!(field.meaning, BitMeaning::Reserved { .. }),
        ..Elements::titled(bits).judged(Judgment::API_COMPATIBLE, Judgment::API)
    };
    slices(old, new, &elements, bit_field, comparison);
}

fn bit_field(old: &BitFieldEntry, new: &BitFieldEntry, comparison: &mut Comparison<'_>) {
    comparison.texts("position", position(old), position(new), Judgment::WIRE);
    compare_fields!(BitFieldEntry, old, new, comparison, {
        name, names,
        meaning: meanings,
        when: fact("applies while", Judgment::API_AND_BEHAVIOR),
        trigger: fact("acts on", Judgment::BEHAVIOR),
        access: fact("access", Judgment::API),
        availability, documentation,
    }, COMPARED => [offset, bits], POSITION => [at]);
}

/// Returns the position of a bit field, such as `bit 4` or `bits 7 to 4`.
fn position(field: &BitFieldEntry) -> String {
    let last = u32::from(field.offset) + u32::from(field.bits).max(1) - 1;
    match field.bits {
        1 => format!("bit {last}"),
        0 => format!("no bit at {last}"),
        _ => format!("bits {last} to {}", field.offset),
    }
}

/// Returns the position of a bit field and the condition of its meaning, such as `bits 7 to 4 while Mode is 1`.
fn bits(field: &BitFieldEntry) -> String {
    let when = field.when.as_ref().map(|condition| format!(" while {}", condition.show()));
    position(field) + &when.unwrap_or_default()
}

/// Compares the meanings of bits. The meaning determines what the getter returns.
fn meanings(old: &BitMeaning, new: &BitMeaning, comparison: &mut Comparison<'_>) {
    let judgment = match (old, new) {
        (BitMeaning::Reserved { .. }, BitMeaning::Reserved { .. }) => Judgment::BEHAVIOR,
        // The methods stay the same, but the meaning of the bit is inverted.
        (BitMeaning::Flag { .. }, BitMeaning::Flag { .. }) => Judgment::WIRE,
        (BitMeaning::Reserved { .. }, _) => Judgment::API_COMPATIBLE,
        _ => Judgment::API,
    };
    comparison.texts("meaning", meaning(old).to_owned(), meaning(new).to_owned(), judgment);
    if let (BitMeaning::Enumeration(old), BitMeaning::Enumeration(new)) = (old, new) {
        compare(&Type::Named(*old), &Type::Named(*new), comparison);
    }
}

fn meaning(bit_meaning: &BitMeaning) -> &'static str {
    match bit_meaning {
        BitMeaning::Flag { inverted: false } => "a flag",
        BitMeaning::Flag { inverted: true } => "an inverted flag",
        BitMeaning::Number => "a number",
        BitMeaning::Enumeration(_) => "named values",
        BitMeaning::Reserved { write: None } => "reserved",
        BitMeaning::Reserved { write: Some(false) } => "reserved, written as 0",
        BitMeaning::Reserved { write: Some(true) } => "reserved, written as 1",
    }
}

fn values(old: &[EnumValue], new: &[EnumValue], comparison: &mut Comparison<'_>) {
    let elements = Elements {
        name: |value: &EnumValue| match value.when.as_ref() {
            Some(condition) => format!("{} while {}", value.name, condition.show()),
            None => value.name.to_string(),
        },
        position: |value| value.value.to_string(),
        label: |value| value.name.to_string(),
        // A generated enumeration has a variant for each value that is not a range, and Rust code may match all variants.
        has_effect: |value| value.last.is_none(),
        ..Elements::titled(|value| format!("value {}", number(value))).judged(Judgment::API, Judgment::API)
    };
    slices(old, new, &elements, value, comparison);
}

fn number(value: &EnumValue) -> String {
    types::numbers(value.value, value.last)
}

fn value(old: &EnumValue, new: &EnumValue, comparison: &mut Comparison<'_>) {
    let judgment = if old.value == new.value { Judgment::API } else { Judgment::WIRE };
    comparison.texts("number", number(old), number(new), judgment);
    compare_fields!(EnumValue, old, new, comparison, {
        name,
        zone: fact("zone", Judgment::BEHAVIOR),
        names,
        when: fact("applies while", Judgment::BEHAVIOR),
        availability, documentation,
    }, COMPARED => [value, last], POSITION => [at]);
}
