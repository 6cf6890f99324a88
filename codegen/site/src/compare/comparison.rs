//! The state of a comparison and the functions that compare fields.

use std::borrow::Borrow;
use std::collections::HashSet;
use std::fmt::Debug;
use std::ops::Deref;

use super::change::{Change, Judgment};
use super::pairing;
use super::show::Show;
use lexibus_codegen::ir::{Catalog, Type, TypeDef};

/// The state of a comparison: the changes found so far, and the current element.
pub(super) struct Comparison<'a> {
    /// The old and the new catalog.
    pub catalogs: (&'a Catalog, &'a Catalog),
    /// The old and new types of the current owner of types: a device, a module or the catalog.
    pub types: (&'a [TypeDef], &'a [TypeDef]),
    /// Pairs of types that have been compared, each with the owner of the types.
    compared_types: HashSet<(usize, Type, Type)>,
    /// Number of the owner of the current types. 0 means the catalog.
    types_owner: usize,
    /// Number of type owners so far, including the catalog.
    types_owners: usize,
    pub owner: String,
    pub changes: Vec<Change>,
    element: String,
}

impl<'a> Comparison<'a> {
    pub fn new(old: &'a Catalog, new: &'a Catalog) -> Self {
        Comparison {
            catalogs: (old, new),
            types: (&old.types, &new.types),
            compared_types: HashSet::new(),
            types_owner: 0,
            types_owners: 1,
            owner: String::new(),
            changes: Vec::new(),
            element: String::new(),
        }
    }

    /// Calls `compare` for a device or module, with its lists of types as the current types.
    pub fn in_types(&mut self, old: &'a [TypeDef], new: &'a [TypeDef], compare: impl FnOnce(&mut Self)) {
        let outer = (self.types, self.types_owner);
        (self.types, self.types_owner) = ((old, new), self.types_owners);
        self.types_owners += 1;
        compare(self);
        (self.types, self.types_owner) = outer;
    }

    /// Calls `compare` with the types of the catalogs as the current types.
    pub fn in_types_of_catalog(&mut self, compare: impl FnOnce(&mut Self)) {
        let outer = (self.types, self.types_owner);
        let (old, new) = self.catalogs;
        (self.types, self.types_owner) = ((old.types.as_slice(), new.types.as_slice()), 0);
        compare(self);
        (self.types, self.types_owner) = outer;
    }

    /// Returns whether this pair of types has not been compared before, and records the pair.
    pub fn is_first_comparison(&mut self, old: Type, new: Type) -> bool {
        self.compared_types.insert((self.types_owner, old, new))
    }

    /// Returns the old and the new types of the current owner that have been compared.
    pub fn compared_types(&self) -> (HashSet<Type>, HashSet<Type>) {
        let of_owner = self.compared_types.iter().filter(|(owner, ..)| *owner == self.types_owner);
        of_owner.map(|(_, old, new)| (*old, *new)).unzip()
    }

    /// Compares a part of the current element. The name of the part is added to the element's name.
    pub fn within(&mut self, part: &str, compare: impl FnOnce(&mut Self)) {
        let length = self.element.len();
        if length > 0 {
            self.element.push_str(", ");
        }
        self.element.push_str(part);
        compare(self);
        self.element.truncate(length);
    }

    /// Reports a changed fact of the current element.
    pub fn push(&mut self, fact: &'static str, old: String, new: String, judgment: Judgment) {
        let (owner, element) = (self.owner.clone(), self.element.clone());
        self.changes.push(Change { owner, element, fact, old, new, judgment });
    }

    /// Reports a fact of the current element if its old and new values differ.
    pub fn values<T: PartialEq + Debug>(
        &mut self,
        fact: &'static str,
        [old, new]: [&T; 2],
        [old_text, new_text]: [String; 2],
        judgment: Judgment,
    ) {
        // Compare the texts too: two NaN values are unequal, but equal texts mean no change.
        if old != new && format!("{old:?}") != format!("{new:?}") {
            self.push(fact, old_text, new_text, judgment);
        }
    }

    /// Reports a fact of the current element if its old and new texts differ.
    pub fn texts(&mut self, fact: &'static str, old: String, new: String, judgment: Judgment) {
        if old != new {
            self.push(fact, old, new, judgment);
        }
    }

    /// Reports that the current element was removed.
    pub fn removed(&mut self, judgment: Judgment) {
        self.push("removed", String::new(), String::new(), judgment);
    }

    /// Reports that the current element was added.
    pub fn added(&mut self, judgment: Judgment) {
        self.push("added", String::new(), String::new(), judgment);
    }
}

