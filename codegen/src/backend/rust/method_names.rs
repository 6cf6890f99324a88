//! Names of methods and modules of objects: those that are taken, and those that `clippy` reads a meaning into.

/// Names that modules and methods of objects must not have: the device's own, those of methods that every type has by value, and those
/// that would hide a primitive type or the runtime.
pub(super) const RESERVED: [&str; 31] = [
    "types",
    "new",
    "axis",
    "client",
    "into_client",
    "into",
    "try_into",
    "objects",
    "mappable",
    "pdo",
    "rt",
    "bool",
    "char",
    "str",
    "u8",
    "u16",
    "u32",
    "u64",
    "u128",
    "usize",
    "i8",
    "i16",
    "i32",
    "i64",
    "i128",
    "isize",
    "f32",
    "f64",
    "self",
    "super",
    "crate",
];

/// Names that a device with messages uses itself, too.
pub(super) const BESIDE_MESSAGES: [&str; 3] = ["messages", "on", "after_power_on"];

/// The attribute that methods of these names need: clippy reads a meaning into some prefixes.
pub(super) fn method_allow<'n>(names: impl Iterator<Item = &'n str>) -> Option<String> {
    const PREFIXES: [&str; 5] = ["from_", "into_", "to_", "is_", "as_"];
    const TRAITS: [&str; 3] = ["next", "deref_mut", "borrow_mut"];
    let (mut conventions, mut traits) = (false, false);
    for name in names {
        conventions |= PREFIXES.iter().any(|prefix| name.starts_with(prefix));
        traits |= TRAITS.contains(&name);
    }
    match (conventions, traits) {
        (false, false) => None,
        (true, false) => Some("#[allow(clippy::wrong_self_convention)]".into()),
        (false, true) => Some("#[allow(clippy::should_implement_trait)]".into()),
        (true, true) => Some("#[allow(clippy::should_implement_trait, clippy::wrong_self_convention)]".into()),
    }
}

/// A name that isn't taken.
pub(super) fn beside(is_taken: impl Fn(&String) -> bool, mut name: String) -> String {
    while is_taken(&name) {
        name.push('_');
    }
    name
}
