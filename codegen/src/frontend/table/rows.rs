//! Converts rows of a register table to items.

use std::sync::Arc;

use compact_str::CompactString;

use super::at::{At, Entries, Literal, OneOrMany, TextOr};
use super::definitions::{About, DefinitionKind, Definitions};
use super::format::{ConversionTable, FlagOrText, NumberOrText, Row};
use super::numbered::Numbered;
use super::references::ITEM;
use super::repeats::Repeats;
use super::spaces::Space;
use super::summary::{self, Summaries};
use super::tree::{cited, Reader};
use super::words::{ACCESSES, DIRECTIONS};
use super::{conditions, given, scale, types, value};
use crate::diagnostics::{codes, Code};
use crate::ir::{
    Access, Availability, Behavior, Binding, Bus, Buses, Conversion, Documentation, Fact, FactOrigin, Item, ItemRef,
    ModbusTable, Quantity, RegisterSpace, RelatedItems, Rule, Shape, Storage, Type, TypeDef, TypeId,
};
use crate::source::Span;
use crate::text::brief;

/// State that all rows share while they are read.
pub(super) struct Rows {
    pub definitions: Definitions,
    pub spaces: Vec<Space>,
    /// Modbus requests that the device supports.
    pub modbus: Vec<ModbusTable>,
    pub buses: Buses,
    pub defaults: Option<Row>,
    /// Items that have register numbers.
    pub numbered: Vec<Numbered>,
    /// Diagnostics that rows and definitions allow, with the spans in which they are allowed.
    pub allowed: Vec<(Span, &'static Code)>,
    /// Statements that other sections of the manual make about objects with sub-entries, each with the index of the
    /// object.
    pub summaries: Vec<(u16, Summaries)>,
    /// Budget for the items that rows create, and for the texts that rows copy.
    pub repeats: Repeats,
}

/// Name of an item, its number among the items of its row, and the key and the end of the row.
#[derive(Clone, Copy)]
pub(super) struct Named<'k> {
    pub name: &'k str,
    pub key: &'k At<String>,
    pub number: u32,
    /// End of the row in the file.
    pub end: u32,
}

impl Rows {
    /// Creates the state for rows on all buses, without spaces.
    pub fn new(definitions: Definitions, defaults: Option<Row>) -> Self {
        Rows {
            repeats: Repeats::new(defaults.as_ref()),
            definitions,
            spaces: Vec::new(),
            modbus: Vec::new(),
            buses: Buses::ALL,
            defaults,
            numbered: Vec::new(),
            allowed: Vec::new(),
            summaries: Vec::new(),
        }
    }

    /// Returns the row with the defaults of its chapter and of the file. Returns the row unchanged if the budget is too small for
    /// the defaults.
    pub fn complete(&mut self, reader: &mut Reader<'_, '_>, key: &At<String>, row: &Row, chapter: Option<&Row>) -> Row {
        let row = row.clone();
        if !self.repeats.inherit(reader, reader.span(key)) {
            return row;
        }
        let row = chapter.map_or(row.clone(), |defaults| row.or(defaults));
        self.defaults.as_ref().map_or(row.clone(), |defaults| row.or(defaults))
    }

    /// Allows the diagnostics that the key `allow` of a row names.
    pub fn allow(&mut self, reader: &mut Reader<'_, '_>, key: &At<String>, row: &At<Row>) {
        self.allow_in(reader, Span::new(reader.file, key.start, row.end), &row.value.allow);
    }

