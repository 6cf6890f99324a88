//! Items and groups of items.

use smallvec::SmallVec;
use thin_vec::ThinVec;

use super::{
    Access, Availability, Behaviour, Binding, Bus, CompactString, Documentation, Doubts, Extensions, Fact, FactOrigin,
    FactOrigins, ItemRef, ItemVariant, Limits, Mappable, Quantity, Rule, Texts, Type, Value,
};
use crate::source::{Origin, Span};

/// One value of a device.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Item {
    /// Name as the source spells it (ParameterName of CiA 306); may be empty.
    pub name: CompactString,
    /// Name in other languages.
    pub names: Texts,
    /// Addresses on each bus.
    pub bindings: SmallVec<[Binding; 1]>,
    /// Type.
    pub ty: Type,
    /// Access rights.
    pub access: Access,
    /// PDO mapping.
    pub mappable: Mappable,
    /// Default value.
    pub default: Option<Value>,
    /// Minimum, maximum and allowed ranges; empty = all values of the type.
    pub limits: Limits,
    /// Differences between models or buses, in the order of the source.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "ThinVec::is_empty"))]
    pub variants: ThinVec<ItemVariant>,
    /// Configuration of a single device by a DCF or XDC.
    pub configured: Option<Box<Configured>>,
    /// Unit and scale factor.
    pub quantity: Option<Box<Quantity>>,
    /// Storage, side effects and conditions of writing.
    pub behaviour: Option<Box<Behaviour>>,
    /// Models, firmware versions, options and buses on which the item exists.
    pub availability: Option<Box<Availability>>,
    /// Items with the same value, a part of it, or its length.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub related: Option<Box<RelatedItems>>,
    /// Whether the sub-index is reserved: it exists, but has no meaning.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "std::ops::Not::not"))]
    pub is_reserved: bool,
    /// Whether the sub-index does not always exist, such as an entry of an error history.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "std::ops::Not::not"))]
    pub is_optional: bool,
    /// Whether all axes of a multi-axis device share the item.
    pub shared_by_axes: bool,
    /// ObjFlags (CiA 306): bit 0 refuse write on download, bit 1 refuse read on scan. Other bits are kept.
    pub flags: u32,
    /// Description from the source.
    pub documentation: Option<Box<Documentation>>,
    /// Ambiguities in the source, with assumptions.
    pub doubts: Doubts,
    /// Facts of the source without a field in the IR.
    pub extensions: Extensions,
    /// Location in the source.
    pub origin: Origin,
    /// Locations of facts in the source.
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
            limits: Limits::default(),
            variants: ThinVec::new(),
            configured: None,
            quantity: None,
            behaviour: None,
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

    /// Returns index and sub-index, if the item is in an object dictionary.
    pub fn object(&self) -> Option<(u16, u8)> {
        self.bindings.iter().find_map(|binding| match binding {
            Binding::Object { index, sub_index, .. } => Some((*index, *sub_index)),
            _ => None,
        })
    }

    /// Returns whether the source does not state the access rights, so that `access` is an assumption.
    pub fn is_access_assumed(&self) -> bool {
        self.origins.get(Fact::Access) == Some(&FactOrigin::Rule(Rule::UnstatedAccess))
    }

    /// Returns the access rights for documentation. Assumed access rights have a question mark: `rw?`.
    pub fn access_name(&self) -> &'static str {
        match self.is_access_assumed() {
            true if self.access == Access::ReadOnly => "ro?",
            true => "rw?",
            false => self.access.name(),
        }
    }

    /// Returns the differences on a bus that apply to all models.
    fn variants_on(&self, bus: Bus) -> impl Iterator<Item = &ItemVariant> {
        self.variants.iter().filter(move |variant| variant.models.is_empty() && variant.buses.contains(bus))
    }

    /// Returns the type on a bus.
    pub fn type_on(&self, bus: Bus) -> Type {
        self.variants_on(bus).find_map(|variant| variant.ty).unwrap_or(self.ty)
    }

    /// Returns the type of the object on CANopen, or on EtherCAT if it does not exist on CANopen.
    pub fn object_type(&self) -> Type {
        let is_on_canopen = |binding: &Binding| matches!(binding, Binding::Object { buses, .. } if buses.canopen);
        self.type_on(if self.bindings.iter().any(is_on_canopen) { Bus::CanOpen } else { Bus::EtherCat })
    }

    /// Returns the access rights on a bus.
    pub fn access_on(&self, bus: Bus) -> Access {
        self.variants_on(bus).find_map(|variant| variant.access).unwrap_or(self.access)
    }

    /// Returns the limits on a bus, if they differ from those of the item.
    pub fn limits_on(&self, bus: Bus) -> Option<&Limits> {
        self.variants_on(bus)
            .map(|variant| &variant.limits)
            .find(|limits| !limits.is_empty() || !limits.allowed.is_empty())
    }

    /// Returns the value that a DCF sets.
    pub fn configured_value(&self) -> Option<&Value> {
        self.configured.as_ref()?.value.as_ref()
    }

    /// Returns the initial value: the value that a DCF sets, or the default value.
    pub fn initial(&self) -> Option<&Value> {
        self.configured_value().or(self.default.as_ref())
    }

    /// Returns the default value, if it is an integer.
    pub fn default_integer(&self) -> Option<i128> {
        self.default.as_ref().and_then(Value::as_int)
    }
}

/// References to items with the same value, a part of it, or its length.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RelatedItems {
    /// Item with the same value under another name.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub same_as: Option<ItemRef>,
    /// Item with the same quantity in another scaling.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub same_quantity: Option<ItemRef>,
    /// Item with the upper half of the value.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub upper_half: Option<ItemRef>,
    /// Item with the number of valid elements.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub valid_count: Option<ItemRef>,
}

