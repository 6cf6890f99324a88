//! Random PROFINET descriptions: device access points, modules, submodules, records and diagnosis.

use lexibus_codegen::ir::{
    Access, Binding, Catalog, CompactString, Device, Direction, FParameter, FParameters, FactOrigin, Family, Graphic,
    Group, GroupKind, Identity, IdentityNumber, IoChannel, IoData, IoItem, IoLengths, Item, LocalText, Menu, Module,
    ModuleId, ModuleUse, Numbers, ObjectCode, ProfileHeader, ProfinetSettings, Record, Rule, SlotNumbers, Submodule,
    SubmoduleId, SubmoduleKind, SubmoduleUse, SubslotName, Type, TypeDef, TypeId, UnitDiagnosis, UnitDiagnosisField,
    UnusedText, VendorBlock,
};
use lexibus_codegen::source::Origin;

use super::bytes::Bytes;
use super::items::{item, Around};
use super::machines;
use super::names;
use super::process;
use super::types;
use super::values;

/// Returns the devices of a GSDML file, with their modules and submodules.
pub fn catalog(b: &mut Bytes<'_>) -> Catalog {
    let types = types::definitions(b, 8);
    let submodules = b.list(5, |b| submodule(b, &types));
    let modules = b.list(3, |b| module(b, submodules.len()));
    let points = b.within(1..=2);
    Catalog {
        devices: (0..points).map(|_| access_point(b, &types, modules.len(), submodules.len())).collect(),
        modules,
        submodules,
        code_tables: b.list(2, machines::code_table),
        unit_diagnoses: b.list(2, |b| unit_diagnosis(b, &types)),
        vendor_names: names::texts(b),
        descriptions: names::texts(b),
        types,
        families: b.few(2, 2, |b| Family {
            id: names::name(b),
            name: names::name(b),
            names: names::texts(b),
            descriptions: b.list(2, |b| LocalText { language: names::name(b), text: names::text(b) }),
            origin: Origin::default(),
        }),
        graphics: b.few(4, 2, |b| Graphic { id: names::name(b), file: names::path(b) }),
        vendor_urls: Vec::new(),
        format_version: names::version(b),
        profile_header: b.maybe(2, |b| Box::new(profile_header(b))),
        unused_texts: b.few(3, 2, |b| UnusedText {
            id: names::name(b),
            text: names::text(b),
            translations: names::texts(b),
        }),
        extensions: names::extensions(b),
        // `arbitrary_ir` adds the files.
        files: Vec::new(),
    }
}

fn profile_header(b: &mut Bytes<'_>) -> ProfileHeader {
    ProfileHeader {
        identification: names::text(b),
        revision: names::version(b),
        name: names::text(b),
        source: names::text(b),
        class: names::text(b),
        date: names::text(b),
        additional_information: names::text(b),
        iso_part: names::version(b),
        iso_edition: names::version(b),
        technology: names::text(b),
    }
}

fn access_point(b: &mut Bytes<'_>, types: &[TypeDef], modules: usize, submodules: usize) -> Device {
    let settings = ProfinetSettings {
        ident: b.any(),
        device_id: b.any(),
        family: (names::name(b), names::name(b)),
        pnio_version: names::version(b),
        slots: numbers(b),
        dns_name: names::name(b),
        min_device_interval: b.any(),
        max_record_size: b.any(),
        relations: b.any(),
        startup_modes: b.list(2, names::name),
        max_lengths: IoLengths { input: b.any(), output: b.any(), data: b.any() },
        send_clocks: numbers(b),
        reduction_ratios: numbers(b),
        places: places(b),
        subslot_names: b.list(2, subslot_name),
        vendor_blocks: b.few(4, 2, |b| VendorBlock {
            api: b.any(),
            identifier: b.any(),
            record: record(b, types),
            menus: b.few(4, 1, menu),
        }),
        attributes: names::attributes(b),
    };
    let positions = 0..modules as u32;
    let modules = positions.map(|at| ModuleUse { module: ModuleId(at), places: places(b) }).collect();
    Device {
        name: names::name(b),
        names: names::texts(b),
        id: names::name(b),
        identity: identity(b),
        profinet: Some(Box::new(settings)),
        modules,
        submodules: uses(b, submodules),
        documentation: names::documentation(b),
        extensions: names::extensions(b),
        ..Device::default()
    }
}

