//! Creates the outputs of a test case: the diagnostics as printed on a terminal, and the outputs that the settings
//! name.

use lexibus_codegen::compile::{check, Compilation, Options};
use lexibus_codegen::diagnostics::{render, Severity};
use lexibus_codegen::ir::Catalog;
use lexibus_codegen::source::Source;
use lexibus_export::eds::{self, Flavor, Reals};
use lexibus_export::{esi, gsdml, json, Export, Refusal};
use lexibus_import::import;
use lexibus_site::compare::{compare, Summary};
use lexibus_site::{Format, Page, Site};

use crate::case::{ending, put_diagnostics, Case, Outputs};
use crate::console;
use crate::part::{parts, Form};

/// Returns all outputs of a test case.
///
/// # Errors
///
/// Returns an error if an output cannot be created or does not contain a named part.
pub fn of(case: &Case) -> Result<Outputs, String> {
    let mut outputs = Outputs::new();
    if !case.settings.commands.is_empty() {
        outputs.insert("output.console".to_owned(), console::of(case)?);
        return Ok(outputs);
    }
    let inputs = case.inputs();
    if inputs.iter().any(|input| ending(input.name()) == "csv") {
        import_lists(case, inputs, &mut outputs)?;
        return Ok(outputs);
    }
    if case.settings.network {
        let compilations = inputs.into_iter().map(|input| network(input, case));
        put_diagnostics(&mut outputs, compilations.map(|compilation| printed(&compilation)).collect());
        return Ok(outputs);
    }
    let options = case.options();
    let compilations: Vec<Compilation> = inputs.into_iter().map(|input| check(input, &options)).collect();
    let mut diagnostics: String = compilations.iter().map(printed).collect();
    for compilation in &compilations {
        let name = compilations.len().gt(&1).then(|| compilation.sources[0].name());
        for (file, text) in made(case, compilation, &options, &mut diagnostics)? {
            let heading = name.map_or(String::new(), |name| format!("== {name}\n"));
            *outputs.entry(file).or_default() += &(heading + &text);
        }
    }
    if case.settings.diff {
        outputs.insert("output.diff".to_owned(), difference(case, &compilations)?);
    }
    put_diagnostics(&mut outputs, diagnostics);
    Ok(outputs)
}

/// Compiles a network file.
fn network(input: Source, case: &Case) -> Compilation {
    let compilation = lexibus_network::compile::compile(input, case.levels());
    Compilation::of_diagnostics(compilation.source, compilation.diagnostics)
}

/// Returns the diagnostics of a file as printed on a terminal.
fn printed(compilation: &Compilation) -> String {
    let diagnostics = &compilation.diagnostics;
    let list = diagnostics.list().iter();
    let text: String =
        list.map(|found| render::terminal::render(found, &compilation.sources, false) + "\n\n").collect();
    if text.is_empty() {
        return text;
    }
    let counts = (diagnostics.count(Severity::Error), diagnostics.count(Severity::Warning));
    let name = compilation.sources[0].name();
    format!("{text}{name}: {}\n", render::summary(counts.0, counts.1))
}

/// Returns the outputs of a file that the settings name. Appends the notes and refusals of exports to the diagnostics.
fn made(
    case: &Case,
    compilation: &Compilation,
    options: &Options,
    diagnostics: &mut String,
) -> Result<Vec<(String, String)>, String> {
    let settings = &case.settings;
    let mut outputs = Vec::new();
    let mut put = |name: &str, text: &str, form, wanted: &Vec<String>| -> Result<(), String> {
        outputs.push((format!("output.{name}"), parts(text, form, wanted)?));
        Ok(())
    };
    if let Some(wanted) = &settings.rust {
        put("rs", &compilation.rust(&options.rust).ok_or("no Rust is generated")?, Form::Rust, wanted)?;
    }
    if let Some(wanted) = &settings.info {
        put("info.json", &pretty(&json::info(compilation)), Form::Indented, wanted)?;
    }
    if let Some(pointers) = &settings.dump {
        let catalog = serde_json::to_value(usable(compilation)?).expect("JSON");
        put("ir.json", &pointed(&catalog, pointers)?, Form::Indented, &Vec::new())?;
    }
    if let Some(wanted) = &settings.markdown {
        put("md", &pages(compilation), Form::Paragraphs, wanted)?;
    }
    let exports =
        [("eds", &settings.eds), ("dcf", &settings.dcf), ("esi.xml", &settings.esi), ("gsdml.xml", &settings.gsdml)];
    for (name, wanted) in exports {
        let Some(wanted) = wanted else { continue };
        let form = if name.ends_with("xml") { Form::Indented } else { Form::Paragraphs };
        match export(case, name, compilation)? {
            Ok(exported) => {
                put(name, &exported.text, form, wanted)?;
                *diagnostics +=
                    &exported.notes.iter().map(|note| format!("note: {name}: {note}\n")).collect::<String>();
            }
            Err(refusal) => *diagnostics += &format!("error: {name}: {refusal}\n"),
        }
    }
    Ok(outputs)
}

