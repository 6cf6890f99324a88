//! The types that a device defines and that Rust code has under their names: enumerations, bit fields and their views.

use std::collections::{HashMap, HashSet};

use super::bit_field::{self, BitFieldModel};
use super::enumeration::{self, EnumerationModel};
use super::machine::{self, MachineModel};
use super::options::RustOptions;
use super::scope::Scope;
use super::value_type::ValueType;
use crate::ir::{BitMeaning, Message, Shape, StateMachine, Type, TypeDef};
use crate::names::{self, Case, Wish};

/// The types of a device or module, ready to be written.
#[derive(Default)]
pub(super) struct Types {
    /// By the positions of their definitions.
    pub enumerations: Vec<(u32, EnumerationModel)>,
    /// By the positions of their definitions.
    pub bit_fields: Vec<(u32, BitFieldModel)>,
    pub machines: Vec<MachineModel>,
}

/// What whoever uses such a type has to know of it.
#[derive(Clone, Debug)]
pub(super) struct NamedType {
    pub name: String,
    /// The type of its numbers: `u8`.
    pub native: &'static str,
    /// The integer below.
    pub ty: Type,
    /// Length in bits.
    pub bits: u32,
}

impl NamedType {
    /// Whether its numbers have a sign.
    pub(super) fn is_signed(&self) -> bool {
        self.native.starts_with('i')
    }
}

impl Types {
    /// What items and PDOs have to know of them, by the positions of their definitions.
    pub(super) fn named(&self) -> HashMap<u32, NamedType> {
        let enumerations = self.enumerations.iter().map(|(position, own)| {
            let named = NamedType { name: own.name.clone(), native: own.native, ty: own.ty, bits: own.bits };
            (*position, named)
        });
        let bit_fields = self.bit_fields.iter().map(|(position, own)| {
            let named = NamedType { name: own.name.clone(), native: own.native, ty: own.ty, bits: own.bits };
            (*position, named)
        });
        enumerations.chain(bit_fields).collect()
    }

    pub(super) fn is_empty(&self) -> bool {
        self.enumerations.is_empty() && self.bit_fields.is_empty() && self.machines.is_empty()
    }

    /// Whether their code needs the runtime's name: states and commands by themselves don't.
    pub(super) fn names_runtime(&self) -> bool {
        let has_values = !self.enumerations.is_empty() || !self.bit_fields.is_empty();
        has_values || self.machines.iter().any(MachineModel::has_transitions)
    }
}

/// Names of the prelude that the code beside these types names, and those of which clippy would take a method for a constructor.
const RESERVED_TYPES: [&str; 9] = ["Self", "Option", "Result", "Unknown", "Some", "None", "Default", "New", "FromRaw"];

