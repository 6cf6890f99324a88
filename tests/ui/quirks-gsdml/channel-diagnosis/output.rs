    /// Channel errors in the device description, sorted by application process identifier (API) and error type.
    pub static CHANNEL_ERRORS: [rt::profinet::ChannelError; 3] = [
        rt::profinet::ChannelError::new(0x0010, "", "", &[]),
        rt::profinet::ChannelError::new(
            0x0100,
            "Fault",
            "Restart it",
            &[rt::profinet::ExtendedError::new(0x0001, "Too hot", "")],
        ),
        rt::profinet::ChannelError::of_profile(
            0x3A00,
            0x0010,
            "",
            "",
            &[rt::profinet::ExtendedError::new(0x9001, "Drive fault", "")],
        ),
    ];
