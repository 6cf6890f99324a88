//! Access to the items in the process image of a submodule.

use core::time::Duration;

use super::image::{AsyncImageClient, ImageClient, IoSpan, SubmoduleIo};
use super::io::IoStatus;
use crate::abort::AbortCode;
use crate::bus::ProcessImage;
use crate::client::{AsyncClient, Client, Write};
use crate::error::Error;
use crate::image_field::ImageField;
use crate::value_error::LengthError;

/// Pause between two cycles during [`Cyclic::wait`](crate::Client::wait). The last pause can be shorter.
const CYCLE: Duration = Duration::from_millis(1);

/// A client for the items in the cyclic data of one submodule.
///
/// `Cyclic` implements [`Client`] for the bus [`ProcessImage`] if `I` is an [`ImageClient`], and [`AsyncClient`] if `I`
/// is an [`AsyncImageClient`]. `O` is the type of the output frame and `N` the type of the input frame: an array, a
/// vector or borrowed bytes.
///
/// Outputs keep the values that were written last. The caller sets the status of the outputs, for example with
/// [`Plan::set_status`](super::Plan::set_status). Each access exchanges the frames once: a write changes the output
/// frame and then exchanges the frames, and a read exchanges the frames and then returns the value. If the program has
/// its own cycle, call [`by_hand`](Self::by_hand). After this call, reads and writes don't exchange the frames, and one
/// [`cycle`](Self::cycle) can send several fields together.
///
/// ```
/// use lexibus::profinet::{Cyclic, ImageClient, SubmoduleIo, IoSpan, IoStatus};
/// use lexibus::{Error, Flags, ImageField, Initial, Item, OnImage, Range, Ro, Wo};
///
/// // Generated code for two fields of a process image:
/// const TARGET: Item<i32, Wo, OnImage> =
///     Item::new(OnImage::field(ImageField::output(24, 32)), "Target", Range::Full, Initial::Unknown, "", Flags::NONE);
/// const ACTUAL: Item<i32, Ro, OnImage> =
///     Item::new(OnImage::field(ImageField::input(24, 32)), "Actual", Range::Full, Initial::Unknown, "", Flags::NONE);
///
/// /// A drive without following error. Each direction has 32 bytes and their provider status.
/// struct Quick;
///
/// impl ImageClient for Quick {
///     type Error = core::convert::Infallible;
///
///     fn cycle(&mut self, outputs: &[u8], inputs: &mut [u8]) -> Result<(), Error<Self::Error>> {
///         inputs.copy_from_slice(outputs);
///         Ok(())
///     }
/// }
///
/// let span = Some(IoSpan { offset: 0, length: 33 });
/// let submodule = SubmoduleIo { slot: 1, subslot: 1, inputs: span, outputs: span, inputs_consumer: None, outputs_consumer: None };
/// let mut outputs = [0; 33];
/// IoStatus::GOOD.write(&mut outputs[32..]);
/// let mut drive = Cyclic::new(Quick, submodule, outputs, [0; 33]);
/// TARGET.at(&mut drive).write(60_000)?;
/// assert_eq!(ACTUAL.at(&mut drive).read()?, 60_000);
/// # Ok::<(), Error<core::convert::Infallible>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Cyclic<I, O, N> {
    image: I,
    submodule: SubmoduleIo,
    outputs: O,
    inputs: N,
    is_by_hand: bool,
}

impl<I, O: AsRef<[u8]> + AsMut<[u8]>, N: AsRef<[u8]> + AsMut<[u8]>> Cyclic<I, O, N> {
    /// Creates a client for the data of `submodule` in the frames that `image` exchanges.
    pub const fn new(image: I, submodule: SubmoduleIo, outputs: O, inputs: N) -> Self {
        Self { image, submodule, outputs, inputs, is_by_hand: false }
    }

    /// Disables the frame exchange in reads and writes. The caller must call [`cycle`](Self::cycle) or
    /// [`cycle_async`](Self::cycle_async) instead. [`Client::wait`] still exchanges frames.
    #[must_use]
    pub fn by_hand(self) -> Self {
        Self { is_by_hand: true, ..self }
    }

    /// Returns the image client.
    pub fn image(&mut self) -> &mut I {
        &mut self.image
    }

