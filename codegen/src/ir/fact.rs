//! Origins of facts, and their precedence.

use super::{CompactString, Documentation, Item, SharedList};

/// An attribute of an item or group. Several sources can state the same attribute.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Fact {
    /// Name of the item.
    Name,
    /// Addresses of the item on its buses.
    Addresses,
    /// Object type (object code) of a group.
    ObjectType,
    /// Data type of the item.
    Type,
    /// Names of the item's bits or values.
    Meaning,
    /// Access rights of the item.
    Access,
    /// PDO mapping of the item.
    Mappable,
    /// Default value of the item.
    Default,
    /// Minimum, maximum and allowed values of the item.
    Limits,
    /// Unit, scale factor and rounding step of the item.
    Unit,
    /// Storage of the value, side effects of writing it, and conditions for reading and writing it.
    Behavior,
    /// Models, firmware versions, hardware options and buses on which the item exists.
    Availability,
    /// Facts of the item that differ between models or buses.
    Variants,
    /// Description of the item.
    Description,
}

impl Fact {
    /// All facts, in the order in which outputs show them.
    pub const ALL: [Fact; 14] = [
        Fact::Name,
        Fact::Addresses,
        Fact::ObjectType,
        Fact::Type,
        Fact::Meaning,
        Fact::Access,
        Fact::Mappable,
        Fact::Default,
        Fact::Limits,
        Fact::Unit,
        Fact::Behavior,
        Fact::Availability,
        Fact::Variants,
        Fact::Description,
    ];

    /// Returns whether this fact differs between two items. For [`Fact::Type`] and [`Fact::Meaning`], compares the types of the
    /// items. [`Fact::ObjectType`] never differs, because items have no object type.
    #[cfg(feature = "table")]
    pub(crate) fn differs(self, one: &Item, other: &Item) -> bool {
        match self {
            Fact::Name => one.name != other.name || one.names != other.names,
            Fact::Addresses => one.bindings != other.bindings,
            Fact::ObjectType => false,
            Fact::Type | Fact::Meaning => one.ty != other.ty,
            Fact::Access => one.access != other.access,
            Fact::Mappable => one.mappable != other.mappable,
            Fact::Default => one.default != other.default,
            Fact::Limits => one.limits != other.limits,
            Fact::Unit => one.quantity != other.quantity,
            Fact::Behavior => one.behavior != other.behavior,
            Fact::Availability => one.availability != other.availability,
            Fact::Variants => one.variants != other.variants,
            Fact::Description => text(one) != text(other),
        }
    }

    /// Returns whether an item has this fact, from any source. Addresses, object type, type, access rights and PDO mapping always
    /// count as present.
    pub(crate) fn is_stated(self, item: &Item) -> bool {
        match self {
            Fact::Name => !item.name.is_empty(),
            Fact::Addresses | Fact::ObjectType | Fact::Type | Fact::Access | Fact::Mappable => true,
            Fact::Meaning => matches!(item.ty, super::Type::Named(_)),
            Fact::Default => item.default.is_some(),
            Fact::Limits => !item.limits.is_empty() || !item.limits.allowed.is_empty(),
            Fact::Unit => item.quantity.is_some(),
            Fact::Behavior => item.behavior.is_some(),
            Fact::Availability => item.availability.is_some(),
            Fact::Variants => !item.variants.is_empty(),
            Fact::Description => !text(item).is_empty(),
        }
    }
}

/// Returns the description of an item, without citations.
fn text(item: &Item) -> &str {
    Documentation::text_of(item.documentation.as_deref())
}

/// The origin of a fact.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum FactOrigin {
    /// The description itself. This origin is recorded only if the description states that the item lacks the fact.
    Stated,
    /// The name that the manual prints. The description of the item only spells out this name.
    PrintedName,
    /// An overlay of the user.
    Overlay(Box<OverlayOrigin>),
    /// A standard and a clause of it: `CiA 402, 17.3.7`.
    Standard(CompactString),
    /// A rule of the compiler.
    Rule(Rule),
}

/// The row of an overlay that states a fact.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct OverlayOrigin {
    /// File name of the overlay, without folders.
    pub file: CompactString,
    /// Line of the row in the overlay.
    pub line: u32,
    /// True if the overlay replaces a fact of the description.
    pub replaces: bool,
    /// Reason for the change, from the row or the head of the overlay; may be empty.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "CompactString::is_empty"))]
    pub why: CompactString,
}

/// A rule by which the compiler completes descriptions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Rule {
    /// Items with `access = "?"` in a register table are read-write, except Modbus inputs, which are read-only.
    UnstatedAccess,
    /// A reserved sub-index is read-only, even if it inherits read-write access.
    ReservedEntry,
    /// Objects of implicit PDOs, which the description counts but does not describe, have the facts of CiA 301.
    AnnouncedPdo,
    /// An object of an EtherCAT slave that only PDO entries describe is read-write if an RxPDO maps it, and otherwise read-only.
    MappedObject,
    /// Items without access rights in an EDS, XDD or ESI are read-only, except DOMAIN objects on CANopen, which are read-write.
    /// Items without a data type are read-only raw bytes.
    MissingKey,
    /// Identity numbers that are missing or 0 in the header of the description come from the default values of object 0x1018. The
    /// rule does not apply to EtherCAT devices.
    IdentityObject,
    /// An object has the object type that matches its sub-indices if the stated object type is missing or unknown, or contradicts
    /// the sub-indices.
    ObjectContents,
    /// Sub-index 0 of an object with compact sub-indices contains their number (CiA 306, CompactSubObj).
    CompactObject,
}

