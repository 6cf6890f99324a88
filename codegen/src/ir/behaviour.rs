//! Access, bindings, units, storage and availability of items.

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
    /// `rwr`: read and write, and a process input (may go in a TPDO).
    #[cfg_attr(feature = "serde", serde(rename = "rwr"))]
    ReadWriteInput,
    /// `rww`: read and write, and a process output (may come in an RPDO).
    #[cfg_attr(feature = "serde", serde(rename = "rww"))]
    ReadWriteOutput,
    /// `const`: read-only and never changes.
    #[cfg_attr(feature = "serde", serde(rename = "const"))]
    Constant,
}

impl Access {
    /// The access type that CiA 306 spells so, in any case.
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

    /// The spelling of CiA 306.
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

    /// Whether it can be read.
    pub fn readable(self) -> bool {
        self != Access::WriteOnly
    }

    /// Whether it can be written.
    pub fn writable(self) -> bool {
        !matches!(self, Access::ReadOnly | Access::Constant)
    }
}

/// Into which PDOs an item may be mapped, seen from the device: an RPDO is received by it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Mappable {
    /// Into an RPDO.
    pub rpdo: bool,
    /// Into a TPDO.
    pub tpdo: bool,
}

impl Mappable {
    /// What PDOMapping = 1 of CiA 306 means for an item of this access.
    pub fn by_access(access: Access) -> Self {
        Mappable {
            rpdo: matches!(access, Access::WriteOnly | Access::ReadWrite | Access::ReadWriteOutput),
            tpdo: !matches!(access, Access::WriteOnly | Access::ReadWriteOutput),
        }
    }

    /// Whether it may be mapped at all.
    pub fn any(self) -> bool {
        self.rpdo || self.tpdo
    }
}

/// Where an item is found on one bus.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Binding {
    /// An entry of the object dictionary.
    Object {
        /// On which buses.
        buses: ObjectBuses,
        /// Index.
        index: u16,
        /// Sub-index.
        sub_index: u8,
    },
    /// Modbus registers, or single bits.
    Register(Box<RegisterBinding>),
    /// Bits of a record of a PROFINET submodule.
    Record {
        /// Record index.
        index: u16,
        /// First bit: bit 0 is the least significant one of the first byte. A number of several bytes is big-endian and
        /// begins at bit 0 of its first byte.
        bit_offset: u32,
        /// Number of bits.
        bits: u32,
    },
    /// Bits of a fixed process image.
    Image(Box<ImageBinding>),
    /// A numbered parameter in a named space, reached by messages.
    Parameter {
        /// The space.
        space: CompactString,
        /// The number.
        code: u32,
    },
    /// A named parameter of an ASCII protocol.
    Ascii(CompactString),
    /// Memory of an EtherCAT slave controller.
    EscMemory {
        /// Address.
        address: u16,
        /// Number of bytes.
        length: u16,
    },
    /// Write the number to one item, and read or write the value through another.
    Indirect(Box<IndirectBinding>),
}

/// The buses on which an object is found under one index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ObjectBuses {
    /// On CANopen.
    pub canopen: bool,
    /// On EtherCAT (CAN application protocol over EtherCAT).
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
    /// An entry of a CANopen object dictionary.
    pub fn canopen(index: u16, sub_index: u8) -> Self {
        Binding::Object { buses: ObjectBuses::CANOPEN, index, sub_index }
    }

    /// An entry of the object dictionary of an EtherCAT slave.
    pub fn coe(index: u16, sub_index: u8) -> Self {
        Binding::Object { buses: ObjectBuses::COE, index, sub_index }
    }
}

/// Where an item is found on Modbus.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RegisterBinding {
    /// Which table.
    pub space: RegisterSpace,
    /// Address on the wire, counted from 0.
    pub address: u16,
    /// The number, or numbers, as the source prints them: `40102–40103`, `R01`; empty if it prints the address on the wire.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "CompactString::is_empty"))]
    pub printed: CompactString,
    /// Whether the order of words is an assumption.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "is_false"))]
    pub is_order_assumed: bool,
    /// Number of registers (of bits in a coil or input table).
    pub count: u16,
    /// Whether the less significant word comes first.
    pub low_word_first: bool,
    /// Whether the bytes of a word are swapped.
    pub bytes_swapped: bool,
    /// First bit within the register, where the item is a part of it.
    pub bit_offset: Option<u8>,
    /// How many registers of 16 bits one address stands for: 2 where a device gives each of its registers of 32 bits one.
    #[cfg_attr(feature = "serde", serde(default = "one", skip_serializing_if = "is_one"))]
    pub words_per_address: u8,
    /// Whether a value with fewer bits than the registers have fills them: with copies of its sign, or zeros where it has none.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "is_false"))]
    pub extended: bool,
}

impl RegisterBinding {
    /// The last address, counted from 0.
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

/// The four tables of Modbus.
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

/// Bits of a fixed process image.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ImageBinding {
    /// Name of the image.
    pub image: CompactString,
    /// First bit.
    pub bit_offset: u32,
    /// Number of bits.
    pub bits: u32,
    /// The type that the value has there, where it isn't the item's.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub ty: Option<Type>,
}

/// Access through a window: the number of the item is written to one item, and its value read or written through another.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct IndirectBinding {
    /// The space that the number is one of.
    pub space: CompactString,
    /// Which window of the space it is, counted from 0.
    pub window: u8,
    /// The buses on which it serves.
    pub buses: Buses,
    /// The number.
    pub number: u32,
    /// How the value is read.
    pub read: Option<WindowSide>,
    /// How it is written.
    pub write: Option<WindowSide>,
}

