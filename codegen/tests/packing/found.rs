//! The types of generated code that are packed and unpacked, found by the lines of its text.

use std::collections::HashMap;

/// What a type is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// A PDO, or a process image: `pack` and `unpack`.
    ProcessData,
    /// A parameter record: `encode` and `decode`.
    Record,
    /// A request with its reply.
    Message,
}

/// A type, by its path below the bindings.
#[derive(Debug)]
pub struct Found {
    path: String,
    kind: Kind,
    /// Of a message: an expression with random values for it, and one for its reply, where they consist of numbers.
    values: [Option<String>; 2],
    /// Of a message: the constant bytes of the request, and of its reply.
    constants: [String; 2],
}

impl Found {
    /// The call that checks it.
    pub fn call(&self, module: &str, file: &str) -> String {
        let name = format!("{module}::{}", self.path);
        let title = format!("{file:?}, {:?}", self.path);
        match self.kind {
            Kind::ProcessData => format!("process_data!({title}, {name});"),
            Kind::Record => format!("record!({title}, {name});"),
            Kind::Message => {
                let [request, reply] = &self.values;
                let own = |value: &String| value.replace("MODULE", module);
                let request = match request {
                    Some(value) => format!("sent!(random, {name}, data, {})", own(value)),
                    None => format!("overheard!(random, {name}, &[{}])", self.constants[0]),
                };
                let reply = match reply {
                    Some(value) => format!("answered!(random, {name}, data, {})", own(value)),
                    None => format!("overheard_reply!(random, {name}, data, &[{}])", self.constants[1]),
                };
                format!("message({title}, |random| {request}, |random, data| {reply});")
            }
        }
    }
}

/// How many types of each kind there are.
#[derive(Debug, Default)]
pub struct Counts {
    pub process_data: usize,
    pub records: usize,
    pub messages: usize,
}

impl Counts {
    /// Adds what was found in `text`, which has to be as much as has the functions that it is found by.
    pub fn add(&mut self, found: &[Found], text: &str, name: &str) {
        let of = |kind: Kind| found.iter().filter(|one| one.kind == kind).count();
        let lines = |part: &str| text.lines().filter(|line| line.contains(part)).count();
        let (process_data, records, messages) = (of(Kind::ProcessData), of(Kind::Record), of(Kind::Message));
        assert_eq!(process_data, lines("fn pack(&self) -> ["), "{name}");
        assert_eq!(records, lines("fn encode(&self) -> Result<["), "{name}");
        assert_eq!(messages, lines("rt::message::Request<'a> for "), "{name}");
        self.process_data += process_data;
        self.records += records;
        self.messages += messages;
    }
}

/// The text without modules that no layout needs: handles would take most of the time.
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

/// Every type of `text` that is packed and unpacked. The text is canonical: a step of four spaces is a level.
pub fn all(text: &str) -> Vec<Found> {
    let (mut found, structs, replies) = (Vec::new(), structs(text), replies(text));
    let (constants, rules) = (constants(text), rules(text));
    let mut modules: Vec<(usize, &str)> = Vec::new();
    let mut owner = "";
    for line in text.lines() {
        let code = line.trim_start();
        let level = line.len() - code.len();
        if !code.is_empty() {
            modules.retain(|(own, _)| *own < level);
        }
        if let Some(name) = code.strip_prefix("pub mod ").and_then(|rest| rest.strip_suffix(" {")) {
            modules.push((level, name));
        }
        if let Some(name) = code.strip_prefix("impl ").and_then(|rest| rest.strip_suffix(" {")) {
            owner = name;
        }
        let message = code.strip_prefix("impl<'a> rt::message::Request<'a> for ");
        let (name, kind) = match message {
            Some(message) => (bare(message), Kind::Message),
            None if code.contains("fn pack(&self) -> [") => (owner, Kind::ProcessData),
            None if code.contains("fn encode(&self) -> Result<[") => (owner, Kind::Record),
            None => continue,
        };
        let of = [message.and(Some(name)), message.and(replies.get(name).copied())];
        let values = of.map(|name| random(name?, &structs, rules.get(name?).copied()));
        let constants =
            of.map(|name| name.and_then(|name| constants.get(name)).copied().unwrap_or_default().to_owned());
        let path = modules.iter().map(|(_, name)| *name).chain([name]).collect::<Vec<_>>().join("::");
        found.push(Found { path, kind, values, constants });
    }
    found
}

