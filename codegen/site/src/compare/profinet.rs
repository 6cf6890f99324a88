//! Compares PROFINET descriptions: device access points, submodules, records and diagnosis.

use std::slice::from_ref;

use super::change::Judgment;
use super::comparison::{
    each, fact, fact_as, judged, list, optional, or_default, part, rules, slice, text, Comparison, Elements, KEY,
    POSITION,
};
use super::identity::identity;
use super::show::{index, Show};
use super::slots::{self, Use};
use super::texts::{documentation, extensions, renamed};
use super::{groups, pdos, types};
use lexibus_codegen::facts;
use lexibus_codegen::ir::{
    Catalog, FParameter, FParameters, Group, IoChannel, IoData, IoItem, IoLengths, Menu, ProfinetSettings, Submodule,
    SubmoduleKind, SubmoduleUse, SubslotName, Type, TypeId, UnitDiagnosis, UnitDiagnosisField, VendorBlock,
};
use lexibus_codegen::number::{hex16, hex32};

rules!(pub(super) fn settings(ProfinetSettings) {
    ident: fact_as("ident number", Judgment::WIRE, |ident| hex32(*ident)),
    device_id: fact_as("device ID", Judgment::WIRE, index),
    family: text("family"),
    pnio_version: text("version of PROFINET"),
    slots: fact("slots", Judgment::BEHAVIOR),
    dns_name: fact("name of a new device", Judgment::BEHAVIOR),
    min_device_interval: fact("minimum interval in 31.25 µs", Judgment::BEHAVIOR),
    max_record_size: fact("maximum length of a record", Judgment::BEHAVIOR),
    relations: fact("maximum number of application relations", Judgment::BEHAVIOR),
    startup_modes: fact("start-up modes", Judgment::BEHAVIOR),
    max_lengths: fact_as("maximum lengths", Judgment::BEHAVIOR, lengths),
    send_clocks: fact("send clock factors", Judgment::BEHAVIOR),
    reduction_ratios: fact("reduction ratios", Judgment::BEHAVIOR),
    places: fact("slots of the device access point", Judgment::BEHAVIOR),
    subslot_names: each("names of subslots", Judgment::NONE, subslot_name),
    vendor_blocks: list(
        Elements::titled(|block: &VendorBlock| format!("vendor block {}/{}", hex16(block.api), hex16(block.identifier))),
        vendor_block,
    ),
    attributes: fact("attributes", Judgment::BEHAVIOR),
});

fn lengths(lengths: &IoLengths) -> String {
    let IoLengths { input, output, data } = lengths;
    format!("input {}, output {}, both {}", input.show(), output.show(), data.show())
}

/// Formats a subslot number with its names.
pub(super) fn subslot_name(subslot: &SubslotName) -> String {
    let SubslotName { number, name, names } = subslot;
    format!("{number} {name} {}", names.show()).trim_end().to_owned()
}

rules!(fn vendor_block(VendorBlock) {
    record: |old: &Group, new: &Group, comparison: &mut Comparison<'_>| {
        comparison.in_types_of_catalog(|comparison| groups::compare(from_ref(old), from_ref(new), comparison));
    },
    menus: each("menus", Judgment::NONE, menu),
}, KEY => [api, identifier]);

fn menu(menu: &Menu) -> String {
    let Menu { id, name, names, targets } = menu;
    format!("{id} {name} ({}): {}", names.show(), targets.show())
}

/// Returns the key that pairs submodules: their ident number and identifier.
pub(super) fn submodule_key(submodule: &Submodule) -> String {
    format!("{:08X} {}", submodule.ident, submodule.id)
}

rules!(pub(super) fn submodule(Submodule) {
    kind: part("submodule", fact_as("kind", Judgment::WIRE, |kind: &SubmoduleKind| kind_name(*kind).to_owned())),
    api: part("submodule", fact_as("API", Judgment::WIRE, |api| hex16(*api))),
    name: part("submodule", judged("name", renamed)),
    names: part("submodule", text("name in other languages")),
    documentation: part("submodule", or_default(documentation)),
    identity: part("submodule", identity),
    input: optional("input", Judgment::API_AND_WIRE, Judgment::API_AND_WIRE, io_data),
    output: optional("output", Judgment::API_AND_WIRE, Judgment::API_AND_WIRE, io_data),
    status_lengths: part("submodule", fact("lengths of provider and consumer status", Judgment::WIRE)),
    records: slice(groups::compare),
    f_parameters: optional("F-parameters", Judgment::API_AND_WIRE, Judgment::API_AND_WIRE, f_parameters),
    menus: part("submodule", each("menus", Judgment::NONE, menu)),
    graphics: part("submodule", fact("pictures", Judgment::NONE)),
    attributes: part("submodule", fact("attributes", Judgment::BEHAVIOR)),
    extensions: part("submodule", extensions),
}, KEY => [id, ident], POSITION => [origin]);

