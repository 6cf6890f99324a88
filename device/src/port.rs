//! CAN interfaces that are connected to the computer.

use std::time::Duration;

use lexibus::clients::canopen::{Buffered, CanFrame, CanPort, Node};
use lexibus::NodeId;

use crate::connection::CanOpenConnection;
use crate::failure::Failure;

/// Maximum number of received frames that are buffered while the client waits for another frame.
const KEPT: usize = 64;

/// A CAN interface of any kind.
pub struct AnyPort(Box<dyn CanPort<Error = Failure>>);

/// Connection to a CANopen node over a CAN interface.
pub type NodeConnection = CanOpenConnection<Node<Buffered<AnyPort, KEPT>>>;

impl AnyPort {
    /// Wraps a CAN interface.
    pub fn new(port: impl CanPort<Error: std::fmt::Display> + 'static) -> Self {
        Self(Box::new(Converted(port)))
    }

    /// Opens a CAN interface of Linux.
    #[cfg(all(feature = "socketcan", target_os = "linux"))]
    pub(crate) fn socketcan(name: &str) -> Result<Self, Failure> {
        use lexibus::clients::canopen::socketcan::{CanSocket, Socket};
        let socket = CanSocket::open(name);
        let socket = socket.map_err(|error| Failure::Bus(format!("cannot open the CAN interface {name}: {error}")))?;
        Ok(Self::new(socket))
    }

    #[cfg(not(all(feature = "socketcan", target_os = "linux")))]
    pub(crate) fn socketcan(_: &str) -> Result<Self, Failure> {
        Err(Failure::Bus("this build doesn't support SocketCAN (feature `socketcan`, Linux only)".to_owned()))
    }

    /// Opens a CAN adapter on a serial line.
    #[cfg(feature = "slcan")]
    pub(crate) fn slcan(path: &str, bit_rate: Option<u16>) -> Result<Self, Failure> {
        let adapter = crate::slcan::open(path, bit_rate);
        let adapter = adapter.map_err(|error| Failure::Bus(format!("cannot open the CAN adapter {path}: {error}")))?;
        Ok(Self::new(adapter))
    }

    #[cfg(not(feature = "slcan"))]
    pub(crate) fn slcan(_: &str, _: Option<u16>) -> Result<Self, Failure> {
        Err(Failure::Bus("this build doesn't support slcan (feature `slcan`)".to_owned()))
    }

    /// Creates a connection to a CANopen node. `timeout` is the maximum time for each reply.
    #[must_use]
    pub fn connection(self, node: NodeId, timeout: Duration) -> NodeConnection {
        CanOpenConnection::new(Node::new(Buffered::new(self), node).with_timeout(timeout))
    }
}

impl CanPort for AnyPort {
    type Error = Failure;

    fn send(&mut self, frame: &CanFrame, patience: Duration) -> Result<bool, Failure> {
        self.0.send(frame, patience)
    }

    fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, Failure> {
        self.0.receive(patience, wanted)
    }

    fn now(&mut self) -> Option<Duration> {
        self.0.now()
    }
}

/// A CAN interface whose errors are converted to [`Failure`].
struct Converted<P>(P);

impl<P: CanPort<Error: std::fmt::Display>> CanPort for Converted<P> {
    type Error = Failure;

    fn send(&mut self, frame: &CanFrame, patience: Duration) -> Result<bool, Failure> {
        self.0.send(frame, patience).map_err(converted)
    }

    fn receive(
        &mut self,
        patience: Duration,
        wanted: &mut dyn FnMut(&CanFrame) -> bool,
    ) -> Result<Option<CanFrame>, Failure> {
        self.0.receive(patience, wanted).map_err(converted)
    }

    fn now(&mut self) -> Option<Duration> {
        self.0.now()
    }
}

fn converted(error: impl std::fmt::Display) -> Failure {
    Failure::Bus(error.to_string())
}
