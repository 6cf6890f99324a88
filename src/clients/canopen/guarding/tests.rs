//! Tests of node guarding with a scripted node.

use core::task::{Context, Poll};
use std::vec::Vec;

use super::*;

const GUARD_TIME: Duration = Duration::from_millis(100);
const LOST: Result<NmtState, GuardError<()>> = Err(GuardError::NodeLost);
const NONE: Result<NmtState, GuardError<()>> = Err(GuardError::NoAnswer);

/// An interface with one node. Each element of `answers` is the reaction to one request.
struct Script {
    now: Duration,
    answers: Vec<Reaction>,
    waiting: Vec<(Duration, u8)>,
    requests: Vec<Duration>,
    /// True if an async call that waits for a frame never ends, so that a test can drop it.
    is_pending: bool,
}

#[derive(Clone, Copy)]
enum Reaction {
    Answer(u8),
    Late(u64, u8),
    Nothing,
    Busy,
    Broken,
}
use Reaction::{Answer, Broken, Busy, Late, Nothing};

impl CanPort for Script {
    type Error = ();

    fn send(&mut self, frame: &CanFrame, _: Duration) -> Result<bool, ()> {
        assert!(frame.is_remote());
        let reaction = if self.answers.is_empty() { Nothing } else { self.answers.remove(0) };
        let (delay, raw) = match reaction {
            Answer(raw) => (1, raw),
            Late(delay, raw) => (delay, raw),
            Nothing => (u64::MAX / 2, 0),
            Busy => return Ok(false),
            Broken => return Err(()),
        };
        self.requests.push(self.now);
        self.waiting.push((self.now + Duration::from_millis(delay), raw));
        Ok(true)
    }

    fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, ()> {
        let end = self.now + patience;
        self.waiting.sort_unstable();
        match self.waiting.first().copied().filter(|(time, _)| *time <= end) {
            Some((time, raw)) => {
                self.waiting.remove(0);
                self.now = self.now.max(time);
                Ok(Some(CanFrame::of(0x705, [raw])).filter(wanted))
            }
            None => {
                self.now = end;
                Ok(None)
            }
        }
    }

    fn now(&mut self) -> Option<Duration> {
        Some(self.now)
    }
}

impl AsyncCanPort for Script {
    type Error = ();

    async fn send(&mut self, frame: &CanFrame, patience: Duration) -> Result<bool, ()> {
        CanPort::send(self, frame, patience)
    }

    async fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, ()> {
        if self.is_pending && !patience.is_zero() {
            core::future::pending::<()>().await;
        }
        CanPort::receive(self, patience, wanted)
    }

    fn now(&mut self) -> Option<Duration> {
        Some(self.now)
    }
}

fn node(answers: &[Reaction]) -> Node<Script> {
    let id = NodeId::new(5).expect("a node-ID");
    let script = Script {
        now: Duration::ZERO,
        answers: answers.to_vec(),
        waiting: Vec::new(),
        requests: Vec::new(),
        is_pending: false,
    };
    Node::new(script, id)
}

/// Runs one cycle in each guard time, and returns the results.
fn cycles(node: &mut Node<Script>, guarding: &mut Guarding, count: u32) -> Vec<Result<NmtState, GuardError<()>>> {
    let mut results = Vec::new();
    for _ in 0..count {
        let end = node.port().now + GUARD_TIME;
        results.push(node.guard(guarding));
        assert!(node.port().now <= end, "a cycle takes at most the guard time");
        node.port().now = end;
    }
    results
}

fn run(answers: &[Reaction], factor: u8) -> Vec<Result<NmtState, GuardError<()>>> {
    cycles(&mut node(answers), &mut Guarding::new(GUARD_TIME, factor), answers.len() as u32)
}

const OPERATIONAL: Result<NmtState, GuardError<()>> = Ok(NmtState::Operational);
const TOGGLE_BIT: Result<NmtState, GuardError<()>> = Err(GuardError::ToggleBit);

#[test]
fn a_node_with_a_constant_toggle_bit_is_lost() {
    assert_eq!(run(&[Answer(5); 5], 3), [OPERATIONAL, TOGGLE_BIT, TOGGLE_BIT, LOST, LOST]);
    // Each answer is late.
    let results = run(&[Late(120, 5); 8], 3);
    assert_eq!(results.last(), Some(&LOST), "{results:?}");
}

