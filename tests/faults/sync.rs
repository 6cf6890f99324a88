//! Tests the SYNC producer over many cycles, with a program that is late and a bus that can be busy.

use std::convert::Infallible;
use std::time::Duration;

use lexibus::clients::canopen::{CanFrame, CanPort, Node, SyncProducer, SYNC};
use lexibus::{Error, NodeId};

use crate::random::Random;

const PERIOD: Duration = Duration::from_millis(10);
const OVERFLOW: u8 = 19;

/// An interface that records the messages with their times. The bus can be busy.
#[derive(Default)]
struct Recorder {
    now: Duration,
    sent: Vec<(Duration, CanFrame)>,
    is_busy: bool,
}

impl CanPort for Recorder {
    type Error = Infallible;

    fn send(&mut self, frame: &CanFrame, _: Duration) -> Result<bool, Infallible> {
        if !self.is_busy {
            self.sent.push((self.now, *frame));
        }
        Ok(!self.is_busy)
    }

    fn receive(
        &mut self,
        patience: Duration,
        _: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, Infallible> {
        self.now += patience;
        Ok(None)
    }

    fn now(&mut self) -> Option<Duration> {
        Some(self.now)
    }
}

#[test]
fn messages_keep_their_grid_and_count_without_a_gap() {
    let mut node = Node::new(Recorder::default(), NodeId::new(5).expect("a node-ID"));
    let mut producer = SyncProducer::new(PERIOD).with_overflow(OVERFLOW).expect("a valid value");
    let (mut random, mut busy) = (Random::new(6), 0);
    for _ in 0..100_000 {
        // The program calls the producer up to 3 ms late, and sometimes more than a period late.
        let late = if random.below(100) == 0 { random.below(40_000) } else { random.below(3000) };
        let remaining = producer.remaining(node.port().now);
        node.port().now += remaining + Duration::from_micros(late);
        node.port().is_busy = random.below(200) == 0;
        match node.produce_sync(&mut producer) {
            Ok(true) => assert!(!node.port().is_busy),
            Err(Error::Timeout) => busy += 1,
            other => panic!("{other:?}"),
        }
        assert_eq!(node.produce_sync(&mut producer), Ok(false), "only one message in each period");
    }
    let now = node.port().now;
    let sent = &node.port().sent;
    let first = sent[0].0;
    let mut last = None;
    for (at, (time, frame)) in sent.iter().enumerate() {
        assert_eq!((frame.id(), frame.data()), (SYNC, &[(at % usize::from(OVERFLOW)) as u8 + 1][..]));
        // A period contains at most one message, at its start unless the program is late.
        let period = (*time - first).as_nanos() / PERIOD.as_nanos();
        assert!(last < Some(period), "message {at}");
        last = Some(period);
    }
    let on_time = sent.iter().filter(|(time, _)| (*time - first).as_nanos() % PERIOD.as_nanos() < 3_000_000).count();
    let periods = (now - first).as_nanos() / PERIOD.as_nanos() + 1;
    println!(
        "{} SYNC messages in {periods} periods, {} skipped, the bus was busy {busy} times",
        sent.len(),
        producer.skipped()
    );
    assert_eq!(sent.len() as u128 + u128::from(producer.skipped()), periods);
    assert!(on_time * 100 > sent.len() * 98 && busy > 100 && producer.skipped() > busy);
}
