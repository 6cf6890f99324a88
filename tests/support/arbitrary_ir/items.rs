//! Random items and their groups: objects, chapters and process images.

use lexibus_codegen::ir::{
    Binding, Category, CompactString, Configured, Group, GroupKind, ImageBinding, IndirectBinding, Item, Mappable,
    ObjectBuses, ObjectCode, RegisterBinding, RegisterSpace, RelatedItems, ToolFlags, Type, TypeDef, Value, WindowSide,
};

use super::bytes::Bytes;
use super::facts;
use super::names;
use super::types;
use super::values;

/// Elements of a device to which its items can refer.
pub struct Around<'d> {
    pub types: &'d [TypeDef],
    /// Names of machine constants on which scales may depend.
    pub given: &'d [CompactString],
    /// Names of process images.
    pub images: &'d [CompactString],
    /// Names of parameter spaces.
    pub spaces: &'d [CompactString],
    /// Choices for the buses of an object.
    pub buses: &'d [ObjectBuses],
    /// True if the items belong to a register table, in which items may be on any bus.
    pub is_table: bool,
}

/// The buses CANopen and EtherCAT.
pub const BOTH: ObjectBuses = ObjectBuses { canopen: true, coe: true };

const NOWHERE: ObjectBuses = ObjectBuses { canopen: false, coe: false };

/// Returns an item with this binding.
pub fn item(b: &mut Bytes<'_>, around: &Around<'_>, binding: Binding) -> Item {
    let ty = types::any(b, around.types.len());
    let base = types::base(around.types, ty);
    let access = facts::access(b);
    Item {
        name: names::name(b),
        names: names::texts(b),
        ty,
        access,
        mappable: if b.one_in(2) {
            Mappable::by_access(access)
        } else {
            Mappable { rpdo: b.one_in(4), tpdo: b.one_in(4) }
        },
        default: b.maybe(2, |b| values::of(b, base)),
        limits: values::limits(b, base).into(),
        variants: b.few(6, 2, |b| facts::variant(b, base)).into(),
        configured: b.maybe(12, |b| {
            let value = b.maybe(2, |b| values::of(b, base));
            let [upload_file, download_file] = [0; 2].map(|_| b.maybe(4, names::path));
            Box::new(Configured { value, denotation: b.maybe(2, names::text), upload_file, download_file })
        }),
        quantity: b.maybe(3, |b| Box::new(facts::quantity(b, around.given))),
        behavior: b.maybe(4, |b| Box::new(facts::behavior(b))),
        availability: b.maybe(6, |b| Box::new(facts::availability(b))),
        related: b.maybe(8, |b| {
            let mut item = || b.maybe(2, names::name).map(|name| Box::new(name.into()));
            let (same_as, same_quantity, upper_half, valid_count) = (item(), item(), item(), item());
            let (id, unsuitable_values) = (names::name(b), names::name(b));
            Box::new(RelatedItems { same_as, same_quantity, upper_half, valid_count, id, unsuitable_values })
        }),
        is_reserved: b.one_in(12),
        is_optional: b.one_in(12),
        shared_by_axes: b.one_in(6),
        flags: b.pick(&[0, 0, 1, u32::MAX]),
        documentation: names::documentation(b),
        doubts: names::doubts(b),
        extensions: names::extensions(b),
        origins: names::origins(b),
        ..Item::new(binding)
    }
}

/// Returns the objects of a dictionary in ascending order of their indices.
pub fn objects(b: &mut Bytes<'_>, around: &Around<'_>, most: usize) -> Vec<Group> {
    const KNOWN: [u16; 9] = [0x1000, 0x1018, 0x1600, 0x1A00, 0x6040, 0x6041, 0x6060, 0x607A, 0x20];
    let mut indices = b.list(most, |b| if b.one_in(3) { b.pick(&KNOWN) } else { b.within(0x2000..=0x2020) });
    indices.sort_unstable();
    indices.dedup();
    indices.into_iter().map(|index| object(b, around, index)).collect()
}