pub fn identity(b: &mut Bytes<'_>) -> Identity {
    Identity {
        vendor_id: b.any(),
        vendor_name: names::name(b),
        product_code: b.any(),
        product_name: names::text(b),
        revision_number: b.any(),
        order_code: names::name(b),
        serial_number: b.maybe(6, Bytes::any),
        others: b.few(6, 1, |b| (names::name(b), b.any())),
        origins: b.few(6, 1, |b| (b.pick(&IdentityNumber::ALL), FactOrigin::Rule(Rule::IdentityObject))),
    }
}

fn module(b: &mut Bytes<'_>, submodules: usize) -> Module {
    Module {
        number: b.within(0..=3),
        id: names::name(b),
        name: names::name(b),
        names: names::texts(b),
        identity: identity(b),
        submodules: uses(b, submodules),
        subslots: numbers(b),
        subslot_names: b.list(2, subslot_name),
        documentation: names::documentation(b),
        attributes: names::attributes(b),
        extensions: names::extensions(b),
        ..Module::default()
    }
}

fn uses(b: &mut Bytes<'_>, submodules: usize) -> Vec<SubmoduleUse> {
    let mut uses = Vec::new();
    for at in 0..submodules as u32 {
        uses.extend(b.maybe(2, |b| SubmoduleUse { submodule: SubmoduleId(at), places: places(b) }));
    }
    uses
}

fn numbers(b: &mut Bytes<'_>) -> Numbers {
    let ranges = b.list(2, |b| {
        let first = b.within(0..=9_u16);
        (first, first + b.within(0..=4))
    });
    Numbers(ranges.into_iter().collect())
}

fn places(b: &mut Bytes<'_>) -> SlotNumbers {
    SlotNumbers { allowed: numbers(b), fixed: numbers(b), used: numbers(b) }
}

fn subslot_name(b: &mut Bytes<'_>) -> SubslotName {
    SubslotName { number: b.any(), name: names::name(b), names: names::texts(b) }
}

fn menu(b: &mut Bytes<'_>) -> Menu {
    Menu { id: names::name(b), name: names::name(b), names: names::texts(b), targets: b.list(3, names::name) }
}

fn submodule(b: &mut Bytes<'_>, types: &[TypeDef]) -> Submodule {
    const KINDS: [SubmoduleKind; 5] = [
        SubmoduleKind::Virtual,
        SubmoduleKind::Virtual,
        SubmoduleKind::Pluggable,
        SubmoduleKind::Interface,
        SubmoduleKind::Port,
    ];
    Submodule {
        id: names::name(b),
        ident: b.within(0..=3),
        kind: b.pick(&KINDS),
        api: b.pick(&[0, 0x3A00, 0x3E00, u32::MAX]),
        name: names::name(b),
        names: names::texts(b),
        documentation: names::documentation(b),
        identity: identity(b),
        input: b.maybe(2, |b| Box::new(io_data(b, types, Direction::Transmit))),
        output: b.maybe(2, |b| Box::new(io_data(b, types, Direction::Receive))),
        status_lengths: (b.within(0..=2), b.within(0..=2)),
        records: b.list(3, |b| record(b, types)),
        f_parameters: b.maybe(5, |b| Box::new(f_parameters(b))),
        menus: b.few(4, 2, menu),
        graphics: b.few(6, 2, |b| (names::name(b), names::name(b))),
        attributes: names::attributes(b),
        extensions: names::extensions(b),
        origin: Origin::default(),
    }
}

fn io_data(b: &mut Bytes<'_>, types: &[TypeDef], direction: Direction) -> IoData {
    let name: CompactString = if direction == Direction::Receive { "Output".into() } else { "Input".into() };
    let least = u32::from(!b.one_in(8));
    let image = process::image(b, name, types, least);
    let fields = image.fields.len() as u32;
    IoData {
        items: b.few(6, 2, |b| IoItem {
            name: names::name(b),
            names: names::texts(b),
            data_type: names::name(b),
            bit_offset: b.within(0..=40),
            bits: b.within(0..=40),
            first_field: b.within(0..=fields),
            fields: b.within(0..=2),
            subordinate: b.any(),
        }),
        image: lexibus_codegen::ir::ProcessImage { direction, big_endian: true, ..image },
        consistent: b.any(),
        channels: b.few(6, 2, |b| IoChannel {
            number: b.any(),
            data: b.maybe(2, |b| (b.within(0..=40), b.within(0..=40))),
            quality: b.maybe(2, |b| (b.within(0..=40), b.within(0..=40))),
            quality_format: names::name(b),
            attributes: names::attributes(b),
        }),
    }
}

