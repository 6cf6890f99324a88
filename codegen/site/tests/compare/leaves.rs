//! Finds and changes the leaves of a JSON value.

use lexibus_codegen::ir::Catalog;
use serde::Deserialize;
use serde_json::Value;

/// Path of a value within a JSON value.
pub struct Leaf {
    path: Vec<Key>,
}

#[derive(Clone)]
enum Key {
    Field(String),
    Position(usize),
}

impl Leaf {
    /// Returns all numbers, texts, truth values, lists and objects within `root`. Lists and objects are included, because they can
    /// also be missing.
    pub fn all(root: &Value) -> Vec<Leaf> {
        let mut leaves = Vec::new();
        collect(root, &mut Vec::new(), &mut leaves);
        leaves
    }

    /// Returns the JSON pointer of the leaf.
    pub fn pointer(&self) -> String {
        let escaped = |key: &Key| match key {
            Key::Field(name) => format!("/{}", name.replace('~', "~0").replace('/', "~1")),
            Key::Position(position) => format!("/{position}"),
        };
        self.path.iter().map(escaped).collect()
    }

    /// Returns the JSON pointer with `*` for list positions.
    pub fn pattern(&self) -> String {
        let name = |key: &Key| match key {
            Key::Field(name) => format!("/{name}"),
            Key::Position(_) => "/*".to_owned(),
        };
        self.path.iter().map(name).collect()
    }

    /// Returns the value of the leaf within `root`.
    pub fn value<'r>(&self, root: &'r Value) -> &'r Value {
        root.pointer(&self.pointer()).expect("a leaf")
    }

    /// Returns whether the leaf is a number, a text or a truth value.
    pub fn is_value(&self, root: &Value) -> bool {
        !matches!(self.value(root), Value::Object(_) | Value::Array(_))
    }

    /// Replaces the value of the leaf in `root` and returns the old value.
    pub fn replace(&self, root: &mut Value, value: Value) -> Value {
        std::mem::replace(root.pointer_mut(&self.pointer()).expect("a leaf"), value)
    }
}

fn collect(value: &Value, path: &mut Vec<Key>, leaves: &mut Vec<Leaf>) {
    match value {
        // A missing value is not a leaf. The test does not add values, but it makes the reverse change: it removes values that
        // exist.
        Value::Null => return,
        Value::Array(list) => {
            for (position, part) in list.iter().enumerate() {
                path.push(Key::Position(position));
                collect(part, path, leaves);
                path.pop();
            }
        }
        Value::Object(fields) => {
            for (name, part) in fields {
                path.push(Key::Field(name.clone()));
                collect(part, path, leaves);
                path.pop();
            }
        }
        _ => {}
    }
    leaves.push(Leaf { path: path.clone() });
}

/// Returns values that differ from the value of a leaf. Some of these values can be invalid.
pub fn mutations(leaf: &Leaf, root: &mut Value) -> Vec<Value> {
    let value = leaf.value(root).clone();
    let mut others = candidates(&value, leaf, root);
    others.retain(|other| *other != value);
    others
}

fn candidates(value: &Value, leaf: &Leaf, root: &mut Value) -> Vec<Value> {
    match value {
        Value::Bool(value) => vec![Value::Bool(!value)],
        Value::Number(number) => numbers(number),
        Value::String(text) => texts(text, &variants(&leaf.pointer(), root)),
        Value::Array(list) => shorter(list),
        Value::Object(fields) => {
            let mut others = vec![Value::Null];
            if let [content] = fields.values().collect::<Vec<_>>().as_slice() {
                others.extend(alternatives(content, &variants(&leaf.pointer(), root)));
            }
            others
        }
        Value::Null => Vec::new(),
    }
}

fn numbers(number: &serde_json::Number) -> Vec<Value> {
    match (number.as_i64(), number.as_u64()) {
        (Some(number), _) => vec![Value::from(number.wrapping_add(1)), Value::from(number.wrapping_sub(1))],
        (_, Some(number)) => vec![Value::from(number.wrapping_sub(1))],
        _ => vec![Value::from(number.as_f64().unwrap_or_default() / 2.0 + 1.5)],
    }
}

/// Returns a changed text and a number, or all variant names if the text is a variant name.
fn texts(text: &str, variants: &[String]) -> Vec<Value> {
    match variants.is_empty() {
        // JSON has no NaN or infinity, so the representation stores these numbers as texts.
        true => vec![Value::from(format!("{text}x")), Value::from(2.5)],
        false => variants.iter().map(|other| Value::from(other.as_str())).collect(),
    }
}

/// Returns the variant names of the enumeration at a leaf, which the deserializer lists in its error message about an
/// unknown name. Returns an empty list if the leaf is not an enumeration.
fn variants(pointer: &str, root: &mut Value) -> Vec<String> {
    let target = root.pointer_mut(pointer).expect("a leaf");
    let before = std::mem::replace(target, Value::from("no alternative"));
    let error = Catalog::deserialize(&*root).err().map(|error| error.to_string()).unwrap_or_default();
    *root.pointer_mut(pointer).expect("a leaf") = before;
    match error.split_once("unknown variant") {
        Some((_, list)) => list.split('`').skip(3).step_by(2).map(str::to_owned).collect(),
        None => Vec::new(),
    }
}

/// Returns the list without its first element, the list without its last element, and `null` in place of the list.
/// Returns nothing for an empty list.
fn shorter(list: &[Value]) -> Vec<Value> {
    match list {
        [] => Vec::new(),
        [_] => vec![Value::Array(Vec::new()), Value::Null],
        [_, rest @ ..] => vec![Value::from(rest.to_vec()), Value::from(list[..list.len() - 1].to_vec()), Value::Null],
    }
}

/// Returns the other variants: variants without content, and variants with the same content.
fn alternatives(content: &Value, variants: &[String]) -> Vec<Value> {
    let with_content = variants.iter().map(|name| Value::from_iter([(name.clone(), content.clone())]));
    with_content.chain(variants.iter().map(|name| Value::from(name.as_str()))).collect()
}
