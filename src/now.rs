//! Runs futures that are ready at the first poll, without an async runtime. The tests use this module.

use core::future::Future;
use core::pin::pin;
use core::task::{Context, Poll};
use std::sync::Arc;
use std::task::Wake;

/// Returns the output of a future that is ready at the first poll.
pub(crate) fn now<F: Future>(future: F) -> F::Output {
    struct Silent;
    impl Wake for Silent {
        fn wake(self: Arc<Self>) {}
    }
    match pin!(future).poll(&mut Context::from_waker(&Arc::new(Silent).into())) {
        Poll::Ready(output) => output,
        Poll::Pending => panic!("the future waits"),
    }
}
