//! Reads modules, and finds the slots into which they fit.

use std::collections::BTreeMap;

use super::description::OtherFiles;
use super::dictionary::missing_index;
use super::lower::lower;
use super::mailbox;
use super::pdos::Pdos;
use super::profile::Profiles;
use super::reader::{Names, Reader};
use crate::collections::HashMap;
use crate::diagnostics::{codes, Diagnostics};
use crate::frontend::xml::Read;
use crate::ir::{Catalog, CompactString, Device, Fit, Module, ModuleId, ModuleUse, Numbers, SlotNumbers};
use crate::limits;
use crate::number::hex32;
use crate::syntax::xml::Tag;

/// Reads a `Module` element. Also returns the references to other files, the types of PDO entries that these files may define, and
/// the diagnosis messages.
pub(super) fn read<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>) -> Read<(Module, OtherFiles)> {
    let start = reader.extensions.len();
    let mut module = Module { origin: reader.origin(parent), ..Module::default() };
    let [] = reader.attributes(parent, [])?;
    let (mut names, mut pdos, mut profiles) = (Names::default(), Pdos::default(), Profiles::default());
    let mut has_type = false;
    while let Some(tag) = reader.child(parent)? {
        match tag.name {
            "Type" => {
                has_type = true;
                module_type(reader, &tag, &mut module)?;
            }
            "Name" => reader.name(&tag, &mut names)?,
            "RxPdo" | "TxPdo" => pdos.read(reader, &tag)?,
            "Mailbox" => module.mailbox = Some(Box::new(mailbox::read(reader, &tag)?)),
            "Profile" => profiles.read(reader, &tag)?,
            "SafetyParaMapping" => reader.keep(&tag)?,
            "DcOpModeName" => module.clock_mode = reader.text(&tag)?.compact(),
            "Image16x14" | "ImageFile16x14" | "ImageData16x14" => reader.image(&tag)?,
            "VendorSpecific" => reader.vendor_specific(&tag)?,
            _ => reader.unknown(&tag)?,
        }
    }
    if !has_type {
        missing_index(reader, parent.span, "this module has no <Type> with an ident number");
    }
    (module.name, module.names) = (names.name(), names.others());
    module.profiles = profiles.numbers;
    module.add_info = reader.int(&profiles.add_info, "number");
    module.sub_add_info = reader.int(&profiles.sub_add_info, "number");
    module.extensions = reader.extensions_since(start);
    let lowered = lower(reader, profiles.dictionary, pdos, &mut module.process_data, &mut profiles.other_files);
    (module.types, module.groups) = lowered;
    profiles.other_files.messages = profiles.code_tables;
    Ok((module, profiles.other_files))
}

fn module_type<'a>(reader: &mut Reader<'a, '_>, tag: &Tag<'a>, module: &mut Module) -> Read<()> {
    const NAMES: [&str; 3] = ["ModuleIdent", "ModuleClass", "ModulePdoGroup"];
    let fields = reader.attributes(tag, NAMES)?;
    let [ident, class, group] = &fields;
    match reader.int(ident, "module ident number") {
        Some(ident) => module.number = ident,
        None if ident.is_empty() => missing_index(reader, tag.span, "this module has no ident number"),
        None => {}
    }
    module.class = class.compact();
    module.pdo_group = reader.int(group, "group number");
    let given = reader.content()?;
    module.id = given.compact();
    module.identity.order_code = given.compact();
    Ok(())
}

/// Adds to each device the modules of the catalog that fit into its slots.
pub(super) fn plug(catalog: &mut Catalog, diagnostics: &mut Diagnostics) {
    let Catalog { devices, modules, .. } = catalog;
    let known = Known::new(modules, diagnostics);
    let (mut left, mut is_reported) = (limits::MAX_MODULE_USES, false);
    for device in devices {
        if !known.plug(device, &mut left, &mut is_reported, diagnostics) {
            let message = "the slots of all devices accept more modules than the limit allows";
            let diagnostic = codes::INPUT_TOO_LARGE.at(device.origin.span, message);
            diagnostics.push(diagnostic.label("this and later devices have no modules"));
            return;
        }
    }
}

