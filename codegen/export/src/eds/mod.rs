//! EDS and DCF files (CiA 306): any device that has objects, written so that reading it again gives the same objects.
//!
//! What was read from an EDS comes out as it was understood: repairs are made, values have the spelling of the standard,
//! sections its order; extension attributes and comments stand in the section where they stood. Of a device of another
//! format, the file has what CiA 306 has a place for, and [`Export::notes`] says what it doesn't.
//!
//! | file | subject |
//! |---|---|
//! | `writer` | sections, entries, comments; texts that must not break a line |
//! | `extras` | which extension attribute goes into which section |
//! | `header` | `[FileInfo]`, `[DeviceInfo]` and the other sections about the whole |
//! | `file_info` | what a header of another format has to be for `[FileInfo]` |
//! | `object`, `compact` | objects; those of equal elements as CompactSubObj |
//! | `data_type`, `value` | types as numbers, values as texts |
//! | `modules` | modular devices |
//! | `mapping` | mapping objects of PDOs that the dictionary doesn't have |
//! | `losses` | facts that CiA 306 has no place for |

mod compact;
mod data_type;
mod extras;
mod file_info;
mod header;
mod losses;
mod mapping;
mod modules;
mod object;
mod section;
mod value;
mod writer;

pub use super::note::{Export, Note, NoteKind};

use std::collections::HashSet;

use super::note::{self, Subject};
use super::registers;
use extras::Extras;
use lexibus_codegen::ir::{Binding, Catalog, Device, Format, Group, Item};
use writer::Writer;

/// Which of the two files of CiA 306 is written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Flavour {
    /// An electronic data sheet: what all devices of the type have in common. Nothing that configures one device.
    #[default]
    Eds,
    /// A device configuration file: also the node-ID, the network, configured values, denotations, and the modules that
    /// are plugged in.
    Dcf,
}

/// How REAL32 and REAL64 values are written. CiA 306 names no form, and tools differ in what they read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Reals {
    /// Decimal numbers, as in real files and for Python's `canopen`.
    #[default]
    Decimal,
    /// The bits of IEEE 754 in hexadecimal, for the tools of lely.
    Pattern,
}

/// What is written, and how.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// Which file.
    pub flavour: Flavour,
    /// The form of real numbers.
    pub reals: Reals,
}

impl From<Flavour> for Options {
    fn from(flavour: Flavour) -> Self {
        Options { flavour, ..Options::default() }
    }
}

/// The file of `device`, which is one of `catalog`, with the line ends of CiA 306 (CR LF): ASCII where the device's texts are,
/// else to be written as UTF-8. `None` where the device has no objects.
pub fn export(catalog: &Catalog, device: &Device, options: impl Into<Options>) -> Option<Export> {
    let Options { flavour, reals } = options.into();
    let registers = registers::objects(device, Item::object);
    let completed = registers::completed(&registers);
    let made = [mapping::objects(device), registers].concat();
    let objects = objects(device, &made);
    if objects.is_empty() && device.canopen.is_none() {
        return None;
    }
    let format = catalog.files.first().map(|file| file.format);
    let context = Context {
        device,
        flavour,
        reals,
        file_name: catalog.files.first().map_or("", |file| &file.name),
        is_verbatim: matches!(format, Some(Format::Eds | Format::Dcf)),
        is_canopen: device.canopen.is_some(),
    };
    let mut writer = Writer::new(context.is_verbatim);
    losses::of_device(&context, catalog, &mut writer.notes);
    writer.notes.add_many(NoteKind::Completed, completed, Subject::Device);
    let extras = Extras::new(&context, &mut writer.notes);
    for comment in &extras.preamble {
        writer.comment(&comment.value);
    }
    let mut seen = HashSet::new();
    let objects: Vec<&Group> =
        objects.into_iter().filter(|group| first_of_index(group, &mut seen, &mut writer)).collect();
    for section in extras.order() {
        header::write(&mut writer, &context, catalog, section, extras.of(section), &objects);
    }
    object::all(
        &mut writer,
        &context,
        objects.iter().filter(|group| group.index().is_some_and(|index| index < 0x1000)),
    );
    modules::write(&mut writer, &context, catalog);
    extras.write_unknown(&mut writer);
    let (text, notes) = writer.finish();
    Some(Export { text, notes })
}

/// What every part of the file is written from.
struct Context<'a> {
    device: &'a Device,
    flavour: Flavour,
    reals: Reals,
    /// The name of the file that was read.
    file_name: &'a str,
    /// Whether the source was a file of CiA 306: then what it leaves out stays left out, and what it spells stays so.
    is_verbatim: bool,
    /// Whether the source describes a CANopen device.
    is_canopen: bool,
}

/// Whether the device is on CANopen, and this object on EtherCAT only.
fn is_coe_only(device: &Device, group: &Group) -> bool {
    let is_coe = |binding: &Binding| matches!(binding, Binding::Object { buses, .. } if !buses.canopen);
    let mut items = group.items.iter();
    device.canopen.is_some() && !group.items.is_empty() && items.all(|item| item.bindings.iter().any(is_coe))
}

/// The objects that the file describes: those of the device without what CompactPDO says already and what only EtherCAT has, and
/// those `made` of something else; sorted by index.
fn objects<'a>(device: &'a Device, made: &'a [Group]) -> Vec<&'a Group> {
    let compact_pdos = device.canopen.as_ref().is_some_and(|canopen| canopen.compact_pdo != 0);
    let is_implied =
        |group: &Group| compact_pdos && group.origin.line == 0 && matches!(group.index(), Some(0x1400..=0x1BFF));
    let own = device.groups.iter().filter(|group| group.index().is_some() && !is_implied(group));
    let own = own.filter(|group| !is_coe_only(device, group));
    let mut objects: Vec<&Group> = own.chain(made).collect();
    objects.sort_by_key(|group| group.index());
    objects
}

/// Whether no object of this index was there before.
fn first_of_index(group: &Group, seen: &mut HashSet<Option<u16>>, writer: &mut Writer) -> bool {
    let is_first = seen.insert(group.index());
    if !is_first {
        writer.notes.add(NoteKind::Duplicate, Subject::object(group));
    }
    is_first
}
