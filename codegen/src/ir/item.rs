//! Items and the groups that hold them.

use smallvec::SmallVec;
use thin_vec::ThinVec;

use super::{
    Access, Availability, Behaviour, Binding, Bus, CompactString, Documentation, Doubts, Extensions, Fact, FactOrigin,
    FactOrigins, ItemRef, ItemVariant, Limits, Mappable, Quantity, Rule, Texts, Type, Value,
};
use crate::source::{Origin, Span};

/// One value of the device.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Item {
    /// Its name as the source spells it (ParameterName in CiA 306); may be empty.
    pub name: CompactString,
    /// The name in other languages.
    pub names: Texts,
    /// Where it is found on each bus.
    pub bindings: SmallVec<[Binding; 1]>,
    /// Its type.
    pub ty: Type,
    /// Access rights.
    pub access: Access,
    /// Into which PDOs it may be mapped.
    pub mappable: Mappable,
    /// Its value before anybody wrote it.
    pub default: Option<Value>,
    /// The values it may have, where the source says so; else all of its type.
    pub limits: Limits,
    /// What differs between models or buses, in the order of the source.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "ThinVec::is_empty"))]
    pub variants: ThinVec<ItemVariant>,
    /// What a DCF or XDC sets for this one device.
    pub configured: Option<Box<Configured>>,
    /// Unit and scale.
    pub quantity: Option<Box<Quantity>>,
    /// Storage, side effects and conditions of writing.
    pub behaviour: Option<Box<Behaviour>>,
    /// Models, firmware versions and options that have it.
    pub availability: Option<Box<Availability>>,
    /// Other items that hold the same value, a part of it, or its length.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub related: Option<Box<RelatedItems>>,
    /// Whether the sub-index exists and means nothing.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "std::ops::Not::not"))]
    pub is_reserved: bool,
    /// Whether it exists only at times.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "std::ops::Not::not"))]
    pub is_optional: bool,
    /// Of a device with several axes: whether there is one for all of them.
    pub shared_by_axes: bool,
    /// ObjFlags of CiA 306: bit 0 refuse write on download, bit 1 refuse read on scan; further bits are kept.
    pub flags: u32,
    /// What the source says about it.
    pub documentation: Option<Box<Documentation>>,
    /// Contradictions of the source.
    pub doubts: Doubts,
    /// What the source says beyond that.
    pub extensions: Extensions,
    /// Where it is declared.
    pub origin: Origin,
    /// Where its facts stand.
    pub at: ItemSpans,
    /// The facts that do not come from the description itself.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "FactOrigins::is_empty"))]
    pub origins: FactOrigins,
}

impl Item {
    /// An item with nothing but an address: read-only, type unknown.
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

    /// Index and sub-index, where the item is an entry of an object dictionary.
    pub fn object(&self) -> Option<(u16, u8)> {
        self.bindings.iter().find_map(|binding| match binding {
            Binding::Object { index, sub_index, .. } => Some((*index, *sub_index)),
            _ => None,
        })
    }

    /// Whether the source says nothing of the access rights, so that `access` is an assumption.
    pub fn is_access_assumed(&self) -> bool {
        self.origins.get(Fact::Access) == Some(&FactOrigin::Rule(Rule::UnstatedAccess))
    }

    /// The access rights as documentation shows them: `rw?` where they are an assumption.
    pub fn access_name(&self) -> &'static str {
        match self.is_access_assumed() {
            true if self.access == Access::ReadOnly => "ro?",
            true => "rw?",
            false => self.access.name(),
        }
    }

    /// What differs on a bus, whatever the model.
    fn variants_on(&self, bus: Bus) -> impl Iterator<Item = &ItemVariant> {
        self.variants.iter().filter(move |variant| variant.models.is_empty() && variant.buses.contains(bus))
    }

    /// The type that the value has on a bus.
    pub fn type_on(&self, bus: Bus) -> Type {
        self.variants_on(bus).find_map(|variant| variant.ty).unwrap_or(self.ty)
    }

    /// The type that the value has as an object: on CANopen, or on EtherCAT where it is no object of CANopen.
    pub fn object_type(&self) -> Type {
        let is_on_canopen = |binding: &Binding| matches!(binding, Binding::Object { buses, .. } if buses.canopen);
        self.type_on(if self.bindings.iter().any(is_on_canopen) { Bus::CanOpen } else { Bus::EtherCat })
    }

    /// What may be done on a bus.
    pub fn access_on(&self, bus: Bus) -> Access {
        self.variants_on(bus).find_map(|variant| variant.access).unwrap_or(self.access)
    }

    /// The only values on a bus, where they are fewer than elsewhere.
    pub fn limits_on(&self, bus: Bus) -> Option<&Limits> {
        self.variants_on(bus)
            .map(|variant| &variant.limits)
            .find(|limits| !limits.is_empty() || !limits.allowed.is_empty())
    }

    /// The value that a DCF sets.
    pub fn configured_value(&self) -> Option<&Value> {
        self.configured.as_ref()?.value.as_ref()
    }

    /// The value a device starts with: the configured one of a DCF, else the default.
    pub fn initial(&self) -> Option<&Value> {
        self.configured_value().or(self.default.as_ref())
    }

    /// The default, if it is an integer.
    pub fn default_integer(&self) -> Option<i128> {
        self.default.as_ref().and_then(Value::as_int)
    }
}

/// Other items that hold the value of an item, a part of it, or its length.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RelatedItems {
    /// The item that is the same value under another name.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub same_as: Option<ItemRef>,
    /// The item that is the same quantity in another scale.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub same_quantity: Option<ItemRef>,
    /// The item that holds the upper half of the value.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub upper_half: Option<ItemRef>,
    /// The item that holds how many elements are valid.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub valid_count: Option<ItemRef>,
}

