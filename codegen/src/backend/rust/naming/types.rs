//! The types that a description defines and that Rust code has under their names: enumerations, bit fields and their views, states and
//! commands.

use std::collections::{HashMap, HashSet};

use super::handles::HandleNames;
use super::machines::{self, NamedMachine};
use crate::backend::rust::scope::Scope;
use crate::backend::rust::value_type::ValueType;
use crate::ir::{BitFieldEntry, BitMeaning, Condition, Message, Shape, StateMachine, Type, TypeDef, Value};
use crate::names::{self, Case, Wish};

/// An enumeration or a bit field.
#[derive(Clone, Debug)]
pub(in crate::backend::rust) struct NamedType {
    pub name: String,
    /// The type of the value below, in terms of the runtime: `u8`, `rt::Uint<3>`.
    pub base: &'static str,
    /// The type of its numbers: `u8`.
    pub native: &'static str,
    /// The integer below.
    pub ty: Type,
    /// Length in bits.
    pub bits: u32,
}

impl NamedType {
    /// The type over this integer, as yet without a name; `None` where Rust has no such integer.
    fn over(ty: Type) -> Option<Self> {
        let (base, native) = ValueType::of(ty).number()?;
        Some(NamedType { name: String::new(), base, native, ty, bits: ty.bits()? })
    }

    /// Whether its numbers have a sign.
    pub fn is_signed(&self) -> bool {
        self.native.starts_with('i')
    }
}

/// The bits of a bit field that have their meaning under one condition.
pub(in crate::backend::rust) struct View {
    pub name: String,
    pub condition: Condition,
    /// `in profile position`.
    pub words: String,
}

/// The names of all types.
#[derive(Default)]
pub(in crate::backend::rust) struct TypeNames<'a> {
    /// By the positions of their definitions, in ascending order.
    pub enumerations: Vec<(u32, NamedType)>,
    /// The same, with the views of each.
    pub bit_fields: Vec<(u32, NamedType, Vec<View>)>,
    /// The enumerations that fields of bit fields have.
    pub in_fields: HashSet<u32>,
    pub machines: Vec<NamedMachine<'a>>,
}

/// Names of the prelude that the same module uses, and those of which clippy would take a method for a constructor.
const RESERVED: [&str; 9] = ["Self", "Option", "Result", "Unknown", "Some", "None", "Default", "New", "FromRaw"];

impl<'a> TypeNames<'a> {
    /// The types that items and PDO entries have, and those of the fields of bit fields.
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

    /// The enumeration or the bit field at this position.
    pub fn get(&self, position: u32) -> Option<&NamedType> {
        let bit_field = || {
            let at = self.bit_fields.binary_search_by_key(&position, |(own, ..)| *own).ok()?;
            self.bit_fields.get(at).map(|(_, own, _)| own)
        };
        self.enumeration(position).or_else(bit_field)
    }

    /// The enumeration at this position.
    pub fn enumeration(&self, position: u32) -> Option<&NamedType> {
        let at = self.enumerations.binary_search_by_key(&position, |(own, _)| *own).ok()?;
        self.enumerations.get(at).map(|(_, own)| own)
    }

    /// The names of enumerations, of bit fields, of views, and of states and commands.
    fn unique(&self, scope: &Scope<'_>, machines: &[StateMachine]) -> Vec<String> {
        let definition = |at: u32| &scope.types[at as usize];
        let enumerations = || self.enumerations.iter().map(|(at, _)| *at);
        let bit_fields = || self.bit_fields.iter().map(|(at, ..)| *at);
        let alike = Alike::new(scope, enumerations().chain(bit_fields()).map(definition));
        let wish = |at: u32, kind: &str| {
            let own = definition(at);
            let is_only = alike.by_name[own.name.as_str()] == 1;
            let own = Wish { name: &own.name, fallback: format!("{kind} {at}"), suffix: alike.suffix(scope, own, at) };
            match is_only && RESERVED.contains(&pascal(&own).as_str()) {
                true => Wish { suffix: "Type".to_owned(), ..own },
                false => own,
            }
        };
        let of_views = |(at, _, views): &(u32, NamedType, Vec<View>)| -> Vec<(u32, usize, String)> {
            let name =
                |(number, view): (usize, &View)| (*at, number, format!("{} {}", definition(*at).name, view.words));
            views.iter().enumerate().map(name).collect()
        };
        let views: Vec<(u32, usize, String)> = self.bit_fields.iter().flat_map(of_views).collect();
        let mut wishes: Vec<Wish<'_>> = enumerations().map(|at| wish(at, "enumeration")).collect();
        wishes.extend(bit_fields().map(|at| wish(at, "bits")));
        wishes.extend(views.iter().map(|(at, number, name)| Wish {
            name,
            fallback: format!("view {at}"),
            suffix: format!("{at}_{number}"),
        }));
        let others = names::unique(&wishes, &RESERVED, Case::Pascal);
        let plain: HashSet<String> = wishes.iter().map(pascal).collect();
        let is_used = |name: &str| plain.contains(name) || others.iter().any(|other| other == name);
        let machine_names = machines::wished(machines, &is_used);
        let of_machine = |name| Wish { name, fallback: "machine".to_owned(), suffix: "Machine".to_owned() };
        wishes.extend(machine_names.iter().flatten().map(|name| of_machine(name)));
        names::unique(&wishes, &RESERVED, Case::Pascal)
    }
}

