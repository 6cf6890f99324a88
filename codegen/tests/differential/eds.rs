//! Compares EDS and DCF files with Python's `canopen`: objects, values and device facts.

use lexibus_codegen::compile::check;
use lexibus_codegen::ir::{Access, Device, Extension, Group, Item, ObjectCode, Type, Value};

use super::corpus_support::round_trip::{options, source};
use super::eds_reasons::{reason, rejection, Case, REASONS};
use super::facts::{put, put_flag, put_some, real, Elements, Facts};
use super::peer::answers;
use super::tally::Tally;

/// Node-ID for files that do not contain one. The script uses the same node-ID.
const NODE_ID: u8 = 5;

#[test]
fn canopen_reads_the_same_facts() {
    let Some(answers) = answers("eds") else { return };
    let mut tally = Tally::new("EDS", REASONS);
    for (file, answer) in &answers {
        let compilation = check(source(file), &options());
        for error in &answer.errors {
            tally.rejected(&file.name, error, rejection(file, error));
        }
        let Some(peer) = &answer.elements else { continue };
        let device = compilation.catalog.as_ref().map(|catalog| &catalog.devices[0]);
        let elements = device.map(elements).unwrap_or_default();
        let case = Case::new(file, peer, &elements, NODE_ID);
        tally.file(&file.name, peer, &elements, |difference| reason(&case, &difference));
    }
    tally.finish(396_000);
}

/// Returns the facts that Lexibus reads from a device.
fn elements(device: &Device) -> Elements {
    let mut elements = Elements::from([("device".to_owned(), header(device))]);
    let node_id = device.commissioning.as_ref().and_then(|commissioning| commissioning.node_id).unwrap_or(NODE_ID);
    for group in &device.groups {
        let Some(index) = group.index() else { continue };
        elements.insert(format!("{index:04X}"), object(group));
        for item in &group.items {
            let Some((_, sub)) = item.object() else { continue };
            let is_whole = kind(group) == "value";
            let extensions = if is_whole { &group.extensions } else { &item.extensions };
            elements.insert(format!("{index:04X}:{sub:02X}"), self::item(item, extensions, node_id));
        }
    }
    elements
}

fn header(device: &Device) -> Facts {
    let mut facts = Facts::new();
    let identity = &device.identity;
    put(&mut facts, "vendor name", identity.vendor_name.as_str());
    put_some(&mut facts, "vendor number", identity.vendor_id);
    put(&mut facts, "product name", identity.product_name.as_str());
    put_some(&mut facts, "product number", identity.product_code);
    put_some(&mut facts, "revision number", identity.revision_number);
    put(&mut facts, "order code", identity.order_code.as_str());
    file_info(&mut facts, device);
    if let Some(commissioning) = &device.commissioning {
        put_some(&mut facts, "node-ID", commissioning.node_id);
        put_some(&mut facts, "bit rate", commissioning.bit_rate.filter(|&rate| rate != 0));
    }
    let Some(canopen) = &device.canopen else { return facts };
    put_flag(&mut facts, "boot-up master", canopen.boot_up_master);
    put_flag(&mut facts, "boot-up slave", canopen.boot_up_slave);
    put_some(&mut facts, "granularity", canopen.granularity);
    put_flag(&mut facts, "dynamic channels", canopen.dynamic_channels_supported != 0);
    put_flag(&mut facts, "group messaging", canopen.group_messaging);
    put_some(&mut facts, "RPDOs", canopen.rx_pdos);
    put_some(&mut facts, "TPDOs", canopen.tx_pdos);
    put_flag(&mut facts, "LSS", canopen.lss);
    let words = |numbers: Vec<String>| numbers.join(" ");
    put(&mut facts, "bit rates", words(canopen.bit_rates.iter().map(ToString::to_string).collect()));
    // The library `canopen` reads dummy usage only for the types 1 to 7.
    let dummies = canopen.dummies.iter().filter(|code| (1..8).contains(*code));
    put(&mut facts, "dummies", words(dummies.map(ToString::to_string).collect()));
    facts
}

/// Adds the facts from the file header.
fn file_info(facts: &mut Facts, device: &Device) {
    let header = &device.header;
    put(facts, "FileName", header.file_name.as_str());
    put(facts, "FileVersion", header.file_version.as_str());
    put(facts, "FileRevision", header.file_revision.as_str());
    put(facts, "EDSVersion", header.format_version.as_str());
    put(facts, "Description", header.description.as_str());
    put(facts, "CreationTime", header.creation_time.as_str());
    put(facts, "CreationDate", header.creation_date.as_str());
    put(facts, "CreatedBy", header.created_by.as_str());
    put(facts, "ModificationTime", header.modification_time.as_str());
    put(facts, "ModificationDate", header.modification_date.as_str());
    put(facts, "ModifiedBy", header.modified_by.as_str());
    put(facts, "LastEDS", header.last_eds.as_str());
    put(facts, "comments", header.comments.join("\n").trim_end());
}

