//! Deferred Ctrl-C. After Ctrl-C, a command that writes to a device ends between two writes, and reports what it has
//! written. `monitor` completes its output before it ends.

use std::sync::atomic::{AtomicBool, Ordering};

/// True while Ctrl-C is deferred.
static DEFERS: AtomicBool = AtomicBool::new(false);
/// True if Ctrl-C was pressed while it was deferred.
static IS_REQUESTED: AtomicBool = AtomicBool::new(false);

/// Records Ctrl-C if it is deferred. Returns whether it is deferred. A second Ctrl-C is not deferred.
pub(super) fn is_deferred() -> bool {
    DEFERS.load(Ordering::SeqCst) && !IS_REQUESTED.swap(true, Ordering::SeqCst)
}

/// Defers Ctrl-C until the guard is dropped.
#[cfg(feature = "bus")]
pub(super) struct Deferred;

#[cfg(feature = "bus")]
impl Deferred {
    pub(super) fn new() -> Self {
        DEFERS.store(true, Ordering::SeqCst);
        Deferred
    }

    /// Returns whether Ctrl-C was pressed while it was deferred.
    pub(super) fn is_requested(&self) -> bool {
        IS_REQUESTED.load(Ordering::SeqCst)
    }
}

#[cfg(feature = "bus")]
impl Drop for Deferred {
    fn drop(&mut self) {
        DEFERS.store(false, Ordering::SeqCst);
    }
}
