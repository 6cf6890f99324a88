//! Definitions of types and code tables that a device can re-export instead of containing them.

use super::bit_field::BitFieldModel;
use super::code::Code;
use super::code_table::CodeTableModel;
use super::machine::MachineModel;
use super::named::Types;
use super::print;
use super::reexport::Section;

/// Definitions that are shared only together.
pub(super) struct Shareable<'d> {
    pub section: Section,
    /// The names of the definitions, each with a sentence about the items that use the definition. The sentence is empty for views,
    /// states, commands and code tables.
    pub names: Vec<(&'d str, &'d str)>,
    /// Names in the code that may refer to types.
    pub used: Vec<&'d str>,
    /// True if a profile states the definitions.
    pub is_of_profile: bool,
    /// Writes the code of the definitions.
    pub write: &'d dyn Fn(&mut Code),
}

/// Removes the types for which `is_kept` returns false.
pub(super) fn retain_types(types: &mut Types, is_kept: &mut dyn FnMut(&Shareable<'_>) -> bool) {
    let section = Section::Types;
    types.enumerations.retain(|(_, enumeration)| {
        is_kept(&Shareable {
            section,
            names: vec![(&enumeration.name, &enumeration.users)],
            used: Vec::new(),
            is_of_profile: enumeration.is_of_profile,
            write: &|code| print::types::enumeration(code, enumeration),
        })
    });
    // A state machine adds methods to its bit fields. State machines and their bit fields must therefore be shared
    // together.
    let machines = std::mem::take(&mut types.machines);
    let has_methods =
        |bits: &BitFieldModel| machines.iter().flat_map(MachineModel::bit_fields).any(|name| name == bits.name);
    types.bit_fields.retain(|(_, bits)| {
        has_methods(bits)
            || is_kept(&Shareable {
                section,
                names: bit_field_names(bits).collect(),
                used: bits.type_names().collect(),
                is_of_profile: bits.is_of_profile,
                write: &|code| print::bit_field::write(code, bits),
            })
    });
    if machines.is_empty() {
        return;
    }
    let with_methods: Vec<&BitFieldModel> =
        types.bit_fields.iter().map(|(_, bits)| bits).filter(|bits| has_methods(bits)).collect();
    let of_machines = machines.iter().flat_map(MachineModel::names).map(|name| (name, ""));
    let shareable = Shareable {
        section,
        names: of_machines.chain(with_methods.iter().flat_map(|bits| bit_field_names(bits))).collect(),
        used: with_methods.iter().flat_map(|bits| bits.type_names()).collect(),
        is_of_profile: machines.iter().all(|machine| machine.is_of_profile)
            && with_methods.iter().all(|bits| bits.is_of_profile),
        write: &|code| {
            with_methods.iter().for_each(|bits| print::bit_field::write(code, bits));
            machines.iter().for_each(|machine| print::types::machine(code, machine));
        },
    };
    if is_kept(&shareable) {
        types.machines = machines;
    } else {
        types.bit_fields.retain(|(_, bits)| !has_methods(bits));
    }
}

/// Returns the names of a bit field and its views.
fn bit_field_names(bits: &BitFieldModel) -> impl Iterator<Item = (&str, &str)> {
    let views = bits.views.iter().map(|view| (view.name.as_str(), ""));
    std::iter::once((bits.name.as_str(), bits.users.as_str())).chain(views)
}

/// Removes the code tables for which `is_kept` returns false.
pub(super) fn retain_code_tables(tables: &mut Vec<CodeTableModel>, is_kept: &mut dyn FnMut(&Shareable<'_>) -> bool) {
    tables.retain(|table| {
        let ty = table.ty.as_ref().map(|ty| ty.name.as_str()).filter(|name| *name != table.name);
        is_kept(&Shareable {
            section: Section::Codes,
            names: std::iter::once(table.name.as_str()).chain(ty).map(|name| (name, "")).collect(),
            used: Vec::new(),
            is_of_profile: table.is_of_profile,
            write: &|code| print::codes::table(code, table),
        })
    });
}
