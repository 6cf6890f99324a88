//! A simulated node at the other end of a serial line, in a thread. The node's clock follows the real time.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use lexibus::clients::canopen::{CanFrame, CanPort};
use lexibus::sim::CanNode;

use super::NODE;
use crate::pty::Pty;
use crate::slcan::Slcan;

/// Time to wait for a frame before the thread advances the clock and checks whether the test has ended.
const POLL: Duration = Duration::from_millis(2);

/// Returns whether the line loses a frame. `number` is the position of the frame among the SDO requests to the node, or among all
/// other frames, starting at 1.
pub type Loses = fn(id: u32, number: usize) -> bool;

/// The simulated node on a serial line, in a thread.
pub struct Served {
    pub node: Arc<Mutex<CanNode>>,
    is_ended: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl Served {
    pub fn start(line: Pty, node: CanNode, loses: Loses) -> Self {
        let node = Arc::new(Mutex::new(node));
        let is_ended = Arc::new(AtomicBool::new(false));
        let (served, ended) = (node.clone(), is_ended.clone());
        let thread = thread::spawn(move || {
            let (mut line, mut requests, mut replies) = (Slcan::new(line), 0, 0);
            let mut is_lost = |frame: &CanFrame| {
                let count = if frame.id() == 0x600 + u32::from(NODE) { &mut requests } else { &mut replies };
                *count += 1;
                loses(frame.id(), *count)
            };
            let start = Instant::now();
            while !ended.load(Ordering::Relaxed) {
                let request = line.receive(POLL, &mut |_| true).expect("a line");
                let mut node = served.lock().expect("no panic");
                let late = start.elapsed().saturating_sub(node.now());
                node.advance(late);
                if let Some(request) = request.filter(|request| !is_lost(request)) {
                    node.handle(&request);
                }
                while let Some(reply) = node.next_frame() {
                    if !is_lost(&reply) {
                        assert!(line.send(&reply, Duration::from_secs(10)).expect("a line"), "the line is full");
                    }
                }
            }
        });
        Self { node, is_ended, thread: Some(thread) }
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        self.is_ended.store(true, Ordering::Relaxed);
        let result = self.thread.take().map_or(Ok(()), JoinHandle::join);
        assert!(result.is_ok() || thread::panicking(), "the thread of the node has panicked");
    }
}