fn object(b: &mut Bytes<'_>, around: &Around<'_>, index: u16) -> Group {
    const CODES: [ObjectCode; 10] = [
        ObjectCode::Var,
        ObjectCode::Var,
        ObjectCode::Var,
        ObjectCode::Record,
        ObjectCode::Record,
        ObjectCode::Array,
        ObjectCode::Domain,
        ObjectCode::DefStruct,
        ObjectCode::DefType,
        ObjectCode::Null,
    ];
    const CATEGORIES: [Category; 4] =
        [Category::Mandatory, Category::Optional, Category::Conditional, Category::Manufacturer];
    let code = b.pick(&CODES);
    let count = if code.has_subs() { b.within(0..=5) } else { 1 };
    let items = (0..count).map(|sub_index| {
        let buses = if around.is_table && b.one_in(20) { NOWHERE } else { b.pick(around.buses) };
        let mut item = item(b, around, Binding::Object { buses, index, sub_index });
        if around.is_table && b.one_in(4) {
            item.bindings.push(binding(b, around));
        }
        item
    });
    let items = items.collect();
    Group {
        name: names::name(b),
        names: names::texts(b),
        kind: GroupKind::Object { index, code, category: b.maybe(4, |b| b.pick(&CATEGORIES)) },
        items,
        links: b.few(8, 2, |b| b.within(0x2000..=0x2020)),
        flags: b.pick(&[0, 1]),
        described: b.within(0..=count.into()),
        depends_on_slot: b.one_in(8),
        depends_on_slot_group: b.one_in(8),
        tool_flags: b.maybe(8, |b| {
            let [attribute, transition, sdo_access, overwritten_by_module] = [0; 4].map(|_| names::text(b));
            Box::new(ToolFlags { attribute, transition, sdo_access, overwritten_by_module })
        }),
        documentation: names::documentation(b),
        doubts: names::doubts(b),
        extensions: names::extensions(b),
        origins: names::origins(b),
        ..Group::object(index, code)
    }
}

/// Returns objects with the communication parameters and mappings of PDOs. The passes of the compiler create PDOs from
/// these objects.
pub fn pdo_objects(b: &mut Bytes<'_>, dictionary: &[Group]) -> Vec<Group> {
    let mut numbers = b.list(4, |b| b.pick(&[0x1400, 0x1401, 0x1402, 0x15FF, 0x1800, 0x1801]));
    numbers.sort_unstable();
    numbers.dedup();
    let communications = numbers.iter().map(|index| parameters(b, *index, communication));
    let mut groups: Vec<Group> = communications.collect();
    groups.extend(numbers.iter().map(|index| parameters(b, *index + 0x200, |b, sub| mapping(b, sub, dictionary))));
    groups
}

fn parameters(b: &mut Bytes<'_>, index: u16, default: impl Fn(&mut Bytes<'_>, u8) -> (u8, Value)) -> Group {
    let last = b.within(0..=6);
    let items = (0..=last).map(|sub_index| {
        let (bits, value) = if sub_index == 0 { (8, Value::Int(last.into())) } else { default(b, sub_index) };
        let mut item = Item::new(Binding::canopen(index, sub_index));
        (item.name, item.ty) = (names::name(b), Type::Unsigned(bits));
        (item.access, item.default) = (facts::access(b), Some(value));
        item
    });
    let items = items.collect();
    Group { name: names::name(b), items, ..Group::object(index, ObjectCode::Record) }
}

fn communication(b: &mut Bytes<'_>, sub: u8) -> (u8, Value) {
    match sub {
        1 => (32, b.pick(&[Value::NodeId(0x200), Value::Int(0x8000_0181), Value::NodeId(-5), Value::Raw("x".into())])),
        3 | 5 => (16, Value::Int(b.any::<u16>().into())),
        _ => (8, Value::Int(b.any::<u8>().into())),
    }
}

/// Returns the width in bits and the value of a mapping entry, which usually maps an existing object with the correct length.
fn mapping(b: &mut Bytes<'_>, sub: u8, dictionary: &[Group]) -> (u8, Value) {
    let items: Vec<&Item> = dictionary.iter().flat_map(|group| &group.items).collect();
    if items.is_empty() || b.one_in(6) {
        return (32, Value::Int(b.pick(&[0, 0x0005_0008, 0x2000_0010, i128::from(sub)])));
    }
    let item = b.pick(&items);
    let (index, sub) = item.object().unwrap_or_default();
    let bits = item.ty.bits().filter(|_| !b.one_in(8)).unwrap_or(8).min(255);
    (32, Value::Int(i128::from(index) << 16 | i128::from(sub) << 8 | i128::from(bits)))
}

