//! Pictures that come in: every form reads to the values that were written, and what is broken is an error with a name.

mod common;

use common::pictures::{ROWS, Rows, hdr, write_exr, write_exr_channel, write_exr_with, write_png};
use png::{BitDepth, ColorType};
use spectrel::spectrum::{Chromaticities, RgbSpace};
use spectrel::texture::{Encoding, Raster, Samples, TextureError, read};
use std::fs;
use std::path::PathBuf;
use tempfile::TempDir;

fn folder() -> (TempDir, impl Fn(&str) -> PathBuf) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().to_owned();
    (folder, move |name: &str| path.join(name))
}

/// Colours that four bytes hold exactly, with runs long and short.
fn colors(width: usize, height: usize) -> Vec<[f32; 3]> {
    let color = |i: usize| match i / 5 % 4 {
        0 => [1.0, 0.5, 0.25],
        1 => [0.0; 3],
        2 => [(i % 7) as f32, 64.0, 3.0],
        _ => [1e-3; 3],
    };
    (0..width * height)
        .map(|i| if i < width { [2.0; 3] } else { color(i) })
        .map(|rgb| rgb.map(quantised(rgb)))
        .collect()
}

/// What a texel keeps of a channel beside its largest one.
fn quantised(rgb: [f32; 3]) -> impl Fn(f32) -> f32 {
    let largest = rgb.into_iter().fold(0.0, f32::max);
    let step = libm::ldexp(1.0, libm::frexp(f64::from(largest)).1 - 8);
    move |channel| if largest == 0.0 { 0.0 } else { ((f64::from(channel) / step).floor() * step) as f32 }
}

fn rgb(raster: &Raster) -> &[[f32; 3]] {
    match &raster.samples {
        Samples::Rgb(pixels) => pixels,
        Samples::Grey(_) => panic!("grey"),
    }
}

#[test]
fn radiance_hdr_reads_back_from_every_form_of_rows() {
    let (_folder, path) = folder();
    for (width, height) in [(9, 4), (600, 3), (7, 5), (1, 1), (40_000, 1)] {
        for rows in ROWS {
            if rows == Rows::NewRuns && !(8..0x8000).contains(&width) {
                continue;
            }
            let pixels = colors(width, height);
            fs::write(path("a.hdr"), hdr(width, &pixels, rows, "")).expect("a file");
            let raster = read(&path("a.hdr"), 0).expect("a picture");
            assert_eq!((raster.width as usize, raster.height as usize), (width, height));
            assert_eq!((rgb(&raster), raster.encoding), (&pixels[..], Encoding::Linear), "{rows:?} {width}");
            assert!(raster.notes.is_empty() && raster.chromaticities.is_none());
        }
    }
}

#[test]
fn headers_of_radiance_hdr_are_honoured() {
    let (_folder, path) = folder();
    let pixels = colors(9, 4);
    let with = |more: &str| {
        fs::write(path("a.hdr"), hdr(9, &pixels, Rows::Flat, more)).expect("a file");
        read(&path("a.hdr"), 0).expect("a picture")
    };
    let exposed = with("EXPOSURE=2\nSOFTWARE=some\nEXPOSURE= 4.0\n");
    assert!(rgb(&exposed).iter().flatten().zip(pixels.iter().flatten()).all(|(a, b)| *a == b / 8.0));
    assert!(exposed.notes[0].contains("0.125"), "{:?}", exposed.notes);
    let primaries = with("PRIMARIES=0.64 0.33 0.3 0.6 0.15 0.06 0.3127 0.329\n");
    assert_eq!(primaries.chromaticities.and_then(|c| c.space()), Some(RgbSpace::Srgb));
    // Rows from below and from the right.
    let text = hdr(9, &pixels, Rows::Flat, "");
    let at = text.windows(2).position(|pair| pair == b"-Y").expect("a size");
    let mut turned = text.clone();
    (turned[at], turned[at + 5]) = (b'+', b'-');
    fs::write(path("a.hdr"), &turned).expect("a file");
    let turned = read(&path("a.hdr"), 0).expect("a picture");
    assert!(rgb(&turned).iter().eq(pixels.iter().rev()));
}