/// The structs of `pub mod messages`, with the names and types of their fields.
fn structs(text: &str) -> HashMap<&str, Vec<(&str, &str)>> {
    let mut structs: HashMap<&str, Vec<(&str, &str)>> = HashMap::new();
    let mut own = None;
    for line in text.lines() {
        if let Some(name) = line.strip_prefix("    pub struct ") {
            own = Some(bare(name));
            structs.insert(bare(name), Vec::new());
        } else if line == "    }" {
            own = None;
        } else if let Some(field) = line.strip_prefix("        pub ").and_then(|field| field.strip_suffix(',')) {
            let fields = own.and_then(|name| structs.get_mut(name));
            fields.into_iter().for_each(|fields| fields.extend(field.split_once(": ")));
        }
    }
    structs
}

/// The type of the reply to each message.
fn replies(text: &str) -> HashMap<&str, &str> {
    let (mut replies, mut message) = (HashMap::new(), None);
    for line in text.lines().map(str::trim_start) {
        if line.starts_with("impl") {
            message = line.split_once("rt::message::Message for ").map(|(_, name)| bare(name));
        }
        if let (Some(message), Some(reply)) = (message, line.strip_prefix("type Reply<'r> = ")) {
            replies.insert(message, bare(reply));
        }
    }
    replies
}

/// The first constant bytes that each request and reply is read by.
fn constants(text: &str) -> HashMap<&str, &str> {
    let (mut constants, mut owner) = (HashMap::new(), None);
    for line in text.lines().map(str::trim_start) {
        if line.starts_with("impl") {
            let read = line.split_once("rt::message::").and_then(|(_, line)| line.split_once("<'a> for "));
            owner = read.map(|(_, name)| bare(name));
        }
        let constant = line.strip_prefix("from.constant(&[").and_then(|rest| rest.strip_suffix("])?;"));
        if let (Some(name), Some(constant)) = (owner, constant) {
            constants.entry(name).or_insert(constant);
        }
    }
    constants
}

/// The rule by which each request reads its settings.
fn rules(text: &str) -> HashMap<&str, &str> {
    let (mut rules, mut owner) = (HashMap::new(), "");
    for line in text.lines().map(str::trim_start) {
        owner = line.strip_prefix("impl<'a> rt::message::Request<'a> for ").map_or(owner, bare);
        if let Some((_, rule)) = line.split_once("rt::message::Settings::received(value_0, ") {
            rules.insert(owner, bare(rule));
        }
    }
    rules
}

/// A name without what stands behind it.
fn bare(name: &str) -> &str {
    let end = name.find(|letter: char| !letter.is_alphanumeric() && letter != '_').unwrap_or(name.len());
    &name[..end]
}

/// An expression of random values for a message; `None` where it has a field that has a list.
fn random(name: &str, structs: &HashMap<&str, Vec<(&str, &str)>>, rule: Option<&str>) -> Option<String> {
    let value = |ty: &str| match ty {
        "u8" | "u16" | "u32" | "u64" | "i8" | "i16" | "i32" | "i64" => Some(format!("random.number() as {ty}")),
        "f32" => Some("f32::from_bits(random.next() as u32)".to_owned()),
        "bool" => Some("random.next() & 1 != 0".to_owned()),
        "rt::Parameter" => Some("lexibus::Parameter(random.number() as u32)".to_owned()),
        "rt::message::Setting" => Some("random.setting(data)".to_owned()),
        "rt::message::Settings<'a>" => {
            let rule = format!("MODULE::messages::{}", rule?);
            Some(format!("lexibus::message::Settings::sent(random.settings({rule}), {rule})"))
        }
        _ => match ty.strip_prefix("rt::message::List<'a, ") {
            Some(entry) => {
                let entry = random(bare(entry), structs, None)?;
                Some(format!("lexibus::message::List::from(random.several(|random| {entry}))"))
            }
            None => ty.strip_prefix("super::").map(|ty| format!("MODULE::{ty}::from_raw(random.number() as _)")),
        },
    };
    let fields: Option<Vec<String>> =
        structs.get(name)?.iter().map(|(name, ty)| Some(format!("{name}: {}", value(ty)?))).collect();
    Some(format!("MODULE::messages::{name} {{ {} }}", fields?.join(", ")))
}
