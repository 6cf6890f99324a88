//! Rows whose only limit is that of their type: it says nothing, and the cell of the other limit is empty.

use crate::check::context::Context;
use crate::diagnostics::{codes, Diagnostic, Diagnostics};
use crate::ir::Value;
use crate::text::brief;

pub(crate) fn check(context: &Context<'_>, diagnostics: &mut Diagnostics) {
    let owner = context.owner;
    for item in owner.items() {
        let Some((least, greatest)) = owner.basic(item.ty).integer_range() else { continue };
        let number = |limit: &Option<Value>| limit.as_ref().and_then(Value::as_int);
        let (low, high) = (number(&item.limits.low), number(&item.limits.high));
        let (given, missing, span) = match (&item.limits.low, &item.limits.high) {
            (Some(_), None) if low == Some(least) => (least, "upper", item.at.low),
            (None, Some(_)) if high == Some(greatest) => (greatest, "lower", item.at.high),
            _ => continue,
        };
        let message =
            format!("`{}` has the limit {given}, which is that of its type, and no {missing} one", brief(&item.name));
        let found = Diagnostic::new(&codes::EMPTY_LIMIT, span.or(item.origin.span), message);
        diagnostics.push(found.help("give both, or none"));
    }
}