    /// Allows the diagnostics that definitions name in their key `allow`, within the names and contents of these definitions.
    pub fn allow_of_definitions(&mut self, reader: &mut Reader<'_, '_>) {
        fn whole<T>(reader: &Reader<'_, '_>, name: &At<String>, entries: &Entries<T>) -> Span {
            let spans = entries.iter().map(|(key, value)| (key.start, value.end));
            let (start, end) =
                spans.fold((name.start, name.end), |all, entry| (all.0.min(entry.0), all.1.max(entry.1)));
            Span::new(reader.file, start, end)
        }
        let enums = self.definitions.enums.iter();
        let enums = enums.map(|(name, table)| (whole(reader, name, &table.values), table.allow.clone()));
        let bits = self.definitions.bits.iter();
        let bits = bits.map(|(name, table)| (whole(reader, name, &table.at), table.allow.clone()));
        for (span, names) in enums.chain(bits).collect::<Vec<_>>() {
            self.allow_in(reader, span, &names);
        }
    }

    /// Allows the diagnostics that the key `allow` of an element names, in the byte range `at`.
    pub fn allow_at(&mut self, reader: &mut Reader<'_, '_>, at: (u32, u32), names: &Option<Vec<At<String>>>) {
        self.allow_in(reader, Span::new(reader.file, at.0, at.1), names);
    }

    fn allow_in(&mut self, reader: &mut Reader<'_, '_>, span: Span, names: &Option<Vec<At<String>>>) {
        for name in names.iter().flatten() {
            match codes::find(&name.value) {
                Some(code) => self.allowed.push((span, code)),
                None => {
                    let known = codes::similar(&name.value);
                    reader.unresolved("code", &name.value, reader.span(name), known.into_iter());
                }
            }
        }
    }

    /// Reports an item whose access rights are not declared.
    pub fn no_access(&self, reader: &mut Reader<'_, '_>, named: Named<'_>) {
        let message = format!("the access rights of `{}` are not declared", brief(named.name));
        let found = codes::ACCESS_NOT_GIVEN.at(reader.span(named.key), message).label("read-only");
        reader.diagnostics.push(found.help("add `access` to the row, or to `defaults` for all rows"));
    }

    /// Returns the type of a row. Reports a missing or unknown type.
    pub fn ty(&mut self, reader: &mut Reader<'_, '_>, named: Named<'_>, row: &Row) -> Option<Type> {
        let written = row.ty.as_ref().and_then(|ty| {
            let found = types::named(&ty.value);
            if found.is_none() {
                let what = format!("`{}` is not a known data type", brief(&ty.value));
                let help = match types::suggestion(&ty.value) {
                    Some(name) => format!("did you mean `{name}`?"),
                    None => "write a type such as `u16`, `i32`, `f32`, `bool`, `str(25)` or `u16[10]`".to_owned(),
                };
                reader.report_with_help(&codes::TABLE_VALUE, reader.span(ty), what, help);
            }
            found
        });
        let (base, elements) = match written {
            Some(written) => (Some(written.ty), written.elements),
            None => (definition(row).and_then(|(kind, name)| self.definitions.base(reader, kind, &name.value)), None),
        };
        let Some(base) = base else {
            if row.ty.is_none() {
                let message = format!("the row `{}` has no `type`", brief(&named.key.value));
                reader.report(&codes::TABLE_VALUE, reader.span(named.key), message);
            }
            return None;
        };
        let ty = self.meaning(reader, named, row, base).unwrap_or(base);
        Some(elements.map_or(ty, |count| self.array(reader, named, ty, count)))
    }

    /// Returns the bit field or enumeration of a row, with the underlying integer type `base`.
    pub fn meaning(&mut self, reader: &mut Reader<'_, '_>, named: Named<'_>, row: &Row, base: Type) -> Option<Type> {
        let origin = reader.origin(named.key);
        if let (Some(_), Some(values)) = (&row.bits, &row.values) {
            let message = "the row has both `bits` and `enum`, which exclude each other";
            reader.report(&codes::TABLE_VALUE, reader.span(values), message);
        }
        let about = || About::inline(named.name.into(), origin);
        let (kind, name) = match (&row.bits, &row.values) {
            (Some(At { value: TextOr::Table(table), .. }), _) => {
                return Some(Type::Named(self.definitions.bit_field(reader, about(), base, table, None)));
            }
            (None, Some(At { value: TextOr::Table(table), .. })) => {
                return Some(Type::Named(self.definitions.enumeration(reader, about(), base, false, table)));
            }
            _ => definition(row).filter(|(_, name)| !name.value.is_empty())?,
        };
        self.definitions.named(reader, kind, &name, base)
    }

