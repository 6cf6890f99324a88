//! PDO structs with their fields, the code that packs and unpacks them, and the writes that configure the PDO in the
//! device.

use super::literal;
use crate::collections::{HashMap, HashSet};
use crate::number::{self, hex, hex16, hex8};

use super::code::{call, list, seq, Break, Data, Doc};
use super::context::Context;
use super::doc_table;
use super::docs::{self, WORDS};
use super::field_type::{field_type, FieldType};
use super::links::DocModule;
use super::method_names::{method_allow, unused_name};
use super::naming;
use super::naming::pdos::{is_field, is_generated, NamedField, NamedPdo};
use super::options::RustOptions;
use super::reachable::addressable;
use super::scope::ObjectBus;
use super::slot_dependency::depends_on;
use crate::facts::cob_id::has_identifier as contains_identifier;
use crate::ir::{Group, ObjectBuses, Pdo, PdoCommunication, PdoEntry, PdoEntryKind, Value};
use crate::names;
use crate::source::Span;
use crate::text::count_of;

/// Maximum length of a field's name in an expression that packs the field. The limit keeps the generated line short.
const MAX_FIELD_NAME: usize = 30;

/// Number of bits in a word, that is, in a `u64`.
const WORD: u32 = 64;

/// A PDO, ready to be printed.
pub(super) struct PdoModel {
    pub name: String,
    pub docs: Vec<String>,
    /// Documentation of the view.
    pub view_docs: Vec<String>,
    pub derives: Vec<String>,
    pub mapping_index: u16,
    /// Line number of the PDO's declaration in the source.
    line: u32,
    declared: Span,
    pub bits: u32,
    pub length: usize,
    /// `const ` if packing and unpacking can be `const fn` in the minimum supported Rust version of the runtime.
    /// Otherwise empty.
    pub constant: &'static str,
    pub fields: Vec<FieldModel>,
    pub mapping: Vec<Doc>,
    pub word: bool,
    /// Mask of those bits in the first 64 bits that unpacking and packing preserve.
    pub covered: String,
    pub cob_id: Option<String>,
    pub configuration: Vec<String>,
    /// True if the default COB-ID contains a CAN identifier.
    pub has_identifier: bool,
    /// True if the struct implements the wire traits of `ethercrab`.
    pub is_on_ethercat: bool,
}

/// A field of a PDO.
pub(super) struct FieldModel {
    pub name: String,
    /// Object of the field, for the documentation table.
    object: String,
    /// Type of the field, for the documentation table.
    type_link: String,
    /// Name of the view's method that reads the field.
    pub getter: String,
    /// Name of the view's method that writes the field.
    pub setter: String,
    pub docs: Vec<String>,
    /// Attribute that the field needs for derived traits.
    pub attribute: Option<String>,
    pub ty: String,
    kind: FieldType,
    /// Mask of the field's bits. `None` if no mask is necessary, because the Rust type has no bits beyond the field's
    /// width, or its conversions clear these bits.
    cut: Option<String>,
    pub offset: u32,
    pub bits: u32,
    /// True if the field is longer than a word. Such a long field is copied as bytes, and the unused bits of the last
    /// byte are 0.
    pub long: bool,
}

/// Returns the models of all PDOs that become structs.
pub(super) fn models(context: &Context<'_>, options: &RustOptions) -> Vec<PdoModel> {
    let generated = context.names.pdos.iter().filter(|named| is_generated(named.pdo));
    generated.map(|named| model(context, named, options)).collect()
}

fn model(context: &Context<'_>, named: &NamedPdo<'_>, options: &RustOptions) -> PdoModel {
    let pdo = named.pdo;
    let fields = fields(context, &named.fields, options);
    let is_constant = !fields.iter().any(|field| matches!(field.kind, FieldType::Real(_)));
    let word = pdo.bits() <= WORD;
    PdoModel {
        docs: documentation(context, pdo, &fields),
        view_docs: view_docs(context, pdo, &named.name),
        name: named.name.clone(),
        derives: options.derives(true),
        mapping_index: pdo.mapping_index,
        line: pdo.origin.line,
        declared: pdo.origin.span,
        bits: pdo.bits(),
        length: pdo.bytes(),
        constant: if is_constant && word { "const " } else { "" },
        covered: covered(&fields),
        fields,
        mapping: pdo.entries.iter().map(mapping_line).collect(),
        word,
        cob_id: cob_id(pdo),
        configuration: configuration(context, pdo),
        has_identifier: has_identifier(pdo),
        is_on_ethercat: context.is_on_ethercat(pdo),
    }
}

