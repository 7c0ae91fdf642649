//! What determines a picture, written into its file: scene hash, version, seed, samples, settings.
//!
//! And nothing that doesn't: no date, host, thread count or path, so that equal pictures are equal files.

use super::ImageError;

/// Keys and values in the order in which they are written.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Metadata(pub Vec<(String, String)>);

/// Keys carry this prefix in files, so that none can meet a standard attribute.
pub const PREFIX: &str = "spectrel:";

/// PNG allows keywords of 79 bytes.
const KEY_LIMIT: usize = 79 - PREFIX.len();

impl Metadata {
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a value, or replaces the one `key` has.
    pub fn set(&mut self, key: impl Into<String>, value: impl ToString) {
        let (key, value) = (key.into(), value.to_string());
        match self.0.iter_mut().find(|(k, _)| *k == key) {
            Some(entry) => entry.1 = value,
            None => self.0.push((key, value)),
        }
    }

    /// [`set`](Metadata::set), to chain.
    pub fn with(mut self, key: impl Into<String>, value: impl ToString) -> Self {
        self.set(key, value);
        self
    }

    pub fn get(&self, key: &str) -> Option<&str> {
        self.0.iter().find(|(k, _)| k == key).map(|(_, v)| v.as_str())
    }

    /// Names as files hold them, and values.
    pub(super) fn named(&self) -> impl Iterator<Item = (String, &str)> {
        self.0.iter().map(|(key, value)| (format!("{PREFIX}{key}"), value.as_str()))
    }

    /// Whether both formats can hold every entry.
    pub(super) fn check(&self) -> Result<(), ImageError> {
        for (i, (key, value)) in self.0.iter().enumerate() {
            let repeated = self.0[..i].iter().any(|(k, _)| k == key);
            if let Some(problem) = problem(key, value, repeated) {
                return Err(ImageError::Metadata { key: key.clone(), problem });
            }
        }
        Ok(())
    }
}

fn problem(key: &str, value: &str, repeated: bool) -> Option<&'static str> {
    let plain = |b: u8| b.is_ascii_alphanumeric() || b"._-".contains(&b);
    if key.is_empty() || key.len() > KEY_LIMIT || !key.bytes().all(plain) {
        Some("must be 1 to 70 letters, digits, dots, dashes or underscores")
    } else if repeated {
        Some("is given twice")
    } else if value.contains('\0') {
        Some("has a value with a zero byte")
    } else {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bad_entries_are_errors() {
        assert!(Metadata::new().with("seed", 1).with("seed", 2).check().is_ok());
        for (key, value) in [("", "x"), ("a b", "x"), ("ключ", "x"), (&"k".repeat(71), "x"), ("k", "a\0b")] {
            assert!(Metadata::new().with(key, value).check().is_err(), "{key}");
        }
        assert!(Metadata(vec![("a".into(), "1".into()), ("a".into(), "2".into())]).check().is_err());
    }
}