/// The types that items and PDO entries of `scope` have, and those of the fields of bit fields.
pub(super) fn types(scope: &Scope<'_>, machines: &[StateMachine], options: &RustOptions) -> Types {
    let (enumerations, bit_fields, in_fields) = used(scope);
    let mut types = Types {
        enumerations: enumerations
            .into_iter()
            .filter_map(|at| Some((at, enumeration::model(scope, at, in_fields.contains(&at), options)?)))
            .collect(),
        ..Types::default()
    };
    let bit_fields: Vec<u32> = bit_fields.into_iter().filter(|&at| bit_field::is_possible(scope, at)).collect();
    let conditions: Vec<Vec<bit_field::View>> = bit_fields.iter().map(|&at| bit_field::views(scope, at)).collect();

    let definition = |at: u32| &scope.types[at as usize];
    let positions: Vec<u32> = types.enumerations.iter().map(|(at, _)| *at).chain(bit_fields.iter().copied()).collect();
    let alike = Alike::new(scope, positions.iter().map(|&at| definition(at)));
    let wish = |at: u32, kind: &str| {
        let own = definition(at);
        let is_only = alike.by_name[own.name.as_str()] == 1;
        let own = Wish { name: &own.name, fallback: format!("{kind} {at}"), suffix: alike.suffix(scope, own, at) };
        match is_only && RESERVED_TYPES.contains(&pascal(&own).as_str()) {
            true => Wish { suffix: "Type".to_owned(), ..own },
            false => own,
        }
    };
    let view_names: Vec<Vec<String>> = bit_fields
        .iter()
        .zip(&conditions)
        .map(|(&at, views)| views.iter().map(|view| format!("{} {}", definition(at).name, view.words)).collect())
        .collect();
    let mut wishes: Vec<Wish<'_>> = types.enumerations.iter().map(|(at, _)| wish(*at, "enumeration")).collect();
    wishes.extend(bit_fields.iter().map(|&at| wish(at, "bits")));
    for (&at, names) in bit_fields.iter().zip(&view_names) {
        let view = |(name, number)| Wish { name, fallback: format!("view {at}"), suffix: format!("{at}_{number}") };
        wishes.extend(names.iter().map(String::as_str).zip(0..).map(view));
    }
    let others = names::unique(&wishes, &RESERVED_TYPES, Case::Pascal);
    let plain: HashSet<String> = wishes.iter().map(pascal).collect();
    let machine_names = machine::names(machines, &|name| plain.contains(name) || others.iter().any(|own| own == name));
    let machine_wish = |name| Wish { name, fallback: "machine".to_owned(), suffix: "Machine".to_owned() };
    wishes.extend(machine_names.iter().flatten().map(|name| machine_wish(name)));

    let mut names = names::unique(&wishes, &RESERVED_TYPES, Case::Pascal).into_iter();
    let mut next = || names.next().unwrap_or_default();
    for (_, model) in &mut types.enumerations {
        model.name = next();
    }
    let own_names: Vec<String> = bit_fields.iter().map(|_| next()).collect();
    let view_names: Vec<Vec<String>> = conditions.iter().map(|views| views.iter().map(|_| next()).collect()).collect();
    let machine_names: Vec<[String; 2]> = machines.iter().map(|_| [next(), next()]).collect();

    let mut machine_methods = Vec::new();
    for [state, command] in machine::methods(machines) {
        machine_methods.extend([machine::setter(&command), state, command]);
    }
    for ((&at, name), (views, view_names)) in bit_fields.iter().zip(own_names).zip(conditions.iter().zip(view_names)) {
        let views = (views.as_slice(), view_names);
        let model = bit_field::model(scope, at, name, views, &types.enumerations, &machine_methods, options);
        types.bit_fields.push((at, model));
    }
    types.machines = machine::models(scope, machines, machine_names, &types.bit_fields, &types.enumerations, options);
    types
}

/// The name that a type would have if there were no others.
fn pascal(wish: &Wish<'_>) -> String {
    names::unique(std::slice::from_ref(wish), &[], Case::Pascal).remove(0)
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

    /// What tells types of one name apart: the integer below, or else their positions.
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

/// The positions of enumerations and of bit fields, and of the enumerations that fields of bit fields have.
fn used(scope: &Scope<'_>) -> (Vec<u32>, Vec<u32>, HashSet<u32>) {
    let items = scope.groups.iter().flat_map(|group| &group.items).map(|item| item.ty);
    let entries = scope.pdos.iter().flat_map(|pdo| &pdo.entries).map(|entry| entry.ty);
    let mut seen = HashSet::new();
    let (mut enumerations, mut bit_fields, mut in_fields) = (Vec::new(), Vec::new(), HashSet::new());
    let fields = scope.device.into_iter().flat_map(|device| device.messages.iter().flat_map(Message::values));
    for ty in items.chain(entries).chain(fields.map(|value| value.item.ty)) {
        let Some((position, definition)) = scope.resolve(ty).1 else { continue };
        if !seen.insert(position) {
            continue;
        }
        match &definition.shape {
            Shape::Enumeration { .. } => enumerations.push(position),
            Shape::BitField { fields, .. } if bit_field::is_named(fields) => {
                bit_fields.push(position);
                for field in fields {
                    if let BitMeaning::Enumeration(id) = field.meaning {
                        in_fields.insert(id.0);
                    }
                }
            }
            _ => {}
        }
    }
    let exists =
        |at: &u32| matches!(scope.types.get(*at as usize).map(|own| &own.shape), Some(Shape::Enumeration { .. }));
    enumerations.extend(in_fields.iter().copied().filter(|at| exists(at) && !seen.contains(at)));
    enumerations.sort_unstable();
    bit_fields.sort_unstable();
    (enumerations, bit_fields, in_fields)
}
