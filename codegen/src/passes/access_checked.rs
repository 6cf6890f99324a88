//! After this pass the access of every item was held against what is said of its storage, its PDOs and its limits.

use crate::diagnostics::{codes, Code, Diagnostic, Diagnostics};
use crate::ir::owner::Owner;
use crate::ir::{Item, Storage, Value};
use crate::source::Span;
use crate::text::brief;

/// Of other formats than tables, what contradicts itself is told to those who ask: 52 files of the corpus say that values which
/// can't be written come in RPDOs.
pub(super) fn run(owner: Owner<'_>, is_table: bool, diagnostics: &mut Diagnostics) {
    let wants_conflicts = is_table || diagnostics.asks_for(&codes::ACCESS_CONFLICT);
    for item in owner.items() {
        for (code, span, problem) in problems(owner, item).into_iter().flatten() {
            if !wants_conflicts && code == &codes::ACCESS_CONFLICT {
                continue;
            }
            let message = format!("`{}` is {} and {problem}", brief(&item.name), item.access.name());
            let found = Diagnostic::new(code, span.or(item.at.access).or(item.origin.span), message);
            diagnostics.push(match code == &codes::ACCESS_CONFLICT {
                true => {
                    found.help("one of the two is misprinted: keep what the manual's text supports, with a `doubt`")
                }
                false => {
                    found.help("if it can be zero, the limit is that of a set-point; if not, the type is unsigned")
                }
            });
        }
    }
}

type Problem = Option<(&'static Code, Span, String)>;

fn problems(owner: Owner<'_>, item: &Item) -> [Problem; 4] {
    let (readable, writable) = (item.access.readable(), item.access.writable());
    let conflict = |span, text: &str| Some((&codes::ACCESS_CONFLICT, span, text.to_owned()));
    let behaviour = item.behaviour.as_deref();
    let is_saved = behaviour.is_some_and(|own| matches!(own.storage, Storage::Immediate | Storage::OnCommand(_)));
    let saved = match behaviour {
        Some(_) if is_saved && !writable => conflict(Span::default(), "saved, though nobody can write it"),
        Some(own) if is_saved && own.self_clearing => conflict(Span::default(), "saved, though the device clears it"),
        _ => None,
    };
    let mapped = match item.mappable {
        own if own.rpdo && !writable => conflict(item.at.mappable, "may come in an RPDO"),
        own if own.tpdo && !readable => conflict(item.at.mappable, "may go into a TPDO"),
        _ => None,
    };
    let written = behaviour.filter(|own| !writable && !own.writable_values.is_empty());
    let written = written.and_then(|_| conflict(Span::default(), "has values that may be written"));
    [saved, mapped, written, reading(owner, item)]
}

/// What is measured passes through zero, or it would need no sign.
fn reading(owner: Owner<'_>, item: &Item) -> Problem {
    let low = item.limits.low.as_ref().and_then(Value::as_int).filter(|&low| low > 0)?;
    let high = item.limits.high.as_ref().and_then(Value::as_int);
    let is_measured = owner.basic(item.ty).is_signed() && !item.access.writable() && high != Some(low);
    let problem = || format!("signed, and has the lower limit {low}");
    is_measured.then(|| (&codes::READING_LIMITS, item.at.low, problem()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ir::{Access, Behaviour, Binding, Mappable, Type};

    fn found(change: impl FnOnce(&mut Item)) -> Vec<&'static str> {
        let mut item = Item::new(Binding::canopen(0x2000, 0));
        item.ty = Type::Integer(16);
        change(&mut item);
        let problems = problems(Owner { types: &[], groups: &[] }, &item);
        problems.into_iter().flatten().map(|(code, ..)| code.id).collect()
    }

    #[test]
    fn what_nobody_can_write_is_neither_saved_nor_received() {
        let save = |item: &mut Item| {
            item.behaviour = Some(Box::new(Behaviour { storage: Storage::Immediate, ..Behaviour::default() }));
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
    fn what_is_measured_passes_through_zero() {
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
