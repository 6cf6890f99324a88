//! Replaces the placeholders in names and descriptions with texts.
//!
//! Before the text list is read, a name in the IR is a placeholder: the number of a reference. A space and a suffix may
//! follow the number.

use std::borrow::Cow;
use std::sync::Arc;

use compact_str::{format_compact, CompactString};

use super::text_list::TextList;
use crate::collections::{HashMap, HashSet};
use crate::diagnostics::{codes, Diagnostics};
use crate::frontend::xml::Given;
use crate::ir::{
    Catalog, Device, Documentation, Group, LocalText, Module, Shape, Submodule, Texts, TypeDef, UnitDiagnosis,
};
use crate::limits;
use crate::source::Span;
use crate::text::brief;

/// Replaces all placeholders in the names and descriptions of a catalog.
pub(super) fn catalog(catalog: &mut Catalog, resolver: &mut Resolver<'_, '_>) {
    catalog.devices.iter_mut().for_each(|found| device(found, resolver));
    catalog.modules.iter_mut().for_each(|found| module(found, resolver));
    catalog.submodules.iter_mut().for_each(|found| submodule(found, resolver));
    catalog.types.iter_mut().for_each(|def| type_def(def, resolver));
    for row in catalog.code_tables.iter_mut().flat_map(|table| table.rows.to_mut()) {
        resolver.name(&mut row.name, &mut row.names);
        resolver.documentation(&mut row.documentation);
    }
    catalog.unit_diagnoses.iter_mut().for_each(|found| unit_diagnosis(found, resolver));
    for family in &mut catalog.families {
        resolver.name(&mut family.name, &mut family.names);
        resolver.descriptions(&mut family.descriptions);
    }
}

fn device(device: &mut Device, resolver: &mut Resolver<'_, '_>) {
    resolver.name(&mut device.name, &mut device.names);
    resolver.documentation(&mut device.documentation);
    resolver.names(device.slots.iter_mut().map(|slot| (&mut slot.name, &mut slot.names)));
    let Some(settings) = &mut device.profinet else { return };
    resolver.names(settings.subslot_names.iter_mut().map(|subslot| (&mut subslot.name, &mut subslot.names)));
    for block in &mut settings.vendor_blocks {
        record(&mut block.record, resolver);
        resolver.names(block.menus.iter_mut().map(|menu| (&mut menu.name, &mut menu.names)));
    }
}

fn module(module: &mut Module, resolver: &mut Resolver<'_, '_>) {
    resolver.name(&mut module.name, &mut module.names);
    resolver.documentation(&mut module.documentation);
    resolver.names(module.subslot_names.iter_mut().map(|subslot| (&mut subslot.name, &mut subslot.names)));
}

fn submodule(submodule: &mut Submodule, resolver: &mut Resolver<'_, '_>) {
    resolver.name(&mut submodule.name, &mut submodule.names);
    resolver.documentation(&mut submodule.documentation);
    for data in [&mut submodule.input, &mut submodule.output].into_iter().flatten() {
        resolver.names(data.image.fields.iter_mut().map(|field| (&mut field.name, &mut field.names)));
        resolver.names(data.items.iter_mut().map(|item| (&mut item.name, &mut item.names)));
    }
    submodule.records.iter_mut().for_each(|group| record(group, resolver));
    resolver.names(submodule.menus.iter_mut().map(|menu| (&mut menu.name, &mut menu.names)));
}

fn record(group: &mut Group, resolver: &mut Resolver<'_, '_>) {
    resolver.name(&mut group.name, &mut group.names);
    resolver.names(group.items.iter_mut().map(|item| (&mut item.name, &mut item.names)));
}

fn type_def(def: &mut TypeDef, resolver: &mut Resolver<'_, '_>) {
    resolver.documentation(&mut def.documentation);
    if let Shape::Enumeration { values, .. } = &mut def.shape {
        resolver.names(values.iter_mut().map(|value| (&mut value.name, &mut value.names)));
    }
}

fn unit_diagnosis(diagnosis: &mut UnitDiagnosis, resolver: &mut Resolver<'_, '_>) {
    resolver.name(&mut diagnosis.name, &mut diagnosis.names);
    resolver.documentation(&mut diagnosis.documentation);
    resolver.names(diagnosis.fields.iter_mut().map(|field| (&mut field.name, &mut field.names)));
}

