//! Check of each process data cycle.

use core::error;
use core::fmt;

use ethercrab::error::Error as BusError;
use ethercrab::subdevice_group::{Op, TxRxResponse};
use ethercrab::{AlStatusCode, Command, DefaultLock, MainDevice, RegisterAddress, SubDeviceGroup, SubDeviceState};

/// Exchanges process data and checks that all SubDevices of a group took part.
///
/// `ethercrab` returns from `tx_rx` without an error if a SubDevice didn't process the datagram, or if a SubDevice left
/// Operational. The inputs of such a SubDevice keep their values from an earlier cycle.
///
/// ```no_run
/// use ethercrab::subdevice_group::Op;
/// use ethercrab::{DefaultLock, MainDevice, SubDeviceGroup};
/// use lexibus::clients::ethercat::{Cycle, CycleError};
///
/// async fn run(
///     maindevice: &MainDevice<'_>,
///     group: &SubDeviceGroup<16, 64, DefaultLock, Op>,
/// ) -> Result<(), CycleError> {
///     let cycle = Cycle::of(maindevice, group);
///     loop {
///         cycle.run(maindevice, group).await?; // the inputs are those of this cycle
///     }
/// }
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cycle {
    working_counter: u16,
}

impl Cycle {
    /// Creates the check for a group. A SubDevice adds 1 to the working counter for its inputs, and 2 for its outputs
    /// (ETG.1000.4 5.4.1.2).
    pub fn of<const N: usize, const P: usize, DC>(
        maindevice: &MainDevice<'_>,
        group: &SubDeviceGroup<N, P, DefaultLock, Op, DC>,
    ) -> Self {
        let counts = group.iter(maindevice).map(|subdevice| {
            let (outputs, inputs) = (subdevice.outputs_raw().len(), subdevice.inputs_raw().len());
            2 * u16::from(outputs > 0) + u16::from(inputs > 0)
        });
        Self { working_counter: counts.sum() }
    }

    /// Creates the check for this expected working counter, for example for a group with process data in several
    /// frames.
    #[must_use]
    pub const fn expecting(working_counter: u16) -> Self {
        Self { working_counter }
    }

    /// Checks the response of an `ethercrab` method that exchanges process data.
    ///
    /// # Errors
    ///
    /// Returns [`CycleError::State`] if a SubDevice isn't in Operational, or [`CycleError::WorkingCounter`] if the
    /// working counter is too low.
    pub fn check<const N: usize, T>(self, response: &TxRxResponse<N, T>) -> Result<(), CycleError> {
        let mut states = response.subdevice_states.iter().copied().enumerate();
        if let Some((subdevice, state)) = states.find(|(_, state)| *state != SubDeviceState::Op) {
            return Err(CycleError::State { subdevice, state, code: None });
        }
        let (expected, actual) = (self.working_counter, response.working_counter);
        if actual < expected {
            return Err(CycleError::WorkingCounter { expected, actual });
        }
        Ok(())
    }

    /// Exchanges the process data of the group once, and checks the response. If a SubDevice has left Operational, reads
    /// its AL status code.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`check`](Self::check), or [`CycleError::Bus`] if the exchange fails, for example because
    /// a frame didn't come back. After any of these errors, the inputs are stale.
    pub async fn run<const N: usize, const P: usize, DC>(
        self,
        maindevice: &MainDevice<'_>,
        group: &SubDeviceGroup<N, P, DefaultLock, Op, DC>,
    ) -> Result<(), CycleError> {
        match self.check(&group.tx_rx(maindevice).await.map_err(CycleError::Bus)?) {
            Err(CycleError::State { subdevice, state, .. }) => {
                let code = code(maindevice, group, subdevice).await.ok();
                Err(CycleError::State { subdevice, state, code })
            }
            checked => checked,
        }
    }
}

/// Reads the AL status code of a SubDevice.
async fn code<const N: usize, const P: usize, DC>(
    maindevice: &MainDevice<'_>,
    group: &SubDeviceGroup<N, P, DefaultLock, Op, DC>,
    index: usize,
) -> Result<AlStatusCode, BusError> {
    // `SubDeviceRef::status` fails if the error flag of the AL status is set.
    let station = group.subdevice(maindevice, index)?.configured_address();
    Command::fprd(station, RegisterAddress::AlStatusCode.into()).receive(maindevice).await
}

/// Reason why the inputs of a cycle are stale.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum CycleError {
    /// The exchange failed, for example because a frame didn't come back.
    Bus(BusError),
    /// Fewer SubDevices than expected processed the datagram.
    WorkingCounter {
        /// Working counter if all SubDevices take part.
        expected: u16,
        /// Working counter of this cycle.
        actual: u16,
    },
    /// A SubDevice isn't in Operational.
    State {
        /// Index of the SubDevice in the group.
        subdevice: usize,
        /// State of the SubDevice.
        state: SubDeviceState,
        /// AL status code of the SubDevice; `NoError` if the SubDevice reports no error. `None` if the code was not read,
        /// because [`Cycle::check`] doesn't read it, or because the read failed.
        code: Option<AlStatusCode>,
    },
}

impl fmt::Display for CycleError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Bus(error) => error.fmt(f),
            Self::WorkingCounter { expected, actual } => {
                write!(f, "stale inputs: the working counter is {actual} instead of {expected}")
            }
            Self::State { subdevice, state, code } => {
                write!(f, "stale inputs: SubDevice {subdevice} of the group is in state {state}")?;
                code.map_or(Ok(()), |code| write!(f, ", AL status code {code}"))
            }
        }
    }
}

impl error::Error for CycleError {}
