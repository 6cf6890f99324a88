//! Types of the register table format. `dictionaries/README.md` explains the keys to authors of tables. The doc comments of the
//! types become descriptions in the JSON Schema.

use std::fmt;

use super::at::{At, Entries, FlagOr, Literal, OneOrMany, TextOr};
use super::read::{self, Mistake, Node, Read};
#[cfg(test)]
use super::schema;
use super::tree::cited;

/// Expands to the key of a field: its name, or the text after `=`.
macro_rules! key {
    ($field:ident) => {
        stringify!($field)
    };
    ($field:ident $key:literal) => {
        $key
    };
}

/// Declares tables of the format with their readers. Every key is optional, and unknown keys are errors. A field has the key
/// after `=` if this key is not a valid Rust name. Words after the name of the table select groups of common keys.
macro_rules! tables {
    ($(
        $(#[$attribute:meta])*
        pub struct $name:ident $(: $($group:ident)+)? { $($fields:tt)* }
    )*) => {$(
        table! { { $($($group)+)? } [$(#[$attribute])*] $name { $($fields)* } }
        $($(words! { $name $group })+)?
    )*};
}

/// Tables that may have a description.
pub(super) trait Documented {
    fn doc(&self) -> Option<&str>;
}

/// Tables that may cite the manual.
pub(super) trait Cited {
    /// Returns the cited pages or lines as one text.
    fn cited(&self) -> Option<String>;
}

/// Tables that may record ambiguities in the manual.
pub(super) trait Doubted: Cited {
    fn doubt_tables(&self) -> [Option<&OneOrMany<DoubtTable>>; 2];
}

/// Implements the traits for the key groups of a table.
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

/// Declares one table, and adds its groups of common keys one by one.
macro_rules! table {
    ({ meaning $($group:ident)* } $attributes:tt $name:ident { $($fields:tt)* }) => {
        table! { { $($group)* } $attributes $name {
            $($fields)*
            /// Definition of the bits, or the name of a definition in `[bits]`.
            #[cfg_attr(test, schemars(transform = schema::keys(schema::BITS)))]
            pub bits: Option<At<TextOr<BitEntries>>>,
            /// Definition of the values, or the name of a definition in `[enums]`.
            #[cfg_attr(test, schemars(transform = schema::keys(schema::VALUES)))]
            pub values = "enum": Option<At<TextOr<ValueEntries>>>,
            /// Symbol of the unit, or the name of a unit in `[units]`.
            pub unit: Option<At<String>>,
            /// Scale factor (physical value = raw value × scale + offset), or another rule that converts raw values.
            pub scale: Option<At<Scaling>>,
            /// Minimum raw value.
            pub min: Option<At<Literal>>,
            /// Maximum raw value.
            pub max: Option<At<Literal>>,
            /// Raw values that do not represent a number, each with its meaning.
            pub na: Option<Entries<String>>,
            /// Pairs of raw and physical values in the manual; the compiler compares each pair with the scale.
            pub conversions: Vec<At<ConversionTable>>,
        } }
    };
    ({ window $($group:ident)* } $attributes:tt $name:ident { $($fields:tt)* }) => {
        table! { { $($group)* } $attributes $name {
            $($fields)*
            /// Models that have this item, value, bit, code or message; `*` matches any characters.
            pub models: Option<Vec<At<String>>>,
            /// First firmware version that has this item, value, bit, code or message.
            pub since: Option<String>,
            /// First firmware version that no longer has this item, value, bit, code or message.
            pub until: Option<String>,
        } }
    };
    ({ orig $($group:ident)* } $attributes:tt $name:ident { $($fields:tt)* }) => {
        table! { { $($group)* } $attributes $name {
            $($fields)*
            /// Name in the language of the manual.
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
            /// Page or line of the manual, or several pages or lines.
            pub cite: Option<OneOrMany<NumberOrText>>,
        } }
    };
    ({ doubt $($group:ident)* } $attributes:tt $name:ident { $($fields:tt)* }) => {
        table! { { $($group)* } $attributes $name {
            $($fields)*
            /// Ambiguity in the manual, and the assumption of the table.
            pub doubt: Option<OneOrMany<DoubtTable>>,
            /// Several ambiguities in the manual, each with an assumption.
            pub doubts: Option<OneOrMany<DoubtTable>>,
        } }
    };
    ({ allow $($group:ident)* } $attributes:tt $name:ident { $($fields:tt)* }) => {
        table! { { $($group)* } $attributes $name {
            $($fields)*
            /// Codes of diagnostics that an ambiguity explains; the compiler suppresses these diagnostics.
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

        impl $name {
            /// Keys that the table can have.
            pub(super) const KEYS: &'static [&'static str] = &[$(key!($field $($key)?)),*];
        }

        impl Read for $name {
            fn read(node: &Node<'_>) -> Result<Self, Mistake> {
                let mut table = Self::default();
                for (key, value) in read::table(node)?.iter() {
                    match key.value.as_ref() {
                        $(key!($field $($key)?) => table.$field = Read::read(value)?,)*
                        _ => return Err(Mistake::unknown_key(key, Self::KEYS)),
                    }
                }
                Ok(table)
            }
        }
    };
}

/// Values that fulfill a condition, and the bits that the condition compares.
#[derive(Clone, Debug)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(untagged))]
pub enum ConditionValues {
    /// Values of the whole item.
    Values(OneOrMany<Literal>),
    /// Values of some bits of the item.
    Bits(ConditionTable),
}

/// Required values of other items, by item name.
pub type Conditions = Entries<ConditionValues>;

/// Creates a row from an image field or message field, with the keys that rows and fields have in common.
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
pub(super) use {field_row, key};

/// Text, or a list of texts.
pub type Words = OneOrMany<String>;

/// Bits by position, each with a name, a definition, or several meanings.
pub type BitEntries = Entries<OneOrMany<TextOr<BitTable>>>;

/// Values by number, each with a name or a definition.
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

/// Scale factor, or another rule that converts raw values.
#[derive(Clone, Debug)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(untagged))]
pub enum Scaling {
    /// Scale factor: physical value = raw value × factor.
    Factor(f64),
    /// Any other rule that converts raw values.
    Rule(Box<ScaleRule>),
}

tables! {
    /// Rule that converts a raw value to a physical value.
    pub struct ScaleRule {
        /// Scale factor by which the raw value is multiplied. Default: 1.
        pub factor: Option<f64>,
        /// Physical value of the raw value 0.
        pub offset: Option<f64>,
        /// Item by whose value the raw value is divided.
        pub by: Option<At<String>>,
        /// Item by whose value the raw value is multiplied.
        pub times: Option<At<String>>,
        /// Numerator of a reciprocal: physical value = numerator / raw value.
        pub reciprocal: Option<f64>,
        /// Number of fractional bits of the raw value.
        pub fraction: Option<u8>,
        /// Name of the model constant that is the base value of the fraction: physical value = fraction × constant.
        pub of: Option<At<String>>,
        /// Item that contains the exponent of the power by which the raw value is multiplied.
        pub exponent: Option<At<String>>,
        /// Base of the power: 10 (default) or 2.
        pub base: Option<u8>,
    }

    /// Ambiguity in the manual, and the assumption of the table.
    pub struct DoubtTable {
        /// Text that the manual prints; in case of a contradiction, both statements.
        pub says: String,
        /// Assumption that the table makes.
        pub chose: String,
        /// Reason for the assumption.
        pub why: String,
        /// Page or line of the manual that contains the ambiguity, or several pages or lines.
        pub cite: Option<OneOrMany<NumberOrText>>,
        /// Consequence of a wrong assumption: `hazard` (damage or motion), `value` (a wrong value) or `print` (a misprint only).
        #[cfg_attr(test, schemars(transform = schema::words("hazard value print")))]
        pub severity: Option<At<String>>,
    }

    /// Mailbox protocols and sync managers of an EtherCAT slave.
    pub struct EtherCatTable: cite doubt {
        /// CAN application protocol over EtherCAT (CoE): whether it is supported, or a table of its features.
        pub coe: Option<FlagOr<CoeTable>>,
        /// Whether ADS over EtherCAT (AoE) is supported.
        pub aoe: bool,
        /// Whether Ethernet over EtherCAT (EoE) is supported.
        pub eoe: bool,
        /// Whether file access over EtherCAT (FoE) is supported.
        pub foe: bool,
        /// Whether the servo drive profile over EtherCAT (SoE) is supported.
        pub soe: bool,
        /// Whether a vendor-specific protocol over EtherCAT (VoE) is supported.
        pub voe: bool,
        /// Sync managers of the slave.
        pub sync_managers: Vec<At<SyncManagerTable>>,
    }

    /// Features of a slave's CAN application protocol.
    pub struct CoeTable: cite {
        /// Whether the SDO information service is supported.
        pub sdo_info: bool,
        /// Whether the PDO assignment is writable (0x1C12, 0x1C13).
        pub pdo_assign: bool,
        /// Whether the PDO mapping objects are writable.
        pub pdo_config: bool,
        /// Whether masters read the PDO mapping and the PDO assignment from the device.
        pub pdo_upload: bool,
        /// Whether complete access to all sub-indices is supported.
        pub complete_access: bool,
        /// Whether segmented transfer is supported.
        pub segmented_sdo: bool,
    }

    /// Sync manager of an EtherCAT slave.
    pub struct SyncManagerTable: cite doubt {
        /// Number of the sync manager.
        pub number: Option<u8>,
        /// Purpose as seen from the master: `mailbox_out`, `mailbox_in`, `outputs` or `inputs`.
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
        /// Control byte of the sync manager.
        pub control: Option<u8>,
    }

    /// Device that a table describes.
    pub struct DeviceTable: orig doc cite doubt {
        /// Name of the device, from which the names of Rust types are derived.
        pub name: Option<At<String>>,
        /// Name of the vendor.
        pub vendor: Option<String>,
        /// Vendor ID, assigned by the CiA or the ETG.
        pub vendor_id: Option<u32>,
        /// Product code of the device.
        pub product_code: Option<u32>,
        /// Revision number of the device.
        pub revision: Option<u32>,
        /// Order code of the device.
        pub order_code: Option<String>,
        /// Buses of the device: `canopen`, `ethercat`, `modbus`, `profinet`, `serial`.
        #[cfg_attr(test, schemars(transform = schema::words(schema::BUSES)))]
        pub buses: Option<Vec<At<String>>>,
        /// Numbers of the device profiles that the device follows.
        pub profiles: Vec<u32>,
        /// Range of valid node-IDs or server addresses (`"1..90"`).
        #[cfg_attr(test, schemars(transform = schema::notation("#(\\.\\.=?#)?")))]
        pub node_ids: Option<At<NumberOrText>>,
        /// CANopen bit rates that the device supports, in kbit/s.
        pub bit_rates: Vec<u16>,
        /// Number of RPDOs of the device.
        pub rx_pdos: Option<u16>,
        /// Number of TPDOs of the device.
        pub tx_pdos: Option<u16>,
        /// Granularity of the PDO mapping in bits.
        pub granularity: Option<u8>,
        /// Whether layer setting services (LSS) are supported.
        pub lss: bool,
    }

    /// Manual that a table was transcribed from.
    pub struct ManualTable: doc {
        /// Title of the manual.
        pub title: Option<String>,
        /// Edition of the manual: a number or date.
        pub edition: Option<String>,
        /// Language of the manual as a BCP 47 tag.
        pub language: Option<String>,
        /// Unit of the numbers in `cite`: `page` or `line`.
        #[cfg_attr(test, schemars(transform = schema::words("page line")))]
        pub cites: Option<At<String>>,
        /// Titles of sections and tables, each with its first page or line.
        pub sections: Entries<String>,
    }

    /// Devices or modules that an overlay changes, and the reason for the overlay.
    pub struct OverlayTable: doc {
        /// Devices or modules that the overlay changes.
        pub applies = "for": Option<AppliesTable>,
        /// Reason for the overlay.
        pub why: Option<String>,
    }

    /// Devices that an overlay changes; omitted keys match any device.
    pub struct AppliesTable {
        /// Vendor ID of the devices.
        pub vendor_id: Option<u32>,
        /// Product code of the devices.
        pub product_code: Option<u32>,
        /// Revision number of the devices.
        pub revision: Option<u32>,
        /// Name, order code or identifier of the devices; `*` matches any characters.
        pub device: Option<String>,
        /// Name, identifier or number of the modules that the overlay changes; `*` matches any characters. Unless `for` contains a
        /// key of a device, PROFINET submodules can match as well.
        pub module: Option<String>,
    }

    /// Name and number of a profile, and the devices that follow it.
    pub struct ProfileTable: doc {
        /// Name of the profile.
        pub name: Option<String>,
        /// Number of the device profile.
        pub number: Option<u32>,
        /// Object that identifies devices with this profile.
        pub when: Option<At<NumberOrText>>,
        /// PROFINET: API number of the submodules that follow the profile.
        pub api: Option<u32>,
        /// Buses on which the profile applies.
        pub buses: Option<Vec<At<String>>>,
        /// Index offset from one axis to the next, for objects from 0x6000 to 0x67FF.
        pub axis_index: Option<u16>,
    }

    /// Model or firmware version of the device.
    pub struct ModelTable: orig doc cite doubt {
        /// Name of the model.
        pub name: Option<At<String>>,
        /// Product code of the model.
        pub product_code: Option<u32>,
        /// Revision number of the model.
        pub revision: Option<u32>,
        /// Order code of the model.
        pub order_code: Option<String>,
        /// Constants of the model, to which scale factors refer.
        pub constants: Entries<Literal>,
    }

    /// Option for a fact that the manual does not state.
    pub struct OptionTable: doc cite doubt {
        /// Choices of the option, each with the value that replaces `$name` in the table.
        pub choices: Entries<Literal>,
        /// Default choice of the option.
        pub default: Option<At<String>>,
    }

    /// Rules that convert a register number to an address on each bus.
    pub struct SpaceTable: doc {
        /// Number of bits that one register number addresses. Default: 1 for coils and discrete inputs, otherwise 16.
        pub bits: Option<u8>,
        /// Whether a value that is shorter than its registers is extended to their length: a signed value with its sign, and an
        /// unsigned value with zeros.
        pub extend: bool,
        /// Rule for Modbus addresses.
        pub modbus: Option<ModbusRule>,
        /// Rule for CANopen objects.
        pub canopen: Option<ObjectRule>,
        /// Rule for EtherCAT objects (CoE).
        pub ethercat: Option<ObjectRule>,
        /// Whether `reg` is a parameter number of a command protocol; or a table with the messages that transfer the parameter.
        pub parameter: Option<FlagOr<ParameterMessages>>,
        /// Whether `reg` is an address in the memory of an EtherCAT slave controller.
        pub esc: bool,
        /// Window through which the driver accesses the registers of the space, or a list of windows.
        pub indirect: Option<OneOrMany<IndirectRule>>,
    }

    /// Messages that transfer the parameters of a space.
    pub struct ParameterMessages {
        /// Message that reads a parameter.
        pub read: Option<At<String>>,
        /// Message that writes a parameter.
        pub write: Option<At<String>>,
        /// Message that stores parameters in non-volatile memory.
        pub store: Option<At<String>>,
        /// Byte order of 32-bit values; `A` is the most significant byte.
        pub order: Option<At<String>>,
    }

    /// Rule for the Modbus addresses of a space.
    pub struct ModbusRule {
        /// Modbus table of the registers: `holding`, `input`, `coil` or `discrete`.
        #[cfg_attr(test, schemars(transform = schema::words("holding input coil discrete")))]
        pub table: Option<At<String>>,
        /// Printed register number of the wire address 0; the wire address is `reg` - `first` + `add`.
        pub first: Option<i64>,
        /// Offset that is added to the register number to get the wire address.
        pub add: Option<i64>,
        /// Word order of values with several registers: `high_first` or `low_first`.
        #[cfg_attr(test, schemars(transform = schema::words("high_first low_first")))]
        pub order: Option<At<String>>,
        /// Whether `order` is an assumption, because the manual does not state the word order.
        pub order_assumed: bool,
        /// Prefix of the register numbers in the manual: `R` for `R01`.
        pub prefix: Option<String>,
        /// Minimum number of digits of the register numbers in the manual: 2 for `R01`.
        pub digits: Option<u8>,
        /// Whether the device sends the low byte of each word first.
        pub swap: bool,
        /// Function codes that the device supports (`[3, 6, 16]`).
        pub functions: Option<At<Vec<u8>>>,
        /// Maximum number of registers or bits that one request reads.
        pub max_read: Option<At<u16>>,
        /// Maximum number of registers or bits that one request writes.
        pub max_write: Option<At<u16>>,
        /// Whether the driver may transfer a value in several requests if the value exceeds the limit of one request.
        pub split: Option<bool>,
    }

    /// Rule for the object of a register.
    pub struct ObjectRule {
        /// Offset that is added to the register number to get the index.
        pub index: Option<At<i64>>,
        /// Sub-index of the object.
        pub sub: Option<At<u8>>,
    }

    /// Window: items through which the driver accesses the registers of a space.
    pub struct IndirectRule {
        /// Buses on which the window exists. Default: all buses of the items in the window.
        #[cfg_attr(test, schemars(transform = schema::words(schema::BUSES)))]
        pub buses: Option<Vec<At<String>>>,
        /// Numbers that the driver may write to the window (`reg` + `add`), such as `"0x8000..0x8FFF"`. Default: all numbers.
        pub numbers: Option<At<String>>,
        /// Offset that is added to `reg` to get the number that the driver writes.
        pub add: Option<i64>,
        /// Item to which the driver writes the register number.
        pub write_address: Option<At<String>>,
        /// Item through which the driver reads the value, or a table with further keys.
        pub read: Option<At<TextOr<WindowTable>>>,
        /// Item through which the driver writes the value, or a table with further keys.
        pub write: Option<At<TextOr<WindowTable>>>,
        /// Whether the device resets the register number to 0 after the transfer. Default: follows from `procedure` and the row of `write_address`.
        pub clears: Option<bool>,
        /// Time in ms that the transfer takes, if the device does not reset the register number.
        pub wait: Option<u32>,
        /// Maximum time in ms until the device resets the register number.
        pub timeout: Option<u32>,
        /// Procedure that describes the access sequence.
        pub procedure: Option<At<String>>,
    }

    /// Items and times for reading or writing through a window.
    pub struct WindowTable {
        /// Item to which the driver writes the register number. Default: `write_address`.
        pub address: Option<At<String>>,
        /// Item through which the driver reads or writes the value.
        pub value: Option<At<String>>,
        /// Item that the driver writes first: `address` or `value`; valid only in `write`.
        #[cfg_attr(test, schemars(transform = schema::words("address value")))]
        pub first: Option<At<String>>,
        /// Whether the device resets the register number to 0 after the transfer.
        pub clears: Option<bool>,
        /// Time in ms that the transfer takes, if the device does not reset the register number.
        pub wait: Option<u32>,
        /// Maximum time in ms until the device resets the register number.
        pub timeout: Option<u32>,
        /// Procedure that describes the access sequence.
        pub procedure: Option<At<String>>,
    }

    /// Group of rows, such as the rows of one chapter of the manual.
    pub struct ChapterTable: orig doc cite doubt {
        /// Title of the chapter.
        pub title: Option<String>,
        /// Space that converts the register numbers of the chapter.
        pub space: Option<At<String>>,
        /// Keys that apply to all rows of the chapter.
        pub defaults: Option<At<Row>>,
        /// Rows of registers, by name.
        pub registers: Entries<Row>,
        /// Rows of objects, by index and sub-index (`0x6040`, `"0x1018:1"`, `"0x1400..0x1403:1"`).
        #[cfg_attr(test, schemars(transform = schema::keys(schema::OBJECTS)))]
        pub objects: Entries<Row>,
    }

    /// Description of one item of the device: a register, object or parameter.
    pub struct Row: meaning window orig doc cite doubt allow {
        /// Register number, or range of register numbers (`"63-64"`).
        #[cfg_attr(test, schemars(transform = schema::notation("#( *[-–] *#)?")))]
        pub reg: Option<At<NumberOrText>>,
        /// Index and sub-index of the object (`"0x2000:1"`).
        #[cfg_attr(test, schemars(transform = schema::notation("#(:#)?")))]
        pub obj: Option<At<NumberOrText>>,
        /// Address in the memory of an EtherCAT slave controller.
        pub esc: Option<At<u16>>,
        /// Access rights of the slave's processor to the memory of the slave controller: `ro`, `rw` or `wo`.
        #[cfg_attr(test, schemars(transform = schema::words("ro rw wo")))]
        pub pdi: Option<At<String>>,
        /// Length of the memory at `esc` in bytes. Without `esc`: length that the manual prints; the compiler compares this length with the type.
        pub length: Option<At<u16>>,
        /// Name of the item in an ASCII protocol.
        pub ascii: Option<String>,
        /// Parameter number of the item in a command protocol.
        pub param: Option<At<u32>>,
        /// Name of the object or sub-entry.
        pub name: Option<At<String>>,
        /// Object code: `var`, `array`, `record` or `domain`.
        #[cfg_attr(test, schemars(transform = schema::words("var array record domain")))]
        pub code: Option<At<String>>,
        /// Data type: `u16`, `i32`, `f32`, `bool`, `str(25)`, `bytes(6)`, `u16[10]`, …; `?` if the manual does not state it.
        #[cfg_attr(test, schemars(transform = schema::types))]
        pub ty = "type": Option<At<String>>,
        /// Access rights: `ro`, `rw`, `wo`, `const`, `rwr` or `rww`; `?` if the manual does not state them (the compiler assumes `rw`, or `ro` for Modbus inputs).
        #[cfg_attr(test, schemars(transform = schema::words("ro rw wo const rwr rww ?")))]
        pub access: Option<At<String>>,
        /// PDO direction, as seen from the device: `rx`, `tx`, `both` or `no`.
        #[cfg_attr(test, schemars(transform = schema::words("rx tx both no")))]
        pub pdo: Option<At<String>>,
        /// Default value: a raw value, an expression with the node-ID (`"$NODEID+0x80"`), or a list with one value per object, repetition or
        /// array element.
        pub default: Option<At<OneOrMany<Literal>>>,
        /// Value that the item always has.
        pub fixed: Option<At<Literal>>,
        /// Valid values and ranges of values (`"3..7"`); all other values are invalid.
        pub allowed: Option<At<Vec<Literal>>>,
        /// Physical value of the raw value 0.
        pub offset: Option<f64>,
        /// Increment: the device rounds written raw values to multiples of this value.
        pub step: Option<At<Literal>>,
        /// Facts of the item that differ on some models or buses.
        pub variants: Option<Vec<At<VariantTable>>>,
        /// Storage: `true` (non-volatile), `false` (volatile), or the name of the command that stores the value.
        pub save: Option<FlagOrText>,
        /// Event after which a written value takes effect, if not immediately.
        pub effective: Option<String>,
        /// Conditions for writing: the value is writable only while each listed item has one of its listed values.
        pub when: Option<Conditions>,
        /// Values and ranges of values that may be written (`"3..7"`).
        pub writable: Option<At<Vec<Literal>>>,
        /// Whether the device resets the value to 0 after a write.
        pub clears: Option<bool>,
        /// Whether the value can be written only once.
        pub once: Option<bool>,
        /// Other effects of writing the value.
        pub effects: Option<Words>,
        /// Item that replaces this item.
        pub replaced_by: Option<At<String>>,
        /// Hardware or software options that the item requires.
        pub needs: Option<Words>,
        /// Buses on which the item exists.
        #[cfg_attr(test, schemars(transform = schema::words(schema::BUSES)))]
        pub buses: Option<Vec<At<String>>>,
        /// Whether each axis has its own item.
        pub per_axis: Option<bool>,
        /// Item that contains the upper half of the number; this item contains the lower half.
        pub upper: Option<At<String>>,
        /// Item for the same quantity in another scale; the compiler compares the physical default values of both items.
        pub same_quantity: Option<At<String>>,
        /// Item that accesses the same value at another address.
        pub same_as: Option<At<String>>,
        /// Whether the item is only for the vendor or the tools of the vendor.
        pub hidden: Option<bool>,
        /// Number of repetitions, or the item that contains the number of valid repetitions.
        pub count: Option<At<NumberOrText>>,
        /// Maximum number of repetitions, required if `count` names an item.
        pub max_count: Option<u32>,
        /// Difference between the addresses of successive repetitions, in `reg`, `obj`, `param` and `esc`.
        pub stride: Option<u32>,
        /// Bits of the Modbus register that contain the value (`"7-0"`).
        #[cfg_attr(test, schemars(transform = schema::notation(schema::BITS)))]
        pub part: Option<At<NumberOrText>>,
        /// Word order of the value: `high_first` or `low_first`.
        #[cfg_attr(test, schemars(transform = schema::words("high_first low_first")))]
        pub order: Option<At<String>>,
        /// Whether the device sends the low byte of each word first.
        pub swap: Option<bool>,
        /// Whether the sub-index exists and is read-only, but has no meaning.
        pub reserved: Option<bool>,
        /// Whether the sub-index does not always exist.
        pub optional: Option<bool>,
        /// Source of `doc`, if it is not the manual: a standard (`CiA 402, 17.3.7`), or `name` if `doc` only spells out the printed name.
        pub doc_from: Option<At<String>>,
        /// Facts about the item in other parts of the manual; the compiler compares these facts with the row.
        pub summary: Option<At<OneOrMany<SummaryTable>>>,
        /// In an overlay: reason for the change.
        pub why: Option<String>,
        /// In an overlay: whether the row adds an object that the description does not contain.
        pub add: Option<bool>,
        /// In an overlay: whether the row removes the object.
        pub remove: Option<bool>,
    }

    /// Facts of an item that differ on some models or buses; the row contains all other facts.
    pub struct VariantTable: doc cite {
        /// Models to which the variant applies; `*` matches any characters.
        pub models: Option<Vec<At<String>>>,
        /// Buses to which the variant applies.
        #[cfg_attr(test, schemars(transform = schema::words(schema::BUSES)))]
        pub buses: Option<Vec<At<String>>>,
        /// Integer type or `bool` on the buses of the variant, if it differs from the type of the row.
        #[cfg_attr(test, schemars(transform = schema::types))]
        pub ty = "type": Option<At<String>>,
        /// Access rights on the buses of the variant, if they are more restrictive than those of the row.
        #[cfg_attr(test, schemars(transform = schema::words("ro rw wo")))]
        pub access: Option<At<String>>,
        /// Valid values and ranges of values; all other values are invalid.
        pub allowed: Option<At<Vec<Literal>>>,
        /// Default value.
        pub default: Option<At<Literal>>,
        /// Minimum raw value.
        pub min: Option<At<Literal>>,
        /// Maximum raw value.
        pub max: Option<At<Literal>>,
        /// Increment: the device rounds written raw values to multiples of this value.
        pub step: Option<At<Literal>>,
        /// Scale factor (physical value = raw value × scale), or another rule that converts raw values.
        pub scale: Option<At<Scaling>>,
    }

    /// Condition that compares some bits of an item.
    pub struct ConditionTable {
        /// Bits that the condition compares.
        pub mask: Option<u64>,
        /// Value that the compared bits must have, or a list of values.
        pub value: Option<OneOrMany<Literal>>,
    }

    /// Summary of an item: facts in another part of the manual, such as an overview, a table of contents or the text.
    pub struct SummaryTable: cite {
        /// Data type that the summary states.
        #[cfg_attr(test, schemars(transform = schema::types))]
        pub ty = "type": Option<At<String>>,
        /// Access rights that the summary states.
        pub access: Option<At<String>>,
        /// PDO direction that the summary states.
        pub pdo: Option<At<String>>,
        /// Object code that the summary states.
        #[cfg_attr(test, schemars(transform = schema::words("var array record domain")))]
        pub code: Option<At<String>>,
        /// Name that the summary states.
        pub name: Option<At<String>>,
        /// Number of sub-indices that the summary states, including sub-index 0.
        pub subs: Option<At<u32>>,
        /// Length in bytes that the summary states.
        pub length: Option<At<u32>>,
        /// Minimum that the summary states.
        pub min: Option<At<Literal>>,
        /// Maximum that the summary states.
        pub max: Option<At<Literal>>,
        /// Default value that the summary states.
        pub default: Option<At<Literal>>,
    }

    /// Named unit, with its scale, offset and machine unit.
    pub struct UnitTable: doc {
        /// Symbol of the physical unit.
        pub symbol: Option<String>,
        /// Scale factor (physical value = raw value × scale + offset), or another rule that converts raw values.
        pub scale: Option<At<Scaling>>,
        /// Physical value of the raw value 0.
        pub offset: Option<f64>,
        /// Conversion of physical values to a machine unit.
        pub machine: Option<MachineUnitTable>,
        /// Unit as the manual prints it.
        pub orig: Option<String>,
    }

    /// Machine unit: the physical value is multiplied and divided by properties that `[given]` defines.
    pub struct MachineUnitTable {
        /// Symbol of the machine unit.
        pub unit: Option<At<String>>,
        /// Machine properties from `[given]` by which the physical value is multiplied.
        pub times: Vec<At<String>>,
        /// Machine properties from `[given]` by which the physical value is divided.
        pub over: Vec<At<String>>,
    }

    /// Property of the machine that conversions to machine units use.
    pub struct GivenTable: doc cite doubt {
        /// Symbol of the unit of the property.
        pub unit: Option<At<String>>,
        /// Models on which the property has a fixed value, each with this value.
        pub models: Entries<Literal>,
    }

    /// Enumeration: named values of an integer.
    pub struct EnumTable: orig doc cite doubt allow {
        /// Integer type of the values; required only if it does not follow from a row.
        #[cfg_attr(test, schemars(transform = schema::types))]
        pub base: Option<At<String>>,
        /// Whether the device never uses an unlisted value.
        pub closed: bool,
        /// Values and ranges of values (`"3..7"`), each with a name or a table.
        #[cfg_attr(test, schemars(transform = schema::keys(schema::VALUES)))]
        pub values: ValueEntries,
    }

    /// Named value of an enumeration.
    pub struct ValueTable: window orig doc cite doubt {
        /// Name of the value: a short English phrase, from which the Rust identifier is derived.
        pub name: Option<String>,
        /// Zone of reserved or vendor-specific values: `reserved` or `vendor`.
        #[cfg_attr(test, schemars(transform = schema::words("reserved vendor")))]
        pub zone: Option<At<String>>,
        /// Buses on which the value exists.
        #[cfg_attr(test, schemars(transform = schema::words(schema::BUSES)))]
        pub buses: Option<Vec<At<String>>>,
        /// Condition: the value exists only while the listed item has one of the listed values.
        pub when: Option<Conditions>,
        /// Name of the value that replaces this value.
        pub replaced_by: Option<String>,
    }

    /// Named bits and bit fields of an integer.
    pub struct BitsTable: orig doc cite doubt allow {
        /// Integer type of the bits; required only if it does not follow from a row.
        #[cfg_attr(test, schemars(transform = schema::types))]
        pub base: Option<At<String>>,
        /// Address of the byte that contains bits 0 to 7. Required if keys of `at` contain byte addresses, as in `"0x221:3-2"`.
        pub address: Option<u32>,
        /// Bits and ranges of bits (`"3-2"`); a list of meanings if other items select the meaning.
        #[cfg_attr(test, schemars(transform = schema::keys(schema::BITS_OF_BYTES)))]
        pub at: BitEntries,
    }

    /// Meaning of a bit or bit field.
    pub struct BitTable: window orig doc cite doubt {
        /// Name of the bits: a short English phrase, from which the Rust identifier is derived.
        pub name: Option<String>,
        /// Whether the name applies while the bit is 0.
        pub inverted: bool,
        /// Whether the bit field contains a number.
        pub number: bool,
        /// Names of the values of the bit field.
        #[cfg_attr(test, schemars(transform = schema::keys(schema::VALUES)))]
        pub values: Option<ValueEntries>,
        /// Name of an enumeration that names the values of the bit field.
        pub enumeration = "enum": Option<At<String>>,
        /// Value to write to bits without meaning: 0, 1, or the value that was read before (`keep`).
        pub reserved: Option<NumberOrText>,
        /// Edge or event that starts the command: `rising`, `falling`, `toggle` or `self_clearing`.
        #[cfg_attr(test, schemars(transform = schema::words(schema::TRIGGERS)))]
        pub trigger: Option<At<String>>,
        /// Condition: the bits have this meaning only while the listed item has one of the listed values.
        pub when: Option<Conditions>,
        /// Access rights to the bits, if they differ from the access rights of the row.
        #[cfg_attr(test, schemars(transform = schema::words("ro rw wo const rwr rww")))]
        pub access: Option<At<String>>,
        /// Name of the bits that replace these bits.
        pub replaced_by: Option<String>,
    }

    /// Rules that derive the objects of further axes from those of the first axis.
    pub struct AxesTable: doc cite doubt {
        /// Number of axes.
        pub count: u8,
        /// Models that have this number of axes; `*` matches any characters.
        pub models: Option<Vec<At<String>>>,
        /// Rules that derive objects; if several rules contain an object, the first of these rules applies.
        pub rules: Vec<At<AxisRuleTable>>,
    }

    /// Rule that derives the objects of the next axis.
    pub struct AxisRuleTable {
        /// Objects of the first axis to which the rule applies (`"0x6000..0x67FF"`).
        #[cfg_attr(test, schemars(transform = schema::notation("#(\\.\\.=?#)?")))]
        pub objects: Option<At<NumberOrText>>,
        /// Offset that is added to the index for each further axis.
        pub index: Option<u16>,
        /// `axis`: the sub-index is the axis number.
        #[cfg_attr(test, schemars(transform = schema::words("axis")))]
        pub sub: Option<String>,
        /// Offset that is added to the sub-index for each further axis.
        pub sub_stride: Option<u8>,
    }

    /// Process data object.
    pub struct PdoTable: doc cite doubt allow {
        /// Index of the mapping object.
        pub index: Option<At<u16>>,
        /// Name of the PDO.
        pub name: Option<String>,
        /// Direction as seen from the device: `rx` or `tx`.
        #[cfg_attr(test, schemars(transform = schema::words("rx tx")))]
        pub direction: Option<At<String>>,
        /// Entries, each an object (`"0x6040:0/16"`), an item name, padding (`"pad/8"`), or a field without an object (`"? name/16"`, `"? name/i16"`).
        pub entries: Vec<At<String>>,
        /// Length in bytes that the manual prints, or a list of such lengths; the compiler compares each of these with the total
        /// length of the entries.
        pub length: Option<At<OneOrMany<u32>>>,
        /// Maximum length in bytes of a PDO with variable mapping.
        pub max: Option<u16>,
        /// Whether the entries cannot be changed.
        pub fixed: bool,
        /// Whether the PDO must be assigned.
        pub mandatory: bool,
        /// Sync manager of the default assignment.
        pub sm: Option<At<u8>>,
        /// Whether the PDO is assigned by default.
        pub default: bool,
        /// PDOs that cannot be assigned together with this PDO (`0x1702`, `"0x1600..0x1603"`).
        pub excludes: Vec<NumberOrText>,
        /// Buses on which the PDO has this mapping: `canopen`, `ethercat`.
        #[cfg_attr(test, schemars(transform = schema::words(schema::BUSES)))]
        pub buses: Option<Vec<At<String>>>,
    }

    /// Process image whose layout the manual prints.
    pub struct ImageTable: doc cite doubt {
        /// Name of the image.
        pub name: Option<String>,
        /// Direction as seen from the device: `rx` or `tx`.
        #[cfg_attr(test, schemars(transform = schema::words("rx tx")))]
        pub direction: Option<At<String>>,
        /// Length of the image in bytes.
        pub bytes: Option<u32>,
        /// Byte order of the fields: `big` (default) or `little`.
        #[cfg_attr(test, schemars(transform = schema::words("big little")))]
        pub order: Option<At<String>>,
        /// Fields of the image, by item name; a field that is not an item of the table needs a `type`.
        pub fields: Entries<ImageField>,
    }

    /// Field of a process image; the key of the field is the name of an item, or any other name.
    pub struct ImageField: meaning orig doc cite doubt {
        /// Number of the first byte of the field.
        pub at: Option<u32>,
        /// First bit of the field in its first byte.
        pub bit: Option<u8>,
        /// Data type of the field, if it differs from the type of the item.
        #[cfg_attr(test, schemars(transform = schema::types))]
        pub ty = "type": Option<At<String>>,
    }

    /// Table of codes, such as error codes or alarms.
    pub struct CodesTable: doc cite {
        /// Titles of further columns next to code and name.
        pub columns: Vec<String>,
        /// Prefix of the codes in the manual: `F` for `F125`.
        pub prefix: Option<String>,
        /// Whether the compiler warns about codes with equal cells.
        pub distinct: bool,
        /// Codes of diagnostics that an ambiguity explains; the compiler suppresses these diagnostics.
        pub allow: Option<Vec<At<String>>>,
        /// Buses on which these codes apply.
        #[cfg_attr(test, schemars(transform = schema::words(schema::BUSES)))]
        pub buses: Option<Vec<At<String>>>,
        /// Codes and ranges of codes, each with a name or a table.
        #[cfg_attr(test, schemars(transform = schema::keys(schema::VALUES)))]
        pub rows: Entries<TextOr<CodeTableRow>>,
    }

    /// Code with a name and further cells.
    pub struct CodeTableRow: window orig doc cite doubt {
        /// Name of the code.
        pub name: Option<String>,
        /// Contents of the further columns.
        pub cells: Vec<At<Literal>>,
    }

    /// State machine of the device.
    pub struct MachineTable: doc cite doubt {
        /// Item that contains the state.
        pub status: Option<At<String>>,
        /// Item to which commands are written.
        pub control: Option<At<String>>,
        /// States, each with its bit pattern in the `status` item; or the name of an enumeration of the states.
        pub states: Option<At<TextOr<Entries<PatternTable>>>>,
        /// State after power-on.
        pub initial: Option<At<String>>,
        /// Fault states, in which `walk` stops. The list can omit states that the device enters automatically from any state, and the states that follow them automatically.
        pub faults: Vec<At<String>>,
        /// Commands, each with its bit pattern in the `control` item.
        pub commands: Entries<PatternTable>,
        /// Transitions between the states.
        pub transitions: Vec<At<TransitionTable>>,
        /// Outcome of each command in each state.
        pub matrix: Option<At<MatrixTable>>,
    }

    /// State-command matrix: outcomes of commands by state.
    pub struct MatrixTable: doc cite doubt {
        /// States of the matrix columns, in order.
        pub states: Vec<At<String>>,
        /// Notes to which cells refer, by number.
        pub notes: Entries<String>,
        /// Rows of the matrix, by message or command; each row has one cell per state.
        pub rows: Entries<MatrixRow>,
    }

    /// Row of a state-command matrix: outcomes of a command in each state.
    pub struct MatrixRow: doc cite doubt {
        /// Messages or commands of the row, if the key of the row is not their name; empty if only the matrix describes the command.
        pub commands: Option<Vec<At<String>>>,
        /// One outcome per state: `same`, `refused`, `?`, the next state, or `"a > b"` if `b` follows `a` automatically.
        /// Several outcomes are separated by `or`.
        pub cells: Vec<At<TextOr<MatrixCell>>>,
        /// Models that have the command; `*` matches any characters.
        pub models: Option<Vec<At<String>>>,
        /// First firmware version that has the command.
        pub since: Option<String>,
    }

    /// Cell of a state-command matrix with an outcome and further facts.
    pub struct MatrixCell: cite {
        /// Outcome, in the notation of a cell without further facts.
        pub to: Option<At<String>>,
        /// Number of the note in `notes` of the matrix that applies to the cell.
        pub note: Option<At<NumberOrText>>,
        /// Condition under which the outcome occurs, in your own words.
        pub doc: Option<String>,
    }

    /// Bit pattern of a state or command.
    pub struct PatternTable: orig doc cite {
        /// Bits that belong to the pattern.
        pub mask: Option<u32>,
        /// Value of the bits in `mask`.
        pub value: Option<u32>,
    }

    /// Transition between two states.
    pub struct TransitionTable: doc cite {
        /// Number of the transition in the manual.
        pub number: Option<u16>,
        /// State before the transition, or a list of states. Default: any state.
        pub from: Option<At<OneOrMany<String>>>,
        /// State after the transition.
        pub to: Option<At<String>>,
        /// Command or message that causes the transition; automatic transitions have none.
        pub command: Option<At<String>>,
    }

    /// Procedure: a sequence of steps.
    pub struct ProcedureTable: orig doc cite doubt allow {
        /// Names of the arguments that the caller passes; steps write these arguments with `argument`.
        pub arguments: Vec<At<String>>,
        /// Steps of the procedure, in order.
        pub steps: Vec<At<StepTable>>,
    }

    /// Number that is split over several items.
    pub struct CompositeTable: orig doc cite doubt {
        /// Items that contain the digits, most significant first.
        pub parts: Vec<At<String>>,
        /// Base of the digits: each part is less than this number.
        pub base: Option<u16>,
        /// Item that contains the sign.
        pub sign: Option<At<String>>,
        /// Value of the sign item for negative numbers; the value for all other numbers is 0.
        pub negative: Option<u16>,
        /// Unit of the number.
        pub unit: Option<String>,
    }

    /// Step of a procedure.
    pub struct StepTable: doc {
        /// Item to which the step writes `value` or `argument`.
        pub write: Option<At<String>>,
        /// Item that the step reads; its value is the result of the procedure.
        pub read: Option<At<String>>,
        /// Item whose value the step waits for.
        pub wait: Option<At<String>>,
        /// Bits that the step writes or compares; by default, all bits.
        pub mask: Option<At<u64>>,
        /// Value that the step writes or waits for.
        pub value: Option<Literal>,
        /// Procedure argument that the step writes.
        pub argument: Option<At<String>>,
        /// Maximum time in ms that the step waits for the value.
        pub timeout: Option<At<u32>>,
        /// Time in ms that the step waits.
        pub delay: Option<u32>,
        /// Message that the step sends.
        pub send: Option<At<String>>,
        /// Direction of the process data that the step exchanges once: `rx` or `tx`.
        #[cfg_attr(test, schemars(transform = schema::words("rx tx")))]
        pub exchange: Option<At<String>>,
        /// Action that a person performs.
        pub manual: Option<String>,
    }

    /// Modbus request and reply that the manual prints: node address, function code and data, with or without CRC.
    pub struct FrameTable: doc cite doubt {
        /// Bytes of the request.
        pub request: At<Vec<u8>>,
        /// Bytes of the reply.
        pub reply: At<Vec<u8>>,
        /// Codes of diagnostics that an ambiguity explains; the compiler suppresses these diagnostics.
        pub allow: Option<Vec<At<String>>>,
    }

    /// Raw value and corresponding physical value that the manual prints.
    pub struct ConversionTable: doc cite {
        /// Raw value.
        pub raw: Option<i64>,
        /// Physical value.
        pub value: Option<f64>,
        /// Unit of the physical value, if it is the machine unit instead of the unit of the item.
        pub unit: Option<At<String>>,
        /// Properties of the machine in the example: names that `[given]` defines, each with a value.
        pub given: Entries<f64>,
        /// Model whose constants the example uses.
        pub model: Option<At<String>>,
        /// Value of the item on which the scale depends.
        pub by: Option<f64>,
    }
}

// Command protocols.
#[cfg(feature = "messages")]
tables! {
    /// Delimiters and checksum of frames.
    pub struct FramingTable: doc cite doubt {
        /// First byte of a frame.
        pub start: Option<u8>,
        /// Last byte of a frame.
        pub end: Option<u8>,
        /// Byte that precedes an escaped byte.
        pub escape: Option<u8>,
        /// Value with which an escaped byte is XORed.
        pub escape_xor: u8,
        /// Bytes that are escaped in the data.
        pub escaped: Vec<u8>,
        /// Algorithm of the checksum.
        #[cfg_attr(test, schemars(transform = schema::words(schema::CHECKS)))]
        pub check: Option<At<String>>,
        /// Initial value of the checksum.
        pub seed: u32,
        /// First message field that the checksum covers. Default: the byte after `start`.
        pub check_from: Option<At<String>>,
        /// Whether the bytes of the checksum are escaped, too. Default: `true` if `escape` is present.
        pub check_escaped: Option<bool>,
        /// Maximum number of data bytes per frame, without start byte, end byte, escape bytes and checksum.
        pub max_data: Option<u16>,
        /// Request field that contains the device address.
        pub address: Option<At<String>>,
    }

    /// Request and the corresponding reply.
    pub struct MessageTable: window orig doc cite doubt allow {
        /// Name of the message.
        pub name: Option<At<String>>,
        /// Fields of the request.
        pub request: Vec<At<FieldTable>>,
        /// Fields of the reply.
        pub reply: Vec<At<FieldTable>>,
        /// Event that indicates that the device has executed the request: `immediate`, `reply`, `{ poll = "item" }` or `{ delay = 100 }`.
        pub completion: Option<At<TextOr<CompletionTable>>>,
        /// States in which the device accepts the message.
        pub accepted_in: Vec<At<String>>,
        /// Frames that the manual prints; the compiler compares these frames with the fields.
        pub examples: Vec<At<ExampleTable>>,
        /// Values that other items must have when the message is sent.
        pub when: Option<Conditions>,
        /// Approximate time in ms from the request to the reply, if the device delays the reply.
        pub reply_time: Option<u32>,
        /// Message after which the device answers with this reply, if several messages have identical requests.
        pub after: Option<At<String>>,
        /// Whether the device answers the request with this reply after power-on, until it receives a message that selects another
        /// reply.
        pub default: bool,
        /// Message that the device sends instead of the reply if it refuses the request.
        pub error: Option<At<String>>,
        /// Other effects of the message.
        pub effects: Option<Words>,
        /// Message that replaces this message.
        pub replaced_by: Option<At<String>>,
    }

    /// Request and reply that the manual prints.
    pub struct ExampleTable: doc cite doubt {
        /// Bytes of the request.
        pub request: At<Vec<u8>>,
        /// Bytes of the reply.
        pub reply: At<Vec<u8>>,
    }

    /// Event that indicates that the device has executed a request.
    pub struct CompletionTable {
        /// Item or reply field that indicates completion; the name of a bit may follow after a dot.
        pub poll: Option<At<String>>,
        /// Bits of the item that are compared with `value`.
        pub mask: Option<u64>,
        /// Value that indicates completion. Default: any value except 0.
        pub value: Option<Literal>,
        /// Whether the reply to the request already contains the polled value, which differs from `value` until the device has executed the
        /// request.
        pub in_reply: bool,
        /// Time in ms after which the device has executed the request.
        pub delay: Option<u32>,
    }

    /// Field of a message.
    pub struct FieldTable: meaning orig doc cite doubt {
        /// Number that the manual prints for the first byte of the field; the compiler compares this number with the lengths of the
        /// preceding fields.
        pub at: Option<At<u16>>,
        /// Constant bytes.
        pub bytes: Option<Vec<u8>>,
        /// Value that the named field always has; without `field`, constant bits that fill a part of a byte.
        pub fixed: Option<At<Literal>>,
        /// Name of the value in the field.
        pub field: Option<At<String>>,
        /// Data type of the field.
        #[cfg_attr(test, schemars(transform = schema::types))]
        pub ty = "type": Option<At<String>>,
        /// Byte order of the value in the frame; `A` is the most significant byte.
        pub order: Option<At<String>>,
        /// Physical value of the raw value 0.
        pub offset: Option<f64>,
        /// Name of a field: the value is the number of bytes from the named field to the end of the message data, without
        /// checksum and end byte.
        pub counts: Option<At<String>>,
        /// Request field that the reply repeats; with `part`, the reply repeats only some bytes.
        pub echo: Option<At<String>>,
        /// Bytes of the repeated field (`"1..3"`); byte 0 is the first byte on the wire.
        pub part: Option<At<NumberOrText>>,
        /// Bytes of the request that the reply repeats (`"3..5"`); byte 0 is the first data byte.
        pub copy: Option<At<NumberOrText>>,
        /// Space of the parameter whose number the field contains.
        pub code: Option<At<String>>,
        /// Space of the preceding `code` field; the field contains the value of the parameter that the `code` field names.
        pub value_of: Option<At<String>>,
        /// Space of the preceding `code` field; the field contains zero bytes in place of the parameter's value.
        pub zeros_for: Option<At<String>>,
        /// Number of bytes that have no meaning.
        pub pad: Option<u8>,
        /// Group of fields that is repeated.
        pub repeat: Option<RepeatTable>,
        /// Whether the field contains all further bytes of the message data, without checksum and end byte.
        pub rest: bool,
    }

    /// Group of fields that is repeated in a message.
    pub struct RepeatTable {
        /// Field that contains the number of repetitions. Default: the group is repeated to the end of the message data.
        pub count: Option<At<String>>,
        /// Maximum number of repetitions.
        pub max: Option<u16>,
        /// Fields of the group.
        pub fields: Vec<At<FieldTable>>,
    }
}

#[cfg(test)]
tables! {
    /// Register table, overlay or profile.
    pub struct Document {
        /// Version of the table format: 1.
        #[cfg_attr(test, schemars(extend("const" = 1)))]
        pub lexibus: Option<At<u32>>,
        /// Device that the table describes.
        pub device: Option<At<DeviceTable>>,
        /// Devices or modules that the overlay changes, and the reason for the overlay.
        pub overlay: Option<At<OverlayTable>>,
        /// Name and number of the profile, and the devices that follow it.
        pub profile: Option<At<ProfileTable>>,
        /// Manual that the table was transcribed from.
        pub manual: Option<At<ManualTable>>,
        /// Models of a family that share the table.
        pub models: Vec<At<ModelTable>>,
        /// Mailbox protocols and sync managers of an EtherCAT slave.
        pub ethercat: Option<At<EtherCatTable>>,
        /// Options for facts that the manual does not state.
        pub options: Entries<OptionTable>,
        /// Keys that apply to all rows of the file.
        pub defaults: Option<At<Row>>,
        /// Spaces, which convert a register number to an address on each bus.
        pub spaces: Entries<SpaceTable>,
        /// Chapters with the rows, in the order of the manual.
        pub chapters: Vec<At<ChapterTable>>,
        /// Definitions of units, by name of the unit.
        pub units: Entries<UnitTable>,
        /// Properties of the machine by name, such as the pitch of a screw. Conversions to machine units use these properties.
        pub given: Entries<GivenTable>,
        /// Enumerations, by name.
        pub enums: Entries<EnumTable>,
        /// Definitions of the bits and bit fields of an integer, by name of the definition.
        pub bits: Entries<BitsTable>,
        /// Rules that derive the objects of further axes from those of the first axis.
        pub axes: Option<At<AxesTable>>,
        /// Process data objects whose entries do not follow from the default values of the mapping objects.
        pub pdos: Vec<At<PdoTable>>,
        /// Process images whose layout the manual prints.
        pub images: Vec<At<ImageTable>>,
        /// Tables of codes: emergency codes, alarms, abort codes.
        pub codes: Entries<CodesTable>,
        /// State machines.
        pub machines: Entries<MachineTable>,
        /// Procedures: sequences of steps.
        pub procedures: Entries<ProcedureTable>,
        /// Numbers that are split over several items.
        pub composites: Entries<CompositeTable>,
        /// Delimiters and checksum of the frames of a command protocol.
        pub framing: Option<At<FramingTable>>,
        /// Requests and replies of a command protocol.
        pub messages: Vec<At<MessageTable>>,
        /// Modbus frames that the manual prints.
        pub frames: Vec<At<FrameTable>>,
        /// Ambiguities that belong to no row.
        pub doubts: Vec<At<DoubtTable>>,
    }
}
