//! The files of a crate for a PROFINET device.

use askama::Template;
use lexibus_codegen::backend::rust::{self, ProfinetData, ProfinetProgram};

use super::files::Files;
use super::layout::{self, At};
use super::package::{render, Package};
use super::text::doc;
use crate::Failure;

/// Minimum number of submodules for which a slot plan has space. The space allows users to add modules.
const MIN_PLACES: usize = 8;

#[derive(Template)]
#[template(path = "crate/profinet_lib.rs.txt", escape = "none")]
struct Library<'l> {
    title: String,
    places: usize,
    /// Statements that plug modules and submodules.
    plugged: Vec<String>,
    data: Option<&'l ProfinetData>,
    /// Names of the structs to import.
    structs: &'static str,
}

#[derive(Template)]
#[template(path = "crate/profinet_example.rs.txt", escape = "none")]
struct Example<'e> {
    library: &'e str,
    data: Option<&'e ProfinetData>,
}

#[derive(Template)]
#[template(path = "crate/profinet_support.rs.txt", escape = "none")]
struct Support<'s> {
    library: &'s str,
    data: Option<&'s ProfinetData>,
    /// Names of the structs to import.
    structs: &'static str,
}

#[derive(Template)]
#[template(path = "crate/profinet_test.rs.txt", escape = "none")]
struct Test<'t> {
    library: &'t str,
    data: Option<&'t ProfinetData>,
}

pub(super) fn write(package: &Package, files: &mut Files) -> Result<(), Failure> {
    let program = rust::profinet_program(package.catalog)
        .ok_or_else(|| Failure::Usage("the file describes no device access point".into()))?;
    let library = package.library.as_str();
    let data = program.data.as_ref();
    let structs = data.map_or("", structs);
    let places = program.places.next_power_of_two().max(MIN_PLACES);
    let title = doc(&package.title);
    files.text("src/lib.rs", render(&Library { title, places, plugged: plugged(&program), data, structs })?);
    files.text("examples/simulated.rs", render(&Example { library, data })?);
    files.text("tests/support/mod.rs", render(&Support { library, data, structs })?);
    files.text("tests/simulated.rs", render(&Test { library, data })?);
    Ok(())
}

/// Returns the statements that plug the module and the submodule that the program uses, if they must be plugged.
fn plugged(program: &ProfinetProgram) -> Vec<String> {
    let statement = |head, arguments: &[&str]| layout::call(At(4, ""), head, arguments, "?;");
    let module = program.plugged.as_ref().map(|(slot, module)| {
        statement("plan.plug", &[&slot.to_string(), &format!("&bindings::modules::{module}::MODULE")])
    });
    let submodule = program.data.as_ref().filter(|_| program.plugs_submodule).map(|data| {
        let constant = format!("&bindings::submodules::{}::SUBMODULE", data.submodule);
        statement("plan.plug_submodule", &[&data.slot.to_string(), &data.subslot.to_string(), &constant])
    });
    module.into_iter().chain(submodule).collect()
}

/// Returns the names of the structs to import.
fn structs(data: &ProfinetData) -> &'static str {
    match (data.has_inputs, data.has_outputs) {
        (true, true) => "{Inputs, Outputs}",
        (true, false) => "Inputs",
        _ => "Outputs",
    }
}
