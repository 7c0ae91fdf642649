//! A stable fingerprint of bytes.

/// FNV-1a with 64 bits (Fowler, Noll and Vo): the same on every machine and in every version. It tells accidental
/// differences, such as another scene or a damaged file; it is no protection against someone who wants equal hashes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StableHash(u64);

impl Default for StableHash {
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl StableHash {
    pub fn update(&mut self, bytes: &[u8]) {
        self.0 = bytes.iter().fold(self.0, |hash, byte| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3));
    }

    pub fn finish(self) -> u64 {
        self.0
    }
}

/// [`StableHash`] of bytes in one piece.
pub fn fnv1a_64(bytes: &[u8]) -> u64 {
    let mut hash = StableHash::default();
    hash.update(bytes);
    hash.finish()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn matches_the_published_vectors() {
        assert_eq!(fnv1a_64(b""), 0xcbf2_9ce4_8422_2325);
        assert_eq!(fnv1a_64(b"a"), 0xaf63_dc4c_8601_ec8c);
        assert_eq!(fnv1a_64(b"foobar"), 0x8594_4171_f739_67e8);
    }
}
