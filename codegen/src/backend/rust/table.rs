//! The static table of all objects and registers that clients can access.

use super::code::{call, seq, Data, Doc};
use super::constructor::flags;
use super::context::Context;
use super::item;
use super::item_addresses::{ItemAddresses, ObjectAddress};
use super::literal;
use super::reachable::addressable;
use super::value_type::ValueType;
use super::variant;
use crate::facts::encoding;
use crate::ir::{Access, Bus, Item, Type, Value};
use crate::number::{hex16, hex8};

/// Returns the rows of the static table. Registers that are not objects come first, sorted by table and address. Then
/// come the objects, sorted by index and sub-index.
pub(super) fn models(context: &Context<'_>) -> Vec<Doc> {
    let mut rows = Vec::new();
    for (_, group) in addressable(context) {
        let by_object = !group.has_entries();
        for item in &group.items {
            entries(context, item, if by_object { &group.name } else { &item.name }, &mut rows);
        }
    }
    for item in context.registers.iter().map(|register| register.item) {
        entries(context, item, &item.name, &mut rows);
    }
    rows.sort_by_key(|(key, _)| *key);
    rows.into_iter().map(|(_, row)| row).collect()
}

/// Sort key of a row. The runtime searches the objects of the table in this order.
type Key = (Option<ObjectAddress>, Option<(u8, u16, Option<u8>)>);

/// Adds the rows of an item. An item has several rows if its object addresses on CANopen and EtherCAT differ. It also
/// has several rows if its type or access rights at the register and at the object differ. An item has no row if it has
/// neither an object nor a register.
fn entries(context: &Context<'_>, item: &Item, name: &str, rows: &mut Vec<(Key, Doc)>) {
    let addresses = ItemAddresses::of(context, item);
    let [object, other] = addresses.objects();
    let (mut register, key) = (addresses.register_code(), addresses.register_key());
    let at_object = BusForm::on(item, if addresses.is_on_canopen() { Bus::CanOpen } else { Bus::EtherCat });
    let at_register = BusForm::on(item, Bus::Modbus);
    // The register and the object need separate rows if their types or access rights differ.
    if object.is_some() && register.is_some() && at_object != at_register {
        rows.push(((None, key), entry(context, item, name, None, register.take(), at_register)));
        rows.push(((object, None), entry(context, item, name, object, None, at_object)));
    } else if object.is_some() || register.is_some() {
        let form = if object.is_some() { at_object } else { at_register };
        rows.push(((object, key), entry(context, item, name, object, register, form)));
    }
    let form = BusForm::on(item, Bus::EtherCat);
    rows.extend(other.map(|other| ((Some(other), None), entry(context, item, name, Some(other), None, form))));
}

/// Type and access rights of an item on one bus.
#[derive(Clone, Copy, PartialEq)]
struct BusForm {
    ty: Type,
    access: Access,
}

impl BusForm {
    fn on(item: &Item, bus: Bus) -> Self {
        BusForm { ty: item.type_on(bus), access: item.access_on(bus) }
    }
}

fn entry(
    context: &Context<'_>,
    item: &Item,
    name: &str,
    object: Option<ObjectAddress>,
    register: Option<String>,
    form: BusForm,
) -> Doc {
    let (base, ty) = (context.base(form.ty), context.value_type(form.ty));
    let unit = item.quantity.as_ref().map_or("", |quantity| quantity.unit.as_str());
    let limits = variant::widest(item);
    let object = object.map(|(index, sub)| format!("rt::Object::new({}, {})", hex16(index), hex8(sub)));
    let configured = item.configured_value().map(|value| raw_value(Some(value), base, ty));
    Data::fields(
        "rt::table::Entry",
        vec![
            ("object", Data::option(object)),
            ("register", Data::optional(register.map(Doc::from))),
            ("name", Doc::from(literal::string(name))),
            ("data_type", seq!["rt::DataType::", data_type(base)]),
            ("access", seq!["rt::AccessRights::", item::alias(form.access)]),
            ("flags", Doc::from(flags(item))),
            ("initial", raw_value(item.default.as_ref(), base, ty)),
            ("configured", Data::optional(configured)),
            ("low", Doc::from(bound(limits.low.as_ref(), base))),
            ("high", Doc::from(bound(limits.high.as_ref(), base))),
            ("unit", Doc::from(literal::string(unit))),
        ],
    )
}

fn data_type(ty: Type) -> String {
    let name = match ty {
        Type::Unsigned(bits @ (1..=7 | 9..=15)) => return format!("Bits({bits})"),
        Type::Integer(bits @ (8 | 16 | 24 | 32 | 40 | 48 | 56 | 64)) => return format!("Integer{bits}"),
        Type::Unsigned(bits @ (8 | 16 | 24 | 32 | 40 | 48 | 56 | 64)) => return format!("Unsigned{bits}"),
        Type::Boolean => "Boolean",
        Type::Real32 => "Real32",
        Type::Real64 => "Real64",
        Type::VisibleString(_) => "VisibleString",
        Type::OctetString(_) => "OctetString",
        Type::UnicodeString(_) => "UnicodeString",
        Type::TimeOfDay => "TimeOfDay",
        Type::TimeDifference => "TimeDifference",
        Type::Domain => "Domain",
        _ => "Opaque",
    };
    name.to_owned()
}

/// Returns the code of a default value or configured value: the bytes of an SDO upload, a node-ID formula, or
/// `Unknown`.
fn raw_value(value: Option<&Value>, base: Type, ty: ValueType) -> Doc {
    let formula = value.and_then(|value| ty.formula(value));
    if let Some(offset) = formula.and_then(|offset| u64::try_from(offset).ok()) {
        return Doc::from(format!("rt::table::RawInitial::NodeId({offset:#x})"));
    }
    let bytes = value.filter(|value| ty.literal(value).is_some()).and_then(|value| encoding::bytes(value, base));
    match bytes {
        Some(bytes) => call!("rt::table::RawInitial::Bytes", literal::bytes(&bytes)),
        None => Doc::from("rt::table::RawInitial::Unknown"),
    }
}

fn bound(value: Option<&Value>, ty: Type) -> String {
    let real = matches!(ty, Type::Real32 | Type::Real64);
    let Some(value) = value else { return "rt::table::Bound::Unlimited".to_owned() };
    match value {
        _ if real => match value.as_real().and_then(|value| literal::real(value, 64)) {
            Some(literal) => format!("rt::table::Bound::Real({literal})"),
            None => "rt::table::Bound::Unlimited".to_owned(),
        },
        Value::Int(value) => match (i64::try_from(*value), u64::try_from(*value)) {
            (_, Ok(unsigned)) if !ty.is_signed() => format!("rt::table::Bound::Unsigned({unsigned})"),
            (Ok(signed), _) => format!("rt::table::Bound::Signed({signed})"),
            _ => "rt::table::Bound::Unlimited".to_owned(),
        },
        _ => "rt::table::Bound::Unlimited".to_owned(),
    }
}
