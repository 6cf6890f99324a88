//! Access rights, bindings, units, storage and availability of items.

use std::sync::Arc;

use super::{
    Buses, CompactString, Condition, Documentation, Doubts, ElementRef, GivenRef, ImageRef, ItemRef, ProcedureRef,
    Scale, SpaceRef, Texts, Type, Value, VariantRef,
};
use crate::source::{Origin, Span};

/// Access rights of an item, seen from the bus (CiA 306; ETG.2000 Flags/Access).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Access {
    /// Read-only (`ro`).
    #[default]
    #[cfg_attr(feature = "serde", serde(rename = "ro"))]
    ReadOnly,
    /// Write-only (`wo`).
    #[cfg_attr(feature = "serde", serde(rename = "wo"))]
    WriteOnly,
    /// Read-write (`rw`).
    #[cfg_attr(feature = "serde", serde(rename = "rw"))]
    ReadWrite,
    /// Read-write, and mappable only into TPDOs as a process input (`rwr`).
    #[cfg_attr(feature = "serde", serde(rename = "rwr"))]
    ReadWriteInput,
    /// Read-write, and mappable only into RPDOs as a process output (`rww`).
    #[cfg_attr(feature = "serde", serde(rename = "rww"))]
    ReadWriteOutput,
    /// Read-only, with a value that never changes (`const`).
    #[cfg_attr(feature = "serde", serde(rename = "const"))]
    Constant,
}

impl Access {
    /// Returns the access rights with this name in CiA 306, ignoring case.
    pub fn from_cia306(text: &str) -> Option<Self> {
        const SPELLINGS: [(&str, Access); 6] = [
            ("ro", Access::ReadOnly),
            ("rw", Access::ReadWrite),
            ("const", Access::Constant),
            ("wo", Access::WriteOnly),
            ("rwr", Access::ReadWriteInput),
            ("rww", Access::ReadWriteOutput),
        ];
        SPELLINGS.iter().find(|(name, _)| name.eq_ignore_ascii_case(text)).map(|&(_, access)| access)
    }

    /// Returns the CiA 306 name of the access rights, such as `rw`.
    pub fn name(self) -> &'static str {
        match self {
            Access::ReadOnly => "ro",
            Access::WriteOnly => "wo",
            Access::ReadWrite => "rw",
            Access::ReadWriteInput => "rwr",
            Access::ReadWriteOutput => "rww",
            Access::Constant => "const",
        }
    }

    /// Returns whether the item can be read.
    pub fn readable(self) -> bool {
        self != Access::WriteOnly
    }

    /// Returns whether the item can be written.
    pub fn writable(self) -> bool {
        !matches!(self, Access::ReadOnly | Access::Constant)
    }
}

/// PDOs into which an item can be mapped. The device receives RPDOs and sends TPDOs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Mappable {
    /// True if RPDOs can map the item.
    pub rpdo: bool,
    /// True if TPDOs can map the item.
    pub tpdo: bool,
}

impl Mappable {
    /// Returns the PDOs that PDOMapping = 1 (CiA 306) allows for an item with these access rights.
    pub fn by_access(access: Access) -> Self {
        Mappable {
            rpdo: matches!(access, Access::WriteOnly | Access::ReadWrite | Access::ReadWriteOutput),
            tpdo: !matches!(access, Access::WriteOnly | Access::ReadWriteOutput),
        }
    }

    /// Returns whether the item can be mapped into a PDO.
    pub fn any(self) -> bool {
        self.rpdo || self.tpdo
    }
}

