    /// Start.
    ///
    /// Sends the message [`messages::Start`].
    pub fn start(&mut self, speed: u16) -> rt::message::Call<'_, C, messages::Start> {
        let message = messages::Start { speed };
        rt::message::Call::new(&mut self.client, message)
    }
