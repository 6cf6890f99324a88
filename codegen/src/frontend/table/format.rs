//! The register table format. `dictionaries/README.md` explains the keys to authors of tables. The doc comments become descriptions in the schema.

use std::fmt;

use super::at::{At, Entries, FlagOr, Literal, OneOrMany, TextOr};
use super::read::{self, Mistake, Node, Read};
#[cfg(test)]
use super::schema;
use super::tree::cited;

/// Key of a field: its name, or the text after `=`.
macro_rules! key {
    ($field:ident) => {
        stringify!($field)
    };
    ($field:ident $key:literal) => {
        $key
    };
}

/// Declares tables of the format with their readers. Every key is optional, and unknown keys are errors. A field whose key is not a valid
/// name has the key after `=`. Names after the table select groups of common keys.
macro_rules! tables {
    ($(
        $(#[$attribute:meta])*
        pub struct $name:ident $(: $($group:ident)+)? { $($fields:tt)* }
    )*) => {$(
        table! { { $($($group)+)? } [$(#[$attribute])*] $name { $($fields)* } }
        $($(words! { $name $group })+)?
    )*};
}

/// Tables with a description.
pub(super) trait Documented {
    fn doc(&self) -> Option<&str>;
}

/// Tables with citations.
pub(super) trait Cited {
    /// Returns the pages or lines as one text.
    fn cited(&self) -> Option<String>;
}

/// Tables with ambiguities.
pub(super) trait Doubted: Cited {
    fn doubt_tables(&self) -> [Option<&OneOrMany<DoubtTable>>; 2];
}

/// Implements the traits of a table's key groups.
macro_rules! words {
    ($name:ident doc) => {
        impl Documented for $name {
            fn doc(&self) -> Option<&str> {
                self.doc.as_deref()
            }
        }
    };
    ($name:ident cite) => {
        impl Cited for $name {
            fn cited(&self) -> Option<String> {
                self.cite.as_ref().map(cited)
            }
        }
    };
    ($name:ident doubt) => {
        impl Doubted for $name {
            fn doubt_tables(&self) -> [Option<&OneOrMany<DoubtTable>>; 2] {
                [self.doubt.as_ref(), self.doubts.as_ref()]
            }
        }
    };
    ($name:ident $group:ident) => {};
}

/// Expands one table: adds its groups of common keys one by one.
macro_rules! table {
    ({ meaning $($group:ident)* } $attributes:tt $name:ident { $($fields:tt)* }) => {
        table! { { $($group)* } $attributes $name {
            $($fields)*
            /// Meaning of the bits: a name of `[bits]`, or the definition.
            #[cfg_attr(test, schemars(transform = schema::keys(schema::BITS)))]
            pub bits: Option<At<TextOr<BitEntries>>>,
            /// Meaning of the values: a name of `[enums]`, or the definition.
            #[cfg_attr(test, schemars(transform = schema::keys(schema::VALUES)))]
            pub values = "enum": Option<At<TextOr<ValueEntries>>>,
            /// Unit: a symbol, or a name of `[units]`.
            pub unit: Option<At<String>>,
            /// Scale factor (physical = raw × scale + offset), or the rule for it.
            pub scale: Option<At<Scaling>>,
            /// Minimum raw value.
            pub min: Option<At<Literal>>,
            /// Maximum raw value.
            pub max: Option<At<Literal>>,
            /// Raw values that are not numbers, with their meaning.
            pub na: Option<Entries<String>>,
            /// Printed conversions, which are compared with the scale.
            pub conversions: Vec<At<ConversionTable>>,
        } }
    };
    ({ window $($group:ident)* } $attributes:tt $name:ident { $($fields:tt)* }) => {
        table! { { $($group)* } $attributes $name {
            $($fields)*
            /// Models that have it; `*` matches any characters.
            pub models: Option<Vec<At<String>>>,
            /// First firmware that has it.
            pub since: Option<String>,
            /// First firmware without it.
            pub until: Option<String>,
        } }
    };
    ({ orig $($group:ident)* } $attributes:tt $name:ident { $($fields:tt)* }) => {
        table! { { $($group)* } $attributes $name {
            $($fields)*
            /// Name or label in the manual's language.
            pub orig: Option<String>,
        } }
    };
    ({ doc $($group:ident)* } $attributes:tt $name:ident { $($fields:tt)* }) => {
        table! { { $($group)* } $attributes $name {
            $($fields)*
            /// Description in your own words.
            pub doc: Option<String>,
        } }
    };
    ({ cite $($group:ident)* } $attributes:tt $name:ident { $($fields:tt)* }) => {
        table! { { $($group)* } $attributes $name {
            $($fields)*
            /// Page or line of the manual.
            pub cite: Option<OneOrMany<NumberOrText>>,
        } }
    };
    ({ doubt $($group:ident)* } $attributes:tt $name:ident { $($fields:tt)* }) => {
        table! { { $($group)* } $attributes $name {
            $($fields)*
            /// Ambiguity in the manual, and the assumption.
            pub doubt: Option<OneOrMany<DoubtTable>>,
            /// Several ambiguities.
            pub doubts: Option<OneOrMany<DoubtTable>>,
        } }
    };
    ({ allow $($group:ident)* } $attributes:tt $name:ident { $($fields:tt)* }) => {
        table! { { $($group)* } $attributes $name {
            $($fields)*
            /// Diagnostics that the ambiguity explains; they are suppressed.
            pub allow: Option<Vec<At<String>>>,
        } }
    };
    ({} [$(#[$attribute:meta])*] $name:ident {
        $($(#[$of_field:meta])* pub $field:ident $(= $key:literal)?: $ty:ty,)*
    }) => {
        $(#[$attribute])*
        #[derive(Clone, Debug, Default)]
        #[cfg_attr(test, derive(schemars::JsonSchema), schemars(deny_unknown_fields, default))]
        #[allow(missing_docs)]
        pub struct $name {
            $($(#[$of_field])* $(#[cfg_attr(test, schemars(rename = $key))])? pub $field: $ty,)*
        }

        impl Read for $name {
            fn read(node: &Node<'_>) -> Result<Self, Mistake> {
                const KEYS: &[&str] = &[$(key!($field $($key)?)),*];
                let mut table = Self::default();
                for (key, value) in read::table(node, concat!("struct ", stringify!($name)))? {
                    match key.get_ref().as_ref() {
                        $(key!($field $($key)?) => table.$field = Read::read(value)?,)*
                        _ => return Err(Mistake::unknown_key(key, KEYS)),
                    }
                }
                Ok(table)
            }
        }
    };
}

/// Values of a condition, and the bits that it compares.
#[derive(Clone, Debug)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(untagged))]
pub enum ConditionValues {
    /// Values of the whole item.
    Values(OneOrMany<Literal>),
    /// Values of some of its bits.
    Bits(ConditionTable),
}

impl Default for ConditionValues {
    fn default() -> Self {
        ConditionValues::Values(OneOrMany::default())
    }
}

/// Required values of other items, by item name.
pub type Conditions = Entries<ConditionValues>;

/// Row of an image or message field, with the keys that both have.
macro_rules! field_row {
    ($field:ident) => {
        Row {
            ty: $field.ty.clone(),
            bits: $field.bits.clone(),
            values: $field.values.clone(),
            unit: $field.unit.clone(),
            scale: $field.scale.clone(),
            min: $field.min.clone(),
            max: $field.max.clone(),
            na: $field.na.clone(),
            conversions: $field.conversions.clone(),
            orig: $field.orig.clone(),
            doc: $field.doc.clone(),
            cite: $field.cite.clone(),
            doubt: $field.doubt.clone(),
            doubts: $field.doubts.clone(),
            ..Row::default()
        }
    };
}
pub(super) use field_row;

/// Text, or a list of texts.
pub type Words = OneOrMany<String>;

/// Bits by position: a name, a definition, or several meanings.
pub type BitEntries = Entries<OneOrMany<TextOr<BitTable>>>;

/// Values by number: a name or a definition.
pub type ValueEntries = Entries<TextOr<ValueTable>>;

/// Number or text.
#[derive(Clone, Debug)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(untagged))]
pub enum NumberOrText {
    /// Number.
    Number(i64),
    /// Text.
    Text(String),
}

impl fmt::Display for NumberOrText {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NumberOrText::Number(number) => number.fmt(f),
            NumberOrText::Text(text) => text.fmt(f),
        }
    }
}

/// `true`, `false` or text.
#[derive(Clone, Debug)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(untagged))]
pub enum FlagOrText {
    /// `true` or `false`.
    Flag(bool),
    /// Text.
    Text(String),
}

/// Scale factor, or the rule for it.
#[derive(Clone, Debug)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(untagged))]
pub enum Scaling {
    /// physical = raw × factor.
    Factor(f64),
    /// Another rule.
    Rule(Box<ScaleRule>),
}

tables! {
    /// Rule that converts a raw value to a physical value.
    pub struct ScaleRule {
        /// Physical value of 1 LSB.
        pub factor: Option<f64>,
        /// Physical value of raw 0.
        pub offset: Option<f64>,
        /// Item whose value divides.
        pub by: Option<At<String>>,
        /// Item whose value multiplies.
        pub times: Option<At<String>>,
        /// Numerator: physical = this / raw.
        pub reciprocal: Option<f64>,
        /// Number of fractional bits.
        pub fraction: Option<u8>,
        /// Constant of the model that the fraction refers to.
        pub of: Option<At<String>>,
        /// Item with the exponent.
        pub exponent: Option<At<String>>,
        /// Base of the exponent: 10 (default) or 2.
        pub base: Option<u8>,
    }

    /// Ambiguity in the manual, and the assumption.
    pub struct DoubtTable {
        /// Printed text; both sides of a contradiction.
        pub says: String,
        /// Assumption.
        pub chose: String,
        /// Reason for the assumption.
        pub why: String,
        /// Page or line of the ambiguity.
        pub cite: Option<OneOrMany<NumberOrText>>,
        /// Result of a wrong assumption: `hazard`, `value` or `print`.
        #[cfg_attr(test, schemars(transform = schema::words("hazard value print")))]
        pub severity: Option<At<String>>,
    }

    /// Mailbox protocols and sync managers of an EtherCAT slave.
    pub struct EtherCatTable: cite doubt {
        /// CAN application protocol over EtherCAT, and its features.
        pub coe: Option<FlagOr<CoeTable>>,
        /// ADS over EtherCAT.
        pub aoe: bool,
        /// Ethernet over EtherCAT.
        pub eoe: bool,
        /// File access over EtherCAT.
        pub foe: bool,
        /// Servo profile over EtherCAT.
        pub soe: bool,
        /// Vendor-specific protocol over EtherCAT.
        pub voe: bool,
        /// Sync managers.
        pub sync_managers: Vec<At<SyncManagerTable>>,
    }

    /// Features of a slave's CAN application protocol.
    pub struct CoeTable: cite {
        /// Whether the SDO information service is supported.
        pub sdo_info: bool,
        /// Whether the PDO assignment is writable (0x1C12, 0x1C13).
        pub pdo_assign: bool,
        /// Whether the PDO mapping is writable.
        pub pdo_config: bool,
        /// Whether masters read the PDO assignment from the device.
        pub pdo_upload: bool,
        /// Whether complete access to all sub-indices is supported.
        pub complete_access: bool,
        /// Whether segmented transfer is supported.
        pub segmented_sdo: bool,
    }

    /// Sync manager.
    pub struct SyncManagerTable: cite doubt {
        /// Number.
        pub number: Option<u8>,
        /// `mailbox_out`, `mailbox_in`, `outputs` or `inputs`, as seen from the master.
        #[cfg_attr(test, schemars(transform = schema::words(schema::PURPOSES)))]
        pub purpose: Option<At<String>>,
        /// First address in the memory of the slave controller.
        pub start: Option<u16>,
        /// Default length in bytes.
        pub size: Option<u16>,
        /// Minimum length in bytes.
        pub min: Option<u16>,
        /// Maximum length in bytes.
        pub max: Option<u16>,
        /// Control byte.
        pub control: Option<u8>,
    }

    /// Device that a table describes.
    pub struct DeviceTable: orig doc cite doubt {
        /// Name of the device; Rust types are named after it.
        pub name: Option<At<String>>,
        /// Name of the vendor.
        pub vendor: Option<String>,
        /// Vendor ID (CiA, ETG).
        pub vendor_id: Option<u32>,
        /// Product code.
        pub product_code: Option<u32>,
        /// Revision number.
        pub revision: Option<u32>,
        /// Order code.
        pub order_code: Option<String>,
        /// `canopen`, `ethercat`, `modbus`, `profinet`, `serial`.
        #[cfg_attr(test, schemars(transform = schema::words(schema::BUSES)))]
        pub buses: Option<Vec<At<String>>>,
        /// Numbers of its device profiles.
        pub profiles: Vec<u32>,
        /// Node-ID range, or range of server addresses (`"1..90"`).
        #[cfg_attr(test, schemars(transform = schema::notation("#(\\.\\.=?#)?")))]
        pub node_ids: Option<At<NumberOrText>>,
        /// CANopen bit rates in kbit/s.
        pub bit_rates: Vec<u16>,
        /// Number of RPDOs.
        pub rx_pdos: Option<u16>,
        /// Number of TPDOs.
        pub tx_pdos: Option<u16>,
        /// Granularity of PDO mapping in bits.
        pub granularity: Option<u8>,
        /// Whether layer setting services (LSS) are supported.
        pub lss: bool,
    }

    /// Manual that a table was transcribed from.
    pub struct ManualTable: doc {
        /// Title.
        pub title: Option<String>,
        /// Edition: number or date.
        pub edition: Option<String>,
        /// Language (BCP 47).
        pub language: Option<String>,
        /// Unit of `cite`: `page` or `line`.
        #[cfg_attr(test, schemars(transform = schema::words("page line")))]
        pub cites: Option<At<String>>,
        /// Titles of sections and tables, by first page or line.
        pub sections: Entries<String>,
    }

    /// Devices of an overlay, and its reason.
    pub struct OverlayTable: doc {
        /// Devices to change.
        pub applies = "for": Option<AppliesTable>,
        /// Reason for the overlay.
        pub why: Option<String>,
    }

    /// Devices that an overlay changes; omitted keys match any device.
    pub struct AppliesTable {
        /// Vendor ID.
        pub vendor_id: Option<u32>,
        /// Product code.
        pub product_code: Option<u32>,
        /// Revision number.
        pub revision: Option<u32>,
        /// Name or order code; `*` matches any characters.
        pub device: Option<String>,
        /// Modules to change, by name, identifier or ident number; in GSDML also submodules.
        pub module: Option<String>,
    }

    /// Name, number and devices of a profile.
    pub struct ProfileTable: doc {
        /// Name of the profile.
        pub name: Option<String>,
        /// Number of the device profile.
        pub number: Option<u32>,
        /// Object that identifies devices with this profile.
        pub when: Option<At<NumberOrText>>,
        /// PROFINET: API number of submodules with this profile.
        pub api: Option<u32>,
        /// The only buses of the profile.
        pub buses: Option<Vec<At<String>>>,
        /// Index offset of each further axis, for 0x6000 to 0x67FF.
        pub axis_index: Option<u16>,
    }

    /// Model, or firmware version.
    pub struct ModelTable: orig doc cite doubt {
        /// Name.
        pub name: Option<At<String>>,
        /// Product code.
        pub product_code: Option<u32>,
        /// Revision number.
        pub revision: Option<u32>,
        /// Order code.
        pub order_code: Option<String>,
        /// Constants of the model, such as the reference of fractions.
        pub constants: Entries<Literal>,
    }

    /// Choice that the manual leaves open.
    pub struct OptionTable: doc cite doubt {
        /// Choices, each with the value that replaces `$name`.
        pub choices: Entries<Literal>,
        /// Default choice.
        pub default: Option<At<String>>,
    }

    /// Meaning of a register number on each bus.
    pub struct SpaceTable: doc {
        /// Bits per number. Default: 1 for coils and discrete inputs, otherwise 16.
        pub bits: Option<u8>,
        /// Whether a shorter value fills all bits of its numbers, with sign extension or zeros.
        pub extend: bool,
        /// Modbus addresses.
        pub modbus: Option<ModbusRule>,
        /// CANopen objects.
        pub canopen: Option<ObjectRule>,
        /// EtherCAT objects (CoE).
        pub ethercat: Option<ObjectRule>,
        /// Whether the number is a parameter number of a command protocol; a table names the messages that transfer it.
        pub parameter: Option<FlagOr<ParameterMessages>>,
        /// Whether the number is an address in the memory of an EtherCAT slave controller.
        pub esc: bool,
        /// Window through which the value is reached, or several windows.
        pub indirect: Option<OneOrMany<IndirectRule>>,
    }

    /// Messages that transfer the parameters of a space.
    pub struct ParameterMessages {
        /// Message that reads a value.
        pub read: Option<At<String>>,
        /// Message that writes a value.
        pub write: Option<At<String>>,
        /// Message that stores values in non-volatile memory.
        pub store: Option<At<String>>,
        /// Byte order of a 32-bit value; `A` is the most significant byte.
        pub order: Option<At<String>>,
    }

    /// Modbus addresses of the registers of a space.
    pub struct ModbusRule {
        /// `holding`, `input`, `coil` or `discrete`.
        #[cfg_attr(test, schemars(transform = schema::words("holding input coil discrete")))]
        pub table: Option<At<String>>,
        /// First number in the manual.
        pub first: Option<i64>,
        /// Offset added to get the wire address.
        pub add: Option<i64>,
        /// Word order of longer values: `high_first` or `low_first`.
        #[cfg_attr(test, schemars(transform = schema::words("high_first low_first")))]
        pub order: Option<At<String>>,
        /// Whether `order` is an assumption because the manual states none.
        pub order_assumed: bool,
        /// Printed prefix of each number: `R` for `R01`.
        pub prefix: Option<String>,
        /// Minimum number of printed digits: 2 for `R01`.
        pub digits: Option<u8>,
        /// Whether the bytes of a word are swapped.
        pub swap: bool,
        /// Supported function codes (`[3, 6, 16]`).
        pub functions: Option<At<Vec<u8>>>,
        /// Maximum number of registers or bits that one request reads.
        pub max_read: Option<At<u16>>,
        /// Maximum number of registers or bits that one request writes.
        pub max_write: Option<At<u16>>,
        /// Whether longer values are read and written in several requests.
        pub split: Option<bool>,
    }

    /// Object of a register.
    pub struct ObjectRule {
        /// Offset added to the register number to get the index.
        pub index: Option<At<i64>>,
        /// Sub-index.
        pub sub: Option<At<u8>>,
    }

    /// Window: access to a value through other items.
    pub struct IndirectRule {
        /// Buses of the window. Default: all buses of its items.
        #[cfg_attr(test, schemars(transform = schema::words(schema::BUSES)))]
        pub buses: Option<Vec<At<String>>>,
        /// Valid numbers, such as `"0x8000..0x8FFF"`. Default: all.
        pub numbers: Option<At<String>>,
        /// Offset added to the number of a row.
        pub add: Option<i64>,
        /// Item that takes the number.
        pub write_address: Option<At<String>>,
        /// Item through which the value is read, or a table.
        pub read: Option<At<TextOr<WindowTable>>>,
        /// Item through which the value is written, or a table.
        pub write: Option<At<TextOr<WindowTable>>>,
        /// Whether the device resets the number to 0 when done. Default: as in the row of the number item.
        pub clears: Option<bool>,
        /// Time in ms that the device needs if it does not reset the number.
        pub wait: Option<u32>,
        /// Maximum time in ms until the device resets the number.
        pub timeout: Option<u32>,
        /// Procedure that describes the sequence.
        pub procedure: Option<At<String>>,
    }

    /// Reading or writing through a window.
    pub struct WindowTable {
        /// Item that takes the number. Default: `write_address`.
        pub address: Option<At<String>>,
        /// Item with the value.
        pub value: Option<At<String>>,
        /// First item to write: `address` or `value`.
        #[cfg_attr(test, schemars(transform = schema::words("address value")))]
        pub first: Option<At<String>>,
        /// Whether the device resets the number to 0 when done.
        pub clears: Option<bool>,
        /// Time in ms that the device needs if it does not reset the number.
        pub wait: Option<u32>,
        /// Maximum time in ms until the device resets the number.
        pub timeout: Option<u32>,
        /// Procedure that describes the sequence.
        pub procedure: Option<At<String>>,
    }

    /// Chapter: a group of rows.
    pub struct ChapterTable: orig doc cite doubt {
        /// Title.
        pub title: Option<String>,
        /// Space of the register numbers.
        pub space: Option<At<String>>,
        /// Default keys of rows.
        pub defaults: Option<At<Row>>,
        /// Registers by name.
        pub registers: Entries<Row>,
        /// Objects by index and sub-index (`0x6040`, `"0x1018:1"`, `"0x1400..0x1403:1"`).
        #[cfg_attr(test, schemars(transform = schema::keys(schema::OBJECTS)))]
        pub objects: Entries<Row>,
    }

    /// One item of the device.
    pub struct Row: meaning window orig doc cite doubt allow {
        /// Register number, or range of numbers (`"63-64"`).
        #[cfg_attr(test, schemars(transform = schema::notation("#( *[-–] *#)?")))]
        pub reg: Option<At<NumberOrText>>,
        /// Object and sub-index (`"0x2000:1"`).
        #[cfg_attr(test, schemars(transform = schema::notation("#(:#)?")))]
        pub obj: Option<At<NumberOrText>>,
        /// Address in the memory of an EtherCAT slave controller.
        pub esc: Option<At<u16>>,
        /// Access rights of the slave's processor to that memory: `ro`, `rw` or `wo`.
        #[cfg_attr(test, schemars(transform = schema::words("ro rw wo")))]
        pub pdi: Option<At<String>>,
        /// Length in bytes at `esc`. Without `esc`: printed length, which is compared with the type.
        pub length: Option<At<u16>>,
        /// Name in an ASCII protocol.
        pub ascii: Option<String>,
        /// Parameter number.
        pub param: Option<At<u32>>,
        /// Name of an object or sub-entry.
        pub name: Option<At<String>>,
        /// Object code: `var`, `array`, `record` or `domain`.
        #[cfg_attr(test, schemars(transform = schema::words("var array record domain")))]
        pub code: Option<At<String>>,
        /// Data type: `u16`, `i32`, `f32`, `bool`, `str(25)`, `bytes(6)`, `u16[10]`, …; `?` if the manual does not state it.
        #[cfg_attr(test, schemars(transform = schema::types))]
        pub ty = "type": Option<At<String>>,
        /// Access rights: `ro`, `rw`, `wo`, `const`, `rwr` or `rww`; `?` if the manual does not state them.
        #[cfg_attr(test, schemars(transform = schema::words("ro rw wo const rwr rww ?")))]
        pub access: Option<At<String>>,
        /// PDO direction, as seen from the device: `rx`, `tx`, `both` or `no`.
        #[cfg_attr(test, schemars(transform = schema::words("rx tx both no")))]
        pub pdo: Option<At<String>>,
        /// Default value; a list if the row describes several objects.
        pub default: Option<At<OneOrMany<Literal>>>,
        /// The only valid value.
        pub fixed: Option<At<Literal>>,
        /// The only valid values, and ranges (`"3..7"`).
        pub allowed: Option<At<Vec<Literal>>>,
        /// Physical value of raw 0.
        pub offset: Option<f64>,
        /// Raw value to whose multiples the device rounds.
        pub step: Option<At<Literal>>,
        /// Differences between models or buses.
        pub variants: Option<Vec<At<VariantTable>>>,
        /// Storage: `true` (non-volatile), `false` (volatile), or the command that stores the value.
        pub save: Option<FlagOrText>,
        /// When a write takes effect, if not immediately.
        pub effective: Option<String>,
        /// Writable only while these items have one of these values.
        pub when: Option<Conditions>,
        /// The only values that may be written, and ranges (`"3..7"`).
        pub writable: Option<At<Vec<Literal>>>,
        /// Whether the device resets the value to 0.
        pub clears: Option<bool>,
        /// Whether it can be written only once.
        pub once: Option<bool>,
        /// Other effects of a write.
        pub effects: Option<Words>,
        /// Replacement.
        pub replaced_by: Option<At<String>>,
        /// Required hardware or software options.
        pub needs: Option<Words>,
        /// The only buses on which it exists.
        #[cfg_attr(test, schemars(transform = schema::words(schema::BUSES)))]
        pub buses: Option<Vec<At<String>>>,
        /// Whether each axis has its own item.
        pub per_axis: Option<bool>,
        /// Item with the upper half of the number; this is the lower half.
        pub upper: Option<At<String>>,
        /// Item with the same quantity in another scale; the defaults are compared.
        pub same_quantity: Option<At<String>>,
        /// Item with the same value at another address.
        pub same_as: Option<At<String>>,
        /// Whether it is for the vendor or a tool only.
        pub hidden: Option<bool>,
        /// Number of repetitions, or the item with the number of valid ones.
        pub count: Option<At<NumberOrText>>,
        /// Number of rows if `count` is an item.
        pub max_count: Option<u32>,
        /// Distance of the register numbers of two repetitions.
        pub stride: Option<u32>,
        /// Bits of the register that the row describes (`"7-0"`).
        #[cfg_attr(test, schemars(transform = schema::notation(schema::BITS)))]
        pub part: Option<At<NumberOrText>>,
        /// Word order: `high_first` or `low_first`.
        #[cfg_attr(test, schemars(transform = schema::words("high_first low_first")))]
        pub order: Option<At<String>>,
        /// Whether the bytes of a word are swapped.
        pub swap: Option<bool>,
        /// Whether the sub-index exists without a meaning.
        pub reserved: Option<bool>,
        /// Whether it does not always exist.
        pub optional: Option<bool>,
        /// Source of `doc` if not the manual: `CiA 402, 17.3.7`, or `name` if it spells out the printed name.
        pub doc_from: Option<At<String>>,
        /// Repetition elsewhere in the manual, which is compared with the row.
        pub summary: Option<At<OneOrMany<SummaryTable>>>,
        /// In an overlay: reason for the row.
        pub why: Option<String>,
        /// In an overlay: adds an object that does not exist yet.
        pub add: Option<bool>,
        /// In an overlay: removes the object.
        pub remove: Option<bool>,
    }

    /// Differences on some models or buses; omitted keys are as in the row.
    pub struct VariantTable: doc cite {
        /// Models; `*` matches any characters.
        pub models: Option<Vec<At<String>>>,
        /// Buses.
        #[cfg_attr(test, schemars(transform = schema::words(schema::BUSES)))]
        pub buses: Option<Vec<At<String>>>,
        /// Integer type with another width on these buses.
        #[cfg_attr(test, schemars(transform = schema::types))]
        pub ty = "type": Option<At<String>>,
        /// Access rights on buses that allow less.
        #[cfg_attr(test, schemars(transform = schema::words("ro rw wo")))]
        pub access: Option<At<String>>,
        /// The only valid values, and ranges.
        pub allowed: Option<At<Vec<Literal>>>,
        /// Default value.
        pub default: Option<At<Literal>>,
        /// Minimum raw value.
        pub min: Option<At<Literal>>,
        /// Maximum raw value.
        pub max: Option<At<Literal>>,
        /// Raw value to whose multiples the device rounds.
        pub step: Option<At<Literal>>,
        /// Scale factor (physical = raw × scale), or the rule for it.
        pub scale: Option<At<Scaling>>,
    }

    /// Condition on some bits of an item.
    pub struct ConditionTable {
        /// Bits that are compared.
        pub mask: Option<u64>,
        /// Value of the bits, or a list of values.
        pub value: Option<OneOrMany<Literal>>,
    }

    /// Repetition of a row elsewhere in the manual: an overview, a table of contents or the text.
    pub struct SummaryTable: cite {
        /// Printed data type.
        #[cfg_attr(test, schemars(transform = schema::types))]
        pub ty = "type": Option<At<String>>,
        /// Printed access rights.
        pub access: Option<At<String>>,
        /// Printed PDO direction.
        pub pdo: Option<At<String>>,
        /// Printed object code.
        #[cfg_attr(test, schemars(transform = schema::words("var array record domain")))]
        pub code: Option<At<String>>,
        /// Printed name.
        pub name: Option<At<String>>,
        /// Number of sub-indices, including sub-index 0.
        pub subs: Option<At<u32>>,
        /// Length in bytes.
        pub length: Option<At<u32>>,
        /// Printed minimum.
        pub min: Option<At<Literal>>,
        /// Printed maximum.
        pub max: Option<At<Literal>>,
        /// Printed default value.
        pub default: Option<At<Literal>>,
    }

    /// Unit with a scale.
    pub struct UnitTable: doc {
        /// Symbol of the physical unit.
        pub symbol: Option<String>,
        /// Scale factor: physical = raw × scale + offset.
        pub scale: Option<At<Scaling>>,
        /// Physical value of raw 0.
        pub offset: Option<f64>,
        /// Conversion to a machine unit.
        pub machine: Option<MachineUnitTable>,
        /// Unit as the manual prints it.
        pub orig: Option<String>,
    }

    /// Machine unit: the physical value, multiplied and divided by numbers of `[given]`.
    pub struct MachineUnitTable {
        /// Symbol.
        pub unit: Option<At<String>>,
        /// Numbers that multiply.
        pub times: Vec<At<String>>,
        /// Numbers that divide.
        pub over: Vec<At<String>>,
    }

    /// Number that depends on the machine.
    pub struct GivenTable: doc cite doubt {
        /// Symbol of the unit.
        pub unit: Option<At<String>>,
        /// Value on models that have a fixed one.
        pub models: Entries<Literal>,
    }

    /// Enumeration: named values of an integer.
    pub struct EnumTable: orig doc cite doubt allow {
        /// Integer type; required only if no row implies it.
        #[cfg_attr(test, schemars(transform = schema::types))]
        pub base: Option<At<String>>,
        /// Whether the device never has an unlisted value.
        pub closed: bool,
        /// Values, and ranges of values (`"3..7"`).
        #[cfg_attr(test, schemars(transform = schema::keys(schema::VALUES)))]
        pub values: ValueEntries,
    }

    /// Named value.
    pub struct ValueTable: window orig doc cite doubt {
        /// Short English phrase, from which the identifier is derived.
        pub name: Option<String>,
        /// Zone of reserved or vendor-specific values: `reserved` or `vendor`.
        #[cfg_attr(test, schemars(transform = schema::words("reserved vendor")))]
        pub zone: Option<At<String>>,
        /// The only buses on which it exists.
        #[cfg_attr(test, schemars(transform = schema::words(schema::BUSES)))]
        pub buses: Option<Vec<At<String>>>,
        /// It exists only while these items have one of these values.
        pub when: Option<Conditions>,
        /// Replacement, as text.
        pub replaced_by: Option<String>,
    }

    /// Named bits of an integer.
    pub struct BitsTable: orig doc cite doubt allow {
        /// Integer type; required only if no row implies it.
        #[cfg_attr(test, schemars(transform = schema::types))]
        pub base: Option<At<String>>,
        /// Address of the byte with bits 0 to 7, if the manual counts bits in each byte (`"0x221:3-2"`).
        pub address: Option<u32>,
        /// Bits, and ranges of bits (`"3-2"`); a list if other items select the meaning.
        #[cfg_attr(test, schemars(transform = schema::keys(schema::BITS_OF_BYTES)))]
        pub at: BitEntries,
    }

    /// Meaning of bits.
    pub struct BitTable: window orig doc cite doubt {
        /// Short English phrase, from which the identifier is derived.
        pub name: Option<String>,
        /// Whether the name applies while the bit is 0.
        pub inverted: bool,
        /// Whether the bits are a number.
        pub number: bool,
        /// Meaning of the values.
        #[cfg_attr(test, schemars(transform = schema::keys(schema::VALUES)))]
        pub values: Option<ValueEntries>,
        /// Meaning of the values, as a name of `[enums]`.
        pub enumeration = "enum": Option<At<String>>,
        /// The bits have no meaning; write 0, 1, or the value read (`keep`).
        pub reserved: Option<NumberOrText>,
        /// Edge or event that triggers the command: `rising`, `falling`, `toggle` or `self_clearing`.
        #[cfg_attr(test, schemars(transform = schema::words(schema::TRIGGERS)))]
        pub trigger: Option<At<String>>,
        /// The meaning applies while these items have one of these values.
        pub when: Option<Conditions>,
        /// Access rights, if they differ from the row.
        #[cfg_attr(test, schemars(transform = schema::words("ro rw wo const rwr rww")))]
        pub access: Option<At<String>>,
        /// Replacement, as text.
        pub replaced_by: Option<String>,
    }

    /// Rules that derive the objects of further axes from the first axis.
    pub struct AxesTable: doc cite doubt {
        /// Number of axes.
        pub count: u8,
        /// Models with this number of axes; `*` matches any characters.
        pub models: Option<Vec<At<String>>>,
        /// Rules; the first that contains an object applies.
        pub rules: Vec<At<AxisRuleTable>>,
    }

    /// Rule that derives the object of the next axis.
    pub struct AxisRuleTable {
        /// Objects (`"0x6000..0x67FF"`).
        #[cfg_attr(test, schemars(transform = schema::notation("#(\\.\\.=?#)?")))]
        pub objects: Option<At<NumberOrText>>,
        /// Offset added to the index.
        pub index: Option<u16>,
        /// `axis`: the sub-index is the axis number.
        #[cfg_attr(test, schemars(transform = schema::words("axis")))]
        pub sub: Option<String>,
        /// Offset added to the sub-index.
        pub sub_stride: Option<u8>,
    }

    /// Process data object.
    pub struct PdoTable: doc cite doubt allow {
        /// Index of the mapping object.
        pub index: Option<At<u16>>,
        /// Name.
        pub name: Option<String>,
        /// Direction as seen from the device: `rx` or `tx`.
        #[cfg_attr(test, schemars(transform = schema::words("rx tx")))]
        pub direction: Option<At<String>>,
        /// Entries: `"0x6040:0/16"`, `"item"`, `"pad/8"`, or `"? name/16"` (`"? name/i16"`) if the manual gives no object.
        pub entries: Vec<At<String>>,
        /// Printed length in bytes, or a list of printed lengths; compared with the entries.
        pub length: Option<At<OneOrMany<u32>>>,
        /// Maximum length in bytes of a variable mapping.
        pub max: Option<u16>,
        /// Whether the entries cannot be changed.
        pub fixed: bool,
        /// Whether it must be assigned.
        pub mandatory: bool,
        /// Sync manager of the default assignment.
        pub sm: Option<At<u8>>,
        /// Whether it is assigned by default.
        pub default: bool,
        /// PDOs that cannot be assigned together with it (`0x1702`, `"0x1600..0x1603"`).
        pub excludes: Vec<NumberOrText>,
        /// The only buses with this mapping: `canopen`, `ethercat`.
        #[cfg_attr(test, schemars(transform = schema::words(schema::BUSES)))]
        pub buses: Option<Vec<At<String>>>,
    }

    /// Fixed process image.
    pub struct ImageTable: doc cite doubt {
        /// Name.
        pub name: Option<String>,
        /// Direction as seen from the device: `rx` or `tx`.
        #[cfg_attr(test, schemars(transform = schema::words("rx tx")))]
        pub direction: Option<At<String>>,
        /// Length in bytes.
        pub bytes: Option<u32>,
        /// Byte order: `big` (default) or `little`.
        #[cfg_attr(test, schemars(transform = schema::words("big little")))]
        pub order: Option<At<String>>,
        /// Fields by item name; a field that is not an item of the table needs a `type`.
        pub fields: Entries<ImageField>,
    }

    /// Field of a process image; its key is the item.
    pub struct ImageField: meaning orig doc cite doubt {
        /// First byte.
        pub at: Option<u32>,
        /// First bit in that byte.
        pub bit: Option<u8>,
        /// Data type, if it differs from the item.
        #[cfg_attr(test, schemars(transform = schema::types))]
        pub ty = "type": Option<At<String>>,
    }

    /// Table of codes.
    pub struct CodesTable: doc cite {
        /// Names of further columns after code and meaning.
        pub columns: Vec<String>,
        /// Printed prefix of each number: `F` for `F125`.
        pub prefix: Option<String>,
        /// Whether all codes must have different cells.
        pub distinct: bool,
        /// Diagnostics that an ambiguity explains; they are suppressed.
        pub allow: Option<Vec<At<String>>>,
        /// The only buses with these codes.
        #[cfg_attr(test, schemars(transform = schema::words(schema::BUSES)))]
        pub buses: Option<Vec<At<String>>>,
        /// Codes, and ranges of codes.
        #[cfg_attr(test, schemars(transform = schema::keys(schema::VALUES)))]
        pub rows: Entries<TextOr<CodeTableRow>>,
    }

    /// Code.
    pub struct CodeTableRow: window orig doc cite doubt {
        /// Name.
        pub name: Option<String>,
        /// Cells of the further columns.
        pub cells: Vec<At<Literal>>,
    }

    /// State machine.
    pub struct MachineTable: doc cite doubt {
        /// Item with the state.
        pub status: Option<At<String>>,
        /// Item with the commands.
        pub control: Option<At<String>>,
        /// States as bit patterns of `status`, or the name of an enumeration.
        pub states: Option<At<TextOr<Entries<PatternTable>>>>,
        /// State after power-on.
        pub initial: Option<At<String>>,
        /// Commands as bit patterns of `control`.
        pub commands: Entries<PatternTable>,
        /// Transitions.
        pub transitions: Vec<At<TransitionTable>>,
        /// Outcome of each command in each state.
        pub matrix: Option<At<MatrixTable>>,
    }

    /// State-command matrix.
    pub struct MatrixTable: doc cite doubt {
        /// States of the columns.
        pub states: Vec<At<String>>,
        /// Notes of cells.
        pub notes: Entries<String>,
        /// Rows: messages or commands, each with one cell per state.
        pub rows: Entries<MatrixRow>,
    }

    /// Outcome of a command in each state.
    pub struct MatrixRow: doc cite doubt {
        /// Messages or commands of the row, if its name is none; empty if it is not described elsewhere.
        pub commands: Option<Vec<At<String>>>,
        /// One outcome per state: `same`, `refused`, `?`, the next state, or `"a > b"` if `b` follows `a` automatically.
        /// Several outcomes are separated by `or`.
        pub cells: Vec<At<TextOr<MatrixCell>>>,
        /// Models that have it; `*` matches any characters.
        pub models: Option<Vec<At<String>>>,
        /// First firmware that has it.
        pub since: Option<String>,
    }

    /// Cell with more than an outcome.
    pub struct MatrixCell: cite {
        /// Outcome, as in a plain cell.
        pub to: Option<At<String>>,
        /// Note of the table.
        pub note: Option<At<NumberOrText>>,
        /// Condition of the outcome, in your own words.
        pub doc: Option<String>,
    }

    /// Bit pattern.
    pub struct PatternTable: orig doc cite {
        /// Bits that are compared.
        pub mask: Option<u32>,
        /// Value of these bits.
        pub value: Option<u32>,
    }

    /// Transition between states.
    pub struct TransitionTable: doc cite {
        /// Number in the manual.
        pub number: Option<u16>,
        /// State before, or a list of states. Default: any state.
        pub from: Option<At<OneOrMany<String>>>,
        /// State after.
        pub to: Option<At<String>>,
        /// Command or message that causes it; omitted for automatic transitions.
        pub command: Option<At<String>>,
    }

    /// Sequence of steps.
    pub struct ProcedureTable: orig doc cite doubt allow {
        /// Names of the caller's arguments, which steps write with `argument`.
        pub arguments: Vec<At<String>>,
        /// Steps, in order.
        pub steps: Vec<At<StepTable>>,
    }

    /// Number that is split over several items.
    pub struct CompositeTable: orig doc cite doubt {
        /// Items with the digits, most significant first.
        pub parts: Vec<At<String>>,
        /// Radix: each part is less than this.
        pub base: Option<u16>,
        /// Item with the sign.
        pub sign: Option<At<String>>,
        /// Value of the sign item for negative numbers; otherwise it is 0.
        pub negative: Option<u16>,
        /// Unit of the number.
        pub unit: Option<String>,
    }

    /// Step.
    pub struct StepTable: doc {
        /// Item to which `value` or `argument` is written.
        pub write: Option<At<String>>,
        /// Item that is read; its value is the result of the procedure.
        pub read: Option<At<String>>,
        /// Item to wait for.
        pub wait: Option<At<String>>,
        /// The only bits that are written or compared.
        pub mask: Option<At<u64>>,
        /// Value to write or to wait for.
        pub value: Option<Literal>,
        /// Argument of the procedure to write.
        pub argument: Option<At<String>>,
        /// Timeout in ms.
        pub timeout: Option<At<u32>>,
        /// Delay in ms.
        pub delay: Option<u32>,
        /// Message to send.
        pub send: Option<At<String>>,
        /// `rx` or `tx`: one exchange of process data.
        #[cfg_attr(test, schemars(transform = schema::words("rx tx")))]
        pub exchange: Option<At<String>>,
        /// Manual action.
        pub manual: Option<String>,
    }

    /// Modbus frame that the manual prints: node, function code and data, with or without CRC.
    pub struct FrameTable: doc cite doubt {
        /// Bytes of the request.
        pub request: At<Vec<u8>>,
        /// Bytes of the reply.
        pub reply: At<Vec<u8>>,
        /// Diagnostics that the ambiguities explain; they are suppressed.
        pub allow: Option<Vec<At<String>>>,
    }

    /// Conversion that the manual prints.
    pub struct ConversionTable: doc cite {
        /// Raw value.
        pub raw: Option<i64>,
        /// Physical value.
        pub value: Option<f64>,
        /// Unit of the physical value, if it is the machine unit.
        pub unit: Option<At<String>>,
        /// Numbers of `[given]` in the example.
        pub given: Entries<f64>,
        /// Model whose constants apply.
        pub model: Option<At<String>>,
        /// Value of the item that the scale depends on.
        pub by: Option<f64>,
    }
}

// Command protocols.
#[cfg(feature = "messages")]
tables! {
    /// Delimiters and check of frames.
    pub struct FramingTable: doc cite doubt {
        /// First byte of a frame.
        pub start: Option<u8>,
        /// Last byte of a frame.
        pub end: Option<u8>,
        /// Byte that precedes an escaped byte.
        pub escape: Option<u8>,
        /// Value that is XORed with an escaped byte.
        pub escape_xor: u8,
        /// Bytes that are escaped.
        pub escaped: Vec<u8>,
        /// Algorithm of the check.
        #[cfg_attr(test, schemars(transform = schema::words(schema::CHECKS)))]
        pub check: Option<At<String>>,
        /// Initial value of the check.
        pub seed: u32,
        /// First message field that the check covers. Default: the byte after `start`.
        pub check_from: Option<At<String>>,
        /// Whether the check is escaped, too.
        pub check_escaped: Option<bool>,
        /// Maximum number of data bytes per frame, without start, end, escapes and check.
        pub max_data: Option<u16>,
        /// Request field with the device address.
        pub address: Option<At<String>>,
    }

    /// Request and its reply.
    pub struct MessageTable: window orig doc cite doubt allow {
        /// Name.
        pub name: Option<At<String>>,
        /// Fields of the request.
        pub request: Vec<At<FieldTable>>,
        /// Fields of the reply.
        pub reply: Vec<At<FieldTable>>,
        /// When the order completes: `immediate`, `reply`, `{ poll = "item" }` or `{ delay = 100 }`.
        pub completion: Option<At<TextOr<CompletionTable>>>,
        /// States in which the device accepts the message.
        pub accepted_in: Vec<At<String>>,
        /// Frames that the manual prints; they are compared with the fields.
        pub examples: Vec<At<ExampleTable>>,
        /// Required values of other items.
        pub when: Option<Conditions>,
        /// Approximate time in ms of a late reply.
        pub reply_time: Option<u32>,
        /// The reply has this form after this message.
        pub after: Option<At<String>>,
        /// Whether the reply has this form after power-on, too.
        pub default: bool,
        /// Message that replaces the reply if the device refuses.
        pub error: Option<At<String>>,
        /// Other effects.
        pub effects: Option<Words>,
        /// Replacement.
        pub replaced_by: Option<At<String>>,
    }

    /// Printed request and reply.
    pub struct ExampleTable: doc cite doubt {
        /// Bytes of the request.
        pub request: At<Vec<u8>>,
        /// Bytes of the reply.
        pub reply: At<Vec<u8>>,
    }

    /// When an order completes.
    pub struct CompletionTable {
        /// Item or reply field that indicates completion; a bit name follows after a dot.
        pub poll: Option<At<String>>,
        /// Bits that are compared.
        pub mask: Option<u64>,
        /// Value that indicates completion. Default: any value except 0.
        pub value: Option<Literal>,
        /// Whether the reply to the order already shows the value: until the order completes, it has another value.
        pub in_reply: bool,
        /// Delay in ms after which the order is complete.
        pub delay: Option<u32>,
    }

    /// Field of a message.
    pub struct FieldTable: meaning orig doc cite doubt {
        /// Printed number of the first byte; numbers must be contiguous from field to field.
        pub at: Option<At<u16>>,
        /// Constant bytes.
        pub bytes: Option<Vec<u8>>,
        /// The only value of a `field`; without `field`, constant bits of a partial byte with the width of `type`.
        pub fixed: Option<At<Literal>>,
        /// Name of a value.
        pub field: Option<At<String>>,
        /// Data type.
        #[cfg_attr(test, schemars(transform = schema::types))]
        pub ty = "type": Option<At<String>>,
        /// Byte order; `A` is the most significant byte.
        pub order: Option<At<String>>,
        /// Physical value of raw 0.
        pub offset: Option<f64>,
        /// The value is the number of bytes from the named field to the end of the frame.
        pub counts: Option<At<String>>,
        /// Copy of this request field; with `part`, of some of its bytes.
        pub echo: Option<At<String>>,
        /// Bytes of the echoed field (`"1..3"`); 0 is the first on the wire.
        pub part: Option<At<NumberOrText>>,
        /// Copy of these request bytes (`"3..5"`); 0 is the first data byte.
        pub copy: Option<At<NumberOrText>>,
        /// Number of an item in this space, with this `type`.
        pub code: Option<At<String>>,
        /// Value of the preceding `code` of this space.
        pub value_of: Option<At<String>>,
        /// As many zero bytes as the value of the preceding `code` of this space has.
        pub zeros_for: Option<At<String>>,
        /// Number of bytes without meaning.
        pub pad: Option<u8>,
        /// Repeated fields.
        pub repeat: Option<RepeatTable>,
        /// Whether the field is all following bytes.
        pub rest: bool,
    }

    /// Repeated fields.
    pub struct RepeatTable {
        /// Field with the number of repetitions. Default: to the end of the frame.
        pub count: Option<At<String>>,
        /// Maximum number of repetitions.
        pub max: Option<u16>,
        /// Fields.
        pub fields: Vec<At<FieldTable>>,
    }
}

#[cfg(test)]
tables! {
    /// Register table, overlay or profile.
    pub struct Document {
        /// Format version: 1.
        #[cfg_attr(test, schemars(extend("const" = 1)))]
        pub lexibus: Option<At<u32>>,
        /// The device that the table describes.
        pub device: Option<At<DeviceTable>>,
        /// Devices of the overlay, and its reason.
        pub overlay: Option<At<OverlayTable>>,
        /// Name, number and devices of the profile.
        pub profile: Option<At<ProfileTable>>,
        /// Manual that the table was transcribed from.
        pub manual: Option<At<ManualTable>>,
        /// Models of a family that share the table.
        pub models: Vec<At<ModelTable>>,
        /// Mailbox and sync managers of an EtherCAT slave.
        pub ethercat: Option<At<EtherCatTable>>,
        /// Choice that the manual leaves open.
        pub options: Entries<OptionTable>,
        /// Default keys of rows.
        pub defaults: Option<At<Row>>,
        /// Meaning of a register number on each bus.
        pub spaces: Entries<SpaceTable>,
        /// Rows, in the order of the manual.
        pub chapters: Vec<At<ChapterTable>>,
        /// Units with a scale, by name.
        pub units: Entries<UnitTable>,
        /// Numbers that depend on the machine, such as the pitch of a screw.
        pub given: Entries<GivenTable>,
        /// Named values.
        pub enums: Entries<EnumTable>,
        /// Named bits.
        pub bits: Entries<BitsTable>,
        /// Rules that derive the objects of further axes from the first axis.
        pub axes: Option<At<AxesTable>>,
        /// Process data objects that do not follow from the defaults of mapping objects.
        pub pdos: Vec<At<PdoTable>>,
        /// Fixed process images.
        pub images: Vec<At<ImageTable>>,
        /// Tables of codes: emergency codes, alarms, abort codes.
        pub codes: Entries<CodesTable>,
        /// State machines.
        pub machines: Entries<MachineTable>,
        /// Sequences of steps.
        pub procedures: Entries<ProcedureTable>,
        /// Numbers that are split over several items.
        pub composites: Entries<CompositeTable>,
        /// How frames of a command protocol are delimited and checked.
        pub framing: Option<At<FramingTable>>,
        /// Requests and replies of a command protocol.
        pub messages: Vec<At<MessageTable>>,
        /// Modbus frames that the manual prints.
        pub frames: Vec<At<FrameTable>>,
        /// Ambiguities that belong to no row.
        pub doubts: Vec<At<DoubtTable>>,
    }
}