fn usable(compilation: &Compilation) -> Result<&Catalog, String> {
    compilation.catalog.as_ref().ok_or_else(|| format!("{} could not be used", compilation.sources[0].name()))
}

fn pretty(value: &impl serde::Serialize) -> String {
    serde_json::to_string_pretty(value).expect("JSON") + "\n"
}

/// Returns the values at these JSON pointers. Each value follows its pointer.
fn pointed(catalog: &serde_json::Value, pointers: &[String]) -> Result<String, String> {
    let texts = pointers.iter().map(|pointer| {
        let value = catalog.pointer(pointer).ok_or_else(|| format!("the IR has nothing at {pointer}"))?;
        Ok(format!("{pointer}: {}", pretty(value)))
    });
    texts.collect::<Result<Vec<String>, String>>().map(|texts| texts.concat())
}

/// Returns all Markdown pages of a file. The path of each page precedes its text.
fn pages(compilation: &Compilation) -> String {
    let mut site = Site::new(Format::Markdown);
    let mut pages = site.add_compilation("input", compilation);
    pages.extend(site.finish());
    pages.iter().map(|Page { path, text, .. }| format!("== {path}\n\n{text}\n")).collect()
}

/// Exports a file. The outer error states that the test case is invalid. The inner error is the refusal that a user
/// would see.
fn export(case: &Case, name: &str, compilation: &Compilation) -> Result<Result<Export, Refusal>, String> {
    // Like `lexibus export`, leave out the facts that profiles add.
    let mut options = Options { no_profiles: true, ..case.options() };
    options.select.pdos = matches!(name, "eds" | "dcf");
    let again =
        check(case.source_of(compilation.sources[0].name(), compilation.sources[0].bytes().into_owned()), &options);
    let catalog = again.catalog.ok_or("there is nothing to export")?;
    Ok(match name {
        "eds" | "dcf" => {
            let flavor = if name == "eds" { Flavor::Eds } else { Flavor::Dcf };
            let device = catalog.devices.first().ok_or("there is no device to export")?;
            let reals = if case.settings.real_hex { Reals::Pattern } else { Reals::Decimal };
            eds::export(&catalog, device, eds::Options { flavor, reals }).ok_or(Refusal::Nothing)
        }
        "esi.xml" => {
            let mut options = esi::Options::default();
            case.settings.set.iter().try_for_each(|(key, value)| options.set(key, value))?;
            esi::export(&catalog, &options)
        }
        _ => {
            let mut options = gsdml::Options::default();
            case.settings.set.iter().try_for_each(|(key, value)| options.set(key, value))?;
            gsdml::export(&catalog, &options)
        }
    })
}

/// Returns the output of `lexibus diff` for the two inputs.
fn difference(case: &Case, compilations: &[Compilation]) -> Result<String, String> {
    let [old, new] = compilations else { return Err(format!("{}: `diff` needs two inputs", case.name())) };
    let changes = compare(usable(old)?, usable(new)?);
    let lines: String = changes.iter().map(|change| format!("{change}\n")).collect();
    Ok(format!("{lines}{}\n", Summary::of(&changes)))
}

/// Imports register lists and adds their diagnostics. If the settings name the table, also adds the register tables.
fn import_lists(case: &Case, inputs: Vec<Source>, outputs: &mut Outputs) -> Result<(), String> {
    let mut diagnostics = String::new();
    for input in inputs {
        let map: Result<_, String> = case.settings.map.iter().map(|text| lexibus_import::mapping(text)).collect();
        let options = lexibus_import::Options { levels: case.levels(), map: map?, ..Default::default() };
        let made = import(input, &options);
        diagnostics += &printed(&made.compilation);
        if let Some(wanted) = &case.settings.table {
            let text = made.table.ok_or("the list cannot be imported")?;
            *outputs.entry("output.toml".to_owned()).or_default() += &parts(&text, Form::Paragraphs, wanted)?;
        }
    }
    put_diagnostics(outputs, diagnostics);
    Ok(())
}
