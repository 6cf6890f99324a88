//! Structs for the cyclic data of submodules, and views of the bytes.

use super::docs;
use super::field::{Field, Use};
use super::values::Values;
use crate::backend::rust::code::Doc;
use crate::backend::rust::doc_table;
use crate::backend::rust::RustOptions;
use crate::ir::{Direction, IoData, PdoEntryKind, Submodule, Type};
use crate::names::{self, Case, NameRequest};
use crate::text::count_of;

/// Maximum length of a field's name, without a suffix that makes the name unique. The limit keeps the generated lines
/// that read and write the field short.
const MAX_FIELD_NAME: usize = 30;

/// Names that fields must not have: keywords, and methods of the views or of all types.
const RESERVED: [&str; 8] = ["self", "super", "crate", "new", "view", "clone", "into", "try_into"];

/// The cyclic data of a submodule in one direction, ready to be printed.
pub(in crate::backend::rust) struct ImageModel {
    /// `Inputs` or `Outputs`.
    pub name: &'static str,
    pub is_output: bool,
    pub docs: Vec<String>,
    pub derives: Vec<String>,
    pub length: u32,
    pub trailer: u32,
    pub status: u8,
    /// Attribute that suppresses lints about the names of getters.
    pub allow: Option<&'static str>,
    pub fields: Vec<FieldModel>,
}

/// A field of a struct for cyclic data or a record.
pub(in crate::backend::rust) struct FieldModel {
    pub name: String,
    pub docs: Vec<String>,
    pub heading: String,
    /// Position and type of the field, as cells of a documentation table.
    cells: [String; 2],
    pub ty: String,
    /// True if the type is an enumeration.
    pub is_enumeration: bool,
    /// Attribute that the field needs for derived traits.
    pub attribute: Option<String>,
    /// Expression that reads the field in a view.
    pub get: Doc,
    /// Expression that reads the field from the array `data`.
    pub read: Doc,
    /// Statement that writes the struct's field to the array `data`.
    pub pack: Doc,
    /// Statement that writes `value` to the field in a view.
    pub set: Doc,
    /// `const ` if a `const fn` can read the field. Otherwise empty.
    pub constant: &'static str,
}

/// Returns the inputs or outputs of `submodule`. Returns `None` if the submodule has no data or no fields in this
/// direction.
pub(super) fn model(
    submodule: &Submodule,
    direction: Direction,
    values: &Values<'_>,
    options: &RustOptions,
) -> Option<ImageModel> {
    let data = match direction {
        Direction::Transmit => submodule.input.as_deref()?,
        Direction::Receive => submodule.output.as_deref()?,
    };
    let fields = fields(data, values, options);
    let (name, title) = match direction {
        Direction::Transmit => ("Inputs", "data from the device to the controller"),
        Direction::Receive => ("Outputs", "data from the controller to the device"),
    };
    let image = &data.image;
    let mut docs = vec![format!("{name}: {title}."), String::new()];
    let consistency = if data.consistent { "consistent as a whole" } else { "consistent only within each data item" };
    let length = count_of(image.length, "byte");
    docs.push(format!("{length} of user data, {consistency}{}.", trailer(image.overhead)));
    docs.extend(table(&fields, &["pack", "unpack"], |_| String::new()));
    (!fields.is_empty()).then(|| ImageModel {
        name,
        is_output: direction == Direction::Receive,
        docs,
        derives: options.derives(true),
        length: image.length,
        trailer: image.overhead,
        status: submodule.status_lengths.0,
        allow: allow(fields.iter().map(|field| field.name.as_str())),
        fields,
    })
}

