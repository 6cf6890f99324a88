//! CANopen over EtherCAT, with `ethercrab` as the master. Needs Rust 1.85, as `ethercrab` does.
//!
//! [`Sdo`] reads and writes the objects of one SubDevice, in all states from Pre-Operational on. You can keep an
//! [`Sdo`] while the group of the SubDevice changes its state in `ethercrab`.
//!
//! ```no_run
//! use ethercrab::{std::ethercat_now, MainDevice};
//! use lexibus::clients::ethercat::{is_a, Cycle, Sdo};
//! use lexibus::ethercat::Assignment;
//!
//! lexibus::dictionary! {
//!     /// Bindings of the drive.
//!     pub mod servo = "examples/support/servo.esi.xml" { strict: true }
//! }
//! use servo::{image, pdo};
//!
//! async fn drive(maindevice: &MainDevice<'_>) -> Result<(), Box<dyn std::error::Error>> {
//!     let group = maindevice.init_single_group::<16, 64>(ethercat_now).await?;
//!
//!     // In Pre-Operational: write objects and assign PDOs.
//!     let subdevice = group.subdevice(maindevice, 0)?;
//!     assert!(is_a(&subdevice, &servo::IDENTITY));
//!     let client = Sdo::new(maindevice, &subdevice).with_timer(tokio::time::sleep); // pauses between polls
//!     let mut drive = servo::DemoServo::new(client);
//!     drive.profile_velocity().write_async(250_000).await?;
//!     let assignment = Assignment::<8>::by_default(&servo::DEVICE)?;
//!     drive.client().configure(assignment.startup()).await?;
//!
//!     // In Operational: exchange process data.
//!     let group = group.into_op(maindevice).await?;
//!     let cycle = Cycle::of(maindevice, &group);
//!     loop {
//!         cycle.run(maindevice, &group).await?; // stale inputs are an error
//!         let subdevice = group.subdevice(maindevice, 0)?;
//!         let inputs = image::Inputs::unpack(&subdevice.inputs_raw())?;
//!         let mut outputs = subdevice.outputs_raw_mut();
//!         image::OutputsView::new(&mut outputs[..])?
//!             .position_mode_mut()
//!             .set_target_position(inputs.position.position_actual_value + 100);
//!     }
//! }
//! ```
//!
//! # Memory of the slave controller
//!
//! [`Memory`] reads and writes items with an address in the memory of the slave controller: AL status, error counters,
//! and other registers that the device's manual lists.
//!
//! # Process data
//!
//! `ethercrab` reads the PDO assignment from the device, and provides the inputs and outputs of a SubDevice as byte
//! slices. If the default PDOs are assigned, generated `image` types convert the byte slices: use `Inputs::unpack`,
//! `Outputs::pack`, or views that access single fields. For another assignment,
//! [`Assignment::find`](crate::ethercat::Assignment::find) returns the bit offset of a PDO. Pass the bit offset to
//! `view::…::at` of the PDO. If a device has several sync managers for one direction, the slice contains their data one
//! after the other. The data of each sync manager start at a byte boundary.
//!
//! # Why not `sdo_read` and `sdo_write` of `ethercrab`
//!
//! In version 0.7.1 of `ethercrab`, `sdo_write` writes at most 4 bytes, and `sdo_read` cannot read segmented values.
//! Both functions fail or panic if the device sends an emergency message before its reply. [`Sdo`] exchanges the
//! mailbox messages itself, in datagrams of `ethercrab`, and needs no buffer.

mod cycle;
mod mailbox;
mod memory;
mod protocol;
#[doc(hidden)]
pub mod wire;

use core::time::Duration;

use ethercrab::error::Error as BusError;
use ethercrab::{MainDevice, SubDevice};

pub use self::cycle::{Cycle, CycleError};
pub use self::memory::Memory;

use self::mailbox::{Mailbox, Sought};
use self::protocol::{Answer, Command};
use crate::bus::{CoE, Object};
use crate::client::AsyncClient;
use crate::clock::{DefaultClock, Timer};
use crate::emergency::Emergency;
use crate::error::Error;
use crate::ethercat::StartupCommand;
use crate::identity::Identity;
use crate::pdo::SdoWriteError;
use crate::value_error::LengthError;

/// Default timeout of a mailbox exchange, and of a transfer that needs only one exchange.
pub const TIMEOUT: Duration = Duration::from_secs(1);

