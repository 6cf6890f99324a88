//! Writes the resolved values of a catalog as text with one line per element. The text contains no field names of the IR, so it
//! does not change if the structure of the IR changes.

use std::fmt::Write;

use lexibus_codegen::ir::{
    Binding, Catalog, Device, Direction, Group, IndirectBinding, Item, ItemVariant, Limits, Message, MessageField,
    Module, PdoEntry, PdoEntryKind, ProcessData, ProcessImage, RegisterBinding, Scale, Shape, Storage, Submodule, Type,
    TypeDef, Value, WindowSide,
};

/// Returns the values of a catalog as text with one line per element.
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
    let actual = &device.identity;
    let number = |number: Option<u32>| number.map(|number| format!("{number:#X}")).unwrap_or_default();
    let identity = [actual.vendor_id, actual.product_code, actual.revision_number].map(number).join(" ");
    line(
        out,
        &[
            "device".into(),
            device.name.to_string(),
            actual.vendor_name.to_string(),
            actual.product_name.to_string(),
            identity,
        ],
    );
    let mut lines: Vec<String> = Vec::new();
    groups(&mut lines, &device.groups, &device.types);
    lines.sort();
    lines.iter().for_each(|entry| line(out, std::slice::from_ref(entry)));
    process_data(out, &device.process_data, &device.types);
    device.messages.iter().for_each(|entry| message(out, entry, &device.types));
    for table in &device.code_tables {
        for row in table.rows.iter() {
            line(out, &["code".into(), table.name.to_string(), row.code.to_string(), row.name.to_string()]);
        }
    }
    for machine in &device.machines {
        for (kind, list) in [("state", &machine.states), ("command", &machine.commands)] {
            for entry in list {
                line(
                    out,
                    &[
                        kind.into(),
                        machine.name.to_string(),
                        entry.name.to_string(),
                        format!("{:#X}/{:#X}", entry.value, entry.mask),
                    ],
                );
            }
        }
        for fault in &machine.faults {
            line(out, &["fault".into(), machine.name.to_string(), fault.to_string()]);
        }
        for transition in &machine.transitions {
            let from = transition.from.as_ref().map_or("*", |from| from.as_str());
            line(
                out,
                &[
                    "transition".into(),
                    machine.name.to_string(),
                    format!("{:?}", transition.number),
                    from.into(),
                    transition.to.to_string(),
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
    lines.iter().for_each(|entry| line(out, std::slice::from_ref(entry)));
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
            for item in &data.items {
                line(
                    out,
                    &[
                        "data".into(),
                        item.name.to_string(),
                        item.data_type.to_string(),
                        format!("{}+{}", item.bit_offset, item.bits),
                    ],
                );
            }
        }
    }
    let mut lines = Vec::new();
    groups(&mut lines, &submodule.records, types);
    lines.iter().for_each(|entry| line(out, std::slice::from_ref(entry)));
}

fn groups(lines: &mut Vec<String>, groups: &[Group], types: &[TypeDef]) {
    for group in groups {
        lines.extend(group.items.iter().map(|item| self::item(item, types)));
    }
}

/// Returns the line of an item. Addresses come first, so that sorted lines are sorted by address.
fn item(item: &Item, types: &[TypeDef]) -> String {
    let addresses: Vec<String> = item.bindings.iter().map(address).collect();
    let mut parts =
        vec![addresses.join(", "), item.name.to_string(), ty(item.ty, types), item.access.name().to_owned()];
    let mapped = [("rpdo", item.mappable.rpdo), ("tpdo", item.mappable.tpdo)];
    parts.extend(mapped.iter().filter(|(_, is)| *is).map(|(name, _)| (*name).to_owned()));
    parts.extend(item.default.as_ref().map(|default_value| format!("default {}", value(default_value))));
    parts.extend(limits(&item.limits));
    if let Some(quantity) = &item.quantity {
        let scale = quantity.scale.as_ref().map(scale).unwrap_or_default();
        parts.push(format!("unit {} {scale}", quantity.unit));
    }
    parts.extend(
        item.configured
            .as_ref()
            .and_then(|configured| configured.value.as_ref())
            .map(|entry| format!("configured {}", value(entry))),
    );
    if let Some(behavior) = &item.behavior {
        parts.push(match &behavior.storage {
            Storage::Unknown => String::new(),
            Storage::Volatile => "volatile".to_owned(),
            Storage::Immediate => "saved at once".to_owned(),
            Storage::OnCommand(command) => format!("saved on {command}"),
        });
    }
    parts.extend(item.variants.iter().map(variant));
    parts.join(" | ")
}

fn variant(variant: &ItemVariant) -> String {
    let mut parts = vec![format!("on {} {}", variant.models.join(" "), variant.buses.to_string().replace(',', ""))];
    parts.extend(variant.ty.map(|ty| ty.to_string()));
    parts.extend(variant.access.map(|access| access.name().to_owned()));
    parts.extend(variant.default.as_ref().map(value));
    parts.extend(limits(&variant.limits));
    parts.extend(variant.scale.as_ref().map(scale));
    format!("[{}]", parts.join(", "))
}

fn scale(scale: &Scale) -> String {
    let text = match scale {
        Scale::Exponent { exponent, base, fraction } => {
            format!("Exponent {{ exponent: {:?}, base: {base}, fraction: {fraction} }}", exponent.name)
        }
        Scale::ByItem { item, factor } => format!("ByItem {{ item: {:?}, factor: {factor:?} }}", item.name),
        Scale::TimesItem { item, factor } => format!("TimesItem {{ item: {:?}, factor: {factor:?} }}", item.name),
        _ => format!("{scale:?}"),
    };
    text.replace(|letter: char| letter.is_alphabetic() || letter == '_', "")
}

fn limits(limits: &Limits) -> Option<String> {
    let bound = |entry: &Option<Value>| entry.as_ref().map(value).unwrap_or_default();
    let (low, high) = (bound(&limits.low), bound(&limits.high));
    (!low.is_empty() || !high.is_empty()).then(|| format!("{low} ... {high}"))
}

fn value(value: &Value) -> String {
    match value {
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
        Binding::Register(entry) => register(entry),
        Binding::Record { index, bit_offset, bits } => format!("record {index:05} {bit_offset:05}+{bits}"),
        Binding::Image(image) => format!("image {} {:05}+{}", image.image, image.bit_offset, image.bits),
        Binding::Parameter(parameter) => format!("parameter {} {:05}", parameter.space, parameter.code),
        Binding::Ascii(name) => format!("ascii {name}"),
        Binding::EscMemory { address, length } => format!("memory {address:04X}+{length}"),
        Binding::Indirect(window) => indirect(window),
    }
}

fn indirect(binding: &IndirectBinding) -> String {
    let side = |item: &Option<WindowSide>| {
        item.as_ref().map(|entry| format!("{} {}", entry.number, entry.value)).unwrap_or_default()
    };
    format!(
        "indirect {:05} [{}; {}; {}]",
        binding.number,
        binding.buses.to_string().replace(',', ""),
        side(&binding.read),
        side(&binding.write)
    )
}

fn register(register: &RegisterBinding) -> String {
    let order = if register.low_word_first { "low" } else { "high" };
    let swapped = if register.bytes_swapped { " swapped" } else { "" };
    let bit = register.bit_offset.map(|bit| format!(" bit {bit}")).unwrap_or_default();
    let wide = if register.words_per_address > 1 { " wide" } else { "" };
    format!("{:?} {:05}+{} {order}{swapped}{bit}{wide}", register.space, register.address, register.count)
}

fn ty(ty: Type, types: &[TypeDef]) -> String {
    let Type::Named(id) = ty else { return ty.to_string() };
    let Some(def) = types.get(id.0 as usize) else { return "missing type".to_owned() };
    let mut text = format!("{}{}", def.name, def.bits.map(|bits| format!("/{bits}")).unwrap_or_default());
    match &def.shape {
        Shape::Enumeration { values, .. } => {
            for ty in values.iter() {
                let _ = write!(text, " {}={}", ty.value, ty.name);
            }
        }
        Shape::BitField { fields, .. } => {
            for ty in fields.iter() {
                let _ = write!(text, " {}+{}={}", ty.offset, ty.bits, ty.name);
            }
        }
        Shape::Record(fields) => {
            for ty in fields.iter() {
                let _ = write!(text, " {}+{}={}:{}", ty.bit_offset, ty.bits, ty.name, ty.ty);
            }
        }
        _ => {}
    }
    text
}

fn process_data(out: &mut String, data: &ProcessData, types: &[TypeDef]) {
    for pdo in &data.pdos {
        let direction = if pdo.direction == Direction::Receive { "RPDO" } else { "TPDO" };
        let sync_manager = pdo.sync_manager.map(|number| format!("SM {number}")).unwrap_or_default();
        let cob_id = pdo
            .communication
            .as_ref()
            .and_then(|communication| communication.cob_id.as_ref())
            .map(value)
            .unwrap_or_default();
        line(out, &[format!("{direction} {:04X}", pdo.mapping_index), pdo.name.to_string(), sync_manager, cob_id]);
        pdo.entries.iter().for_each(|item| entry(out, item, types));
    }
    for manager in &data.sync_managers {
        line(out, &["sync manager".into(), manager.number.to_string()]);
    }
    data.images.iter().for_each(|entry| image(out, entry, types));
}

fn image(out: &mut String, image: &ProcessImage, types: &[TypeDef]) {
    let order = if image.big_endian { "big-endian" } else { "little-endian" };
    line(out, &["image".into(), image.name.to_string(), image.length.to_string(), order.into()]);
    image.fields.iter().for_each(|field| entry(out, field, types));
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

fn message(out: &mut String, message: &Message, types: &[TypeDef]) {
    for (direction, list) in [("request", &message.request), ("reply", &message.reply)] {
        line(out, &[direction.into(), message.name.to_string()]);
        fields(out, list, types, "  ");
    }
}

fn fields(out: &mut String, list: &[MessageField], types: &[TypeDef], indent: &str) {
    for entry in list {
        let text = match entry {
            MessageField::Constant(bytes) => format!("constant {bytes:02X?}"),
            MessageField::FixedBits { bits, value } => format!("fixed {value:#X}/{bits}"),
            MessageField::Value(field) => format!("value {} {:?}", item(&field.item, types), field.byte_order),
            MessageField::Echo { field, bytes } => format!("echo {field} {bytes:?}"),
            MessageField::Copy { first, last } => format!("copy {first}..{last}"),
            MessageField::ItemCode { space, bits } => format!("code of {space} {bits}"),
            MessageField::ItemValue { space } => format!("value of {space}"),
            MessageField::ItemPadding { space } => format!("padding of {space}"),
            MessageField::Padding(bits) => format!("padding {bits}"),
            MessageField::Repeat { count, max, .. } => format!("repeat {:?} {max:?}", count.as_deref()),
            MessageField::Rest => "rest".to_owned(),
        };
        line(out, &[format!("{indent}{text}")]);
        if let MessageField::Repeat { fields: inner, .. } = entry {
            fields(out, inner, types, &format!("{indent}  "));
        }
    }
}