/// Returns the documentation of a PDO.
fn documentation(context: &Context<'_>, pdo: &Pdo, fields: &[FieldModel]) -> Vec<String> {
    let mut facts = vec![format!("Mapping object {}, {} bits", hex16(pdo.mapping_index), pdo.bits())];
    if let Some(communication) = &pdo.communication {
        facts.extend(communication.cob_id.as_ref().map(|value| format!("COB-ID {}", identifier(value))));
        facts.extend(communication.transmission_type.map(|ty| format!("transmission type {ty}")));
    }
    let mut sentences = vec![title(context, pdo), docs::sentence(&facts.join(", "))];
    sentences.extend(docs::described(pdo.documentation.as_deref(), &context.manual));
    sentences.extend(pdo.doubts.iter().map(|doubt| WORDS.doubt(&context.manual, doubt)));
    docs::paragraphs(sentences).into_iter().chain(table(pdo, fields)).collect()
}

/// Returns the COB-ID of a PDO in the usual notation.
fn identifier(value: &Value) -> String {
    match value {
        Value::Int(number @ 0..) => hex(*number),
        Value::NodeId(offset @ 0..) => format!("{} + node-ID", hex(*offset)),
        other => docs::value(other),
    }
}

/// Returns the documentation of a PDO's view.
fn view_docs(context: &Context<'_>, pdo: &Pdo, name: &str) -> Vec<String> {
    vec![title(context, pdo), String::new(), format!("The view has the fields of [`pdo::{name}`](super::pdo::{name}).")]
}

/// Names of the struct's methods. A field may have the same name as a method, and a link to the field would then lead
/// to the method.
const METHODS: [&str; 4] = ["pack", "unpack", "configuration", "configuration_as"];

/// Returns the lines of the documentation table that lists the entries of a PDO.
fn table(pdo: &Pdo, fields: &[FieldModel]) -> Vec<String> {
    let mut fields = fields.iter();
    let row = |entry: &PdoEntry| {
        let bytes = span(entry);
        match is_field(entry).then(|| fields.next()).flatten() {
            Some(field) => {
                [bytes, doc_table::field_link(&field.name, &METHODS), field.object.clone(), field.type_link.clone()]
            }
            None => [bytes, "padding".to_owned(), String::new(), String::new()],
        }
    };
    let rows: Vec<[String; 4]> = pdo.entries.iter().filter(|entry| entry.bits > 0).map(row).collect();
    doc_table::table(["Bytes", "Field", "Object", "Type"], &rows)
}

/// Returns the byte numbers of an entry. If the entry does not fill its bytes, the first and last bits are included.
fn span(entry: &PdoEntry) -> String {
    let last = entry.bit_offset.saturating_add(entry.bits) - 1;
    let position = |bit: u32, whole: bool| match whole {
        true => (bit / 8).to_string(),
        false => format!("{}.{}", bit / 8, bit % 8),
    };
    let whole = entry.bit_offset.is_multiple_of(8) && entry.bits.is_multiple_of(8);
    let (first, last) = (position(entry.bit_offset, whole), position(last, whole));
    if first == last {
        first
    } else {
        format!("{first}–{last}")
    }
}

/// Returns a sentence with the title of the PDO.
pub(super) fn title(context: &Context<'_>, pdo: &Pdo) -> String {
    let buses = match context.bus_of(pdo) {
        ObjectBus::CanOpen => ObjectBuses::CANOPEN,
        ObjectBus::CoE => ObjectBuses::COE,
    };
    let title = crate::facts::pdo::title(pdo, buses);
    let name = if pdo.name.is_empty() { String::new() } else { format!(": {}", docs::escape(&pdo.name)) };
    docs::sentence(&format!("{title}{name}"))
}

