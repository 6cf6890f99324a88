//! Reads an overlay, and applies it to the devices and modules that it selects.
//!
//! `resolve` applies the overlays, but calls a function of this front end, because a row has a meaning only together with the item that
//! it changes: the bits or values of a row have the type of the item, and a formula or condition refers to other items. The code that
//! creates an item from a row of a register table therefore also changes an item.

use super::super::definitions::DefinitionKind;
use super::super::file::resolve;
use super::super::format::AppliesTable;
use super::super::machine_budget::MachineBudget;
use super::super::tree::Reader;
use super::super::{code_tables, device, machines};
use super::change::{file_name, Change, ObjectSet, RowEffect, RowPatcher};
use super::{Overlay, PatchRow, Target};
use crate::collections::{HashMap, HashMapExt, HashSet};
use crate::diagnostics::{codes, Diagnostic, Diagnostics};
use crate::frontend::Overlay as ReadOverlay;
use crate::ir::object_names::{item_name, name_conditions};
use crate::ir::{
    Bus, Buses, Catalog, CodeRow, CodeTable, CompactString, Device, Doubts, Group, Identity, Item, Module, ModuleId,
    ObjectBuses, Submodule, SubmoduleId, SubmoduleUse, TypeDef,
};
use crate::number::hex32;
use crate::source::{FileId, Source, Span};
use crate::text::glob;
use crate::text::{brief, similar};

/// Reads an overlay. Returns the function that applies it, or `None` if the file has no `[overlay]` or is not valid TOML.
pub(crate) fn read<'s>(source: &'s Source, file: FileId, diagnostics: &mut Diagnostics) -> Option<ReadOverlay<'s>> {
    let overlay = Overlay::read(&mut Reader::new(source, file, diagnostics));
    diagnostics.forget_repeated(|other| other == file);
    let overlay = overlay?;
    Some(Box::new(move |catalog, diagnostics| {
        let mut reader = Reader::new(source, file, diagnostics);
        reader.language.clone_from(&overlay.patch.language);
        Applied::new(&overlay).run(&mut reader, catalog);
        // An error in a row is reported again for each device, so repeated diagnostics are removed.
        diagnostics.forget_repeated(|other| other == file);
    }))
}

/// State of an overlay while it is applied.
struct Applied<'o> {
    patcher: RowPatcher<'o>,
    /// Maximum effect of each row on all devices, modules and submodules so far.
    effects: Vec<RowEffect>,
    /// Definitions that rows have used so far.
    used: HashSet<(DefinitionKind, String)>,
    /// Names of items, for suggestions in messages.
    names: Vec<CompactString>,
}

impl<'o> Applied<'o> {
    fn new(overlay: &'o Overlay) -> Self {
        let effects = vec![RowEffect::NoMatch; overlay.patch.rows.len()];
        let patcher = RowPatcher { overlay, rows: overlay.patch.filler() };
        Applied { patcher, effects, used: HashSet::default(), names: Vec::new() }
    }

    fn run(&mut self, reader: &mut Reader<'_, '_>, catalog: &mut Catalog) {
        let everything = AppliesTable::default();
        let applies = self.patcher.overlay.head.value.applies.as_ref().unwrap_or(&everything);
        let count = match &applies.module {
            Some(pattern) => {
                self.behavior_of_module(reader);
                self.modules(reader, catalog, applies, &pattern.to_lowercase())
            }
            None => self.devices(reader, catalog, applies),
        };
        reader.diagnostics.allow(std::mem::take(&mut self.patcher.rows.allowed));
        if count > 0 {
            return self.report(reader);
        }
        let what = if applies.module.is_some() { "module" } else { "device" };
        let message = format!("the overlay matches no {what} of the description");
        let mut found = codes::OVERLAY_NOT_FOR.at(reader.span(&self.patcher.overlay.head), message);
        if let Some(device) = catalog.devices.first() {
            found = found.note(format!("the description contains {}", described(device)));
        }
        reader.diagnostics.push(found);
    }

    /// Applies the overlay to the selected devices, and returns their number.
    fn devices(&mut self, reader: &mut Reader<'_, '_>, catalog: &mut Catalog, applies: &AppliesTable) -> usize {
        let others = OtherDevices::new(catalog, applies);
        let Catalog { devices, submodules, types, .. } = catalog;
        let mut count = 0;
        // Several devices may share a submodule, which must be changed only once.
        let mut done = HashSet::default();
        for device in devices.iter_mut().filter(|device| is_for(device, applies)) {
            count += 1;
            self.device(reader, device);
            for usage in device.submodules.iter().filter(|usage| done.insert(usage.submodule)) {
                if let Some(submodule) = submodules.get_mut(usage.submodule.0 as usize) {
                    if self.submodule(reader, submodule, types) == RowEffect::Changed {
                        let other = others.submodules.get(&usage.submodule);
                        self.shared(reader, &submodule.name, other);
                    }
                }
            }
        }
        count
    }