/// Returns the lines of the table with all fields of a struct. `methods` are the struct's methods, and `default`
/// returns the default value of a field.
pub(super) fn table<'f>(
    fields: impl IntoIterator<Item = &'f FieldModel>,
    methods: &[&str],
    mut default: impl FnMut(usize) -> String,
) -> Vec<String> {
    let row = |(at, field): (usize, &FieldModel)| {
        let [position, ty] = field.cells.clone();
        [position, doc_table::field_link(&field.name, methods), ty, default(at)]
    };
    let rows: Vec<[String; 4]> = fields.into_iter().enumerate().map(row).collect();
    doc_table::table(["Position", "Field", "Type", "Default"], &rows)
}

fn trailer(bytes: u32) -> String {
    match bytes {
        0 => String::new(),
        length => format!(", followed by an F-message trailer of {}", count_of(length, "byte")),
    }
}

fn fields(data: &IoData, values: &Values<'_>, options: &RustOptions) -> Vec<FieldModel> {
    let entries = data.image.fields.iter().filter(|entry| entry.kind != PdoEntryKind::Padding);
    let found = entries.filter_map(|entry| {
        let bits = (entry.bit_offset, entry.bits);
        let field = Field::new(values, entry.ty, bits, data.image.length, Use::Image)?;
        Some((entry.name.as_str(), entry.ty, field))
    });
    models(&found.collect::<Vec<_>>(), &RESERVED, values, options)
}

/// Returns the models of fields. Each field is given with its name in the description and its type.
pub(super) fn models(
    found: &[(&str, Type, Field<'_>)],
    reserved: &[&str],
    values: &Values<'_>,
    options: &RustOptions,
) -> Vec<FieldModel> {
    let name_requests = found.iter().map(|(title, _, field)| name_request(title, field));
    let names = names::unique_up_to(name_requests, reserved, Case::Snake, MAX_FIELD_NAME);
    let model = |((title, ty, field), name): (&(&str, Type, Field<'_>), String)| {
        let facts = field.facts(values.types, *ty);
        FieldModel::new(field, &name, vec![docs::titled(title, &facts)], options)
    };
    found.iter().zip(names).map(model).collect()
}

/// Returns the name request of a field. If the name is ambiguous, the position of the field is the suffix.
pub(super) fn name_request<'n>(name: &'n str, field: &Field<'_>) -> NameRequest<'n> {
    let position = field.position;
    let is_whole = position.bit == 0 && position.bits.is_multiple_of(8);
    let suffix = if is_whole { position.byte.to_string() } else { format!("{}_{}", position.byte, position.bit) };
    NameRequest { name, fallback: format!("field {}", suffix.replace('_', " ")), suffix }
}

impl FieldModel {
    /// Creates the model of a field. `name` must not be escaped.
    pub(super) fn new(field: &Field<'_>, name: &str, docs: Vec<String>, options: &RustOptions) -> Self {
        let name = names::escaped(name);
        FieldModel {
            heading: docs.first().cloned().unwrap_or_default(),
            docs,
            cells: [field.position.words(), field.type_link()],
            ty: field.rust_type(),
            is_enumeration: field.enumeration.is_some(),
            attribute: field.byte_string().and_then(|length| options.octets_attribute(length)),
            get: field.read("self.0"),
            read: field.read("data"),
            pack: field.write("data", "&mut data", &format!("self.{name}")),
            set: field.write("self.0", "self.0", "value"),
            constant: if field.is_const() { "const " } else { "" },
            name,
        }
    }

    /// Returns the name of the method that sets the field.
    pub(in crate::backend::rust) fn setter(&self) -> String {
        names::prefixed("set_", &self.name)
    }
}

/// Returns the attribute for getters with these names, if at least one name needs the attribute. It suppresses a clippy
/// lint about prefixes, such as `to_`, that imply a certain signature.
fn allow<'n>(mut names: impl Iterator<Item = &'n str>) -> Option<&'static str> {
    let has_prefix =
        names.any(|name| ["from_", "into_", "to_", "is_", "as_"].iter().any(|prefix| name.starts_with(prefix)));
    has_prefix.then_some("#[allow(clippy::wrong_self_convention)]")
}
