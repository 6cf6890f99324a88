//! Items and groups of items.

use std::sync::Arc;

use smallvec::SmallVec;
use thin_vec::ThinVec;

use super::{
    Access, Availability, Behavior, Binding, Bus, CompactString, Documentation, Doubts, Extensions, Fact, FactOrigin,
    FactOrigins, ItemRef, ItemVariant, Limits, Mappable, Missing, Quantity, Rare, Rule, Texts, Type, Value,
};
use crate::source::{Origin, Span};

/// One value of a device.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Item {
    /// Name of the item as the source spells it (ParameterName of CiA 306); may be empty.
    pub name: CompactString,
    /// Name of the item in other languages.
    pub names: Texts,
    /// Addresses of the item on its buses.
    pub bindings: SmallVec<[Binding; 1]>,
    /// Data type of the item.
    pub ty: Type,
    /// Access rights of the item.
    pub access: Access,
    /// PDOs that can map the item.
    pub mappable: Mappable,
    /// Default value of the item.
    pub default: Option<Value>,
    /// Minimum, maximum and allowed ranges; empty = all values of the type.
    pub limits: Rare<Limits>,
    /// Facts of the item that differ between models or buses, in the order of the source.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "ThinVec::is_empty"))]
    pub variants: ThinVec<ItemVariant>,
    /// Settings of the item in a configuration file (DCF, XDC).
    pub configured: Option<Box<Configured>>,
    /// Unit, scale, special raw values and step of the item.
    pub quantity: Option<Box<Quantity>>,
    /// Storage of the value, side effects of writing it, and conditions for reading and writing it.
    pub behavior: Option<Box<Behavior>>,
    /// Models, firmware versions, hardware options and buses on which the item exists.
    pub availability: Option<Box<Availability>>,
    /// Items with the same value or quantity, with the upper half of the value, or with the number of valid elements.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub related: Option<Box<RelatedItems>>,
    /// True if the sub-index is reserved: it exists, but has no meaning.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "std::ops::Not::not"))]
    pub is_reserved: bool,
    /// True if the sub-index does not always exist, such as an entry of an error history.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "std::ops::Not::not"))]
    pub is_optional: bool,
    /// True if all axes of a multi-axis device share the item.
    pub shared_by_axes: bool,
    /// ObjFlags of CiA 306: bit 0 = refuse write on download, bit 1 = refuse read on scan. Other bits are stored unchanged.
    pub flags: u32,
    /// Description of the item, as in the description file.
    pub documentation: Option<Arc<Documentation>>,
    /// Ambiguities in the source about the item, with the assumptions made.
    pub doubts: Doubts,
    /// Facts about the item that have no field in the IR.
    pub extensions: Extensions,
    /// Location of the item in the source.
    pub origin: Origin,
    /// Locations of the item's facts in the source.
    pub at: ItemSpans,
    /// Origins of facts that do not come from the description itself.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "FactOrigins::is_empty"))]
    pub origins: FactOrigins,
}

impl Item {
    /// Creates a read-only item with an address and no further facts.
    pub fn new(binding: Binding) -> Self {
        Item {
            name: CompactString::default(),
            names: Texts::default(),
            bindings: SmallVec::from_buf([binding]),
            ty: Type::Opaque(None),
            access: Access::ReadOnly,
            mappable: Mappable::default(),
            default: None,
            limits: Rare::default(),
            variants: ThinVec::new(),
            configured: None,
            quantity: None,
            behavior: None,
            availability: None,
            related: None,
            is_reserved: false,
            is_optional: false,
            shared_by_axes: false,
            flags: 0,
            documentation: None,
            doubts: Doubts::new(),
            extensions: Extensions::new(),
            origin: Origin::default(),
            at: ItemSpans::default(),
            origins: FactOrigins::default(),
        }
    }

    /// Returns the index and sub-index of the item, if it has an object address. If it has several, returns the first one.
    pub fn object(&self) -> Option<(u16, u8)> {
        self.bindings.iter().find_map(|binding| match binding {
            Binding::Object { index, sub_index, .. } => Some((*index, *sub_index)),
            _ => None,
        })
    }

    /// Returns whether `access` is an assumption of the compiler, because the source does not state the access rights.
    pub fn is_access_assumed(&self) -> bool {
        self.origins.get(Fact::Access) == Some(&FactOrigin::Rule(Rule::UnstatedAccess))
    }

