== none.xml
    /// Outputs: data of sync manager 2 with the default PDO assignment.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Outputs {
        /// RxPDO 0x1601: Speed.
        pub speed: super::pdo::Speed,
    }
        /// Number of the sync manager.
        pub const SYNC_MANAGER: u8 = 2;
== other.xml
    /// Outputs: data of sync manager 0 with the default PDO assignment.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Outputs {
        /// RxPDO 0x1601: Speed.
        pub speed: super::pdo::Speed,
    }
        /// Number of the sync manager.
        pub const SYNC_MANAGER: u8 = 0;