impl RelatedItems {
    /// Returns all references.
    pub fn all(&self) -> impl Iterator<Item = &ItemRef> {
        let RelatedItems { same_as, same_quantity, upper_half, valid_count } = self;
        [same_as, same_quantity, upper_half, valid_count].into_iter().flatten()
    }

    /// Returns all references for modification.
    pub(crate) fn all_mut(&mut self) -> impl Iterator<Item = &mut ItemRef> {
        let RelatedItems { same_as, same_quantity, upper_half, valid_count } = self;
        [same_as, same_quantity, upper_half, valid_count].into_iter().flatten()
    }
}

/// Locations of the facts of an item in the source. Spans of missing facts are empty.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ItemSpans {
    /// The name.
    pub name: Span,
    /// The data type.
    pub ty: Span,
    /// The access type.
    pub access: Span,
    /// The PDO mapping flag.
    pub mappable: Span,
    /// The default value.
    pub default: Span,
    /// The lower limit.
    pub low: Span,
    /// The upper limit.
    pub high: Span,
    /// The configured value.
    pub configured: Span,
    /// The description.
    pub documentation: Span,
}

/// Settings of an item in a configuration file (DCF, XDC).
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Configured {
    /// Value for this device (ParameterValue).
    pub value: Option<Value>,
    /// Name of the item in this application (Denotation).
    pub denotation: Option<CompactString>,
    /// File for the content of a domain that was read (UploadFile).
    pub upload_file: Option<CompactString>,
    /// File whose content is written to a domain (DownloadFile).
    pub download_file: Option<CompactString>,
}

/// Items that belong together in the source.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Group {
    /// Name as the source spells it; may be empty.
    pub name: CompactString,
    /// Name in other languages.
    pub names: Texts,
    /// Kind of group, with its address.
    pub kind: GroupKind,
    /// Items, sorted by sub-index or in the order of the source.
    pub items: Vec<Item>,
    /// Indices of related objects (ObjectLinks of CiA 306).
    pub links: Vec<u16>,
    /// ObjFlags of the object (CiA 306).
    pub flags: u32,
    /// Whether the index of the object depends on the slot of the module (ETG.2000).
    pub depends_on_slot: bool,
    /// Whether the index of the object depends on the slot group of the module (ETG.2000).
    pub depends_on_slot_group: bool,
    /// Number of items that the source describes in the object itself (SubItem in Info of ETG.2000). The other items follow
    /// from its type.
    pub described: u32,
    /// Description from the source.
    pub documentation: Option<Box<Documentation>>,
    /// Ambiguities in the source, with assumptions.
    pub doubts: Doubts,
    /// Facts of the source without a field in the IR.
    pub extensions: Extensions,
    /// Location in the source.
    pub origin: Origin,
    /// Location of the name in the source.
    pub name_at: Span,
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
            described: 0,
            documentation: None,
            doubts: Doubts::new(),
            extensions: Extensions::new(),
            origin: Origin::default(),
            name_at: Span::default(),
        }
    }

    /// Returns the index, if the group is an object.
    pub fn index(&self) -> Option<u16> {
        match self.kind {
            GroupKind::Object { index, .. } => Some(index),
            _ => None,
        }
    }

    /// Returns the object code, if the group is an object.
    pub fn object_code(&self) -> Option<ObjectCode> {
        match self.kind {
            GroupKind::Object { code, .. } => Some(code),
            _ => None,
        }
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

/// The kind of a group, with its address.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum GroupKind {
    /// An object of an object dictionary (CiA 301 7.4, ETG.1000.6 5.6).
    Object {
        /// Index.
        index: u16,
        /// Object code.
        code: ObjectCode,
        /// Whether a device has to have the object, if the source states it.
        category: Option<Category>,
    },
    /// A chapter of a register table.
    Chapter,
    /// A parameter record of a PROFINET submodule.
    Record(Box<Record>),
    /// A process image with a fixed layout.
    Image {
        /// Length in bytes.
        length: u32,
    },
}

/// Facts of a parameter record of a PROFINET submodule (ParameterRecordDataItem of GSDML).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Record {
    /// Record index.
    pub index: u16,
    /// Length in bytes.
    pub length: u32,
    /// Position in the order of transfer at start-up; 0 = any.
    pub transfer_sequence: u16,
    /// Whether a change during operation disturbs the device, if stated (`ChangeableWithBump`).
    pub changeable_with_bump: Option<bool>,
    /// Fixed bytes with their byte offsets. Bytes without a constant or an item are 0.
    pub constants: Vec<(u32, Vec<u8>)>,
}

/// Whether a device has to have an object.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Category {
    /// Mandatory.
    Mandatory,
    /// Optional.
    Optional,
    /// Mandatory under a condition.
    Conditional,
    /// Manufacturer-specific.
    Manufacturer,
}

/// Object code (CiA 301 7.4.3).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum ObjectCode {
    /// 0: no data.
    Null,
    /// 2: a block of data of any length.
    Domain,
    /// 5: definition of a basic type.
    DefType,
    /// 6: definition of a record type.
    DefStruct,
    /// 7: a single value.
    Var,
    /// 8: elements of one type.
    Array,
    /// 9: elements of different types.
    Record,
}

impl ObjectCode {
    /// Returns the object code with this number.
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

    /// Returns the name in CiA 301.
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

    /// Returns whether an object of this code has sub-indices.
    pub fn has_subs(self) -> bool {
        matches!(self, ObjectCode::Array | ObjectCode::Record | ObjectCode::DefStruct)
    }
}