    /// Returns the output frame for the next cycle.
    pub fn outputs(&mut self) -> &mut [u8] {
        self.outputs.as_mut()
    }

    /// Returns the input frame of the last cycle.
    pub fn inputs(&self) -> &[u8] {
        self.inputs.as_ref()
    }

    /// Returns the image client and drops `self`.
    pub fn into_image(self) -> I {
        self.image
    }

    /// Reads a field from the current frames.
    fn get<E>(&self, field: ImageField, buffer: &mut [u8]) -> Result<usize, Error<E>> {
        let (span, frame) = match field.is_output {
            true => (self.submodule.outputs, self.outputs.as_ref()),
            false => (self.submodule.inputs, self.inputs.as_ref()),
        };
        let data = span_of(span)?.of(frame)?;
        let provider = IoStatus::from_bytes(data.get(data.len().saturating_sub(1)..).unwrap_or_default());
        if !field.is_output && !provider.is_good() {
            return Err(Error::InvalidData);
        }
        Ok(field.get(data, buffer)?)
    }

    /// Writes a field to the output frame.
    fn put<E>(&mut self, field: ImageField, data: &[u8]) -> Result<(), Error<E>> {
        if !field.is_output {
            return Err(Error::Abort(AbortCode::READ_ONLY));
        }
        Ok(field.put(span_of(self.submodule.outputs)?.of_mut(self.outputs.as_mut())?, data)?)
    }
}

fn span_of(span: Option<IoSpan>) -> Result<IoSpan, LengthError> {
    span.ok_or(LengthError::new(1, 0))
}

/// Subtracts the next step from the remaining waiting time and returns the step, at most [`CYCLE`]. Returns `None` if
/// no time remains.
fn step(left: &mut Duration) -> Option<Duration> {
    let step = (*left).min(CYCLE);
    *left -= step;
    (!step.is_zero()).then_some(step)
}

macro_rules! clients {
    ($ImageClient:ident $Client:ident: $cycle:ident $($async:ident $await:ident)?) => {
        impl<I: $ImageClient, O: AsRef<[u8]> + AsMut<[u8]>, N: AsRef<[u8]> + AsMut<[u8]>> Cyclic<I, O, N> {
            /// Sends the outputs and receives the inputs.
            ///
            /// # Errors
            ///
            /// Returns the errors of [`ImageClient::cycle`].
            pub $($async)? fn $cycle(&mut self) -> Result<(), Error<I::Error>> {
                self.image.cycle(self.outputs.as_ref(), self.inputs.as_mut())$(.$await)?
            }
        }

        impl<I: $ImageClient, O: AsRef<[u8]> + AsMut<[u8]>, N: AsRef<[u8]> + AsMut<[u8]>> $Client for Cyclic<I, O, N> {
            type Bus = ProcessImage;
            type Error = I::Error;

            $($async)? fn read(&mut self, field: ImageField, buffer: &mut [u8]) -> Result<usize, Error<I::Error>> {
                if !self.is_by_hand {
                    self.$cycle()$(.$await)??;
                }
                self.get(field, buffer)
            }

            $($async)? fn write(&mut self, field: ImageField, data: &[u8]) -> Result<(), Error<I::Error>> {
                self.put(field, data)?;
                if self.is_by_hand {
                    return Ok(());
                }
                self.$cycle()$(.$await)?
            }

            /// Sends both values in the same cycle.
            $($async)? fn write_both(&mut self, writes: [Write<'_, ProcessImage>; 2]) -> Result<(), Error<I::Error>> {
                writes.into_iter().try_for_each(|(field, data)| self.put(field, data))?;
                if self.is_by_hand {
                    return Ok(());
                }
                self.$cycle()$(.$await)?
            }

            /// Waits, and exchanges frames during the waiting time.
            $($async)? fn wait(&mut self, time: Duration) -> Result<(), Error<I::Error>> {
                let mut left = time;
                self.$cycle()$(.$await)??;
                while let Some(step) = step(&mut left) {
                    self.image.wait(step)$(.$await)??;
                    self.$cycle()$(.$await)??;
                }
                Ok(())
            }
        }
    };
}

clients! { ImageClient Client: cycle }
clients! { AsyncImageClient AsyncClient: cycle_async async await }
