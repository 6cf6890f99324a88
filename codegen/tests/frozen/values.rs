//! The resolved values of a catalogue as text, a line for each address. It names no field of the IR, so that the IR may change its
//! shape while the text stays the same.

use std::fmt::Write;

use lexibus_codegen::ir::{
    Binding, Catalog, Device, Direction, Group, IndirectBinding, Item, ItemVariant, Limits, Message, MessageField,
    Module, PdoEntry, PdoEntryKind, ProcessData, ProcessImage, RegisterBinding, Scale, Shape, Storage, Submodule, Type,
    TypeDef, Value, WindowSide,
};

/// A text with a line for each element.
pub fn text(catalog: &Catalog) -> String {
    let mut out = String::new();
    for device in &catalog.devices {
        self::device(&mut out, device);
    }
    for module in &catalog.modules {
        self::module(&mut out, module);
    }
    for submodule in &catalog.submodules {
        self::submodule(&mut out, submodule, &catalog.types);
    }
    out
}

fn line(out: &mut String, parts: &[String]) {
    out.push_str(&parts.join(" | "));
    out.push('\n');
}

fn device(out: &mut String, device: &Device) {
    let own = &device.identity;
    let number = |number: Option<u32>| number.map(|number| format!("{number:#X}")).unwrap_or_default();
    let identity = [own.vendor_id, own.product_code, own.revision_number].map(number).join(" ");
    line(
        out,
        &[
            "device".into(),
            device.name.to_string(),
            own.vendor_name.to_string(),
            own.product_name.to_string(),
            identity,
        ],
    );
    let mut lines: Vec<String> = Vec::new();
    groups(&mut lines, &device.groups, &device.types);
    lines.sort();
    lines.iter().for_each(|own| line(out, std::slice::from_ref(own)));
    process_data(out, &device.process_data, &device.types);
    device.messages.iter().for_each(|own| message(out, own, &device.types));
    for table in &device.code_tables {
        for row in table.rows.iter() {
            line(out, &["code".into(), table.name.to_string(), row.code.to_string(), row.name.to_string()]);
        }
    }
    for machine in &device.machines {
        for (kind, list) in [("state", &machine.states), ("command", &machine.commands)] {
            for own in list {
                line(
                    out,
                    &[
                        kind.into(),
                        machine.name.to_string(),
                        own.name.to_string(),
                        format!("{:#X}/{:#X}", own.value, own.mask),
                    ],
                );
            }
        }
        for own in &machine.transitions {
            let from = own.from.as_deref().unwrap_or("*");
            line(
                out,
                &[
                    "transition".into(),
                    machine.name.to_string(),
                    format!("{:?}", own.number),
                    from.into(),
                    own.to.to_string(),
                ],
            );
        }
    }
    for slot in &device.slots {
        line(out, &["slot".into(), slot.number.to_string(), slot.name.to_string(), format!("{:?}", slot.instances)]);
    }
}

fn module(out: &mut String, module: &Module) {
    line(out, &["module".into(), module.name.to_string(), format!("{:?}", module.identity.product_code)]);
    let mut lines = Vec::new();
    groups(&mut lines, &module.groups, &module.types);
    lines.iter().for_each(|own| line(out, std::slice::from_ref(own)));
    process_data(out, &module.process_data, &module.types);
}

fn submodule(out: &mut String, submodule: &Submodule, types: &[TypeDef]) {
    line(
        out,
        &["submodule".into(), submodule.id.to_string(), format!("{:#X}", submodule.ident), submodule.name.to_string()],
    );
    for (direction, data) in [("input", &submodule.input), ("output", &submodule.output)] {
        if let Some(data) = data {
            out.push_str(direction);
            image(out, &data.image, types);
            for own in &data.items {
                line(
                    out,
                    &[
                        "data".into(),
                        own.name.to_string(),
                        own.data_type.to_string(),
                        format!("{}+{}", own.bit_offset, own.bits),
                    ],
                );
            }
        }
    }
    let mut lines = Vec::new();
    groups(&mut lines, &submodule.records, types);
    lines.iter().for_each(|own| line(out, std::slice::from_ref(own)));
}

fn groups(lines: &mut Vec<String>, groups: &[Group], types: &[TypeDef]) {
    for group in groups {
        lines.extend(group.items.iter().map(|item| self::item(item, types)));
    }
}

