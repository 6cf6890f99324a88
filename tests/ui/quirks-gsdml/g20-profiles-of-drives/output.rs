    /// Channel errors in the device description, sorted by application process identifier (API) and error type.
    pub static CHANNEL_ERRORS: [rt::profinet::ChannelError; 1] = [
        rt::profinet::ChannelError::of_profile(
            0x3A00,
            0x9000,
            "Fault",
            "Restart the drive",
            &[],
        ),
    ];