    /// Returns the name of the access rights for documentation. Assumed access rights have a question mark: `rw?`.
    pub fn access_name(&self) -> &'static str {
        match self.is_access_assumed() {
            true if self.access == Access::ReadOnly => "ro?",
            true => "rw?",
            false => self.access.name(),
        }
    }

    /// Returns the variants of the item that apply to all models and name this bus.
    fn variants_on(&self, bus: Bus) -> impl Iterator<Item = &ItemVariant> {
        self.variants.iter().filter(move |variant| variant.models.is_empty() && variant.buses.contains(bus))
    }

    /// Returns the type of the item on a bus.
    pub fn type_on(&self, bus: Bus) -> Type {
        self.variants_on(bus).find_map(|variant| variant.ty).unwrap_or(self.ty)
    }

    /// Returns the type of the item on CANopen, or its type on EtherCAT if the item has no object address on CANopen.
    pub fn object_type(&self) -> Type {
        let is_on_canopen = |binding: &Binding| matches!(binding, Binding::Object { buses, .. } if buses.canopen);
        self.type_on(if self.bindings.iter().any(is_on_canopen) { Bus::CanOpen } else { Bus::EtherCat })
    }

    /// Returns the access rights of the item on a bus.
    pub fn access_on(&self, bus: Bus) -> Access {
        self.variants_on(bus).find_map(|variant| variant.access).unwrap_or(self.access)
    }

    /// Returns the default value of the item on a bus.
    pub fn default_on(&self, bus: Bus) -> Option<&Value> {
        self.variants_on(bus).find_map(|variant| variant.default.as_ref()).or(self.default.as_ref())
    }

    /// Returns the limits that a variant states for this bus and for all models, if any.
    pub fn limits_on(&self, bus: Bus) -> Option<&Limits> {
        self.variants_on(bus)
            .map(|variant| &variant.limits)
            .find(|limits| !limits.is_empty() || !limits.allowed.is_empty())
    }

    /// Returns the value that a configuration file (DCF, XDC) sets for the item.
    pub fn configured_value(&self) -> Option<&Value> {
        self.configured.as_ref()?.value.as_ref()
    }

    /// Returns the initial value of the item: the value that a configuration file sets or, if none is set,
    /// the default value.
    pub fn initial(&self) -> Option<&Value> {
        self.configured_value().or(self.default.as_ref())
    }

    /// Returns the default value of the item, if it is an integer or a BOOLEAN.
    pub fn default_integer(&self) -> Option<i128> {
        self.default.as_ref().and_then(Value::as_int)
    }
}

/// References to items with the same value or quantity, with the upper half of the value, or with the number of valid elements, and
/// identifiers for references in the source. The references are boxed, because only register tables have them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RelatedItems {
    /// Item with the same value under another name.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub same_as: Option<Box<ItemRef>>,
    /// Item with the same quantity in another scaling.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub same_quantity: Option<Box<ItemRef>>,
    /// Item with the upper half of the value.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub upper_half: Option<Box<ItemRef>>,
    /// Item that contains the number of valid elements of this item.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub valid_count: Option<Box<ItemRef>>,
    /// Identifier of the item, to which menus refer (`ID` of a parameter in GSDML).
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "CompactString::is_empty"))]
    pub id: CompactString,
    /// Identifier of a list of named values that does not suit the type of the item (`ValueItemTarget` of GSDML).
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "CompactString::is_empty"))]
    pub unsuitable_values: CompactString,
}

impl RelatedItems {
    /// Returns the references to all related items.
    pub fn all(&self) -> impl Iterator<Item = &ItemRef> {
        let RelatedItems { same_as, same_quantity, upper_half, valid_count, .. } = self;
        [same_as, same_quantity, upper_half, valid_count].into_iter().flatten().map(Box::as_ref)
    }

    /// Returns the references to all related items for modification.
    pub(crate) fn all_mut(&mut self) -> impl Iterator<Item = &mut ItemRef> {
        let RelatedItems { same_as, same_quantity, upper_half, valid_count, .. } = self;
        [same_as, same_quantity, upper_half, valid_count].into_iter().flatten().map(Box::as_mut)
    }
}