    fn submodule(
        &mut self,
        reader: &mut Reader<'_, '_>,
        submodule: &mut Submodule,
        types: &mut Vec<TypeDef>,
    ) -> RowEffect {
        let effect = self.apply_rows(reader, ObjectSet::of_submodule(submodule, types));
        self.resolve(reader, &mut submodule.records, types);
        effect
    }

    /// Applies the overlay to the objects of a module, and returns the maximum effect of the rows.
    fn module(&mut self, reader: &mut Reader<'_, '_>, module: &mut Module) -> RowEffect {
        let buses = buses_of_module(module);
        let Module { groups, fixed_objects, types, extensions, .. } = module;
        let effect = self.apply_rows(reader, ObjectSet { groups, types, extensions, buses });
        let effect = effect.max(self.apply_rows(reader, ObjectSet { groups: fixed_objects, types, extensions, buses }));
        // ETG.2000 modules have `groups`, and CiA 306 modules have `fixed_objects`. One of the two lists is empty, so
        // the joined list is sorted.
        let count = groups.len();
        groups.append(fixed_objects);
        self.resolve(reader, groups, types);
        *fixed_objects = groups.split_off(count);
        effect
    }

    /// Looks up the names in rows and definitions among the items of the module or submodule, and reports unknown
    /// names.
    fn resolve(&mut self, reader: &mut Reader<'_, '_>, groups: &mut Vec<Group>, types: &mut Vec<TypeDef>) {
        let mut device = Device { groups: std::mem::take(groups), types: std::mem::take(types), ..Device::default() };
        resolve(reader, &self.patcher.rows, &device);
        (*groups, *types) = (std::mem::take(&mut device.groups), std::mem::take(&mut device.types));
    }

    /// Reports that a changed module or submodule is also part of a device that the overlay does not select.
    fn shared(&self, reader: &mut Reader<'_, '_>, name: &str, other: Option<&CompactString>) {
        let Some(other) = other else { return };
        let (name, other) = (brief(name), brief(other));
        let message = format!("`{name}` is also a part of `{other}`, which `for` of the overlay does not select");
        let found = codes::OVERLAY_SHARED.at(reader.span(&self.patcher.overlay.head), message);
        reader.diagnostics.push(found.label("also changed in the other device"));
    }

    fn device(&mut self, reader: &mut Reader<'_, '_>, device: &mut Device) {
        let buses = buses_of(device);
        let Device { groups, types, extensions, .. } = device;
        self.apply_rows(reader, ObjectSet { groups, types, extensions, buses });
        let patch = &self.patcher.overlay.patch;
        if let Some(axes) = &patch.axes {
            device::axes(reader, axes, device);
        }
        for (name, table) in &patch.codes {
            code_tables::table(reader, name, table, device);
            merge(&mut device.code_tables, &self.change(reader, reader.origin(name).line));
        }
        let mut budget = MachineBudget::new();
        for (name, table) in &patch.machines {
            let before = device.machines.len();
            let replaces = device.machines.iter().any(|machine| machine.name == name.value);
            if !machines::machine(reader, name, table, device, &mut budget) {
                break;
            }
            // The new machine replaces an earlier machine with the same name.
            let mut at = 0..;
            device.machines.retain(|machine| at.next().is_some_and(|at| at >= before) || machine.name != name.value);
            if let Some(machine) = device.machines.last_mut() {
                machine.status_item = item_name(&device.groups, &machine.status_item);
                machine.control_item = item_name(&device.groups, &machine.control_item);
                let change = self.change(reader, reader.origin(name).line);
                machine.stated_by = Some(Box::new(change.origin(replaces)));
            }
        }
        for (name, table) in &patch.procedures {
            device.procedures.retain(|procedure| procedure.name != name.value);
            machines::procedure(reader, name, table, device);
        }
        device.doubts.extend(self.overlay_doubts(reader));
        resolve(reader, &self.patcher.rows, device);
    }

    /// Returns the change that the definition on the line `line` of the overlay makes.
    fn change(&self, reader: &Reader<'_, '_>, line: u32) -> Change {
        let why = self.patcher.overlay.head.value.why.as_deref().unwrap_or_default().into();
        Change { file: file_name(reader), line, why }
    }

