//! Files: read back equal, the same bytes twice, whole or not at all.

use std::fs;
use std::io::Cursor;
use std::path::Path;

use exr::prelude::{ReadChannels, ReadLayers};
use spectrel::film::{Develop, Developed, Exposure, Film, Window};
use spectrel::image::{self, Bits, ExrSpace, Format, ImageError, Metadata, Options};
use spectrel::spectrum::RgbSpace;

/// A crop of 5 × 4 pixels at (3, 2) of 16 × 9, with colours inside and outside the display.
fn picture() -> Developed {
    let window = Window { x0: 3, y0: 2, width: 5, height: 4 };
    let mut film = Film::new([16, 9], window).unwrap();
    for (i, pixel) in film.pixels_mut().iter_mut().enumerate() {
        let y = 40.0 * i as f32;
        pixel.add([y * 0.9, y, y * 0.3 + 1.0]);
    }
    film.develop(&Develop { exposure: Exposure::Ev(9.0), ..Develop::default() }).unwrap()
}

/// One row with these linear sRGB pixels.
fn row(rgb: &[[f32; 3]]) -> Developed {
    let mut developed = Film::full(rgb.len() as u32, 1).unwrap().develop(&Develop::default()).unwrap();
    developed.rgb = rgb.to_vec();
    developed
}

fn metadata() -> Metadata {
    Metadata::new().with("scene", "8f00b204e9800998").with("seed", 7).with("material", "größer als 1 µm")
}

fn png_bytes(developed: &Developed, bits: Bits) -> Vec<u8> {
    image::encode(Format::Png, developed, &Options { bits, ..Options::default() }, &metadata()).unwrap().bytes
}

fn read_png(bytes: &[u8]) -> (png::Info<'static>, Vec<u8>) {
    let mut reader = png::Decoder::new(Cursor::new(bytes)).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut pixels).unwrap();
    (reader.info().clone(), pixels)
}

#[test]
fn png_holds_known_values() {
    // 0.214041140 is the linear value of the middle of sRGB, 0.5 (IEC 61966-2-1).
    let developed = row(&[[0.0, 1.0, 0.214_041_14], [0.001, 0.5, 2.0 / 255.0 / 12.92]]);
    let (info, pixels) = read_png(&png_bytes(&developed, Bits::Eight));
    assert_eq!(pixels, [0, 255, 128, 3, 188, 2]);
    assert_eq!(info.bit_depth, png::BitDepth::Eight);
    assert!(info.srgb.is_some());
    let (info, pixels) = read_png(&png_bytes(&developed, Bits::Sixteen));
    let values: Vec<u16> = pixels.chunks_exact(2).map(|b| u16::from_be_bytes([b[0], b[1]])).collect();
    assert_eq!(values, [0, 65535, 32768, 847, 48192, 514]);
    assert_eq!(info.bit_depth, png::BitDepth::Sixteen);
}

#[test]
fn png_says_srgb_and_carries_the_metadata() {
    let bytes = png_bytes(&picture(), Bits::Eight);
    for chunk in [b"sRGB", b"gAMA", b"cHRM", b"tEXt", b"iTXt"] {
        assert!(bytes.windows(4).any(|w| w == chunk), "{}", String::from_utf8_lossy(chunk));
    }
    let (info, _) = read_png(&bytes);
    let seed = info.uncompressed_latin1_text.iter().find(|t| t.keyword == "spectrel:seed").unwrap();
    assert_eq!(seed.text, "7");
    assert_eq!(info.utf8_text[0].get_text().unwrap(), "größer als 1 µm");
}

#[test]
fn other_spaces_say_what_they_are() {
    let has = |bytes: &[u8], chunk: &[u8]| bytes.windows(4).any(|w| w == chunk);
    for (space, cicp) in [
        (RgbSpace::DisplayP3, Some(12)),
        (RgbSpace::Rec2020, Some(9)),
        (RgbSpace::AcesCg, None),
        (RgbSpace::Srgb, None),
    ] {
        let film = Film::full(1, 1).unwrap();
        let developed = film.develop(&Develop { space, ..Develop::default() }).unwrap();
        let bytes = png_bytes(&developed, Bits::Eight);
        assert_eq!(has(&bytes, b"sRGB"), space == RgbSpace::Srgb);
        assert!(has(&bytes, b"cHRM") && has(&bytes, b"gAMA"));
        let at = bytes.windows(4).position(|w| w == b"cICP");
        assert_eq!(at.map(|at| bytes[at + 4]), cicp);
        read_png(&bytes);
        let exr = image::encode(Format::Exr, &developed, &Options::default(), &Metadata::new()).unwrap().bytes;
        let white = read_exr(&exr).0.shared_attributes.chromaticities.unwrap().white;
        assert_eq!((white.0, white.1), (space.white_xy()[0] as f32, space.white_xy()[1] as f32));
    }
}

