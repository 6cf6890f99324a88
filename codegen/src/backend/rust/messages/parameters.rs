//! Messages that read or write a single numbered parameter.

use super::field::steps_with_field;
use super::rules::Rules;
use super::MessageModel;
use crate::backend::rust::code::{call, Doc};
use crate::ir::Device;
use crate::resolve::messages::{carriers, Shaped, Step};

/// The implementation of the trait `ParameterMessages`, ready to be printed.
#[derive(Default)]
pub(in crate::backend::rust) struct ParametersModel {
    pub read: Vec<Arm>,
    pub write: Vec<Arm>,
}

/// The message that reads or writes the parameters of a space.
pub(in crate::backend::rust) struct Arm {
    /// Name of the constant with the encoding rule of the parameter space.
    pub rule: String,
    /// Rust type of the message.
    pub message: String,
    /// Names and values of the message's fields.
    pub build: Vec<(String, Doc)>,
    /// Expression that returns the value from the reply. Empty for a message that writes.
    pub value: String,
}

/// Returns the implementation of the trait. Returns `None` if no message transfers a single parameter.
pub(super) fn model(
    device: &Device,
    shapes: &[Shaped<'_>],
    messages: &[MessageModel],
    rules: &Rules,
) -> Option<ParametersModel> {
    let mut model = ParametersModel::default();
    let find = |position: usize| Some((shapes.get(position)?, messages.get(position)?));
    for carrier in carriers(device, shapes) {
        let rule = rules.name(carrier.space, None);
        let reads = carrier.read.and_then(find).and_then(|(shape, model)| reading(shape, model, rule, rules));
        let writes = carrier.write.and_then(find).and_then(|(shape, model)| writing(shape, model, rule, rules));
        model.read.extend(reads);
        model.write.extend(writes);
    }
    (!model.read.is_empty() || !model.write.is_empty()).then_some(model)
}

fn reading(shape: &Shaped<'_>, model: &MessageModel, rule: &str, rules: &Rules) -> Option<Arm> {
    let (request, reply) = (model.request.as_ref()?, model.reply.as_ref()?);
    let field = request.fields.first()?;
    let build = (field.name.clone(), Doc::from("parameter"));
    let values = steps_with_field(&shape.reply.steps).zip(&reply.fields).filter_map(|(step, field)| match step {
        Step::Setting { .. } => Some(format!("reply.{}.copy(parameter, value)", field.name)),
        Step::ValueOnly { space, .. } => Some(format!("{}.copy(reply.{}, value)", rules.name(space, None), field.name)),
        _ => None,
    });
    let value = values.last()?;
    Some(Arm { rule: rule.to_owned(), message: request.name.clone(), build: vec![build], value })
}

fn writing(shape: &Shaped<'_>, model: &MessageModel, rule: &str, rules: &Rules) -> Option<Arm> {
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