impl RelatedItems {
    /// Returns all references.
    pub fn all(&self) -> impl Iterator<Item = &ItemRef> {
        let RelatedItems { same_as, same_quantity, upper_half, valid_count } = self;
        [same_as, same_quantity, upper_half, valid_count].into_iter().flatten()
    }

    /// Returns all references, to be changed.
    pub(crate) fn all_mut(&mut self) -> impl Iterator<Item = &mut ItemRef> {
        let RelatedItems { same_as, same_quantity, upper_half, valid_count } = self;
        [same_as, same_quantity, upper_half, valid_count].into_iter().flatten()
    }
}

/// Where the facts of an item stand in the source; an empty span for what the source doesn't say.
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
    /// The words that say what it is.
    pub documentation: Span,
}

/// What a configuration file (DCF, XDC) sets for one device.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Configured {
    /// ParameterValue: the value of this device.
    pub value: Option<Value>,
    /// Denotation: the name of the item in this application.
    pub denotation: Option<CompactString>,
    /// UploadFile: where a domain that was read is kept.
    pub upload_file: Option<CompactString>,
    /// DownloadFile: what is written into a domain.
    pub download_file: Option<CompactString>,
}

/// Items that the source keeps together.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Group {
    /// Its name as the source spells it; may be empty.
    pub name: CompactString,
    /// The name in other languages.
    pub names: Texts,
    /// What it is.
    pub kind: GroupKind,
    /// Its items, by sub-index or in the order of the source.
    pub items: Vec<Item>,
    /// Items that name further objects or parameters of interest (ObjectLinks of CiA 306), by index.
    pub links: Vec<u16>,
    /// ObjFlags of the object itself.
    pub flags: u32,
    /// Whether its index grows with the slot of its module (ETG.2000).
    pub depends_on_slot: bool,
    /// Whether its index grows with the slot group of its module (ETG.2000).
    pub depends_on_slot_group: bool,
    /// How many of its items the source describes at the object itself (SubItem in Info of ETG.2000); the others follow
    /// from its type.
    pub described: u32,
    /// What the source says about it.
    pub documentation: Option<Box<Documentation>>,
    /// Contradictions of the source.
    pub doubts: Doubts,
    /// What the source says beyond that.
    pub extensions: Extensions,
    /// Where it is declared.
    pub origin: Origin,
    /// Where its name stands.
    pub name_at: Span,
}

impl Group {
    /// An object without items.
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

    /// The index, where the group is an object.
    pub fn index(&self) -> Option<u16> {
        match self.kind {
            GroupKind::Object { index, .. } => Some(index),
            _ => None,
        }
    }

    /// The object code, where the group is an object.
    pub fn object_code(&self) -> Option<ObjectCode> {
        match self.kind {
            GroupKind::Object { code, .. } => Some(code),
            _ => None,
        }
    }

    /// The item at a sub-index.
    pub fn sub(&self, sub_index: u8) -> Option<&Item> {
        self.items.get(self.position(sub_index)?)
    }

    /// The position of the item at a sub-index.
    pub(crate) fn position(&self, sub_index: u8) -> Option<usize> {
        let at = |item: &Item| item.object().map(|(_, sub)| sub);
        let sorted = self.items.binary_search_by_key(&Some(sub_index), at);
        sorted.ok().or_else(|| self.items.iter().position(|item| at(item) == Some(sub_index)))
    }
}

/// What a group is.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum GroupKind {
    /// An object of an object dictionary (CiA 301 7.4, ETG.1000.6 5.6).
    Object {
        /// Its index.
        index: u16,
        /// Its object code.
        code: ObjectCode,
        /// Mandatory, optional or conditional, where the source says so.
        category: Option<Category>,
    },
    /// A chapter of a register table.
    Chapter,
    /// A parameter record of a PROFINET submodule.
    Record(Box<Record>),
    /// A fixed process image.
    Image {
        /// Length in bytes.
        length: u32,
    },
}

/// What a parameter record of a PROFINET submodule is (ParameterRecordDataItem of GSDML).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Record {
    /// Record index.
    pub index: u16,
    /// Length in bytes.
    pub length: u32,
    /// Order of transfer at start-up; 0 = any.
    pub transfer_sequence: u16,
    /// Whether a change while the device runs disturbs it, where given (`ChangeableWithBump`).
    pub changeable_with_bump: Option<bool>,
    /// Fixed bytes, by offset; bytes that neither a constant nor an item covers are 0.
    pub constants: Vec<(u32, Vec<u8>)>,
}

/// Whether an object has to exist.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Category {
    /// It has to.
    Mandatory,
    /// It may.
    Optional,
    /// It has to under a condition.
    Conditional,
    /// The vendor's own.
    Manufacturer,
}

/// Object codes of CiA 301 7.4.3.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum ObjectCode {
    /// 0: no data.
    Null,
    /// 2: a block of data of any length.
    Domain,
    /// 5: the definition of a basic type.
    DefType,
    /// 6: the definition of a record type.
    DefStruct,
    /// 7: one value.
    Var,
    /// 8: equal elements.
    Array,
    /// 9: different elements.
    Record,
}

impl ObjectCode {
    /// The object code with this number.
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

    /// The name in CiA 301.
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

    /// Whether an object of this code has sub-indices.
    pub fn has_subs(self) -> bool {
        matches!(self, ObjectCode::Array | ObjectCode::Record | ObjectCode::DefStruct)
    }
}