/// Replaces placeholders with the texts to which they refer.
pub(super) struct Resolver<'a, 'd> {
    pub list: TextList<'a>,
    references: Vec<Given<'a>>,
    pub diagnostics: &'d mut Diagnostics,
    /// Texts with a suffix, by text identifier and suffix.
    suffixed: HashMap<(Cow<'a, str>, CompactString), (CompactString, Texts)>,
    /// Numbers of the references whose missing texts were reported. Each reference is reported once, although several
    /// elements of the IR may have it.
    missing: HashSet<usize>,
    /// Remaining number of text bytes that may be copied.
    budget: usize,
}

impl<'a, 'd> Resolver<'a, 'd> {
    /// Creates a resolver for a file of `length` bytes.
    pub fn new(
        list: TextList<'a>,
        references: Vec<Given<'a>>,
        length: usize,
        diagnostics: &'d mut Diagnostics,
    ) -> Self {
        let budget = limits::MAX_TEXT_COPIES_PER_BYTE.saturating_mul(length).max(limits::MIN_TEXT_COPIES);
        Resolver { list, references, diagnostics, suffixed: HashMap::default(), missing: HashSet::default(), budget }
    }

    /// Returns the text list and the diagnostics, and frees all other memory.
    pub fn into_list(self) -> (TextList<'a>, &'d mut Diagnostics) {
        (self.list, self.diagnostics)
    }

    /// Replaces the placeholder in `name` with its text, or with the text identifier if the text is missing or the budget
    /// is too small. Stores the translations of the text in `names`.
    pub fn name(&mut self, name: &mut CompactString, names: &mut Texts) {
        let digits = name.bytes().take_while(u8::is_ascii_digit).count();
        let (placeholder, suffix) = name.split_at(digits);
        let suffix = suffix.trim_start_matches(' ');
        if placeholder.is_empty() {
            *name = suffix.into();
            return;
        }
        let Some(at) = placeholder.parse::<usize>().ok() else { return };
        let Some(given) = self.references.get(at).cloned() else { return };
        let found = match suffix {
            "" => self.list.find(&given.text),
            _ => self.with_suffix(&given, suffix.into()),
        };
        if let Some((text, texts)) = found {
            if self.spend(text.len(), given.span) {
                (*name, *names) = (text, texts);
                return;
            }
        } else if self.missing.insert(at) {
            let message = format!("the text `{}` is not in the text list", brief(&given.text));
            self.diagnostics
                .push(codes::MISSING_TEXT.at(given.span, message).label("the identifier is used as the name"));
        }
        *name = match suffix {
            "" => given.text.as_ref().into(),
            _ => format_compact!("{} {suffix}", given.text),
        };
    }

    fn with_suffix(&mut self, given: &Given<'a>, suffix: CompactString) -> Option<(CompactString, Texts)> {
        let key = (given.text.clone(), suffix);
        if let Some(found) = self.suffixed.get(&key) {
            return Some(found.clone());
        }
        let (text, texts) = self.list.find(&given.text)?;
        let with = |text: &str| format_compact!("{text} {}", key.1);
        let names = texts.iter().map(|local| LocalText { language: local.language.clone(), text: with(&local.text) });
        let found = (with(&text), names.collect());
        self.suffixed.insert(key, found.clone());
        Some(found)
    }

    /// Replaces the placeholders in several names.
    fn names<'n>(&mut self, names: impl Iterator<Item = (&'n mut CompactString, &'n mut Texts)>) {
        names.for_each(|(name, names)| self.name(name, names));
    }

    /// Subtracts `length` bytes from the budget for copied texts, without which many references could multiply a long
    /// text. Returns false if the budget is too small. Only the first excess of the budget is reported.
    pub fn spend(&mut self, length: usize, span: Span) -> bool {
        if let Some(rest) = self.budget.checked_sub(length) {
            self.budget = rest;
            return true;
        }
        if std::mem::take(&mut self.budget) > 0 {
            let message = "copied texts would exceed the size limit of the description";
            self.diagnostics
                .push(codes::INPUT_TOO_LARGE.at(span, message).label("identifiers are used as further names"));
        }
        false
    }

    /// Replaces the placeholder in a description with its text and translations.
    pub fn documentation(&mut self, documentation: &mut Option<Arc<Documentation>>) {
        let Some(documentation) = documentation.as_mut().map(Arc::make_mut) else { return };
        let mut text = CompactString::from(&*documentation.text);
        self.name(&mut text, &mut documentation.translations);
        documentation.text = text.into();
    }

    /// Replaces each placeholder in a list of descriptions with its text in all languages.
    pub fn descriptions(&mut self, descriptions: &mut Vec<LocalText>) {
        for LocalText { text: mark, .. } in std::mem::take(descriptions) {
            let (mut text, mut texts) = (mark.clone(), Texts::default());
            self.name(&mut text, &mut texts);
            descriptions.push(LocalText { language: "en".into(), text });
            // The translations are further copies, which the budget must allow.
            let given = mark.parse().ok().and_then(|at: usize| self.references.get(at)).cloned();
            let length = texts.iter().map(|local| local.text.len() + std::mem::size_of::<LocalText>()).sum();
            if given.is_some_and(|given| self.spend(length, given.span)) {
                descriptions.extend(texts.iter().cloned());
            }
        }
    }
}