/// One way through a window.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct WindowSide {
    /// The item that takes the number.
    pub number: ItemRef,
    /// The item that has, or takes, the value.
    pub value: ItemRef,
    /// Whether the number is written before the value, where the source says so.
    pub number_first: Option<bool>,
    /// Whether the device sets the number to 0 once it is done, where the source says so here.
    pub clears: Option<bool>,
    /// How many milliseconds the device needs.
    pub wait: Option<u32>,
    /// After how many milliseconds the device should have set the number to 0.
    pub timeout: Option<u32>,
    /// The procedure that describes the handshake, if it has one.
    pub procedure: Option<ProcedureRef>,
}

/// Unit and scale of an item.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Quantity {
    /// Symbol of the unit of the physical value (`rpm`, `0.1 A`), as the source has it.
    pub unit: CompactString,
    /// The unit in other languages.
    pub units: Texts,
    /// How the raw number relates to the physical one.
    pub scale: Option<Scale>,
    /// Raw values that aren't numbers, with their meaning (0xFFFF = check off).
    pub sentinels: Vec<(Value, CompactString)>,
    /// Number of raw steps in which the device rounds.
    pub step: Option<Value>,
    /// What the physical number is in a unit of the machine that the device drives.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub machine: Option<Box<MachineUnit>>,
    /// Numbers that the source converts as examples.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Vec::is_empty"))]
    pub conversions: Vec<Conversion>,
}

/// A number that a source converts as an example.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Conversion {
    /// The raw number.
    pub raw: Option<i128>,
    /// The physical one.
    pub value: Option<f64>,
    /// Its unit, where it isn't that of the item.
    pub unit: Option<CompactString>,
    /// Given numbers of the machine that the example has.
    pub given: Vec<(CompactString, f64)>,
    /// The model whose constants it uses.
    pub model: Option<CompactString>,
    /// The value of the item that the scale depends on.
    pub by: Option<f64>,
    /// What the source says about it.
    pub documentation: Option<Box<Documentation>>,
    /// Where it is declared.
    pub at: Span,
}

/// A unit of the machine that a device drives: the physical number, multiplied and divided by numbers that only whoever builds the
/// machine knows ([`GivenNumber`]).
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MachineUnit {
    /// Symbol of the unit.
    pub unit: CompactString,
    /// The given numbers that multiply.
    pub times: Vec<CompactString>,
    /// The given numbers that divide.
    pub over: Vec<CompactString>,
}

/// A number that no device holds and whoever builds the machine knows, such as the pitch of a screw.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct GivenNumber {
    /// Its name.
    pub name: CompactString,
    /// Symbol of its unit.
    pub unit: CompactString,
    /// What it is on the models of the device, where these know it: the model and its number.
    pub models: Vec<(CompactString, Value)>,
    /// What the source says about it.
    pub documentation: Option<Box<Documentation>>,
    /// Contradictions of the source.
    pub doubts: Doubts,
    /// Where it is declared.
    pub origin: Origin,
}

/// Storage, side effects and conditions of writing.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Behaviour {
    /// Where the value is kept over power-off.
    pub storage: Storage,
    /// When a write takes effect, where not at once.
    pub effective: Option<CompactString>,
    /// States, modes or orders in which writing is allowed.
    pub write_when: Vec<Condition>,
    /// The only values that may be written, where they aren't those that can be read.
    pub writable_values: Vec<Value>,
    /// What else writing does.
    pub side_effects: Vec<CompactString>,
    /// Whether the device clears the value by itself.
    pub self_clearing: bool,
    /// Whether it can be written only once.
    pub write_once: bool,
    /// Whether the backup of a device keeps it (Backup of ETG.2000).
    pub backup: bool,
    /// Whether it is a setting of the application (Setting of ETG.2000).
    pub setting: bool,
    /// Its role in functional safety (SafetyMapping of ETG.2000: `si`, `so`, `sio`, `sp`).
    pub safety: Option<CompactString>,
    /// Mapping into a safety-relevant data object of CANopen, if it is allowed (SRDOMapping of CiA 306-1).
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub srdo: Option<Srdo>,
    /// Whether a tool doesn't show it (Visible of GSDML).
    pub hidden: bool,
    /// What the slave's own side may do with memory of its slave controller (PDI access in ETG.1000.4).
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub pdi_access: Option<Access>,
    /// Communication states in which reading is allowed (ETG.2000 ReadRestrictions); empty = all.
    pub read_states: Vec<CompactString>,
    /// Communication states in which writing is allowed (ETG.2000 WriteRestrictions); empty = all.
    pub write_states: Vec<CompactString>,
}

/// How an object is mapped into a safety-relevant data object (EN 50325-5).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Srdo {
    /// Index and sub-index of the object with the bitwise inverted data (InvertedSRAD of CiA 306-1).
    pub inverted: Option<(u16, u8)>,
}

/// Where a value is kept over power-off.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Storage {
    /// The source doesn't say.
    #[default]
    Unknown,
    /// Lost.
    Volatile,
    /// Kept as soon as it is written.
    Immediate,
    /// Kept once this command was given.
    OnCommand(ElementRef),
}

/// Models, firmware versions, options and buses that have an item.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Availability {
    /// Models; empty = all.
    pub models: Vec<CompactString>,
    /// First firmware version that has it.
    pub since: Option<CompactString>,
    /// First firmware version that doesn't have it any more.
    pub until: Option<CompactString>,
    /// What replaces it from then on: an item or a message, or of bits and values another one of these, which has no id.
    pub replaced_by: Option<ElementRef>,
    /// Options that have to be fitted.
    pub options: Vec<CompactString>,
    /// The only buses on which it exists, where its addresses don't tell; empty = all.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Buses::is_empty"))]
    pub buses: Buses,
}
