//! Statics that describe modules, submodules and device access points.

use super::docs;
use super::f_record::{self, FRecordModel};
use super::image::{self, ImageModel};
use super::record::{self, RecordModel};
use super::scope::{AccessPoint, Scope};
use crate::backend::rust::code::{call, seq, slice, Data, Declaration, Doc};
use crate::backend::rust::doc_table;
use crate::backend::rust::identity;
use crate::backend::rust::literal;
use crate::ir::{Direction, IoData, Module, ModuleUse, Numbers, SlotNumbers, Submodule, SubmoduleUse};
use crate::number::{hex16, hex32};
use crate::text::count_of;

/// A submodule, ready to be printed.
pub(in crate::backend::rust) struct SubmoduleModel<'a> {
    pub name: &'a str,
    pub docs: Vec<String>,
    /// The static `SUBMODULE`.
    pub constant: Declaration,
    pub images: Vec<ImageModel>,
    pub records: Vec<RecordModel>,
    pub f_record: Option<FRecordModel>,
    /// True if the type of any field or constant is an enumeration.
    pub uses_values: bool,
}

pub(super) fn submodule<'s>(scope: &'s Scope<'_>, submodule: &'s Submodule, name: &'s str) -> SubmoduleModel<'s> {
    let directions = [Direction::Transmit, Direction::Receive].into_iter();
    let images = directions.filter_map(|direction| image::model(submodule, direction, &scope.values, scope.options));
    let images: Vec<ImageModel> = images.collect();
    let records = record::models(&submodule.records, &scope.values, scope.options);
    let f_record = submodule.f_parameters.as_deref().map(f_record::model);
    let mut fields =
        images.iter().flat_map(|image| &image.fields).chain(records.iter().flat_map(|record| &record.fields));
    let mut constants = records.iter().flat_map(|record| &record.constants);
    let uses_values = fields.any(|field| field.is_enumeration) || constants.any(|constant| constant.is_enumeration);
    let values = [
        ("ident", Doc::from(hex32(submodule.ident))),
        ("api", Doc::from(hex16(submodule.api))),
        ("name", Doc::from(literal::string(&submodule.name))),
        ("input_len", length(submodule.input.as_deref())),
        ("output_len", length(submodule.output.as_deref())),
        ("provider_len", seq![submodule.status_lengths.0]),
        ("consumer_len", seq![submodule.status_lengths.1]),
        ("records", slice(record_list(&records, f_record.as_ref()))),
    ];
    let about = "Description of the submodule. Modules and slot plans use this constant.";
    SubmoduleModel {
        name,
        docs: submodule_docs(submodule, name, &images, &records, f_record.is_some()),
        constant: constant([about], "SUBMODULE", "rt::profinet::Submodule", values),
        images,
        records,
        f_record,
        uses_values,
    }
}

fn submodule_docs(
    submodule: &Submodule,
    module: &str,
    images: &[ImageModel],
    records: &[RecordModel],
    is_safe: bool,
) -> Vec<String> {
    let api = if submodule.api == 0 { String::new() } else { format!(" of API {}", hex16(submodule.api)) };
    let title = docs::titled(&submodule.name, &format!("submodule {}{api}", hex32(submodule.ident)));
    let mut lines = docs::documented(title, &submodule.name, submodule.documentation.as_deref());
    let too_long = submodule.records.iter().filter(|group| match &group.kind {
        crate::ir::GroupKind::Record(record) => !(1..=crate::limits::MAX_RECORD_BYTES).contains(&record.length),
        _ => false,
    });
    let too_long = too_long.count();
    if too_long > 0 {
        let text = format!("{too_long} records are left out because their length is 0 or exceeds 65,535 bytes.");
        lines.extend([String::new(), text]);
    }
    let images = images.iter().map(|image| (image.name, image.length));
    let records = records.iter().map(|record| (record.name.as_str(), record.length));
    let safe = is_safe.then_some(("F_PARAMETERS", 0));
    let row = |(name, length): (&str, u32)| {
        let length = if length == 0 { String::new() } else { count_of(length, "byte") };
        [format!("[`{name}`]({}::{name})", module.trim_start_matches("r#")), length]
    };
    let rows: Vec<[String; 2]> = images.chain(records).chain(safe).map(row).collect();
    lines.extend(doc_table::table(["Part", "Length"], &rows));
    lines
}

