== latin-1-as-utf-8.xml
/// Identity of Müller Drive: vendor, product and revision.
pub const IDENTITY: rt::Identity = rt::Identity {
    vendor_id: Some(0x00000001),
    product_code: Some(0x00000002),
    revision_number: Some(0x00000003),
    vendor_name: "Müller",
    product_name: "Drive",
    order_code: "Drive",
};
== latin-1.xml
/// Identity of Müller Drive: vendor, product and revision.
pub const IDENTITY: rt::Identity = rt::Identity {
    vendor_id: Some(0x00000001),
    product_code: Some(0x00000002),
    revision_number: Some(0x00000003),
    vendor_name: "Müller",
    product_name: "Drive",
    order_code: "Drive",
};
== utf-8-as-latin-1.xml
/// Identity of Müller Drive: vendor, product and revision.
pub const IDENTITY: rt::Identity = rt::Identity {
    vendor_id: Some(0x00000001),
    product_code: Some(0x00000002),
    revision_number: Some(0x00000003),
    vendor_name: "Müller",
    product_name: "Drive",
    order_code: "Drive",
};
== utf-8.xml
/// Identity of Müller Drive: vendor, product and revision.
pub const IDENTITY: rt::Identity = rt::Identity {
    vendor_id: Some(0x00000001),
    product_code: Some(0x00000002),
    revision_number: Some(0x00000003),
    vendor_name: "Müller",
    product_name: "Drive",
    order_code: "Drive",
};
