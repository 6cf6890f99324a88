//! Mailbox of a SubDevice, which transfers one message at a time in each direction (ETG.1000.4 6.7, ETG.1000.6 5.3).

use core::future::pending;
use core::ops::Deref;
use core::time::Duration;

use ethercrab::error::{Error as BusError, MailboxError};
use ethercrab::{Command, EtherCrabWireWrite, MainDevice, RegisterAddress};

use super::protocol::{Answer, Request, SMALLEST};
use super::TIMEOUT;
use crate::bus::Object;
use crate::clock::{Clock, DefaultClock, Timer};
use crate::emergency::Emergency;
use crate::error::Error;

/// Number of sync managers to search. The mailboxes are usually the first two of four.
const MANAGERS: u16 = 4;

/// Length of the registers of a sync manager in bytes.
const REGISTERS: u16 = 8;

/// Offset of the status register within the registers of a sync manager, and the bit that is set if the mailbox is
/// full.
const STATE: u16 = 5;
const FULL: u8 = 0x08;

/// Offsets of the activate register and the PDI control register from the status register, and the bit for repetitions
/// in both registers. In the activate register, the bit requests the repetition of a message. In the PDI control
/// register, the bit acknowledges the repetition (ETG.1000.4 6.7.3).
const ACTIVATE: u16 = 1;
const PDI_CONTROL: u16 = 2;
const REPEAT: u8 = 0x02;

/// Maximum number of repeat requests for one message.
const MOST_REPEATS: u32 = 3;

/// Maximum number of polls in an exchange without a clock and without pauses.
const POLLS: u32 = 20_000;

/// Number of further segments for which a transfer takes one more timeout, as on CANopen.
const SEGMENTS_PER_TIMEOUT: u32 = 10;

/// Pause between two polls of a mailbox.
const PAUSE: Duration = Duration::from_micros(500);

/// Limit of a duration: an end time, or the number of remaining polls if there is no clock.
#[derive(Clone, Copy, Debug, Default)]
struct Limit {
    end: Option<Duration>,
    polls: u32,
}

/// Limit of a mailbox exchange, and limit of the transfer that contains it. The client waits between polls if there is a timer.
struct Deadline<'t, T> {
    timer: &'t mut T,
    clock: Option<fn() -> Duration>,
    exchange: Limit,
    transfer: &'t mut Limit,
}

/// Returns the time of `clock`, or of the [`DefaultClock`] if `clock` is `None`.
fn time(clock: Option<fn() -> Duration>) -> Option<Duration> {
    clock.map(|clock| clock()).or_else(|| DefaultClock.now())
}

impl<T: Timer> Deadline<'_, T> {
    /// Counts a poll. Returns an error if a limit is exceeded.
    fn check(&mut self) -> Result<(), Error<BusError>> {
        let now = time(self.clock);
        let exceeds = |limit: &Limit| match (limit.end, now) {
            (Some(end), Some(now)) => now >= end,
            _ => limit.polls == 0,
        };
        let is_late = exceeds(&self.exchange) || exceeds(self.transfer);
        for limit in [&mut self.exchange, &mut *self.transfer] {
            limit.polls = limit.polls.saturating_sub(1);
        }
        if is_late {
            Err(Error::Timeout)
        } else {
            Ok(())
        }
    }

    /// Waits before the next poll if there is a timer.
    async fn pause(&mut self) {
        if T::EXPIRES {
            self.timer.limit(PAUSE, pending::<()>()).await;
        }
    }
}

/// A mailbox buffer in the memory of the slave controller.
#[derive(Clone, Copy, Debug)]
struct Buffer {
    /// Address of the status register.
    state: u16,
    address: u16,
    length: u16,
}

/// Access to the slave controller of one SubDevice.
#[derive(Clone, Copy, Debug)]
struct Controller<'m> {
    maindevice: &'m MainDevice<'m>,
    station: u16,
}

#[derive(Debug)]
pub(super) struct Mailbox<'m, T> {
    controller: Controller<'m>,
    pub(super) timeout: Duration,
    pub(super) clock: Option<fn() -> Duration>,
    timer: T,
    /// Mailbox buffers for sending and receiving. The client reads their addresses and lengths from the registers at
    /// the first use.
    buffers: Option<(Buffer, Buffer)>,
    pub(super) emergency: Option<Emergency>,
    /// True if the reply to the last request may still arrive.
    is_unsettled: bool,
    /// Limit of the current transfer.
    transfer: Limit,
}

