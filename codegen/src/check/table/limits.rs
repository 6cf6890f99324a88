//! Rows whose only limit is that of their type: it says nothing, and the cell of the other limit is empty.

use crate::check::context::Context;
use crate::diagnostics::{codes, Diagnostics};
use crate::text::brief;

pub(crate) fn check(context: &Context<'_>, diagnostics: &mut Diagnostics) {
    let owner = context.owner;
    for item in owner.items() {
        let Some((least, greatest)) = owner.basic(item.ty).integer_range() else { continue };
        let (given, missing, span) = match (&item.limits.low, &item.limits.high, item.limits.integers()) {
            (Some(_), None, (low, _)) if low == Some(least) => (least, "upper", item.at.low),
            (None, Some(_), (_, high)) if high == Some(greatest) => (greatest, "lower", item.at.high),
            _ => continue,
        };
        let message =
            format!("`{}` has the limit {given}, which is that of its type, and no {missing} one", brief(&item.name));
        diagnostics.push(codes::EMPTY_LIMIT.at(span.or(item.origin.span), message).help("give both, or none"));
    }
}
