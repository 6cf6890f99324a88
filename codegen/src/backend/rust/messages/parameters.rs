//! The messages that read and write numbered parameters one by one.

use super::rules::Rules;
use super::MessageModel;
use crate::backend::rust::code::{call, Doc};
use crate::ir::Device;
use crate::resolve::messages::{carriers, Shaped, Step};

/// The implementation of `ParameterMessages`, ready to be written.
#[derive(Default)]
pub(in crate::backend::rust) struct ParametersModel {
    pub read: Vec<Arm>,
    pub write: Vec<Arm>,
}

/// The parameters of a space, and their message.
pub(in crate::backend::rust) struct Arm {
    /// The constant that knows them.
    pub rule: String,
    /// The type of the message.
    pub message: String,
    /// How it is made.
    pub build: Vec<(String, Doc)>,
    /// The value in the reply.
    pub value: String,
}

/// `None` where no parameter is read or written by messages.
pub(super) fn model(
    device: &Device,
    shapes: &[Shaped<'_>],
    messages: &[MessageModel],
    rules: &Rules,
) -> Option<ParametersModel> {
    let mut model = ParametersModel::default();
    let at = |at: usize| Some((shapes.get(at)?, messages.get(at)?));
    for own in carriers(device, shapes) {
        let rule = rules.name(own.space, None);
        model.read.extend(own.read.and_then(at).and_then(|own| reading(own, rule, rules)));
        model.write.extend(own.write.and_then(at).and_then(|own| writing(own, rule, rules)));
    }
    (!model.read.is_empty() || !model.write.is_empty()).then_some(model)
}

fn reading((shape, model): (&Shaped<'_>, &MessageModel), rule: &str, rules: &Rules) -> Option<Arm> {
    let (request, reply) = (model.request.as_ref()?, model.reply.as_ref()?);
    let field = request.fields.first()?;
    let build = (field.name.clone(), Doc::from("parameter"));
    let steps = shape.reply.steps.iter();
    let mut value = steps.filter_map(|step| match step {
        Step::Setting { space, .. } => Some((true, *space)),
        Step::ValueOnly { space, .. } => Some((false, *space)),
        _ => None,
    });
    let (with_number, space) = value.next_back()?;
    let field = &reply.fields.iter().rfind(|field| field.is_value_of(space))?.name;
    let value = match with_number {
        true => format!("reply.{field}.copy(parameter, value)"),
        false => format!("{}.copy(reply.{field}, value)", rules.name(space, None)),
    };
    Some(Arm { rule: rule.to_owned(), message: request.name.clone(), build: vec![build], value })
}

fn writing((shape, model): (&Shaped<'_>, &MessageModel), rule: &str, rules: &Rules) -> Option<Arm> {
    let request = model.request.as_ref()?;
    let name = &request.fields.first()?.name;
    let build = shape.request.steps.iter().find_map(|step| match step {
        Step::Setting { .. } => Some((name.clone(), Doc::from("settings[0]"))),
        Step::Settings { bits, space, .. } => {
            let rule = rules.name(space, Some(*bits));
            Some((name.clone(), call!("rt::message::Settings::sent", "&settings", rule)))
        }
        _ => None,
    });
    Some(Arm { rule: rule.to_owned(), message: request.name.clone(), build: vec![build?], value: String::new() })
}
