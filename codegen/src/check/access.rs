//! Access rights that contradict storage, PDO mapping or limits.

use super::context::Context;
use crate::diagnostics::{codes, Diagnostics};
use crate::ir::owner::Owner;
use crate::ir::{stated, Item, Storage};
use crate::source::Span;
use crate::text::brief;

/// Reports items whose access rights contradict their storage, PDO mapping or writable values. Also reports
/// non-volatile items that the device clears. Such conflicts occur in real files: in 52 files of the test corpus,
/// read-only items can be mapped into RPDOs.
pub(super) fn conflicts(context: &Context<'_>, diagnostics: &mut Diagnostics) {
    for item in context.owner.items() {
        for (span, problem) in contradictions(item).into_iter().flatten() {
            let message = format!("`{}` is {}{problem}", brief(&item.name), item.access.name());
            let found = codes::ACCESS_CONFLICT.at(access_span(item, span), message);
            let help = "check both facts in the manual, correct the wrong one, and add a `doubt`";
            diagnostics.push(found.help(help));
        }
    }
}

/// Reports signed measured values whose minimum is above zero.
pub(super) fn readings(context: &Context<'_>, diagnostics: &mut Diagnostics) {
    for item in context.owner.items() {
        let Some(low) = positive_limit_of_reading(context.owner, item) else { continue };
        let (name, access) = (brief(&item.name), item.access.name());
        let message = format!("`{name}` is {access} and signed, but its minimum {low} is above zero");
        let help =
            "remove the minimum if it belongs to a setpoint and the value can be zero; otherwise use an unsigned type";
        diagnostics.push(codes::READING_LIMITS.at(access_span(item, item.at.others.low), message).help(help));
    }
}

fn access_span(item: &Item, span: Span) -> Span {
    span.or(item.at.access).or(item.origin.span)
}

/// Returns texts about contradictory facts of an item, with their locations. If a location is empty, the location of
/// the access rights applies.
fn contradictions(item: &Item) -> [Option<(Span, &'static str)>; 3] {
    let (readable, writable) = (item.access.readable(), item.access.writable());
    let conflict = |span, text| Some((span, text));
    let behavior = stated::behavior(item);
    let saved = behavior.filter(|behavior| matches!(behavior.storage, Storage::Immediate | Storage::OnCommand(_)));
    let saved = match saved {
        Some(_) if !writable => conflict(Span::default(), ", but declared as non-volatile"),
        Some(saved) if saved.self_clearing => conflict(Span::default(), " and non-volatile, but the device clears it"),
        _ => None,
    };
    let mapped = match item.mappable {
        mappable if mappable.rpdo && !writable => conflict(item.at.mappable, ", but can be mapped into an RPDO"),
        mappable if mappable.tpdo && !readable => conflict(item.at.mappable, ", but can be mapped into a TPDO"),
        _ => None,
    };
    let is_written = !writable && behavior.is_some_and(|behavior| !behavior.writable_values.is_empty());
    let written = is_written.then_some((Span::default(), ", but has a list of writable values"));
    [saved, mapped, written]
}

/// Returns the minimum of a signed measured value if this minimum is above zero. Signed measured values normally pass through
/// zero.
fn positive_limit_of_reading(owner: Owner<'_>, item: &Item) -> Option<i128> {
    let (low, high) = item.limits.integers();
    let is_measured = owner.basic(item.ty).is_signed() && !item.access.writable() && high != low;
    low.filter(|&low| low > 0 && is_measured)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ir::{Access, Behavior, Binding, Mappable, Type, Value};

    fn found(change: impl FnOnce(&mut Item)) -> Vec<&'static str> {
        let mut item = Item::new(Binding::canopen(0x2000, 0));
        item.ty = Type::Integer(16);
        change(&mut item);
        let conflicts = contradictions(&item).into_iter().flatten().map(|_| codes::ACCESS_CONFLICT.id);
        let reading = positive_limit_of_reading(Owner::of_types(&[]), &item).map(|_| codes::READING_LIMITS.id);
        conflicts.chain(reading).collect()
    }

    #[test]
    fn read_only_values_are_neither_saved_nor_received() {
        let save = |item: &mut Item| {
            item.behavior = Some(Box::new(Behavior { storage: Storage::Immediate, ..Behavior::default() }));
        };
        assert_eq!(found(|_| {}), [""; 0]);
        assert_eq!(found(save), ["TAB024"]);
        assert_eq!(
            found(|item| {
                save(item);
                item.access = Access::ReadWrite;
            }),
            [""; 0]
        );
        assert_eq!(found(|item| item.mappable = Mappable { rpdo: true, tpdo: true }), ["TAB024"]);
        assert_eq!(
            found(|item| {
                item.access = Access::WriteOnly;
                item.mappable.tpdo = true;
            }),
            ["TAB024"]
        );
    }

    #[test]
    fn signed_measured_values_pass_through_zero() {
        let limits = |low| move |item: &mut Item| item.limits.low = Some(Value::Int(low));
        assert_eq!(found(limits(1)), ["TAB023"]);
        assert_eq!(found(limits(0)), [""; 0]);
        assert_eq!(
            found(|item| {
                limits(1)(item);
                item.ty = Type::Unsigned(16);
            }),
            [""; 0]
        );
    }
}
