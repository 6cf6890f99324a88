//! Where the data of each submodule are in the frames of a device, and what carries these.

use core::time::Duration;

use super::io::{IoData, IoStatus, WithStatus};
use super::plan::Plan;
use crate::client::sleep;
use crate::error::Error;
use crate::value_error::LengthError;

/// Exchanges the process image of one device with it, waiting for each cycle.
///
/// A frame of outputs or inputs is what an IOCR carries: the data objects with their provider status, and the consumer status
/// of what goes the other way. [`Plan::layout`] says where each of them is.
///
/// ```
/// use lexibus::profinet::ImageClient;
/// use lexibus::{Error, LengthError};
///
/// /// A device that sends back what it gets.
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
    /// What can go wrong on the bus.
    type Error;

    /// Sends `outputs` in the next frame, and fills `inputs` with what the device sent last.
    ///
    /// Both are as long as [`Plan::lengths`] says. A library that has its own cycle copies, and doesn't wait.
    ///
    /// # Errors
    ///
    /// [`Error::Client`] where the bus fails, or the device is gone, [`Error::Length`] where a frame has another length.
    fn cycle(&mut self, outputs: &[u8], inputs: &mut [u8]) -> Result<(), Error<Self::Error>>;

    /// Waits so long, as [`Client::wait`](crate::Client::wait) does. [`Cyclic`](super::Cyclic) calls it between two cycles of an
    /// access that takes time, with at most 1 ms.
    ///
    /// # Errors
    ///
    /// [`Error::NoClock`] where there is no clock: unless said otherwise, without the feature `std`.
    fn wait(&mut self, time: Duration) -> Result<(), Error<Self::Error>> {
        sleep(time)
    }
}

/// Exchanges the process image of one device with it without blocking. The same rules as for [`ImageClient`].
///
/// ```
/// use lexibus::profinet::AsyncImageClient;
/// use lexibus::Error;
///
/// /// A device whose data never are valid.
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
    /// What can go wrong on the bus.
    type Error;

    /// Sends `outputs` and fills `inputs`, as [`ImageClient::cycle`] does.
    ///
    /// # Errors
    ///
    /// The same as of [`ImageClient::cycle`].
    async fn cycle(&mut self, outputs: &[u8], inputs: &mut [u8]) -> Result<(), Error<Self::Error>>;

    /// Waits so long, as [`AsyncClient::wait`](crate::AsyncClient::wait) does.
    ///
    /// # Errors
    ///
    /// [`Error::NoClock`] where there is no clock: always, unless said otherwise.
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

/// Some bytes of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct IoSpan {
    /// Where they begin: bytes from the start of the frame.
    pub offset: usize,
    /// How many they are.
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

/// Where the data and the status of one submodule are.
///
/// `None` where the submodule doesn't have it: then reading and writing fail, as beyond the end of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct SubmoduleIo {
    /// Slot.
    pub slot: u16,
    /// Subslot.
    pub subslot: u16,
    /// Data and provider status of the inputs, in the frame of inputs. No data, and a status, where the submodule has no data at
    /// all.
    pub inputs: Option<IoSpan>,
    /// Data and provider status of the outputs, in the frame of outputs.
    pub outputs: Option<IoSpan>,
    /// The controller's status of the inputs (IOCS), in the frame of outputs.
    pub inputs_consumer: Option<IoSpan>,
    /// The device's status of the outputs (IOCS), in the frame of inputs.
    pub outputs_consumer: Option<IoSpan>,
}

impl SubmoduleIo {
    /// The same as the device has it, which reads outputs and writes inputs: for simulated ones.
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

    /// The inputs `T` of the submodule and their provider status, in the frame of inputs.
    ///
    /// # Errors
    ///
    /// When the submodule has inputs of another length, or the frame is too short.
    pub fn read<T: IoData>(&self, inputs: &[u8]) -> Result<WithStatus<T>, LengthError> {
        WithStatus::read(object::<T>(self.inputs)?.of(inputs)?)
    }

    /// Writes the outputs `T` of the submodule with their provider status to the frame of outputs.
    ///
    /// # Errors
    ///
    /// When the submodule has outputs of another length, or the frame is too short.
    pub fn write<T: IoData>(&self, outputs: &mut [u8], data: T, provider: IoStatus) -> Result<(), LengthError> {
        WithStatus { data, provider }.write(object::<T>(self.outputs)?.of_mut(outputs)?)
    }

    /// What the device says of the outputs that it got, in the frame of inputs; [`IoStatus::BAD`] where there are none.
    #[must_use]
    pub fn consumer(&self, inputs: &[u8]) -> IoStatus {
        let status = self.outputs_consumer.and_then(|span| span.of(inputs).ok());
        IoStatus::from_bytes(status.unwrap_or_default())
    }

    /// Writes what the controller says of the inputs that it got to the frame of outputs.
    ///
    /// # Errors
    ///
    /// When the frame is too short. Nothing happens where the submodule has no inputs.
    pub fn set_consumer(&self, outputs: &mut [u8], status: IoStatus) -> Result<(), LengthError> {
        if let Some(span) = self.inputs_consumer {
            status.write(span.of_mut(outputs)?);
        }
        Ok(())
    }
}

/// The span of a `T`, if it is as long as that.
fn object<T: IoData>(span: Option<IoSpan>) -> Result<IoSpan, LengthError> {
    let error = LengthError::new(WithStatus::<T>::LEN, span.map_or(0, |span| span.length));
    span.filter(|span| span.length == WithStatus::<T>::LEN).ok_or(error)
}

/// The next `length` bytes of a frame.
fn take(end: &mut usize, length: usize) -> Option<IoSpan> {
    let span = IoSpan { offset: *end, length };
    *end += length;
    Some(span)
}

impl<const N: usize> Plan<N> {
    /// Where the data and the status of each submodule are in the frames, by slot and subslot.
    ///
    /// A controller chooses the places and tells the device when it connects. These follow one another without a gap, and
    /// are as long together as [`Plan::lengths`] says.
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

    /// Where the data and the status of the submodule in `subslot` of `slot` are; `None` where there is none.
    #[must_use]
    pub fn submodule_io(&self, slot: u16, subslot: u16) -> Option<SubmoduleIo> {
        self.layout().find(|io| (io.slot, io.subslot) == (slot, subslot))
    }

    /// Writes `status` as the provider status of all outputs, and as the consumer status of all inputs, to the frame of outputs.
    ///
    /// # Errors
    ///
    /// When the frame is too short.
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
