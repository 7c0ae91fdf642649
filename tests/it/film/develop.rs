//! Development: white lands on white, nothing is clipped, everything odd is counted.

use spectrel::film::{Develop, Exposure, Film, FilmError, Gamut};

const ILLUMINANT_A: [f64; 3] = [1.098_50, 1.0, 0.355_85];

fn film_of(samples: &[[f32; 3]]) -> Film {
    let mut film = Film::full(samples.len() as u32, 1).unwrap();
    film.pixels_mut().iter_mut().zip(samples).for_each(|(pixel, xyz)| pixel.add(*xyz));
    film
}

#[test]
fn white_at_two_to_the_ev_is_display_white() {
    for ev in [-3.0, 0.0, 7.25, 13.0] {
        let develop = Develop { exposure: Exposure::Ev(ev), white: ILLUMINANT_A, ..Develop::default() };
        let rgb = develop.matrix(ev).unwrap().apply(ILLUMINANT_A.map(|c| c * libm::exp2(ev)));
        assert!(rgb.iter().all(|c| (c - 1.0).abs() < 1e-12), "{rgb:?}");
        let film = film_of(&[ILLUMINANT_A.map(|c| (c * libm::exp2(ev)) as f32)]);
        let rgb = film.develop(&develop).unwrap().rgb[0];
        assert!(rgb.iter().all(|c| (c - 1.0).abs() < 1e-6), "{rgb:?}");
    }
}

#[test]
fn the_scale_of_the_given_white_does_not_matter() {
    let develop = |scale: f64| Develop { white: ILLUMINANT_A.map(|c| c * scale), ..Develop::default() };
    let (one, hundred) = (develop(1.0).matrix(0.0).unwrap(), develop(100.0).matrix(0.0).unwrap());
    for (a, b) in one.0.iter().flatten().zip(hundred.0.iter().flatten()) {
        assert!((a - b).abs() < 1e-14);
    }
}

#[test]
fn colours_beyond_the_display_are_kept_and_counted() {
    // Just below display white, four times as bright, a spectral green (outside sRGB), black without a sample.
    let mut film = film_of(&[[0.94, 0.99, 1.07], [3.8, 4.0, 4.36], [0.1, 0.5, 0.05], [0.0; 3]]);
    film.pixel_mut(0, 0).unwrap().add([f32::NAN, 0.0, 0.0]);
    *film.pixel_mut(3, 0).unwrap() = Default::default();
    let developed = film.develop(&Develop { exposure: Exposure::Ev(0.0), ..Develop::default() }).unwrap();
    assert!(developed.rgb[1].iter().all(|c| *c > 3.9));
    assert!(developed.rgb[2][0] < 0.0);
    let report = &developed.report;
    assert_eq!((report.pixels, report.above_one, report.negative), (4, 1, 1));
    assert_eq!((report.rejected, report.overflow, report.unsampled), (1, 0, 1));
    assert_eq!(report.warnings().len(), 2);
    assert!(developed.display().flatten().all(|c| (0.0..=1.0).contains(&c)));
}

#[test]
fn overflow_is_reported() {
    let developed = film_of(&[[f32::MAX; 3], [1.0; 3]]).develop(&Develop::default()).unwrap();
    assert_eq!(developed.report.overflow, 1);
    assert!(developed.rgb.iter().flatten().all(|c| c.is_finite()));
}

#[test]
fn automatic_exposure_prints_what_it_used() {
    let film = film_of(&[[300.0, 310.0, 290.0], [50.0, 60.0, 40.0]]);
    let auto = film.develop(&Develop::default()).unwrap();
    let again = film.develop(&Develop { exposure: Exposure::Ev(auto.ev), ..Develop::default() }).unwrap();
    assert_eq!(auto, again);
    assert_eq!(auto.ev, format!("{:.2}", auto.ev).parse::<f64>().unwrap());
    assert_eq!(film_of(&[[0.0; 3]; 4]).develop(&Develop::default()).unwrap().ev, 0.0);
}

#[test]
fn clipping_and_keeping_hue_differ_only_outside() {
    let film = film_of(&[[0.2, 0.2, 0.2], [1.2, 0.9, 0.1]]);
    let display = |gamut| {
        let develop = Develop { exposure: Exposure::Ev(0.0), gamut, ..Develop::default() };
        film.develop(&develop).unwrap().display().collect::<Vec<_>>()
    };
    let (clipped, kept) = (display(Gamut::Clip), display(Gamut::PreserveChroma));
    assert_eq!(clipped[0], kept[0]);
    assert_ne!(clipped[1], kept[1]);
}

#[test]
fn impossible_whites_are_errors() {
    let film = film_of(&[[1.0; 3]]);
    for white in [[1.0, 0.0, 1.0], [f64::NAN, 1.0, 1.0], [1.0, -1.0, 1.0], [f64::INFINITY, 1.0, 1.0]] {
        let error = film.develop(&Develop { white, ..Develop::default() }).unwrap_err();
        assert!(matches!(error, FilmError::White { .. }));
    }
}