/// The address of an item on one or more buses.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Binding {
    /// An entry of the object dictionary.
    Object {
        /// Buses on which the object has this address.
        buses: ObjectBuses,
        /// Index of the object.
        index: u16,
        /// Sub-index of the entry.
        sub_index: u8,
    },
    /// Modbus registers, coils or discrete inputs.
    Register(Box<RegisterBinding>),
    /// Bits of a record of a PROFINET submodule.
    Record {
        /// Index of the record.
        index: u16,
        /// Bit offset in the record. Bit 0 is the least significant bit of the first byte. A number of several bytes is big-endian,
        /// and its offset is that of bit 0 of its first byte.
        bit_offset: u32,
        /// Length in bits.
        bits: u32,
    },
    /// Bits of a fixed process image.
    Image(Box<ImageBinding>),
    /// A parameter of a parameter space. Messages transfer the value of the parameter.
    Parameter(Box<ParameterBinding>),
    /// A parameter of an ASCII protocol, identified by its name.
    Ascii(CompactString),
    /// A memory range of an EtherCAT slave controller (ESC).
    EscMemory {
        /// Address of the first byte.
        address: u16,
        /// Length in bytes.
        length: u16,
    },
    /// Indirect access through a window: one item selects the parameter, and another item transfers the parameter's value.
    Indirect(Box<IndirectBinding>),
}

/// The buses on which an object has a certain address.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ObjectBuses {
    /// True if the object exists on CANopen.
    pub canopen: bool,
    /// True if the object exists on EtherCAT (CAN application protocol over EtherCAT, CoE).
    pub coe: bool,
}

impl ObjectBuses {
    /// Buses of an object that exists on CANopen only.
    pub const CANOPEN: ObjectBuses = ObjectBuses { canopen: true, coe: false };
    /// Buses of an object that exists on EtherCAT only.
    pub const COE: ObjectBuses = ObjectBuses { canopen: false, coe: true };
    /// The empty set of buses.
    pub const NONE: ObjectBuses = ObjectBuses { canopen: false, coe: false };
}

impl Binding {
    /// Creates the address of an entry of a CANopen object dictionary.
    pub fn canopen(index: u16, sub_index: u8) -> Self {
        Binding::Object { buses: ObjectBuses::CANOPEN, index, sub_index }
    }

    /// Creates the address of a parameter of a parameter space.
    pub fn parameter(space: &str, code: u32) -> Self {
        Binding::Parameter(Box::new(ParameterBinding { space: space.into(), code }))
    }

    /// Creates the address of an entry in the object dictionary of an EtherCAT slave (CoE).
    pub fn coe(index: u16, sub_index: u8) -> Self {
        Binding::Object { buses: ObjectBuses::COE, index, sub_index }
    }
}

/// The address of an item on Modbus, and the encoding of its value.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RegisterBinding {
    /// Modbus table that contains the item.
    pub space: RegisterSpace,
    /// Zero-based wire address of the first register, coil or discrete input.
    pub address: u16,
    /// Address as the source prints it, such as `40102–40103` or `R01`; empty if the source prints no address other than the
    /// wire address.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "CompactString::is_empty"))]
    pub printed: CompactString,
    /// True if the word order is an assumption.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "is_false"))]
    pub is_order_assumed: bool,
    /// Number of 16-bit words, coils or discrete inputs. A 32-bit register counts as two words.
    pub count: u16,
    /// True if the least significant word comes first.
    pub low_word_first: bool,
    /// True if the bytes of each word are swapped.
    pub bytes_swapped: bool,
    /// Bit offset of the item in its register; `None` if the item occupies whole registers.
    pub bit_offset: Option<u8>,
    /// Number of 16-bit words at one register address; 2 if the device has 32-bit registers.
    #[cfg_attr(feature = "serde", serde(default = "one", skip_serializing_if = "is_one"))]
    pub words_per_address: u8,
    /// True if a value that is shorter than its registers is extended to their length. A signed value is extended with
    /// its sign, and an unsigned value with zeros.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "is_false"))]
    pub extended: bool,
}

impl RegisterBinding {
    /// Creates the address of an item in `count` whole registers, with the high word first.
    pub fn new(space: RegisterSpace, address: u16, count: u16) -> Self {
        RegisterBinding {
            space,
            address,
            printed: CompactString::default(),
            is_order_assumed: false,
            count,
            low_word_first: false,
            bytes_swapped: false,
            bit_offset: None,
            words_per_address: 1,
            extended: false,
        }
    }

    /// Returns the last wire address of the item.
    pub fn last(&self) -> u16 {
        let addresses = self.count.div_ceil(u16::from(self.words_per_address.max(1)));
        self.address.saturating_add(addresses.saturating_sub(1))
    }
}

