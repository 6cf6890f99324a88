== chosen.xml
    /// Outputs: data of sync manager 0 with the default PDO assignment.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Outputs {
        /// RxPDO 0x1601: Speed.
        pub speed: super::pdo::Speed,
    }
== conflict.xml
    /// Outputs: data of sync manager 0 with the default PDO assignment.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Outputs {
        /// RxPDO 0x1601: Speed.
        pub speed: super::pdo::Speed,
    }
== later.xml
    /// Outputs: data of sync manager 0 with the default PDO assignment.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Outputs {
        /// RxPDO 0x1601: Speed.
        pub speed: super::pdo::Speed,
        /// RxPDO 0x1603: Torque.
        pub torque: super::pdo::Torque,
    }
