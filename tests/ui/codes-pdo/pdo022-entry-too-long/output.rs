    /// Outputs: data of sync manager 0 with the default PDO assignment.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Outputs {
        /// RxPDO 0x1602: Longest.
        pub longest: super::pdo::Longest,
    }