#[test]
fn exr_reads_back_with_its_chromaticities() {
    let (_folder, path) = folder();
    let pixels: Vec<[f32; 3]> = (0..15).map(|i| [i as f32, -0.5, f32::INFINITY]).collect();
    write_exr(&path("a.exr"), 5, &pixels);
    let raster = read(&path("a.exr"), 0).expect("a picture");
    assert_eq!((raster.width, raster.height, rgb(&raster)), (5, 3, &pixels[..]));
    assert!(raster.chromaticities.is_none() && raster.notes.is_empty());
    write_exr_with(&path("b.exr"), 5, &pixels, |attributes| {
        let Chromaticities { primaries_xy: [red, green, blue], white_xy } = RgbSpace::AcesCg.chromaticities();
        let xy = |[x, y]: [f64; 2]| exr::math::Vec2(x as f32, y as f32);
        let stated = exr::meta::attribute::Chromaticities {
            red: xy(red),
            green: xy(green),
            blue: xy(blue),
            white: xy(white_xy),
        };
        attributes.chromaticities = Some(stated);
    });
    let raster = read(&path("b.exr"), 0).expect("a picture");
    assert_eq!(raster.chromaticities.and_then(|c| c.space()), Some(RgbSpace::AcesCg));
    write_exr_channel(&path("y.exr"), "Y", 2, &[1.0, 2.0, 3.0, 4.0]);
    assert_eq!(read(&path("y.exr"), 0).expect("a picture").samples, Samples::Grey(vec![1.0, 2.0, 3.0, 4.0]));
    write_exr_channel(&path("z.exr"), "Z", 2, &[1.0, 2.0, 3.0, 4.0]);
    let message = read(&path("z.exr"), 0).unwrap_err().to_string();
    assert!(message.contains("z.exr") && message.contains("the channels `Z`"), "{message}");
}

#[test]
fn png_of_every_kind_reads_to_its_codes() {
    let (_folder, path) = folder();
    let read = |name: &str| read(&path(name), 0).expect("a picture");
    write_png(&path("grey.png"), 2, ColorType::Grayscale, BitDepth::Eight, &[0, 51, 102, 255]);
    assert_eq!(read("grey.png").samples, Samples::Grey([0.0, 0.2, 0.4, 1.0].to_vec()));
    assert_eq!(read("grey.png").encoding, Encoding::Codes);
    write_png(&path("grey16.png"), 1, ColorType::Grayscale, BitDepth::Sixteen, &[0x33, 0x33, 0xff, 0xff]);
    assert_eq!(read("grey16.png").samples, Samples::Grey([0.2, 1.0].to_vec()));
    write_png(&path("bits.png"), 4, ColorType::Grayscale, BitDepth::Two, &[0b0001_1011]);
    assert_eq!(read("bits.png").samples, Samples::Grey([0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0].to_vec()));
    write_png(&path("rgb.png"), 1, ColorType::Rgb, BitDepth::Eight, &[255, 0, 51]);
    assert_eq!(read("rgb.png").samples, Samples::Rgb(vec![[1.0, 0.0, 0.2]]));
    write_png(&path("rgba.png"), 1, ColorType::Rgba, BitDepth::Eight, &[255, 0, 51, 7]);
    assert_eq!(read("rgba.png").samples, Samples::Rgb(vec![[1.0, 0.0, 0.2]]));
    assert_eq!(read("rgba.png").notes, ["its alpha is ignored"]);
    write_png(&path("palette.png"), 4, ColorType::Indexed, BitDepth::Two, &[0b0001_1011]);
    let expected = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 128.0 / 255.0, 1.0], [1.0; 3]];
    assert_eq!(read("palette.png").samples, Samples::Rgb(expected));
}

/// Every file cut at many lengths is an error that names it.
#[test]
fn pictures_cut_short_are_errors_at_every_length() {
    let (_folder, path) = folder();
    let pixels = colors(64, 40);
    write_exr(&path("whole.exr"), 64, &pixels);
    write_png(
        &path("whole.png"),
        64,
        ColorType::Rgb,
        BitDepth::Eight,
        &(0..64 * 40 * 3).map(|i| (i * i) as u8).collect::<Vec<_>>(),
    );
    let mut files = vec![
        ("exr", fs::read(path("whole.exr")).expect("a file")),
        ("png", fs::read(path("whole.png")).expect("a file")),
    ];
    files.extend(ROWS.map(|rows| ("hdr", hdr(64, &pixels, rows, ""))));
    for (extension, bytes) in files {
        let name = format!("cut.{extension}");
        // The last bytes of a PNG are a chunk that says it ends; its pixels are whole without.
        let needed = if extension == "png" { bytes.len() - 20 } else { bytes.len() };
        for length in (0..needed).step_by(1 + needed / 400).chain(needed.saturating_sub(30)..needed) {
            fs::write(path(&name), &bytes[..length]).expect("a file");
            match read(&path(&name), 0) {
                Err(error @ TextureError::Content { .. }) => assert!(error.to_string().contains(&name), "{error}"),
                other => panic!("{extension} of {length} bytes: {other:?}"),
            }
        }
    }
}

