//! Films as files: checkpoints of a long render, and parts of a job to merge elsewhere.
//!
//! Little-endian: magic, length and UTF-8 of a label, image width and height, window x0, y0, width, height, the pixels
//! row by row, and an FNV-1a hash of all before it. The label is the caller's: what tells whether two films belong
//! together (scene hash, seed) and which samples this one holds.

use std::io::{self, Read, Write};

use super::{Film, FilmError, Pixel, StableHash, Window};

/// The last byte is the version of the format.
const MAGIC: [u8; 8] = *b"spctflm\x01";

/// Longer labels are no labels.
const LABEL_LIMIT: u32 = 1 << 20;

impl Film {
    /// Writes the film and a label of at most 1 MiB.
    pub fn write_to(&self, out: &mut (impl Write + ?Sized), label: &str) -> io::Result<()> {
        let length = u32::try_from(label.len()).ok().filter(|n| *n <= LABEL_LIMIT);
        let length = length.ok_or_else(|| io::Error::new(io::ErrorKind::InvalidInput, "the label is too long"))?;
        let mut out = Hashing { inner: out, hash: StableHash::default() };
        out.write_all(&MAGIC)?;
        out.write_all(&length.to_le_bytes())?;
        out.write_all(label.as_bytes())?;
        let (image, window) = (self.image, self.window);
        for n in [image[0], image[1], window.x0, window.y0, window.width, window.height] {
            out.write_all(&n.to_le_bytes())?;
        }
        for pixel in &self.pixels {
            out.write_all(&pixel.to_bytes())?;
        }
        let hash = out.hash.finish();
        out.write_all(&hash.to_le_bytes())
    }

    /// Reads a film and its label. Wrap files in a `BufReader`: it reads pixel by pixel.
    pub fn read_from(input: &mut (impl Read + ?Sized)) -> Result<(Film, String), FilmError> {
        let mut input = Hashing { inner: input, hash: StableHash::default() };
        if bytes(&mut input).ok() != Some(MAGIC) {
            return Err(FilmError::NotAFilm);
        }
        let label = label(&mut input)?;
        let mut next = || bytes(&mut input).map(u32::from_le_bytes);
        let image = [next()?, next()?];
        let window = Window { x0: next()?, y0: next()?, width: next()?, height: next()? };
        window.check(image)?;
        // Grown pixel by pixel: a damaged size must not allocate more than the file holds.
        let mut pixels = Vec::new();
        for _ in 0..window.pixel_count() {
            pixels.push(Pixel::from_bytes(&bytes(&mut input)?));
        }
        let hash = input.hash.finish();
        if u64::from_le_bytes(bytes(&mut input)?) != hash {
            return Err(FilmError::Damaged { reason: "its content does not match its checksum".into() });
        }
        Ok((Film { image, window, pixels }, label))
    }
}

fn label(input: &mut impl Read) -> Result<String, FilmError> {
    let length = u32::from_le_bytes(bytes(input)?);
    if length > LABEL_LIMIT {
        return Err(FilmError::Damaged { reason: format!("its label has {length} bytes") });
    }
    let mut label = vec![0; length as usize];
    input.read_exact(&mut label).map_err(damaged)?;
    String::from_utf8(label).map_err(|_| FilmError::Damaged { reason: "its label is not text".into() })
}

fn bytes<const N: usize>(input: &mut impl Read) -> Result<[u8; N], FilmError> {
    let mut bytes = [0; N];
    input.read_exact(&mut bytes).map_err(damaged)?;
    Ok(bytes)
}

fn damaged(error: io::Error) -> FilmError {
    let reason = match error.kind() {
        io::ErrorKind::UnexpectedEof => "it ends too early".to_string(),
        _ => error.to_string(),
    };
    FilmError::Damaged { reason }
}

/// Passes bytes on and hashes them.
struct Hashing<'a, T: ?Sized> {
    inner: &'a mut T,
    hash: StableHash,
}

impl<T: Write + ?Sized> Write for Hashing<'_, T> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.inner.write(bytes)?;
        self.hash.update(&bytes[..written]);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.inner.flush()
    }
}

impl<T: Read + ?Sized> Read for Hashing<'_, T> {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        let read = self.inner.read(bytes)?;
        self.hash.update(&bytes[..read]);
        Ok(read)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn film() -> Film {
        let mut film = Film::new([10, 10], Window { x0: 2, y0: 3, width: 4, height: 5 }).unwrap();
        film.pixels_mut().iter_mut().enumerate().for_each(|(i, p)| p.add([i as f32 / 3.0, -1.0, 1e20]));
        film
    }

    fn stored() -> Vec<u8> {
        let mut bytes = Vec::new();
        film().write_to(&mut bytes, "scene ü, samples 0..64").unwrap();
        bytes
    }

    #[test]
    fn reads_back_equal() {
        assert_eq!(Film::read_from(&mut stored().as_slice()), Ok((film(), "scene ü, samples 0..64".into())));
    }

    #[test]
    fn every_cut_and_every_changed_byte_is_noticed() {
        let good = stored();
        for i in 0..good.len() {
            assert!(Film::read_from(&mut &good[..i]).is_err(), "cut at {i}");
            let mut bad = good.clone();
            bad[i] ^= 0x41;
            assert!(Film::read_from(&mut bad.as_slice()).is_err(), "changed at {i}");
        }
        assert_eq!(Film::read_from(&mut &b"PNG"[..]), Err(FilmError::NotAFilm));
    }
}