/// Locations of the facts of an item in the source. Spans of missing facts are empty.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ItemSpans {
    /// Location of the name.
    pub name: Span,
    /// Location of the data type.
    pub ty: Span,
    /// Location of the access type.
    pub access: Span,
    /// Location of the PDO mapping flag.
    pub mappable: Span,
    /// Location of the default value.
    pub default: Span,
    /// Locations of facts that few items have.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub others: Rare<OtherSpans>,
}

/// Locations of facts that few items have. Spans of missing facts are empty.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct OtherSpans {
    /// Location of the minimum.
    pub low: Span,
    /// Location of the maximum.
    pub high: Span,
    /// Location of the configured value.
    pub configured: Span,
    /// Location of the description.
    pub documentation: Span,
}

impl OtherSpans {
    const MISSING: OtherSpans =
        OtherSpans { low: Span::MISSING, high: Span::MISSING, configured: Span::MISSING, documentation: Span::MISSING };
}

impl Missing for OtherSpans {
    fn missing() -> &'static Self {
        &OtherSpans::MISSING
    }
}

/// Settings of an item in a configuration file (DCF, XDC).
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Configured {
    /// Value that the file configures (ParameterValue).
    pub value: Option<Value>,
    /// Name of the item in the application (Denotation).
    pub denotation: Option<CompactString>,
    /// File that stores the content that was read from a domain (UploadFile).
    pub upload_file: Option<CompactString>,
    /// File whose content is written to a domain (DownloadFile).
    pub download_file: Option<CompactString>,
}

/// A group of items that belong together in the source.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Group {
    /// Name of the group as the source spells it; may be empty.
    pub name: CompactString,
    /// Name of the group in other languages.
    pub names: Texts,
    /// Kind of the group, with the index of an object or record.
    pub kind: GroupKind,
    /// Items of the group, sorted by sub-index or in the order of the source.
    pub items: Vec<Item>,
    /// Indices of related objects (ObjectLinks of CiA 306).
    pub links: Vec<u16>,
    /// ObjFlags of the object (CiA 306).
    pub flags: u32,
    /// True if the index of the object depends on the slot of the module (ETG.2000).
    pub depends_on_slot: bool,
    /// True if the index of the object depends on the slot group of the module (ETG.2000).
    pub depends_on_slot_group: bool,
    /// Flags of the object that only tools use (ETG.2000).
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub tool_flags: Option<Box<ToolFlags>>,
    /// Number of items that the source describes in the object itself (SubItem in Info of ETG.2000). The other items follow from
    /// the type of the object.
    pub described: u32,
    /// Description of the group from the source.
    pub documentation: Option<Arc<Documentation>>,
    /// Ambiguities in the source about the group, with the assumptions made.
    pub doubts: Doubts,
    /// Facts about the group that have no field in the IR.
    pub extensions: Extensions,
    /// Location of the group in the source.
    pub origin: Origin,
    /// Location of the group's name in the source.
    pub name_at: Span,
    /// Origins of the group's name, object type and description, if they do not come from the description file itself.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "FactOrigins::is_empty"))]
    pub origins: FactOrigins,
}

impl Group {
    /// Creates an object without items.
    pub fn object(index: u16, code: ObjectCode) -> Self {
        Group {
            name: CompactString::default(),
            names: Texts::default(),
            kind: GroupKind::Object { index, code, category: None },
            items: Vec::new(),
            links: Vec::new(),
            flags: 0,
            depends_on_slot: false,
            depends_on_slot_group: false,
            tool_flags: None,
            described: 0,
            documentation: None,
            doubts: Doubts::new(),
            extensions: Extensions::new(),
            origin: Origin::default(),
            name_at: Span::default(),
            origins: FactOrigins::default(),
        }
    }

    /// Returns the index of the group, if the group is an object.
    pub fn index(&self) -> Option<u16> {
        match self.kind {
            GroupKind::Object { index, .. } => Some(index),
            _ => None,
        }
    }

    /// Returns the object code of the group, if the group is an object.
    pub fn object_code(&self) -> Option<ObjectCode> {
        match self.kind {
            GroupKind::Object { code, .. } => Some(code),
            _ => None,
        }
    }

    /// Returns whether the object has entries: sub-indices above 0, or several values. In Rust, such an object becomes a type
    /// with a constant for each entry. Any other object becomes a single constant.
    pub fn has_entries(&self) -> bool {
        self.object_code().is_some_and(ObjectCode::has_subs) || self.items.len() != 1
    }

