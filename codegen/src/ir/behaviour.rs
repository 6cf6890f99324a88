//! Access rights, bindings, units, storage and availability of items.

use super::{
    Buses, CompactString, Condition, Documentation, Doubts, ElementRef, ItemRef, ProcedureRef, Scale, Texts, Type,
    Value,
};
use crate::source::{Origin, Span};

/// Access rights of an item, seen from the bus (CiA 306; ETG.2000 Flags/Access).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Access {
    /// `ro`.
    #[default]
    #[cfg_attr(feature = "serde", serde(rename = "ro"))]
    ReadOnly,
    /// `wo`.
    #[cfg_attr(feature = "serde", serde(rename = "wo"))]
    WriteOnly,
    /// `rw`.
    #[cfg_attr(feature = "serde", serde(rename = "rw"))]
    ReadWrite,
    /// `rwr`: read-write, and a process input (TPDO).
    #[cfg_attr(feature = "serde", serde(rename = "rwr"))]
    ReadWriteInput,
    /// `rww`: read-write, and a process output (RPDO).
    #[cfg_attr(feature = "serde", serde(rename = "rww"))]
    ReadWriteOutput,
    /// `const`: read-only, and the value never changes.
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

    /// Returns the name in CiA 306.
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
    /// RPDOs.
    pub rpdo: bool,
    /// TPDOs.
    pub tpdo: bool,
}

impl Mappable {
    /// Returns the meaning of PDOMapping = 1 (CiA 306) for an item with these access rights.
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

/// The address of an item on one bus.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Binding {
    /// An entry of the object dictionary.
    Object {
        /// Buses.
        buses: ObjectBuses,
        /// Index.
        index: u16,
        /// Sub-index.
        sub_index: u8,
    },
    /// Modbus registers, coils or discrete inputs.
    Register(Box<RegisterBinding>),
    /// Bits of a record of a PROFINET submodule.
    Record {
        /// Record index.
        index: u16,
        /// Bit offset: bit 0 is the least significant bit of the first byte. A number of several bytes is big-endian and
        /// starts at bit 0 of its first byte.
        bit_offset: u32,
        /// Number of bits.
        bits: u32,
    },
    /// Bits of a fixed process image.
    Image(Box<ImageBinding>),
    /// A parameter of a parameter space. Messages transfer its value.
    Parameter {
        /// Name of the parameter space.
        space: CompactString,
        /// Number of the parameter.
        code: u32,
    },
    /// Name of a parameter of an ASCII protocol.
    Ascii(CompactString),
    /// Memory of an EtherCAT slave controller.
    EscMemory {
        /// Address.
        address: u16,
        /// Number of bytes.
        length: u16,
    },
    /// Indirect access through a window: one item selects the parameter, another item transfers its value.
    Indirect(Box<IndirectBinding>),
}

/// The buses on which an object has one index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ObjectBuses {
    /// CANopen.
    pub canopen: bool,
    /// EtherCAT (CAN application protocol over EtherCAT, CoE).
    pub coe: bool,
}

impl ObjectBuses {
    /// CANopen only.
    pub const CANOPEN: ObjectBuses = ObjectBuses { canopen: true, coe: false };
    /// EtherCAT only.
    pub const COE: ObjectBuses = ObjectBuses { canopen: false, coe: true };
    /// Neither.
    pub const NONE: ObjectBuses = ObjectBuses { canopen: false, coe: false };
}

impl Binding {
    /// Creates the address of an entry of a CANopen object dictionary.
    pub fn canopen(index: u16, sub_index: u8) -> Self {
        Binding::Object { buses: ObjectBuses::CANOPEN, index, sub_index }
    }

    /// Creates the address of an entry of the object dictionary of an EtherCAT slave.
    pub fn coe(index: u16, sub_index: u8) -> Self {
        Binding::Object { buses: ObjectBuses::COE, index, sub_index }
    }
}

/// The address of an item on Modbus, and its encoding.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RegisterBinding {
    /// Modbus table.
    pub space: RegisterSpace,
    /// Register address: zero-based wire address.
    pub address: u16,
    /// Printed address: `40102–40103`, `R01`; empty if the source prints the wire address.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "CompactString::is_empty"))]
    pub printed: CompactString,
    /// Whether the word order is an assumption.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "is_false"))]
    pub is_order_assumed: bool,
    /// Number of registers, coils or discrete inputs.
    pub count: u16,
    /// Whether the least significant word comes first.
    pub low_word_first: bool,
    /// Whether the bytes of each word are swapped.
    pub bytes_swapped: bool,
    /// Bit offset in the register, if the item is a part of a register.
    pub bit_offset: Option<u8>,
    /// Number of 16-bit registers at one address: 2 if a device has 32-bit registers.
    #[cfg_attr(feature = "serde", serde(default = "one", skip_serializing_if = "is_one"))]
    pub words_per_address: u8,
    /// Whether a value with fewer bits than its registers is extended: sign-extended if it is signed, otherwise with zeros.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "is_false"))]
    pub extended: bool,
}

impl RegisterBinding {
    /// Returns the last wire address.
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
    /// 0x: coils.
    Coil,
    /// 1x: discrete inputs.
    DiscreteInput,
    /// 3x: input registers.
    Input,
    /// 4x: holding registers.
    Holding,
}

/// The address of an item in a process image with a fixed layout.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ImageBinding {
    /// Name of the image.
    pub image: CompactString,
    /// Bit offset.
    pub bit_offset: u32,
    /// Number of bits.
    pub bits: u32,
    /// Type in the image, if it differs from the type of the item.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub ty: Option<Type>,
}