/// Returns a mask of those bits in the first 64 bits that unpacking and packing preserve. The four reserved bits of a
/// TIME_OF_DAY or TIME_DIFFERENCE value are not preserved.
fn covered(fields: &[FieldModel]) -> String {
    const TIME: u64 = 0xFFFF_0FFF_FFFF;
    let mut covered: u64 = 0;
    for field in fields.iter().filter(|field| field.offset + field.bits <= WORD) {
        let bits = match field.kind {
            FieldType::Time(_) => TIME,
            _ => u64::MAX >> (WORD - field.bits),
        };
        covered |= bits << field.offset;
    }
    hex(covered)
}

/// Returns the name and arguments of the shortest constructor for a mapped entry.
pub(super) fn mapping_entry(entry: &PdoEntry) -> (&'static str, Vec<String>) {
    let mut arguments = vec![hex16(entry.index), hex8(entry.sub_index), entry.bits.to_string()];
    // The mapping of padding (index 0) does not depend on the slot.
    let is_object = entry.index != 0;
    let path = match (entry.depends_on_slot && is_object, entry.depends_on_slot_group && is_object) {
        (false, false) => "rt::MappedEntry::new",
        (true, false) => "rt::MappedEntry::in_slot",
        (slot, group) => {
            arguments.push(depends_on(slot, group).to_owned());
            "rt::MappedEntry::depending_on"
        }
    };
    (path, arguments)
}

pub(super) fn mapping_line(entry: &PdoEntry) -> Doc {
    let (path, arguments) = mapping_entry(entry);
    list(&format!("{path}("), arguments, ")")
}

fn fields(context: &Context<'_>, named: &[NamedField<'_>], options: &RustOptions) -> Vec<FieldModel> {
    // `new` and `at` are constructors of the view. The other names belong to methods of traits that any type may
    // implement. If a setter would have the name of another field, the setter gets a different name.
    const RESERVED: [&str; 5] = ["new", "at", "clone", "into", "try_into"];
    let names: HashSet<&String> = named.iter().map(|field| &field.name).collect();
    let field = |NamedField { entry, name }: &NamedField<'_>| {
        let field = field(context, entry, names::escaped(name), options);
        let is_reserved = RESERVED.contains(&name.as_str());
        FieldModel {
            getter: if is_reserved { format!("{name}_") } else { field.name.clone() },
            // A name that would start with a digit already has a leading underscore.
            setter: unused_name(|name| names.contains(name), names::prefixed("set_", name)),
            ..field
        }
    };
    named.iter().map(field).collect()
}

/// Returns the field of an entry. The names of the view's methods are still empty.
fn field(context: &Context<'_>, entry: &PdoEntry, name: String, options: &RustOptions) -> FieldModel {
    let kind = field_type(context, entry.ty, entry.bits);
    let ty = kind.path("super::");
    let cut = kind.cut(entry.bits);
    let address = number::object(entry.index, entry.sub_index);
    let object = match (entry.kind, entry.item.and_then(|id| context.links.path(id.into()))) {
        (PdoEntryKind::Unnumbered, _) => String::new(),
        (PdoEntryKind::Item, Some(path)) => DocModule::PDO.text(&address, path),
        _ => address,
    };
    let location = if object.is_empty() { "an object with an unknown index" } else { object.as_str() };
    let facts = format!("{location}, {} at bit offset {}.", count_of(entry.bits, "bit"), entry.bit_offset);
    let type_link = match &kind {
        FieldType::Named(name, _) => DocModule::PDO.code(&format!("types::{name}")),
        _ => format!("`{}`", ty.trim_start_matches("rt::")),
    };
    let title = docs::escape(&naming::pdos::title(context, entry));
    FieldModel {
        docs: vec![match title.is_empty() {
            true => facts,
            false => format!("{}: {facts}", title.trim_end_matches(['.', ':'])),
        }],
        getter: String::new(),
        setter: String::new(),
        name,
        object,
        type_link,
        attribute: match &kind {
            FieldType::Bytes(length) => options.octets_attribute(*length),
            _ => None,
        },
        ty,
        kind,
        cut,
        offset: entry.bit_offset,
        bits: entry.bits,
        long: entry.bits > WORD,
    }
}