/// The name that a type would have if there were no others.
fn pascal(wish: &Wish<'_>) -> String {
    names::identifier(wish, Case::Pascal)
}

/// How many types have a name, and a name and an integer below.
struct Alike<'a> {
    by_name: HashMap<&'a str, usize>,
    by_base: HashMap<(&'a str, Type), usize>,
}

impl<'a> Alike<'a> {
    fn new(scope: &Scope<'_>, types: impl Iterator<Item = &'a TypeDef>) -> Self {
        let mut alike = Alike { by_name: HashMap::new(), by_base: HashMap::new() };
        for own in types {
            *alike.by_name.entry(&own.name).or_default() += 1;
            *alike.by_base.entry((&own.name, below(scope, own))).or_default() += 1;
        }
        alike
    }

    /// How types with the same name differ: by their integer, or by their position if the integers are equal.
    fn suffix(&self, scope: &Scope<'_>, own: &TypeDef, position: u32) -> String {
        let base = below(scope, own);
        let name = own.name.as_str();
        match self.by_name[name] > 1 && self.by_base[&(name, base)] == 1 {
            true => ValueType::of(base).word(),
            false => position.to_string(),
        }
    }
}

/// The integer below a type.
fn below(scope: &Scope<'_>, own: &TypeDef) -> Type {
    match &own.shape {
        Shape::Enumeration { base, .. } | Shape::BitField { base, .. } => scope.base(*base),
        _ => Type::Opaque(None),
    }
}

/// The types that are used, as yet without names.
fn used<'a>(scope: &Scope<'_>, handles: &HandleNames<'_>) -> TypeNames<'a> {
    let items = scope.groups.iter().flat_map(|group| &group.items).map(|item| item.ty);
    let entries = scope.pdos.iter().flat_map(|pdo| &pdo.entries).map(|entry| entry.ty);
    let fields = scope.device.into_iter().flat_map(|device| device.messages.iter().flat_map(Message::values));
    let mut seen = HashSet::new();
    let (mut enumerations, mut bit_fields, mut in_fields) = (Vec::new(), Vec::new(), HashSet::new());
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

/// Whether any bit has a name. A fallback such as "Bit 3" is none.
fn is_named(fields: &[BitFieldEntry]) -> bool {
    fields.iter().any(|field| match field.meaning {
        BitMeaning::Reserved { .. } => false,
        BitMeaning::Flag { .. } => field.name.as_str() != format!("Bit {}", field.offset),
        _ => true,
    })
}

/// The enumeration at this position; `None` where it has no value that its integer has.
fn enumeration(scope: &Scope<'_>, position: u32) -> Option<NamedType> {
    let Shape::Enumeration { base, values, .. } = &scope.types.get(position as usize)?.shape else { return None };
    // A truth value with names for its values is a number of one bit.
    let base = match scope.base(*base) {
        Type::Boolean => Type::Unsigned(1),
        other => other,
    };
    let (low, high) = base.integer_range()?;
    let has_value = values.iter().any(|value| value.last.is_none() && (low..=high).contains(&value.value));
    NamedType::over(base).filter(|_| has_value)
}

/// The bit field at this position. Bits have no sign.
fn bit_field(scope: &Scope<'_>, position: u32) -> Option<NamedType> {
    let Shape::BitField { base, .. } = &scope.types.get(position as usize)?.shape else { return None };
    NamedType::over(Type::Unsigned(u8::try_from(scope.base(*base).bits()?).ok()?))
}

/// The conditions under which bits of the type at this position have a meaning.
fn views(scope: &Scope<'_>, handles: &HandleNames<'_>, position: u32) -> Vec<View> {
    let Shape::BitField { fields, .. } = &scope.types[position as usize].shape else { return Vec::new() };
    let mut views: Vec<View> = Vec::new();
    for field in fields.iter().filter(|field| !matches!(field.meaning, BitMeaning::Reserved { .. })) {
        let Some(condition) = &field.when else { continue };
        if !views.iter().any(|view| view.condition == *condition) {
            let (condition, words) = (condition.clone(), words(scope, handles, condition));
            views.push(View { name: String::new(), condition, words });
        }
    }
    views
}

/// The names of the values of a condition; `None` where one has no name, or only some bits count.
pub(in crate::backend::rust) fn value_names(scope: &Scope<'_>, condition: &Condition) -> Option<Vec<String>> {
    let item = scope.referred(&condition.item);
    let definition = item.and_then(|item| scope.resolve(item.ty).1).map(|(_, definition)| definition);
    let named = |value: &Value| {
        let Shape::Enumeration { values, .. } = &definition?.shape else { return None };
        let number = value.as_int()?;
        values.iter().find(|own| own.value == number && own.last.is_none()).map(|own| own.name.to_string())
    };
    let of_condition = || {
        let names: Vec<String> = condition.names.iter().map(ToString::to_string).collect();
        (!names.is_empty()).then_some(names)
    };
    let of_item = condition.values.iter().map(named).collect::<Option<_>>();
    of_item.or_else(of_condition).filter(|_| condition.mask.is_none())
}

/// The words of a condition for a name.
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