/// Returns whether a SubDevice matches a description: vendor and product code are equal, unless the description omits
/// them.
#[must_use]
pub fn is_a(subdevice: &SubDevice, identity: &Identity) -> bool {
    let actual = subdevice.identity();
    let fits = |described: Option<u32>, found: u32| described.map_or(true, |described| described == found);
    fits(identity.vendor_id, actual.vendor_id) && fits(identity.product_code, actual.product_id)
}

/// SDO client for the objects of one SubDevice: expedited, normal and segmented transfers through its mailbox
/// (ETG.1000.6 5.6.2).
///
/// Run only one transfer with a SubDevice at a time, including those of `ethercrab`, because the SubDevice has only one
/// mailbox. You can drop a transfer before it ends.
///
/// # Late replies
///
/// A reply identifies its request only by the object. After a timeout, an unexpected reply or a dropped transfer, the
/// next transfer first waits for the missing reply and discards it. This wait takes at most one timeout. If a datagram
/// with a reply is lost, the client requests the reply again.
///
/// # Pauses between polls
///
/// The client polls the mailbox until it contains the reply. `T` is the [`Timer`] that pauses between two polls, for
/// half a millisecond. The default timer doesn't pause, because a timer depends on the executor. Without a pause, the
/// client polls the mailbox continuously, once in each frame round trip. Set a timer to avoid this:
///
/// ```no_run
/// # use ethercrab::{MainDevice, SubDevice};
/// # use lexibus::clients::ethercat::Sdo;
/// # fn client(maindevice: &'static MainDevice<'static>, subdevice: &SubDevice) {
/// let client = Sdo::new(maindevice, subdevice).with_timer(tokio::time::sleep); // or `embassy_time::Timer::after`
/// # }
/// ```
#[derive(Debug)]
pub struct Sdo<'m, T = DefaultClock> {
    mailbox: Mailbox<'m, T>,
}

impl<'m> Sdo<'m> {
    /// Creates the client for `subdevice`.
    pub fn new(maindevice: &'m MainDevice<'m>, subdevice: &SubDevice) -> Self {
        Self { mailbox: Mailbox::new(maindevice, subdevice.configured_address()) }
    }
}