    /// Returns the ambiguities that concern the whole overlay.
    fn overlay_doubts(&self, reader: &mut Reader<'_, '_>) -> Doubts {
        let given = self.patcher.overlay.patch.doubts.iter();
        given.map(|doubt| reader.doubt(&doubt.value, reader.origin(doubt), None)).collect()
    }

    /// Reports axes, codes, machines and procedures in an overlay for modules. Only an overlay for devices can have these keys.
    fn behavior_of_module(&self, reader: &mut Reader<'_, '_>) {
        let patch = &self.patcher.overlay.patch;
        let axes = patch.axes.iter().map(|axes| ("axes", reader.span(axes)));
        let codes = patch.codes.iter().map(|(name, _)| ("codes", reader.span(name)));
        let machines = patch.machines.iter().map(|(name, _)| ("machines", reader.span(name)));
        let procedures = patch.procedures.iter().map(|(name, _)| ("procedures", reader.span(name)));
        let all: Vec<_> = axes.chain(codes).chain(machines).chain(procedures).collect();
        for (key, span) in all {
            let message = format!("a module cannot have `{key}`, because they belong to its device");
            let found = codes::TABLE_VALUE.at(span, message);
            reader.diagnostics.push(found.help("move the table to an overlay whose `for` has no `module`"));
        }
    }

    /// Applies the overlay to the selected modules and submodules, and returns their number.
    fn modules(
        &mut self,
        reader: &mut Reader<'_, '_>,
        catalog: &mut Catalog,
        applies: &AppliesTable,
        pattern: &str,
    ) -> usize {
        let takes = |position: usize| -> bool {
            let has = |device: &Device| device.modules.iter().any(|usage| usage.module.0 as usize == position);
            !says_device(applies) || catalog.devices.iter().any(|device| is_for(device, applies) && has(device))
        };
        let wanted: Vec<bool> = catalog
            .modules
            .iter()
            .enumerate()
            .map(|(position, module)| is_called(pattern, [&module.name, &module.id], module.number) && takes(position))
            .collect();
        let chosen = |wanted: &[bool], position: usize| wanted.get(position).copied().unwrap_or(false);
        let parts =
            |uses: &[SubmoduleUse]| -> Vec<usize> { uses.iter().map(|usage| usage.submodule.0 as usize).collect() };
        let modules = catalog.modules.iter().enumerate().filter(|(position, _)| chosen(&wanted, *position));
        let of_modules: HashSet<usize> = modules.flat_map(|(_, module)| parts(&module.submodules)).collect();
        let others = OtherDevices::new(catalog, applies);
        let Catalog { devices, modules, submodules, types, .. } = catalog;
        let mut count = 0;
        for (position, module) in modules.iter_mut().enumerate().filter(|(position, _)| chosen(&wanted, *position)) {
            count += 1;
            if self.module(reader, module) == RowEffect::Changed {
                self.shared(reader, &module.name, others.modules.get(&ModuleId(position as u32)));
            }
        }
        for (position, submodule) in submodules.iter_mut().enumerate() {
            let is_called = is_called(pattern, [&submodule.name, &submodule.id], submodule.ident);
            if of_modules.contains(&position) || (is_called && !says_device(applies)) {
                count += 1;
                if self.submodule(reader, submodule, types) == RowEffect::Changed {
                    self.shared(reader, &submodule.name, others.submodules.get(&SubmoduleId(position as u32)));
                }
            }
        }
        let doubts = if count > 0 { self.overlay_doubts(reader) } else { Doubts::new() };
        // In the IR, a module has no list of ambiguities. The ambiguities go to the selected devices that have the module. If no
        // selected device has the module, they go to all selected devices.
        let takes = |device: &Device| device.modules.iter().any(|usage| chosen(&wanted, usage.module.0 as usize));
        let any_takes = devices.iter().any(|device| is_for(device, applies) && takes(device));
        for device in devices.iter_mut().filter(|device| is_for(device, applies) && (takes(device) || !any_takes)) {
            device.doubts.extend(doubts.iter().cloned());
        }
        count
    }

