//! Reserved names of methods and of objects' types, and method names for which clippy expects a certain signature.

/// Keywords, and names that would hide a primitive type or the runtime.
const KEYWORDS: [&str; 21] = [
    "self", "super", "crate", "rt", "bool", "char", "str", "u8", "u16", "u32", "u64", "u128", "usize", "i8", "i16",
    "i32", "i64", "i128", "isize", "f32", "f64",
];

/// Names of methods and modules of the device, and of methods that all types have and that take `self` by value.
const METHODS: [&str; 10] =
    ["types", "new", "axis", "client", "into_client", "into", "try_into", "objects", "mappable", "pdo"];

/// Returns the names that objects' types and methods must not have.
pub(super) fn reserved<'n>() -> impl Iterator<Item = &'n str> {
    METHODS.into_iter().chain(KEYWORDS)
}

/// Additional reserved names if the device has messages.
pub(super) const RESERVED_WITH_MESSAGES: [&str; 3] = ["messages", "on", "after_power_on"];

/// Returns the `allow` attribute for methods with these names, if at least one name needs the attribute. The attribute
/// suppresses the clippy lints about prefixes such as `to_` and about names of trait methods such as `next`.
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

/// Appends underscores to `name` until it is unused.
pub(super) fn unused_name(is_used: impl Fn(&String) -> bool, mut name: String) -> String {
    while is_used(&name) {
        name.push('_');
    }
    name
}