fn kind_name(kind: SubmoduleKind) -> &'static str {
    match kind {
        SubmoduleKind::Virtual => "virtual",
        SubmoduleKind::Pluggable => "pluggable",
        SubmoduleKind::Interface => "interface",
        SubmoduleKind::Port => "port",
    }
}

rules!(fn io_data(IoData) {
    image: pdos::image,
    consistent: fact("consistent as a whole", Judgment::BEHAVIOR),
    items: each("data items", Judgment::NONE, io_item),
    channels: each("channels", Judgment::BEHAVIOR, channel),
});

fn io_item(item: &IoItem) -> String {
    let IoItem { name, names, data_type, bit_offset, bits, first_field, fields, subordinate } = item;
    let position = facts::address::bits_of(*bit_offset, *bits);
    let subordinate = if *subordinate { ", subordinate" } else { "" };
    let names = names.show();
    format!("{data_type} {name} {names} in {position} ({bit_offset} + {bits}), {fields} fields from {first_field}{subordinate}")
}

fn channel(channel: &IoChannel) -> String {
    let IoChannel { number, data, quality, quality_format, attributes } = channel;
    let bits = |bits: &Option<(u32, u32)>| bits.map(|(first, bits)| format!("{first} + {bits}")).unwrap_or_default();
    format!("{number}: {}, quality {} {quality_format} {}", bits(data), bits(quality), attributes.show())
        .trim_end()
        .to_owned()
}

rules!(fn f_parameters(FParameters) {
    index: fact_as("index", Judgment::WIRE, index),
    transfer_sequence: fact("order of transfer", Judgment::WIRE),
    description_crc: fact_as("checksum of the description", Judgment::WIRE, |crc: &Option<u16>| {
        crc.as_ref().map(index).unwrap_or_default()
    }),
    parameters: list(Elements::titled(|parameter: &FParameter| parameter.name.to_string())
        .judged(Judgment::API_AND_WIRE, Judgment::API_AND_WIRE), f_parameter),
}, POSITION => [origin]);

rules!(fn f_parameter(FParameter) {
    default: fact("default", Judgment::BEHAVIOR),
    label: text("name of the default"),
    allowed: each("range", Judgment::BEHAVIOR, |(first, last): &(i128, i128)| {
        facts::types::numbers(*first, Some(*last))
    }),
    allowed_labels: fact("names of the range", Judgment::NONE),
    changeable: fact("changeable", Judgment::BEHAVIOR),
    visible: fact("shown by tools", Judgment::NONE),
}, KEY => [name]);

/// Compares which submodules fit a device or module, and into which subslots each submodule fits.
pub(super) fn compare_uses(old: &[SubmoduleUse], new: &[SubmoduleUse], comparison: &mut Comparison<'_>) {
    let used = |catalog: &Catalog, one: &SubmoduleUse| {
        let submodule = catalog.submodules.get(one.submodule.0 as usize);
        let submodule = submodule.map(|submodule| (submodule.name.as_str(), submodule_key(submodule)));
        Use::new("submodule", one.submodule.0, submodule, &one.places)
    };
    slots::compare_uses(old, new, used, comparison);
}

/// Compares user-defined diagnosis structures, which are paired by API and identifier.
pub(super) fn unit_diagnoses() -> impl Fn(&Vec<UnitDiagnosis>, &Vec<UnitDiagnosis>, &mut Comparison<'_>) {
    list(
        Elements::titled(|diagnosis: &UnitDiagnosis| {
            format!("diagnosis {}/{}", hex16(diagnosis.api), hex16(diagnosis.identifier))
        }),
        diagnosis,
    )
}

rules!(fn diagnosis(UnitDiagnosis) {
    name, names, documentation,
    fields: list(Elements {
        name: |field: &UnitDiagnosisField| field.name.to_string(),
        position: |field| field.bit_offset.to_string(),
        added: Judgment::API_AND_WIRE,
        ..Elements::titled(|field| format!("field {}", field.name))
    }, diagnosis_field),
    extensions,
}, KEY => [api, identifier], POSITION => [origin]);

rules!(fn diagnosis_field(UnitDiagnosisField) {
    name, names,
    bit_offset: fact("first bit", Judgment::WIRE),
    bits: fact("length in bits", Judgment::WIRE),
    ty: types::compare,
    values: |old: &Option<TypeId>, new: &Option<TypeId>, comparison: &mut Comparison<'_>| {
        let named = |value: &Option<TypeId>| value.map(Type::Named);
        types::compare_optional("values", Judgment::API)(&named(old), &named(new), comparison);
    },
    default: fact("default", Judgment::BEHAVIOR),
});
