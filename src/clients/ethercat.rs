//! CANopen over EtherCAT, with `ethercrab` as the master. Needs Rust 1.85, as that library does.
//!
//! [`Sdo`] reads and writes the objects of one SubDevice, from Pre-Operational on. The group of `ethercrab` that the
//! SubDevice is in may change its state meanwhile: a client outlives it.
//!
//! ```no_run
//! use ethercrab::{std::ethercat_now, MainDevice};
//! use lexibus::clients::ethercat::{is_a, Sdo};
//! use lexibus::ethercat::Assignment;
//!
//! lexibus::dictionary! {
//!     /// The drive.
//!     pub mod servo = "examples/support/servo.esi.xml" { strict: true }
//! }
//! use servo::{image, pdo};
//!
//! async fn drive(maindevice: &MainDevice<'_>) -> Result<(), Box<dyn std::error::Error>> {
//!     let group = maindevice.init_single_group::<16, 64>(ethercat_now).await?;
//!
//!     // Pre-Operational: objects, and the PDOs to be exchanged.
//!     let subdevice = group.subdevice(maindevice, 0)?;
//!     assert!(is_a(&subdevice, &servo::IDENTITY));
//!     let mut drive = servo::DemoServo::new(Sdo::new(maindevice, &subdevice));
//!     drive.profile_velocity().write_async(250_000).await?;
//!     let assignment = Assignment::<8>::by_default(&servo::DEVICE)?;
//!     drive.client().configure(assignment.startup()).await?;
//!
//!     // Operational: process data.
//!     let group = group.into_op(maindevice).await?;
//!     loop {
//!         group.tx_rx(maindevice).await?;
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
//! [`Memory`] reads and writes items that have an address in it: AL status, error counters, whatever a device's manual lists.
//!
//! # Process data
//!
//! `ethercrab` reads from the device which PDOs are assigned, and gives the inputs and the outputs of a SubDevice as
//! slices of bytes. Generated `image` types take them as they are, where the PDOs are those that are assigned by default:
//! `Inputs::unpack`, `Outputs::pack`, and views that read and write one field where it stands. Of another choice,
//! [`Assignment::find`](crate::ethercat::Assignment::find) tells the bit at which a PDO begins, and the PDO's `view::…::at` takes it. Where a
//! device has several sync managers of one direction, their data follow each other in the slice, each from a whole byte on.
//!
//! # Why not `sdo_read` and `sdo_write` of `ethercrab`
//!
//! In version 0.7.1 they write at most 4 bytes, read no value that comes in segments, and fail, or panic, where an emergency
//! message of the device comes before its answer. [`Sdo`] exchanges the messages of the mailbox itself, over the datagrams
//! of `ethercrab`, and needs no buffer of its own.

mod mailbox;
mod memory;
mod protocol;

use ethercrab::error::Error as BusError;
use ethercrab::{MainDevice, SubDevice};

pub use self::memory::Memory;

use self::mailbox::{Mailbox, Sought};
use self::protocol::{Answer, Command};
use crate::bus::{CoE, Object};
use crate::client::AsyncClient;
use crate::emergency::Emergency;
use crate::error::Error;
use crate::ethercat::StartupCommand;
use crate::identity::Identity;
use crate::value_error::LengthError;

/// So many times the state of a mailbox is read until it has changed, where nothing else is said. Each takes a frame there
/// and back, on most segments 50 to 200 µs.
pub const PATIENCE: u32 = 10_000;

/// Whether a SubDevice is the described one: vendor and product code are the same, as far as the description has them.
#[must_use]
pub fn is_a(subdevice: &SubDevice, identity: &Identity) -> bool {
    let actual = subdevice.identity();
    let fits = |described: Option<u32>, found: u32| described.map_or(true, |described| described == found);
    fits(identity.vendor_id, actual.vendor_id) && fits(identity.product_code, actual.product_id)
}

