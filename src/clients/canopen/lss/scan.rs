//! Search for slaves that have no node-ID.

use super::super::port::{AsyncCanPort, CanPort};
use super::LssMaster;
use crate::lss::{is_identified, FastScan, IdentityPart, LssAddress, LssError, LssState, Service};

macro_rules! scan {
    (
        $Port:ident: $has_unconfigured:ident $fast_scan:ident $step:ident $await_start:ident
        $switch_global:ident $request:ident $send:ident $receive:ident $collect:ident $run:ident $($async:ident $await:ident)?
    ) => {
        impl<P: $Port> LssMaster<P> {
            /// Returns whether there are slaves in Waiting that have no node-ID. [`fast_scan`](Self::fast_scan) finds
            /// them.
            ///
            /// # Errors
            ///
            /// Returns [`LssError::Client`] if the interface fails, or [`LssError::NotSent`] if the bus stays busy.
            pub $($async)? fn $has_unconfigured(&mut self) -> Result<bool, LssError<P::Error>> {
                let result = self.$run(Service::IdentifyUnconfigured)$(.$await)?;
                match result {
                    Err(LssError::Timeout) => {
                        // That no slave answers is the answer, and no late answer is expected.
                        self.is_owed = false;
                        Ok(false)
                    }
                    result => result.map(|_| true),
                }
            }

            /// Switches all slaves to Waiting, finds a slave that has no node-ID, and returns its address. This slave
            /// is then in Configuration. Returns `None` if all slaves have a node-ID: the master sends two requests,
            /// and no slave answers either of them within the timeout.
            ///
            /// A scan takes 133 times the [window](Self::with_window), 2.7 s by default. The master then inquires the
            /// address of the slave and compares it with the result of the scan, because a lost or late answer can lead
            /// to a wrong result. To find all slaves, give each one a node-ID, switch it to Waiting, and repeat the
            /// scan.
            ///
            /// # Errors
            ///
            /// - [`LssError::Client`] if the interface fails, or [`LssError::NotSent`] if the bus stays busy.
            /// - [`LssError::Timeout`] if the slave doesn't answer the inquiries.
            /// - [`LssError::SeveralAnswers`] if several slaves have the same address.
            /// - [`LssError::Inconclusive`] if an answer was lost, or arrived after the window. If this error persists,
            ///   use a longer [window](Self::with_window).
            pub $($async)? fn $fast_scan(&mut self) -> Result<Option<LssAddress>, LssError<P::Error>> {
                self.$switch_global(LssState::Waiting)$(.$await)??;
                // Answers can also arrive after an error, and after a future was dropped.
                self.is_owed = true;
                let mut scan = FastScan::new();
                while let Some(request) = scan.next() {
                    self.$send(request)$(.$await)??;
                    let is_answered = self.$step(&mut scan)$(.$await)??;
                    if scan.is_start() && !is_answered {
                        // Only slaves that don't answer at all have a node-ID: an answer may be late, or lost once.
                        self.$await_start()$(.$await)??;
                        self.$send(request)$(.$await)??;
                        if !self.$step(&mut scan)$(.$await)?? {
                            self.$await_start()$(.$await)??;
                        }
                    }
                    scan.time_out();
                }
                let Some(address) = scan.result().map_err(LssError::of_client)? else {
                    self.is_owed = false;
                    return Ok(None);
                };
                let mut inquired = [0; 4];
                for (to, part) in inquired.iter_mut().zip(IdentityPart::ALL) {
                    // Without a wait for late answers of the scan, because the answers to inquiries differ from them.
                    let number = self.$request(Service::Inquire(part))$(.$await)?;
                    self.is_owed = true;
                    *to = number?;
                }
                if LssAddress::from_array(inquired) != address {
                    return Err(LssError::Inconclusive);
                }
                self.is_owed = false;
                Ok(Some(address))
            }

            /// Collects the answers to a fastscan request for the duration of the window. Returns whether there are any.
            $($async)? fn $step(&mut self, scan: &mut FastScan) -> Result<bool, LssError<P::Error>> {
                self.$collect(self.window, &|message| is_identified(message), &mut |message| scan.handle(message))$(.$await)?
            }

            /// Waits for the rest of the timeout. Returns an error if an answer to the first request of a scan arrives
            /// in this time.
            $($async)? fn $await_start(&mut self) -> Result<(), LssError<P::Error>> {
                let rest = self.timeout.saturating_sub(self.window);
                let late = self.$receive(rest, &|message| is_identified(message))$(.$await)??;
                late.map_or(Ok(()), |_| Err(LssError::Inconclusive))
            }
        }
    };
}

scan! {
    CanPort: has_unconfigured fast_scan step await_start
    switch_global request send receive collect run
}
scan! {
    AsyncCanPort: has_unconfigured_async fast_scan_async step_async await_start_async
    switch_global_async request_async send_async receive_async collect_async run_async async await
}
