//! Finds the types in generated code that are packed and unpacked. Reads the text line by line.

use std::collections::HashMap;

use crate::layouts::{self, Layout};
use crate::messages::{bare, Messages};
use crate::views::{self, Views};
use lexibus_codegen::ir::Catalog;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum TypeKind {
    /// A PDO or process image, which has the methods `pack` and `unpack`.
    ProcessData,
    /// A parameter record, which has the methods `encode` and `decode`.
    Record,
    /// A request with its reply.
    Message,
}

/// A type found in the text: its name and the modules that contain it.
struct Found<'t> {
    modules: Vec<&'t str>,
    /// Path of the module that defines the type, if the type is imported from another module. Otherwise `None`.
    shared: Option<Vec<&'t str>>,
    name: &'t str,
    kind: TypeKind,
}

/// Number of types of each kind, and number of their fields.
#[derive(Debug, Default)]
pub struct Counts {
    pub process_data: usize,
    pub records: usize,
    pub messages: usize,
    pub views: usize,
    /// Number of fields in process data and records.
    pub fields: usize,
}

impl Counts {
    /// Counts the types in `found`. Checks that the counts agree with the functions and implementations in `text`.
    fn of(found: &[Found<'_>], text: &str, name: &str) -> Self {
        let of = |kind: TypeKind| found.iter().filter(|one| one.kind == kind && one.shared.is_none()).count();
        let lines = |part: &str| text.lines().filter(|line| line.contains(part)).count();
        let (process_data, records, messages) =
            (of(TypeKind::ProcessData), of(TypeKind::Record), of(TypeKind::Message));
        assert_eq!(process_data, lines("fn pack(&self) -> ["), "{name}");
        assert_eq!(records, lines("fn encode(&self) -> Result<["), "{name}");
        assert_eq!(messages, lines("rt::message::Request<'a> for "), "{name}");
        Counts { process_data, records, messages, ..Counts::default() }
    }

    pub fn add(&mut self, other: &Counts) {
        self.process_data += other.process_data;
        self.records += other.records;
        self.messages += other.messages;
        self.views += other.views;
        self.fields += other.fields;
    }
}

/// Returns the text without comments and without modules that contain no layouts. Compiling these modules would take most of
/// the time.
pub fn needed(text: &str) -> String {
    let not_needed = ["objects", "mappable", "remappable", "codes", "procedures", "models"];
    let (mut out, mut keep) = (String::new(), true);
    for line in text.lines().filter(|line| !line.trim_start().starts_with("//")) {
        if let Some(name) = line.strip_prefix("pub mod ") {
            keep = !not_needed.contains(&name.trim_end_matches(" {"));
        }
        if keep {
            out.extend([line, "\n"]);
        }
        keep |= line == "}";
    }
    out
}

/// Returns the statements that check all types in the bindings of `catalog`, and the number of types of each kind. The bindings
/// are in the module `MODULE`.
pub fn checks(name: &str, text: &str, catalog: &Catalog) -> (Vec<String>, Counts) {
    let (found, structs, messages, views) = (all(text), structs(text), Messages::new(text), Views::new(text));
    let mut counts = Counts::of(&found, text, name);
    let expected = layouts::all(catalog);
    let with_layout = found.iter().filter(|one| one.kind != TypeKind::Message).count();
    assert_eq!(with_layout, expected.len(), "{name}: the number of types and of layouts");
    let found = in_order(found, &expected, &indices(text));
    let mut expected = expected.iter();
    let check = |one: &Found<'_>| {
        let path = one.path();
        let title = format!("{name}: {path}");
        if one.kind == TypeKind::Message {
            let name = messages.title(one.name);
            let has_node =
                layouts::has_node(catalog, name).unwrap_or_else(|| panic!("{title}: no message is {name:?}"));
            return messages.call(&title, one.name, &format!("MODULE::{path}"), has_node);
        }
        let layout = expected.next().expect("a layout for each type");
        let fields = structs.get(&one.definition()).map(Vec::as_slice).unwrap_or_default();
        assert_eq!(one.kind == TypeKind::Record, layout.is_record, "{title}");
        assert_eq!(fields.len(), layout.fields(), "{title}: {fields:?}");
        counts.fields += fields.len();
        let view = views.check(&one.modules, one.name, fields);
        let view = view.filter(|_| one.kind == TypeKind::ProcessData && one.shared.is_none());
        counts.views += usize::from(view.is_some());
        one.check(&title, layout, fields) + &view.unwrap_or_default()
    };
    let checks = found.iter().map(check).collect();
    assert_eq!(counts.views, views::count(text), "{name}: views");
    (checks, counts)
}