/// Returns a chapter of a manual or the fields of a process image. The items may be on any bus.
pub fn chapter(b: &mut Bytes<'_>, around: &Around<'_>) -> Group {
    let kind = if b.one_in(4) { GroupKind::Image { length: b.within(0..=40) } } else { GroupKind::Chapter };
    let items = b.list(9, |b| {
        let first = binding(b, around);
        let mut item = item(b, around, first);
        if around.is_table && b.one_in(8) {
            (item.name, item.ty) = (names::of_window(b), b.pick(&[Type::Unsigned(16), Type::Integer(32)]));
        }
        while b.one_in(3) {
            item.bindings.push(binding(b, around));
        }
        if b.one_in(12) {
            item.bindings.clear();
        }
        item
    });
    let (documentation, doubts) = (names::documentation(b), names::doubts(b));
    Group { name: names::name(b), kind, items, documentation, doubts, ..Group::object(0, ObjectCode::Var) }
}

fn binding(b: &mut Bytes<'_>, around: &Around<'_>) -> Binding {
    match b.within(0..=11) {
        0 | 1 => Binding::Object { buses: b.pick(around.buses), index: b.within(0x2000..=0x2020), sub_index: b.any() },
        2..=5 => Binding::Register(Box::new(register(b))),
        6 => Binding::parameter(&names::of(b, around.spaces), b.pick(&[0, 1, 255, u32::MAX])),
        7 => Binding::Image(Box::new(ImageBinding {
            image: names::of(b, around.images).into(),
            bit_offset: b.within(0..=80),
            bits: b.within(0..=70),
            ty: b.maybe(4, types::basic),
        })),
        8 => Binding::EscMemory { address: b.any(), length: b.within(0..=9) },
        9 => b.maybe(2, |b| Binding::Ascii(names::name(b))).unwrap_or(Binding::Record {
            index: 1,
            bit_offset: 0,
            bits: 8,
        }),
        _ => Binding::Indirect(Box::new(indirect(b))),
    }
}

fn register(b: &mut Bytes<'_>) -> RegisterBinding {
    const TABLES: [RegisterSpace; 6] = [
        RegisterSpace::Holding,
        RegisterSpace::Holding,
        RegisterSpace::Holding,
        RegisterSpace::Input,
        RegisterSpace::Coil,
        RegisterSpace::DiscreteInput,
    ];
    RegisterBinding {
        space: b.pick(&TABLES),
        address: if b.one_in(4) { b.any() } else { b.within(0..=20) },
        printed: b.maybe(2, names::text).unwrap_or_default(),
        is_order_assumed: b.one_in(5),
        count: b.within(1..=4),
        low_word_first: b.any(),
        bytes_swapped: b.one_in(4),
        bit_offset: b.maybe(4, |b| b.within(0..=15)),
        words_per_address: b.pick(&[1, 1, 1, 2]),
        extended: b.one_in(4),
    }
}

fn indirect(b: &mut Bytes<'_>) -> IndirectBinding {
    IndirectBinding {
        space: names::name(b),
        window: b.within(0..=2),
        buses: names::buses(b),
        number: if b.one_in(40) { u32::MAX } else { b.within(0..=3) },
        read: b.maybe(2, window_side),
        write: b.maybe(2, window_side),
    }
}

fn window_side(b: &mut Bytes<'_>) -> WindowSide {
    WindowSide {
        number: names::of_window(b).into(),
        value: names::of_window(b).into(),
        number_first: b.any(),
        clears: b.any(),
        wait: b.maybe(3, |b| b.pick(&[0, 5, u32::MAX])),
        timeout: b.maybe(3, |b| b.pick(&[0, 5, u32::MAX])),
        procedure: b.maybe(3, names::name).map(Into::into),
    }
}

/// Returns an item that exists only as a value in a message.
pub fn unbound(b: &mut Bytes<'_>, around: &Around<'_>) -> Item {
    let mut item = item(b, around, Binding::canopen(0, 0));
    item.bindings.clear();
    if b.one_in(2) {
        item.ty = b.pick(&[Type::Unsigned(8), Type::Unsigned(16), Type::Integer(32)]);
    }
    item
}
