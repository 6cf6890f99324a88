//! Encoding rules for parameters in messages. Each rule is a constant for one parameter space and one length of the
//! parameter numbers.

use crate::backend::rust::code::{seq, slice, Data, Declaration};
use crate::backend::rust::context::Context;
use crate::backend::rust::docs;
use crate::backend::rust::links::DocModule;
use crate::ir::{Device, ParameterSpace, SpaceRef, Type};
use crate::names::{self, Case, NameRequest};
use crate::number::hex;
use crate::resolve::messages::{numbered, Step};

/// Maximum length of a constant's name, without a suffix that makes the name unique. The limit keeps the generated
/// lines that use the constant short.
const MAX_NAME: usize = 24;

/// A constant with an encoding rule, ready to be printed.
pub(in crate::backend::rust) struct RuleModel {
    name: String,
    space: String,
    code_bits: u32,
    pub constant: Declaration,
}

/// The constants of all encoding rules.
#[derive(Default)]
pub(in crate::backend::rust) struct Rules {
    pub models: Vec<RuleModel>,
}

impl Rules {
    /// Creates the constants that these steps use. `types` contains the names of types in the same module.
    pub(super) fn new<'a>(
        context: &Context<'_>,
        device: &Device,
        steps: impl Iterator<Item = &'a Step<'a>>,
        types: &[&str],
    ) -> Self {
        let mut used: Vec<(&SpaceRef, u32)> = Vec::new();
        for step in steps {
            let space_and_bits = match step {
                Step::Setting { bits, space } | Step::Blank { bits, space } | Step::Settings { bits, space, .. } => {
                    (*space, *bits)
                }
                Step::ValueOnly { bits, space } => (*space, *bits),
                _ => continue,
            };
            if !used.contains(&space_and_bits) {
                used.push(space_and_bits);
            }
        }
        let name_request = |(space, bits): &(&'a SpaceRef, u32)| NameRequest {
            name: space,
            fallback: "space".to_owned(),
            suffix: bits.to_string(),
        };
        let name_requests = used.iter().map(name_request);
        // A type name of one letter, with or without digits after the letter, could also be the name of a constant.
        // Such type names are therefore reserved.
        let upper_case = types.iter().filter(|name| name.to_ascii_uppercase() == **name);
        let types: Vec<String> = upper_case.map(|name| name.to_ascii_lowercase()).collect();
        let mut reserved = vec!["framing", "max_data"];
        reserved.extend(types.iter().map(String::as_str));
        let names = names::unique_up_to(name_requests, &reserved, Case::Snake, MAX_NAME);
        let models = used.iter().zip(names).map(|((space, bits), name)| {
            let definition = device.parameter_space(space);
            let order = definition.map_or(&[][..], |definition| &definition.byte_order);
            let values = [
                ("code_bits", seq![*bits]),
                ("order", slice(order.iter().map(u8::to_string))),
                ("lengths", slice(lengths(context, device, space))),
            ];
            let (name, docs) = (name.to_ascii_uppercase(), documentation(context, definition, space));
            let start = seq!["const ", name, ": rt::message::SettingsRule"];
            let constant = Declaration::new([docs], start, Data::fields("rt::message::SettingsRule", values));
            RuleModel { name, space: space.to_string(), code_bits: *bits, constant }
        });
        Rules { models: models.collect() }
    }

    /// Returns the name of a space's constant for parameter numbers with this many bits. If `bits` is `None`, the
    /// number of bits does not matter.
    pub(super) fn name(&self, space: &str, bits: Option<u32>) -> &str {
        let fits = |model: &&RuleModel| model.space == space && bits.is_none_or(|bits| model.code_bits == bits);
        self.models.iter().find(fits).map_or("", |model| model.name.as_str())
    }
}

/// Returns the documentation of a rule's constant.
fn documentation(context: &Context<'_>, definition: Option<&ParameterSpace>, space: &str) -> String {
    let mut text = format!("Encoding in messages for parameters from the space \"{}\".", docs::escape(space));
    let messages = definition.map_or([None, None], |definition| [definition.read.as_ref(), definition.write.as_ref()]);
    for (name, verb) in messages.into_iter().zip(["reads", "writes"]) {
        if let Some(path) = name.and_then(|message| context.links.path(message.id?.into())) {
            text += &format!(" {} {verb} parameters.", DocModule::MESSAGES.code(path));
        }
    }
    text
}

/// Returns ranges of consecutive parameter numbers with values of the same length.
fn lengths(context: &Context<'_>, device: &Device, space: &SpaceRef) -> Vec<String> {
    let mut spans: Vec<(u32, u32, u32)> = Vec::new();
    for (code, item) in numbered(device, space) {
        let Some(length) = length(context.base(item.ty)) else { continue };
        match spans.last_mut() {
            Some((_, last, span_length)) if last.checked_add(1) == Some(code) && *span_length == length => *last = code,
            _ => spans.push((code, code, length)),
        }
    }
    let one = |&(first, last, length): &(u32, u32, u32)| format!("({}, {}, {length})", hex(first), hex(last));
    spans.iter().map(one).collect()
}

/// Returns the byte length of a value. Returns `None` if the length is variable or greater than 8.
fn length(ty: Type) -> Option<u32> {
    ty.bits().map(|bits| bits.div_ceil(8)).filter(|length| (1..=8).contains(length))
}
