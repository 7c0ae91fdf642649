//! Pictures that come in: every form reads to the values that were written, and what is broken is an error with a name.

use crate::common::pictures::{
    ROWS, Rows, hdr, sampled_exr, stored, write_exr, write_exr_channel, write_exr_channels, write_exr_window,
    write_exr_with, write_png, write_png_with,
};
use png::{BitDepth, ColorType};
use spectrel::spectrum::{Chromaticities, RgbSpace};
use spectrel::texture::{Curve, Encoding, Raster, Samples, TextureError, read};
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
        other => panic!("{other:?}"),
    }
}

/// The codes of a PNG over their largest.
fn coded(raster: Raster) -> Vec<[f32; 3]> {
    assert_eq!(raster.encoding(), Encoding::Codes);
    raster.into_rgb()
}

fn grey<const N: usize>(values: [f32; N]) -> Vec<[f32; 3]> {
    values.map(|value| [value; 3]).to_vec()
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
            assert_eq!((rgb(&raster), raster.encoding()), (&pixels[..], Encoding::Linear), "{rows:?} {width}");
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
    assert_eq!(coded(read("grey.png")), grey([0.0, 0.2, 0.4, 1.0]));
    write_png(&path("grey16.png"), 1, ColorType::Grayscale, BitDepth::Sixteen, &[0x33, 0x33, 0xff, 0xff]);
    assert_eq!(coded(read("grey16.png")), grey([0.2, 1.0]));
    write_png(&path("bits.png"), 4, ColorType::Grayscale, BitDepth::Two, &[0b0001_1011]);
    assert_eq!(coded(read("bits.png")), grey([0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0]));
    write_png(&path("rgb.png"), 1, ColorType::Rgb, BitDepth::Eight, &[255, 0, 51]);
    assert_eq!(coded(read("rgb.png")), [[1.0, 0.0, 0.2]]);
    write_png(&path("rgba.png"), 1, ColorType::Rgba, BitDepth::Eight, &[255, 0, 51, 7]);
    assert_eq!(read("rgba.png").notes, ["its alpha is ignored"]);
    assert_eq!(coded(read("rgba.png")), [[1.0, 0.0, 0.2]]);
    write_png(&path("palette.png"), 4, ColorType::Indexed, BitDepth::Two, &[0b0001_1011]);
    let expected = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 128.0 / 255.0, 1.0], [1.0; 3]];
    assert_eq!(coded(read("palette.png")), expected);
}

#[test]
fn png_says_what_its_codes_mean_by_the_first_of_its_chunks() {
    let (_folder, path) = folder();
    let p3 = RgbSpace::DisplayP3.chromaticities();
    let write = |chunks: &[(&[u8; 4], Vec<u8>)]| {
        write_png_with(&path("a.png"), 1, ColorType::Rgb, BitDepth::Eight, &[200, 60, 40], chunks);
        read(&path("a.png"), 0).expect("a picture")
    };
    let curve = |raster: &Raster| raster.curves.clone().map(|curves| curves[1].clone());
    let gamma = |value: u32| (b"gAMA", value.to_be_bytes().to_vec());
    let numbers = |[red, green, blue]: [[f64; 2]; 3], white: [f64; 2]| {
        let all = [white, red, green, blue].concat();
        (b"cHRM", all.iter().flat_map(|x| ((x * 1e5).round() as u32).to_be_bytes()).collect::<Vec<u8>>())
    };
    let plain = write(&[]);
    assert_eq!((curve(&plain), plain.chromaticities), (None, None));
    assert_eq!(curve(&write(&[gamma(100_000)])), Some(Curve::Power(1.0)));
    assert_eq!(curve(&write(&[gamma(45_455)])), Some(Curve::Srgb), "as it is viewed everywhere");
    assert_eq!(curve(&write(&[gamma(55_556)])), Some(Curve::Power(1e5 / 55_556.0)));
    let stated = write(&[numbers(p3.primaries_xy, p3.white_xy)]);
    assert_eq!(stated.chromaticities.and_then(|stated| stated.space()), Some(RgbSpace::DisplayP3));
    let srgb = write(&[gamma(100_000), (b"sRGB", vec![0]), numbers(p3.primaries_xy, p3.white_xy)]);
    assert_eq!((curve(&srgb), srgb.chromaticities), (Some(Curve::Srgb), Some(RgbSpace::Srgb.chromaticities())));
    let by_number = write(&[(b"cICP", vec![12, 13, 0, 1]), (b"sRGB", vec![0])]);
    assert_eq!((curve(&by_number), by_number.chromaticities), (Some(Curve::Srgb), Some(p3)));
    let wide = write(&[(b"cICP", vec![9, 14, 0, 1])]);
    assert_eq!((curve(&wide), wide.chromaticities), (Some(Curve::Bt709), Some(RgbSpace::Rec2020.chromaticities())));
    let hdr = write(&[(b"cICP", vec![9, 16, 0, 1])]);
    assert!(hdr.notes[0].contains("the curve 16") && curve(&hdr) == Some(Curve::Srgb), "{:?}", hdr.notes);
    let odd = write(&[(b"iCCP", [b"a profile\0\0".as_slice(), &stored(b"no profile at all")].concat())]);
    assert!(odd.notes[0].contains("colour profile") && odd.curves.is_none(), "{:?}", odd.notes);
    let adobe = [[0.60974, 0.31111, 0.01947], [0.20528, 0.62567, 0.06087], [0.14919, 0.06322, 0.74457]];
    let profile = [b"Adobe\0\0".as_slice(), &stored(&profile(adobe, 563))].concat();
    let stated = write(&[gamma(100_000), (b"iCCP", profile)]);
    assert_eq!(curve(&stated), Some(Curve::Power(563.0 / 256.0)));
    let matrices = [stated.chromaticities.expect("primaries"), Chromaticities::ADOBE_RGB];
    let [found, expected] = matrices.map(|stated| stated.to(RgbSpace::Srgb).expect("colours"));
    for (a, b) in found.0.iter().flatten().zip(expected.0.iter().flatten()) {
        assert!((a - b).abs() < 1e-3, "{found:?} {expected:?}");
    }
}

