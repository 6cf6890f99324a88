//! Selection of the messages that an injected fault affects.

use core::fmt;
use std::boxed::Box;
use std::vec::Vec;

/// Faults of type `F` with the messages of type `M` that they affect.
pub(super) struct Faults<F, M: ?Sized> {
    rules: Vec<Rule<F, M>>,
}

struct Rule<F, M: ?Sized> {
    fault: F,
    affected: Affected<F, M>,
}

enum Affected<F, M: ?Sized> {
    /// One of the messages for which the function returns true: 1 is the next one.
    Nth(u64, fn(&F, &M) -> bool),
    /// All messages for which the function returns true.
    Selected(Box<dyn FnMut(&M) -> bool + Send>),
}

impl<F, M: ?Sized> Default for Faults<F, M> {
    fn default() -> Self {
        Self { rules: Vec::new() }
    }
}

impl<F: Clone, M: ?Sized> Faults<F, M> {
    /// Adds a fault that affects all messages that `selects` accepts.
    pub fn add(&mut self, fault: F, selects: impl FnMut(&M) -> bool + Send + 'static) {
        self.rules.push(Rule { fault, affected: Affected::Selected(Box::new(selects)) });
    }

    /// Adds a fault that affects the `n`th message from now on. The value 0 has the same effect as 1.
    pub fn add_nth(&mut self, fault: F, n: u64) {
        self.add_nth_of(fault, n, |_, _| true);
    }

    /// Adds a fault that affects the `n`th message from now on for which `is_counted` returns true. 0 has the same
    /// effect as 1.
    pub fn add_nth_of(&mut self, fault: F, n: u64, is_counted: fn(&F, &M) -> bool) {
        self.rules.push(Rule { fault, affected: Affected::Nth(n, is_counted) });
    }

    pub fn clear(&mut self) {
        self.rules.clear();
    }

    /// Returns the fault of the next message. If several faults affect the message, the first one that was added
    /// applies.
    pub fn next(&mut self, message: &M) -> Option<F> {
        let mut found = None;
        self.rules.retain_mut(|rule| {
            let (is_affected, remains) = match &mut rule.affected {
                Affected::Selected(selects) => (selects(message), true),
                Affected::Nth(_, is_counted) if !is_counted(&rule.fault, message) => (false, true),
                Affected::Nth(left, _) => {
                    *left = left.saturating_sub(1);
                    (*left == 0, *left > 0)
                }
            };
            if is_affected && found.is_none() {
                found = Some(rule.fault.clone());
            }
            remains
        });
        found
    }
}

impl<F: fmt::Debug, M: ?Sized> fmt::Debug for Faults<F, M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.rules.iter().map(|rule| &rule.fault)).finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_message_has_at_most_one_fault() {
        let mut faults = Faults::<char, u32>::default();
        assert_eq!(faults.next(&7), None);
        faults.add_nth('a', 3);
        faults.add_nth('b', 1);
        faults.add('c', |message| message % 2 == 0);
        let found: Vec<_> = [1, 2, 4, 5, 6].iter().map(|message| faults.next(message)).collect();
        assert_eq!(found, [Some('b'), Some('c'), Some('a'), None, Some('c')]);
        assert_eq!(std::format!("{faults:?}"), "['c']");
        faults.clear();
        assert_eq!(faults.next(&2), None);
    }
}