/// Returns the expression for the length of the cyclic data, including an F-message trailer. The expression is `None`
/// if there are no data.
fn length(data: Option<&IoData>) -> Doc {
    let length = |data: &IoData| u64::from(data.image.length) + u64::from(data.image.overhead);
    Data::option(data.map(|data| length(data).min(u16::MAX.into())))
}

/// Returns the records sorted by transfer sequence. Records with sequence 0 have no fixed order and come last.
fn record_list(records: &[RecordModel], f_record: Option<&FRecordModel>) -> Vec<Doc> {
    let element = |index: u16, sequence: u16, title: &str, data: &str| {
        let index = hex16(index);
        let call = call!("rt::profinet::Record::new", index, sequence, title, seq!["&", data]);
        (if sequence == 0 { u16::MAX } else { sequence }, call)
    };
    let parameters = records.iter().map(|record| {
        let data = format!("{}::DEFAULT_BYTES", record.name);
        element(record.index, record.transfer_sequence, &record.title, &data)
    });
    let safe = f_record
        .map(|record| element(record.index, record.transfer_sequence, "\"F-parameters\"", "F_PARAMETERS_DEFAULT"));
    let mut list: Vec<(u16, Doc)> = safe.into_iter().chain(parameters).collect();
    list.sort_by_key(|(sequence, _)| *sequence);
    list.into_iter().map(|(_, call)| call).collect()
}

/// A module, ready to be printed.
pub(in crate::backend::rust) struct ModuleModel<'a> {
    pub name: &'a str,
    pub docs: Vec<String>,
    /// The static `MODULE`.
    pub constant: Declaration,
}

pub(super) fn module<'s>(scope: &'s Scope<'_>, module: &'s Module, name: &'s str) -> ModuleModel<'s> {
    let title = docs::titled(&module.name, &format!("module {}", hex32(module.number)));
    let mut docs = docs::documented(title, &module.name, module.documentation.as_deref());
    list_submodules(scope, &module.submodules, &mut docs);
    let values = [
        ("ident", Doc::from(hex32(module.number))),
        ("name", Doc::from(literal::string(&module.name))),
        ("submodules", slice(submodule_uses(scope, &module.submodules, "super::super::"))),
        ("subslots", slice(numbers(&module.subslots))),
    ];
    let about = "Description of the module. A slot plan uses this constant.";
    ModuleModel { name, docs, constant: constant([about], "MODULE", "rt::profinet::Module", values) }
}

/// Returns a static with a struct of this type.
fn constant<const N: usize>(
    docs: impl IntoIterator<Item: Into<String>>,
    name: &str,
    ty: &str,
    values: [(&str, Doc); N],
) -> Declaration {
    Declaration::new(docs, seq!["static ", name, ": ", ty], Data::fields(ty, values))
}

/// Returns the slot of a device access point: its first fixed slot, otherwise its first allowed slot, otherwise 0.
pub(super) fn slot(point: &AccessPoint<'_>) -> u16 {
    let fixed = point.settings.places.fixed.iter().next();
    fixed.or_else(|| point.settings.places.allowed.iter().next()).unwrap_or(0)
}

/// A device access point, ready to be printed.
pub(in crate::backend::rust) struct DapModel<'a> {
    pub name: &'a str,
    /// Heading of the device access point in generated comments.
    pub heading: String,
    /// The static `DAP` and the constant `IDENTITY`.
    pub constants: [Declaration; 2],
}

