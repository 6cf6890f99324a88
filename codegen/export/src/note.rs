//! Notes on facts that an export leaves out or changes.

use std::collections::BTreeMap;
use std::fmt;

use lexibus_codegen::facts::doubts;
use lexibus_codegen::ir::{Catalog, Device, Group, Item};
use lexibus_codegen::number;

/// An exported file with its notes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Export {
    /// The text of the file.
    pub text: String,
    /// Notes on facts that were left out or changed: one note for each kind, sorted by kind.
    pub notes: Vec<Note>,
}

/// All facts of one kind that an export left out or changed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Note {
    /// The kind of the facts.
    pub kind: NoteKind,
    /// Number of facts of this kind.
    pub count: usize,
    /// The location of the first fact: an object, an entry, a named element or the device.
    pub first: String,
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} × {} (first: {})", self.count, self.kind.text(), self.first)
    }
}

macro_rules! kinds {
    ($($(#[doc = $doc:literal])* $kind:ident = $name:literal, $text:literal;)+) => {
        /// A kind of fact that the output format cannot express, or expresses in a different form.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[non_exhaustive]
        pub enum NoteKind {
            $($(#[doc = $doc])* #[doc = ""] #[doc = concat!("Note: ", $text, ".")] $kind,)+
        }

        impl NoteKind {
            /// All kinds of notes.
            pub const ALL: &'static [NoteKind] = &[$(NoteKind::$kind,)+];

            /// Returns the stable name that programs use for the kind.
            pub fn name(self) -> &'static str {
                match self {
                    $(NoteKind::$kind => $name,)+
                }
            }

            /// Returns a text that describes the fact and what the export does with it.
            pub fn text(self) -> &'static str {
                match self {
                    $(NoteKind::$kind => $text,)+
                }
            }
        }
    };
}

kinds! {
    GivenFact = "given-fact", "value of an option left out: the file has no field for it";
    /// A fact of a configured device, such as ParameterValue or Denotation, if the output format is not DCF.
    Configuration = "configuration", "configured value left out: only a DCF has a field for it";
    /// A unit or scale, including sentinel values, a step and further units.
    Quantity = "unit", "unit or scale left out";
    Enumeration = "enumeration", "enumeration written as its integer type";
    BitField = "bit-field", "bit field written as its integer type";
    Structure = "structure", "array or record in a single entry written as raw bytes";
    Widened = "widened-type", "integer written with the next wider type of the format";
    /// A type that the format does not support, or that the source does not define.
    UnknownType = "unknown-type", "unsupported type written as raw bytes";
    Length = "text-length", "maximum length of a string left out";
    AllowedValues = "allowed-values", "list of allowed values reduced to its minimum and maximum";
    Limits = "limits", "default or limits of a value in cyclic data left out";
    SwappedLimits = "swapped-limits", "limits left out: the minimum is above the maximum";
    Value = "value", "value left out: its type cannot hold it";
    RoundedLimit = "rounded-limit", "fractional minimum or maximum of an integer rounded";
    /// A formula that subtracts a number from `$NODEID`.
    NegativeFormula = "negative-formula", "formula with a negative number written, although CiA 306 does not define it";
    Mapping = "pdo-mapping", "direction of PDO mapping written as access type rwr or rww";
    LostMapping = "lost-mapping", "direction of PDO mapping left out: no access type expresses it";
    Pdo = "pdo", "PDO, or its communication parameters, left out: no object of the file describes it";
    /// Storage behavior, side effects or conditions of an item, or conditions of a named value.
    Behavior = "behavior", "storage, conditions or side effects left out";
    /// The models, versions or options in which an item or a named value exists.
    Availability = "availability", "models, versions or options of an item left out";
    /// A reference from an item to another item that has the same value or a part of the value. Also the property that
    /// an item is reserved or optional.
    Relation = "relation", "relation to other items, or property reserved or optional, left out";
    Documentation = "documentation", "description left out";
    Language = "language", "text in another language left out";
    Name = "name", "name of an object's only entry left out: the file contains only the name of the object";
    Doubt = "doubt", "ambiguity in the manual left out";
    /// The category of an object: mandatory, optional or conditional.
    Category = "category", "category of an object left out";
    Binding = "binding", "address on another bus left out";
    CoeOnly = "coe-only", "EtherCAT-only object left out";
    NotAnObject = "not-an-object", "item outside of the object dictionary left out";
    Completed = "completed", "sub-index 0 added to an object that consists of registers";
    Duplicate = "duplicate", "object or entry left out: another one has the same address";
    Extension = "extension", "extension attribute left out: the format has no field for it";
    /// A module of another bus, or its submodules or fixed objects.
    Module = "module", "module of another bus left out";
    Slot = "slot", "slot, or class or name of a module that a slot accepts, left out";
    OtherBus = "other-bus", "settings of another bus left out";
    Axis = "axis", "additional axis left out: the file contains only the objects of the first axis";
    OtherPart = "other-part", "message, code table, state machine, procedure, variant or submodule left out";
    /// A setting of the device or of one of its objects for which the format has no field.
    Setting = "setting", "setting left out: the format has no field for it";
    FileInfo = "file-info", "file date, time, version or comment converted or left out";
    LineBreak = "line-break", "line break in a text written as a space";
    NotAscii = "not-ascii", "line with characters other than ASCII: the file is encoded in UTF-8";
    LongLine = "long-line", "line longer than 255 characters";
    Constant = "constant", "constant written as a read-only value";
    ValueRange = "value-range", "range of values of an enumeration written as its first value";
    Renamed = "renamed", "repeated name replaced by a unique name";
    UnknownLength = "unknown-length", "type of unknown length written with a length of 0";
    CanObject = "can-object", "CANopen-only object, or object for CAN services (COB-ID, SYNC, heartbeat), left out";
    EmptyObject = "empty-object", "object without entries left out";
    /// A fact that the format accepts only together with other facts that are missing.
    Incomplete = "incomplete", "facts left out: the format requires further facts that are missing";
    Spelling = "spelling", "word or number left out: the schema does not allow its notation";
    OtherVendor = "other-vendor", "device or module of another vendor left out: a file contains only one vendor";
    Control = "control-character", "control character removed from a text";
    MissingText = "missing-text", "missing text of an element replaced by its name";
    Layout = "layout", "overlapping or unaligned field of cyclic data written as octets or bits";
    NotInData = "not-in-data", "item outside of the cyclic data left out";
    ByteOrder = "byte-order", "little-endian number written as octets: the bus is big-endian";
    Character = "character", "text with characters outside of ISO 8859-1, which become question marks";
    LongText = "long-text", "text shortened to 255 bytes";
    TextCount = "text-count", "text left out: an image contains at most 255 texts";
    SplitEntry = "split-entry", "PDO entry longer than 255 bits written as several entries";
    PdoEntries = "pdo-entries", "PDO left out: it has more than 255 entries";
    EntryNames = "entry-names", "name of a PDO entry left out: the EEPROM is too small";
    PdosLeftOut = "pdos-left-out", "PDO left out: the EEPROM is too small, and a master can read the PDO with CoE";
    EepromSize = "eeprom-size", "EEPROM size missing or invalid; the next larger power of two is used";
    /// Bytes of ConfigData or BootStrap for which the EEPROM has no field.
    ConfigData = "config-data", "bytes after the configuration of the slave controller or mailbox left out";
    Checksum = "checksum", "checksum of the configuration area in the description is wrong";
}

/// Collects the notes of an export.
#[derive(Default)]
pub(super) struct Notes(BTreeMap<NoteKind, (usize, String)>);

impl Notes {
    pub(super) fn add(&mut self, kind: NoteKind, subject: Subject<'_>) {
        self.add_many(kind, true, subject);
    }

    /// Adds a fact of each kind.
    pub(super) fn add_all(&mut self, kinds: impl IntoIterator<Item = NoteKind>, subject: Subject<'_>) {
        kinds.into_iter().for_each(|kind| self.add(kind, subject));
    }

    /// Adds `count` facts. As a count, `true` means one fact and `false` means none.
    pub(super) fn add_many(&mut self, kind: NoteKind, count: impl Into<usize>, subject: Subject<'_>) {
        let count = count.into();
        if count > 0 {
            self.0.entry(kind).or_insert_with(|| (0, subject.to_string())).0 += count;
        }
    }

    pub(super) fn finish(self) -> Vec<Note> {
        self.0.into_iter().map(|(kind, (count, first))| Note { kind, count, first }).collect()
    }
}

/// Adds notes on the facts of an item that only register tables and overlays can express.
pub(super) fn of_item(item: &Item, notes: &mut Notes, subject: Subject<'_>) {
    notes.add_many(NoteKind::Availability, usize::from(item.availability.is_some()) + item.variants.len(), subject);
    notes.add_many(NoteKind::Relation, relations(item), subject);
    notes.add_many(NoteKind::Doubt, item.doubts.len(), subject);
}

/// Adds notes on the further axes of a device, and on its ambiguities.
pub(super) fn of_device(catalog: &Catalog, device: &Device, notes: &mut Notes, subject: Subject<'_>) {
    let axes = device.axes.as_ref().map_or(0, |rule| usize::from(rule.axes.saturating_sub(1)));
    notes.add_many(NoteKind::Axis, axes, subject);
    notes.add_many(NoteKind::Doubt, doubts::of_device(catalog, device).len(), subject);
}

/// Adds notes on the items in chapters of a device that are not objects.
pub(super) fn of_chapters(device: &Device, notes: &mut Notes) {
    for group in device.groups.iter().filter(|group| group.index().is_none()) {
        let others = group.items.iter().filter(|item| item.object().is_none()).count();
        notes.add_many(NoteKind::NotAnObject, others, Subject::Named(&group.name));
    }
}

/// Returns the number of facts of an item that belong to the kind [`NoteKind::Relation`].
pub(crate) fn relations(item: &Item) -> usize {
    let related = item.related.iter().flat_map(|related| related.all()).next();
    usize::from(related.is_some()) + usize::from(item.is_reserved) + usize::from(item.is_optional)
}

/// Returns the number of elements of a device that only a register table can express.
pub(super) fn parts_of_tables(device: &Device) -> usize {
    let parts = [
        device.messages.len(),
        device.machines.len(),
        device.procedures.len(),
        device.composites.len(),
        device.variants.len(),
        usize::from(device.framing.is_some()),
    ];
    parts.iter().sum()
}

/// The object, entry, named element or device to which a note applies.
#[derive(Clone, Copy)]
pub(super) enum Subject<'a> {
    Device,
    Object(u16),
    Entry(u16, u8),
    Named(&'a str),
}

impl Subject<'_> {
    /// Returns the object of a group, or the device if the group is not an object.
    pub(super) fn object(group: &Group) -> Self {
        group.index().map_or(Subject::Device, Subject::Object)
    }

    pub(super) fn item(item: &Item) -> Subject<'_> {
        item.object().map_or(Subject::Named(&item.name), |(index, sub)| Subject::Entry(index, sub))
    }
}

impl fmt::Display for Subject<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Subject::Device => f.write_str("the device"),
            Subject::Object(index) => f.write_str(&number::hex16(*index)),
            Subject::Entry(index, sub) => f.write_str(&number::object(*index, *sub)),
            // Replace control characters in names, because a note must fit on one line.
            Subject::Named(name) => name.chars().try_for_each(|letter| {
                let letter = if letter.is_control() { ' ' } else { letter };
                write!(f, "{letter}")
            }),
        }
    }
}
