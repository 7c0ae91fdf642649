//! What the documents and the source promise of themselves.

mod readme;
mod reference;
mod rooms;
