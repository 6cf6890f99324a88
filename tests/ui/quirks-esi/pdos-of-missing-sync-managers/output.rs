== excluded.xml
        /// Number of the sync manager.
        pub const SYNC_MANAGER: u8 = 0;
== input.xml
        /// Number of the sync manager.
        pub const SYNC_MANAGER: u8 = 0;
== no-sync-manager.xml
        /// Number of the sync manager.
        pub const SYNC_MANAGER: u8 = 2;