#[test]
fn exr_reads_back_equal_with_its_windows() {
    let developed = picture();
    for (exr_space, expected) in [(ExrSpace::Rgb, &developed.rgb), (ExrSpace::Xyz, &developed.xyz)] {
        let options = Options { exr_space, ..Options::default() };
        let encoded = image::encode(Format::Exr, &developed, &options, &metadata()).unwrap();
        assert_eq!((encoded.beyond_half, &read_exr(&encoded.bytes).1), (0, expected));
    }
}

/// The header and the pixels in f32.
fn read_exr(bytes: &[u8]) -> (exr::meta::header::Header, Vec<[f32; 3]>) {
    let meta = exr::meta::MetaData::read_from_buffered(Cursor::new(bytes), true).unwrap();
    let image = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .rgb_channels(
            |size, _| (size.0, vec![[0f32; 3]; size.0 * size.1]),
            |(width, pixels), at, (r, g, b): (f32, f32, f32)| pixels[at.1 * *width + at.0] = [r, g, b],
        )
        .first_valid_layer()
        .all_attributes()
        .from_buffered(Cursor::new(bytes))
        .unwrap();
    (meta.headers[0].clone(), image.layer_data.channel_data.pixels.1)
}

#[test]
fn exr_attributes_say_what_the_numbers_are() {
    let developed = picture();
    let header = |exr_space| {
        let options = Options { exr_space, ..Options::default() };
        read_exr(&image::encode(Format::Exr, &developed, &options, &metadata()).unwrap().bytes).0
    };
    let rgb = header(ExrSpace::Rgb);
    let window = rgb.shared_attributes.display_window;
    assert_eq!((window.position.0, window.position.1, window.size.0, window.size.1), (0, 0, 16, 9));
    let window = rgb.data_window();
    assert_eq!((window.position.0, window.position.1, window.size.0, window.size.1), (3, 2, 5, 4));
    assert_eq!(rgb.own_attributes.white_luminance, Some(512.0));
    let xy = rgb.shared_attributes.chromaticities.unwrap();
    assert_eq!((xy.red.0, xy.red.1, xy.white.0, xy.white.1), (0.64, 0.33, 0.3127, 0.329));
    let named =
        |name: &str| rgb.own_attributes.other.iter().find(|(k, _)| k.as_slice() == name.as_bytes()).map(|(_, v)| v);
    let Some(exr::meta::attribute::AttributeValue::Text(seed)) = named("spectrel:seed") else { panic!() };
    assert_eq!(seed.to_string(), "7");
    let Some(exr::meta::attribute::AttributeValue::Text(utf8)) = named("spectrel:material") else { panic!() };
    assert_eq!(utf8.as_slice(), "größer als 1 µm".as_bytes());
    assert_eq!((&rgb.own_attributes.capture_date, &rgb.shared_attributes.time_code), (&None, &None));
    let xyz = header(ExrSpace::Xyz);
    assert_eq!(xyz.own_attributes.white_luminance, Some(1.0));
    let xy = xyz.shared_attributes.chromaticities.unwrap();
    assert_eq!((xy.red.0, xy.green.1, xy.blue.0, xy.blue.1), (1.0, 1.0, 0.0, 0.0));
}

#[test]
fn half_floats_saturate_and_say_so() {
    let developed = row(&[[0.25, 1e6, -1e6], [65504.0, 3.0, 0.1]]);
    let options = Options { half: true, ..Options::default() };
    let encoded = image::encode(Format::Exr, &developed, &options, &Metadata::new()).unwrap();
    assert_eq!(encoded.beyond_half, 2);
    let pixels = read_exr(&encoded.bytes).1;
    assert_eq!(pixels[0], [0.25, 65504.0, -65504.0]);
    assert!((pixels[1][2] - 0.1).abs() < 1e-4);
}

#[test]
fn the_same_picture_is_the_same_bytes() {
    let mut metadata = metadata();
    (0..20).for_each(|i| metadata.set(format!("key-{i}"), i));
    // Many blocks of 16 lines, compressed by several threads at once.
    let mut film = Film::full(64, 400).unwrap();
    film.pixels_mut().iter_mut().enumerate().for_each(|(i, p)| p.add([(i % 977) as f32, (i % 131) as f32, 1.0]));
    let developed = film.develop(&Develop::default()).unwrap();
    for format in [Format::Exr, Format::Png] {
        let encode = || image::encode(format, &developed, &Options::default(), &metadata).unwrap().bytes;
        let first = encode();
        assert!((0..5).all(|_| encode() == first), "{format:?}");
        let one_thread = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
        assert!(one_thread.install(encode) == first, "{format:?}");
    }
}

