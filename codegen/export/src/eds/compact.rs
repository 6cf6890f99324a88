//! Objects of equal elements, which CiA 306 describes at once with CompactSubObj.

use crate::note;
use lexibus_codegen::ir::{Access, Group, Item, Limits, Mappable, ObjectCode, Type, Value};

/// The name that sub-index 0 has where nobody describes it (CiA 306).
const COUNT_NAME: &str = "NrOfObjects";

/// The elements of such an object.
pub(super) struct Elements<'g> {
    group: &'g Group,
    /// How many there are, sub-index 0 apart.
    pub(super) count: u8,
    /// What all of them are.
    pub(super) template: &'g Item,
}

/// The elements of `group`, if the source declares them at the object itself, and reading CompactSubObj gives just these.
///
/// Others that happen to be alike stay as they are: not every reader of EDS files knows CompactSubObj well.
pub(super) fn elements(group: &Group) -> Option<Elements<'_>> {
    let (count_item, items) = group.items.split_first()?;
    let count = u8::try_from(items.len()).ok().filter(|&count| (1..=254).contains(&count))?;
    let template = items.first()?;
    let is_in_place =
        |(item, sub): (&Item, u8)| item.origin == group.origin && item.object().is_some_and(|(_, own)| own == sub);
    let fits = group.object_code() == Some(ObjectCode::Array)
        && group.origin.line > 0
        && group.flags == template.flags
        && !matches!(template.ty, Type::Opaque(None))
        && group.items.iter().zip(0..=u8::MAX).all(is_in_place)
        && is_count(count_item, count)
        && items.iter().all(|item| is_like(item, template));
    fits.then_some(Elements { group, count, template })
}

/// Whether sub-index 0 is what follows from the number of elements.
fn is_count(item: &Item, count: u8) -> bool {
    item.name == COUNT_NAME
        && item.ty == Type::Unsigned(8)
        && item.access == Access::ReadOnly
        && item.mappable == Mappable::default()
        && item.default == Some(Value::Int(i128::from(count)))
        && item.limits == Limits::default()
        && item.flags == 0
        && item.configured.is_none()
        && says_nothing_more(item)
}

/// Whether two elements differ in nothing but name and configured value.
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
        && says_nothing_more(item)
}

/// Whether an element has nothing that would need a section of its own, or a note of its own.
fn says_nothing_more(item: &Item) -> bool {
    item.extensions.is_empty()
        && item.names.is_empty()
        && item.bindings.len() == 1
        && item.quantity.is_none()
        && item.behaviour.is_none()
        && item.availability.is_none()
        && note::relations(item) == 0
        && item.documentation.is_none()
        && item.doubts.is_empty()
}

impl Elements<'_> {
    fn numbered(&self) -> impl Iterator<Item = (u8, &Item)> {
        self.group.items.iter().skip(1).filter_map(|item| Some((item.object()?.1, item)))
    }

    /// Names that don't follow from the object's.
    pub(super) fn names(&self) -> Vec<(u8, String)> {
        let follows = |sub: u8, item: &Item| {
            let number = item.name.strip_prefix(self.group.name.as_str());
            number.is_some_and(|number| number == sub.to_string())
        };
        let others = self.numbered().filter(|&(sub, item)| !follows(sub, item));
        others.map(|(sub, item)| (sub, super::writer::quoted(&item.name).into_owned())).collect()
    }

    /// Configured values.
    pub(super) fn values(&self, text: impl Fn(&Value) -> Option<String>) -> Vec<(u8, String)> {
        let text = |item: &Item| text(item.configured.as_ref()?.value.as_ref()?);
        self.numbered().filter_map(|(sub, item)| Some((sub, text(item)?))).collect()
    }

    /// How many have something configured.
    pub(super) fn configured(&self) -> usize {
        self.numbered().filter(|(_, item)| item.configured.is_some()).count()
    }

    /// Names of elements in the application.
    pub(super) fn denotations(&self) -> Vec<(u8, String)> {
        let text = |item: &Item| Some(item.configured.as_ref()?.denotation.as_ref()?.to_string());
        self.numbered().filter_map(|(sub, item)| Some((sub, text(item)?))).collect()
    }
}
