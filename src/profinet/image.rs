//! Process image: the layout of frames, and the clients that exchange frames.

use core::time::Duration;

use super::io::{IoData, IoStatus, WithStatus};
use super::plan::Plan;
use crate::client::sleep;
use crate::error::Error;
use crate::value_error::LengthError;

/// A blocking client that exchanges the process image of one device.
///
/// A frame is the content of an input/output communication relation (IOCR). A frame contains the data of submodules
/// with their provider status, and the consumer status of the opposite direction. [`Plan::layout`] returns the offsets
/// of the data.
///
/// ```
/// use lexibus::profinet::ImageClient;
/// use lexibus::{Error, LengthError};
///
/// /// A device whose inputs are a copy of its outputs.
/// struct Mirror;
///
/// impl ImageClient for Mirror {
///     type Error = core::convert::Infallible;
///
///     fn cycle(&mut self, outputs: &[u8], inputs: &mut [u8]) -> Result<(), Error<Self::Error>> {
///         if inputs.len() != outputs.len() {
///             return Err(Error::Length(LengthError::new(outputs.len(), inputs.len())));
///         }
///         inputs.copy_from_slice(outputs);
///         Ok(())
///     }
/// }
///
/// let mut inputs = [0; 3];
/// Mirror.cycle(&[0x12, 0x34, 0x80], &mut inputs)?;
/// assert_eq!(inputs, [0x12, 0x34, 0x80]);
/// # Ok::<(), Error<core::convert::Infallible>>(())
/// ```
pub trait ImageClient {
    /// Error type of the client.
    type Error;

    /// Sends `outputs` in the next cycle and copies the last received frame to `inputs`.
    ///
    /// [`Plan::lengths`] returns the lengths of both frames. If the bus library exchanges frames in its own cycle, this
    /// method only copies the data and returns immediately.
    ///
    /// # Errors
    ///
    /// Returns [`Error::Client`] if the bus fails or the device is disconnected, or [`Error::Length`] if a frame has
    /// the wrong length.
    fn cycle(&mut self, outputs: &[u8], inputs: &mut [u8]) -> Result<(), Error<Self::Error>>;

    /// Waits for `time`, as [`Client::wait`](crate::Client::wait) does.
    ///
    /// If an access has to wait, [`Cyclic`](super::Cyclic) calls this method between two cycles, for at most 1 ms at a
    /// time.
    ///
    /// # Errors
    ///
    /// Returns [`Error::NoClock`] if there is no clock. The default implementation returns this error without the
    /// feature `std`.
    fn wait(&mut self, time: Duration) -> Result<(), Error<Self::Error>> {
        sleep(time)
    }
}

/// An asynchronous client that exchanges the process image of one device, as [`ImageClient`] does.
///
/// ```
/// use lexibus::profinet::AsyncImageClient;
/// use lexibus::Error;
///
/// /// A device whose data are always invalid.
/// struct Bad;
///
/// impl AsyncImageClient for Bad {
///     type Error = core::convert::Infallible;
///
///     async fn cycle(&mut self, _: &[u8], inputs: &mut [u8]) -> Result<(), Error<Self::Error>> {
///         inputs.fill(0);
///         Ok(())
///     }
/// }
/// ```
#[allow(async_fn_in_trait)]
pub trait AsyncImageClient {
    /// Error type of the client.
    type Error;

    /// Sends `outputs` and receives `inputs`, as [`ImageClient::cycle`] does.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`ImageClient::cycle`].
    async fn cycle(&mut self, outputs: &[u8], inputs: &mut [u8]) -> Result<(), Error<Self::Error>>;

    /// Waits for `time`, as [`AsyncClient::wait`](crate::AsyncClient::wait) does.
    ///
    /// # Errors
    ///
    /// The default implementation returns [`Error::NoClock`].
    async fn wait(&mut self, time: Duration) -> Result<(), Error<Self::Error>> {
        let _ = time;
        Err(Error::NoClock)
    }
}

macro_rules! borrowed {
    ($Client:ident $($async:ident $await:ident)?) => {
        impl<T: $Client + ?Sized> $Client for &mut T {
            type Error = T::Error;

            $($async)? fn cycle(&mut self, outputs: &[u8], inputs: &mut [u8]) -> Result<(), Error<T::Error>> {
                T::cycle(self, outputs, inputs)$(.$await)?
            }

            $($async)? fn wait(&mut self, time: Duration) -> Result<(), Error<T::Error>> {
                T::wait(self, time)$(.$await)?
            }
        }
    };
}

borrowed! { ImageClient }
borrowed! { AsyncImageClient async await }

/// A range of bytes in a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct IoSpan {
    /// Offset from the start of the frame in bytes.
    pub offset: usize,
    /// Length in bytes.
    pub length: usize,
}

impl IoSpan {
    pub(super) fn of(self, frame: &[u8]) -> Result<&[u8], LengthError> {
        let error = LengthError::new(self.offset.saturating_add(self.length), frame.len());
        frame.get(self.offset..).and_then(|rest| rest.get(..self.length)).ok_or(error)
    }

    pub(super) fn of_mut(self, frame: &mut [u8]) -> Result<&mut [u8], LengthError> {
        let error = LengthError::new(self.offset.saturating_add(self.length), frame.len());
        frame.get_mut(self.offset..).and_then(|rest| rest.get_mut(..self.length)).ok_or(error)
    }
}