    fn array(&mut self, reader: &Reader<'_, '_>, named: Named<'_>, element: Type, count: u32) -> Type {
        let bits = self.definitions.underlying(element).bits().and_then(|bits| bits.checked_mul(count));
        let id = TypeId(self.definitions.types.len() as u32);
        self.definitions.types.push(TypeDef {
            origin: reader.origin(named.key),
            ..TypeDef::new(named.name, Shape::Array { element, dimensions: vec![(0, count)] }, bits)
        });
        Type::Named(id)
    }

    /// Adds the facts of a row to its item. A row of an overlay contains only the facts that it changes.
    pub fn fill(
        &mut self,
        reader: &mut Reader<'_, '_>,
        item: &mut Item,
        named: Named<'_>,
        row: &Row,
        ty: Option<Type>,
    ) {
        let origin = reader.origin(named.key);
        item.origin = crate::source::Origin { span: Span { end: named.end, ..origin.span }, ..origin };
        (item.name, item.at.name) = (named.name.into(), reader.span(named.key));
        if let Some(ty) = ty {
            item.ty = ty;
            item.at.ty = row.ty.as_ref().map_or(item.at.ty, |ty| reader.span(ty));
        }
        if row.bits.is_some() || row.values.is_some() {
            item.origins.set(Fact::Meaning, states_no_meaning(row).then_some(FactOrigin::Stated));
        }
        self.access(reader, item, row);
        self.values(reader, item, named, row);
        self.length(reader, item, named, row);
        self.quantity(reader, item, row);
        self.variants(reader, item, row);
        self.behavior(reader, item, row);
        self.availability(reader, item, row);
        self.words(reader, item, row);
        if let Some(summary) = &row.summary {
            summary::item(reader, &self.definitions, summary, item);
        }
    }

    /// Compares the `length` of a row with the item's type, unless `length` belongs to the address `esc` or to `defaults`.
    fn length(&self, reader: &mut Reader<'_, '_>, item: &Item, named: Named<'_>, row: &Row) {
        let Some(length) = row.length.as_ref().filter(|_| row.esc.is_none()) else { return };
        let is_in_row = named.key.start <= length.start && length.end <= named.end;
        let Some(bits) =
            self.definitions.bits_of(item.ty).filter(|bits| is_in_row && bits.div_ceil(8) != u32::from(length.value))
        else {
            return;
        };
        let (name, bytes) = (brief(named.name), bits.div_ceil(8));
        let message = format!("the manual states {} bytes for `{name}`, but its type has {bytes}", length.value);
        let found = codes::LENGTH_MISMATCH.at(reader.span(length), message).label("the type is used");
        reader.diagnostics.push(found.help("correct the type, or delete `length` and add a `doubt`"));
    }

    fn access(&mut self, reader: &mut Reader<'_, '_>, item: &mut Item, row: &Row) {
        if let Some(access) = &row.access {
            let rule = (access.value == "?").then_some(FactOrigin::Rule(Rule::UnstatedAccess));
            item.origins.set(Fact::Access, rule);
            let known = ACCESSES.iter().copied().chain([("?", Access::ReadWrite)]).collect::<Vec<_>>();
            item.access = reader.word(access, "access right", &known).unwrap_or(item.access);
            item.at.access = reader.span(access);
        }
        // A reserved sub-index has no value to write, even if its row inherits write access.
        let is_object = item.object().is_some_and(|(_, sub)| sub > 0);
        if row.reserved == Some(true) && is_object && item.access.readable() && item.access.writable() {
            item.access = Access::ReadOnly;
            item.origins.set(Fact::Access, Some(FactOrigin::Rule(Rule::ReservedEntry)));
        }
        // No Modbus function writes inputs.
        let is_input = |binding: &Binding| match binding {
            Binding::Register(register) => {
                matches!(register.space, RegisterSpace::Input | RegisterSpace::DiscreteInput)
            }
            _ => false,
        };
        if item.is_access_assumed() && item.bindings.iter().all(is_input) {
            item.access = Access::ReadOnly;
        }
        if let Some(pdo) = &row.pdo {
            item.mappable = reader.word(pdo, "PDO direction", &DIRECTIONS).unwrap_or(item.mappable);
            item.at.mappable = reader.span(pdo);
        }
    }

