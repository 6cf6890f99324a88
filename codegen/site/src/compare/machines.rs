//! State machines and procedures.

use super::types::named;
use super::{by_name, Changes, Judgement};
use lexibus_codegen::facts::words::PLAIN;
use lexibus_codegen::ir::{Device, Pattern, Procedure, StateMachine};

pub(super) fn compare(old: &Device, new: &Device, changes: &mut Changes) {
    by_name("machine", (&old.machines, &new.machines), |own| &own.name, changes, machine);
    by_name("procedure", (&old.procedures, &new.procedures), |own| &own.name, changes, procedure);
}

fn machine((was, is): (&StateMachine, &StateMachine), element: &str, changes: &mut Changes) {
    let item = |own: &StateMachine| (own.status_item.to_string(), own.control_item.to_string());
    let ((status, control), (new_status, new_control)) = (item(was), item(is));
    changes.fact(element, "status", (status, new_status), Judgement::Breaking);
    changes.fact(element, "control", (control, new_control), Judgement::Breaking);
    // A further state: whoever matched all of them has one to add. Commands are only given.
    for (kind, old, new, of_new) in [
        ("state", &was.states, &is.states, Judgement::Breaking),
        ("command", &was.commands, &is.commands, Judgement::Compatible),
    ] {
        let key = |own: &Pattern| (format!("{kind} {}", own.name), own.name.to_string());
        named(old.iter().map(key), new.iter().map(key), element, of_new, changes);
        for (one, other) in old.iter().filter_map(|one| Some((one, new.iter().find(|other| other.name == one.name)?))) {
            let bits = |own: &Pattern| format!("0x{:X} of 0x{:X}", own.value, own.mask);
            let what = format!("{element}, {kind} {}", one.name);
            changes.fact(&what, "bits", (bits(one), bits(other)), Judgement::Compatible);
        }
    }
    let ways = |own: &StateMachine| {
        let way = |own: &lexibus_codegen::ir::Transition| {
            let from = own.from.as_deref().unwrap_or("any state");
            format!("{from} to {} by {}", own.to, own.command.as_deref().unwrap_or("itself"))
        };
        own.transitions.iter().map(way).collect::<Vec<_>>().join("; ")
    };
    changes.fact(element, "transitions", (ways(was), ways(is)), Judgement::Compatible);
}

fn procedure((was, is): (&Procedure, &Procedure), element: &str, changes: &mut Changes) {
    let arguments = |own: &Procedure| own.arguments.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
    changes.fact(element, "arguments", (arguments(was), arguments(is)), Judgement::Breaking);
    let steps = |own: &Procedure| own.steps.iter().map(|own| PLAIN.step(own)).collect::<Vec<_>>().join(" ");
    changes.fact(element, "steps", (steps(was), steps(is)), Judgement::Compatible);
}