fn write(path: &Path) -> Result<image::Written, ImageError> {
    image::write(path, &picture(), &Options::default(), &metadata())
}

fn entries(folder: &Path) -> Vec<String> {
    fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().to_string_lossy().into_owned()).collect()
}

#[test]
fn writing_replaces_and_leaves_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["a.png", "b.EXR"] {
        let path = folder.path().join(name);
        fs::write(&path, "old").unwrap();
        image::check_writable(&path).unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"old", "checking changes nothing");
        assert_eq!(write(&path).unwrap().bytes, fs::metadata(&path).unwrap().len());
    }
    let mut names = entries(folder.path());
    names.sort();
    assert_eq!(names, ["a.png", "b.EXR"]);
}

#[test]
fn unknown_formats_are_named_with_the_known_ones() {
    for name in ["picture.jpg", "picture", ".png"] {
        for error in [write(Path::new(name)).unwrap_err(), image::check_writable(Path::new(name)).unwrap_err()] {
            let message = error.to_string();
            assert!(message.contains(name) && message.contains(".exr or .png"), "{message}");
        }
    }
}

#[test]
fn missing_folders_and_folders_in_the_way_are_errors() {
    let folder = tempfile::tempdir().unwrap();
    let missing = folder.path().join("none/picture.png");
    assert!(matches!(write(&missing), Err(ImageError::NoFolder { .. })));
    assert!(matches!(image::check_writable(&missing), Err(ImageError::NoFolder { .. })));
    let in_the_way = folder.path().join("folder.png");
    fs::create_dir(&in_the_way).unwrap();
    assert!(matches!(write(&in_the_way), Err(ImageError::IsFolder { .. })));
    assert_eq!(entries(folder.path()), ["folder.png"]);
    let error = image::write(
        &folder.path().join("x.png"),
        &picture(),
        &Options::default(),
        &Metadata::new().with("two words", ""),
    );
    assert!(matches!(error, Err(ImageError::Metadata { .. })));
    assert_eq!(entries(folder.path()), ["folder.png"]);
}

#[cfg(target_os = "linux")]
#[test]
fn refusals_of_the_system_are_errors_with_the_path() {
    let folder = tempfile::tempdir().unwrap();
    // Nobody creates files in /proc, and no name has 300 bytes.
    for path in [Path::new("/proc/picture.png"), &folder.path().join(format!("{}.png", "n".repeat(300)))] {
        for error in [write(path).unwrap_err(), image::check_writable(path).unwrap_err()] {
            assert!(matches!(error, ImageError::Write { .. }));
            assert!(error.to_string().contains(&path.display().to_string()), "{error}");
        }
    }
    assert!(entries(folder.path()).is_empty());
}

#[test]
fn content_that_fails_half_way_leaves_the_old_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("film.part");
    fs::write(&path, "old").unwrap();
    let error = image::atomic::write_with(&path, |file| {
        file.write_all(&[7; 100_000])?;
        Err(std::io::Error::other("disk full"))
    });
    assert!(error.unwrap_err().to_string().contains("disk full"));
    assert_eq!(fs::read(&path).unwrap(), b"old");
    assert_eq!(entries(folder.path()), ["film.part"]);
}

#[cfg(unix)]
#[test]
fn unwritable_folders_keep_their_files() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("picture.png");
    fs::write(&path, "old").unwrap();
    fs::set_permissions(folder.path(), fs::Permissions::from_mode(0o555)).unwrap();
    // The super-user may write everywhere; there is nothing to test then.
    if fs::write(folder.path().join("probe"), "").is_err() {
        let error = write(&path).unwrap_err().to_string();
        assert!(error.contains("picture.png") && error.contains("denied"), "{error}");
        assert!(image::check_writable(&path).is_err());
        assert_eq!(fs::read(&path).unwrap(), b"old");
    }
    fs::set_permissions(folder.path(), fs::Permissions::from_mode(0o755)).unwrap();
}

#[cfg(unix)]
#[test]
fn files_are_readable_by_others_and_links_are_followed() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().unwrap();
    let (real, link) = (folder.path().join("real.png"), folder.path().join("link.png"));
    fs::write(&real, "").unwrap();
    std::os::unix::fs::symlink(&real, &link).unwrap();
    write(&link).unwrap();
    assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    let (written, plain) = (fs::metadata(&real).unwrap(), folder.path().join("plain"));
    fs::write(&plain, "").unwrap();
    assert!(written.len() > 0);
    assert_eq!(written.permissions().mode(), fs::metadata(&plain).unwrap().permissions().mode());
}
