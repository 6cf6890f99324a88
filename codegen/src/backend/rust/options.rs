//! Options of the generated Rust code.

use crate::facts::configuration::Setting;

/// Specifies whether a part of the output is generated.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Presence {
    /// The part is generated unconditionally.
    Always,
    /// The part is not generated.
    #[default]
    Never,
    /// The part is generated with a `cfg` attribute. It is compiled only if this feature is enabled in the crate that
    /// contains the generated code.
    Feature(String),
}

/// Options of the generated Rust code.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RustOptions {
    /// Name of the device's type. `None` means that the name is derived from the order code of an EtherCAT device, the
    /// name of the device, or the file name.
    pub device_name: Option<String>,
    /// Path of the runtime crate in the generated code.
    pub runtime: String,
    /// True to generate a device type with an accessor method for every entry.
    pub accessors: bool,
    /// True to generate a struct for every PDO.
    pub pdos: bool,
    /// Specifies whether the output contains a static table of all entries, for tools.
    pub table: Presence,
    /// Specifies whether generated types implement `Debug`, and whether their other text traits, such as `Display` and
    /// `FromStr`, are generated.
    pub debug: Presence,
    /// Specifies whether generated types implement `PartialEq` and, if their values are integers, `Eq` and `Hash`.
    pub partial_eq: Presence,
    /// Specifies whether generated types implement `defmt::Format`. The crate that contains the generated code needs
    /// the dependency `defmt`, and the feature `defmt` of `lexibus`.
    pub defmt: Presence,
    /// Specifies whether generated types implement `serde::Serialize` and `serde::Deserialize`. The crate that contains
    /// the generated code needs the dependency `serde`, and the feature `serde` of `lexibus`.
    pub serde: Presence,
    /// Values that a network file configures for the device, in the order in which a program writes them. The constant
    /// `CONFIGURATION` contains these values. If this option is `None`, the constant contains the values that the
    /// description configures.
    pub configuration: Option<Vec<Setting>>,
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
            configuration: None,
        }
    }
}

/// Maximum length of the arrays for which `serde` implements its traits.
const SERDE_ARRAY: u32 = 32;

impl RustOptions {
    /// Returns the attribute that makes `serde` support a field with this many bytes. Returns `None` if the field needs
    /// no attribute.
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

    /// Returns the line with the `cfg` attribute of a part, or no line if the part is generated unconditionally.
    /// Returns `None` if the part is not generated.
    pub(super) fn gate(presence: &Presence) -> Option<Vec<String>> {
        match presence {
            Presence::Never => None,
            Presence::Always => Some(Vec::new()),
            Presence::Feature(feature) => Some(vec![format!("#[cfg(feature = {})]", super::literal::string(feature))]),
        }
    }

    /// Returns the lines with the `derive` attributes of a generated type.
    pub(super) fn derives(&self, plain_data: bool) -> Vec<String> {
        self.derives_with(plain_data, Some("PartialEq"))
    }

    /// Returns the lines with the `derive` attributes of a generated type whose values are integers.
    pub(super) fn derives_of_integers(&self) -> Vec<String> {
        self.derives_with(true, Some("PartialEq, Eq, Hash"))
    }

    /// Returns the lines with the `derive` attributes of a generated type whose equality traits are not derived.
    /// Generated implementations compare the numbers of its values instead.
    pub(super) fn derives_without_equality(&self) -> Vec<String> {
        self.derives_with(true, None)
    }

    fn derives_with(&self, plain_data: bool, equality: Option<&'static str>) -> Vec<String> {
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
            if let Some(equality) = equality {
                add(&self.partial_eq, equality);
            }
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
