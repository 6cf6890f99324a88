//! PROFINET devices: submodules, parameter records, diagnosis, and the descriptions that a plan of slots is made of.
//!
//! Modules and submodules are shared by the device access points of a file; what none of these can have isn't emitted.
//! Each part is written at the left margin by a template of its own and then moved to its place.

mod descriptor;
mod diagnosis;
mod docs;
mod f_record;
mod field;
mod image;
mod record;
mod scope;
mod types;
mod values;

use askama::Template;

use super::nested::module;
use super::{header, layout, literal};
use super::{RustOptions, INTERFACE_VERSION};
use crate::ir::{Catalog, FileInfo};
use descriptor::{DapModel, ModuleModel, SubmoduleModel};
use diagnosis::UnitModel;
use scope::Scope;
use values::Enumeration;

#[derive(Template)]
#[template(path = "rust/profinet.rs.txt", escape = "none")]
struct FileTemplate<'a> {
    options: &'a RustOptions,
    interface_version: u32,
    body: String,
}

#[derive(Template)]
#[template(path = "rust/profinet_dap.rs.txt", escape = "none")]
struct DapTemplate<'a> {
    d: DapModel<'a>,
}

#[derive(Template)]
#[template(path = "rust/profinet_module.rs.txt", escape = "none")]
struct ModuleTemplate<'a> {
    runtime: &'a str,
    m: ModuleModel<'a>,
}

#[derive(Template)]
#[template(path = "rust/profinet_submodule.rs.txt", escape = "none")]
struct SubmoduleTemplate<'a> {
    runtime: &'a str,
    s: SubmoduleModel<'a>,
}

#[derive(Template)]
#[template(path = "rust/profinet_value.rs.txt", escape = "none")]
struct ValueTemplate<'a> {
    e: &'a Enumeration,
}

#[derive(Template)]
#[template(path = "rust/profinet_diagnosis.rs.txt", escape = "none")]
struct DiagnosisTemplate<'a> {
    runtime: &'a str,
    errors: Vec<String>,
    units: Vec<UnitModel>,
    /// Whether there is a module of enumerations.
    values: bool,
}

/// The Rust module for all device access points of `catalog`; `None` where there is none.
pub(super) fn emit(catalog: &Catalog, file: &FileInfo, options: &RustOptions) -> Option<String> {
    let scope = Scope::new(catalog, options);
    if scope.access_points.is_empty() {
        return None;
    }
    let text = render(&FileTemplate { options, interface_version: INTERFACE_VERSION, body: body(&scope) });
    Some(layout::fit(&(header(file) + &text)))
}

fn body(scope: &Scope<'_>) -> String {
    let runtime = &scope.options.runtime;
    let mut out = String::new();
    for point in &scope.access_points {
        let model = descriptor::access_point(scope, point);
        if scope.is_single() {
            out += &render(&DapTemplate { d: model });
            continue;
        }
        let (name, heading) = (model.name, model.heading.clone());
        let content = format!("use {runtime} as rt;\n{}", render(&DapTemplate { d: model }));
        module(&mut out, &heading, name, &content);
    }
    let parts = scope
        .modules
        .values()
        .map(|(module, name)| render(&ModuleTemplate { runtime, m: descriptor::module(scope, module, name) }));
    module(&mut out, "Modules that can be plugged into the device.", "modules", &parts.collect::<String>());
    let parts = scope.submodules.values().map(|(submodule, name)| {
        render(&SubmoduleTemplate { runtime, s: descriptor::submodule(scope, submodule, name) })
    });
    module(&mut out, "Submodules: their data and parameter records.", "submodules", &parts.collect::<String>());
    let parts = scope.values.iter().map(|e| render(&ValueTemplate { e }));
    module(&mut out, "Enumerations: named values of fields.", "values", &parts.collect::<String>());
    let errors = diagnosis::channel_errors(scope.catalog);
    let units = diagnosis::units(scope.catalog, &scope.values, scope.options);
    if !errors.is_empty() || !units.is_empty() {
        let values = scope.values.iter().next().is_some();
        let content = render(&DiagnosisTemplate { runtime, errors, units, values });
        module(&mut out, "Diagnosis: what error types and user structures mean.", "diagnosis", &content);
    }
    out
}

/// What a template writes, with the end of its last line.
fn render(template: &impl Template) -> String {
    let mut text = String::with_capacity(template_hint());
    // Writing to a String can't fail, and the templates call nothing that does.
    let _ = template.render_into(&mut text);
    if !text.ends_with('\n') {
        text.push('\n');
    }
    text
}

/// Room for an ordinary part.
const fn template_hint() -> usize {
    4096
}