/// Three primaries as adapted to D50 and one gamma in 256ths, as an ICC profile.
fn profile(colors: [[f64; 3]; 3], gamma: u16) -> Vec<u8> {
    let mut bytes = vec![0u8; 128];
    bytes[16..24].copy_from_slice(b"RGB XYZ ");
    bytes[36..40].copy_from_slice(b"acsp");
    bytes.extend(6u32.to_be_bytes());
    let entry = |name: &[u8; 4], at: u32, size: u32| [&name[..], &at.to_be_bytes(), &size.to_be_bytes()].concat();
    for (i, name) in [b"rXYZ", b"gXYZ", b"bXYZ"].into_iter().enumerate() {
        bytes.extend(entry(name, 132 + 72 + 20 * i as u32, 20));
    }
    [b"rTRC", b"gTRC", b"bTRC"].into_iter().for_each(|name| bytes.extend(entry(name, 132 + 72 + 60, 14)));
    for color in colors {
        bytes.extend(b"XYZ \0\0\0\0");
        color.iter().for_each(|value| bytes.extend(((value * 65536.0).round() as i32).to_be_bytes()));
    }
    bytes.extend(b"curv\0\0\0\0\0\0\0\x01");
    bytes.extend(gamma.to_be_bytes());
    bytes
}

#[test]
fn colour_corrections_of_radiance_hdr_are_divided_out() {
    let (_folder, path) = folder();
    let pixels = colors(9, 4);
    let more = "COLORCORR=2 1 0.5\nEXPOSURE=2\nCOLORCORR= 2 1 1\n";
    fs::write(path("a.hdr"), hdr(9, &pixels, Rows::Flat, more)).expect("a file");
    let raster = read(&path("a.hdr"), 0).expect("a picture");
    let expected: Vec<_> = pixels.iter().map(|[r, g, b]| [r / 8.0, g / 2.0, b / 1.0]).collect();
    assert_eq!(rgb(&raster), &expected[..]);
    assert!(raster.notes[0].contains("0.125, 0.5 and 1"), "{:?}", raster.notes);
    for broken in ["COLORCORR=1 1", "COLORCORR=1 0 1", "COLORCORR=1 1 x"] {
        fs::write(path("a.hdr"), hdr(9, &pixels, Rows::Flat, broken)).expect("a file");
        assert!(read(&path("a.hdr"), 0).unwrap_err().to_string().contains(broken));
    }
}