/// Indirect access through a window: the number of the parameter is written to one item, and another item transfers its value.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct IndirectBinding {
    /// Name of the space that the number belongs to.
    pub space: CompactString,
    /// Zero-based position of the window in the space.
    pub window: u8,
    /// Buses on which the window exists.
    pub buses: Buses,
    /// Number of the parameter.
    pub number: u32,
    /// Read access.
    pub read: Option<WindowSide>,
    /// Write access.
    pub write: Option<WindowSide>,
}

/// Read or write access through a window.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct WindowSide {
    /// Item that selects the parameter by its number.
    pub number: ItemRef,
    /// Item that transfers the value.
    pub value: ItemRef,
    /// Whether a client writes the number before the value, if the source states it.
    pub number_first: Option<bool>,
    /// Whether the device sets the number to 0 after the access, if the source states it.
    pub clears: Option<bool>,
    /// Duration of the access in milliseconds.
    pub wait: Option<u32>,
    /// Timeout in milliseconds for the device to set the number to 0.
    pub timeout: Option<u32>,
    /// Procedure of the handshake, if the source has one.
    pub procedure: Option<ProcedureRef>,
}

/// Unit and scale factor of an item.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Quantity {
    /// Unit symbol of the physical value as the source spells it (`rpm`, `0.1 A`).
    pub unit: CompactString,
    /// Unit in other languages.
    pub units: Texts,
    /// Relation of raw value and physical value.
    pub scale: Option<Scale>,
    /// Raw values with a special meaning (0xFFFF = monitoring off).
    pub sentinels: Vec<(Value, CompactString)>,
    /// Rounding step of the device in raw units.
    pub step: Option<Value>,
    /// Conversion of the physical value to a unit of the machine.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub machine: Option<Box<MachineUnit>>,
    /// Example conversions in the source.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Vec::is_empty"))]
    pub conversions: Vec<Conversion>,
}

/// An example conversion in the source.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Conversion {
    /// Raw value.
    pub raw: Option<i128>,
    /// Physical value.
    pub value: Option<f64>,
    /// Unit, if it differs from the unit of the item.
    pub unit: Option<CompactString>,
    /// Values of machine constants in the example.
    pub given: Vec<(CompactString, f64)>,
    /// Model whose constants the example uses.
    pub model: Option<CompactString>,
    /// Value of the item that the scale factor depends on.
    pub by: Option<f64>,
    /// Description from the source.
    pub documentation: Option<Box<Documentation>>,
    /// Location in the source.
    pub at: Span,
}

/// A unit of the machine. A value in this unit is the physical value, multiplied and divided by machine constants ([`GivenNumber`]).
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MachineUnit {
    /// Unit symbol.
    pub unit: CompactString,
    /// Machine constants that multiply.
    pub times: Vec<CompactString>,
    /// Machine constants that divide.
    pub over: Vec<CompactString>,
}

/// A machine constant that the device does not store, such as the pitch of a lead screw.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct GivenNumber {
    /// Name.
    pub name: CompactString,
    /// Unit symbol.
    pub unit: CompactString,
    /// Values for models of the device that define the constant.
    pub models: Vec<(CompactString, Value)>,
    /// Description from the source.
    pub documentation: Option<Box<Documentation>>,
    /// Ambiguities in the source, with assumptions.
    pub doubts: Doubts,
    /// Location in the source.
    pub origin: Origin,
}

/// Storage, side effects and conditions of writing.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Behaviour {
    /// Whether the value is volatile or non-volatile.
    pub storage: Storage,
    /// When a write takes effect, if not immediately.
    pub effective: Option<CompactString>,
    /// Conditions on other items under which a client can write the item.
    pub write_when: Vec<Condition>,
    /// Values that can be written, if they differ from those that can be read.
    pub writable_values: Vec<Value>,
    /// Side effects of writing.
    pub side_effects: Vec<CompactString>,
    /// Whether the device clears the value automatically.
    pub self_clearing: bool,
    /// Whether the item can be written only once.
    pub write_once: bool,
    /// Whether the item is a part of the device backup (Backup of ETG.2000).
    pub backup: bool,
    /// Whether the item is a setting of the application (Setting of ETG.2000).
    pub setting: bool,
    /// Role in functional safety (SafetyMapping of ETG.2000: `si`, `so`, `sio`, `sp`).
    pub safety: Option<CompactString>,
    /// Mapping into a safety-relevant data object of CANopen, if allowed (SRDOMapping of CiA 306-1).
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub srdo: Option<Srdo>,
    /// Whether tools hide the item (Visible of GSDML).
    pub hidden: bool,
    /// Access rights of the slave application to ESC memory (PDI access in ETG.1000.4).
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
    /// Not stated by the source.
    #[default]
    Unknown,
    /// Volatile.
    Volatile,
    /// Non-volatile: stored immediately by each write.
    Immediate,
    /// Non-volatile: stored on this command.
    OnCommand(ElementRef),
}

/// Models, firmware versions, options and buses on which an element exists.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Availability {
    /// Models; empty = all.
    pub models: Vec<CompactString>,
    /// First firmware version that has the element.
    pub since: Option<CompactString>,
    /// First firmware version that no longer has the element.
    pub until: Option<CompactString>,
    /// Replacement: an item or a message, or for bits and values another bit or value, which has no id.
    pub replaced_by: Option<ElementRef>,
    /// Hardware options that the element requires.
    pub options: Vec<CompactString>,
    /// Buses, if they do not follow from addresses; empty = all.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Buses::is_empty"))]
    pub buses: Buses,
}