/// Returns a record. The fields are usually contiguous and within the record.
fn record(b: &mut Bytes<'_>, types: &[TypeDef]) -> Group {
    let index = b.within(0..=3);
    let around = Around { types, given: &[], images: &[], spaces: &[], buses: &[], is_table: false };
    let mut next = 0_u32;
    let items: Vec<Item> = b.list(7, |b| {
        let mut item = item(b, &around, Binding::canopen(0, 0));
        let bits = types::base(types, item.ty).bits().filter(|_| !b.one_in(8)).unwrap_or_else(|| b.within(0..=70));
        let padding = if bits.is_multiple_of(8) { next.next_multiple_of(8) - next } else { 0 };
        let bit_offset = if b.one_in(12) { b.within(0..=100) } else { next + padding };
        next = bit_offset + bits;
        item.bindings = [Binding::Record { index, bit_offset, bits }].into_iter().collect();
        item.access = if b.one_in(4) { Access::Constant } else { Access::ReadWrite };
        item
    });
    let length = if b.one_in(8) { b.within(0..=20) } else { next.div_ceil(8).max(1) };
    let constants = b.few(3, 2, |b| (b.within(0..=8), b.list(3, Bytes::any)));
    let record = Record { index, length, transfer_sequence: b.any(), changeable_with_bump: b.any(), constants };
    let kind = GroupKind::Record(Box::new(record));
    let (name, names) = (names::name(b), names::texts(b));
    Group { name, names, kind, items, documentation: names::documentation(b), ..Group::object(0, ObjectCode::Record) }
}

fn f_parameters(b: &mut Bytes<'_>) -> FParameters {
    const NAMES: [&str; 9] = [
        "F_Check_SeqNr",
        "F_Check_iPar",
        "F_SIL",
        "F_CRC_Length",
        "F_Block_ID",
        "F_Par_Version",
        "F_Source_Add",
        "F_WD_Time",
        "F_Par_CRC",
    ];
    FParameters {
        index: b.any(),
        transfer_sequence: b.any(),
        description_crc: b.any(),
        parameters: b.list(9, |b| FParameter {
            name: b.pick(&NAMES).into(),
            default: values::number(b),
            label: b.pick(&["", "SIL3", "3-Byte-CRC", "\""]).into(),
            allowed: b.list(2, |b| (values::number(b), values::number(b))),
            allowed_labels: b.list(2, names::name),
            changeable: b.any(),
            visible: b.any(),
        }),
        origin: Origin::default(),
    }
}

fn unit_diagnosis(b: &mut Bytes<'_>, types: &[TypeDef]) -> UnitDiagnosis {
    UnitDiagnosis {
        api: b.within(0..=1),
        identifier: b.within(0..=3),
        name: names::name(b),
        names: names::texts(b),
        documentation: names::documentation(b),
        fields: b.list(5, |b| {
            let ty = types::any(b, types.len());
            let base = types::base(types, ty);
            UnitDiagnosisField {
                name: names::name(b),
                names: names::texts(b),
                bit_offset: b.within(0..=60),
                bits: base.bits().unwrap_or_else(|| b.within(0..=40)),
                ty,
                values: enumeration(b, types),
                default: b.maybe(3, |b| values::of(b, base)),
            }
        }),
        extensions: names::extensions(b),
        origin: Origin::default(),
    }
}

/// Returns the ID of a defined type, which is not always an enumeration. Returns `None` for a basic type.
fn enumeration(b: &mut Bytes<'_>, types: &[TypeDef]) -> Option<TypeId> {
    let Type::Named(id) = types::any(b, types.len()) else { return None };
    Some(id)
}