    fn quantity(&mut self, reader: &mut Reader<'_, '_>, item: &mut Item, row: &Row) {
        let says_nothing =
            row.unit.is_none() && row.scale.is_none() && row.offset.is_none() && row.na.is_none() && row.step.is_none();
        if says_nothing && row.conversions.is_empty() {
            return;
        }
        let base = self.definitions.underlying(item.ty);
        let mut quantity = item.quantity.take().map_or_else(Quantity::default, |quantity| *quantity);
        let units = &self.definitions.units;
        let unit_table = row.unit.as_ref().and_then(|unit| units.get(&unit.value));
        let unit_table = unit_table.map(|(_, table)| table.clone());
        let mut affordable = |unit: &At<String>| self.repeats.unit(reader, units, &unit.value, reader.span(unit));
        if let Some(unit) = row.unit.as_ref().filter(|unit| affordable(unit)) {
            quantity.unit = match &unit_table {
                Some(table) => table.symbol.as_deref().unwrap_or_default().into(),
                None => unit.value.as_str().into(),
            };
            quantity.units = reader.original(unit_table.as_ref().and_then(|table| table.orig.as_deref()));
            let machine = unit_table.as_ref().and_then(|table| table.machine.as_ref());
            quantity.machine = machine.and_then(|machine| given::unit(reader, machine));
            if unit_table.is_none() && !unit.value.is_empty() && !super::units::is_unit(&unit.value) {
                let names = self.definitions.units.names().map(|name| name.value.as_str());
                let names = names.take_while(|_| reader.helps());
                let similar =
                    crate::text::similar(&unit.value, names).or_else(|| super::units::usual_unit(&unit.value));
                let message = format!("`{}` is neither defined in `[units]` nor a known unit", brief(&unit.value));
                let diagnostic = codes::UNKNOWN_UNIT.at(reader.span(unit), message);
                reader.diagnostics.push(match similar {
                    Some(name) => diagnostic.help(format!("did you mean `{name}`?")),
                    None => diagnostic.label("kept unchanged").help("define it in `[units]`"),
                });
            }
        }
        let (scale, offset) = match &unit_table {
            Some(table) if row.scale.is_none() => (table.scale.as_ref(), row.offset.or(table.offset)),
            _ => (row.scale.as_ref(), row.offset),
        };
        if unit_table.is_some() || row.scale.is_some() || row.offset.is_some() {
            quantity.scale = scale::read(reader, scale, offset, item.at.name);
        }
        for (key, meaning) in row.na.iter().flat_map(|na| na.iter()) {
            let literal = At { value: Literal::Text(key.value.clone()), start: key.start, end: key.end };
            quantity.sentinels.push((value::value(reader, &literal, base), meaning.value.as_str().into()));
        }
        quantity.step = row.step.as_ref().map(|step| value::value(reader, step, base)).or(quantity.step);
        quantity.conversions.extend(row.conversions.iter().map(|conversion| self.conversion(reader, conversion)));
        item.quantity = Some(Box::new(quantity));
    }

