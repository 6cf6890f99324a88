//! Compares GSDML files with lxml's XPath: device access points, modules and submodules. The module `gsdml_data` compares the
//! data of submodules.

use lexibus_codegen::compile::check;
use lexibus_codegen::ir::{
    Catalog, CodeTable, CompactString, Device, Module, ProfinetSettings, Shape, SlotNumbers, Submodule, SubmoduleKind,
    SubmoduleUse, SubslotName, TypeDef, UnitDiagnosis, Value,
};

use super::corpus_support::round_trip::{options, source};
use super::facts::{put, put_some, Elements, Facts};
use super::gsdml_data::{body, io_data, menus, records};
use super::gsdml_reasons::{reason, rejection, Case, REASONS};
use super::peer::answers;
use super::tally::Tally;
use super::values::{numbers, put_documentation, put_names, type_name};

#[test]
fn xpath_reads_the_same_facts_from_gsdml() {
    let Some(answers) = answers("gsdml") else { return };
    let mut tally = Tally::new("GSDML", REASONS);
    for (file, answer) in &answers {
        let compilation = check(source(file), &options());
        for error in &answer.errors {
            tally.rejected(&file.name, error, rejection(&compilation));
        }
        let Some(peer) = &answer.elements else { continue };
        let elements = compilation.catalog.as_ref().map(elements).unwrap_or_default();
        let case = Case { text: file.text(), peer };
        tally.file(&file.name, peer, &elements, |difference| reason(&case, &difference));
    }
    tally.finish(112_000);
}

/// Returns the facts that Lexibus reads from a file.
fn elements(catalog: &Catalog) -> Elements {
    let mut elements = Elements::new();
    for (at, entry) in catalog.devices.iter().enumerate() {
        device(&mut elements, &format!("device {at}"), entry, catalog);
    }
    for (at, catalog) in catalog.modules.iter().enumerate() {
        module(&mut elements, &format!("module {at}"), catalog);
    }
    for (at, entry) in catalog.submodules.iter().enumerate() {
        submodule(&mut elements, &format!("submodule {at}"), entry, &catalog.types);
    }
    catalog.code_tables.iter().for_each(|table| code_table(&mut elements, table));
    for (at, entry) in catalog.unit_diagnoses.iter().enumerate() {
        unit_diagnosis(&mut elements, &format!("unit {at}"), entry, &catalog.types);
    }
    catalog.types.iter().for_each(|definition| value_list(&mut elements, definition));
    for family in &catalog.families {
        let mut facts = Facts::new();
        put_names(&mut facts, "name", &family.name, &family.names);
        elements.insert(format!("category {}", family.id), facts);
    }
    for graphic in &catalog.graphics {
        elements
            .insert(format!("graphic {}", graphic.id), Facts::from([("file".to_owned(), graphic.file.to_string())]));
    }
    elements
}

fn device(elements: &mut Elements, owner: &str, device: &Device, catalog: &Catalog) {
    let Some(settings) = device.profinet.as_deref() else { return };
    let mut facts = self::settings(settings);
    put(&mut facts, "id", device.id.as_str());
    put_names(&mut facts, "name", &device.name, &device.names);
    put_documentation(&mut facts, "info", device.documentation.as_deref());
    put(&mut facts, "order number", device.identity.order_code.as_str());
    put_some(&mut facts, "vendor number", device.identity.vendor_id);
    put_some(&mut facts, "device number", device.identity.product_code);
    put(&mut facts, "vendor", device.identity.vendor_name.as_str());
    elements.insert(owner.to_owned(), facts);
    for module in &device.modules {
        let id = &catalog.modules[module.module.0 as usize].id;
        elements.insert(format!("{owner} takes {id}"), places(&module.places));
    }
    for entry in &device.slots {
        let mut facts = Facts::new();
        put_names(&mut facts, "name", &entry.name, &entry.names);
        elements.insert(format!("{owner} slot {}", entry.number), facts);
    }
    for (at, settings) in settings.vendor_blocks.iter().enumerate() {
        let key = format!("{owner} request {at}");
        let mut facts = body(elements, &key, &settings.record, &catalog.types);
        put(&mut facts, "index", settings.identifier.to_string());
        put(&mut facts, "api", settings.api.to_string());
        elements.insert(key, facts);
    }
    held(elements, owner, &device.submodules, &settings.subslot_names);
}

/// Returns the facts that only a device access point has.
fn settings(settings: &ProfinetSettings) -> Facts {
    let mut facts = Facts::new();
    let words = |list: &[CompactString]| list.iter().map(CompactString::as_str).collect::<Vec<_>>().join(" ");
    put(&mut facts, "ident", settings.ident.to_string());
    put(&mut facts, "version", settings.pnio_version.as_str());
    put(&mut facts, "DNS name", settings.dns_name.as_str());
    put_some(&mut facts, "interval", settings.min_device_interval);
    put(&mut facts, "record size", settings.max_record_size.to_string());
    put(&mut facts, "slots", numbers(&settings.slots));
    facts.append(&mut places(&settings.places));
    put_some(&mut facts, "most input", settings.max_lengths.input);
    put_some(&mut facts, "most output", settings.max_lengths.output);
    put_some(&mut facts, "most data", settings.max_lengths.data);
    put(&mut facts, "start-up", words(&settings.startup_modes));
    put(&mut facts, "relations", settings.relations.to_string());
    put(&mut facts, "clocks", numbers(&settings.send_clocks));
    put(&mut facts, "ratios", numbers(&settings.reduction_ratios));
    put(&mut facts, "main family", settings.family.0.as_str());
    put(&mut facts, "product family", settings.family.1.as_str());
    facts
}

