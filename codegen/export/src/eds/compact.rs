//! Objects whose elements are equal except for name and configured value. CiA 306 describes such an object in one
//! section with CompactSubObj.

use crate::note;
use lexibus_codegen::ir::{Access, Group, Item, Limits, Mappable, ObjectCode, Type, Value};

/// The default name of sub-index 0 in a compact object (CiA 306).
const COUNT_NAME: &str = "NrOfObjects";

/// The elements of a compact object.
pub(super) struct Elements<'g> {
    group: &'g Group,
    /// Number of elements, without sub-index 0.
    pub(super) count: u8,
    /// The first element. The other elements differ from it only in name and configured value.
    pub(super) template: &'g Item,
}

/// Returns the elements of `group` if the source declares them together and CompactSubObj can express them exactly.
///
/// All other objects get one section per element, because not all EDS readers support CompactSubObj.
pub(super) fn elements(group: &Group) -> Option<Elements<'_>> {
    let (count_item, items) = group.items.split_first()?;
    let count = u8::try_from(items.len()).ok().filter(|&count| (1..=254).contains(&count))?;
    let template = items.first()?;
    let is_consecutive =
        |(item, sub): (&Item, u8)| item.origin == group.origin && item.object().is_some_and(|(_, index)| index == sub);
    let fits = group.object_code() == Some(ObjectCode::Array)
        && group.origin.line > 0
        && group.flags == template.flags
        && !matches!(template.ty, Type::Opaque(None))
        && group.items.iter().zip(0..=u8::MAX).all(is_consecutive)
        && is_count(count_item, count)
        && items.iter().all(|item| is_like(item, template));
    fits.then_some(Elements { group, count, template })
}

/// Returns whether sub-index 0 has the value and properties that CompactSubObj implies.
fn is_count(item: &Item, count: u8) -> bool {
    item.name == COUNT_NAME
        && item.ty == Type::Unsigned(8)
        && item.access == Access::ReadOnly
        && item.mappable == Mappable::default()
        && item.default == Some(Value::Int(i128::from(count)))
        && *item.limits == Limits::default()
        && item.flags == 0
        && item.configured.is_none()
        && has_no_other_facts(item)
}

/// Returns whether `item` differs from `other` only in name and configured value, and CompactSubObj can express its
/// facts.
fn is_like(item: &Item, other: &Item) -> bool {
    let is_configured_alike = item
        .configured
        .as_ref()
        .is_none_or(|configured| configured.upload_file.is_none() && configured.download_file.is_none());
    item.ty == other.ty
        && item.access == other.access
        && item.mappable == other.mappable
        && item.default == other.default
        && item.limits == other.limits
        && item.flags == other.flags
        && is_configured_alike
        && !item.name.is_empty()
        && has_no_other_facts(item)
}

/// Returns whether an element has no fact that requires a separate section or a note.
fn has_no_other_facts(item: &Item) -> bool {
    item.extensions.is_empty()
        && item.names.is_empty()
        && item.bindings.len() == 1
        && item.quantity.is_none()
        && item.behavior.is_none()
        && item.availability.is_none()
        && note::relations(item) == 0
        && item.documentation.is_none()
        && item.doubts.is_empty()
}

impl Elements<'_> {
    fn numbered(&self) -> impl Iterator<Item = (u8, &Item)> {
        self.group.items.iter().skip(1).filter_map(|item| Some((item.object()?.1, item)))
    }

    /// Returns the sub-index and the name of each element whose name is not the one that CompactSubObj implies.
    pub(super) fn names(&self) -> Vec<(u8, String)> {
        let follows = |sub: u8, item: &Item| {
            let number = item.name.strip_prefix(self.group.name.as_str());
            number.is_some_and(|number| number == sub.to_string())
        };
        let others = self.numbered().filter(|&(sub, item)| !follows(sub, item));
        others.map(|(sub, item)| (sub, super::writer::quoted(&item.name).into_owned())).collect()
    }

    /// Returns the sub-index and the text of each configured value of the elements.
    pub(super) fn values(&self, text: impl Fn(&Value) -> Option<String>) -> Vec<(u8, String)> {
        let text = |item: &Item| text(item.configured.as_ref()?.value.as_ref()?);
        self.numbered().filter_map(|(sub, item)| Some((sub, text(item)?))).collect()
    }

    /// Returns the number of elements with a configured value or a denotation.
    pub(super) fn configured(&self) -> usize {
        self.numbered().filter(|(_, item)| item.configured.is_some()).count()
    }

    /// Returns the sub-index and the denotation (the name in the application) of each element that has one.
    pub(super) fn denotations(&self) -> Vec<(u8, String)> {
        let text = |item: &Item| Some(item.configured.as_ref()?.denotation.as_ref()?.to_string());
        self.numbered().filter_map(|(sub, item)| Some((sub, text(item)?))).collect()
    }
}
