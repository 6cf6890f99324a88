//! Reads machine constants, and machine units that depend on these constants.

use super::at::At;
use super::format::{GivenTable, MachineUnitTable};
use super::tree::Reader;
use super::{units, value};
use crate::diagnostics::codes;
use crate::ir::{GivenNumber, MachineUnit, Type};
use crate::text::brief;

/// Reads a machine constant from the table `[given]`.
pub(super) fn number(reader: &mut Reader<'_, '_>, name: &At<String>, table: &GivenTable) -> GivenNumber {
    if let Some(unit) = &table.unit {
        symbol(reader, unit);
    }
    let mut models = Vec::new();
    for (model, given) in table.models.iter() {
        reader.mention([model], "model");
        models.push((reader.reference(model), value::value(reader, given, Type::Real64)));
    }
    let origin = reader.origin(name);
    GivenNumber {
        name: name.value.as_str().into(),
        unit: table.unit.as_ref().map(|unit| unit.value.as_str().into()).unwrap_or_default(),
        models,
        doubts: reader.doubts_of(table, origin),
        documentation: reader.documentation_of(table),
        origin,
    }
}

/// Reads the machine unit of a unit in the table `[units]`. Returns `None` if the machine unit has no symbol.
pub(super) fn unit(reader: &mut Reader<'_, '_>, table: &MachineUnitTable) -> Option<Box<MachineUnit>> {
    reader.mention(table.times.iter().chain(&table.over), "given number");
    let unit = table.unit.as_ref()?;
    symbol(reader, unit);
    let names = |list: &[At<String>]| list.iter().map(|name| reader.reference(name)).collect();
    let unit = unit.value.as_str().into();
    Some(Box::new(MachineUnit { unit, times: names(&table.times), over: names(&table.over) }))
}

fn symbol(reader: &mut Reader<'_, '_>, unit: &At<String>) {
    if !units::is_unit(&unit.value) {
        let message = format!("`{}` is not a known unit", brief(&unit.value));
        let found = codes::UNKNOWN_UNIT.at(reader.span(unit), message);
        reader.diagnostics.push(match units::usual_unit(&unit.value) {
            Some(usual) => found.help(format!("did you mean `{usual}`?")),
            None => found.label("kept unchanged"),
        });
    }
}