/// Key that identifies a PDO: the index of the mapping object, and the position of the declaration. The index alone is
/// not enough, because several PDOs may have the same mapping object if only one of them is assigned at a time.
type Declared = (u16, Span, u32);

/// The models of a device's or module's PDOs.
pub(super) struct PdoModels<'a>(HashMap<Declared, &'a PdoModel>);

impl<'a> PdoModels<'a> {
    pub(super) fn new(models: &'a [PdoModel]) -> Self {
        // `collect` keeps the last of several PDOs with the same key. In the reversed order, this is the first PDO of
        // the description.
        let keyed = models.iter().rev().map(|model| ((model.mapping_index, model.declared, model.line), model));
        PdoModels(keyed.collect())
    }

    /// Returns the model of `pdo`. Returns `None` if no struct is generated for `pdo`.
    pub(super) fn of(&self, pdo: &Pdo) -> Option<&'a PdoModel> {
        self.0.get(&(pdo.mapping_index, pdo.origin.span, pdo.origin.line)).copied()
    }
}

impl PdoModel {
    /// Returns the names of the enumerations and bit fields that are types of fields.
    pub(super) fn type_names(&self) -> impl Iterator<Item = &str> {
        self.fields.iter().filter_map(|field| match &field.kind {
            FieldType::Named(name, _) => Some(name.as_str()),
            _ => None,
        })
    }

    /// Returns the attribute that suppresses lints about names of the view's methods.
    pub(super) fn view_allow(&self) -> Option<String> {
        method_allow(self.fields.iter().map(|field| field.getter.as_str()))
    }

    /// Returns statements that pack a PDO of more than one word. Long fields are stored as bytes. If all fields fill
    /// whole bytes, the other fields are also stored as bytes, which is fastest. Otherwise, the statements shift the
    /// other fields into words and convert the words to bytes.
    pub(super) fn pack_long(&self) -> Vec<Doc> {
        let is_stored = |field: &&FieldModel| field.long || self.fields.iter().all(FieldModel::is_whole);
        let (stored, shifted): (Vec<_>, Vec<_>) = self.fields.iter().partition(is_stored);
        let mut lines: Vec<Doc> = Vec::new();
        let mut data = format!("[0; {}]", self.length);
        if !shifted.is_empty() {
            lines.push(seq!["let mut words = [0; ", self.bits.div_ceil(WORD), "];"]);
            for field in shifted {
                lines.extend(field.packed().into_iter().chain(field.pack_words()).map(Doc::from));
            }
            data = "rt::bits::from_words(words)".to_owned();
        }
        if stored.is_empty() {
            lines.push(data.into());
            return lines;
        }
        lines.push(seq!["let mut data = ", data, ";"]);
        lines.extend(stored.iter().flat_map(|field| field.pack_data()));
        lines.push("data".into());
        lines
    }

    /// Returns a struct literal that reads all fields of the PDO.
    pub(super) fn unpacked(&self) -> Doc {
        let value = |field: &FieldModel| if self.word { field.unpack_word() } else { field.unpack_data() };
        Data::fields("Self", self.fields.iter().map(|field| (field.name.as_str(), value(field))))
    }
}

impl FieldModel {
    /// Returns statements that calculate `bits`, the bits of the field. In the result, bits beyond the width of the
    /// field are 0.
    pub(super) fn packed(&self) -> Vec<String> {
        let field = format!("self.{}", self.name);
        let is_long = self.name.len() > MAX_FIELD_NAME;
        let bits = self.kind.encode(if is_long { "value" } else { &field }, self.bits);
        let cut = self.cut.as_ref().map(|mask| format!(" & {mask}")).unwrap_or_default();
        let value = is_long.then(|| format!("let value = {field};"));
        value.into_iter().chain([format!("let bits = {bits}{cut};")]).collect()
    }