    /// Applies the rows to the groups of a device, module or submodule. Returns the maximum effect of the rows.
    fn apply_rows(&mut self, reader: &mut Reader<'_, '_>, mut set: ObjectSet<'_>) -> RowEffect {
        let items = set.groups.iter().flat_map(|group| &group.items);
        self.names.extend(items.map(|item| item.name.clone()));
        let made = set.types.len();
        self.patcher.rows.definitions.types = std::mem::take(set.types);
        self.patcher.rows.definitions.made.clear();
        self.patcher.rows.buses = Buses::from_iter([Bus::Modbus, Bus::Profinet, Bus::Serial]).or(set.buses.into());
        let overlay = self.patcher.overlay;
        let mut best = RowEffect::NoMatch;
        for (position, row) in overlay.patch.rows.iter().enumerate() {
            self.patcher.rows.allow(reader, &row.key, &row.row);
            let effect = self.patcher.row(reader, &mut set, row);
            best = best.max(effect);
            if let Some(best_so_far) = self.effects.get_mut(position) {
                *best_so_far = (*best_so_far).max(effect);
            }
        }
        let names = self.patcher.rows.definitions.made.keys().cloned();
        self.used.extend(names);
        *set.types = std::mem::take(&mut self.patcher.rows.definitions.types);
        let new = set.types.get_mut(made..).unwrap_or_default();
        for definition in &mut *new {
            let line = definition.origin.line;
            definition.stated_by = Some(Box::new(self.change(reader, line).origin(false)));
        }
        name_conditions(set.groups, new, &|_| None);
        best
    }

    /// Reports rows that match nothing or change nothing, and definitions that no row uses.
    fn report(&self, reader: &mut Reader<'_, '_>) {
        let errors = reader.diagnostics.error_spans();
        for (row, effect) in self.patcher.overlay.patch.rows.iter().zip(&self.effects) {
            let span = Span { end: row.row.end, ..reader.span(&row.key) };
            if errors.any_in(span) {
                continue;
            }
            match effect {
                RowEffect::NoMatch => self.no_match(reader, row),
                RowEffect::NoChange => {
                    let message =
                        format!("the description already contains everything in the row `{}`", brief(&row.key.value));
                    let found = codes::OVERLAY_NO_CHANGE.at(reader.span(&row.key), message);
                    reader.diagnostics.push(found.label("the row changes nothing"));
                }
                RowEffect::Changed => {}
            }
        }
        // Unused definitions are not reported if a row matches nothing or has an error, because this row might use them.
        let whole = Span::new(reader.file, 0, u32::MAX);
        if self.effects.contains(&RowEffect::NoMatch) || reader.diagnostics.error_spans().any_in(whole) {
            return;
        }
        let definitions = &self.patcher.overlay.patch.definitions;
        let enums = definitions.enums.names().map(|name| (DefinitionKind::Enumeration, name));
        let all = enums.chain(definitions.bits.names().map(|name| (DefinitionKind::Bits, name)));
        let unused = all.filter(|(kind, name)| !self.used.contains(&(*kind, name.value.clone()))).map(|(_, name)| name);
        let rows = || self.patcher.overlay.patch.rows.iter().filter_map(|row| row.row.value.unit.as_ref());
        let units = definitions.units.names();
        let units = units.filter(|name| !rows().any(|unit| unit.value == name.value));
        for name in unused.chain(units) {
            let message = format!("no row of the overlay uses the definition `{}`", brief(&name.value));
            reader.report(&codes::OVERLAY_NO_MATCH, reader.span(name), message);
        }
    }

    fn no_match(&self, reader: &mut Reader<'_, '_>, row: &PatchRow) {
        let key = brief(&row.key.value);
        let (message, help) = match row.target {
            Target::Objects(_) => {
                let help = "write `add = true` to add the object to the description";
                let help = (row.row.value.remove != Some(true)).then(|| help.to_owned());
                (format!("the description has no object `{key}`"), help)
            }
            Target::Name => {
                let names = self.names.iter().map(CompactString::as_str).take_while(|_| reader.helps());
                let help = similar(&row.key.value, names).map(|name| format!("did you mean `{name}`?"));
                (format!("no item has the name `{key}`"), help)
            }
        };
        let found = codes::OVERLAY_NO_MATCH.at(reader.span(&row.key), message);
        reader.diagnostics.push(Diagnostic { help, ..found });
    }
}

/// Modules and submodules of the devices that the overlay does not select, each with the name of the first of these devices that
/// has it.
struct OtherDevices {
    modules: HashMap<ModuleId, CompactString>,
    submodules: HashMap<SubmoduleId, CompactString>,
}

impl OtherDevices {
    fn new(catalog: &Catalog, applies: &AppliesTable) -> Self {
        let mut others = OtherDevices { modules: HashMap::default(), submodules: HashMap::default() };
        for device in catalog.devices.iter().filter(|device| !is_for(device, applies)) {
            others.submodules(&device.submodules, device);
            for plugged in &device.modules {
                let is_new = !others.modules.contains_key(&plugged.module);
                if let Some(module) = catalog.modules.get(plugged.module.0 as usize).filter(|_| is_new) {
                    others.modules.insert(plugged.module, device.name.clone());
                    others.submodules(&module.submodules, device);
                }
            }
        }
        others
    }

