//! Creates random values for the messages in generated code. Reads the text line by line.

use std::collections::HashMap;

/// Facts about the messages in generated code.
pub struct Messages<'t> {
    structs: HashMap<&'t str, Vec<(&'t str, &'t str)>>,
    replies: HashMap<&'t str, &'t str>,
    constants: HashMap<&'t str, &'t str>,
    rules: HashMap<&'t str, &'t str>,
    titles: HashMap<&'t str, &'t str>,
}

impl<'t> Messages<'t> {
    pub fn new(text: &'t str) -> Self {
        Messages {
            structs: structs(text),
            replies: replies(text),
            constants: constants(text),
            rules: rules(text),
            titles: titles(text),
        }
    }

    /// Returns the name of a message in the device description.
    pub fn title(&self, message: &str) -> &'t str {
        self.titles.get(message).copied().unwrap_or_default()
    }

    /// Returns the macro call that checks a message. `MODULE` is a placeholder for the module of the bindings.
    pub fn call(&self, title: &str, message: &str, path: &str, has_node: bool) -> String {
        let value = |name: &str| random(name, &self.structs, self.rules.get(name).copied());
        let constant = |name: &str| self.constants.get(name).copied().unwrap_or_default();
        let request = match value(message) {
            Some(value) => format!("sent!(random, {path}, data, {has_node}, {value})"),
            None => format!("overheard!(random, {path}, &[{}])", constant(message)),
        };
        // A reply that is a sequence of bytes has no struct.
        let reply = self.replies.get(message).copied().unwrap_or_default();
        let reply = match value(reply) {
            Some(value) => format!("answered!(random, {path}, data, {value})"),
            None => format!("overheard_reply!(random, {path}, data, &[{}])", constant(reply)),
        };
        format!("message({title:?}, |random| {request}, |random, data| {reply});")
    }
}

/// Returns the names of all messages in the device description, by type name.
fn titles(text: &str) -> HashMap<&str, &str> {
    let (mut titles, mut message) = (HashMap::new(), None);
    for line in text.lines().map(str::trim_start) {
        if line.starts_with("impl") {
            message = line.split_once("rt::message::Message for ").map(|(_, name)| bare(name));
        }
        let title = line.strip_prefix("const NAME: &'static str = \"").and_then(|rest| rest.strip_suffix("\";"));
        titles.extend(message.zip(title));
    }
    titles
}

/// Returns the structs in `pub mod messages`, with the names and types of their fields.
fn structs(text: &str) -> HashMap<&str, Vec<(&str, &str)>> {
    let mut structs: HashMap<&str, Vec<(&str, &str)>> = HashMap::new();
    let mut current = None;
    for line in text.lines() {
        if let Some(name) = line.strip_prefix("    pub struct ") {
            current = Some(bare(name));
            structs.insert(bare(name), Vec::new());
        } else if line == "    }" {
            current = None;
        } else if let Some(field) = line.strip_prefix("        pub ").and_then(|field| field.strip_suffix(',')) {
            let fields = current.and_then(|name| structs.get_mut(name));
            fields.into_iter().for_each(|fields| fields.extend(field.split_once(": ")));
        }
    }
    structs
}

/// Returns the reply type of each message.
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

/// Returns the first constant bytes of each request and each reply.
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

/// Returns the rule that each request uses to read its settings.
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

/// Returns the name at the start of a text.
pub fn bare(name: &str) -> &str {
    let end = name.find(|letter: char| !letter.is_alphanumeric() && letter != '_').unwrap_or(name.len());
    &name[..end]
}

/// Returns an expression that creates a message with random values. Returns `None` if no struct has this name, or if the
/// type of a field is not supported, for example a text.
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