/// Positions of the modules in a catalog, by ident number and class.
struct Known<'m> {
    by_ident: HashMap<u32, Vec<u32>>,
    by_class: HashMap<&'m CompactString, Vec<u32>>,
    count: usize,
}

impl<'m> Known<'m> {
    fn new(modules: &'m [Module], diagnostics: &mut Diagnostics) -> Self {
        let mut known = Known { by_ident: HashMap::default(), by_class: HashMap::default(), count: modules.len() };
        for (at, module) in modules.iter().enumerate() {
            let same = known.by_ident.entry(module.number).or_default();
            let first = same.first().and_then(|&first| modules.get(first as usize));
            if let Some(first) = first.filter(|_| module.number != 0) {
                let message = format!("two modules have the ident number {}", hex32(module.number));
                let found = codes::DUPLICATE_MODULE.at(module.origin.span, message).label("both are kept");
                diagnostics.push(found.note_at(first.origin.span, "first module"));
            }
            same.push(at as u32);
            if !module.class.is_empty() {
                known.by_class.entry(&module.class).or_default().push(at as u32);
            }
        }
        known
    }

    /// Adds to a device the modules that fit into its slots. Subtracts the number of modules of each slot from `left`,
    /// and returns false without adding modules if `left` is too small.
    fn plug(
        &self,
        device: &mut Device,
        left: &mut usize,
        is_reported: &mut bool,
        diagnostics: &mut Diagnostics,
    ) -> bool {
        let mut places: BTreeMap<u32, SlotNumbers> = BTreeMap::new();
        for slot in &device.slots {
            let last = slot.number.saturating_add(slot.instances.1.max(1) - 1);
            let all: Vec<u32> = if slot.fits.is_empty() { (0..self.count as u32).collect() } else { Vec::new() };
            let mut missing = 0;
            let fitting = slot.fits.iter().map(|fit| match fit {
                Fit::Ident(ident) => self.by_ident.get(ident).map_or(&[][..], Vec::as_slice),
                Fit::Class(class) => self.by_class.get(class).map_or(&[][..], Vec::as_slice),
                Fit::Name(_) => &[],
            });
            for modules in fitting.chain([all.as_slice()]) {
                missing += usize::from(modules.is_empty());
                let Some(rest) = left.checked_sub(modules.len()) else { return false };
                *left = rest;
                for &module in modules {
                    push_range(&mut places.entry(module).or_default().allowed, slot.number, last);
                }
            }
            if missing > slot.fits.len() && !slot.fits.is_empty() {
                nothing_fits(device, slot.number, !std::mem::replace(is_reported, true), diagnostics);
            }
        }
        let uses = places.into_iter().map(|(module, places)| ModuleUse { module: ModuleId(module), places });
        device.modules.extend(uses);
        true
    }
}

/// Adds a range of slot numbers. Merges the new range with the last range if the two overlap or are adjacent.
fn push_range(numbers: &mut Numbers, first: u16, last: u16) {
    match numbers.0.last_mut() {
        Some(range) if range.1 >= first => range.1 = range.1.max(last),
        Some(range) if range.1.checked_add(1) == Some(first) => range.1 = last,
        _ => numbers.0.push((first, last)),
    }
}

/// Reports a slot into which no module fits. Only the first such diagnostic of a catalog has a help text.
fn nothing_fits(device: &Device, slot: u16, is_first: bool, diagnostics: &mut Diagnostics) {
    let message = format!("no module of this description fits into slot {slot}");
    let found = codes::NO_MODULE_FITS.at(device.origin.span, message).label("the slot stays empty");
    let help = "check whether InfoReference names a file with the modules";
    diagnostics.push(if is_first { found.help(help) } else { found });
}