impl FactOrigin {
    /// Returns the rank by which origins take precedence: overlay, then description, then standard, then rule.
    fn rank(&self) -> u8 {
        match self {
            FactOrigin::Rule(_) => 0,
            FactOrigin::Standard(_) => 1,
            FactOrigin::Stated | FactOrigin::PrintedName => 2,
            FactOrigin::Overlay(_) => 3,
        }
    }

    /// Returns whether a fact of this origin replaces a fact of the origin `present`. `None` means that the
    /// fact does not exist yet. The later of two overlays takes precedence, and the first of two standards.
    pub(crate) fn takes_precedence_over(&self, present: Option<&FactOrigin>) -> bool {
        let Some(present) = present else { return true };
        self.rank() > present.rank() || matches!(self, FactOrigin::Overlay(_))
    }
}

/// Origins of facts that do not come from the description itself. Items whose facts have the same origins can share the list.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FactOrigins(pub SharedList<(Fact, FactOrigin)>);

impl FactOrigins {
    /// Returns whether no origin is recorded. If so, all facts come from the description itself.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Returns the recorded origin of a fact, if any. A fact without a recorded origin is missing, or comes from the description
    /// itself.
    pub fn get(&self, fact: Fact) -> Option<&FactOrigin> {
        self.0.iter().find(|(recorded, _)| *recorded == fact).map(|(_, origin)| origin)
    }

    /// Records the origin of a fact. `None` means the description itself.
    pub(crate) fn set(&mut self, fact: Fact, origin: Option<FactOrigin>) {
        if self.get(fact) != origin.as_ref() {
            let origins = self.0.to_mut();
            origins.retain(|(recorded, _)| *recorded != fact);
            origins.extend(origin.map(|origin| (fact, origin)));
        }
    }

    /// Uses the list of `recent` if both lists are equal. Otherwise, `recent` becomes this list.
    pub(crate) fn share(&mut self, recent: &mut FactOrigins) {
        if self == recent {
            self.clone_from(recent);
        } else {
            recent.clone_from(self);
        }
    }

    /// Creates a list in which all `facts` have the origin `rule`.
    pub(crate) fn by_rule(facts: &[Fact], rule: Rule) -> Self {
        FactOrigins(facts.iter().map(|fact| (*fact, FactOrigin::Rule(rule))).collect())
    }

    /// Returns whether a fact of the origin `origin` may be added or may replace the present fact. `is_stated` means
    /// that the element already has the fact.
    pub(crate) fn admits(&self, fact: Fact, is_stated: bool, origin: &FactOrigin) -> bool {
        origin.takes_precedence_over(self.get(fact).or(is_stated.then_some(&FactOrigin::Stated)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn overlay() -> FactOrigin {
        FactOrigin::Overlay(Box::new(OverlayOrigin { file: "a.toml".into(), line: 3, replaces: true, why: "".into() }))
    }

    #[test]
    fn precedence_is_overlay_description_standard_rule() {
        let standard = FactOrigin::Standard("CiA 402, 17.3.7".into());
        let order = [FactOrigin::Rule(Rule::UnstatedAccess), standard.clone(), FactOrigin::Stated, overlay()];
        for (at, lower) in order.iter().enumerate() {
            assert!(lower.takes_precedence_over(None));
            assert!(order[at + 1..].iter().all(|higher| higher.takes_precedence_over(Some(lower))));
            assert!(order[at + 1..].iter().all(|higher| !lower.takes_precedence_over(Some(higher))));
        }
        assert!(!standard.takes_precedence_over(Some(&standard)) && overlay().takes_precedence_over(Some(&overlay())));
    }

    #[test]
    fn a_fact_has_one_origin() {
        let mut origins = FactOrigins::default();
        origins.set(Fact::Unit, Some(FactOrigin::Standard("CiA 402, 1".into())));
        origins.set(Fact::Unit, Some(overlay()));
        assert_eq!((origins.0.len(), origins.get(Fact::Unit)), (1, Some(&overlay())));
        assert!(!origins.admits(Fact::Unit, true, &FactOrigin::Standard("CiA 402, 2".into())));
        assert!(origins.admits(Fact::Limits, false, &FactOrigin::Rule(Rule::UnstatedAccess)));
        origins.set(Fact::Unit, None);
        assert!(origins.is_empty());
    }

    #[test]
    fn equal_origins_share_one_list_until_one_of_them_changes() {
        let rule = || FactOrigins::by_rule(&[Fact::Access], Rule::MissingKey);
        let (mut recent, mut first, mut second) = (FactOrigins::default(), rule(), rule());
        first.share(&mut recent);
        second.share(&mut recent);
        assert!(std::ptr::eq(&*first.0, &*second.0));
        second.set(Fact::Unit, Some(overlay()));
        assert_eq!((first.get(Fact::Unit), second.get(Fact::Unit)), (None, Some(&overlay())));
        second.share(&mut recent);
        assert!(std::ptr::eq(&*recent.0, &*second.0) && first == rule());
    }
}