/// Compares all fields of a type. The caller gives a rule for each field or lists the field as ignored; a missing field
/// is a compile error. The macro `rule` contains the rules of common fields. The list of ignored fields comes last and
/// gives a reason for each. An ignored field is not a fact of the device, or is compared elsewhere.
macro_rules! compare_fields {
    ($type:ident, $old:expr, $new:expr, $comparison:expr, { $($field:ident $(: $rule:expr)?),* $(,)? }
        $(, $reason:expr => [$($ignored:ident),+])* $(,)?) => {{
        let (old, new, comparison): (&$type, &$type, &mut $crate::compare::comparison::Comparison<'_>) =
            ($old, $new, $comparison);
        let $type { $($field: _,)* $($($ignored: _,)+)* } = old;
        let _reasons: &[&str] = &[$($reason),*];
        $(($crate::compare::comparison::rule!($field $(, $rule)?))(&old.$field, &new.$field, comparison);)*
    }};
}
pub(super) use compare_fields;

/// Defines a function that compares two values of a type by [`compare_fields`].
macro_rules! rules {
    ($visibility:vis fn $name:ident($type:ident) $($rules:tt)*) => {
        $visibility fn $name(
            old: &$type, new: &$type, comparison: &mut $crate::compare::comparison::Comparison<'_>,
        ) {
            $crate::compare::comparison::compare_fields!($type, old, new, comparison, $($rules)*);
        }
    };
}
pub(super) use rules;

/// Selects the rule of a field: the rule that the caller gives, or otherwise the common rule of all fields with this
/// name.
macro_rules! rule {
    (name) => {
        $crate::compare::comparison::judged("name", $crate::compare::texts::renamed)
    };
    (names) => {
        $crate::compare::comparison::text("name in other languages")
    };
    (documentation) => {
        $crate::compare::comparison::or_default($crate::compare::texts::documentation)
    };
    (doubts) => {
        $crate::compare::texts::doubts
    };
    (extensions) => {
        $crate::compare::texts::extensions
    };
    (origins) => {
        $crate::compare::texts::origins
    };
    (stated_by) => {
        $crate::compare::texts::stated_by
    };
    (availability) => {
        $crate::compare::comparison::or_default($crate::compare::conditions::availability)
    };
    ($field:ident, $rule:expr) => {
        $rule
    };
}
pub(super) use rule;

/// Reason to ignore a field: it is a position in the source file.
pub(super) const POSITION: &str = "a position in the source file";
/// Reason to ignore a field: it is a page, line or clause of a manual.
pub(super) const CITATION: &str = "a position in the manual";
/// Reason to ignore a field: elements are paired by this field.
pub(super) const KEY: &str = "a key; a change is reported as a removal and an addition";
/// Reason to ignore a field: it is compared together with another field.
pub(super) const COMPARED: &str = "compared together with another field";

/// Returns a rule that compares a fact. All changes to the fact have the same effects.
pub(super) fn fact<T: PartialEq + Debug + Show>(
    name: &'static str,
    judgment: Judgment,
) -> impl Fn(&T, &T, &mut Comparison<'_>) {
    fact_as(name, judgment, T::show)
}

/// Returns a rule that compares a fact. All changes to the fact have the same effects. `show` returns the text of a
/// value for reports.
pub(super) fn fact_as<T: PartialEq + Debug>(
    name: &'static str,
    judgment: Judgment,
    show: impl Fn(&T) -> String,
) -> impl Fn(&T, &T, &mut Comparison<'_>) {
    move |old, new, comparison| {
        if old != new {
            comparison.values(name, [old, new], [show(old), show(new)], judgment);
        }
    }
}

/// Returns a rule that compares a fact, such as a text, whose changes have no effect.
pub(super) fn text<T: PartialEq + Debug + Show>(name: &'static str) -> impl Fn(&T, &T, &mut Comparison<'_>) {
    fact(name, Judgment::NONE)
}

/// Returns a rule that compares values by their texts, because the values contain positions in the source.
/// The changes have no effect.
pub(super) fn positioned<T: PartialEq>(
    name: &'static str,
    show: impl Fn(&T) -> String,
) -> impl Fn(&T, &T, &mut Comparison<'_>) {
    move |old, new, comparison| {
        if old != new {
            comparison.texts(name, show(old), show(new), Judgment::NONE);
        }
    }
}

/// Returns a rule that compares the elements of a list by their texts, because the elements contain positions in the source.
pub(super) fn each_positioned<T, L: Deref<Target = [T]> + PartialEq>(
    name: &'static str,
    show: impl Fn(&T) -> String,
) -> impl Fn(&L, &L, &mut Comparison<'_>) {
    positioned(name, move |list: &L| joined(list, &show))
}

/// Returns a rule that compares a list. `show` formats each element.
pub(super) fn each<T, L: Deref<Target = [T]> + PartialEq + Debug>(
    name: &'static str,
    judgment: Judgment,
    show: impl Fn(&T) -> String,
) -> impl Fn(&L, &L, &mut Comparison<'_>) {
    fact_as(name, judgment, move |list: &L| joined(list, &show))
}

/// Joins the elements of a list. `show` formats each element.
pub(super) fn joined<T>(list: &[T], show: impl Fn(&T) -> String) -> String {
    list.iter().map(show).collect::<Vec<_>>().join("; ")
}

/// Returns a rule that compares a fact. The effects of a change depend on the old and new values.
pub(super) fn judged<T: PartialEq + Debug + Show>(
    name: &'static str,
    judge: impl Fn(&T, &T) -> Judgment,
) -> impl Fn(&T, &T, &mut Comparison<'_>) {
    move |old, new, comparison| {
        if old != new {
            comparison.values(name, [old, new], [old.show(), new.show()], judge(old, new));
        }
    }
}

/// Returns a rule that compares a part of the current element. Reports contain the name of the part.
pub(super) fn part<T>(
    name: &'static str,
    compare: impl Fn(&T, &T, &mut Comparison<'_>),
) -> impl Fn(&T, &T, &mut Comparison<'_>) {
    move |old, new, comparison| comparison.within(name, |comparison| compare(old, new, comparison))
}

/// Returns a rule that compares an optional part. Adding or removing the part has the given effects.
pub(super) fn optional<T, B: Borrow<T>>(
    name: &'static str,
    added: Judgment,
    removed: Judgment,
    compare: impl Fn(&T, &T, &mut Comparison<'_>),
) -> impl Fn(&Option<B>, &Option<B>, &mut Comparison<'_>) {
    move |old, new, comparison| {
        comparison.within(name, |comparison| match (old, new) {
            (Some(old), Some(new)) => compare(old.borrow(), new.borrow(), comparison),
            (Some(_), None) => comparison.removed(removed),
            (None, Some(_)) => comparison.added(added),
            (None, None) => {}
        });
    }
}

/// Returns a rule that compares an optional part. A missing part is equal to its default.
pub(super) fn or_default<T: Default, B: Borrow<T>>(
    compare: impl Fn(&T, &T, &mut Comparison<'_>),
) -> impl Fn(&Option<B>, &Option<B>, &mut Comparison<'_>) {
    move |old, new, comparison| {
        if old.is_some() || new.is_some() {
            let (missing_old, missing_new) = (T::default(), T::default());
            let old = old.as_ref().map_or(&missing_old, B::borrow);
            compare(old, new.as_ref().map_or(&missing_new, B::borrow), comparison);
        }
    }
}

/// Returns a rule that passes two lists as slices to `compare`.
pub(super) fn slice<T, L: Deref<Target = [T]>>(
    compare: impl Fn(&[T], &[T], &mut Comparison<'_>),
) -> impl Fn(&L, &L, &mut Comparison<'_>) {
    move |old, new, comparison| compare(old, new, comparison)
}

/// Rules for the elements of a list: their titles, the keys that pair them, and the effects of additions and removals.
pub(super) struct Elements<T> {
    /// Function that returns the name of an element in reports.
    pub title: fn(&T) -> String,
    /// Function that returns the first key that pairs elements. Elements with an empty key are not paired by this key.
    pub name: fn(&T) -> String,
    /// Function that returns the second key, which pairs the elements that the first key does not pair.
    pub position: fn(&T) -> String,
    /// Function that returns the text of an added or removed element in reports.
    pub label: fn(&T) -> String,
    /// Function that returns whether the addition or removal of an element has an effect.
    pub has_effect: fn(&T) -> bool,
    pub added: Judgment,
    pub removed: Judgment,
}

impl<T> Elements<T> {
    /// Creates rules for elements that are paired by their title.
    pub fn titled(title: fn(&T) -> String) -> Self {
        Elements {
            title,
            name: title,
            position: |_| String::new(),
            label: |_| String::new(),
            has_effect: |_| true,
            added: Judgment::ADDITION,
            removed: Judgment::API_AND_WIRE,
        }
    }

    /// Sets the function that returns the first key.
    pub fn paired_by(self, name: fn(&T) -> String) -> Self {
        Elements { name, ..self }
    }

    /// Sets the effects of an addition and of a removal.
    pub fn judged(self, added: Judgment, removed: Judgment) -> Self {
        Elements { added, removed, ..self }
    }
}

/// Returns a rule that pairs the elements of two lists as `elements` states, and compares each pair with `compare`.
pub(super) fn list<T, L: Deref<Target = [T]>>(
    elements: Elements<T>,
    compare: impl Fn(&T, &T, &mut Comparison<'_>),
) -> impl Fn(&L, &L, &mut Comparison<'_>) {
    move |old, new, comparison| slices(old, new, &elements, &compare, comparison)
}

/// Pairs the elements of two slices as `elements` states, and compares each pair with `compare`.
pub(super) fn slices<T>(
    old: &[T],
    new: &[T],
    elements: &Elements<T>,
    compare: impl Fn(&T, &T, &mut Comparison<'_>),
    comparison: &mut Comparison<'_>,
) {
    for (old, new) in pairing::pairs(old, new, elements.name, elements.position) {
        let Some(title) = new.or(old).map(elements.title) else { continue };
        let judge = |one: &T, judgment| if (elements.has_effect)(one) { judgment } else { Judgment::NONE };
        comparison.within(&title, |comparison| match (old, new) {
            (Some(old), Some(new)) => compare(old, new, comparison),
            (Some(old), None) => {
                comparison.push("removed", (elements.label)(old), String::new(), judge(old, elements.removed));
            }
            (None, Some(new)) => {
                comparison.push("added", String::new(), (elements.label)(new), judge(new, elements.added));
            }
            (None, None) => {}
        });
    }
}