impl<'m, T: Timer> Sdo<'m, T> {
    /// Returns the client with a timer, which pauses between two polls of the mailbox.
    #[must_use]
    pub fn with_timer<U: Timer>(self, timer: U) -> Sdo<'m, U> {
        Sdo { mailbox: self.mailbox.with_timer(timer) }
    }

    /// Sets the timeout for each mailbox exchange, which is a request and its reply. The default is [`TIMEOUT`].
    #[must_use]
    pub fn with_timeout(mut self, timeout: Duration) -> Self {
        self.mailbox.timeout = timeout;
        self
    }

    /// Returns the client with a clock: a function that returns the time since any fixed moment. Without the feature
    /// `std` and without a clock, an exchange ends when the sum of its pauses reaches the timeout. Without a clock and
    /// without a [timer](Self::with_timer), an exchange ends after 20,000 polls of the mailbox. Each poll takes one
    /// frame round trip, typically 50 to 200 µs.
    #[must_use]
    pub fn with_clock(mut self, clock: fn() -> Duration) -> Self {
        self.mailbox.clock = Some(clock);
        self
    }

    /// Returns the last emergency message that arrived during a transfer or was waiting before it, and removes the
    /// message from the client.
    pub fn take_emergency(&mut self) -> Option<Emergency> {
        self.mailbox.emergency.take()
    }

    /// Sends a start-up list, for example [`Assignment::startup`](crate::ethercat::Assignment::startup) or the constant
    /// `STARTUP` of a generated device, with complete access for the commands that request it. Call this method in
    /// state `PreOp`, before the group changes to `PreOpPdi` or `SafeOp`. `ethercrab` reads the PDO assignment during
    /// the transitions to these two states.
    ///
    /// # Errors
    ///
    /// Returns the first write that fails, with its error. The remaining commands are not sent.
    pub async fn configure(
        &mut self,
        commands: impl IntoIterator<Item: Into<StartupCommand>>,
    ) -> Result<(), SdoWriteError<BusError>> {
        for command in commands {
            let command = command.into();
            let sent = self.download(command.object, command.complete_access, command.data()).await;
            sent.map_err(|error| SdoWriteError { write: command.write(), error })?;
        }
        Ok(())
    }

    /// Reads all entries of an object at once, starting at entry `from` (complete access, ETG.1000.6 5.6.2.1). Returns
    /// the length in bytes. With complete access, sub-index 0 takes two bytes.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`AsyncClient::read`].
    pub async fn read_complete(&mut self, from: Object, buffer: &mut [u8]) -> Result<usize, Error<BusError>> {
        self.upload(from, true, buffer).await
    }

    /// Writes all entries of an object at once, starting at entry `from`.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`AsyncClient::write`].
    pub async fn write_complete(&mut self, from: Object, data: &[u8]) -> Result<(), Error<BusError>> {
        self.download(from, true, data).await
    }

    async fn upload(&mut self, object: Object, complete: bool, buffer: &mut [u8]) -> Result<usize, Error<BusError>> {
        self.mailbox.begin().await?;
        let request = protocol::upload(object, complete);
        let begun = self.mailbox.exchange(&request, &[], |answer| match answer {
            Answer::Upload { object: of, size, data } if of == object => {
                let filled = fill(buffer, 0, data);
                // If the reply has no length, the value has the requested length.
                Sought::Found((size.unwrap_or(data.len().min(buffer.len())), filled))
            }
            // This segment belongs to an earlier transfer that was dropped.
            Answer::UploadSegment { .. } => Sought::Other,
            other => Sought::of(other, object),
        });
        let (size, mut have) = begun.await?;
        if size > buffer.len() {
            // The remaining segments are not needed. The device discards them at the next request.
            return Err(Error::Length(LengthError::new(buffer.len(), size)));
        }
        let mut toggle = false;
        while have < size {
            self.mailbox.extend();
            let request = protocol::upload_segment(toggle);
            let segment = self.mailbox.exchange(&request, &[], |answer| match answer {
                Answer::UploadSegment { toggle: of, last, data } if of == toggle => {
                    Sought::Found((last, fill(buffer, have, data)))
                }
                other => Sought::of(other, object),
            });
            let (last, more) = segment.await?;
            have += more;
            toggle = !toggle;
            if last != (have >= size) || more == 0 {
                return Err(Error::UnexpectedReply);
            }
        }
        Ok(size)
    }

    async fn download(&mut self, object: Object, complete: bool, data: &[u8]) -> Result<(), Error<BusError>> {
        let room = self.mailbox.room().await?;
        self.mailbox.begin().await?;
        let (request, mut sent) = protocol::download(object, complete, data, room);
        let first = data.get(..sent).filter(|_| request.command() == Command::Normal).unwrap_or(&[]);
        let begun = self.mailbox.exchange(&request, first, |answer| match answer {
            Answer::Download { object: of } if of == object => Sought::Found(()),
            Answer::DownloadSegment { .. } => Sought::Other,
            other => Sought::of(other, object),
        });
        begun.await?;
        let mut toggle = false;
        while let Some(rest) = data.get(sent..).filter(|rest| !rest.is_empty()) {
            self.mailbox.extend();
            let (request, length) = protocol::download_segment(toggle, rest.len(), room);
            let part = rest.get(..length).unwrap_or(rest);
            let segment = self.mailbox.exchange(&request, part, |answer| match answer {
                Answer::DownloadSegment { toggle: of } if of == toggle => Sought::Found(()),
                other => Sought::of(other, object),
            });
            segment.await?;
            sent += length;
            toggle = !toggle;
        }
        Ok(())
    }
}

/// Copies as much of `data` as fits to `buffer`, starting at index `at`, and returns the length of `data`.
fn fill(buffer: &mut [u8], at: usize, data: &[u8]) -> usize {
    let room = buffer.get_mut(at..).unwrap_or_default();
    room.iter_mut().zip(data).for_each(|(to, from)| *to = *from);
    data.len()
}

impl<T: Timer> AsyncClient for Sdo<'_, T> {
    type Bus = CoE;
    type Error = BusError;

    async fn read(&mut self, address: Object, buffer: &mut [u8]) -> Result<usize, Error<BusError>> {
        self.upload(address, false, buffer).await
    }

    async fn write(&mut self, address: Object, data: &[u8]) -> Result<(), Error<BusError>> {
        self.download(address, false, data).await
    }

    /// Waits with the [timer](Sdo::with_timer). Returns [`Error::NoClock`] without a timer.
    async fn wait(&mut self, time: Duration) -> Result<(), Error<BusError>> {
        self.mailbox.wait(time).await
    }

    fn now(&mut self) -> Option<Duration> {
        self.mailbox.now()
    }
}