/// Result of comparing a received message with the expected reply.
pub(super) enum Sought<T> {
    /// The message is the reply.
    Found(T),
    /// The message is unrelated to the request.
    Other,
    /// The device refused the request, or the reply doesn't match the request.
    Failed(Error<BusError>),
}

impl<T> Sought<T> {
    /// Classifies a message that isn't the expected reply about `object`. A reply about another object belongs to an
    /// earlier transfer that was dropped.
    pub(super) fn of(answer: Answer<'_>, object: Object) -> Self {
        match answer {
            Answer::Foreign | Answer::Emergency(_) => Sought::Other,
            Answer::Upload { object: of, .. } | Answer::Download { object: of } | Answer::Abort { object: of, .. }
                if of != object =>
            {
                Sought::Other
            }
            Answer::Abort { code, .. } => Sought::Failed(Error::Abort(code)),
            Answer::MailboxError(code) => Sought::Failed(Error::Mailbox(code)),
            _ => Sought::Failed(Error::UnexpectedReply),
        }
    }
}

impl<'m> Mailbox<'m, DefaultClock> {
    pub(super) const fn new(maindevice: &'m MainDevice<'m>, station: u16) -> Self {
        let controller = Controller { maindevice, station };
        Self {
            controller,
            timeout: TIMEOUT,
            clock: None,
            timer: DefaultClock,
            buffers: None,
            emergency: None,
            is_unsettled: false,
            transfer: Limit { end: None, polls: 0 },
        }
    }
}

