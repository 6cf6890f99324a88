//! A simulated CAN bus with one node, which has values of any length.

use std::collections::{HashMap, VecDeque};
use std::convert::Infallible;
use std::future::Future;
use std::pin::Pin;
use std::sync::Arc;
use std::task::{Context, Poll, Wake};
use std::time::Duration;

use lexibus::clients::canopen::{AsyncCanPort, CanFrame, CanPort, Node};
use lexibus::sdo::Server;
use lexibus::sim::{CanError, FaultyCan, SimulatedCan};
use lexibus::{AbortCode, NodeId, Object};

use crate::faulty::TIMEOUT;

pub const NODE: u8 = 5;
/// Simulated time that the transmission of a frame takes.
pub const FRAME: Duration = Duration::from_millis(1);
/// Object that contains the number of the current request.
pub const COUNT: Object = Object::new(0x2000, 0);
/// Object that contains the same number as a text of 20 bytes, which needs a segmented transfer.
pub const TEXT: Object = Object::new(0x2001, 0);
pub const SETPOINT: Object = Object::new(0x2002, 0);

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

/// A CAN bus with one node. The simulated time advances while a client waits for a frame, and with each sent frame.
pub struct Bus {
    pub server: Server<8192>,
    pub objects: Objects,
    pub now: Duration,
    /// Frames that have not been received.
    pub frames: VecDeque<CanFrame>,
    pub aborts: usize,
    /// Number of received SYNC messages. The node sends this number in its PDO.
    pub sample: u32,
}

impl Bus {
    pub fn new() -> Self {
        let server = Server::new();
        let objects = Objects(HashMap::new());
        Self { server, objects, now: Duration::ZERO, frames: VecDeque::new(), aborts: 0, sample: 0 }
    }

    /// Sets both objects that contain the number of the current request.
    pub fn count(&mut self, count: u32) {
        self.objects.0.insert(COUNT, count.to_le_bytes().to_vec());
        self.objects.0.insert(TEXT, text(count));
    }
}

impl SimulatedCan for Bus {
    fn power_cycle(&mut self) {
        self.server = Server::new();
        self.frames.push_back(CanFrame::new(0x700 + u32::from(NODE), &[0]).expect("a boot-up message"));
    }
}

impl CanPort for Bus {
    type Error = Infallible;

    fn send(&mut self, frame: &CanFrame, _: Duration) -> Result<bool, Infallible> {
        self.now += FRAME;
        if frame.id() == 0x080 {
            self.sample = self.sample.wrapping_add(1);
            self.frames.push_back(CanFrame::new(0x185, &self.sample.to_le_bytes()).expect("a frame"));
            return Ok(true);
        }
        let data: [u8; 8] = frame.data().try_into().expect("an SDO message");
        self.aborts += usize::from(data[0] == 0x80);
        if frame.id() == 0x600 + u32::from(NODE) {
            self.server.handle(&data, Duration::ZERO, &mut self.objects);
        }
        while let Some(reply) = self.server.next() {
            self.frames.push_back(CanFrame::new(0x580 + u32::from(NODE), &reply).expect("a frame"));
        }
        Ok(true)
    }

    fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, Infallible> {
        while let Some(frame) = self.frames.pop_front() {
            let frame = frame.at(Some(self.now));
            if wanted(&frame) {
                return Ok(Some(frame));
            }
        }
        self.now += patience;
        Ok(None)
    }

    fn now(&mut self) -> Option<Duration> {
        Some(self.now)
    }
}

/// An asynchronous port of the bus.
pub struct AsyncBus {
    pub bus: FaultyCan<Bus>,
    /// Number of further calls of `receive` that may wait for a frame. After these calls, waiting never ends. `None` sets no
    /// limit.
    pub pending_after: Option<usize>,
}

impl AsyncCanPort for AsyncBus {
    type Error = CanError;

    async fn send(&mut self, frame: &CanFrame, patience: Duration) -> Result<bool, CanError> {
        CanPort::send(&mut self.bus, frame, patience)
    }

    async fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, CanError> {
        if self.pending_after == Some(0) && !patience.is_zero() {
            std::future::pending::<()>().await;
        }
        if let Some(left) = &mut self.pending_after {
            *left = left.saturating_sub(usize::from(!patience.is_zero()));
        }
        CanPort::receive(&mut self.bus, patience, wanted)
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

pub fn node() -> Node<FaultyCan<Bus>> {
    Node::new(FaultyCan::new(Bus::new()), NodeId::new(NODE).expect("a node-ID")).with_timeout(TIMEOUT)
}