#[cfg(feature = "serde")]
fn one() -> u8 {
    1
}

#[cfg(feature = "serde")]
fn is_false(value: &bool) -> bool {
    !value
}

#[cfg(feature = "serde")]
fn is_one(value: &u8) -> bool {
    *value == 1
}

/// One of the four Modbus tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum RegisterSpace {
    /// Coils (0x).
    Coil,
    /// Discrete inputs (1x).
    DiscreteInput,
    /// Input registers (3x).
    Input,
    /// Holding registers (4x).
    Holding,
}

/// The address of an item in a process image with a fixed layout.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ImageBinding {
    /// The process image.
    pub image: ImageRef,
    /// Bit offset of the item in the process image.
    pub bit_offset: u32,
    /// Length of the item in bits.
    pub bits: u32,
    /// Data type that the source declares for the process image; `None` = the item's type.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub ty: Option<Type>,
}

/// The address of an item in a parameter space.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ParameterBinding {
    /// The parameter space.
    pub space: SpaceRef,
    /// Number of the parameter in its parameter space.
    pub code: u32,
}

/// Indirect access through a window. A client writes the number of the parameter to one item, and reads or writes the parameter's
/// value through another item.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct IndirectBinding {
    /// Name of the parameter space in the register table. The number identifies a parameter of this space.
    pub space: CompactString,
    /// Zero-based position of the window in the list of windows of the parameter space.
    pub window: u8,
    /// Buses on which the window exists.
    pub buses: Buses,
    /// Number that selects the parameter.
    pub number: u32,
    /// Items for read access, if the window has read access.
    pub read: Option<WindowSide>,
    /// Items for write access, if the window has write access.
    pub write: Option<WindowSide>,
}

/// The items for read access or for write access through a window.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct WindowSide {
    /// Item to which a client writes the number of the parameter.
    pub number: ItemRef,
    /// Item through which a client reads or writes the value of the parameter.
    pub value: ItemRef,
    /// True if a client has to write the number before the value; `None` if the source does not state the order.
    pub number_first: Option<bool>,
    /// True if the device sets the number to 0 after the access; `None` if the source does not state it.
    pub clears: Option<bool>,
    /// Time in milliseconds that the access takes, if the device does not set the number to 0.
    pub wait: Option<u32>,
    /// Maximum time in milliseconds until the device sets the number to 0.
    pub timeout: Option<u32>,
    /// Procedure that performs the access, if the source describes one.
    pub procedure: Option<ProcedureRef>,
}

/// Unit, scale, special raw values and step of an item, with its machine unit and example conversions.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Quantity {
    /// Unit symbol of the physical value as the source spells it (`rpm`, `0.1 A`).
    pub unit: CompactString,
    /// Unit symbol in other languages.
    pub units: Texts,
    /// Conversion between raw value and physical value.
    pub scale: Option<Scale>,
    /// Raw values with a special meaning, and the meaning of each, such as 0xFFFF for "monitoring off".
    pub sentinels: Vec<(Value, CompactString)>,
    /// Step in raw units. The device rounds written values to multiples of the step.
    pub step: Option<Value>,
    /// Conversion of the physical value to a unit of the driven machine.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub machine: Option<Box<MachineUnit>>,
    /// Example conversions that the source prints.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Vec::is_empty"))]
    pub conversions: Vec<Conversion>,
}

/// An example in the source that converts a raw value to a physical value.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Conversion {
    /// Raw value of the example; `None` = not given.
    pub raw: Option<i128>,
    /// Physical value of the example; `None` = not given.
    pub value: Option<f64>,
    /// Unit of the physical value, if it differs from the item's unit.
    pub unit: Option<CompactString>,
    /// The machine constants that the example uses, and their values.
    pub given: Vec<(GivenRef, f64)>,
    /// Model whose constants the example uses.
    pub model: Option<VariantRef>,
    /// Value of the item that the scale factor depends on.
    pub by: Option<f64>,
    /// Description of the example from the source.
    pub documentation: Option<Arc<Documentation>>,
    /// Location of the example in the source.
    pub at: Span,
}

