    /// Outputs: data of sync manager 2 with the default PDO assignment.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Outputs {
        /// RxPDO 0x1600.
        pub rxpdo1600: super::pdo::Rxpdo1600,
        /// RxPDO 0x1601: Named.
        pub named: super::pdo::Named,
    }