    fn submodules(&mut self, uses: &[SubmoduleUse], device: &Device) {
        for usage in uses {
            self.submodules.entry(usage.submodule).or_insert_with(|| device.name.clone());
        }
    }
}

impl<'c> ObjectSet<'c> {
    fn of_submodule(submodule: &'c mut Submodule, types: &'c mut Vec<TypeDef>) -> Self {
        let buses = ObjectBuses::NONE;
        ObjectSet { groups: &mut submodule.records, types, extensions: &mut submodule.extensions, buses }
    }
}

/// Merges the last table of codes into an earlier table with the same name. If both tables contain a code, the row of
/// the last table applies. The overlay is recorded as the origin of a new table, or of added and changed rows.
fn merge(tables: &mut Vec<CodeTable>, change: &Change) {
    let Some(last) = tables.pop() else { return };
    let Some(table) = tables.iter_mut().find(|table| table.name == last.name) else {
        tables.push(CodeTable { stated_by: Some(Box::new(change.origin(false))), ..last });
        return;
    };
    table.doubts.extend(last.doubts);
    let rows = table.rows.to_mut();
    let mut known: HashMap<(i128, Option<i128>), usize> = HashMap::with_capacity(rows.len());
    for (position, row) in rows.iter().enumerate() {
        known.entry((row.code, row.last)).or_insert(position);
    }
    for row in &last.rows {
        let position = *known.entry((row.code, row.last)).or_insert(rows.len());
        let replaces = position < rows.len();
        let row = CodeRow { stated_by: Some(Box::new(change.origin(replaces))), ..row.clone() };
        match rows.get_mut(position) {
            Some(earlier) => *earlier = row,
            None => rows.push(row),
        }
    }
}

/// Returns whether the overlay selects devices by their identity or name.
fn says_device(applies: &AppliesTable) -> bool {
    let numbers = [applies.vendor_id, applies.product_code, applies.revision];
    applies.device.is_some() || numbers.iter().any(Option::is_some)
}

fn is_for(device: &Device, applies: &AppliesTable) -> bool {
    let Identity { vendor_id, product_code, revision_number, product_name, order_code, .. } = &device.identity;
    let numbers =
        [(applies.vendor_id, *vendor_id), (applies.product_code, *product_code), (applies.revision, *revision_number)];
    let names = [&device.name, product_name, order_code, &device.id];
    let by_name = |pattern: &String| names.iter().any(|name| glob(&pattern.to_lowercase(), &name.to_lowercase()));
    numbers.iter().all(|(wanted, actual)| wanted.is_none() || wanted == actual)
        && applies.device.as_ref().is_none_or(by_name)
}

/// Returns whether `pattern` matches the name, identifier or number of a module or submodule.
fn is_called(pattern: &str, names: [&CompactString; 2], number: u32) -> bool {
    let by_number = super::super::notation::range(pattern).is_some_and(|(first, _)| first == i128::from(number));
    by_number || names.iter().any(|name| glob(pattern, &name.to_lowercase()))
}

fn described(device: &Device) -> String {
    let number = |number: Option<u32>| number.map_or("unknown".to_owned(), hex32);
    let Identity { vendor_id, product_code, revision_number, .. } = device.identity;
    let (vendor, product, revision) = (number(vendor_id), number(product_code), number(revision_number));
    format!("`{}`: vendor {vendor}, product code {product}, revision {revision}", brief(&device.name))
}

/// Returns the buses for objects that an overlay adds to a device.
fn buses_of(device: &Device) -> ObjectBuses {
    let by_items = buses_of_items(&device.groups);
    let coe = device.ethercat.is_some() || device.dictionary_only;
    by_items.unwrap_or(ObjectBuses { canopen: !coe, coe })
}

fn buses_of_module(module: &Module) -> ObjectBuses {
    buses_of_items(&module.groups).or(buses_of_items(&module.fixed_objects)).unwrap_or(ObjectBuses::COE)
}

fn buses_of_items(groups: &[Group]) -> Option<ObjectBuses> {
    let of_item = |item: &Item| {
        item.bindings.iter().find_map(|binding| match binding {
            crate::ir::Binding::Object { buses, .. } => Some(*buses),
            _ => None,
        })
    };
    groups.iter().flat_map(|group| &group.items).find_map(of_item)
}
