//! What a user may choose about the generated Rust.

/// Whether something is part of the output.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Presence {
    /// It is.
    Always,
    /// It isn't.
    #[default]
    Never,
    /// It is where the crate that compiles the output has this feature.
    Feature(String),
}

/// What the generated Rust looks like.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RustOptions {
    /// Name of the device's type; from the name of the product where it is `None`.
    pub device_name: Option<String>,
    /// Path of the runtime crate.
    pub runtime: String,
    /// Whether there is a device type with an accessor method for every entry.
    pub accessors: bool,
    /// Whether there is a struct for every PDO.
    pub pdos: bool,
    /// The static table of all entries, for tools.
    pub table: Presence,
    /// `Debug` on generated types.
    pub debug: Presence,
    /// `PartialEq` on generated types.
    pub partial_eq: Presence,
    /// `defmt::Format` on generated types; the compiling crate needs `defmt`, and `lexibus` its feature of that name.
    pub defmt: Presence,
    /// `serde::Serialize` and `Deserialize` on generated types; the compiling crate needs `serde`, and `lexibus` its
    /// feature of that name.
    pub serde: Presence,
}

impl Default for RustOptions {
    fn default() -> Self {
        RustOptions {
            device_name: None,
            runtime: "::lexibus".to_owned(),
            accessors: true,
            pdos: true,
            table: Presence::Never,
            debug: Presence::Always,
            partial_eq: Presence::Always,
            defmt: Presence::Never,
            serde: Presence::Never,
        }
    }
}

/// Traits of `serde` end at arrays of this length.
const SERDE_ARRAY: u32 = 32;

impl RustOptions {
    /// What tells `serde` how to handle a field of so many bytes, where its own traits don't.
    pub(in crate::backend::rust) fn octets_attribute(&self, length: u32) -> Option<String> {
        if length <= SERDE_ARRAY {
            return None;
        }
        let path = super::literal::string(&format!("{}::octets", self.runtime));
        match &self.serde {
            Presence::Never => None,
            Presence::Always => Some(format!("#[serde(with = {path})]")),
            Presence::Feature(feature) => {
                Some(format!("#[cfg_attr(feature = {}, serde(with = {path}))]", super::literal::string(feature)))
            }
        }
    }

    /// The attribute lines in front of a generated type.
    pub(super) fn derives(&self, plain_data: bool) -> Vec<String> {
        let mut always = if plain_data { vec!["Clone", "Copy"] } else { Vec::new() };
        let mut gated = Vec::new();
        let mut add = |presence: &Presence, paths: &'static str| match presence {
            Presence::Always => always.push(paths),
            Presence::Never => {}
            Presence::Feature(feature) => {
                gated.push(format!("#[cfg_attr(feature = {}, derive({paths}))]", super::literal::string(feature)));
            }
        };
        add(&self.debug, "Debug");
        if plain_data {
            add(&self.partial_eq, "PartialEq");
            add(&self.defmt, "defmt::Format");
            add(&self.serde, "serde::Serialize, serde::Deserialize");
        }
        let mut lines = Vec::with_capacity(1 + gated.len());
        if !always.is_empty() {
            lines.push(format!("#[derive({})]", always.join(", ")));
        }
        lines.append(&mut gated);
        lines
    }
}