/// The addresses first, so that lines in order are addresses in order.
fn item(item: &Item, types: &[TypeDef]) -> String {
    let addresses: Vec<String> = item.bindings.iter().map(address).collect();
    let mut parts =
        vec![addresses.join(", "), item.name.to_string(), ty(item.ty, types), item.access.name().to_owned()];
    let mapped = [("rpdo", item.mappable.rpdo), ("tpdo", item.mappable.tpdo)];
    parts.extend(mapped.iter().filter(|(_, is)| *is).map(|(name, _)| (*name).to_owned()));
    parts.extend(item.default.as_ref().map(|own| format!("default {}", value(own))));
    parts.extend(limits(&item.limits));
    if let Some(own) = &item.quantity {
        let scale = own.scale.as_ref().map(scale).unwrap_or_default();
        parts.push(format!("unit {} {scale}", own.unit));
    }
    parts.extend(
        item.configured.as_ref().and_then(|own| own.value.as_ref()).map(|own| format!("configured {}", value(own))),
    );
    if let Some(own) = &item.behaviour {
        parts.push(match &own.storage {
            Storage::Unknown => String::new(),
            Storage::Volatile => "volatile".to_owned(),
            Storage::Immediate => "saved at once".to_owned(),
            Storage::OnCommand(command) => format!("saved on {command}"),
        });
    }
    parts.extend(item.variants.iter().map(variant));
    parts.join(" | ")
}

fn variant(own: &ItemVariant) -> String {
    let mut parts = vec![format!("on {} {}", own.models.join(" "), own.buses.to_string().replace(',', ""))];
    parts.extend(own.ty.map(|ty| ty.to_string()));
    parts.extend(own.access.map(|access| access.name().to_owned()));
    parts.extend(own.default.as_ref().map(value));
    parts.extend(limits(&own.limits));
    parts.extend(own.scale.as_ref().map(scale));
    format!("[{}]", parts.join(", "))
}

fn scale(own: &Scale) -> String {
    let text = match own {
        Scale::Exponent { exponent, base, fraction } => {
            format!("Exponent {{ exponent: {:?}, base: {base}, fraction: {fraction} }}", exponent.name)
        }
        Scale::ByItem { item, factor } => format!("ByItem {{ item: {:?}, factor: {factor:?} }}", item.name),
        Scale::TimesItem { item, factor } => format!("TimesItem {{ item: {:?}, factor: {factor:?} }}", item.name),
        _ => format!("{own:?}"),
    };
    text.replace(|letter: char| letter.is_alphabetic() || letter == '_', "")
}

fn limits(own: &Limits) -> Option<String> {
    let bound = |own: &Option<Value>| own.as_ref().map(value).unwrap_or_default();
    let (low, high) = (bound(&own.low), bound(&own.high));
    (!low.is_empty() || !high.is_empty()).then(|| format!("{low} ... {high}"))
}

fn value(own: &Value) -> String {
    match own {
        Value::Text(text) => format!("{text:?}"),
        Value::Raw(text) => format!("raw {text:?}"),
        Value::Bytes(bytes) => format!("{bytes:02X?}"),
        other => other.to_string(),
    }
}

fn address(binding: &Binding) -> String {
    match binding {
        Binding::Object { buses, index, sub_index } => {
            let bus = match (buses.canopen, buses.coe) {
                (true, true) => "object",
                (true, false) => "canopen",
                (false, true) => "ethercat",
                (false, false) => "nowhere",
            };
            format!("{bus} {index:04X}:{sub_index:02X}")
        }
        Binding::Register(own) => register(own),
        Binding::Record { index, bit_offset, bits } => format!("record {index:05} {bit_offset:05}+{bits}"),
        Binding::Image(own) => format!("image {} {:05}+{}", own.image, own.bit_offset, own.bits),
        Binding::Parameter { space, code } => format!("parameter {space} {code:05}"),
        Binding::Ascii(name) => format!("ascii {name}"),
        Binding::EscMemory { address, length } => format!("memory {address:04X}+{length}"),
        Binding::Indirect(own) => indirect(own),
    }
}

fn indirect(own: &IndirectBinding) -> String {
    let side =
        |own: &Option<WindowSide>| own.as_ref().map(|own| format!("{} {}", own.number, own.value)).unwrap_or_default();
    format!(
        "indirect {:05} [{}; {}; {}]",
        own.number,
        own.buses.to_string().replace(',', ""),
        side(&own.read),
        side(&own.write)
    )
}

