//! Master of the layer setting services (CiA 305).

mod scan;
#[cfg(all(test, feature = "std"))]
mod tests;

use core::time::Duration;

use super::frame::CanFrame;
use super::node::TIMEOUT;
use super::port::{AsyncCanPort, CanPort, BACKLOG};
use crate::clock::elapsed;
use crate::lss::{
    BitRate, IdentityPart, LssAddress, LssError, LssState, Message, Service, Transaction, ANSWERS, REQUESTS,
};
use crate::node_id::NodeId;

/// Default window: the time in which slaves answer a fastscan request, and the time after an answer in which a further
/// answer is an error.
const WINDOW: Duration = Duration::from_millis(20);

/// Master of the layer setting services (LSS, CiA 305) on a CAN interface: assigns node-IDs and bit rates. With a
/// [`CanPort`], use the methods without suffix. With an [`AsyncCanPort`], use the methods whose names end in `_async`.
///
/// ```
/// use lexibus::clients::canopen::LssMaster;
/// use lexibus::lss::{LssAddress, LssState};
/// use lexibus::sim::{CanBus, CanNode, Device};
/// use lexibus::{NodeId, Object};
/// use lexibus_drives::demo_drive::ENTRIES;
///
/// // Three drives without a node-ID, with different serial numbers.
/// let mut bus = CanBus::new();
/// for serial in [21_u32, 22, 23] {
///     let mut device = Device::new(ENTRIES);
///     device.set_initial_bytes(Object::new(0x1018, 4), &serial.to_le_bytes())?;
///     bus.add(CanNode::without_node_id(device));
/// }
///
/// let mut master = LssMaster::new(bus);
/// let mut serials = Vec::new();
/// while let Some(address) = master.fast_scan().expect("unique addresses") {
///     // The drive that was found is in the state Configuration.
///     serials.push(address.serial_number);
///     // No other node is on this bus.
///     let id = NodeId::new(serials.len() as u8).expect("a free node-ID");
///     master.configure_node_id(id).expect("only this drive is in Configuration");
///     master.store().expect("the drive can store");
///     // The drive leaves Configuration and starts with its new node-ID.
///     master.switch_global(LssState::Waiting).expect("the bus works");
/// }
/// assert_eq!(serials, [21, 22, 23]);
/// # Ok::<(), lexibus::AbortCode>(())
/// ```
///
/// # Several answers
///
/// A slave that is in Configuration by mistake would get the same node-ID as the intended slave. After an answer, the
/// master therefore waits for further answers and returns [`LssError::SeveralAnswers`] if a second one arrives. By
/// default, the master waits for 20 ms; [`with_window`](Self::with_window) sets this time. After an answer to a service
/// that changes a slave (node-ID, bit timing, store), the master waits for the whole timeout.
///
/// # Node-IDs that were not confirmed
///
/// If [`configure_node_id`](Self::configure_node_id) fails, one or several slaves may have the node-ID as pending
/// node-ID, and would use it as soon as they leave Configuration. The master therefore removes the pending node-ID of
/// all slaves in Configuration, before it returns the error. If the master cannot send this request, or if the async
/// call was dropped, the next call sends this request first. A slave that already uses a node-ID keeps it until the NMT
/// command "reset communication". Then the slave has no node-ID until it gets a new one, or is switched off and on.
///
/// # Late answers
///
/// Late answers can arrive after a timeout, [`LssError::SeveralAnswers`], a failed scan or a dropped async call. The
/// next request therefore first waits for one timeout, and discards all answers that arrive in this time.
#[derive(Clone, Debug)]
pub struct LssMaster<P> {
    port: P,
    timeout: Duration,
    window: Duration,
    pause: Duration,
    /// Answers to an earlier request can still arrive.
    is_owed: bool,
    /// Slaves in Configuration may have a pending node-ID that was not confirmed.
    is_doubtful: bool,
}

impl<P> LssMaster<P> {
    /// Creates a master on `port`, with a timeout of 500 ms.
    pub const fn new(port: P) -> Self {
        Self { port, timeout: TIMEOUT, window: WINDOW, pause: Duration::ZERO, is_owed: false, is_doubtful: false }
    }

    /// Sets the timeout for each answer, and for sending a frame on a busy bus.
    #[must_use]
    pub fn with_timeout(self, timeout: Duration) -> Self {
        Self { timeout, ..self }
    }

    /// Sets the window: the time after an answer in which a further answer is an error. The window is also the duration
    /// of each of the 133 steps of a fastscan, within which all slaves must answer. The default is 20 ms.
    ///
    /// Without a [clock](CanPort::now), each answer extends a step by at most one eighth of the window.
    #[must_use]
    pub fn with_window(self, window: Duration) -> Self {
        Self { window, ..self }
    }