    /// Reads an example of a conversion that the manual prints.
    fn conversion(&mut self, reader: &mut Reader<'_, '_>, given: &At<ConversionTable>) -> Conversion {
        let example = &given.value;
        if example.raw.is_none() || example.value.is_none() {
            let message = "a conversion needs a `raw` value and a physical `value`";
            reader.report(&codes::TABLE_VALUE, reader.span(given), message);
        }
        reader.mention(&example.model, "model");
        reader.mention(example.given.iter().map(|(name, _)| name), "given number");
        Conversion {
            raw: example.raw.map(Into::into),
            value: example.value,
            unit: example.unit.as_ref().map(|unit| unit.value.as_str().into()),
            given: example.given.iter().map(|(name, number)| (reader.reference(name), number.value)).collect(),
            model: example.model.as_ref().map(|model| reader.reference(model)),
            by: example.by,
            documentation: reader.documentation_of(example),
            at: reader.span(given),
        }
    }

    fn behavior(&mut self, reader: &mut Reader<'_, '_>, item: &mut Item, row: &Row) {
        let base = self.definitions.underlying(item.ty);
        let mut behavior = item.behavior.take().map_or_else(Behavior::default, |behavior| *behavior);
        match &row.save {
            Some(FlagOrText::Flag(true)) => behavior.storage = Storage::Immediate,
            Some(FlagOrText::Flag(false)) => behavior.storage = Storage::Volatile,
            Some(FlagOrText::Text(word)) if ["yes", "no", "true", "false"].contains(&word.as_str()) => {
                let flag = matches!(word.as_str(), "yes" | "true");
                let message = format!("`{word}` is not a command");
                let help = format!("write `save = {flag}` without quotes, or the name of a command");
                reader.report_with_help(&codes::TABLE_VALUE, item.at.name, message, help);
            }
            Some(FlagOrText::Text(command)) => behavior.storage = Storage::OnCommand(command.as_str().into()),
            None => {}
        }
        if let Some(effective) = &row.effective {
            behavior.effective = Some(effective.as_str().into());
        }
        if let Some(when) = &row.when {
            behavior.write_when = conditions::conditions(reader, when);
        }
        if let Some(values) = &row.writable {
            behavior.writable_values = value::listed(reader, &values.value, (values.start, values.end), base);
        }
        behavior.self_clearing = row.clears.unwrap_or(behavior.self_clearing);
        behavior.write_once = row.once.unwrap_or(behavior.write_once);
        if let Some(pdi) = &row.pdi {
            behavior.pdi_access = reader.word(pdi, "access right", &ACCESSES);
            if !item.bindings.iter().any(|binding| matches!(binding, crate::ir::Binding::EscMemory { .. })) {
                let message =
                    "`pdi` needs an address in the memory of an EtherCAT slave controller, but the row has none";
                reader.report(&codes::TABLE_VALUE, reader.span(pdi), message);
            }
        }
        behavior.hidden = row.hidden.unwrap_or(behavior.hidden);
        if let Some(OneOrMany(effects)) = &row.effects {
            behavior.side_effects = effects.iter().map(|effect| effect.as_str().into()).collect();
        }
        item.behavior = (behavior != Behavior::default()).then(|| Box::new(behavior));
        if let Some(per_axis) = row.per_axis {
            item.shared_by_axes = !per_axis;
        }
    }

    fn availability(&mut self, reader: &mut Reader<'_, '_>, item: &mut Item, row: &Row) {
        let mut availability =
            item.availability.take().map_or_else(Availability::default, |availability| *availability);
        if let Some(models) = &row.models {
            availability.models = models.iter().map(|model| model.value.as_str().into()).collect();
            reader.mention(models, "model");
        }
        let text = |given: &Option<String>, old: Option<CompactString>| given.as_deref().map(Into::into).or(old);
        (availability.since, availability.until) =
            (text(&row.since, availability.since), text(&row.until, availability.until));
        if let Some(replaced) = &row.replaced_by {
            availability.replaced_by = Some(reader.reference(replaced));
            reader.mention([replaced], ITEM);
        }
        // Buses are stored only if they include PROFINET or a serial line, because the addresses of an item show all
        // other buses.
        let buses = row.buses.iter().flatten().filter_map(|bus| Bus::from_name(&bus.value)).collect::<Buses>();
        if buses.contains(Bus::Profinet) || buses.contains(Bus::Serial) {
            availability.buses = buses;
        }
        if let Some(OneOrMany(needs)) = &row.needs {
            availability.options = needs.iter().map(|need| need.as_str().into()).collect();
        }
        item.availability = (availability != Availability::default()).then(|| Box::new(availability));
        self.related(reader, item, row);
    }

