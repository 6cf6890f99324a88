//! Types of the description that have names in generated code: enumerations, bit fields and their views, states and
//! commands.

use super::handles::HandleNames;
use super::machines::{self, NamedMachine};
use crate::backend::rust::scope::Scope;
use crate::backend::rust::value_type::ValueType;
use crate::collections::{HashMap, HashSet};
use crate::ir::{BitFieldEntry, BitMeaning, Condition, Message, Shape, StateMachine, Type, TypeDef, Value};
use crate::names::{self, Case, NameRequest};

/// A named type: an enumeration or a bit field.
#[derive(Clone, Debug)]
pub(in crate::backend::rust) struct NamedType {
    pub name: String,
    /// Rust path of the base type, such as `u8` or `rt::Uint<3>`.
    pub base: String,
    /// Primitive integer that holds the raw value, such as `u8`.
    pub native: &'static str,
    /// Integer type of the raw value in the IR.
    pub ty: Type,
    /// Length in bits.
    pub bits: u32,
}

impl NamedType {
    /// Creates a type with the base type `ty` and without a name. Returns `None` if neither Rust nor the runtime has a
    /// corresponding integer type.
    fn with_base(ty: Type) -> Option<Self> {
        let value = ValueType::of(ty);
        Some(NamedType { name: String::new(), base: value.path(), native: value.native()?, ty, bits: ty.bits()? })
    }

    /// Returns whether the raw value is signed.
    pub fn is_signed(&self) -> bool {
        self.native.starts_with('i')
    }
}

/// The view of a bit field: the bits that apply under one condition.
pub(in crate::backend::rust) struct View {
    pub name: String,
    pub condition: Condition,
    /// The condition in words, for the name of the view: `in profile position`.
    pub words: String,
}

/// The names of all types.
#[derive(Default)]
pub(in crate::backend::rust) struct TypeNames<'a> {
    /// Enumerations, sorted by the positions of their definitions.
    pub enumerations: Vec<(u32, NamedType)>,
    /// Bit fields with their views, sorted by the positions of their definitions.
    pub bit_fields: Vec<(u32, NamedType, Vec<View>)>,
    /// Enumerations that are types of fields in bit fields.
    pub in_fields: HashSet<u32>,
    pub machines: Vec<NamedMachine<'a>>,
}

/// Reserved names: the keyword `Self`, names that the generated code uses, and names of constructors, because clippy
/// reports a constructor that has the name of its type.
const RESERVED: [&str; 9] = ["Self", "Option", "Result", "Unknown", "Some", "None", "Default", "New", "FromRaw"];

impl<'a> TypeNames<'a> {
    /// Returns the named types of items, PDO entries, message fields and fields in bit fields, with the names of views
    /// and state machines.
    pub(super) fn of(scope: &Scope<'a>, handles: &HandleNames<'_>) -> Self {
        let mut types = used(scope, handles);
        let machines = scope.device.map_or(&[][..], |device| &device.machines);
        let mut names = types.unique(scope, machines).into_iter();
        let enumerations = types.enumerations.iter_mut().map(|(_, named)| named);
        for named in enumerations.chain(types.bit_fields.iter_mut().map(|(_, named, _)| named)) {
            named.name = names.next().unwrap_or_default();
        }
        for view in types.bit_fields.iter_mut().flat_map(|(.., views)| views) {
            view.name = names.next().unwrap_or_default();
        }
        types.machines = machines::names(machines, &mut names);
        types
    }

    /// Returns the enumeration or bit field at `position` in the list of types.
    pub fn get(&self, position: u32) -> Option<&NamedType> {
        let bit_field = || {
            let at = self.bit_fields.binary_search_by_key(&position, |(other, ..)| *other).ok()?;
            self.bit_fields.get(at).map(|(_, named, _)| named)
        };
        self.enumeration(position).or_else(bit_field)
    }

    /// Returns the enumeration at `position` in the list of types.
    pub fn enumeration(&self, position: u32) -> Option<&NamedType> {
        let at = self.enumerations.binary_search_by_key(&position, |(other, _)| *other).ok()?;
        self.enumerations.get(at).map(|(_, named)| named)
    }

