    /// Channel errors in the device description, sorted by application process identifier (API) and error type.
    pub static CHANNEL_ERRORS: [rt::profinet::ChannelError; 3] = [
        rt::profinet::ChannelError::new(0x0100, "Stopped", "", &[]),
        rt::profinet::ChannelError::of_profile(
            0x3A00,
            0x0100,
            "Stopped",
            "",
            &[rt::profinet::ExtendedError::new(0x0002, "By the drive", "")],
        ),
        rt::profinet::ChannelError::of_profile(
            0x3A00,
            0x9000,
            "Fault",
            "",
            &[rt::profinet::ExtendedError::new(0x0001, "Too hot", "")],
        ),
    ];