    /// Returns the item at a sub-index.
    pub fn sub(&self, sub_index: u8) -> Option<&Item> {
        self.items.get(self.position(sub_index)?)
    }

    /// Returns the position of the item at a sub-index.
    pub(crate) fn position(&self, sub_index: u8) -> Option<usize> {
        let at = |item: &Item| item.object().map(|(_, sub)| sub);
        let sorted = self.items.binary_search_by_key(&Some(sub_index), at);
        sorted.ok().or_else(|| self.items.iter().position(|item| at(item) == Some(sub_index)))
    }
}

/// The kind of a group, with the index of an object or record.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum GroupKind {
    /// An object of an object dictionary (CiA 301 7.4, ETG.1000.6 5.6).
    Object {
        /// Index of the object.
        index: u16,
        /// Object code of the object.
        code: ObjectCode,
        /// Requirement level of the object, if the source states it.
        category: Option<Category>,
    },
    /// A chapter of a register table.
    Chapter,
    /// A parameter record of a PROFINET submodule.
    Record(Box<Record>),
    /// A process image with a fixed layout.
    Image {
        /// Length of the process image in bytes.
        length: u32,
    },
}

/// Flags of an object of an EtherCAT slave, with their texts unchanged.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ToolFlags {
    /// Attribute of the object as a bit pattern (`Attribute`).
    pub attribute: CompactString,
    /// State transition at which a master writes the object (`Transition`).
    pub transition: CompactString,
    /// How a tool accesses the object: with complete access or by sub-index (`SdoAccess`).
    pub sdo_access: CompactString,
    /// Whether an object of a module replaces the object (`OverwrittenByModule`).
    pub overwritten_by_module: CompactString,
}

/// Facts of a parameter record of a PROFINET submodule (ParameterRecordDataItem of GSDML).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Record {
    /// Index of the record.
    pub index: u16,
    /// Length of the record in bytes.
    pub length: u32,
    /// Position of the record in the order of transfer at start-up; 0 = any position.
    pub transfer_sequence: u16,
    /// True if a change to the record during operation disturbs the device (`ChangeableWithBump`); `None` = not given.
    pub changeable_with_bump: Option<bool>,
    /// Fixed bytes of the record, with their byte offsets. Bytes of the record that have neither a constant nor an item are 0.
    pub constants: Vec<(u32, Vec<u8>)>,
}

/// The requirement level of an object: whether devices must have it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Category {
    /// Each device must have the object.
    Mandatory,
    /// The object is optional.
    Optional,
    /// The object is mandatory under a condition.
    Conditional,
    /// The object is manufacturer-specific.
    Manufacturer,
}

/// Object code, which states the kind of an object (CiA 301 7.4.3).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum ObjectCode {
    /// Object code 0: an object without data.
    Null,
    /// Object code 2: a block of data of any length.
    Domain,
    /// Object code 5: a definition of a basic type.
    DefType,
    /// Object code 6: a definition of a record type.
    DefStruct,
    /// Object code 7: a single value.
    Var,
    /// Object code 8: elements of the same type.
    Array,
    /// Object code 9: elements of different types.
    Record,
}

impl ObjectCode {
    /// Returns the object code with this number, or `None` for numbers other than 0, 2 and 5 to 9.
    pub fn from_number(number: i128) -> Option<Self> {
        Some(match number {
            0 => ObjectCode::Null,
            2 => ObjectCode::Domain,
            5 => ObjectCode::DefType,
            6 => ObjectCode::DefStruct,
            7 => ObjectCode::Var,
            8 => ObjectCode::Array,
            9 => ObjectCode::Record,
            _ => return None,
        })
    }

    /// Returns the name of the object code in CiA 301.
    pub fn name(self) -> &'static str {
        match self {
            ObjectCode::Null => "NULL",
            ObjectCode::Domain => "DOMAIN",
            ObjectCode::DefType => "DEFTYPE",
            ObjectCode::DefStruct => "DEFSTRUCT",
            ObjectCode::Var => "VAR",
            ObjectCode::Array => "ARRAY",
            ObjectCode::Record => "RECORD",
        }
    }

    /// Returns whether an object of this code has sub-indices above 0.
    pub fn has_subs(self) -> bool {
        matches!(self, ObjectCode::Array | ObjectCode::Record | ObjectCode::DefStruct)
    }
}