impl<'m, T: Timer> Mailbox<'m, T> {
    /// Returns the mailbox with this timer.
    pub(super) fn with_timer<U>(self, timer: U) -> Mailbox<'m, U> {
        let Self { controller, timeout, clock, buffers, emergency, is_unsettled, transfer, .. } = self;
        Mailbox { controller, timeout, clock, timer, buffers, emergency, is_unsettled, transfer }
    }

    /// Returns the time of the clock.
    pub(super) fn now(&self) -> Option<Duration> {
        time(self.clock)
    }

    /// Waits for `time`, or returns an error without a timer.
    pub(super) async fn wait(&mut self, time: Duration) -> Result<(), Error<BusError>> {
        if !T::EXPIRES {
            return Err(Error::NoClock);
        }
        self.timer.limit(time, pending::<()>()).await;
        Ok(())
    }

    /// Returns the limit that is one timeout from now.
    fn limit(&self) -> Limit {
        let pauses = self.timeout.as_micros() / PAUSE.as_micros();
        let polls = if T::EXPIRES { u32::try_from(pauses).unwrap_or(u32::MAX) } else { POLLS };
        Limit { end: self.now().map(|now| now.saturating_add(self.timeout)), polls }
    }

    /// Starts a transfer: discards late replies, and limits the time of the transfer to one timeout from then on.
    pub(super) async fn begin(&mut self) -> Result<(), Error<BusError>> {
        let (_, back) = self.buffers().await?;
        self.transfer = self.limit();
        self.settle(back).await?;
        self.transfer = self.limit();
        Ok(())
    }

    /// Extends the limit of the transfer by one tenth of the timeout, for one more segment.
    pub(super) fn extend(&mut self) {
        let more = self.timeout / SEGMENTS_PER_TIMEOUT;
        self.transfer.end = self.transfer.end.map(|end| end.saturating_add(more));
        self.transfer.polls = self.transfer.polls.saturating_add(self.limit().polls / SEGMENTS_PER_TIMEOUT);
    }

    /// Returns the maximum length of a message to the device in bytes.
    pub(super) async fn room(&mut self) -> Result<usize, Error<BusError>> {
        Ok(usize::from(self.buffers().await?.0.length))
    }

    /// Sends `request`, followed by `data`, and passes each received message to `seek`, until `seek` finds the reply or
    /// an error. Messages of other protocols are ignored.
    pub(super) async fn exchange<V>(
        &mut self,
        request: &Request,
        data: &[u8],
        mut seek: impl FnMut(Answer<'_>) -> Sought<V>,
    ) -> Result<V, Error<BusError>> {
        let (out, back) = self.buffers().await?;
        self.settle(back).await?;
        let controller = self.controller;
        let exchange = self.limit();
        let (timer, transfer) = (&mut self.timer, &mut self.transfer);
        let mut deadline = Deadline { timer, clock: self.clock, exchange, transfer };
        controller.wait(out, false, &mut deadline).await?;
        // The mailbox stays unsettled if the exchange fails or is dropped.
        self.is_unsettled = true;
        controller.send(out, Message { head: request.head(), data, length: usize::from(out.length) }).await?;
        loop {
            controller.wait(back, true, &mut deadline).await?;
            let received = controller.take(back, &mut deadline).await?;
            let answer = Answer::parse(&received);
            if let Answer::Emergency(emergency) = answer {
                self.emergency = Some(emergency);
            }
            let result = match seek(answer) {
                Sought::Other => continue,
                Sought::Found(found) => Ok(found),
                Sought::Failed(error) => Err(error),
            };
            // After an unexpected reply, the right one may still arrive.
            self.is_unsettled = matches!(result, Err(Error::UnexpectedReply));
            return result;
        }
    }

    /// Removes messages of earlier transfers from the mailbox. If the last reply is missing, waits for this reply, for
    /// at most one timeout. Keeps the last emergency message.
    async fn settle(&mut self, back: Buffer) -> Result<(), Error<BusError>> {
        let controller = self.controller;
        let exchange = self.limit();
        let (timer, transfer) = (&mut self.timer, &mut self.transfer);
        let mut deadline = Deadline { timer, clock: self.clock, exchange, transfer };
        loop {
            if !controller.is_full(back).await? {
                if !self.is_unsettled || deadline.check().is_err() {
                    break;
                }
                deadline.pause().await;
                continue;
            }
            deadline.check()?;
            let received = controller.take(back, &mut deadline).await?;
            match Answer::parse(&received) {
                Answer::Emergency(emergency) => self.emergency = Some(emergency),
                Answer::Foreign => {}
                _ => self.is_unsettled = false,
            }
        }
        self.is_unsettled = false;
        Ok(())
    }

    async fn buffers(&mut self) -> Result<(Buffer, Buffer), Error<BusError>> {
        if let Some(known) = self.buffers {
            return Ok(known);
        }
        let first = u16::from(RegisterAddress::Sm0);
        let registers = self.controller.read(first, MANAGERS * REGISTERS).await.map_err(Error::Client)?;
        let missing = |error| Error::Client(BusError::Mailbox(error));
        let out = find(&registers, first, true).ok_or(missing(MailboxError::NoWriteMailbox))?;
        let back = find(&registers, first, false).ok_or(missing(MailboxError::NoReadMailbox))?;
        Ok(*self.buffers.insert((out, back)))
    }
}