fn places(places: &SlotNumbers) -> Facts {
    let mut facts = Facts::new();
    put(&mut facts, "allowed", numbers(&places.allowed));
    put(&mut facts, "fixed", numbers(&places.fixed));
    put(&mut facts, "used", numbers(&places.used));
    facts
}

/// Adds the built-in and pluggable submodules of a device access point or module, and the names of its subslots.
fn held(elements: &mut Elements, owner: &str, uses: &[SubmoduleUse], subslots: &[SubslotName]) {
    for usage in uses {
        elements.insert(format!("{owner} holds {}", usage.submodule.0), places(&usage.places));
    }
    for entry in subslots {
        let mut facts = Facts::new();
        put_names(&mut facts, "name", &entry.name, &entry.names);
        elements.insert(format!("{owner} subslot {}", entry.number), facts);
    }
}

fn module(elements: &mut Elements, owner: &str, module: &Module) {
    let mut facts = Facts::new();
    put(&mut facts, "id", module.id.as_str());
    put(&mut facts, "ident", module.number.to_string());
    put(&mut facts, "subslots", numbers(&module.subslots));
    put(&mut facts, "hardware", module.revision.as_str());
    put(&mut facts, "software", module.version.as_str());
    put_names(&mut facts, "name", &module.name, &module.names);
    put_documentation(&mut facts, "info", module.documentation.as_deref());
    put(&mut facts, "order number", module.identity.order_code.as_str());
    elements.insert(owner.to_owned(), facts);
    held(elements, owner, &module.submodules, &module.subslot_names);
}

fn submodule(elements: &mut Elements, owner: &str, submodule: &Submodule, types: &[TypeDef]) {
    let mut facts = Facts::new();
    let kind = match submodule.kind {
        SubmoduleKind::Virtual => "VirtualSubmoduleItem",
        SubmoduleKind::Pluggable => "SubmoduleItem",
        SubmoduleKind::Interface => "InterfaceSubmoduleItem",
        SubmoduleKind::Port => "PortSubmoduleItem",
    };
    put(&mut facts, "id", submodule.id.as_str());
    put(&mut facts, "kind", kind);
    put(&mut facts, "ident", submodule.ident.to_string());
    put(&mut facts, "api", submodule.api.to_string());
    put(&mut facts, "provider", submodule.status_lengths.0.to_string());
    put(&mut facts, "consumer", submodule.status_lengths.1.to_string());
    put_names(&mut facts, "name", &submodule.name, &submodule.names);
    put_documentation(&mut facts, "info", submodule.documentation.as_deref());
    put(&mut facts, "order number", submodule.identity.order_code.as_str());
    elements.insert(owner.to_owned(), facts);
    for (direction, item) in [("Input", &submodule.input), ("Output", &submodule.output)] {
        if let Some(entry) = item {
            io_data(elements, &format!("{owner} {direction}"), entry, types);
        }
    }
    records(elements, owner, submodule, types);
    menus(elements, owner, &submodule.menus);
}

/// Adds the rows of a code table: channel diagnosis, process alarms or log book entries. In an extended list, the first cell of
/// each row contains the parent code.
fn code_table(elements: &mut Elements, table: &CodeTable) {
    for (at, row) in table.rows.iter().enumerate() {
        let mut facts = Facts::new();
        let (parent, rest) = match row.cells.first() {
            Some(Value::Int(parent)) => (Some(parent), &row.cells[1..]),
            _ => (None, &row.cells[..]),
        };
        put(&mut facts, "code", row.code.to_string());
        put_some(&mut facts, "last", row.last);
        put_some(&mut facts, "of", parent);
        if let [Value::Text(state), Value::Int(api), ..] = rest {
            put(&mut facts, "state", state.as_str());
            put(&mut facts, "api", api.to_string());
        }
        put_names(&mut facts, "name", &row.name, &row.names);
        put_documentation(&mut facts, "help", row.documentation.as_deref());
        elements.insert(format!("{} {at}", table.name), facts);
    }
}

fn unit_diagnosis(elements: &mut Elements, key: &str, diagnosis: &UnitDiagnosis, types: &[TypeDef]) {
    let mut facts = Facts::new();
    put(&mut facts, "api", diagnosis.api.to_string());
    put(&mut facts, "identifier", diagnosis.identifier.to_string());
    put_names(&mut facts, "name", &diagnosis.name, &diagnosis.names);
    put_documentation(&mut facts, "help", diagnosis.documentation.as_deref());
    elements.insert(key.to_owned(), facts);
    for (place, field) in diagnosis.fields.iter().enumerate() {
        let mut facts = Facts::new();
        put(&mut facts, "type", type_name(field.ty, types));
        put(&mut facts, "offset", field.bit_offset.to_string());
        put(&mut facts, "bits", field.bits.to_string());
        put_names(&mut facts, "name", &field.name, &field.names);
        elements.insert(format!("{key} field {place}"), facts);
    }
}

fn value_list(elements: &mut Elements, definition: &TypeDef) {
    let Shape::Enumeration { values, .. } = &definition.shape else { return };
    let mut facts = Facts::new();
    for value in values {
        let content = value.last.map_or(value.value.to_string(), |last| format!("{}..{last}", value.value));
        put_names(&mut facts, &content, &value.name, &value.names);
    }
    elements.insert(format!("values {}", definition.name), facts);
}