    /// Returns statements that write `bits` to the words of a PDO that has several words.
    fn pack_words(&self) -> Vec<String> {
        let (word, shift) = (self.offset / WORD, self.offset % WORD);
        let low = if shift == 0 { "bits".to_owned() } else { format!("bits << {shift}") };
        let mut lines = vec![format!("words[{word}] |= {low};")];
        if shift + self.bits > WORD {
            lines.push(format!("words[{}] |= bits >> {};", word + 1, WORD - shift));
        }
        lines
    }

    /// Returns whether the field fills whole bytes.
    fn is_whole(&self) -> bool {
        self.offset.is_multiple_of(8) && self.bits.is_multiple_of(8)
    }

    /// Returns an expression that reads the field from `word`, which contains the whole PDO.
    fn unpack_word(&self) -> Doc {
        let shifted = match (self.offset, &self.cut) {
            (0, None) => "word".to_owned(),
            (0, Some(mask)) => format!("word & {mask}"),
            (offset, None) => format!("word >> {offset}"),
            (offset, Some(mask)) => format!("(word >> {offset}) & {mask}"),
        };
        // An expression with operators needs parentheses before a cast. For a Boolean, parentheses clarify the
        // precedence of `>>` and `&`.
        let is_plain = match self.kind {
            FieldType::Bool => false,
            _ => shifted == "word" || !self.kind.is_cast(),
        };
        let bits = Doc::from(if is_plain { shifted } else { format!("({shifted})") });
        self.kind.decode(&self.ty, &bits)
    }

    /// Returns an expression that reads the field from `data`. The expression is used for PDOs of several words.
    fn unpack_data(&self) -> Doc {
        if self.long {
            return self.get_bytes("data", &self.offset.to_string());
        }
        self.decode(&call!("rt::bits::get", "data", self.offset, self.bits))
    }

    /// Returns an expression that decodes the bits of a field. The bits beyond the field's width must be 0.
    fn decode(&self, bits: &Doc) -> Doc {
        match self.kind {
            FieldType::Bool => seq![bits, Break, " != 0"],
            _ => self.kind.decode(&self.ty, bits),
        }
    }

    /// Returns an expression that copies the field's bytes from bit `at` of `data`.
    fn get_bytes(&self, data: &str, at: &str) -> Doc {
        match self.odd_bits() {
            Some(bits) => call!("rt::bits::get_bits", data, at, bits),
            None => call!("rt::bits::get_bytes", data, at),
        }
    }

    /// Returns the length in bits of a field that does not consist of whole bytes. Returns `None` for other fields.
    fn odd_bits(&self) -> Option<u32> {
        (!self.bits.is_multiple_of(8)).then_some(self.bits)
    }

    /// Returns an expression for the position of the field's first bit within a process image.
    fn bit(&self) -> String {
        if self.offset == 0 {
            "self.bit".to_owned()
        } else {
            format!("self.bit + {}", self.offset)
        }
    }

    /// Returns an expression that reads the field from a process image.
    pub(super) fn get_in_image(&self) -> Doc {
        let at = self.bit();
        if self.long {
            return self.get_bytes("self.data.as_ref()", &at);
        }
        self.decode(&call!("rt::bits::get", "self.data.as_ref()", at, self.bits))
    }

    /// Returns a statement that writes `value` to a process image.
    pub(super) fn set_in_image(&self) -> Doc {
        let at = self.bit();
        let data = "self.data.as_mut()";
        let set = match self.odd_bits().filter(|_| self.long) {
            Some(bits) => call!("rt::bits::set_bits", data, at, bits, "&value"),
            None if self.long => call!("rt::bits::set_bytes", data, at, "&value"),
            None => call!("rt::bits::set", data, at, self.bits, self.kind.encode("value", self.bits)),
        };
        seq![set, ";"]
    }

    /// Returns statements that write the field to `data`. The statements are used for PDOs of several words.
    fn pack_data(&self) -> Vec<Doc> {
        let (offset, bits, field) = (self.offset, self.bits, seq!["&self.", self.name]);
        let put = match self.odd_bits().filter(|_| self.long) {
            Some(bits) => call!("rt::bits::put_bits", "data", offset, bits, field),
            None if self.long => call!("rt::bits::put_bytes", "data", offset, field),
            None => call!("rt::bits::put", "data", offset, bits, "bits"),
        };
        let packed = if self.long { Vec::new() } else { self.packed() };
        packed.into_iter().map(Doc::from).chain([seq!["data = ", put, ";"]]).collect()
    }
}