impl Found<'_> {
    fn path(&self) -> String {
        path(&self.modules, self.name)
    }

    /// Returns the path of the definition.
    fn definition(&self) -> String {
        path(self.shared.as_ref().unwrap_or(&self.modules), self.name)
    }

    /// Returns the statement that checks process data or a record.
    fn check(&self, title: &str, layout: &Layout, fields: &[(&str, &str)]) -> String {
        let name = format!("MODULE::{}", self.path());
        let arm = |(at, (field, ty)): (usize, &(&str, &str))| format!("{at} => value.{field} = {}, ", self.value(ty));
        let arms: String = fields.iter().enumerate().map(arm).collect();
        let number = layout.number.map(|(constant, number)| match (constant, layout.is_record) {
            ("INDEX", false) => format!("assert_eq!(<{name} as lexibus::Pdo>::INDEX, {number}, {title:?}); "),
            _ => format!("assert_eq!({name}::{constant}, {number}, {title:?}); "),
        });
        let kind = if layout.is_record { "record" } else { "process_data" };
        format!(
            "{}let layout = &{}; {kind}!({name}, layout, |value, at, raw| match at {{ {arms}_ => {{}} }}); ",
            number.unwrap_or_default(),
            layout.literal(title),
        )
    }

    /// Returns an expression that creates a field of type `ty` from the bits of `raw`.
    fn value(&self, ty: &str) -> String {
        match ty {
            "bool" => "raw & 1 != 0".to_owned(),
            "u8" | "u16" | "u32" | "u64" | "i8" | "i16" | "i32" | "i64" => format!("raw as {ty}"),
            "f32" => "f32::from_bits(raw as u32)".to_owned(),
            "f64" => "f64::from_bits(raw)".to_owned(),
            _ if ty.starts_with("[u8; ") => "bytes(raw)".to_owned(),
            _ => match (ty.strip_prefix("rt::"), ty.strip_prefix("super::")) {
                (Some(name), _) => format!("lexibus::{}::from_raw(raw)", bare(name)),
                (None, Some(name)) => {
                    let modules = self.shared.as_ref().unwrap_or(&self.modules);
                    let outer = &modules[..modules.len() - 1];
                    let path = ["MODULE"].iter().chain(outer).chain([&name]).copied().collect::<Vec<_>>().join("::");
                    match name.starts_with("pdo::") {
                        true => format!("{path}::unpack(&filled(raw, {path}::LEN)).expect(\"a PDO\")"),
                        false => format!("{path}::from_raw(raw as _)"),
                    }
                }
                // All devices of a PROFINET file share its enumerations.
                (None, None) => format!("MODULE::{ty}::from_raw(raw as _)"),
            },
        }
    }
}

fn path(modules: &[&str], name: &str) -> String {
    modules.iter().copied().chain([name]).collect::<Vec<_>>().join("::")
}

/// Returns the index of the mapping object of each PDO, by the path of its struct.
fn indices(text: &str) -> HashMap<String, u16> {
    let (mut indices, mut owner) = (HashMap::new(), "");
    each_line(text, |modules, code| {
        if let Some(name) = code.strip_prefix("impl rt::Pdo for ").and_then(|rest| rest.strip_suffix(" {")) {
            owner = name;
        } else if let Some(index) = code.strip_prefix("const INDEX: u16 = 0x").and_then(|rest| rest.strip_suffix(';')) {
            indices.insert(path(modules, owner), u16::from_str_radix(index, 16).expect("an index"));
        }
    });
    indices
}

