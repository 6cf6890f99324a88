//! Collects texts of a register table: documentation, names, side effects and steps.

use super::{stated, CompactString, Device, Documentation, Item, LocalText, Shape, Step, TypeDef};
use crate::source::Span;

/// A text with its location.
pub(crate) struct Text<'a> {
    pub span: Span,
    /// Name of the element that has the text.
    pub of: &'a str,
    pub words: &'a str,
}

/// Returns the texts of the groups, items, types and procedures of a device, without texts from profiles.
pub(crate) fn all(device: &Device) -> Vec<Text<'_>> {
    let mut list = List(Vec::new());
    for group in &device.groups {
        // The texts of an object with a single value are those of its item, which are collected below.
        if group.items.is_empty() || group.object_code().is_none_or(|code| code.has_subs()) {
            let documentation = stated::description(&group.origins, group.documentation.as_deref());
            list.documented(group.origin.span, &group.name, documentation, &group.names);
        }
        group.items.iter().for_each(|item| list.item(item));
    }
    stated::types(&device.types).for_each(|(_, definition)| list.definition(definition));
    for procedure in &device.procedures {
        list.documented(procedure.origin.span, &procedure.name, procedure.documentation.as_deref(), &[]);
        for (step, span) in procedure.spanned() {
            if let Step::Manual(words) = step {
                list.push(span, &procedure.name, words);
            }
        }
    }
    list.0
}

struct List<'a>(Vec<Text<'a>>);

impl<'a> List<'a> {
    fn push(&mut self, span: Span, of: &'a str, words: &'a str) {
        if !words.is_empty() {
            self.0.push(Text { span, of, words });
        }
    }

    fn documented(
        &mut self,
        span: Span,
        of: &'a CompactString,
        documentation: Option<&'a Documentation>,
        names: &'a [LocalText],
    ) {
        if let Some(documentation) = documentation {
            self.push(span, of, &documentation.text);
        }
        names.iter().for_each(|name| self.push(span, of, &name.text));
    }

    fn item(&mut self, item: &'a Item) {
        let span = item.origin.span;
        let documentation = stated::description(&item.origins, item.documentation.as_deref());
        self.documented(item.at.others.documentation.or(span), &item.name, documentation, &item.names);
        let effects = stated::behavior(item).into_iter().flat_map(|behavior| &behavior.side_effects);
        effects.for_each(|effect| self.push(span, &item.name, effect));
    }

    fn definition(&mut self, definition: &'a TypeDef) {
        let span = definition.origin.span;
        if let Some(documentation) = &definition.documentation {
            self.push(span, &definition.name, &documentation.text);
        }
        match &definition.shape {
            Shape::BitField { fields, .. } => fields.iter().for_each(|field| {
                self.push(span, &definition.name, &field.name);
                self.documented(span, &field.name, field.documentation.as_deref(), &field.names);
            }),
            Shape::Enumeration { values, .. } => values.iter().for_each(|value| {
                self.push(span, &definition.name, &value.name);
                self.documented(span, &value.name, value.documentation.as_deref(), &value.names);
            }),
            _ => {}
        }
    }
}
