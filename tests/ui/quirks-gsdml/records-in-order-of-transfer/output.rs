        /// Description of the submodule. Modules and slot plans use this constant.
        pub static SUBMODULE: rt::profinet::Submodule = rt::profinet::Submodule {
            ident: 0x00000001,
            api: 0x0000,
            name: "Settings",
            input_len: None,
            output_len: None,
            provider_len: 1,
            consumer_len: 1,
            records: &[
                rt::profinet::Record::new(
                    0x0003,
                    5,
                    "Third",
                    &ThirdRecord::DEFAULT_BYTES,
                ),
                rt::profinet::Record::new(
                    0x0002,
                    7,
                    "Second",
                    &SecondRecord::DEFAULT_BYTES,
                ),
                rt::profinet::Record::new(
                    0x0001,
                    0,
                    "First",
                    &FirstRecord::DEFAULT_BYTES,
                ),
            ],
        };