/// Positions of the data and the status of one submodule in the frames.
///
/// A position is `None` if the submodule has no such data. [`read`](Self::read) returns [`LengthError`] if `inputs` is
/// `None`, and [`write`](Self::write) if `outputs` is `None`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct SubmoduleIo {
    /// Number of the slot.
    pub slot: u16,
    /// Number of the subslot.
    pub subslot: u16,
    /// Inputs with their provider status, in the input frame. If the submodule has neither inputs nor outputs, the span
    /// contains only the status.
    pub inputs: Option<IoSpan>,
    /// Outputs with their provider status, in the output frame.
    pub outputs: Option<IoSpan>,
    /// Consumer status (IOCS) of the inputs. The controller sets this status in the output frame.
    pub inputs_consumer: Option<IoSpan>,
    /// Consumer status (IOCS) of the outputs. The device sets this status in the input frame.
    pub outputs_consumer: Option<IoSpan>,
}

impl SubmoduleIo {
    /// Returns the positions with inputs and outputs swapped, for a simulated device, which reads outputs and writes
    /// inputs.
    #[must_use]
    pub const fn of_device(self) -> Self {
        Self {
            inputs: self.outputs,
            outputs: self.inputs,
            inputs_consumer: self.outputs_consumer,
            outputs_consumer: self.inputs_consumer,
            ..self
        }
    }

    /// Reads the inputs `T` of the submodule and the provider status of the inputs from the input frame.
    ///
    /// # Errors
    ///
    /// Returns [`LengthError`] if the length of the inputs differs from the length of `T`, or if the frame is too
    /// short.
    pub fn read<T: IoData>(&self, inputs: &[u8]) -> Result<WithStatus<T>, LengthError> {
        WithStatus::read(object::<T>(self.inputs)?.of(inputs)?)
    }

    /// Writes the outputs `T` of the submodule and the provider status of the outputs to the output frame.
    ///
    /// # Errors
    ///
    /// Returns [`LengthError`] if the length of the outputs differs from the length of `T`, or if the frame is too
    /// short.
    pub fn write<T: IoData>(&self, outputs: &mut [u8], data: T, provider: IoStatus) -> Result<(), LengthError> {
        WithStatus { data, provider }.write(object::<T>(self.outputs)?.of_mut(outputs)?)
    }

    /// Reads the consumer status of the outputs, which the device sets, from the input frame. Returns [`IoStatus::BAD`]
    /// if the submodule has no outputs or the frame is too short.
    #[must_use]
    pub fn consumer(&self, inputs: &[u8]) -> IoStatus {
        let status = self.outputs_consumer.and_then(|span| span.of(inputs).ok());
        IoStatus::from_bytes(status.unwrap_or_default())
    }

    /// Writes the consumer status of the inputs, which the controller sets, to the output frame. This method has no
    /// effect if the submodule has only outputs.
    ///
    /// # Errors
    ///
    /// Returns [`LengthError`] if the frame is too short.
    pub fn set_consumer(&self, outputs: &mut [u8], status: IoStatus) -> Result<(), LengthError> {
        if let Some(span) = self.inputs_consumer {
            status.write(span.of_mut(outputs)?);
        }
        Ok(())
    }
}

/// Returns the span if it has the length of `T` with trailer and status.
fn object<T: IoData>(span: Option<IoSpan>) -> Result<IoSpan, LengthError> {
    let error = LengthError::new(WithStatus::<T>::LEN, span.map_or(0, |span| span.length));
    span.filter(|span| span.length == WithStatus::<T>::LEN).ok_or(error)
}

/// Returns the span of `length` bytes at offset `end`, and increases `end` by `length`.
fn take(end: &mut usize, length: usize) -> Option<IoSpan> {
    let span = IoSpan { offset: *end, length };
    *end += length;
    Some(span)
}

impl<const N: usize> Plan<N> {
    /// Returns the positions of all data and status in the frames, sorted by slot and subslot.
    ///
    /// The controller chooses the positions and sends them to the device during the connection setup. The layout that
    /// this method returns has no gaps. [`Plan::lengths`] returns the lengths of the frames.
    pub fn layout(&self) -> impl Iterator<Item = SubmoduleIo> + '_ {
        self.expected().scan((0, 0), |(inputs, outputs), submodule| {
            let (provider, consumer) = (usize::from(submodule.provider_len), usize::from(submodule.consumer_len));
            let mut io = SubmoduleIo {
                slot: submodule.slot,
                subslot: submodule.subslot,
                inputs: None,
                outputs: None,
                inputs_consumer: None,
                outputs_consumer: None,
            };
            if submodule.input_len.is_some() || submodule.output_len.is_none() {
                io.inputs = take(inputs, usize::from(submodule.input_len.unwrap_or(0)) + provider);
                io.inputs_consumer = take(outputs, consumer);
            }
            if let Some(length) = submodule.output_len {
                io.outputs = take(outputs, usize::from(length) + provider);
                io.outputs_consumer = take(inputs, consumer);
            }
            Some(io)
        })
    }

    /// Returns the positions of the data and the status of one submodule. Returns `None` if the subslot is empty.
    #[must_use]
    pub fn submodule_io(&self, slot: u16, subslot: u16) -> Option<SubmoduleIo> {
        self.layout().find(|io| (io.slot, io.subslot) == (slot, subslot))
    }

    /// Writes `status` to the output frame, as provider status of all outputs and as consumer status of all inputs.
    ///
    /// # Errors
    ///
    /// Returns [`LengthError`] if the frame is too short.
    pub fn set_status(&self, outputs: &mut [u8], status: IoStatus) -> Result<(), LengthError> {
        for (io, submodule) in self.layout().zip(self.expected()) {
            io.set_consumer(outputs, status)?;
            if let Some(span) = io.outputs {
                let data = span.length.saturating_sub(usize::from(submodule.provider_len));
                let object = span.of_mut(outputs)?;
                status.write(object.get_mut(data..).unwrap_or_default());
            }
        }
        Ok(())
    }
}