    /// Sets a pause before each message. By default, there is no pause. Some slaves lose a message that arrives before
    /// they have processed the previous one, for example the four messages of
    /// [`switch_selective`](Self::switch_selective).
    #[must_use]
    pub fn with_pause(self, pause: Duration) -> Self {
        Self { pause, ..self }
    }

    /// Returns the CAN interface.
    pub fn port(&mut self) -> &mut P {
        &mut self.port
    }

    /// Returns the CAN interface and drops the master.
    pub fn into_port(self) -> P {
        self.port
    }
}

/// Returns the LSS message of a slave in a frame, or `None` for other frames. An LSS message has eight bytes.
fn answer(frame: &CanFrame) -> Option<Message> {
    frame.data().try_into().ok().filter(|_| frame.id() == ANSWERS)
}

macro_rules! master {
    (
        $Port:ident: $switch_global:ident $switch_selective:ident $configure_node_id:ident $configure_bit_rate:ident $configure_bit_timing:ident
        $activate_bit_timing:ident $store:ident $inquire:ident $inquire_address:ident $inquire_node_id:ident
        $send:ident $receive:ident $collect:ident $settle:ident $run:ident $remove_node_id:ident $request:ident
        $withdraw:ident $($async:ident $await:ident)?
    ) => {
        impl<P: $Port> LssMaster<P> {
            /// Switches all slaves to a state. Slaves don't answer this service. A slave that had no node-ID starts
            /// with its configured node-ID when it is switched to [`LssState::Waiting`]. Some slaves then restart their
            /// communication: they also change to a configured bit rate, and some of them enter Operational.
            ///
            /// # Errors
            ///
            /// Returns [`LssError::Client`] if the interface fails, or [`LssError::NotSent`] if the bus stays busy.
            pub $($async)? fn $switch_global(&mut self, state: LssState) -> Result<(), LssError<P::Error>> {
                self.$run(Service::SwitchGlobal(state))$(.$await)?.map(|_| ())
            }

            /// Switches all slaves to Waiting, and then the slave with this address to Configuration.
            ///
            /// # Errors
            ///
            /// - [`LssError::Client`] if the interface fails, or [`LssError::NotSent`] if the bus stays busy.
            /// - [`LssError::Timeout`] if no slave has this address, or the answer was lost.
            /// - [`LssError::SeveralAnswers`] if several slaves have this address.
            pub $($async)? fn $switch_selective(&mut self, address: LssAddress) -> Result<(), LssError<P::Error>> {
                self.$switch_global(LssState::Waiting)$(.$await)??;
                self.$run(Service::SwitchSelective(address))$(.$await)?.map(|_| ())
            }

            /// Sets the node-ID of the slave in Configuration. A slave without a node-ID uses the new one when it is
            /// switched to Waiting. A slave that already uses a node-ID uses the new one after the NMT command "reset
            /// communication".
            ///
            /// After an error other than `Refused`, the master removes the pending node-ID of all slaves in
            /// Configuration. Don't give the same node-ID to another slave until a [`fast_scan`](Self::fast_scan) or
            /// [`inquire_node_id`](Self::inquire_node_id) has shown that the intended slave doesn't use it.
            ///
            /// # Errors
            ///
            /// - [`LssError::Client`] if the interface fails, or [`LssError::NotSent`] if the bus stays busy.
            /// - [`LssError::Timeout`] if no slave is in Configuration, or the answer was lost.
            /// - [`LssError::SeveralAnswers`] if several slaves are in Configuration.
            /// - [`LssError::Refused`] if the slave refuses the node-ID.
            pub $($async)? fn $configure_node_id(&mut self, node: NodeId) -> Result<(), LssError<P::Error>> {
                self.$settle()$(.$await)??;
                self.is_doubtful = true;
                let result = self.$request(Service::ConfigureNodeId(Some(node)))$(.$await)?;
                match result {
                    Ok(_) | Err(LssError::Refused(_)) => self.is_doubtful = false,
                    // The caller gets the first error. If this request fails, the next service repeats it.
                    Err(_) => {
                        let _ = self.$withdraw()$(.$await)?;
                    }
                }
                result.map(|_| ())
            }

            /// Removes the node-ID of the slave in Configuration. The slave uses its present node-ID until the NMT
            /// command "reset communication".
            ///
            /// # Errors
            ///
            /// Returns the errors of [`configure_node_id`](Self::configure_node_id).
            pub $($async)? fn $remove_node_id(&mut self) -> Result<(), LssError<P::Error>> {
                self.$run(Service::ConfigureNodeId(None))$(.$await)?.map(|_| ())
            }

            /// Sets the bit rate of the slave in Configuration. The slave changes its bit rate at
            /// [`activate_bit_timing`](Self::activate_bit_timing), or at a restart if it has stored the new bit rate.
            /// Some slaves also change their bit rate when they start with a new node-ID. A slave with a wrong bit rate
            /// disturbs all nodes on the bus. Therefore, first give all slaves their node-IDs. Then configure the bit
            /// rate of each slave, switch all slaves to Configuration, and activate the bit timing.
            ///
            /// # Errors
            ///
            /// Returns the errors of [`configure_bit_timing`](Self::configure_bit_timing).
            pub $($async)? fn $configure_bit_rate(&mut self, rate: BitRate) -> Result<(), LssError<P::Error>> {
                self.$configure_bit_timing(0, rate.index())$(.$await)?
            }

            /// Sets the bit timing of the slave in Configuration to entry `index` of table `table`. Table 0 is the
            /// table of [`BitRate`]; tables 128 to 255 are vendor-specific.
            ///
            /// # Errors
            ///
            /// - [`LssError::Client`] if the interface fails, or [`LssError::NotSent`] if the bus stays busy.
            /// - [`LssError::Timeout`] if no slave is in Configuration, or the answer was lost.
            /// - [`LssError::SeveralAnswers`] if several slaves are in Configuration.
            /// - [`LssError::Refused`] if the slave doesn't support the bit timing.
            pub $($async)? fn $configure_bit_timing(&mut self, table: u8, index: u8) -> Result<(), LssError<P::Error>> {
                self.$run(Service::ConfigureBitTiming { table, index })$(.$await)?.map(|_| ())
            }

            /// Activates the bit timings of all slaves in Configuration. Slaves don't answer this service. The slaves
            /// change their bit timing after `delay` milliseconds, and don't send for another `delay` milliseconds.
            /// Change the bit rate of your interface after the first delay, and don't send before the end of the second
            /// one.
            ///
            /// # Errors
            ///
            /// Returns [`LssError::Client`] if the interface fails, or [`LssError::NotSent`] if the bus stays busy.
            pub $($async)? fn $activate_bit_timing(&mut self, delay: u16) -> Result<(), LssError<P::Error>> {
                self.$run(Service::ActivateBitTiming { delay })$(.$await)?.map(|_| ())
            }

            /// Stores node-ID and bit timing in the non-volatile memory of the slave in Configuration.
            ///
            /// # Errors
            ///
            /// - [`LssError::Client`] if the interface fails, or [`LssError::NotSent`] if the bus stays busy.
            /// - [`LssError::Timeout`] if no slave is in Configuration, the answer was lost, or the slave needs longer
            ///   than the timeout.
            /// - [`LssError::SeveralAnswers`] if several slaves are in Configuration. Each of them may have stored its
            ///   node-ID and bit timing.
            /// - [`LssError::Refused`] if the slave cannot store.
            pub $($async)? fn $store(&mut self) -> Result<(), LssError<P::Error>> {
                self.$run(Service::Store)$(.$await)?.map(|_| ())
            }

            /// Returns one of the four numbers in the address of the slave in Configuration.
            ///
            /// # Errors
            ///
            /// - [`LssError::Client`] if the interface fails, or [`LssError::NotSent`] if the bus stays busy.
            /// - [`LssError::Timeout`] if no slave is in Configuration, or the answer was lost.
            /// - [`LssError::SeveralAnswers`] if several slaves are in Configuration.
            pub $($async)? fn $inquire(&mut self, part: IdentityPart) -> Result<u32, LssError<P::Error>> {
                self.$run(Service::Inquire(part))$(.$await)?
            }

            /// Returns the address of the slave in Configuration.
            ///
            /// # Errors
            ///
            /// Returns the errors of [`inquire`](Self::inquire).
            pub $($async)? fn $inquire_address(&mut self) -> Result<LssAddress, LssError<P::Error>> {
                let mut parts = [0; 4];
                for (to, part) in parts.iter_mut().zip(IdentityPart::ALL) {
                    *to = self.$inquire(part)$(.$await)??;
                }
                Ok(LssAddress::from_array(parts))
            }

            /// Returns the node-ID that the slave in Configuration uses, or `None` if it has no node-ID.
            ///
            /// # Errors
            ///
            /// Returns the errors of [`inquire`](Self::inquire), or [`LssError::UnexpectedReply`] if the slave answers
            /// with an invalid node-ID.
            pub $($async)? fn $inquire_node_id(&mut self) -> Result<Option<NodeId>, LssError<P::Error>> {
                let node = self.$run(Service::InquireNodeId)$(.$await)??;
                Ok(u8::try_from(node).ok().and_then(NodeId::new))
            }

            $($async)? fn $send(&mut self, message: Message) -> Result<(), LssError<P::Error>> {
                if !self.pause.is_zero() {
                    self.$receive(self.pause, &|_| false)$(.$await)??;
                }
                let is_sent = self.port.send(&CanFrame::of(REQUESTS, message), self.timeout)$(.$await)?;
                is_sent.map_err(LssError::Client)?.then_some(()).ok_or(LssError::NotSent)
            }

            /// Waits for a message of a slave that `wanted` accepts.
            $($async)? fn $receive(
                &mut self,
                patience: Duration,
                wanted: &dyn Fn(&Message) -> bool,
            ) -> Result<Option<Message>, LssError<P::Error>> {
                let is_wanted = &mut |frame: &CanFrame| answer(frame).is_some_and(|message| wanted(&message));
                let frame = self.port.receive(patience, is_wanted)$(.$await)?.map_err(LssError::Client)?;
                Ok(frame.as_ref().and_then(answer))
            }

            /// Receives messages of slaves for the duration `time`, and calls `handle` with each message that `wanted`
            /// accepts. Returns whether `wanted` accepted a message. Without a clock, `time` is divided into eight
            /// parts, and each message restarts the present part.
            $($async)? fn $collect(
                &mut self,
                time: Duration,
                wanted: &dyn Fn(&Message) -> bool,
                handle: &mut dyn FnMut(&Message),
            ) -> Result<bool, LssError<P::Error>> {
                let (start, mut left, mut is_answered) = (self.port.now(), time, false);
                let part = if start.is_some() { time } else { time / 8 };
                for _ in 0..BACKLOG {
                    match self.$receive(left.min(part), wanted)$(.$await)?? {
                        Some(message) => {
                            is_answered = true;
                            handle(&message);
                        }
                        None if left <= part => break,
                        None => left = left.saturating_sub(part),
                    }
                    if let Some(elapsed) = elapsed(start, self.port.now()) {
                        left = time.saturating_sub(elapsed);
                    }
                }
                Ok(is_answered)
            }

            /// Removes the pending node-ID of all slaves in Configuration, and waits for their answers. If no slave
            /// answers, this is not an error, because there may be no slave in Configuration.
            $($async)? fn $withdraw(&mut self) -> Result<(), LssError<P::Error>> {
                for message in Service::ConfigureNodeId(None).messages() {
                    self.$send(message)$(.$await)??;
                }
                self.is_doubtful = false;
                self.is_owed = true;
                self.$collect(self.timeout, &|_| true, &mut |_| ())$(.$await)??;
                self.is_owed = false;
                Ok(())
            }

            /// Removes pending node-IDs that were not confirmed, waits for further answers to an earlier request, and
            /// discards all answers that have arrived.
            $($async)? fn $settle(&mut self) -> Result<(), LssError<P::Error>> {
                if self.is_doubtful {
                    self.$withdraw()$(.$await)??;
                }
                let time = if self.is_owed { self.timeout } else { Duration::ZERO };
                self.$collect(time, &|_| true, &mut |_| ())$(.$await)??;
                self.is_owed = false;
                Ok(())
            }

            $($async)? fn $run(&mut self, service: Service) -> Result<u32, LssError<P::Error>> {
                self.$settle()$(.$await)??;
                self.$request(service)$(.$await)?
            }

            $($async)? fn $request(&mut self, service: Service) -> Result<u32, LssError<P::Error>> {
                let mut transaction = Transaction::new(service);
                while let Some(message) = transaction.next() {
                    self.is_owed = service.answer().is_some();
                    if let Err(error) = self.$send(message)$(.$await)? {
                        self.is_owed = false;
                        return Err(error);
                    }
                }
                let mut patience = self.timeout;
                loop {
                    if let Some(result) = transaction.result() {
                        // After several answers, even more slaves can answer.
                        self.is_owed = matches!(result, Err(LssError::Timeout | LssError::SeveralAnswers));
                        return result.map_err(LssError::of_client);
                    }
                    match self.$receive(patience, &|message| transaction.accepts(message))$(.$await)?? {
                        Some(message) if service.is_for_several() => {
                            transaction.handle(&message);
                            transaction.time_out();
                        }
                        Some(message) => transaction.handle(&message),
                        None => transaction.time_out(),
                    }
                    patience = if service.is_change() { self.timeout } else { self.window };
                }
            }
        }
    };
}

master! {
    CanPort: switch_global switch_selective configure_node_id configure_bit_rate configure_bit_timing
    activate_bit_timing store inquire inquire_address inquire_node_id
    send receive collect settle run remove_node_id request withdraw
}
master! {
    AsyncCanPort: switch_global_async switch_selective_async configure_node_id_async configure_bit_rate_async configure_bit_timing_async
    activate_bit_timing_async store_async inquire_async inquire_address_async inquire_node_id_async
    send_async receive_async collect_async settle_async run_async remove_node_id_async request_async withdraw_async async await
}