#[test]
fn exr_pictures_are_found_by_the_names_of_their_channels() {
    let (_folder, path) = folder();
    let write = |names: &[&str]| {
        let values = (0..names.len()).map(|i| vec![i as f32, 10.0 + i as f32]);
        write_exr_channels(&path("a.exr"), 2, &names.iter().copied().zip(values).collect::<Vec<_>>());
        read(&path("a.exr"), 0).expect("a picture")
    };
    let xyz = write(&["X", "Y", "Z"]);
    assert_eq!(
        (rgb(&xyz), xyz.chromaticities),
        (&[[0.0, 1.0, 2.0], [10.0, 11.0, 12.0]][..], Some(Chromaticities::XYZ))
    );
    assert_eq!(write(&["R"]).samples, Samples::Grey(vec![0.0, 10.0]));
    assert_eq!(write(&["Y", "Z"]).samples, Samples::Grey(vec![0.0, 10.0]));
    let layers = write(&["Albedo.R", "Albedo.G", "Albedo.B", "View.Combined.R", "View.Combined.G", "View.Combined.B"]);
    assert_eq!(rgb(&layers), [[3.0, 4.0, 5.0], [13.0, 14.0, 15.0]]);
    assert_eq!(layers.notes, ["its layer `View.Combined` is read, and not `Albedo`"]);
    let plain = write(&["Combined.R", "Combined.G", "Combined.B", "R", "G", "B"]);
    assert_eq!((rgb(&plain)[0], plain.notes.len()), ([3.0, 4.0, 5.0], 0));
    // Normals are no colours.
    write_exr_channels(&path("n.exr"), 1, &[("N.X", vec![1.0]), ("N.Y", vec![1.0]), ("N.Z", vec![1.0])]);
    assert!(read(&path("n.exr"), 0).unwrap_err().to_string().contains("`N.X`"));
    // Y = 0.5 with R = 1 and B = 0.2, by the luminances of sRGB's primaries.
    let chroma = [("BY", vec![-0.6]), ("RY", vec![1.0]), ("Y", vec![0.5])];
    write_exr_channels(&path("c.exr"), 1, &chroma);
    let [r, g, b] = rgb(&read(&path("c.exr"), 0).expect("a picture"))[0];
    let green = (0.5 - 0.2126 - 0.0722 * 0.2) / 0.7152;
    assert!((r - 1.0).abs() < 1e-6 && (b - 0.2).abs() < 1e-6 && (f64::from(g) - green).abs() < 1e-3, "{r} {g} {b}");
}

#[test]
fn chroma_of_half_the_resolution_is_read_in_every_packing() {
    let (_folder, path) = folder();
    let (width, height) = (6, 20);
    let luminance: Vec<f32> = (0..width * height).map(|i| 1.0 + i as f32 / 64.0).collect();
    // Red grows to the right and blue downwards, evenly.
    let chroma = |x: usize, y: usize| [x as f32 / 16.0, y as f32 / 32.0];
    for packing in [0, 2, 3] {
        fs::write(path("c.exr"), sampled_exr([width, height], packing, &luminance, chroma)).expect("a file");
        let raster = read(&path("c.exr"), 0).expect("a picture");
        assert_eq!((raster.width as usize, raster.height as usize), (width, height));
        for (i, [r, _, b]) in rgb(&raster).iter().enumerate() {
            // Behind the last sample of chroma there is none to come.
            let [ry, by] = chroma((i % width).min(width - 2), (i / width).min(height - 2));
            let expected = [(ry + 1.0) * luminance[i], (by + 1.0) * luminance[i]];
            assert!((r - expected[0]).abs() < 1e-4 && (b - expected[1]).abs() < 1e-4, "{packing}, {i}: {r} {b}");
        }
    }
    let bytes = sampled_exr([width, height], 3, &luminance, chroma);
    for length in (0..bytes.len()).step_by(7) {
        fs::write(path("c.exr"), &bytes[..length]).expect("a file");
        assert!(read(&path("c.exr"), 0).is_err(), "{length}");
    }
}

#[test]
fn a_data_window_stands_where_it_is_in_its_display_window() {
    let (_folder, path) = folder();
    let pixels: Vec<[f32; 3]> = (1..=6).map(|i| [i as f32; 3]).collect();
    let placed = |position: (i32, i32), display: [usize; 2]| {
        write_exr_window(&path("a.exr"), 3, &pixels, position, display);
        read(&path("a.exr"), 0).expect("a picture")
    };
    let part = placed((1, 1), [5, 4]);
    assert_eq!((part.width, part.height), (5, 4));
    let values: Vec<f32> = rgb(&part).iter().map(|[r, ..]| *r).collect();
    let rows = [[0.0; 5], [0.0, 1.0, 2.0, 3.0, 0.0], [0.0, 4.0, 5.0, 6.0, 0.0], [0.0; 5]];
    assert_eq!(values, rows.concat());
    assert_eq!(part.notes, ["it has texels for 3 × 2 of its 5 × 4: the others are black"]);
    let beyond = placed((-1, -1), [1, 1]);
    assert_eq!((rgb(&beyond), beyond.width), (&[[5.0; 3]][..], 1));
    assert!(beyond.notes[0].contains("outside of its display window of 1 × 1"), "{:?}", beyond.notes);
    let elsewhere = placed((9, 9), [2, 2]);
    assert_eq!((elsewhere.width, rgb(&elsewhere).len()), (3, 6), "nothing in common");
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
    fs::write(path("a.gif"), "").expect("a file");
    fs::write(path("a.jpg"), "").expect("a file");
    fs::write(path("a.exr"), "#?RADIANCE\n").expect("a file");
    fs::create_dir(path("folder.png")).expect("a folder");
    for (name, says) in [
        ("a.hdr", "does not begin with #?RADIANCE"),
        ("b.hdr", "`24-bit` is not known"),
        ("c.hdr", "rows are columns"),
        ("d.hdr", "7 × 0 texels"),
        ("e.hdr", "EXPOSURE=0"),
        ("a.gif", ".exr, .hdr, .png or .jpg"),
        ("a.jpg", "ends in the middle"),
        ("a.exr", "no EXR"),
        ("none.exr", "cannot read"),
        ("folder.png", "no file"),
    ] {
        let message = read(&path(name), 0).unwrap_err().to_string();
        assert!(message.contains(name) && message.contains(says), "{message}");
    }
}

