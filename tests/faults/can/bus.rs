//! A simulated CAN bus with one node, whose replies are delayed, lost or corrupted.

use std::collections::HashMap;
use std::convert::Infallible;
use std::future::Future;
use std::pin::Pin;
use std::sync::Arc;
use std::task::{Context, Poll, Wake};
use std::time::Duration;

use lexibus::clients::canopen::{AsyncCanPort, CanFrame, CanPort, Node};
use lexibus::sdo::Server;
use lexibus::{AbortCode, NodeId, Object};

pub const NODE: u8 = 5;
pub const TIMEOUT: Duration = Duration::from_millis(500);
/// Object that contains the number of the current request.
pub const COUNT: Object = Object::new(0x2000, 0);
/// Object that contains the same number as a text of 20 bytes, which needs a segmented transfer.
pub const TEXT: Object = Object::new(0x2001, 0);
pub const SETPOINT: Object = Object::new(0x2002, 0);

/// A fault in the replies to one request.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fault {
    Nothing,
    /// The replies arrive with this delay.
    Late(Duration),
    Lost,
    Duplicated,
    /// The replies are truncated to four bytes.
    Truncated,
    /// Replies about another object arrive repeatedly instead of the reply.
    Foreign,
    /// A thousand frames of other nodes arrive before the reply.
    Noise,
    /// Each reply arrives just before the timeout.
    Slow,
}

pub struct Objects(pub HashMap<Object, Vec<u8>>);

impl lexibus::sdo::Objects for Objects {
    fn read(&mut self, object: Object, buffer: &mut [u8]) -> Result<usize, AbortCode> {
        let value = self.0.get(&object).ok_or(AbortCode::NO_OBJECT)?;
        buffer[..value.len()].copy_from_slice(value);
        Ok(value.len())
    }

    fn write(&mut self, object: Object, data: &[u8]) -> Result<(), AbortCode> {
        self.0.insert(object, data.to_vec());
        Ok(())
    }
}

/// A CAN bus with one node. The simulated time advances only while a client waits for a frame.
pub struct Bus {
    pub server: Server<8192>,
    pub objects: Objects,
    pub now: Duration,
    /// Frames that have not been received, with their arrival times.
    pub frames: Vec<(Duration, CanFrame)>,
    pub fault: Fault,
    pub aborts: usize,
    /// Number of received SYNC messages. The node sends this number in its PDO.
    pub sample: u32,
}

impl Bus {
    pub fn new() -> Self {
        let server = Server::new();
        let objects = Objects(HashMap::new());
        Self { server, objects, now: Duration::ZERO, frames: Vec::new(), fault: Fault::Nothing, aborts: 0, sample: 0 }
    }

    /// Sets both objects that contain the number of the current request.
    pub fn count(&mut self, count: u32) {
        self.objects.0.insert(COUNT, count.to_le_bytes().to_vec());
        self.objects.0.insert(TEXT, text(count));
    }

    pub fn reply(&mut self, reply: CanFrame) {
        let soon = self.now + Duration::from_millis(1);
        match self.fault {
            Fault::Nothing => self.frames.push((soon, reply)),
            Fault::Late(delay) => self.frames.push((self.now + delay, reply)),
            Fault::Lost => {}
            Fault::Slow => self.frames.push((self.now + TIMEOUT - Duration::from_millis(1), reply)),
            Fault::Duplicated => self.frames.extend([(soon, reply), (soon, reply)]),
            Fault::Truncated => self.frames.extend(CanFrame::new(reply.id(), &reply.data()[..4]).map(|it| (soon, it))),
            Fault::Noise => {
                let other = CanFrame::new(0x123, &[1, 2, 3]).expect("a frame");
                self.frames.extend([(soon, other); 1000]);
                self.frames.push((soon, reply));
            }
            Fault::Foreign => {
                let foreign = CanFrame::new(0x585, &[0x43, 0x34, 0x12, 1, 9, 9, 9, 9]).expect("a frame");
                self.frames.extend((1..300).map(|at| (self.now + at * TIMEOUT * 2 / 5, foreign)));
            }
        }
    }
}

impl CanPort for Bus {
    type Error = Infallible;

    fn send(&mut self, frame: &CanFrame, _: Duration) -> Result<bool, Infallible> {
        if frame.id() == 0x080 {
            self.sample = self.sample.wrapping_add(1);
            self.reply(CanFrame::new(0x185, &self.sample.to_le_bytes()).expect("a frame"));
            return Ok(true);
        }
        let data: [u8; 8] = frame.data().try_into().expect("an SDO message");
        self.aborts += usize::from(data[0] == 0x80);
        if frame.id() == 0x600 + u32::from(NODE) {
            self.server.handle(&data, Duration::ZERO, &mut self.objects);
        }
        while let Some(reply) = self.server.next() {
            self.reply(CanFrame::new(0x580 + u32::from(NODE), &reply).expect("a frame"));
        }
        Ok(true)
    }

    fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, Infallible> {
        let end = self.now + patience;
        loop {
            let first = (0..self.frames.len()).min_by_key(|&at| self.frames[at].0);
            let Some(first) = first.filter(|&at| self.frames[at].0 <= end) else {
                self.now = end;
                return Ok(None);
            };
            let (at, frame) = self.frames.remove(first);
            self.now = self.now.max(at);
            let frame = frame.at(Some(self.now));
            if wanted(&frame) {
                return Ok(Some(frame));
            }
        }
    }

    fn now(&mut self) -> Option<Duration> {
        Some(self.now)
    }
}

/// An asynchronous port of the bus.
pub struct AsyncBus {
    pub bus: Bus,
    /// Number of frames that the port still receives; `None` if it is unlimited.
    pub pending_after: Option<usize>,
}

impl AsyncCanPort for AsyncBus {
    type Error = Infallible;

    async fn send(&mut self, frame: &CanFrame, patience: Duration) -> Result<bool, Infallible> {
        self.bus.send(frame, patience)
    }

    async fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, Infallible> {
        if self.pending_after == Some(0) && !patience.is_zero() {
            std::future::pending::<()>().await;
        }
        if let Some(left) = &mut self.pending_after {
            *left = left.saturating_sub(usize::from(!patience.is_zero()));
        }
        self.bus.receive(patience, wanted)
    }

    fn now(&mut self) -> Option<Duration> {
        CanPort::now(&mut self.bus)
    }
}

/// Polls a future once.
pub fn poll_once<F: Future>(future: Pin<&mut F>) -> Poll<F::Output> {
    struct Silent;
    impl Wake for Silent {
        fn wake(self: Arc<Self>) {}
    }
    future.poll(&mut Context::from_waker(&Arc::new(Silent).into()))
}

pub fn text(count: u32) -> Vec<u8> {
    format!("{count:020}").into_bytes()
}

pub fn node() -> Node<Bus> {
    Node::new(Bus::new(), NodeId::new(NODE).expect("a node-ID")).with_timeout(TIMEOUT)
}
