//! Client side of expedited and segmented transfers.

use super::super::message::{request, segment, segment_data, toggle, toggled, Initiated, Message};
use super::{Phase, Transfer};
use crate::abort::AbortCode;

/// Expedited and segmented transfers (CiA 301 7.2.4.3.3 to 7.2.4.3.8).
impl Transfer<'_> {
    pub(super) fn upload_initiated(&mut self, message: &Message) {
        let room = self.buffer().len();
        match Initiated::of(message) {
            Initiated::Expedited { data, length } => {
                self.buffer().iter_mut().zip(data).for_each(|(to, from)| *to = from);
                // A value without a length has the requested length.
                self.result = Some(Ok(length.unwrap_or(data.len().min(room))));
            }
            Initiated::Segmented { length: Some(length) } if length > room => self.give_up_too_long(length),
            Initiated::Segmented { length } => {
                self.length = length.unwrap_or(0);
                self.phase = Phase::UploadSegment { toggle: false, length: 0, size: length };
                self.send(toggled(request::UPLOAD_SEGMENT, false));
            }
        }
    }

    pub(super) fn upload_segment(&mut self, message: &Message, expected: bool, length: usize, size: Option<usize>) {
        if toggle(message) != expected {
            // A repeated segment arrived before the requested one.
            self.is_owed = true;
            return self.give_up_unexpected(AbortCode::TOGGLE_BIT);
        }
        let (data, is_last) = segment_data(message);
        let all = length + data.len();
        if data.is_empty() && !is_last {
            // A server could send empty segments forever.
            return self.give_up_unexpected(AbortCode::LENGTH);
        }
        let Some(room) = self.buffer().get_mut(length..all) else { return self.give_up_too_long(all) };
        room.copy_from_slice(data);
        self.length = self.length.max(all);
        if !is_last {
            self.phase = Phase::UploadSegment { toggle: !expected, length: all, size };
            self.send(toggled(request::UPLOAD_SEGMENT, !expected));
        } else if size.is_some_and(|size| size != all) {
            self.give_up_unexpected(AbortCode::LENGTH);
        } else {
            self.result = Some(Ok(all));
        }
    }

    pub(super) fn download_segment(&mut self, toggle: bool, sent: usize) {
        let rest = self.data().get(sent..).unwrap_or_default();
        let (message, length) = segment(request::DOWNLOAD_SEGMENT, toggle, rest);
        self.phase = Phase::DownloadSegment { toggle, sent: sent + length };
        self.send(message);
    }

    pub(super) fn download_confirmed(&mut self, message: &Message, expected: bool, sent: usize) {
        if toggle(message) != expected {
            self.is_owed = true;
            self.give_up_unexpected(AbortCode::TOGGLE_BIT);
        } else if sent == self.data().len() {
            self.result = Some(Ok(sent));
        } else {
            self.download_segment(!expected, sent);
        }
    }
}