/// `slopes*.jpg`: R = 40 + 10 x, G = 220 − 8 y, B = 60 + 5 (x + y) of 16 × 16 texels, as Pillow 12 wrote them with quality 95 and
/// without subsampling; the values are Pillow's of the same files.
#[test]
fn jpegs_have_the_values_of_another_decoder() {
    let data = |name: &str| PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(name);
    let near = |found: [f32; 3], codes: [u8; 3]| {
        let off = |(found, code): (f32, u8)| (found * 255.0 - f32::from(code)).abs();
        assert!(found.into_iter().zip(codes).map(off).fold(0.0, f32::max) < 2.5, "{found:?} {codes:?}");
    };
    let corners = [(0, [40, 220, 61]), (15, [190, 220, 134]), (240, [40, 100, 136]), (255, [190, 101, 209])];
    for name in ["slopes.jpg", "slopes-progressive.jpg"] {
        let raster = read(&data(name), 0).expect("a picture");
        assert_eq!((raster.width, raster.height, raster.encoding()), (16, 16, Encoding::Codes));
        assert!(raster.curves.is_none() && raster.chromaticities.is_none() && raster.notes.is_empty(), "{name}");
        let texels = coded(raster);
        corners.iter().chain(&[(87, [110, 180, 118])]).for_each(|&(texel, codes)| near(texels[texel], codes));
    }
    let raster = read(&data("slopes-grey.jpg"), 0).expect("a picture");
    assert!(matches!(&raster.samples, Samples::Codes(codes) if codes.is_grey()));
    let texels = coded(raster);
    let greys = [(0, 148), (15, 201), (240, 86), (255, 140), (87, 152)];
    greys.into_iter().for_each(|(texel, code)| near(texels[texel], [code; 3]));
}

#[test]
fn jpegs_of_print_and_those_cut_short_are_told() {
    let data = |name: &str| PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(name);
    let told = |path: &PathBuf| read(path, 0).expect_err("an error").to_string();
    let print = told(&data("slopes-cmyk.jpg"));
    assert!(print.contains("CMYK") && print.contains("slopes-cmyk.jpg"), "{print}");
    let (_folder, path) = folder();
    let whole = fs::read(data("slopes.jpg")).expect("a file");
    for length in [0, 1, 20, whole.len() / 2, whole.len() - 40] {
        fs::write(path("cut.jpeg"), &whole[..length]).expect("a file");
        assert!(told(&path("cut.jpeg")).contains("cut.jpeg"), "{length}");
    }
}

/// A profile in a JPEG is read as one in a PNG is.
#[test]
fn the_profile_of_a_jpeg_is_honoured() {
    let (_folder, path) = folder();
    let data = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/data/slopes.jpg");
    let whole = fs::read(data).expect("a file");
    let with = |profile: &[u8]| {
        let mut segment = b"\xff\xe2".to_vec();
        segment.extend((profile.len() as u16 + 16).to_be_bytes());
        segment.extend(b"ICC_PROFILE\0\x01\x01");
        segment.extend(profile);
        fs::write(path("a.jpg"), [&whole[..2], &segment, &whole[2..]].concat()).expect("a file");
        read(&path("a.jpg"), 0).expect("a picture")
    };
    let mut grey = vec![0u8; 128];
    grey[16..20].copy_from_slice(b"GRAY");
    grey[36..40].copy_from_slice(b"acsp");
    grey.extend([0, 0, 0, 1]);
    grey.extend(b"kTRC\0\0\0\x90\0\0\0\x0e");
    grey.extend(b"curv\0\0\0\0\0\0\0\x01\x02\x00");
    assert_eq!(with(&grey).curves, Some([Curve::Power(2.0), Curve::Power(2.0), Curve::Power(2.0)]));
    let unknown = with(b"no profile");
    assert!(unknown.curves.is_none() && unknown.notes[0].contains("taken for sRGB"), "{:?}", unknown.notes);
}