/// Bytes changed at random: an error or a picture, never a panic.
#[test]
fn wounded_pictures_are_errors_or_pictures() {
    let (_folder, path) = folder();
    let pixels = colors(24, 10);
    write_exr(&path("whole.exr"), 24, &pixels);
    write_png(
        &path("whole.png"),
        24,
        ColorType::Grayscale,
        BitDepth::Eight,
        &(0..240).map(|i| (i * i) as u8).collect::<Vec<_>>(),
    );
    let mut files = vec![
        ("exr", fs::read(path("whole.exr")).expect("a file")),
        ("png", fs::read(path("whole.png")).expect("a file")),
    ];
    files.extend(ROWS.map(|rows| ("hdr", hdr(24, &pixels, rows, ""))));
    let mut random: u64 = 0x5eed;
    let mut below = |end: usize| {
        random ^= random << 13;
        random ^= random >> 7;
        random ^= random << 17;
        (random % end as u64) as usize
    };
    let mut good = 0;
    for (extension, bytes) in files {
        for _ in 0..400 {
            let mut wounded = bytes.clone();
            for _ in 0..=below(3) {
                // Headers are short beside pixels, yet most can go wrong there.
                let end = if below(2) == 0 { wounded.len() } else { wounded.len().min(300) };
                wounded[below(end)] = below(256) as u8;
            }
            let name = path(&format!("wounded.{extension}"));
            fs::write(&name, &wounded).expect("a file");
            good += usize::from(read(&name, 0).is_ok());
        }
    }
    assert!(good > 100, "{good}");
}

#[test]
fn pictures_larger_than_memory_say_how_many_bytes_they_take() {
    let (_folder, path) = folder();
    fs::write(path("a.hdr"), "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2000000 +X 4000000\n").expect("a file");
    let message = read(&path("a.hdr"), 0).unwrap_err().to_string();
    assert!(message.contains("a.hdr") && message.contains("128000000000000 bytes"), "{message}");
    // The header of a small file, with another size put in.
    write_exr(&path("a.exr"), 2, &[[1.0; 3]; 16]);
    let mut bytes = fs::read(path("a.exr")).expect("a file");
    let window = b"dataWindow\0box2i\0";
    // Behind the attribute's size stand x0, y0, x1, y1. Wider, so that the number of blocks of rows stays.
    let at = bytes.windows(window.len()).position(|w| w == window).expect("a window") + window.len() + 4;
    bytes[at + 8..at + 12].copy_from_slice(&0x3fff_0000u32.to_le_bytes());
    fs::write(path("a.exr"), &bytes).expect("a file");
    let message = read(&path("a.exr"), 0).unwrap_err().to_string();
    assert!(message.contains("a.exr") && message.contains("GiB of memory"), "{message}");
    write_png(&path("a.png"), 1, ColorType::Grayscale, BitDepth::Eight, &[1]);
    let mut bytes = fs::read(path("a.png")).expect("a file");
    bytes[16..24].copy_from_slice(&[0, 0x0f, 0xff, 0xff, 0, 0x0f, 0xff, 0xff]);
    let crc = crc32(&bytes[12..29]);
    bytes[29..33].copy_from_slice(&crc.to_be_bytes());
    fs::write(path("a.png"), &bytes).expect("a file");
    let message = read(&path("a.png"), 0).unwrap_err().to_string();
    assert!(message.contains("a.png") && message.contains("GiB of memory"), "{message}");
}

fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0, |crc, byte| {
        (0..8).fold(crc ^ u32::from(*byte), |crc, _| if crc & 1 == 1 { crc >> 1 ^ 0xedb8_8320 } else { crc >> 1 })
    })
}

#[test]
fn what_is_no_picture_is_told_by_name() {
    let (_folder, path) = folder();
    fs::write(path("a.hdr"), "P6 3 3 255\n").expect("a file");
    fs::write(path("b.hdr"), "#?RADIANCE\nFORMAT=24-bit\n\n-Y 1 +X 1\nabcd").expect("a file");
    fs::write(path("c.hdr"), "#?RADIANCE\n\n+X 1 -Y 1\nabcd").expect("a file");
    fs::write(path("d.hdr"), "#?RADIANCE\n\n-Y 0 +X 7\nabcd").expect("a file");
    fs::write(path("e.hdr"), "#?RADIANCE\nEXPOSURE=0\n\n-Y 1 +X 1\nabcd").expect("a file");
    fs::write(path("a.jpg"), "").expect("a file");
    fs::write(path("a.exr"), "#?RADIANCE\n").expect("a file");
    fs::create_dir(path("folder.png")).expect("a folder");
    for (name, says) in [
        ("a.hdr", "does not begin with #?RADIANCE"),
        ("b.hdr", "`24-bit` is not known"),
        ("c.hdr", "rows are columns"),
        ("d.hdr", "7 × 0 texels"),
        ("e.hdr", "EXPOSURE=0"),
        ("a.jpg", ".exr, .hdr or .png"),
        ("a.exr", "no EXR"),
        ("none.exr", "cannot read"),
        ("folder.png", "no file"),
    ] {
        let message = read(&path(name), 0).unwrap_err().to_string();
        assert!(message.contains(name) && message.contains(says), "{message}");
    }
}
