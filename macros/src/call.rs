//! Parser of the macro's arguments.

use lexibus_codegen::compile::{self, Options};
use lexibus_codegen::diagnostics::Levels;
use lexibus_codegen::text::similar;
use lexibus_codegen::{Level, Presence};
use syn::parse::{Parse, ParseStream};
use syn::{Attribute, Ident, LitBool, LitStr, Token, Visibility};

/// Names of the options.
pub const OPTIONS: [&str; 20] = [
    "device",
    "module",
    "objects",
    "option",
    "overlay",
    "profiles",
    "device_name",
    "runtime",
    "accessors",
    "pdos",
    "table",
    "debug",
    "partial_eq",
    "defmt",
    "serde",
    "strict",
    "node_id_alias",
    "allow",
    "warn",
    "deny",
];

/// Arguments of the macro: `#[…] pub mod name = "path" { option: value, … };`
pub struct Call {
    pub attributes: Vec<Attribute>,
    pub visibility: Visibility,
    pub name: Ident,
    pub path: LitStr,
    pub options: Options,
    /// Paths of the overlay files.
    pub overlays: Vec<LitStr>,
}

impl Parse for Call {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        let attributes = input.call(Attribute::parse_outer)?;
        let visibility = input.parse()?;
        input.parse::<Token![mod]>()?;
        let name = input.parse()?;
        input.parse::<Token![=]>()?;
        let path: LitStr = input.parse()?;
        let (mut options, mut overlays) = (Options::default(), Vec::new());
        if input.peek(syn::token::Brace) {
            let content;
            syn::braced!(content in input);
            parse_options(&content, &mut options, &mut overlays)?;
            input.parse::<Option<Token![;]>>()?;
        } else if input.is_empty() {
            // The end of the input has no position.
            return Err(syn::Error::new(path.span(), "expected `;` or options in braces after this path"));
        } else {
            input.parse::<Token![;]>()?;
        }
        Ok(Call { attributes, visibility, name, path, options, overlays })
    }
}

fn parse_options(input: ParseStream<'_>, options: &mut Options, overlays: &mut Vec<LitStr>) -> syn::Result<()> {
    let mut levels = Vec::new();
    let mut strict = false;
    while !input.is_empty() {
        let key: Ident = input.parse()?;
        input.parse::<Token![:]>()?;
        match key.to_string().as_str() {
            "device" => {
                let filter = input.parse::<LitStr>()?;
                let parsed = filter.value().parse().map_err(|error| syn::Error::new(filter.span(), error))?;
                options.select.devices.push(parsed);
            }
            "module" => options.select.modules.push(input.parse::<LitStr>()?.value().as_str().into()),
            "objects" => {
                let filter = input.parse::<LitStr>()?;
                let parsed = filter.value().parse().map_err(|error| syn::Error::new(filter.span(), error))?;
                options.select.objects.push(parsed);
            }
            "option" => {
                let text = input.parse::<LitStr>()?;
                let choice = compile::choice(&text.value());
                let choice = choice.ok_or_else(|| syn::Error::new(text.span(), "write `option: \"NAME=CHOICE\"`"))?;
                options.choices.push(choice);
            }
            "overlay" => overlays.push(input.parse()?),
            "profiles" => options.no_profiles = !input.parse::<LitBool>()?.value,
            "device_name" => options.rust.device_name = Some(input.parse::<LitStr>()?.value()),
            "runtime" => options.rust.runtime = input.parse::<LitStr>()?.value(),
            "accessors" => options.rust.accessors = input.parse::<LitBool>()?.value,
            "pdos" => options.rust.pdos = input.parse::<LitBool>()?.value,
            "table" => options.rust.table = presence(input)?,
            "debug" => options.rust.debug = presence(input)?,
            "partial_eq" => options.rust.partial_eq = presence(input)?,
            "defmt" => options.rust.defmt = presence(input)?,
            "serde" => options.rust.serde = presence(input)?,
            "strict" => strict = input.parse::<LitBool>()?.value,
            "node_id_alias" => options.node_id_aliases.push(input.parse::<LitStr>()?.value()),
            "allow" => levels.push((input.parse::<LitStr>()?, Level::Allow)),
            "warn" => levels.push((input.parse::<LitStr>()?, Level::Warn)),
            "deny" => levels.push((input.parse::<LitStr>()?, Level::Deny)),
            other => return Err(syn::Error::new(key.span(), unknown(other))),
        }
        if !input.is_empty() {
            input.parse::<Token![,]>()?;
        }
    }
    options.levels = if strict { Levels::strict() } else { Levels::lenient() };
    for (code, level) in levels {
        options.levels.set(&code.value(), level).map_err(|error| syn::Error::new(code.span(), error))?;
    }
    Ok(())
}

/// Returns the error message for an unknown option.
fn unknown(option: &str) -> String {
    match similar(option, OPTIONS.into_iter()) {
        Some(known) => format!("unknown option `{option}`; did you mean `{known}`?"),
        None => format!("unknown option `{option}`; the options are {}", OPTIONS.join(", ")),
    }
}

/// Parses the value of an option: `true`, `false`, or the name of the cargo feature that enables the code.
fn presence(input: ParseStream<'_>) -> syn::Result<Presence> {
    if input.peek(LitBool) {
        let always = input.parse::<LitBool>()?.value;
        return Ok(if always { Presence::Always } else { Presence::Never });
    }
    if !input.peek(LitStr) {
        return Err(input.error("expected `true`, `false`, or the name of a cargo feature as a string"));
    }
    let feature = input.parse::<LitStr>()?;
    let help = match feature.value().to_ascii_lowercase().as_str() {
        "true" | "yes" | "always" => "write `true` without quotes",
        "false" | "no" | "never" => "write `false` without quotes",
        name if is_feature_name(name) => return Ok(Presence::Feature(feature.value())),
        _ => "expected `true`, `false`, or the name of a cargo feature",
    };
    Err(syn::Error::new(
        feature.span(),
        format!("`{}` cannot be used as the name of a cargo feature: {help}", feature.value()),
    ))
}

/// Returns whether cargo and crates.io accept a feature with this name. Cargo also accepts letters other than ASCII,
/// but crates.io rejects such names.
fn is_feature_name(name: &str) -> bool {
    let is_first = |c: char| c.is_ascii_alphanumeric() || c == '_';
    name.starts_with(is_first) && name.chars().all(|c| is_first(c) || matches!(c, '-' | '+' | '.'))
}