    fn related(&mut self, reader: &mut Reader<'_, '_>, item: &mut Item, row: &Row) {
        let names = [&row.upper, &row.same_quantity, &row.same_as];
        reader.mention(names.into_iter().flatten(), ITEM);
        let mut related = item.related.take().map_or_else(RelatedItems::default, |related| *related);
        let found = |name: &Option<At<String>>| name.as_ref().map(|name| Box::new(reader.reference(name)));
        related.upper_half = found(&row.upper).or(related.upper_half);
        related.same_quantity = found(&row.same_quantity).or(related.same_quantity);
        related.same_as = found(&row.same_as).or(related.same_as);
        if let Some(At { value: NumberOrText::Text(count), start, end }) = &row.count {
            related.valid_count = Some(Box::new(ItemRef::new(count.as_str(), Span::new(reader.file, *start, *end))));
        }
        item.related = (related != RelatedItems::default()).then(|| Box::new(related));
    }

    fn words(&mut self, reader: &mut Reader<'_, '_>, item: &mut Item, row: &Row) {
        let cite = row.cite.as_ref().map(cited);
        if row.orig.is_some() {
            item.names = reader.original(row.orig.as_deref());
        }
        if row.doc.is_some() {
            item.at.others.documentation = item.origin.span;
        }
        if row.doc.is_some() || row.doc_from.is_some() || cite.is_some() {
            item.documentation = documentation(reader, row);
        }
        let doubts = [row.doubt.as_ref(), row.doubts.as_ref()];
        item.doubts.extend(reader.doubts(doubts, item.origin, cite.as_deref()));
        item.is_reserved |= row.reserved == Some(true);
        item.is_optional |= row.optional == Some(true);
    }
}

/// Value of `doc_from` for a description that only spells out the printed name.
const PRINTED_NAME: &str = "name";

/// Returns the documentation of a row, with the origin of its text.
pub(super) fn documentation(reader: &mut Reader<'_, '_>, row: &Row) -> Option<Arc<Documentation>> {
    if let (Some(from), None) = (&row.doc_from, &row.doc) {
        reader.report(&codes::TABLE_VALUE, reader.span(from), "the row has `doc_from`, but no `doc`");
    }
    let mut documentation = reader.documentation_of(row);
    if let (Some(from), Some(documentation)) = (&row.doc_from, &mut documentation) {
        let origin = match from.value.as_str() {
            PRINTED_NAME => FactOrigin::PrintedName,
            standard => FactOrigin::Standard(standard.into()),
        };
        Arc::make_mut(documentation).text_from = (!from.value.is_empty()).then(|| Box::new(origin));
    }
    documentation
}

/// Returns the name of the bit field or enumeration that a row names, with its kind.
pub(super) fn definition(row: &Row) -> Option<(DefinitionKind, At<String>)> {
    let (kind, name, start, end) = match (&row.bits, &row.values) {
        (Some(At { value: TextOr::Text(name), start, end }), _) => (DefinitionKind::Bits, name, start, end),
        (_, Some(At { value: TextOr::Text(name), start, end })) => (DefinitionKind::Enumeration, name, start, end),
        _ => return None,
    };
    Some((kind, At { value: name.clone(), start: *start, end: *end }))
}

/// Returns whether `bits = ""` or `enum = ""` in a row states that the manual names no bits or values.
fn states_no_meaning(row: &Row) -> bool {
    matches!(&row.bits, Some(At { value: TextOr::Text(name), .. }) if name.is_empty())
        || matches!(&row.values, Some(At { value: TextOr::Text(name), .. }) if name.is_empty())
}