/// The objects of one SubDevice: SDO transfers through its mailbox (ETG.1000.6 5.6.2), expedited, normal and segmented.
///
/// Don't let two transfers with one SubDevice run at the same time, with `ethercrab`'s own means neither: it has one
/// mailbox. A transfer that is dropped half way does no harm; the next one clears the mailbox.
#[derive(Debug)]
pub struct Sdo<'m> {
    mailbox: Mailbox<'m>,
}

impl<'m> Sdo<'m> {
    /// The SubDevice `subdevice`.
    pub fn new(maindevice: &'m MainDevice<'m>, subdevice: &SubDevice) -> Self {
        Self { mailbox: Mailbox::new(maindevice, subdevice.configured_address(), PATIENCE) }
    }

    /// The same, with another number of times that the state of a mailbox is read until it has changed.
    #[must_use]
    pub fn with_patience(mut self, patience: u32) -> Self {
        self.mailbox.patience = patience;
        self
    }

    /// The last emergency message that came in front of an answer, and takes it out.
    pub fn take_emergency(&mut self) -> Option<Emergency> {
        self.mailbox.emergency.take()
    }

    /// Sends a start-up list, such as [`Assignment::startup`](crate::ethercat::Assignment::startup), with complete access
    /// where a command asks for it. To be done while the group is `PreOp` and before it becomes `PreOpPdi` or `SafeOp`,
    /// because that is when `ethercrab` reads the assignment back.
    ///
    /// # Errors
    ///
    /// The first one of a command, after which nothing more is sent.
    pub async fn configure(
        &mut self,
        commands: impl IntoIterator<Item = StartupCommand>,
    ) -> Result<(), Error<BusError>> {
        for command in commands {
            self.download(command.object, command.complete_access, command.data()).await?;
        }
        Ok(())
    }

    /// Reads all entries of an object at once (complete access, ETG.1000.6 5.6.2.1), from `from` on, and returns how many
    /// bytes there are. Sub-index 0 takes two bytes then.
    ///
    /// # Errors
    ///
    /// The same as of [`AsyncClient::read`].
    pub async fn read_complete(&mut self, from: Object, buffer: &mut [u8]) -> Result<usize, Error<BusError>> {
        self.upload(from, true, buffer).await
    }

    /// Writes all entries of an object at once, from `from` on.
    ///
    /// # Errors
    ///
    /// The same as of [`AsyncClient::write`].
    pub async fn write_complete(&mut self, from: Object, data: &[u8]) -> Result<(), Error<BusError>> {
        self.download(from, true, data).await
    }

    async fn upload(&mut self, object: Object, complete: bool, buffer: &mut [u8]) -> Result<usize, Error<BusError>> {
        let request = protocol::upload(object, complete);
        let begun = self.mailbox.exchange(&request, &[], |answer| match answer {
            Answer::Upload { object: of, size, data } if of == object => {
                let filled = fill(buffer, 0, data);
                // Where no length was sent, there are as many bytes as asked for.
                Sought::Found((size.unwrap_or(data.len().min(buffer.len())), filled))
            }
            // The next part of a value that nobody waits for any more.
            Answer::UploadSegment { .. } => Sought::Other,
            other => Sought::of(other, object),
        });
        let (size, mut have) = begun.await?;
        if size > buffer.len() {
            // The rest is of no use; the device forgets it at the next request.
            return Err(Error::Length(LengthError::new(buffer.len(), size)));
        }
        let mut toggle = false;
        while have < size {
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

/// Copies `data` to `buffer` from `at` on, as far as there is room, and returns how many bytes `data` has.
fn fill(buffer: &mut [u8], at: usize, data: &[u8]) -> usize {
    let room = buffer.get_mut(at..).unwrap_or_default();
    room.iter_mut().zip(data).for_each(|(to, from)| *to = *from);
    data.len()
}

impl AsyncClient for Sdo<'_> {
    type Bus = CoE;
    type Error = BusError;

    async fn read(&mut self, address: Object, buffer: &mut [u8]) -> Result<usize, Error<BusError>> {
        self.upload(address, false, buffer).await
    }

    async fn write(&mut self, address: Object, data: &[u8]) -> Result<(), Error<BusError>> {
        self.download(address, false, data).await
    }
}
