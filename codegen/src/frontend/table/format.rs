//! The register table format. `dictionaries/README.md` explains the keys to authors of tables; editors show the doc comments.

use std::fmt;

use super::at::{At, Entries, FlagOr, Literal, OneOrMany, TextOr};
use super::read::{self, Mistake, Node, Read};
#[cfg(test)]
use super::schema;
use super::tree::cited;

/// The key of a field: its name, or the text after `=`.
macro_rules! key {
    ($field:ident) => {
        stringify!($field)
    };
    ($field:ident $key:literal) => {
        $key
    };
}

/// Tables of the format, with what reads them: every key may be absent, and there are no others. A field whose name can't be that of its
/// key has the key behind `=`. Keys that many tables have are named after the table.
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
    /// Pages or lines as one text.
    fn cited(&self) -> Option<String>;
}

/// Tables with doubts.
pub(super) trait Doubted: Cited {
    fn doubt_tables(&self) -> [Option<&OneOrMany<DoubtTable>>; 2];
}

/// What a table has in words, by its groups of keys.
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

/// One table: adds the keys that many tables have, one group after the other.
macro_rules! table {
    ({ meaning $($group:ident)* } $attributes:tt $name:ident { $($fields:tt)* }) => {
        table! { { $($group)* } $attributes $name {
            $($fields)*
            /// What the bits mean: a name of `[bits]`, or the bits themselves.
            #[cfg_attr(test, schemars(transform = schema::keys(schema::BITS)))]
            pub bits: Option<At<TextOr<BitEntries>>>,
            /// What the values mean: a name of `[enums]`, or the values themselves.
            #[cfg_attr(test, schemars(transform = schema::keys(schema::VALUES)))]
            pub values = "enum": Option<At<TextOr<ValueEntries>>>,
            /// A symbol, or a name of `[units]`.
            pub unit: Option<At<String>>,
            /// physical = raw × scale + offset, in units of `unit`; or how the factor is found.
            pub scale: Option<At<Scaling>>,
            /// The smallest value, raw.
            pub min: Option<At<Literal>>,
            /// The greatest value, raw.
            pub max: Option<At<Literal>>,
            /// Raw values that are no numbers, with their meaning.
            pub na: Option<Entries<String>>,
            /// Numbers that the manual converts as an example; each is held against the scale.
            pub conversions: Vec<At<ConversionTable>>,
        } }
    };
    ({ window $($group:ident)* } $attributes:tt $name:ident { $($fields:tt)* }) => {
        table! { { $($group)* } $attributes $name {
            $($fields)*
            /// Models that have it; `*` stands for any letters.
            pub models: Option<Vec<At<String>>>,
            /// First firmware that has it.
            pub since: Option<String>,
            /// First firmware that doesn't have it any more.
            pub until: Option<String>,
        } }
    };
    ({ orig $($group:ident)* } $attributes:tt $name:ident { $($fields:tt)* }) => {
        table! { { $($group)* } $attributes $name {
            $($fields)*
            /// Its name or label in the manual's language.
            pub orig: Option<String>,
        } }
    };
    ({ doc $($group:ident)* } $attributes:tt $name:ident { $($fields:tt)* }) => {
        table! { { $($group)* } $attributes $name {
            $($fields)*
            /// What it is, in your own words.
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
            /// A contradiction of the manual, and what was made of it.
            pub doubt: Option<OneOrMany<DoubtTable>>,
            /// Several contradictions.
            pub doubts: Option<OneOrMany<DoubtTable>>,
        } }
    };
    ({ allow $($group:ident)* } $attributes:tt $name:ident { $($fields:tt)* }) => {
        table! { { $($group)* } $attributes $name {
            $($fields)*
            /// Findings that the doubt explains.
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

/// The values that a condition names, and the bits that it compares.
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

/// Values of other items that have to be there, by the items' names.
pub type Conditions = Entries<ConditionValues>;

/// The row of a field of an image or a message: what it has in common with rows.
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

/// A text that may be a list.
pub type Words = OneOrMany<String>;

/// Bits by their place: a name, what is said of them, or several meanings.
pub type BitEntries = Entries<OneOrMany<TextOr<BitTable>>>;

/// Values by their number: a name, or what is said of them.
pub type ValueEntries = Entries<TextOr<ValueTable>>;

/// A number or a text.
#[derive(Clone, Debug)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(untagged))]
pub enum NumberOrText {
    /// A number.
    Number(i64),
    /// A text.
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

/// `true`, `false` or a text.
#[derive(Clone, Debug)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(untagged))]
pub enum FlagOrText {
    /// A truth value.
    Flag(bool),
    /// A text.
    Text(String),
}

/// A number, or how the number is found.
#[derive(Clone, Debug)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(untagged))]
pub enum Scaling {
    /// physical = raw × factor.
    Factor(f64),
    /// Anything else.
    Rule(Box<ScaleRule>),
}

tables! {
    /// How a raw number becomes a physical one.
    pub struct ScaleRule {
        /// Physical units per count.
        pub factor: Option<f64>,
        /// The physical value of raw 0.
        pub offset: Option<f64>,
        /// The item whose value divides.
        pub by: Option<At<String>>,
        /// The item whose value multiplies.
        pub times: Option<At<String>>,
        /// physical = this / raw.
        pub reciprocal: Option<f64>,
        /// Number of fractional bits.
        pub fraction: Option<u8>,
        /// The constant of the model that a fraction is one of.
        pub of: Option<At<String>>,
        /// The item that holds the exponent.
        pub exponent: Option<At<String>>,
        /// What is raised to it: 10 where nothing else is said, or 2.
        pub base: Option<u8>,
    }

    /// A contradiction of the source, and what was made of it.
    pub struct DoubtTable {
        /// What is printed, both sides.
        pub says: String,
        /// What was chosen.
        pub chose: String,
        /// Why.
        pub why: String,
        /// Where it is printed.
        pub cite: Option<OneOrMany<NumberOrText>>,
        /// What a wrong choice leads to.
        #[cfg_attr(test, schemars(transform = schema::words(&["hazard", "value", "print"])))]
        pub severity: Option<At<String>>,
    }

    /// What a master has to know of an EtherCAT slave beside its objects and PDOs.
    pub struct EtherCatTable: cite doubt {
        /// CAN application protocol over EtherCAT, and what it can.
        pub coe: Option<FlagOr<CoeTable>>,
        /// ADS over EtherCAT.
        pub aoe: bool,
        /// Ethernet over EtherCAT.
        pub eoe: bool,
        /// File access over EtherCAT.
        pub foe: bool,
        /// Servo profile over EtherCAT.
        pub soe: bool,
        /// A protocol of the vendor's over EtherCAT.
        pub voe: bool,
        /// Its sync managers.
        pub sync_managers: Vec<At<SyncManagerTable>>,
    }

    /// What the CAN application protocol of a slave can.
    pub struct CoeTable: cite {
        /// It tells of its objects.
        pub sdo_info: bool,
        /// The assignment of PDOs may be written (0x1C12, 0x1C13).
        pub pdo_assign: bool,
        /// The mapping of PDOs may be written.
        pub pdo_config: bool,
        /// A master reads the assignment from the device.
        pub pdo_upload: bool,
        /// All sub-indices may be transferred at once.
        pub complete_access: bool,
        /// Values may be transferred in segments.
        pub segmented_sdo: bool,
    }

    /// A sync manager.
    pub struct SyncManagerTable: cite doubt {
        /// Its number.
        pub number: Option<u8>,
        /// `mailbox_out`, `mailbox_in`, `outputs` or `inputs`, seen from the master.
        #[cfg_attr(test, schemars(transform = schema::words(schema::PURPOSES)))]
        pub purpose: Option<At<String>>,
        /// Its first address in the memory of the slave controller.
        pub start: Option<u16>,
        /// Its length in bytes by default.
        pub size: Option<u16>,
        /// Its least length.
        pub min: Option<u16>,
        /// Its greatest length.
        pub max: Option<u16>,
        /// Its control byte.
        pub control: Option<u8>,
    }

    /// The device that a table describes.
    pub struct DeviceTable: orig doc cite doubt {
        /// Name of the device; types of Rust are named after it.
        pub name: Option<At<String>>,
        /// Name of the vendor.
        pub vendor: Option<String>,
        /// Number of the vendor (CiA, ETG).
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
        /// Numbers of device profiles that it follows.
        pub profiles: Vec<u32>,
        /// The numbers that a node, or server, may have (`"1..90"`).
        #[cfg_attr(test, schemars(transform = schema::place("#(\\.\\.=?#)?")))]
        pub node_ids: Option<At<NumberOrText>>,
        /// CANopen bit rates in kbit/s.
        pub bit_rates: Vec<u16>,
        /// Number of RPDOs.
        pub rx_pdos: Option<u16>,
        /// Number of TPDOs.
        pub tx_pdos: Option<u16>,
        /// Granularity of PDO mapping in bits.
        pub granularity: Option<u8>,
        /// Whether it supports layer setting services.
        pub lss: bool,
    }

    /// The manual that a table was transcribed from.
    pub struct ManualTable: doc {
        /// Its title.
        pub title: Option<String>,
        /// Its edition: number or date.
        pub edition: Option<String>,
        /// Its language (BCP 47).
        pub language: Option<String>,
        /// What `cite` counts: `page` or `line`.
        #[cfg_attr(test, schemars(transform = schema::words(&["page", "line"])))]
        pub cites: Option<At<String>>,
        /// Titles of its sections and tables, by the first page or line of each.
        pub sections: Entries<String>,
    }

    /// What an overlay applies to.
    pub struct OverlayTable: doc {
        /// The devices that it is for.
        pub applies = "for": Option<AppliesTable>,
        /// Why it is needed.
        pub why: Option<String>,
    }

    /// The devices that an overlay is for; what isn't given fits any.
    pub struct AppliesTable {
        /// Number of the vendor.
        pub vendor_id: Option<u32>,
        /// Product code.
        pub product_code: Option<u32>,
        /// Revision number.
        pub revision: Option<u32>,
        /// Name or order code; `*` stands for any letters.
        pub device: Option<String>,
        /// The overlay is for modules (of GSDML also submodules) of this name, identifier or ident number instead.
        pub module: Option<String>,
    }

    /// What a profile applies to.
    pub struct ProfileTable: doc {
        /// Name of the profile.
        pub name: Option<String>,
        /// Number of the device profile.
        pub number: Option<u32>,
        /// The object that shows that a device follows it.
        pub when: Option<At<NumberOrText>>,
        /// The number of the API of submodules that follow it (PROFINET).
        pub api: Option<u32>,
        /// The only buses on which devices follow it.
        pub buses: Option<Vec<At<String>>>,
        /// What is added to indices from 0x6000 to 0x67FF for each further axis.
        pub axis_index: Option<u16>,
    }

    /// A model, or a version of the firmware.
    pub struct ModelTable: orig doc cite doubt {
        /// Its name.
        pub name: Option<At<String>>,
        /// Product code.
        pub product_code: Option<u32>,
        /// Revision number.
        pub revision: Option<u32>,
        /// Order code.
        pub order_code: Option<String>,
        /// Constants of the model, such as the base of fractions.
        pub constants: Entries<Literal>,
    }

    /// What the manual leaves open.
    pub struct OptionTable: doc cite doubt {
        /// The choices, and the value that each puts in place of `$name`.
        pub choices: Entries<Literal>,
        /// The choice where nobody chooses.
        pub default: Option<At<String>>,
    }

    /// What the number of a register means on each bus.
    pub struct SpaceTable: doc {
        /// Number of bits that one number holds: 16 where nothing else is said, 1 of coils and discrete inputs.
        pub bits: Option<u8>,
        /// Whether a shorter value fills all bits of its numbers: with copies of its sign, or zeros where it has none.
        pub extend: bool,
        /// Where its registers are on Modbus.
        pub modbus: Option<ModbusRule>,
        /// Which objects its registers are on CANopen.
        pub canopen: Option<ObjectRule>,
        /// Which objects its registers are on EtherCAT (CoE).
        pub ethercat: Option<ObjectRule>,
        /// The number is that of a parameter in a command protocol; a table names the messages that carry it.
        pub parameter: Option<FlagOr<ParameterMessages>>,
        /// The number is an address of an EtherCAT slave controller.
        pub esc: bool,
        /// The value is reached through a window, or several: on other buses, or one to read and one to write.
        pub indirect: Option<OneOrMany<IndirectRule>>,
    }

    /// The messages that carry the parameters of a space.
    pub struct ParameterMessages {
        /// The message that reads a value.
        pub read: Option<At<String>>,
        /// The message that writes it.
        pub write: Option<At<String>>,
        /// The message that keeps values over power-off.
        pub store: Option<At<String>>,
        /// Order of the bytes of a value of 32 bits, the most significant being `A`.
        pub order: Option<At<String>>,
    }

    /// Where the registers of a space are on Modbus.
    pub struct ModbusRule {
        /// `holding`, `input`, `coil` or `discrete`.
        #[cfg_attr(test, schemars(transform = schema::words(&["holding", "input", "coil", "discrete"])))]
        pub table: Option<At<String>>,
        /// The number that the manual's table counts from.
        pub first: Option<i64>,
        /// What is added to get the address on the wire.
        pub add: Option<i64>,
        /// `high_first` or `low_first`: which word of a longer value comes first.
        #[cfg_attr(test, schemars(transform = schema::words(&["high_first", "low_first"])))]
        pub order: Option<At<String>>,
        /// Whether `order` is an assumption, because the manual gives no order for rows without one.
        pub order_assumed: bool,
        /// What the manual prints before each number: `R` for `R01`.
        pub prefix: Option<String>,
        /// The minimum number of digits that the manual prints: 2 for `R01`.
        pub digits: Option<u8>,
        /// Whether the bytes of a word are swapped.
        pub swap: bool,
        /// Numbers of the functions that the device takes (`[3, 6, 16]`).
        pub functions: Option<At<Vec<u8>>>,
        /// The greatest number of registers, or bits, that one request reads.
        pub max_read: Option<At<u16>>,
        /// The greatest number that one request writes.
        pub max_write: Option<At<u16>>,
        /// Whether a value that is longer than that may be read and written in several requests, one after the other.
        pub split: Option<bool>,
    }

    /// Which object a register is.
    pub struct ObjectRule {
        /// What is added to the register's number.
        pub index: Option<At<i64>>,
        /// The sub-index.
        pub sub: Option<At<u8>>,
    }

    /// How a value is reached through other items.
    pub struct IndirectRule {
        /// The buses on which it is; all of those of its items where nothing is said.
        #[cfg_attr(test, schemars(transform = schema::words(schema::BUSES)))]
        pub buses: Option<Vec<At<String>>>,
        /// The numbers that it takes: `"0x8000..0x8FFF"`; all where nothing is said.
        pub numbers: Option<At<String>>,
        /// What is added to the number of a row.
        pub add: Option<i64>,
        /// The item that takes the number.
        pub write_address: Option<At<String>>,
        /// The item through which the value is read, or how.
        pub read: Option<At<TextOr<WindowTable>>>,
        /// The item through which the value is written, or how.
        pub write: Option<At<TextOr<WindowTable>>>,
        /// Whether the device sets the number to 0 once it is done; where nothing is said, the row of the item tells it.
        pub clears: Option<bool>,
        /// How many milliseconds the device needs, where it doesn't.
        pub wait: Option<u32>,
        /// After how many milliseconds the device has set the number to 0.
        pub timeout: Option<u32>,
        /// The procedure that says in which order.
        pub procedure: Option<At<String>>,
    }

    /// One way through a window.
    pub struct WindowTable {
        /// The item that takes the number, where it isn't `write_address`.
        pub address: Option<At<String>>,
        /// The item that has, or takes, the value.
        pub value: Option<At<String>>,
        /// What is written first: `address` or `value`.
        #[cfg_attr(test, schemars(transform = schema::words(&["address", "value"])))]
        pub first: Option<At<String>>,
        /// Whether the device sets the number to 0 once it is done.
        pub clears: Option<bool>,
        /// How many milliseconds the device needs, where it doesn't.
        pub wait: Option<u32>,
        /// After how many milliseconds the device has set the number to 0.
        pub timeout: Option<u32>,
        /// The procedure that says in which order.
        pub procedure: Option<At<String>>,
    }

    /// Rows that belong together.
    pub struct ChapterTable: orig doc cite doubt {
        /// Its title.
        pub title: Option<String>,
        /// The space of the rows' numbers.
        pub space: Option<At<String>>,
        /// What rows have that don't say otherwise.
        pub defaults: Option<At<Row>>,
        /// Rows by name.
        pub registers: Entries<Row>,
        /// Rows by object (`0x6040`, `"0x1018:1"`, `"0x1400..0x1403:1"`).
        #[cfg_attr(test, schemars(transform = schema::keys(schema::OBJECTS)))]
        pub objects: Entries<Row>,
    }

    /// One item of the device.
    pub struct Row: meaning window orig doc cite doubt allow {
        /// Number of the register, or numbers (`"63-64"`).
        #[cfg_attr(test, schemars(transform = schema::place("#( *[-–] *#)?")))]
        pub reg: Option<At<NumberOrText>>,
        /// Object and sub-index (`"0x2000:1"`).
        #[cfg_attr(test, schemars(transform = schema::place("#(:#)?")))]
        pub obj: Option<At<NumberOrText>>,
        /// Address in the memory of an EtherCAT slave controller.
        pub esc: Option<At<u16>>,
        /// What the slave itself may do with that memory, where the manual says: `ro`, `rw` or `wo`.
        #[cfg_attr(test, schemars(transform = schema::words(&["ro", "rw", "wo"])))]
        pub pdi: Option<At<String>>,
        /// Length there, in bytes; of any other row what the manual prints, which is compared with the type.
        pub length: Option<At<u16>>,
        /// Name in an ASCII protocol.
        pub ascii: Option<String>,
        /// Number of a parameter.
        pub param: Option<At<u32>>,
        /// The name of an object or sub-entry.
        pub name: Option<At<String>>,
        /// `var`, `array`, `record` or `domain`.
        #[cfg_attr(test, schemars(transform = schema::words(&["var", "array", "record", "domain"])))]
        pub code: Option<At<String>>,
        /// `u16`, `i32`, `f32`, `bool`, `str(25)`, `bytes(6)`, `u16[10]`, …; `?` where the manual doesn't say.
        #[cfg_attr(test, schemars(transform = schema::types))]
        pub ty = "type": Option<At<String>>,
        /// `ro`, `rw`, `wo`, `const`, `rwr` or `rww`; `?` if the manual does not state it.
        #[cfg_attr(test, schemars(transform = schema::words(&["ro", "rw", "wo", "const", "rwr", "rww", "?"])))]
        pub access: Option<At<String>>,
        /// `rx`, `tx`, `both` or `no`.
        #[cfg_attr(test, schemars(transform = schema::words(&["rx", "tx", "both", "no"])))]
        pub pdo: Option<At<String>>,
        /// The value before anybody wrote it; a list where the row stands for several objects.
        pub default: Option<At<OneOrMany<Literal>>>,
        /// The only value.
        pub fixed: Option<At<Literal>>,
        /// The only values, and ranges of them (`"3..7"`).
        pub allowed: Option<At<Vec<Literal>>>,
        /// The physical value of raw 0.
        pub offset: Option<f64>,
        /// The device rounds to steps of so many counts.
        pub step: Option<At<Literal>>,
        /// What differs between models or buses.
        pub variants: Option<Vec<At<VariantTable>>>,
        /// Kept over power-off: at once, not at all, or by this command.
        pub save: Option<FlagOrText>,
        /// When a write takes effect, where not at once.
        pub effective: Option<String>,
        /// Writing is allowed while these items have one of these values.
        pub when: Option<Conditions>,
        /// The only values that may be written, and ranges of them (`"3..7"`).
        pub writable: Option<At<Vec<Literal>>>,
        /// The device clears it by itself.
        pub clears: Option<bool>,
        /// It can be written once.
        pub once: Option<bool>,
        /// What else writing does.
        pub effects: Option<Words>,
        /// What replaces it from then on.
        pub replaced_by: Option<At<String>>,
        /// Options that have to be fitted.
        pub needs: Option<Words>,
        /// The only buses on which it exists.
        #[cfg_attr(test, schemars(transform = schema::words(schema::BUSES)))]
        pub buses: Option<Vec<At<String>>>,
        /// Whether each axis has its own.
        pub per_axis: Option<bool>,
        /// The item that holds the upper half of the same number, of which this is the lower one.
        pub upper: Option<At<String>>,
        /// The item that is the same quantity in another scale; the defaults are compared.
        pub same_quantity: Option<At<String>>,
        /// Another name of the same value.
        pub same_as: Option<At<String>>,
        /// Meant for the vendor or a tool.
        pub hidden: Option<bool>,
        /// So many of the same, or the item that holds how many are valid.
        pub count: Option<At<NumberOrText>>,
        /// The number of rows, where an item holds how many are valid.
        pub max_count: Option<u32>,
        /// How many numbers lie between two of them.
        pub stride: Option<u32>,
        /// The bits of the register that the row is about (`"7-0"`).
        #[cfg_attr(test, schemars(transform = schema::place(schema::BITS)))]
        pub part: Option<At<NumberOrText>>,
        /// `high_first` or `low_first`.
        #[cfg_attr(test, schemars(transform = schema::words(&["high_first", "low_first"])))]
        pub order: Option<At<String>>,
        /// Whether the bytes of a word are swapped.
        pub swap: Option<bool>,
        /// The sub-index exists and means nothing.
        pub reserved: Option<bool>,
        /// It exists only at times.
        pub optional: Option<bool>,
        /// Where `doc` comes from, unless from the manual: `CiA 402, 17.3.7`, or `name` if it spells out the printed name.
        pub doc_from: Option<At<String>>,
        /// What another place of the manual says of it; it is compared.
        pub summary: Option<At<OneOrMany<SummaryTable>>>,
        /// In an overlay: why the row is needed.
        pub why: Option<String>,
        /// In an overlay: the object doesn't exist yet.
        pub add: Option<bool>,
        /// In an overlay: the object is taken away.
        pub remove: Option<bool>,
    }

    /// What differs on some models or buses; what isn't given is as the row says.
    pub struct VariantTable: doc cite {
        /// The models; `*` stands for any letters.
        pub models: Option<Vec<At<String>>>,
        /// The buses.
        #[cfg_attr(test, schemars(transform = schema::words(schema::BUSES)))]
        pub buses: Option<Vec<At<String>>>,
        /// The type of the value there, on buses where it has another width.
        #[cfg_attr(test, schemars(transform = schema::types))]
        pub ty = "type": Option<At<String>>,
        /// What may be done there, on buses that allow less.
        #[cfg_attr(test, schemars(transform = schema::words(&["ro", "rw", "wo"])))]
        pub access: Option<At<String>>,
        /// The only values, and ranges of them.
        pub allowed: Option<At<Vec<Literal>>>,
        /// The value before anybody wrote it.
        pub default: Option<At<Literal>>,
        /// The smallest value, raw.
        pub min: Option<At<Literal>>,
        /// The greatest value, raw.
        pub max: Option<At<Literal>>,
        /// The device rounds to steps of so many counts.
        pub step: Option<At<Literal>>,
        /// physical = raw × scale; or how the factor is found.
        pub scale: Option<At<Scaling>>,
    }

    /// The value of another item, or of some of its bits.
    pub struct ConditionTable {
        /// The bits that are compared.
        pub mask: Option<u64>,
        /// The value that they have; a list where there are several.
        pub value: Option<OneOrMany<Literal>>,
    }

    /// What another place of the manual says of a row: an overview, a table of contents, the prose.
    pub struct SummaryTable: cite {
        /// The type that it says.
        #[cfg_attr(test, schemars(transform = schema::types))]
        pub ty = "type": Option<At<String>>,
        /// The access that it says.
        pub access: Option<At<String>>,
        /// The direction of PDOs that it says.
        pub pdo: Option<At<String>>,
        /// The object code that it says.
        #[cfg_attr(test, schemars(transform = schema::words(&["var", "array", "record", "domain"])))]
        pub code: Option<At<String>>,
        /// The name that it says.
        pub name: Option<At<String>>,
        /// Number of sub-indices, with sub-index 0.
        pub subs: Option<At<u32>>,
        /// Length in bytes.
        pub length: Option<At<u32>>,
        /// The least value that it says.
        pub min: Option<At<Literal>>,
        /// The greatest value that it says.
        pub max: Option<At<Literal>>,
        /// The default that it says.
        pub default: Option<At<Literal>>,
    }

    /// A unit with a scale.
    pub struct UnitTable: doc {
        /// The physical unit.
        pub symbol: Option<String>,
        /// physical = raw × scale + offset.
        pub scale: Option<At<Scaling>>,
        /// The physical value of raw 0.
        pub offset: Option<f64>,
        /// What the physical number is in a unit of the machine.
        pub machine: Option<MachineUnitTable>,
        /// How the manual writes it.
        pub orig: Option<String>,
    }

    /// A unit of the machine: the physical number, multiplied and divided by numbers of `[given]`.
    pub struct MachineUnitTable {
        /// Its symbol.
        pub unit: Option<At<String>>,
        /// The numbers that multiply.
        pub times: Vec<At<String>>,
        /// The numbers that divide.
        pub over: Vec<At<String>>,
    }

    /// A number that only whoever builds the machine knows.
    pub struct GivenTable: doc cite doubt {
        /// Symbol of its unit.
        pub unit: Option<At<String>>,
        /// What it is on models that know it.
        pub models: Entries<Literal>,
    }

    /// Named values of an integer.
    pub struct EnumTable: orig doc cite doubt allow {
        /// The integer, where rows don't tell.
        #[cfg_attr(test, schemars(transform = schema::types))]
        pub base: Option<At<String>>,
        /// Whether a device never has a value that isn't listed.
        pub closed: bool,
        /// The values, and ranges of values (`"3..7"`).
        #[cfg_attr(test, schemars(transform = schema::keys(schema::VALUES)))]
        pub values: ValueEntries,
    }

    /// A named value.
    pub struct ValueTable: window orig doc cite doubt {
        /// A short English phrase; the identifier is made of it.
        pub name: Option<String>,
        /// `reserved` or `vendor`.
        #[cfg_attr(test, schemars(transform = schema::words(&["reserved", "vendor"])))]
        pub zone: Option<At<String>>,
        /// The only buses on which it exists.
        #[cfg_attr(test, schemars(transform = schema::words(schema::BUSES)))]
        pub buses: Option<Vec<At<String>>>,
        /// It exists while this item has one of these values.
        pub when: Option<Conditions>,
        /// What replaces it from then on, in words.
        pub replaced_by: Option<String>,
    }

    /// Named bits of an integer.
    pub struct BitsTable: orig doc cite doubt allow {
        /// The integer, where rows don't tell.
        #[cfg_attr(test, schemars(transform = schema::types))]
        pub base: Option<At<String>>,
        /// The address of the byte with bits 0 to 7, where the manual counts the bits of each byte (`"0x221:3-2"`).
        pub address: Option<u32>,
        /// The bits, and ranges of bits (`"3-2"`); a list where other items decide what they mean.
        #[cfg_attr(test, schemars(transform = schema::keys(schema::BITS_OF_BYTES)))]
        pub at: BitEntries,
    }

    /// Bits with a meaning.
    pub struct BitTable: window orig doc cite doubt {
        /// A short English phrase; the identifier is made of it.
        pub name: Option<String>,
        /// The meaning holds while the bit is 0.
        pub inverted: bool,
        /// The bits are a number.
        pub number: bool,
        /// What the values of the bits mean.
        #[cfg_attr(test, schemars(transform = schema::keys(schema::VALUES)))]
        pub values: Option<ValueEntries>,
        /// The same, as a name of `[enums]`.
        pub enumeration = "enum": Option<At<String>>,
        /// The bits mean nothing: a writer puts 0, 1, or `keep`s what was read.
        pub reserved: Option<NumberOrText>,
        /// `rising`, `falling`, `toggle` or `self_clearing`.
        #[cfg_attr(test, schemars(transform = schema::words(schema::TRIGGERS)))]
        pub trigger: Option<At<String>>,
        /// The bits mean this while this item has one of these values.
        pub when: Option<Conditions>,
        /// `ro`, `rw` or `wo`, where it isn't as the row says.
        #[cfg_attr(test, schemars(transform = schema::words(&["ro", "rw", "wo", "const", "rwr", "rww"])))]
        pub access: Option<At<String>>,
        /// What replaces it from then on, in words.
        pub replaced_by: Option<String>,
    }

    /// How the objects of further axes follow from those of the first.
    pub struct AxesTable: doc cite doubt {
        /// Number of axes.
        pub count: u8,
        /// The models that have so many; `*` stands for any letters.
        pub models: Option<Vec<At<String>>>,
        /// The first rule that contains an object holds.
        pub rules: Vec<At<AxisRuleTable>>,
    }

    /// How to get to the object of the next axis.
    pub struct AxisRuleTable {
        /// The objects (`"0x6000..0x67FF"`).
        #[cfg_attr(test, schemars(transform = schema::place("#(\\.\\.=?#)?")))]
        pub objects: Option<At<NumberOrText>>,
        /// What is added to the index.
        pub index: Option<u16>,
        /// `axis`: the sub-index is the number of the axis.
        #[cfg_attr(test, schemars(transform = schema::words(&["axis"])))]
        pub sub: Option<String>,
        /// What is added to the sub-index.
        pub sub_stride: Option<u8>,
    }

    /// A process data object.
    pub struct PdoTable: doc cite doubt allow {
        /// Index of its mapping object.
        pub index: Option<At<u16>>,
        /// Its name.
        pub name: Option<String>,
        /// `rx` or `tx`, seen from the device.
        #[cfg_attr(test, schemars(transform = schema::words(&["rx", "tx"])))]
        pub direction: Option<At<String>>,
        /// `"0x6040:0/16"`, `"item"`, `"pad/8"`, or `"? name/16"` (`"? name/i16"`, if signed) where the manual gives no object.
        pub entries: Vec<At<String>>,
        /// Its length in bytes as the manual prints it; a list where several places do. It is compared with the entries.
        pub length: Option<At<OneOrMany<u32>>>,
        /// Its greatest length in bytes, where its mapping can be changed.
        pub max: Option<u16>,
        /// Whether its entries can't be changed.
        pub fixed: bool,
        /// Whether it has to be assigned.
        pub mandatory: bool,
        /// Number of the sync manager to which it is assigned by default.
        pub sm: Option<At<u8>>,
        /// Whether it is assigned by default.
        pub default: bool,
        /// PDOs that can't be assigned beside it (`0x1702`, `"0x1600..0x1603"`).
        pub excludes: Vec<NumberOrText>,
        /// The only buses on which it carries this: `canopen`, `ethercat`.
        #[cfg_attr(test, schemars(transform = schema::words(schema::BUSES)))]
        pub buses: Option<Vec<At<String>>>,
    }

    /// A fixed process image.
    pub struct ImageTable: doc cite doubt {
        /// Its name.
        pub name: Option<String>,
        /// `rx` or `tx`, seen from the device.
        #[cfg_attr(test, schemars(transform = schema::words(&["rx", "tx"])))]
        pub direction: Option<At<String>>,
        /// Its length in bytes.
        pub bytes: Option<u32>,
        /// `big` (where nothing else is said) or `little`.
        #[cfg_attr(test, schemars(transform = schema::words(&["big", "little"])))]
        pub order: Option<At<String>>,
        /// Its fields, by the name of the item; what is no item of the table gets a `type`.
        pub fields: Entries<ImageField>,
    }

    /// A field of a process image; its key is the item.
    pub struct ImageField: meaning orig doc cite doubt {
        /// First byte.
        pub at: Option<u32>,
        /// First bit in that byte.
        pub bit: Option<u8>,
        /// Its type, where it isn't that of the item.
        #[cfg_attr(test, schemars(transform = schema::types))]
        pub ty = "type": Option<At<String>>,
    }

    /// A table of codes.
    pub struct CodesTable: doc cite {
        /// Names of the columns beside code and meaning.
        pub columns: Vec<String>,
        /// What the manual prints before each number: `F` for `F125`.
        pub prefix: Option<String>,
        /// Whether no two codes have the same cells.
        pub distinct: bool,
        /// Findings that a doubt explains.
        pub allow: Option<Vec<At<String>>>,
        /// The only buses on which the codes mean this.
        #[cfg_attr(test, schemars(transform = schema::words(schema::BUSES)))]
        pub buses: Option<Vec<At<String>>>,
        /// The codes, and ranges of codes.
        #[cfg_attr(test, schemars(transform = schema::keys(schema::VALUES)))]
        pub rows: Entries<TextOr<CodeTableRow>>,
    }

    /// A code.
    pub struct CodeTableRow: window orig doc cite doubt {
        /// Its name.
        pub name: Option<String>,
        /// The other columns.
        pub cells: Vec<At<Literal>>,
    }

    /// A state machine.
    pub struct MachineTable: doc cite doubt {
        /// The item that tells the state.
        pub status: Option<At<String>>,
        /// The item that commands it.
        pub control: Option<At<String>>,
        /// States, by the bits of `status`; or the name of an enumeration whose values they are.
        pub states: Option<At<TextOr<Entries<PatternTable>>>>,
        /// The state after power-on.
        pub initial: Option<At<String>>,
        /// Commands, by the bits of `control`.
        pub commands: Entries<PatternTable>,
        /// From which state to which.
        pub transitions: Vec<At<TransitionTable>>,
        /// What each command does in each state.
        pub matrix: Option<At<MatrixTable>>,
    }

    /// What commands do in each state.
    pub struct MatrixTable: doc cite doubt {
        /// The states of the columns.
        pub states: Vec<At<String>>,
        /// The notes that cells refer to.
        pub notes: Entries<String>,
        /// The rows: messages or commands, each with a cell for every state.
        pub rows: Entries<MatrixRow>,
    }

    /// What a command does in each state.
    pub struct MatrixRow: doc cite doubt {
        /// The messages or commands that the row is about, where its name is none; empty where nothing else describes it.
        pub commands: Option<Vec<At<String>>>,
        /// For each state `same`, `refused`, `?`, or the state that follows (`"a > b"` where `b` follows `a` by itself);
        /// several of these with `or` between them.
        pub cells: Vec<At<TextOr<MatrixCell>>>,
        /// Models that have it; `*` stands for any letters.
        pub models: Option<Vec<At<String>>>,
        /// First firmware that has it.
        pub since: Option<String>,
    }

    /// A cell with more than an outcome.
    pub struct MatrixCell: cite {
        /// What happens, as in a cell without more.
        pub to: Option<At<String>>,
        /// A note of the table.
        pub note: Option<At<NumberOrText>>,
        /// On what it depends, in your own words.
        pub doc: Option<String>,
    }

    /// Bits that have to have a value.
    pub struct PatternTable: orig doc cite {
        /// The bits that count.
        pub mask: Option<u32>,
        /// The value that they have.
        pub value: Option<u32>,
    }

    /// From one state to another.
    pub struct TransitionTable: doc cite {
        /// Its number in the manual.
        pub number: Option<u16>,
        /// The state that it leaves, or states; any where there is none.
        pub from: Option<At<OneOrMany<String>>>,
        /// The state that it leads to.
        pub to: Option<At<String>>,
        /// The command or the message that causes it; none where the device does.
        pub command: Option<At<String>>,
    }

    /// A sequence of steps.
    pub struct ProcedureTable: orig doc cite doubt allow {
        /// What its caller gives: names that steps write with `argument`.
        pub arguments: Vec<At<String>>,
        /// The steps, in order.
        pub steps: Vec<At<StepTable>>,
    }

    /// One number in several items.
    pub struct CompositeTable: orig doc cite doubt {
        /// The items of its digits, the most significant one first.
        pub parts: Vec<At<String>>,
        /// What one digit is worth of the next; each is below it.
        pub base: Option<u16>,
        /// The item that has the sign.
        pub sign: Option<At<String>>,
        /// Its value below zero; otherwise it is 0.
        pub negative: Option<u16>,
        /// The unit of the number.
        pub unit: Option<String>,
    }

    /// A step.
    pub struct StepTable: doc {
        /// The item that `value` or `argument` is written to.
        pub write: Option<At<String>>,
        /// The item that is read: its value is what the procedure gives.
        pub read: Option<At<String>>,
        /// The item that is waited for.
        pub wait: Option<At<String>>,
        /// The only bits that are written, or waited for.
        pub mask: Option<At<u64>>,
        /// The value that is written or waited for.
        pub value: Option<Literal>,
        /// The argument of the procedure that is written.
        pub argument: Option<At<String>>,
        /// How many milliseconds the wait takes at most.
        pub timeout: Option<At<u32>>,
        /// Milliseconds.
        pub delay: Option<u32>,
        /// The message that is sent.
        pub send: Option<At<String>>,
        /// `rx` or `tx`: process data are exchanged once.
        #[cfg_attr(test, schemars(transform = schema::words(&["rx", "tx"])))]
        pub exchange: Option<At<String>>,
        /// What a person has to do.
        pub manual: Option<String>,
    }

    /// A frame of Modbus that the manual prints: node, function and data, with or without the CRC.
    pub struct FrameTable: doc cite doubt {
        /// The bytes of the request.
        pub request: At<Vec<u8>>,
        /// The bytes of the reply.
        pub reply: At<Vec<u8>>,
        /// Findings that the doubts take upon themselves.
        pub allow: Option<Vec<At<String>>>,
    }

    /// A number that the manual converts as an example.
    pub struct ConversionTable: doc cite {
        /// The raw number.
        pub raw: Option<i64>,
        /// The physical one.
        pub value: Option<f64>,
        /// Its unit, where that is the machine's.
        pub unit: Option<At<String>>,
        /// Numbers of `[given]`, as the example has them.
        pub given: Entries<f64>,
        /// The model whose constants the example uses.
        pub model: Option<At<String>>,
        /// The value of the item that the scale depends on.
        pub by: Option<f64>,
    }
}

// Command protocols.
#[cfg(feature = "messages")]
tables! {
    /// How frames are delimited and checked.
    pub struct FramingTable: doc cite doubt {
        /// The byte that begins a frame.
        pub start: Option<u8>,
        /// The byte that ends it.
        pub end: Option<u8>,
        /// The byte in front of one that is escaped.
        pub escape: Option<u8>,
        /// What an escaped byte is combined with by exclusive or.
        pub escape_xor: u8,
        /// The bytes that are escaped.
        pub escaped: Vec<u8>,
        /// How the check is made.
        #[cfg_attr(test, schemars(transform = schema::words(schema::CHECKS)))]
        pub check: Option<At<String>>,
        /// What the check begins with.
        pub seed: u32,
        /// The field of the messages from which on the check counts; else from the byte behind `start`.
        pub check_from: Option<At<String>>,
        /// Whether the check is escaped, too.
        pub check_escaped: Option<bool>,
        /// The greatest number of data bytes in a frame, without start, end, escapes and check.
        pub max_data: Option<u16>,
        /// The field of requests with the number of the device for which they are.
        pub address: Option<At<String>>,
    }

    /// A request and its reply.
    pub struct MessageTable: window orig doc cite doubt allow {
        /// Its name.
        pub name: Option<At<String>>,
        /// What is sent.
        pub request: Vec<At<FieldTable>>,
        /// What comes back.
        pub reply: Vec<At<FieldTable>>,
        /// `immediate`, `reply`, `{ poll = "item" }` or `{ delay = 100 }`.
        pub completion: Option<At<TextOr<CompletionTable>>>,
        /// The states in which the device takes it.
        pub accepted_in: Vec<At<String>>,
        /// Frames that the manual prints, byte for byte; they are held against the fields.
        pub examples: Vec<At<ExampleTable>>,
        /// Items that have to have one of these values.
        pub when: Option<Conditions>,
        /// About how many milliseconds a reply takes that comes late.
        pub reply_time: Option<u32>,
        /// The reply has this form after that message.
        pub after: Option<At<String>>,
        /// The reply has this form after power-on, too.
        pub default: bool,
        /// The message that comes where the device refuses.
        pub error: Option<At<String>>,
        /// What else it does.
        pub effects: Option<Words>,
        /// What replaces it from then on.
        pub replaced_by: Option<At<String>>,
    }

    /// A request and its reply as the manual prints them.
    pub struct ExampleTable: doc cite doubt {
        /// The bytes of the request.
        pub request: At<Vec<u8>>,
        /// The bytes of the reply.
        pub reply: At<Vec<u8>>,
    }

    /// When an order is carried out.
    pub struct CompletionTable {
        /// When this item, or field of replies, says so; a bit stands behind a dot.
        pub poll: Option<At<String>>,
        /// The bits that count.
        pub mask: Option<u64>,
        /// The value that tells it; any but 0 where there is none.
        pub value: Option<Literal>,
        /// The reply tells it already: as long as the order isn't carried out, it has another value for certain.
        pub in_reply: bool,
        /// After so many milliseconds.
        pub delay: Option<u32>,
    }

    /// A field of a message.
    pub struct FieldTable: meaning orig doc cite doubt {
        /// The number that the manual gives to its first byte; numbers have to count on from field to field.
        pub at: Option<At<u16>>,
        /// Fixed bytes.
        pub bytes: Option<Vec<u8>>,
        /// The only value: of a `field`, or else of bits, as many as the `type` has, that fill no whole bytes.
        pub fixed: Option<At<Literal>>,
        /// Name of a value.
        pub field: Option<At<String>>,
        /// Its type.
        #[cfg_attr(test, schemars(transform = schema::types))]
        pub ty = "type": Option<At<String>>,
        /// Order of its bytes, the most significant being `A`.
        pub order: Option<At<String>>,
        /// The physical value of raw 0.
        pub offset: Option<f64>,
        /// It is the number of bytes from this field of the frame to its end.
        pub counts: Option<At<String>>,
        /// A copy of this field of the request; of some of its bytes with `part`.
        pub echo: Option<At<String>>,
        /// The bytes of the field that come back (`"1..3"`), the first on the wire being 0.
        pub part: Option<At<NumberOrText>>,
        /// Bytes of the request (`"3..5"`), whatever they mean there, the first of its data being 0.
        pub copy: Option<At<NumberOrText>>,
        /// The code of an item in this space, of this `type`.
        pub code: Option<At<String>>,
        /// The value of the item whose code stands in front, in this space.
        pub value_of: Option<At<String>>,
        /// As many zeros as the value has of the item whose code stands in front, in this space.
        pub zeros_for: Option<At<String>>,
        /// So many bytes without meaning.
        pub pad: Option<u8>,
        /// Fields that occur several times.
        pub repeat: Option<RepeatTable>,
        /// All bytes that follow.
        pub rest: bool,
    }

    /// Fields that occur several times.
    pub struct RepeatTable {
        /// The field that holds how often; up to the end where there is none.
        pub count: Option<At<String>>,
        /// How often at most.
        pub max: Option<u16>,
        /// The fields.
        pub fields: Vec<At<FieldTable>>,
    }
}

#[cfg(test)]
tables! {
    /// A register table, an overlay or a profile.
    pub struct Document {
        /// Version of the format: 1.
        #[cfg_attr(test, schemars(extend("const" = 1)))]
        pub lexibus: Option<At<u32>>,
        /// The device that the table describes.
        pub device: Option<At<DeviceTable>>,
        /// What the overlay applies to, and why.
        pub overlay: Option<At<OverlayTable>>,
        /// What the profile applies to.
        pub profile: Option<At<ProfileTable>>,
        /// The manual that it was transcribed from.
        pub manual: Option<At<ManualTable>>,
        /// Models of a family that share the table.
        pub models: Vec<At<ModelTable>>,
        /// Mailbox and sync managers of an EtherCAT slave.
        pub ethercat: Option<At<EtherCatTable>>,
        /// What the manual leaves open.
        pub options: Entries<OptionTable>,
        /// What rows have that don't say otherwise.
        pub defaults: Option<At<Row>>,
        /// What the number of a register means on each bus.
        pub spaces: Entries<SpaceTable>,
        /// Rows, in the order of the manual.
        pub chapters: Vec<At<ChapterTable>>,
        /// Units with a scale, by name.
        pub units: Entries<UnitTable>,
        /// Numbers that only whoever builds the machine knows, such as the pitch of a screw.
        pub given: Entries<GivenTable>,
        /// Named values.
        pub enums: Entries<EnumTable>,
        /// Named bits.
        pub bits: Entries<BitsTable>,
        /// How the objects of further axes follow from those of the first.
        pub axes: Option<At<AxesTable>>,
        /// Process data objects that don't follow from the defaults of mapping objects.
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
        /// Frames of Modbus that the manual prints.
        pub frames: Vec<At<FrameTable>>,
        /// Contradictions that belong to no row.
        pub doubts: Vec<At<DoubtTable>>,
    }
}
