//! Reports rows whose only limit is the minimum or maximum of the type: the cell of the other limit is probably empty
//! by mistake.

use crate::check::context::Context;
use crate::diagnostics::{codes, Diagnostics};
use crate::text::brief;

pub(crate) fn check(context: &Context<'_>, diagnostics: &mut Diagnostics) {
    let owner = context.owner;
    for item in owner.items() {
        let Some((minimum, maximum)) = owner.basic(item.ty).integer_range() else { continue };
        let (given, [stated, missing], span) = match (&item.limits.low, &item.limits.high, item.limits.integers()) {
            (Some(_), None, (low, _)) if low == Some(minimum) => (minimum, ["minimum", "maximum"], item.at.others.low),
            (None, Some(_), (_, high)) if high == Some(maximum) => {
                (maximum, ["maximum", "minimum"], item.at.others.high)
            }
            _ => continue,
        };
        let message =
            format!("`{}` has no {missing}, and its {stated} {given} is the {stated} of its type", brief(&item.name));
        diagnostics
            .push(codes::EMPTY_LIMIT.at(span.or(item.origin.span), message).help("write both limits, or neither"));
    }
}