pub(super) fn cob_id(pdo: &Pdo) -> Option<String> {
    let value = pdo.communication.as_ref()?.cob_id.as_ref()?;
    let number = |value: &i128| u32::try_from(*value).ok();
    match value {
        Value::NodeId(offset) => Some(format!("rt::CobId::from_node({:#x})", number(offset)?)),
        Value::Int(value) => Some(format!("rt::CobId::fixed({:#x})", number(value)?)),
        _ => None,
    }
}

/// Returns the SDO writes that configure a PDO as the description states. They disable the PDO, write its mapping, set
/// its transmission type and timers, and enable it again (CiA 301 7.5.2.36). Writes to read-only communication
/// parameters are left out. The mapping is left out if it is unknown or read-only. Returns no writes if the PDO has no
/// communication parameters, or if the COB-ID is unknown or read-only.
fn configuration(context: &Context<'_>, pdo: &Pdo) -> Vec<String> {
    let Some(communication) = &pdo.communication else { return Vec::new() };
    let cob_id_writable = communication.writable.contains(&1);
    if cob_id(pdo).is_none() || !cob_id_writable {
        return Vec::new();
    }
    let mut writes = vec![write("u32", communication.index, 1, "cob_id | 0x8000_0000")];
    writes.extend(mapping_writes(context, pdo));
    writes.extend(timing_writes(communication));
    writes.push(write("u32", communication.index, 1, "cob_id & 0x7FFF_FFFF"));
    writes
}

/// Returns the SDO writes that set the default transmission type, inhibit time, event timer and SYNC start value.
/// Writes to read-only parameters are left out.
pub(super) fn timing_writes(communication: &PdoCommunication) -> Vec<String> {
    let timing = [
        (2, "u8", communication.transmission_type.map(u16::from)),
        (3, "u16", communication.inhibit_time),
        (5, "u16", communication.event_timer),
        (6, "u8", communication.sync_start.map(u16::from)),
    ];
    let writable = timing.into_iter().filter(|(sub, ..)| communication.writable.contains(sub));
    writable.filter_map(|(sub, ty, value)| Some(write(ty, communication.index, sub, &value?.to_string()))).collect()
}

/// Returns whether the default COB-ID contains a CAN identifier.
pub(super) fn has_identifier(pdo: &Pdo) -> bool {
    let value = pdo.communication.as_ref().and_then(|communication| communication.cob_id.as_ref());
    value.is_some_and(contains_identifier)
}

fn mapping_writes(context: &Context<'_>, pdo: &Pdo) -> Vec<String> {
    let writable = |group: &Group, sub| group.sub(sub).is_some_and(|item| item.access.writable());
    let Some((_, mapping)) = addressable(context).find(|(_, group)| group.index() == Some(pdo.mapping_index)) else {
        return Vec::new();
    };
    let count = pdo.entries.len();
    let is_writable = u8::try_from(count).is_ok_and(|count| (0..=count).all(|sub| writable(mapping, sub)));
    if !is_writable || !pdo.is_mapping_known() {
        return Vec::new();
    }
    let mut writes = vec![write("u8", pdo.mapping_index, 0, "0")];
    for (entry, sub) in pdo.entries.iter().zip(1..=u8::MAX) {
        let word = u32::from(entry.index) << 16 | u32::from(entry.sub_index) << 8 | (entry.bits & 0xFF);
        writes.push(write("u32", pdo.mapping_index, sub, &literal::word(word)));
    }
    writes.push(write("u8", pdo.mapping_index, 0, &count.to_string()));
    writes
}

/// Returns the expression that creates the SDO write of a value.
pub(in crate::backend::rust) fn write(ty: &str, index: u16, sub: u8, value: &str) -> String {
    format!("rt::SdoWrite::new_{ty}({}, {}, {value})", hex16(index), hex8(sub))
}
