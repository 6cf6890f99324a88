//! Identity of a device: vendor, product and revision.

/// Identity of a device, as its device description declares it. A CANopen or CoE device contains the vendor-ID, the
/// product code and the revision number in object 0x1018.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Identity {
    /// Vendor-ID (0x1018:01).
    pub vendor_id: Option<u32>,
    /// Product code (0x1018:02).
    pub product_code: Option<u32>,
    /// Revision number (0x1018:03).
    pub revision_number: Option<u32>,
    /// Vendor name; empty if the description has none.
    pub vendor_name: &'static str,
    /// Product name; empty if the description has none.
    pub product_name: &'static str,
    /// Order code; empty if the description has none.
    pub order_code: &'static str,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn identities_compare() {
        let one = Identity {
            vendor_id: Some(0x1234),
            product_code: None,
            revision_number: None,
            vendor_name: "Example",
            product_name: "Drive",
            order_code: "",
        };
        assert_eq!(one, one);
        assert_ne!(one, Identity { product_code: Some(1), ..one });
    }
}