    /// Returns unique names of the enumerations, bit fields, views, states and commands.
    fn unique(&self, scope: &Scope<'_>, machines: &[StateMachine]) -> Vec<String> {
        let definition = |at: u32| &scope.types[at as usize];
        let enumerations = || self.enumerations.iter().map(|(at, _)| *at);
        let bit_fields = || self.bit_fields.iter().map(|(at, ..)| *at);
        let name_counts = NameCounts::new(scope, enumerations().chain(bit_fields()).map(definition));
        let name_request = |at: u32, kind: &str| {
            let definition = definition(at);
            let is_only = name_counts.by_name[definition.name.as_str()] == 1;
            let fallback = format!("{kind} {at}");
            let suffix = name_counts.suffix(scope, definition, at);
            let request = NameRequest { name: &definition.name, fallback, suffix };
            match is_only && RESERVED.contains(&pascal(&request).as_str()) {
                true => NameRequest { suffix: "Type".to_owned(), ..request },
                false => request,
            }
        };
        let of_views = |(at, _, views): &(u32, NamedType, Vec<View>)| -> Vec<(u32, usize, String)> {
            let name =
                |(number, view): (usize, &View)| (*at, number, format!("{} {}", definition(*at).name, view.words));
            views.iter().enumerate().map(name).collect()
        };
        let views: Vec<(u32, usize, String)> = self.bit_fields.iter().flat_map(of_views).collect();
        let mut name_requests: Vec<NameRequest<'_>> =
            enumerations().map(|at| name_request(at, "enumeration")).collect();
        name_requests.extend(bit_fields().map(|at| name_request(at, "bits")));
        name_requests.extend(views.iter().map(|(at, number, name)| NameRequest {
            name,
            fallback: format!("view {at}"),
            suffix: format!("{at}_{number}"),
        }));
        let others = names::unique(name_requests.clone(), &RESERVED, Case::Pascal);
        let plain: HashSet<String> = name_requests.iter().map(pascal).collect();
        let is_used = |name: &str| plain.contains(name) || others.iter().any(|other| other == name);
        let machine_names = machines::type_names(machines, &is_used);
        let of_machine = |name| NameRequest { name, fallback: "machine".to_owned(), suffix: "Machine".to_owned() };
        name_requests.extend(machine_names.iter().flatten().map(|name| of_machine(name)));
        names::unique(name_requests, &RESERVED, Case::Pascal)
    }
}

/// Returns the name of a type before the names are made unique.
fn pascal(name_request: &NameRequest<'_>) -> String {
    names::identifier(name_request, Case::Pascal)
}

/// Number of types with the same name, and number of types with the same name and base type.
struct NameCounts<'a> {
    by_name: HashMap<&'a str, usize>,
    by_base: HashMap<(&'a str, Type), usize>,
}

impl<'a> NameCounts<'a> {
    fn new(scope: &Scope<'_>, types: impl Iterator<Item = &'a TypeDef>) -> Self {
        let mut counts = NameCounts { by_name: HashMap::default(), by_base: HashMap::default() };
        for definition in types {
            *counts.by_name.entry(&definition.name).or_default() += 1;
            *counts.by_base.entry((&definition.name, base_type(scope, definition))).or_default() += 1;
        }
        counts
    }

    /// Returns the suffix of a type whose name is ambiguous. The suffix is the base type if this makes the name unique.
    /// Otherwise, the suffix is the position of the type in the list of types.
    fn suffix(&self, scope: &Scope<'_>, definition: &TypeDef, position: u32) -> String {
        let base = base_type(scope, definition);
        let name = definition.name.as_str();
        match self.by_name[name] > 1 && self.by_base[&(name, base)] == 1 {
            true => ValueType::of(base).word(),
            false => position.to_string(),
        }
    }
}

/// Returns the base type of an enumeration or bit field.
fn base_type(scope: &Scope<'_>, definition: &TypeDef) -> Type {
    match &definition.shape {
        Shape::Enumeration { base, .. } | Shape::BitField { base, .. } => scope.base(*base),
        _ => Type::Opaque(None),
    }
}

/// Returns the types that generated code uses. At this stage, the names of the types are still empty.
fn used<'a>(scope: &Scope<'_>, handles: &HandleNames<'_>) -> TypeNames<'a> {
    let items = scope.groups.iter().flat_map(|group| &group.items).map(|item| item.ty);
    let entries = scope.pdos.iter().flat_map(|pdo| &pdo.entries).map(|entry| entry.ty);
    let fields = scope.device.into_iter().flat_map(|device| device.messages.iter().flat_map(Message::values));
    let mut seen = HashSet::default();
    let (mut enumerations, mut bit_fields, mut in_fields) = (Vec::new(), Vec::new(), HashSet::default());
    for ty in items.chain(entries).chain(fields.map(|value| value.item.ty)) {
        let Some((position, definition)) = scope.resolve(ty).1.filter(|(position, _)| seen.insert(*position)) else {
            continue;
        };
        match &definition.shape {
            Shape::Enumeration { .. } => enumerations.push(position),
            Shape::BitField { fields, .. } if is_named(fields) => {
                bit_fields.push(position);
                in_fields.extend(fields.iter().filter_map(|field| match field.meaning {
                    BitMeaning::Enumeration(id) => Some(id.0),
                    _ => None,
                }));
            }
            _ => {}
        }
    }
    enumerations.extend(in_fields.iter().copied().filter(|at| !seen.contains(at)));
    enumerations.sort_unstable();
    bit_fields.sort_unstable();
    let enumerations = enumerations.into_iter().filter_map(|at| Some((at, enumeration(scope, at)?)));
    let bit_fields =
        bit_fields.into_iter().filter_map(|at| Some((at, bit_field(scope, at)?, views(scope, handles, at))));
    let (enumerations, bit_fields) = (enumerations.collect(), bit_fields.collect());
    TypeNames { enumerations, bit_fields, in_fields, machines: Vec::new() }
}

