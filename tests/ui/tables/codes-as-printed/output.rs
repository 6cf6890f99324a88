    /// Code of the table [`ALARMS`].
    ///
    /// | Code | Name |
    /// |---|---|
    /// | 34 | [`Bus`](Self::Bus) |
    /// | 35 | [`Sensor`](Self::Sensor) |
    #[derive(Clone, Copy, Debug)]
    pub enum Alarms {
        /// 34: bus.
        Bus,
        /// 35: sensor.
        Sensor,
        /// A code that is not in the table.
        Unknown(u16),
    }
    /// Code of the table [`FAULTS`].
    ///
    /// | Code | Name |
    /// |---|---|
    /// | F125 | [`SynchronizationLost`](Self::SynchronizationLost) |
    /// | F130 to F132 | [`Encoder`](Self::Encoder) |
    #[derive(Clone, Copy, Debug)]
    pub enum Faults {
        /// F125: synchronization lost.
        SynchronizationLost,
        /// F130 to F132: encoder.
        Encoder(u16),
        /// A code that is not in the table.
        Unknown(u16),
    }