/// Returns the object type in the notation of the script: `value` for VAR and DOMAIN, `array`, `record`, the name of another object
/// type, or `no object`.
fn kind(group: &Group) -> &'static str {
    match group.object_code() {
        Some(ObjectCode::Var | ObjectCode::Domain) => "value",
        Some(ObjectCode::Array) => "array",
        Some(ObjectCode::Record) => "record",
        Some(other) => other.name(),
        None => "no object",
    }
}

fn object(group: &Group) -> Facts {
    let mut facts = Facts::new();
    let kind = kind(group);
    put(&mut facts, "kind", kind);
    put(&mut facts, "name", group.name.as_str());
    if kind != "value" {
        put_some(&mut facts, "storage", extension(&group.extensions, "StorageLocation"));
    }
    facts
}

fn item(item: &Item, extensions: &[Extension], node_id: u8) -> Facts {
    let mut facts = Facts::new();
    let value = |value: Option<&Value>| value.and_then(|entry| self::value(entry, item.ty, node_id));
    put(&mut facts, "name", item.name.as_str());
    put(&mut facts, "type", code(item.ty));
    put(&mut facts, "access", Access::name(item.access));
    put_flag(&mut facts, "mappable", item.mappable.any());
    put_some(&mut facts, "default", value(item.default.as_ref()));
    put_flag(&mut facts, "relative", matches!(item.default, Some(Value::NodeId(_))));
    put_some(&mut facts, "value", value(item.configured.as_ref().and_then(|configured| configured.value.as_ref())));
    put_some(&mut facts, "low", value(item.limits.low.as_ref()));
    put_some(&mut facts, "high", value(item.limits.high.as_ref()));
    put_some(&mut facts, "unit", extension(extensions, "Unit"));
    put_some(&mut facts, "description", extension(extensions, "Description"));
    put_some(&mut facts, "storage", extension(extensions, "StorageLocation"));
    let factor = extension(extensions, "Factor").and_then(|text| text.parse::<f64>().ok());
    put_some(&mut facts, "factor", factor.filter(|&factor| factor != 1.0).map(real));
    facts
}

fn extension<'e>(extensions: &'e [Extension], key: &str) -> Option<&'e str> {
    extensions.iter().rev().find(|extension| extension.key == key).map(|extension| extension.value.as_str())
}

/// Returns the CiA 301 number of a type. This function repeats the numbers, because the code that reads DataType is under
/// test.
fn code(ty: Type) -> String {
    let code = match ty {
        Type::Boolean => 0x01,
        Type::Integer(8) => 0x02,
        Type::Integer(16) => 0x03,
        Type::Integer(32) => 0x04,
        Type::Unsigned(8) => 0x05,
        Type::Unsigned(16) => 0x06,
        Type::Unsigned(32) => 0x07,
        Type::Real32 => 0x08,
        Type::VisibleString(None) => 0x09,
        Type::OctetString(None) => 0x0A,
        Type::UnicodeString(None) => 0x0B,
        Type::TimeOfDay => 0x0C,
        Type::TimeDifference => 0x0D,
        Type::Domain => 0x0F,
        Type::Integer(24) => 0x10,
        Type::Real64 => 0x11,
        Type::Integer(40) => 0x12,
        Type::Integer(48) => 0x13,
        Type::Integer(56) => 0x14,
        Type::Integer(64) => 0x15,
        Type::Unsigned(24) => 0x16,
        Type::Unsigned(40) => 0x18,
        Type::Unsigned(48) => 0x19,
        Type::Unsigned(56) => 0x1A,
        Type::Unsigned(64) => 0x1B,
        Type::Opaque(Some(code)) => code,
        other => return format!("{other:?}"),
    };
    code.to_string()
}

/// Returns a value in the notation of the script.
fn value(value: &Value, ty: Type, node_id: u8) -> Option<String> {
    Some(match value.resolved(node_id) {
        Value::Bool(value) => i32::from(value).to_string(),
        Value::Int(value) if matches!(ty, Type::Real32 | Type::Real64) => real(value as f64),
        Value::Int(value) => value.to_string(),
        Value::Real(value) => real(value),
        Value::Text(text) if text.is_empty() => return None,
        Value::Text(text) => format!("'{text}'"),
        Value::Bytes(bytes) => format!("x'{}'", bytes.iter().map(|byte| format!("{byte:02x}")).collect::<String>()),
        Value::Time { milliseconds, days } => (u64::from(days) << 32 | u64::from(milliseconds)).to_string(),
        Value::NodeId(_) => unreachable!("resolved values are not formulas"),
        Value::Raw(text) => format!("raw {text}"),
    })
}