#[test]
fn a_toggle_bit_is_wrong_only_once_after_a_missed_restart() {
    let results = run(&[Answer(5), Answer(0x85), Answer(0x85), Answer(5)], 3);
    assert_eq!(results, [OPERATIONAL, OPERATIONAL, TOGGLE_BIT, OPERATIONAL]);
}

#[test]
fn requests_that_are_not_sent_lead_to_a_lost_node() {
    let not_sent = Err(GuardError::NotSent);
    assert_eq!(run(&[Answer(5), Busy, Busy, Busy], 3), [OPERATIONAL, not_sent, not_sent, LOST]);
    let broken = Err(GuardError::Client(()));
    assert_eq!(run(&[Answer(5), Broken, Broken, Broken], 3), [OPERATIONAL, broken, broken, LOST]);
    assert_eq!(run(&[Answer(5), Busy, Nothing, Broken], 3), [OPERATIONAL, not_sent, NONE, LOST]);
}

#[test]
fn the_life_time_is_measured_with_the_clock() {
    let (mut node, mut guarding) = (node(&[Answer(5), Busy, Answer(0x85)]), Guarding::new(GUARD_TIME, 3));
    assert_eq!(node.guard(&mut guarding), OPERATIONAL);
    // The program was busy for longer than the life time.
    node.port().now += 4 * GUARD_TIME;
    assert_eq!((node.guard(&mut guarding), guarding.missed()), (LOST, 1));
    assert_eq!((node.guard(&mut guarding), guarding.missed()), (OPERATIONAL, 0));
}

#[test]
fn the_life_time_factor_is_at_least_1() {
    for factor in [0, 1] {
        let (mut node, mut guarding) = (node(&[Answer(5)]), Guarding::new(GUARD_TIME, factor));
        assert_eq!(guarding.life_time(), GUARD_TIME);
        assert_eq!([node.guard(&mut guarding), node.guard(&mut guarding)], [OPERATIONAL, LOST]);
    }
}

#[test]
fn a_dead_node_is_lost_after_its_life_time() {
    let (mut node, mut guarding) = (node(&[]), Guarding::new(GUARD_TIME, 3));
    let results = [(); 3].map(|()| node.guard(&mut guarding));
    assert_eq!((results, node.port().now), ([NONE, NONE, LOST], 3 * GUARD_TIME));
    // The node expects the next request within its life time, also after a lost answer.
    let requests = &node.port().requests;
    assert!(requests.windows(2).all(|pair| pair[1] - pair[0] <= GUARD_TIME * 3 / 2), "{requests:?}");
}

#[test]
fn a_restart_after_a_lost_answer_is_reported() {
    let (mut node, mut guarding) = (node(&[Answer(5), Nothing, Answer(0x7F)]), Guarding::new(GUARD_TIME, 3));
    assert_eq!(cycles(&mut node, &mut guarding, 2), [OPERATIONAL, NONE]);
    let now = node.port().now;
    node.port().waiting.push((now, 0));
    assert_eq!(cycles(&mut node, &mut guarding, 2), [Ok(NmtState::BootUp), Ok(NmtState::PreOperational)]);
}

#[test]
fn a_dropped_cycle_counts_and_its_answer_is_not_that_of_the_next_one() {
    let answers = [Answer(5), Late(110, 0x85), Answer(4)];
    let (mut node, mut guarding) = (node(&answers), Guarding::new(GUARD_TIME, 3));
    assert_eq!(cycles(&mut node, &mut guarding, 1), [OPERATIONAL]);
    node.port().is_pending = true;
    let mut future = std::boxed::Box::pin(node.guard_async(&mut guarding));
    let first = core::future::poll_fn(|context: &mut Context<'_>| {
        let is_pending = core::future::Future::poll(future.as_mut(), context).is_pending();
        Poll::Ready(is_pending)
    });
    assert!(crate::now::now(first));
    drop(future);
    assert_eq!(guarding.missed(), 1);
    node.port().is_pending = false;
    node.port().now += GUARD_TIME;
    assert_eq!(node.guard(&mut guarding), Ok(NmtState::Stopped));
}
