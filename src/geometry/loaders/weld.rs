//! Numbers for keys in the order of their first appearance: corners that agree in every bit become one vertex.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

/// Three words: the bits of a position, or the indices of an OBJ corner.
pub(super) type Key = [u32; 3];

#[derive(Default)]
pub(super) struct Weld {
    numbers: HashMap<Key, u32>,
    /// Each key once; its place is its number.
    pub keys: Vec<Key>,
}

impl Weld {
    /// The number of a key; `None` if there are more than 32 bits can count.
    pub fn number(&mut self, key: Key) -> Option<u32> {
        match self.numbers.entry(key) {
            Entry::Occupied(entry) => Some(*entry.get()),
            Entry::Vacant(entry) => {
                let number = u32::try_from(self.keys.len()).ok()?;
                self.keys.push(key);
                Some(*entry.insert(number))
            }
        }
    }
}
