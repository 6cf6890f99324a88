//! The whole image: the configuration area, the categories, and the unused rest of the EEPROM.

use lexibus_codegen::ir::{Device, Direction, Eeprom, EtherCatSettings, Pdo};

use super::options::{EepromSize, TrackedOptions};
use super::texts::Texts;
use super::{area, clocks, general, process_data, Context};
use super::{Note, NoteKind, Options, Refusal};
use crate::note::{Notes, Subject};
use crate::options::MissingFacts;

/// Default size of an EEPROM in bytes.
const DEFAULT_SIZE: usize = 2048;

/// Maximum length of the content in bytes. Masters use 16-bit word addresses, and the length of a category is a 16-bit
/// number of words.
const MAX_CONTENT: usize = 0x2_0000;

/// Category type that marks the end of the list of categories.
const END: [u8; 2] = [UNUSED; 2];
/// Value of unused bytes.
const UNUSED: u8 = 0xFF;

/// The content of an EEPROM, and notes on the export.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    /// The content of the EEPROM.
    pub bytes: Vec<u8>,
    /// Notes of the export: one for each kind that occurred, sorted by kind.
    pub notes: Vec<Note>,
}

/// Amount of information about PDOs in an image.
#[derive(Clone, Copy, PartialEq)]
enum Detail {
    Complete,
    WithoutEntryNames,
    WithoutPdos,
}

/// Exports the content of a device's EEPROM.
///
/// If the content is too long for the EEPROM, leaves out the names of PDO entries. If the content is still too long, leaves
/// out the PDOs of a device with CoE. A master can read them from the object dictionary.
///
/// # Errors
///
/// Returns an error if the source lacks a required fact or the EtherCAT settings, or describes only a dictionary. Also
/// returns an error if the shortest possible content is too long for the EEPROM.
pub fn export(device: &Device, options: &Options) -> Result<Image, Refusal> {
    let settings = device.ethercat.as_deref().filter(|_| !device.dictionary_only).ok_or(Refusal::Nothing)?;
    let options = &TrackedOptions::new(options);
    match settings.eeprom.as_deref().filter(|eeprom| !eeprom.data.is_empty()) {
        Some(eeprom) => Ok(declared(eeprom, options)),
        None => composed(device, settings, options),
    }
}

/// Returns the EEPROM content that the description declares, unchanged.
fn declared(eeprom: &Eeprom, options: &TrackedOptions<'_>) -> Image {
    let mut notes = Notes::default();
    notes.add_many(NoteKind::Checksum, !area::is_checked(&eeprom.data), Subject::Named("Data"));
    options.note_unused(&mut notes);
    Image { bytes: eeprom.data.clone(), notes: notes.finish() }
}

/// Returns the content with as many details of the PDOs as fit into the EEPROM. If even the shortest content is too
/// long, returns the error for the complete content.
fn composed(device: &Device, settings: &EtherCatSettings, options: &TrackedOptions<'_>) -> Result<Image, Refusal> {
    let complete = with_detail(device, settings, options, Detail::Complete);
    let Err(Refusal::TooLong { .. }) = complete else { return complete };
    let has_coe = settings.mailbox.as_ref().is_some_and(|mailbox| mailbox.coe.is_some());
    let fewer = [Some(Detail::WithoutEntryNames), has_coe.then_some(Detail::WithoutPdos)];
    let mut shorter = fewer.into_iter().flatten().map(|detail| with_detail(device, settings, options, detail));
    shorter.find(Result::is_ok).unwrap_or(complete)
}

fn with_detail(
    device: &Device,
    settings: &EtherCatSettings,
    options: &TrackedOptions<'_>,
    detail: Detail,
) -> Result<Image, Refusal> {
    let mut context = Context { device, settings, options, notes: Notes::default(), texts: Texts::default() };
    let mut missing = MissingFacts::new(Options::KEYS);
    let area = area::content(&mut context, &mut missing);
    missing.check()?;
    let categories = categories(&mut context, detail);
    let needed = area::LENGTH + categories.len();
    let size = size(&mut context, needed);
    let limit = size.map_or(MAX_CONTENT, EepromSize::bytes).min(MAX_CONTENT);
    let Some(size) = size.filter(|_| needed <= limit) else {
        return Err(Refusal::TooLong { needed, size: limit });
    };
    let mut bytes = area.with_size(size).to_vec();
    bytes.extend(categories);
    bytes.resize(size.bytes(), UNUSED);
    options.note_unused(&mut context.notes);
    Ok(Image { bytes, notes: context.notes.finish() })
}

/// Returns the size of the EEPROM from the options, or from the description if the options contain none. If neither contains
/// a valid size, returns the smallest power of two into which the content fits, but at least the default size. Returns
/// `None` if this power of two is too large for an EEPROM.
fn size(context: &mut Context<'_>, needed: usize) -> Option<EepromSize> {
    let declared = context.settings.eeprom.as_ref().and_then(|eeprom| eeprom.byte_size);
    let known = context.options.eeprom_size().or(declared.and_then(EepromSize::new));
    known.or_else(|| {
        context.notes.add(NoteKind::EepromSize, Subject::Named("ByteSize"));
        let bytes = needed.max(DEFAULT_SIZE).next_power_of_two();
        u32::try_from(bytes).ok().and_then(EepromSize::new)
    })
}

/// Returns the categories and the end marker.
fn categories(context: &mut Context<'_>, detail: Detail) -> Vec<u8> {
    let general = general::content(context);
    let fmmus = process_data::fmmus(context);
    let sync_managers = process_data::sync_managers(context);
    let [tx_pdos, rx_pdos] = [Direction::Transmit, Direction::Receive].map(|direction| match detail {
        Detail::Complete | Detail::WithoutEntryNames => {
            process_data::pdos(context, direction, detail == Detail::Complete)
        }
        Detail::WithoutPdos => Vec::new(),
    });
    let clocks = clocks::content(context);
    note_left_out(context, detail);
    let mut bytes = Vec::new();
    category(&mut bytes, 10, &context.texts.content());
    category(&mut bytes, 30, &general);
    for (number, content) in [(40, fmmus), (41, sync_managers), (50, tx_pdos), (51, rx_pdos), (60, clocks)] {
        if !content.is_empty() {
            category(&mut bytes, number, &content);
        }
    }
    for (number, content) in context.settings.eeprom.iter().flat_map(|eeprom| &eeprom.categories) {
        category(&mut bytes, *number, content);
    }
    bytes.extend(END);
    bytes
}

fn note_left_out(context: &mut Context<'_>, detail: Detail) {
    let named = |pdo: &Pdo| pdo.entries.iter().filter(|entry| !entry.name.is_empty()).count();
    let (kind, count): (_, usize) = match detail {
        Detail::Complete => return,
        Detail::WithoutEntryNames => (NoteKind::EntryNames, context.pdos().map(named).sum()),
        Detail::WithoutPdos => (NoteKind::PdosLeftOut, context.pdos().count()),
    };
    let first = context.pdos().next().map_or(Subject::Device, |pdo| Subject::Object(pdo.mapping_index));
    context.notes.add_many(kind, count, first);
}

/// Appends a category: its number, its length in words, and its content, padded with zeros to whole words.
fn category(bytes: &mut Vec<u8>, number: u16, content: &[u8]) {
    let words = content.len().div_ceil(2);
    bytes.extend(number.to_le_bytes());
    bytes.extend((words as u16).to_le_bytes());
    bytes.extend(content);
    bytes.resize(bytes.len() + 2 * words - content.len(), 0);
}