/// Returns the types in the order of their layouts. In the text, a module first imports the PDOs that it shares with another
/// module, and then defines its own PDOs. Therefore, the PDOs of such a module are assigned to their layouts by index.
fn in_order<'t>(found: Vec<Found<'t>>, layouts: &[Layout], indices: &HashMap<String, u16>) -> Vec<Found<'t>> {
    let (mut ordered, mut rest, mut layouts) = (Vec::new(), found.into_iter().peekable(), layouts.iter());
    while let Some(first) = rest.next() {
        let mut group = vec![first];
        while let Some(next) = rest.next_if(|next| next.modules == group[0].modules) {
            group.push(next);
        }
        let of_group = layouts.by_ref().take(group.iter().filter(|one| one.kind != TypeKind::Message).count());
        for layout in of_group.filter(|_| group.iter().any(|one| one.shared.is_some())).collect::<Vec<_>>() {
            let number = layout.number.map(|(_, number)| number);
            let at = group.iter().position(|one| indices.get(&one.definition()).copied() == number);
            let at = at.expect("a PDO with the index of the layout");
            ordered.push(group.remove(at));
        }
        ordered.append(&mut group);
    }
    ordered
}

/// Returns the PDOs that a line of a module imports from another module, with the modules that define them.
fn imported<'t>(modules: &[&'t str], code: &'t str) -> Vec<Found<'t>> {
    let import = code.strip_prefix("pub use super::super::").and_then(|rest| rest.strip_suffix(';'));
    let Some((module, names)) =
        import.filter(|_| modules.last() == Some(&"pdo")).and_then(|rest| rest.split_once("::pdo::"))
    else {
        return Vec::new();
    };
    let outer = &modules[..modules.len() - 2];
    let shared: Vec<&str> = outer.iter().copied().chain([module, "pdo"]).collect();
    let names = names.trim_matches(['{', '}']).split(", ");
    names
        .map(|name| Found {
            modules: modules.to_vec(),
            shared: Some(shared.clone()),
            name,
            kind: TypeKind::ProcessData,
        })
        .collect()
}

/// Returns all types in `text` that are packed and unpacked.
fn all(text: &str) -> Vec<Found<'_>> {
    let (mut found, mut owner) = (Vec::new(), "");
    each_line(text, |modules, code| {
        found.extend(imported(modules, code));
        if let Some(name) = code.strip_prefix("impl ").and_then(|rest| rest.strip_suffix(" {")) {
            owner = name;
        }
        let (name, kind) = match code.strip_prefix("impl<'a> rt::message::Request<'a> for ") {
            Some(message) => (bare(message), TypeKind::Message),
            None if code.contains("fn pack(&self) -> [") => (owner, TypeKind::ProcessData),
            None if code.contains("fn encode(&self) -> Result<[") => (owner, TypeKind::Record),
            None => return,
        };
        found.push(Found { modules: modules.to_vec(), shared: None, name, kind });
    });
    found
}

/// Returns the names and types of the fields of all structs, by path.
fn structs(text: &str) -> HashMap<String, Vec<(&str, &str)>> {
    let (mut structs, mut current): (HashMap<String, Vec<_>>, _) = (HashMap::new(), None);
    each_line(text, |modules, code| {
        if let Some(name) = code.strip_prefix("pub struct ") {
            let path = path(modules, bare(name));
            current = code.ends_with('{').then_some(path);
        } else if code == "}" {
            current = None;
        } else if let (Some(path), Some(field)) = (&current, code.strip_prefix("pub ")) {
            let field = field.strip_suffix(',').and_then(|field| field.split_once(": "));
            structs.entry(path.clone()).or_default().push(field.expect("a field on one line"));
        }
    });
    structs
}

/// Calls `look` for each line, with the modules that contain it and without its indentation. The indentation determines where
/// a module ends.
pub fn each_line<'t>(text: &'t str, mut look: impl FnMut(&[&'t str], &'t str)) {
    let (mut modules, mut levels): (Vec<&str>, Vec<usize>) = (Vec::new(), Vec::new());
    for line in text.lines() {
        let code = line.trim_start();
        let level = line.len() - code.len();
        while !code.is_empty() && levels.last().is_some_and(|last| *last >= level) {
            levels.pop();
            modules.pop();
        }
        if let Some(name) = code.strip_prefix("pub mod ").and_then(|rest| rest.strip_suffix(" {")) {
            levels.push(level);
            modules.push(name);
        }
        look(&modules, code);
    }
}
