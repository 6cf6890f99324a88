//! Converts an object or sub-object, together with its parameter, to an item.

use super::application::{Allowed, AllowedRange, ParameterKey, View};
use super::data_type::enum_value;
use super::number::integer;
use super::objects::{Builder, Key, Raw};
use super::reader::Texts;
use crate::diagnostics::codes;
use crate::frontend::canopen::object;
use crate::frontend::canopen::value::Role;
use crate::frontend::xml::Given;
use crate::ir::owner::Owner;
use crate::ir::{
    Access, Behavior, Binding, CompactString, Configured, Extension, Extensions, Fact, FactOrigin, Item, Limits,
    Mappable, ObjectCode, OtherSpans, Quantity, Rule, Scale, Shape, Storage, Type, TypeDef, TypeId, Value,
};
use crate::source::Span;

/// Facts that a sub-object takes from its object: the parameter of the object, and the type that the object's data type
/// defines for the sub-object.
pub(super) type Parent<'v, 'p, 'a> = Option<(&'v View<'p, 'a>, Option<Type>)>;

impl<'a, 'p> Builder<'a, '_, 'p> {
    /// Builds the item of a VAR, DOMAIN or sub-object. The caller sets the name, texts and extensions.
    pub(super) fn item(
        &mut self,
        index: u16,
        sub: u8,
        raw: &Raw<'a>,
        view: &View<'p, 'a>,
        code: ObjectCode,
        parent: Parent<'_, 'p, 'a>,
    ) -> Item {
        let mut item = Item::new(Binding::canopen(index, sub));
        item.origin = raw.origin;
        let ty = self.data_type(raw, view, code, parent.and_then(|(_, component)| component), &mut item);
        let plain = ty.unwrap_or(Type::Opaque(None));
        let allowed = view.find(|parameter| parameter.allowed.as_deref());
        let allowed = allowed.map(|allowed| self.application.allowed(self.reader, allowed));
        let allowed = allowed.filter(|allowed| self.charge(allowed.weight, raw.span(Key::UniqueIdRef)));
        item.ty = self.enumeration(plain, view, allowed);
        let base = Owner::of_types(&self.types).basic(item.ty);
        item.access = self.access(raw, view, code, parent, &mut item);
        if ty.is_none() {
            object::without_type(&mut item);
        }
        item.mappable = self.mappable(raw, item.access, &mut item);
        let default = raw.get(Key::DefaultValue).or_else(|| view.get(ParameterKey::Default));
        item.default = self.typed(default, base, Role::Value);
        item.at.default = span_of(default);
        // Limits are redundant if the type is an enumeration of the allowed values.
        self.limits(raw, base, allowed.filter(|_| item.ty == plain), &mut item);
        item.flags = self.flags(raw);
        self.configured(raw, view, base, &mut item);
        self.quantity(view, allowed, base, &mut item);
        self.behavior(view, &mut item);
        item
    }

    fn typed(&mut self, given: Option<&Given<'a>>, ty: Type, role: Role) -> Option<Value> {
        let given = given?;
        self.reader.converter().value(&given.text, given.span, ty, role)
    }

    fn data_type(
        &mut self,
        raw: &Raw<'a>,
        view: &View<'p, 'a>,
        code: ObjectCode,
        component: Option<Type>,
        item: &mut Item,
    ) -> Option<Type> {
        let parameter = view.find(|parameter| parameter.ty.as_ref());
        if let Some(given) = raw.get(Key::DataType) {
            item.at.ty = given.span;
            let Some(number) = self.reader.hex(given, u32::MAX, "data type") else {
                return Some(Type::Opaque(None));
            };
            let defined = self.codes.get(&number).copied();
            let ty = object::type_by_code(number, given.span, defined, self.reader.diagnostics);
            // The type of the parameter is used if it is based on the type of the object, for example as an
            // enumeration.
            let named = parameter.map(|parameter| self.application.resolve(self.reader, parameter));
            return named.filter(|&named| named != ty && Owner::of_types(&self.types).basic(named) == ty).or(Some(ty));
        }
        item.at.ty = parameter.map_or(raw.origin.span, |parameter| parameter.span());
        // IEC 61131-3 has no type for a DOMAIN, so the parameter declares a different type, which is ignored.
        if code == ObjectCode::Domain {
            return Some(Type::Domain);
        }
        if let Some(parameter) = parameter {
            return Some(self.application.resolve(self.reader, parameter));
        }
        if component.is_some() {
            return component;
        }
        if matches!(code, ObjectCode::DefType | ObjectCode::DefStruct | ObjectCode::Null) {
            return Some(Type::Opaque(None));
        }
        let found = codes::MISSING_DATA_TYPE
            .at(item.at.ty, "neither the object nor its parameter has a data type")
            .label("kept as read-only raw bytes");
        self.reader.diagnostics.push(found.help("add a data type, such as `dataType=\"0007\"` for UNSIGNED32"));
        None
    }

    fn access(
        &mut self,
        raw: &Raw<'a>,
        view: &View<'p, 'a>,
        code: ObjectCode,
        parent: Parent<'_, 'p, 'a>,
        item: &mut Item,
    ) -> Access {
        if let Some(given) = raw.get(Key::AccessType) {
            item.at.access = given.span;
            return object::access(&given.text, given.span, self.reader.diagnostics);
        }
        let of_parent = parent.filter(|_| view.parameter.is_none()).map(|(parent, _)| parent);
        let given = view.get(ParameterKey::Access);
        if let Some(given) = given.or_else(|| of_parent?.get(ParameterKey::Access)) {
            item.at.access = given.span;
            return self.parameter_access(given);
        }
        item.at.access = raw.origin.span;
        item.origins.set(Fact::Access, Some(FactOrigin::Rule(Rule::MissingKey)));
        // The CiA 311 schema defines `read` as the default access of a parameter, but no default access of a variable.
        let is_read = view.parameter.is_some_and(|parameter| parameter.field.is_none());
        match code {
            ObjectCode::Domain if !is_read => return Access::ReadWrite,
            ObjectCode::DefType | ObjectCode::DefStruct | ObjectCode::Null => {}
            _ if is_read => {}
            _ => {
                let message = "neither the object nor its parameter has an access type";
                self.reader.report(&codes::MISSING_ACCESS, raw.origin.span, message, "kept read-only");
            }
        }
        Access::ReadOnly
    }

    fn parameter_access(&mut self, given: &Given<'a>) -> Access {
        match given.text.as_ref() {
            "read" => Access::ReadOnly,
            "write" => Access::WriteOnly,
            "readWrite" => Access::ReadWrite,
            "readWriteInput" => Access::ReadWriteInput,
            "readWriteOutput" => Access::ReadWriteOutput,
            "const" => Access::Constant,
            "noAccess" => {
                let message = "the object refers to a parameter that cannot be accessed through the bus";
                self.reader.report(&codes::XDD_VALUE, given.span, message, "kept read-only");
                Access::ReadOnly
            }
            _ => {
                let help = "write one of read, write, readWrite, readWriteInput, readWriteOutput, const, noAccess";
                let Given { text, span } = given;
                object::unknown_access(text, *span, Access::ReadOnly, help, self.reader.diagnostics);
                Access::ReadOnly
            }
        }
    }

    fn mappable(&mut self, raw: &Raw<'a>, access: Access, item: &mut Item) -> Mappable {
        let Some(given) = raw.get(Key::PdoMapping) else { return Mappable::default() };
        item.at.mappable = given.span;
        let text = given.text.as_ref();
        let is = |word: &str| word.eq_ignore_ascii_case(text);
        match () {
            () if is("no") => Mappable::default(),
            () if is("default") || is("optional") => Mappable::by_access(access),
            () if is("TPDO") => Mappable { tpdo: true, rpdo: false },
            () if is("RPDO") => Mappable { tpdo: false, rpdo: true },
            () => {
                self.reader.bad(given, "PDO mapping", "read as `no`; expected no, default, optional, TPDO or RPDO");
                Mappable::default()
            }
        }
    }

    /// Returns an enumeration of the allowed values if `ty` is an integer type and the parameter allows only single
    /// values with labels. Otherwise, returns `ty`.
    fn enumeration(&mut self, ty: Type, view: &View<'p, 'a>, allowed: Option<&'p Allowed<'a>>) -> Type {
        let (Some(allowed), Some(position)) = (allowed, view.position) else { return ty };
        let labeled = allowed.ranges.is_empty() && allowed.values.iter().all(|(_, texts)| !texts.labels.is_empty());
        if allowed.values.is_empty() || !labeled || !matches!(ty, Type::Integer(_) | Type::Unsigned(_)) {
            return ty;
        }
        if let Some(&known) = self.enumerations.get(&position) {
            let is_same = matches!(&self.types[known.0 as usize].shape, Shape::Enumeration { base, .. } if *base == ty);
            return if is_same { Type::Named(known) } else { ty };
        }
        let value = |(given, texts): &(Given<'a>, Texts<'a>)| Some(enum_value(integer(&given.text)?, texts));
        let Some(values) = allowed.values.iter().map(value).collect::<Option<Vec<_>>>() else { return ty };
        let id = TypeId(self.types.len() as u32);
        self.enumerations.insert(position, id);
        self.types.push(TypeDef::new(view.name(), Shape::Enumeration { base: ty, values, closed: false }, ty.bits()));
        Type::Named(id)
    }

    /// Sets the limits of an item. The allowed values of the parameter determine the limits if the object has none.
    fn limits(&mut self, raw: &Raw<'a>, ty: Type, allowed: Option<&'p Allowed<'a>>, item: &mut Item) {
        let attribute = |key| raw.get(key);
        self.range([attribute(Key::LowLimit), attribute(Key::HighLimit)], ty, item);
        let Some(allowed) = allowed else { return };
        if !item.limits.is_empty() {
            return keep_allowed(allowed, &mut item.extensions);
        }
        if let ([range], []) = (allowed.ranges.as_slice(), allowed.values.as_slice()) {
            return self.range([range.low.non_empty(), range.high.non_empty()], ty, item);
        }
        item.limits = self.hull(allowed, ty).into();
        keep_allowed(allowed, &mut item.extensions);
    }

    /// Sets the minimum and the maximum of an item.
    fn range(&mut self, [low, high]: [Option<&Given<'a>>; 2], ty: Type, item: &mut Item) {
        item.at.others = OtherSpans { low: span_of(low), high: span_of(high), ..OtherSpans::default() }.into();
        let low = self.typed(low, ty, Role::Limit);
        item.limits = Limits { low, high: self.typed(high, ty, Role::Limit), ..Limits::default() }.into();
    }

    /// Returns the minimum and the maximum of all allowed ranges and values, or no limits if a bound is missing or is
    /// not a number.
    fn hull(&mut self, allowed: &'p Allowed<'a>, ty: Type) -> Limits {
        let single = allowed.values.iter().map(|(given, _)| (Some(given), Some(given)));
        let ranges = allowed.ranges.iter().map(|range| (range.low.non_empty(), range.high.non_empty()));
        let mut limits: Option<(Value, Value)> = None;
        for (low, high) in ranges.chain(single) {
            let low = self.typed(low, ty, Role::Limit);
            let high = self.typed(high, ty, Role::Limit);
            let (Some(low), Some(high)) = (low, high) else { return Limits::default() };
            limits = match limits {
                None if low.as_real().is_some() && high.as_real().is_some() => Some((low, high)),
                None => return Limits::default(),
                Some((least, greatest)) => {
                    let less = low.as_real() < least.as_real();
                    let more = high.as_real() > greatest.as_real();
                    Some((if less { low } else { least }, if more { high } else { greatest }))
                }
            };
        }
        limits.map_or_else(Limits::default, |(low, high)| Limits {
            low: Some(low),
            high: Some(high),
            ..Limits::default()
        })
    }

    /// Adds the configured value and the denotation in an XDC file to an item.
    fn configured(&mut self, raw: &Raw<'a>, view: &View<'p, 'a>, ty: Type, item: &mut Item) {
        let actual = raw.get(Key::ActualValue).or_else(|| view.get(ParameterKey::Actual));
        let denotation = match raw.get(Key::Denotation) {
            Some(given) => Some(CompactString::from(given.text.as_ref())),
            None => view.find(|parameter| parameter.denotation.as_deref()).map(|texts| texts.labels.name()),
        };
        let configured = Configured {
            value: self.typed(actual, ty, Role::Value),
            denotation: denotation.filter(|text| !text.is_empty()),
            ..Configured::default()
        };
        if actual.is_some() {
            item.at.others.configured = span_of(actual);
        }
        if configured != Configured::default() {
            item.configured = Some(Box::new(configured));
        }
    }

    /// Sets the unit, step and scale of an item. The physical value is (raw value + offset) × multiplier of the
    /// parameter × multiplier of the unit.
    fn quantity(&mut self, view: &View<'p, 'a>, allowed: Option<&'p Allowed<'a>>, ty: Type, item: &mut Item) {
        let unit = view.find(|parameter| parameter.unit.as_deref());
        let multiplier = view.get(ParameterKey::Multiplier);
        let offset = view.get(ParameterKey::Offset);
        let of_unit = unit.and_then(|unit| unit.multiplier.non_empty());
        let step = allowed.and_then(|allowed| match allowed.ranges.as_slice() {
            [range] => range.step.non_empty(),
            _ => None,
        });
        let mut quantity = Quantity { step: self.typed(step, ty, Role::Limit), ..Quantity::default() };
        let given = multiplier.or(of_unit).or(offset).is_some();
        let [of_value, of_unit] = [multiplier, of_unit].map(|given| self.reader.real(given?, "multiplier"));
        let factor = of_value.unwrap_or(1.0) * of_unit.unwrap_or(1.0);
        let offset = offset.and_then(|given| self.reader.real(given, "offset")).unwrap_or(0.0);
        if given && (factor != 1.0 || offset != 0.0) && (factor * offset).is_finite() && factor.is_finite() {
            quantity.scale = Some(Scale::Linear { factor, offset: offset * factor });
        }
        if let Some(unit) = unit {
            quantity.unit = unit.texts.labels.name();
            quantity.units = unit.texts.labels.except(&quantity.unit);
            item.extensions.extend(unit.uri.extension("unitURI"));
        }
        if quantity != Quantity::default() {
            item.quantity = Some(Box::new(quantity));
        }
    }

    fn behavior(&mut self, view: &View<'p, 'a>, item: &mut Item) {
        let Some(given) = view.get(ParameterKey::Persistent) else { return };
        let storage = if self.reader.flag(given) { Storage::Immediate } else { Storage::Volatile };
        item.behavior = Some(Box::new(Behavior { storage, ..Behavior::default() }));
    }
}

/// Stores the exact list of allowed values as an extension, because the limits of the item contain only a minimum and a
/// maximum.
fn keep_allowed(allowed: &Allowed<'_>, extensions: &mut Extensions) {
    let text = |given: Option<&Given<'_>>| given.map_or_else(String::new, |given| given.text.to_string());
    let range = |range: &AllowedRange<'_>| format!("{}..{}", text(range.low.non_empty()), text(range.high.non_empty()));
    let ranges = allowed.ranges.iter().map(range);
    let list: Vec<String> = ranges.chain(allowed.values.iter().map(|(given, _)| text(Some(given)))).collect();
    let first = allowed.ranges.first().and_then(|range| range.low.non_empty());
    let span = span_of(first.or(allowed.values.first().map(|(given, _)| given)));
    if !list.is_empty() {
        extensions.push(Extension { key: "allowedValues".into(), value: list.join(" ").into(), span });
    }
}

fn span_of(given: Option<&Given<'_>>) -> Span {
    given.map_or(Span::default(), |given| given.span)
}
