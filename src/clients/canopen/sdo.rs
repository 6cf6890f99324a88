//! SDO transfers (CiA 301 7.2.4): one node's objects, read and written.

use canopen_sdo::{SdoAbortCode, SdoClient, SdoConfig, SdoError, SdoFrame, SdoOutcome};

use super::frame::CanFrame;
use super::node::Node;
use super::port::{AsyncCanPort, CanPort};
use crate::abort::AbortCode;
use crate::bus::{CanOpen, Object};
use crate::client::{AsyncClient, Client};
use crate::error::{Error, LengthError};
use crate::node_id::NodeId;

/// A transfer on the default channel: requests on 0x600 + node-ID, answers on 0x580 + node-ID (CiA 301 7.3.5).
struct Transfer {
    client: SdoClient,
    answers: u16,
    outcome: Option<Outcome>,
}

/// How a transfer ended.
enum Outcome {
    Done(SdoOutcome),
    Refused(AbortCode),
    Unexpected,
    Late,
}

impl Transfer {
    fn new(node: NodeId) -> Self {
        // The times are those of the port.
        let client = SdoClient::new(SdoConfig { timeout: u64::MAX });
        Self { client, answers: SdoFrame::tsdo_id(node.get()), outcome: None }
    }

    fn upload<E>(node: NodeId, object: Object) -> Result<Self, Error<E>> {
        let mut transfer = Self::new(node);
        let begun = transfer.client.begin_upload(node.get(), object.index, object.sub_index, 0);
        begun.map_err(|_| Error::UnexpectedReply)?;
        Ok(transfer)
    }

    fn download<E>(node: NodeId, object: Object, data: &[u8]) -> Result<Self, Error<E>> {
        if data.is_empty() {
            // An SDO has no way to say so.
            return Err(Error::Length(LengthError::new(1, 0)));
        }
        let mut transfer = Self::new(node);
        let begun = transfer.client.begin_download(node.get(), object.index, object.sub_index, data, 0);
        begun.map_err(|_| Error::UnexpectedReply)?;
        Ok(transfer)
    }

    /// The next frame to be sent.
    fn request(&mut self) -> Option<CanFrame> {
        self.client.poll_transmit().and_then(|frame| CanFrame::new(frame.cob_id, &frame.data))
    }

    /// Takes an answer, or `None` where none came.
    fn answer(&mut self, frame: Option<CanFrame>) {
        let Some(frame) = frame else {
            self.client.abort(SdoAbortCode::ProtocolTimeout);
            self.outcome = Some(Outcome::Late);
            return;
        };
        self.outcome = match self.client.handle_frame(SdoFrame::new(self.answers, frame.padded()), 0) {
            Ok(Some(outcome)) => Some(Outcome::Done(outcome)),
            Ok(None) => None,
            Err(SdoError::ServerAborted(code)) => Some(Outcome::Refused(AbortCode(u32::from(code)))),
            Err(_) => Some(Outcome::Unexpected),
        };
    }

    /// The end, once it is reached.
    fn end<E>(&mut self) -> Option<Result<SdoOutcome, Error<E>>> {
        Some(match self.outcome.take()? {
            Outcome::Done(outcome) => Ok(outcome),
            Outcome::Refused(code) => Err(Error::Abort(code)),
            Outcome::Unexpected => Err(Error::UnexpectedReply),
            Outcome::Late => Err(Error::Timeout),
        })
    }
}

/// Puts what was uploaded to the start of `buffer`, and gives its length.
fn uploaded<E>(outcome: SdoOutcome, buffer: &mut [u8]) -> Result<usize, Error<E>> {
    let SdoOutcome::UploadCompleted(data) = outcome else { return Err(Error::UnexpectedReply) };
    buffer.iter_mut().zip(&data).for_each(|(to, from)| *to = *from);
    Ok(data.len())
}

impl<P: CanPort> Node<P> {
    fn run(&mut self, mut transfer: Transfer) -> Result<SdoOutcome, Error<P::Error>> {
        loop {
            while let Some(frame) = transfer.request() {
                self.send(&frame)?;
            }
            if let Some(end) = transfer.end() {
                return end;
            }
            let (answers, timeout) = (transfer.answers, self.timeout());
            let answer = self.port().receive(timeout, &mut |frame| frame.id() == answers);
            transfer.answer(answer.map_err(Error::Client)?);
        }
    }
}

impl<P: CanPort> Client for Node<P> {
    type Bus = CanOpen;
    type Error = P::Error;

    fn read(&mut self, address: Object, buffer: &mut [u8]) -> Result<usize, Error<P::Error>> {
        let outcome = self.run(Transfer::upload(self.id(), address)?)?;
        uploaded(outcome, buffer)
    }

    fn write(&mut self, address: Object, data: &[u8]) -> Result<(), Error<P::Error>> {
        self.run(Transfer::download(self.id(), address, data)?).map(|_| ())
    }
}

impl<P: AsyncCanPort> Node<P> {
    async fn run_async(&mut self, mut transfer: Transfer) -> Result<SdoOutcome, Error<P::Error>> {
        loop {
            while let Some(frame) = transfer.request() {
                self.send_async(&frame).await?;
            }
            if let Some(end) = transfer.end() {
                return end;
            }
            let (answers, timeout) = (transfer.answers, self.timeout());
            let answer = self.port().receive(timeout, &mut |frame| frame.id() == answers).await;
            transfer.answer(answer.map_err(Error::Client)?);
        }
    }
}

impl<P: AsyncCanPort> AsyncClient for Node<P> {
    type Bus = CanOpen;
    type Error = P::Error;

    async fn read(&mut self, address: Object, buffer: &mut [u8]) -> Result<usize, Error<P::Error>> {
        let outcome = self.run_async(Transfer::upload(self.id(), address)?).await?;
        uploaded(outcome, buffer)
    }

    async fn write(&mut self, address: Object, data: &[u8]) -> Result<(), Error<P::Error>> {
        self.run_async(Transfer::download(self.id(), address, data)?).await.map(|_| ())
    }
}