fn register(own: &RegisterBinding) -> String {
    let order = if own.low_word_first { "low" } else { "high" };
    let swapped = if own.bytes_swapped { " swapped" } else { "" };
    let bit = own.bit_offset.map(|bit| format!(" bit {bit}")).unwrap_or_default();
    let wide = if own.words_per_address > 1 { " wide" } else { "" };
    format!("{:?} {:05}+{} {order}{swapped}{bit}{wide}", own.space, own.address, own.count)
}

fn ty(own: Type, types: &[TypeDef]) -> String {
    let Type::Named(id) = own else { return own.to_string() };
    let Some(def) = types.get(id.0 as usize) else { return "missing type".to_owned() };
    let mut text = format!("{}{}", def.name, def.bits.map(|bits| format!("/{bits}")).unwrap_or_default());
    match &def.shape {
        Shape::Enumeration { values, .. } => {
            for own in values.iter() {
                let _ = write!(text, " {}={}", own.value, own.name);
            }
        }
        Shape::BitField { fields, .. } => {
            for own in fields.iter() {
                let _ = write!(text, " {}+{}={}", own.offset, own.bits, own.name);
            }
        }
        Shape::Record(fields) => {
            for own in fields.iter() {
                let _ = write!(text, " {}+{}={}:{}", own.bit_offset, own.bits, own.name, own.ty);
            }
        }
        _ => {}
    }
    text
}

fn process_data(out: &mut String, own: &ProcessData, types: &[TypeDef]) {
    for pdo in &own.pdos {
        let direction = if pdo.direction == Direction::Receive { "RPDO" } else { "TPDO" };
        let sync_manager = pdo.sync_manager.map(|number| format!("SM {number}")).unwrap_or_default();
        let cob_id = pdo.communication.as_ref().and_then(|own| own.cob_id.as_ref()).map(value).unwrap_or_default();
        line(out, &[format!("{direction} {:04X}", pdo.mapping_index), pdo.name.to_string(), sync_manager, cob_id]);
        pdo.entries.iter().for_each(|own| entry(out, own, types));
    }
    for own in &own.sync_managers {
        line(out, &["sync manager".into(), own.number.to_string()]);
    }
    own.images.iter().for_each(|own| image(out, own, types));
}

fn image(out: &mut String, own: &ProcessImage, types: &[TypeDef]) {
    let order = if own.big_endian { "big-endian" } else { "little-endian" };
    line(out, &["image".into(), own.name.to_string(), own.length.to_string(), order.into()]);
    own.fields.iter().for_each(|own| entry(out, own, types));
}

fn entry(out: &mut String, entry: &PdoEntry, types: &[TypeDef]) {
    let kind = match entry.kind {
        PdoEntryKind::Padding => "padding",
        PdoEntryKind::Unnumbered => "unnumbered",
        _ => "entry",
    };
    let place = format!("  {}+{}", entry.bit_offset, entry.bits);
    let object = format!("{:04X}:{:02X}", entry.index, entry.sub_index);
    line(out, &[place, kind.into(), object, entry.name.to_string(), ty(entry.ty, types)]);
}

fn message(out: &mut String, own: &Message, types: &[TypeDef]) {
    for (direction, list) in [("request", &own.request), ("reply", &own.reply)] {
        line(out, &[direction.into(), own.name.to_string()]);
        fields(out, list, types, "  ");
    }
}

fn fields(out: &mut String, list: &[MessageField], types: &[TypeDef], indent: &str) {
    for own in list {
        let text = match own {
            MessageField::Constant(bytes) => format!("constant {bytes:02X?}"),
            MessageField::FixedBits { bits, value } => format!("fixed {value:#X}/{bits}"),
            MessageField::Value(own) => format!("value {} {:?}", item(&own.item, types), own.byte_order),
            MessageField::Echo { field, bytes } => format!("echo {field} {bytes:?}"),
            MessageField::Copy { first, last } => format!("copy {first}..{last}"),
            MessageField::ItemCode { space, bits } => format!("code of {space} {bits}"),
            MessageField::ItemValue { space } => format!("value of {space}"),
            MessageField::ItemPadding { space } => format!("padding of {space}"),
            MessageField::Padding(bits) => format!("padding {bits}"),
            MessageField::Repeat { count, max, .. } => format!("repeat {count:?} {max:?}"),
            MessageField::Rest => "rest".to_owned(),
        };
        line(out, &[format!("{indent}{text}")]);
        if let MessageField::Repeat { fields: inner, .. } = own {
            fields(out, inner, types, &format!("{indent}  "));
        }
    }
}
