//! Tests `lexibus::octets`, which serializes byte arrays of more than 32 bytes. `serde` implements its traits only for
//! shorter arrays.

#[derive(Debug, PartialEq, serde::Serialize, serde::Deserialize)]
struct Frame {
    #[serde(with = "lexibus::octets")]
    data: [u8; 40],
}

#[test]
fn long_arrays_come_back_and_short_ones_are_refused() {
    let frame = Frame { data: std::array::from_fn(|at| at as u8) };
    let text = serde_json::to_string(&frame).unwrap();
    assert!(text.starts_with("{\"data\":[0,1,2,"));
    assert_eq!(serde_json::from_str::<Frame>(&text).unwrap(), frame);
    let error = serde_json::from_str::<Frame>("{\"data\":[1,2]}").unwrap_err().to_string();
    assert!(error.contains("invalid length 2, expected 40 bytes"), "{error}");
}