impl<'m> Controller<'m> {
    async fn read(self, address: u16, length: u16) -> Result<impl Deref<Target = [u8]> + 'm, BusError> {
        Command::fprd(self.station, address).receive_slice(self.maindevice, length).await
    }

    async fn register(self, address: u16) -> Result<u8, Error<BusError>> {
        Command::fprd(self.station, address).receive::<u8>(self.maindevice).await.map_err(Error::Client)
    }

    /// Writes a message to the mailbox.
    async fn send(self, out: Buffer, message: Message<'_>) -> Result<(), Error<BusError>> {
        let written = Command::fpwr(self.station, out.address).send_receive_slice(self.maindevice, message);
        written.await.map(|_| ()).map_err(Error::Client)
    }

    /// Reads the message in the mailbox. Requests the message again if the read fails, at most [`MOST_REPEATS`] times.
    async fn take<T: Timer>(
        self,
        back: Buffer,
        deadline: &mut Deadline<'_, T>,
    ) -> Result<impl Deref<Target = [u8]> + 'm, Error<BusError>> {
        let mut repeats = MOST_REPEATS;
        loop {
            match self.read(back.address, back.length).await {
                Ok(received) => return Ok(received),
                Err(error) if repeats == 0 => return Err(Error::Client(error)),
                Err(_) => self.repeat(back, deadline).await?,
            }
            repeats -= 1;
        }
    }

    /// Requests the last message again, unless the mailbox is full, and waits until the message is in the mailbox.
    async fn repeat<T: Timer>(self, back: Buffer, deadline: &mut Deadline<'_, T>) -> Result<(), Error<BusError>> {
        if self.is_full(back).await? {
            return Ok(());
        }
        let request = self.register(back.state + ACTIVATE).await? ^ REPEAT;
        let written = Command::fpwr(self.station, back.state + ACTIVATE).send(self.maindevice, request).await;
        written.map_err(Error::Client)?;
        while (self.register(back.state + PDI_CONTROL).await? ^ request) & REPEAT != 0 {
            deadline.check()?;
            deadline.pause().await;
        }
        self.wait(back, true, deadline).await
    }

    /// Waits until the mailbox is full if `full` is set, and otherwise until the mailbox is empty.
    async fn wait<T: Timer>(
        self,
        buffer: Buffer,
        full: bool,
        deadline: &mut Deadline<'_, T>,
    ) -> Result<(), Error<BusError>> {
        loop {
            deadline.check()?;
            if self.is_full(buffer).await? == full {
                return Ok(());
            }
            deadline.pause().await;
        }
    }

    async fn is_full(self, buffer: Buffer) -> Result<bool, Error<BusError>> {
        Ok(self.register(buffer.state).await? & FULL != 0)
    }
}

/// Returns the buffer of the first sync manager that is an enabled mailbox of this direction with at least [`SMALLEST`]
/// bytes.
fn find(registers: &[u8], first: u16, to_device: bool) -> Option<Buffer> {
    let managers = registers.chunks_exact(usize::from(REGISTERS)).zip((first..).step_by(usize::from(REGISTERS)));
    managers.filter_map(|(registers, at)| Some((registers.first_chunk::<7>()?, at))).find_map(|(registers, at)| {
        let [start_low, start_high, length_low, length_high, control, _, enable] = *registers;
        let length = u16::from_le_bytes([length_low, length_high]);
        let is_mailbox = control & 0x03 == 0x02 && enable & 1 != 0 && usize::from(length) >= SMALLEST;
        let is_it = is_mailbox && (control & 0x0C == 0x04) == to_device;
        is_it.then_some(Buffer { state: at + STATE, address: u16::from_le_bytes([start_low, start_high]), length })
    })
}

/// A message that is padded to the length of the mailbox. The write of the last byte passes the mailbox to the device.
struct Message<'d> {
    head: &'d [u8],
    data: &'d [u8],
    length: usize,
}

impl EtherCrabWireWrite for Message<'_> {
    fn pack_to_slice_unchecked<'buf>(&self, buf: &'buf mut [u8]) -> &'buf [u8] {
        let bytes = self.head.iter().chain(self.data).copied().chain(core::iter::repeat(0));
        buf.iter_mut().take(self.length).zip(bytes).for_each(|(to, from)| *to = from);
        buf.get(..self.length).unwrap_or_default()
    }

    fn packed_len(&self) -> usize {
        self.length
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::abort::AbortCode;

    #[test]
    fn answers_about_another_object_are_those_of_a_transfer_that_was_given_up() {
        let (object, other) = (Object::new(0x6040, 0), Object::new(0x6041, 0));
        let code = AbortCode::NO_OBJECT;
        for late in [
            Answer::Upload { object: other, size: None, data: &[1, 2] },
            Answer::Download { object: other },
            Answer::Abort { object: other, code },
            Answer::Foreign,
        ] {
            assert!(matches!(Sought::<()>::of(late, object), Sought::Other), "{late:?}");
        }
        let refused = Sought::<()>::of(Answer::Abort { object, code }, object);
        assert!(matches!(refused, Sought::Failed(Error::Abort(AbortCode::NO_OBJECT))));
        for wrong in [Answer::Download { object }, Answer::UploadSegment { toggle: true, last: true, data: &[] }] {
            assert!(matches!(Sought::<()>::of(wrong, object), Sought::Failed(Error::UnexpectedReply)), "{wrong:?}");
        }
    }
}
