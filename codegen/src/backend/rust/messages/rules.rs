//! How parameters stand in messages: a constant for each space of numbers.

use crate::backend::rust::context::Context;
use crate::backend::rust::docs;
use crate::backend::rust::links::Here;
use crate::ir::{Device, ParameterSpace, Type};
use crate::names::{self, Case, Wish};
use crate::resolve::messages::{numbered, Step};

/// The longest name: the lines that use it have to stay below the margin.
const MAX_NAME: usize = 24;

/// A constant, ready to be written.
pub(in crate::backend::rust) struct RuleModel {
    pub name: String,
    pub space: String,
    pub docs: String,
    pub code_bits: u32,
    pub order: String,
    /// First and last number, and how many bytes their values have.
    pub lengths: Vec<String>,
}

/// All constants.
#[derive(Default)]
pub(in crate::backend::rust) struct Rules {
    pub models: Vec<RuleModel>,
}

impl Rules {
    /// Those that these steps need, beside types of these names.
    pub(super) fn new<'a>(
        context: &Context<'_>,
        device: &Device,
        steps: impl Iterator<Item = &'a Step<'a>>,
        types: &[&str],
    ) -> Self {
        let mut used: Vec<(&str, u32)> = Vec::new();
        for step in steps {
            let own = match step {
                Step::Setting { bits, space } | Step::Blank { bits, space } | Step::Settings { bits, space, .. } => {
                    (*space, *bits)
                }
                Step::ValueOnly { bits, space } => (*space, *bits),
                _ => continue,
            };
            if !used.contains(&own) {
                used.push(own);
            }
        }
        let wish = |(space, bits): &(&'a str, u32)| Wish {
            name: space,
            fallback: "space".to_owned(),
            suffix: bits.to_string(),
        };
        let wishes: Vec<Wish<'_>> = used.iter().map(wish).collect();
        // A type of one letter, or of digits, is written like a constant.
        let shouted = types.iter().filter(|name| name.to_ascii_uppercase() == **name);
        let types: Vec<String> = shouted.map(|name| name.to_ascii_lowercase()).collect();
        let mut reserved = vec!["framing", "max_data"];
        reserved.extend(types.iter().map(String::as_str));
        let names = names::unique_up_to(&wishes, &reserved, Case::Snake, MAX_NAME);
        let models = used.iter().zip(names).map(|((space, bits), name)| {
            let own = device.parameter_spaces.iter().find(|own| own.name == *space);
            let order = own.map(|own| own.byte_order.iter().map(u8::to_string).collect::<Vec<_>>().join(", "));
            RuleModel {
                name: name.to_ascii_uppercase(),
                space: (*space).to_owned(),
                docs: documentation(context, own, space),
                code_bits: *bits,
                order: order.unwrap_or_default(),
                lengths: lengths(context, device, space),
            }
        });
        Rules { models: models.collect() }
    }

    /// The name of the constant for a space, and numbers of so many bits; of any, where these don't matter.
    pub(super) fn name(&self, space: &str, bits: Option<u32>) -> &str {
        let fits = |own: &&RuleModel| own.space == space && bits.is_none_or(|bits| own.code_bits == bits);
        self.models.iter().find(fits).map_or("", |own| own.name.as_str())
    }
}

/// What is said of a constant.
fn documentation(context: &Context<'_>, own: Option<&ParameterSpace>, space: &str) -> String {
    let mut text = format!("How parameters of the space {} stand in messages.", docs::escape(space));
    let messages = own.map_or([None, None], |own| [own.read.as_ref(), own.write.as_ref()]);
    for (name, by) in messages.into_iter().zip(["Read", "Written"]) {
        if let Some(path) = name.and_then(|message| context.links.path(message.id?.into())) {
            text += &format!(" {by} by {}.", Here::MESSAGES.code(path));
        }
    }
    text
}

/// Neighbouring numbers whose values have one length.
fn lengths(context: &Context<'_>, device: &Device, space: &str) -> Vec<String> {
    let mut spans: Vec<(u32, u32, u32)> = Vec::new();
    for (code, item) in numbered(device, space) {
        let Some(length) = length(context.base(item.ty)) else { continue };
        match spans.last_mut() {
            Some((_, last, own)) if last.checked_add(1) == Some(code) && *own == length => *last = code,
            _ => spans.push((code, code, length)),
        }
    }
    let one =
        |(first, last, length): &(u32, u32, u32)| format!("({first:#X}, {last:#X}, {length})").replace("0X", "0x");
    spans.iter().map(one).collect()
}

/// How many bytes a value of a type has; `None` where that isn't fixed, or they are more than 8.
fn length(ty: Type) -> Option<u32> {
    ty.bits().map(|bits| bits.div_ceil(8)).filter(|length| (1..=8).contains(length))
}