/// Returns whether any bit has a name in the description. Reserved bits and fallback names such as "Bit 3" do not
/// count.
fn is_named(fields: &[BitFieldEntry]) -> bool {
    fields.iter().any(|field| match field.meaning {
        BitMeaning::Reserved { .. } => false,
        BitMeaning::Flag { .. } => field.name.as_str() != format!("Bit {}", field.offset),
        _ => true,
    })
}

/// Returns the enumeration at `position` in the list of types. Returns `None` if its base type is not an integer, or if
/// none of its single values fits this type.
fn enumeration(scope: &Scope<'_>, position: u32) -> Option<NamedType> {
    let Shape::Enumeration { base, values, .. } = &scope.types.get(position as usize)?.shape else { return None };
    // If a Boolean has named values, its base type is a one-bit integer.
    let base = match scope.base(*base) {
        Type::Boolean => Type::Unsigned(1),
        other => other,
    };
    let (low, high) = base.integer_range()?;
    let has_value = values.iter().any(|value| value.last.is_none() && (low..=high).contains(&value.value));
    NamedType::with_base(base).filter(|_| has_value)
}

/// Returns the bit field at `position` in the list of types. Bit fields are always unsigned.
fn bit_field(scope: &Scope<'_>, position: u32) -> Option<NamedType> {
    let Shape::BitField { base, .. } = &scope.types.get(position as usize)?.shape else { return None };
    NamedType::with_base(Type::Unsigned(u8::try_from(scope.base(*base).bits()?).ok()?))
}

/// Returns the views of the bit field at `position`: one view for each condition under which some of its bits have a
/// meaning.
fn views(scope: &Scope<'_>, handles: &HandleNames<'_>, position: u32) -> Vec<View> {
    let Shape::BitField { fields, .. } = &scope.types[position as usize].shape else { return Vec::new() };
    let mut views: Vec<View> = Vec::new();
    for field in fields.iter().filter(|field| !matches!(field.meaning, BitMeaning::Reserved { .. })) {
        let Some(condition) = field.when.as_deref() else { continue };
        if !views.iter().any(|view| view.condition == *condition) {
            let (condition, words) = (condition.clone(), words(scope, handles, condition));
            views.push(View { name: String::new(), condition, words });
        }
    }
    views
}

/// Returns the names of the values in a condition: from the enumeration of the item, or as the condition states them.
/// Returns `None` if the enumeration does not name all values and the condition states no names, or if the condition
/// has a mask.
pub(in crate::backend::rust) fn value_names(scope: &Scope<'_>, condition: &Condition) -> Option<Vec<String>> {
    let item = scope.referred(&condition.item);
    let definition = item.and_then(|item| scope.resolve(item.ty).1).map(|(_, definition)| definition);
    let named = |value: &Value| {
        let Shape::Enumeration { values, .. } = &definition?.shape else { return None };
        let number = value.as_int()?;
        values.iter().find(|entry| entry.value == number && entry.last.is_none()).map(|entry| entry.name.to_string())
    };
    let stated_names = || {
        let names: Vec<String> = condition.names.iter().map(ToString::to_string).collect();
        (!names.is_empty()).then_some(names)
    };
    let type_names = condition.values.iter().map(named).collect::<Option<_>>();
    type_names.or_else(stated_names).filter(|_| condition.mask.is_none())
}

/// Returns a condition in words, for the name of a view.
fn words(scope: &Scope<'_>, handles: &HandleNames<'_>, condition: &Condition) -> String {
    let item = condition.item.id.and_then(|id| handles.whole(id));
    let item = item.unwrap_or_else(|| condition.item.as_str().into());
    let numbers = condition.values.iter().map(Value::to_string).collect::<Vec<_>>().join(" or ");
    match (value_names(scope, condition), condition.mask) {
        (Some(names), _) => format!("in {}", names.join(" or ")),
        (None, Some(mask)) => format!("in {item} {mask:x} {numbers}"),
        (None, None) => format!("in {item} {numbers}"),
    }
}