pub(super) fn access_point<'s>(scope: &'s Scope<'_>, point: &'s AccessPoint<'_>) -> DapModel<'s> {
    let AccessPoint { device, settings, name } = point;
    let outer = if scope.is_single() { "" } else { "super::" };
    let heading = docs::titled(&device.name, &format!("device access point {}", hex32(settings.ident)));
    let module = [
        ("ident", Doc::from(hex32(settings.ident))),
        ("name", Doc::from(literal::string(&device.name))),
        ("submodules", slice(submodule_uses(scope, &device.submodules, outer))),
        ("subslots", Doc::from("&[]")),
    ];
    let lengths = settings.max_lengths;
    let lengths = [("input", lengths.input), ("output", lengths.output), ("data", lengths.data)];
    let lengths = lengths.map(|(name, length)| (name, Data::option(length)));
    let vendor_id = hex16(device.identity.vendor_id.map_or(0, |id| id & 0xFFFF));
    let device_id = hex16(settings.device_id);
    let names = [&device.identity.vendor_name, &device.name, &device.identity.order_code].map(|name| name.as_str());
    let about = "Identity of the device. The product code is the PROFINET device ID.".to_owned();
    let identity = identity::with(about, [Some(vendor_id.clone()), Some(device_id.clone()), None], names);
    let values = [
        ("vendor_id", Doc::from(vendor_id)),
        ("device_id", Doc::from(device_id)),
        ("slot", seq![slot(point)]),
        ("module", Data::fields("rt::profinet::Module", module)),
        ("slots", slice(numbers(&settings.slots))),
        ("modules", slice(module_uses(scope, &device.modules, outer))),
        ("max_lengths", Data::fields("rt::profinet::IoLengths", lengths)),
        ("max_record_size", seq![settings.max_record_size]),
    ];
    let docs = docs::documented(heading.clone(), &device.name, device.documentation.as_deref());
    DapModel { name, heading, constants: [constant(docs, "DAP", "rt::profinet::Dap", values), identity] }
}

fn list_submodules(scope: &Scope<'_>, uses: &[SubmoduleUse], docs: &mut Vec<String>) {
    let mut named = uses.iter().filter_map(|usage| Some((usage, scope.submodules.get(&usage.submodule.0)?))).peekable();
    if named.peek().is_none() {
        return;
    }
    docs.push(String::new());
    for (usage, (_, name)) in named {
        let built_in = if usage.places.fixed.is_empty() { "can be plugged in" } else { "built in" };
        let name = name.trim_start_matches("r#");
        docs.push(format!("- [`{name}`](super::submodules::{name}), {built_in}"));
    }
}

fn submodule_uses(scope: &Scope<'_>, uses: &[SubmoduleUse], outer: &str) -> Vec<Doc> {
    let element = |usage: &SubmoduleUse| {
        let (_, name) = scope.submodules.get(&usage.submodule.0)?;
        let subslots = places(&usage.places);
        let path = format!("&{outer}submodules::{name}::SUBMODULE");
        Some(call!("rt::profinet::SubmoduleUse::new", path, subslots))
    };
    uses.iter().filter_map(element).collect()
}

fn module_uses(scope: &Scope<'_>, uses: &[ModuleUse], outer: &str) -> Vec<Doc> {
    let element = |usage: &ModuleUse| {
        let (_, name) = scope.modules.get(&usage.module.0)?;
        let slots = places(&usage.places);
        let path = format!("&{outer}modules::{name}::MODULE");
        Some(call!("rt::profinet::ModuleUse::new", path, slots))
    };
    uses.iter().filter_map(element).collect()
}

fn places(places: &SlotNumbers) -> Doc {
    let SlotNumbers { allowed, fixed, used } = places;
    match (allowed.is_empty(), fixed.is_empty(), used.is_empty()) {
        (true, false, true) => call!("rt::profinet::Places::fixed", slice(numbers(fixed))),
        (false, true, true) => call!("rt::profinet::Places::allowed", slice(numbers(allowed))),
        _ => {
            let [allowed, fixed, used] = [allowed, fixed, used].map(|list| slice(numbers(list)));
            call!("rt::profinet::Places::new", allowed, fixed, used)
        }
    }
}

fn numbers(numbers: &Numbers) -> Vec<String> {
    // By convention, subslots of interfaces and ports are hexadecimal.
    let number = |number: u16| if number < 0x8000 { number.to_string() } else { hex16(number) };
    let range = |&(first, last): &(u16, u16)| format!("({}, {})", number(first), number(last));
    numbers.0.iter().map(range).collect()
}
