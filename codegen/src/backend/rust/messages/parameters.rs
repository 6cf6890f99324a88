//! The messages that read and write numbered parameters.

use super::rules::{self, Rules};
use super::Shaped;
use crate::ir::{CompactString, Device};
use crate::passes::messages_shaped::Step;

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
    pub build: Vec<String>,
    /// The value in the reply.
    pub value: String,
}

/// `None` where no parameter is read or written by messages.
pub(super) fn model(device: &Device, shaped: &[Shaped<'_>], rules: &Rules) -> Option<ParametersModel> {
    let mut model = ParametersModel::default();
    for space in &device.parameter_spaces {
        let items = rules::parameters(device, &space.name);
        let rule = rules.name(&space.name, None);
        if items.is_empty() || rule.is_empty() {
            continue;
        }
        let rule = || rule.to_owned();
        let find = |name: &Option<CompactString>| shaped.iter().find(|own| Some(&own.message.name) == name.as_ref());
        if let Some((own, build)) = find(&space.read).and_then(|own| Some((own, request(own, rules, false)?))) {
            let value = value(own, rules);
            let message = own.names[0].clone();
            model.read.extend(value.map(|value| Arm { rule: rule(), message, build: vec![build], value }));
        }
        if let Some((own, build)) = find(&space.write).and_then(|own| Some((own, request(own, rules, true)?))) {
            model.write.push(Arm {
                rule: rule(),
                message: own.names[0].clone(),
                build: vec![build],
                value: String::new(),
            });
        }
    }
    (!model.read.is_empty() || !model.write.is_empty()).then_some(model)
}

/// The fields of the request; `None` where it has others than a parameter and its value.
fn request(own: &Shaped<'_>, rules: &Rules, writes: bool) -> Option<String> {
    let mut build = None;
    for step in &own.request.steps {
        match step {
            Step::Value { .. } | Step::Count { .. } | Step::List { .. } | Step::Rest | Step::ValueOnly { .. } => {
                return None
            }
            Step::Code { .. } | Step::Blank { .. } if !writes => build = Some("parameter".to_owned()),
            Step::Setting { .. } if writes => build = Some("setting: settings[0]".to_owned()),
            Step::Settings { bits, space, .. } if writes => {
                let rule = rules.name(space, Some(*bits));
                build = Some(format!("settings: rt::message::Settings::sent(«&settings¦ {rule}»)"));
            }
            Step::Code { .. } | Step::Blank { .. } | Step::Setting { .. } | Step::Settings { .. } => return None,
            _ => {}
        }
    }
    build
}

/// The expression that copies the value in the reply.
fn value(own: &Shaped<'_>, rules: &Rules) -> Option<String> {
    own.reply.steps.iter().find_map(|step| match step {
        Step::Setting { .. } => Some("reply.setting.copy(parameter, value)".to_owned()),
        Step::ValueOnly { space } => Some(format!("{}.copy(reply.value, value)", rules.name(space, None))),
        _ => None,
    })
}
