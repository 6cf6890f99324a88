//! The SHA-256 of a file, computed on first use. Only some outputs, such as generated code, need the digest.

use std::fmt;
use std::sync::{Arc, OnceLock};

use sha2::{Digest as _, Sha256};

use super::decode::Decoded;

/// The decoded file and its SHA-256, which a source and its digest share.
#[derive(Debug)]
pub(super) struct Content {
    pub decoded: Decoded,
    sha256: OnceLock<String>,
}

impl Content {
    pub fn new(decoded: Decoded) -> Arc<Self> {
        Arc::new(Content { decoded, sha256: OnceLock::new() })
    }

    /// Returns the SHA-256 of the bytes as read, in lower-case hexadecimal.
    pub fn sha256(&self) -> &str {
        self.sha256.get_or_init(|| {
            use fmt::Write;
            let mut hex = String::with_capacity(64);
            for byte in Sha256::digest(self.decoded.bytes()) {
                let _ = write!(hex, "{byte:02x}");
            }
            hex
        })
    }
}

/// The SHA-256 of a file's bytes, in lower-case hexadecimal.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(from = "String", into = "String"))]
pub struct Digest(Origin);

#[derive(Clone, Debug)]
enum Origin {
    File(Arc<Content>),
    Text(String),
}

impl Digest {
    pub(super) fn of(content: &Arc<Content>) -> Self {
        Digest(Origin::File(Arc::clone(content)))
    }

    /// Computes the SHA-256, so that the content of the file is not needed any more.
    pub(crate) fn detach(&mut self) {
        self.0 = Origin::Text(self.as_str().to_owned());
    }

    /// Returns the hexadecimal digits of the SHA-256.
    pub fn as_str(&self) -> &str {
        match &self.0 {
            Origin::File(content) => content.sha256(),
            Origin::Text(text) => text,
        }
    }
}

impl PartialEq for Digest {
    fn eq(&self, other: &Self) -> bool {
        self.as_str() == other.as_str()
    }
}

impl fmt::Display for Digest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.as_str())
    }
}

impl From<String> for Digest {
    fn from(text: String) -> Self {
        Digest(Origin::Text(text))
    }
}

impl From<Digest> for String {
    fn from(digest: Digest) -> Self {
        digest.as_str().to_owned()
    }
}