/// A unit of the driven machine. A value in the machine unit is the physical value, multiplied and divided by machine constants
/// ([`GivenNumber`]).
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MachineUnit {
    /// Symbol of the machine unit.
    pub unit: CompactString,
    /// Machine constants by which the physical value is multiplied.
    pub times: Vec<GivenRef>,
    /// Machine constants by which the physical value is divided.
    pub over: Vec<GivenRef>,
}

/// A machine constant that the device does not store, such as the pitch of a lead screw.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct GivenNumber {
    /// Name of the machine constant.
    pub name: CompactString,
    /// Unit symbol of the machine constant.
    pub unit: CompactString,
    /// Models that define the constant, and its value on each model.
    pub models: Vec<(VariantRef, Value)>,
    /// Description of the machine constant from the source.
    pub documentation: Option<Arc<Documentation>>,
    /// Ambiguities in the source about the machine constant, with the assumptions made.
    pub doubts: Doubts,
    /// Location of the machine constant in the source.
    pub origin: Origin,
}

/// Storage of a value, side effects of writing it, and conditions for reading and writing it. Also contains the role of
/// the item in backup, functional safety and engineering tools.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Behavior {
    /// Storage of the value: volatile or non-volatile.
    pub storage: Storage,
    /// Text that states when a written value takes effect, if it does not take effect immediately.
    pub effective: Option<CompactString>,
    /// Conditions on other items under which a client can write the item.
    pub write_when: Vec<Condition>,
    /// Values that can be written, if they differ from those that can be read.
    pub writable_values: Vec<Value>,
    /// Side effects of writing the value.
    pub side_effects: Vec<CompactString>,
    /// True if the device clears the value automatically.
    pub self_clearing: bool,
    /// True if the item can be written only once.
    pub write_once: bool,
    /// True if the item is a part of the device backup (Backup of ETG.2000).
    pub backup: bool,
    /// True if the item is a setting of the application (Setting of ETG.2000).
    pub setting: bool,
    /// Role in functional safety (SafetyMapping of ETG.2000: `si`, `so`, `sio`, `sp`).
    pub safety: Option<CompactString>,
    /// Mapping into a safety-relevant data object of CANopen, if allowed (SRDOMapping of CiA 306-1).
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub srdo: Option<Srdo>,
    /// True if engineering tools hide the item (Visible of GSDML).
    pub hidden: bool,
    /// Access rights of the slave application (PDI) to ESC memory (ETG.1000.4).
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub pdi_access: Option<Access>,
    /// Communication states in which the item can be read (ETG.2000 ReadRestrictions); empty = all.
    pub read_states: Vec<CompactString>,
    /// Communication states in which the item can be written (ETG.2000 WriteRestrictions); empty = all.
    pub write_states: Vec<CompactString>,
}

/// Mapping of an object into a safety-relevant data object (EN 50325-5).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Srdo {
    /// Index and sub-index of the object with the bitwise inverted data (InvertedSRAD of CiA 306-1).
    pub inverted: Option<(u16, u8)>,
}

/// Storage of a value.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Storage {
    /// The source does not state how the device stores the value.
    #[default]
    Unknown,
    /// The value is volatile.
    Volatile,
    /// The value is non-volatile, and each write stores it immediately.
    Immediate,
    /// The value is non-volatile, and the device stores it on this command.
    OnCommand(ElementRef),
}

/// Models, firmware versions, hardware options and buses on which an element exists, and the replacement for the
/// element.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Availability {
    /// Models that have the element; empty = all.
    pub models: Vec<CompactString>,
    /// First firmware version that has the element.
    pub since: Option<CompactString>,
    /// First firmware version after `since` that no longer has the element.
    pub until: Option<CompactString>,
    /// Replacement for the element. An item or message is replaced by an item or message, and a bit or value by a bit or value. A
    /// reference to a bit or value has no id.
    pub replaced_by: Option<ElementRef>,
    /// Hardware options that the element requires.
    pub options: Vec<CompactString>,
    /// Buses on which the element exists, if they do not follow from its addresses; empty = all.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Buses::is_empty"))]
    pub buses: Buses,
}
