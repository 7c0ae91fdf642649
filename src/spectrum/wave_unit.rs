//! In which unit the wavelengths of a file are: stated, or told by the numbers where they leave no
//! doubt.

use super::error::Fault;
use super::table::Number;
use super::words::Word;
use super::{LAMBDA_MAX_NM, LAMBDA_MIN_NM};

/// A unit of wavelength, or of what stands for it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum WaveUnit {
    Nanometre,
    Micrometre,
    Angstrom,
    Metre,
    /// Photon energy.
    ElectronVolt,
    /// Wavenumber.
    PerCentimetre,
}

/// hc/e, eV nm: exact since the SI of 2019.
const EV_NM: f64 = 1_239.841_984_332_002_6;

impl WaveUnit {
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Nanometre => "nm",
            Self::Micrometre => "µm",
            Self::Angstrom => "Å",
            Self::Metre => "m",
            Self::ElectronVolt => "eV",
            Self::PerCentimetre => "1/cm",
        }
    }

    /// The wavelength that a number of this unit means, nm.
    pub fn nm(self, word: Word) -> Result<Number, Fault> {
        let over = |factor: f64| word.number().map(|number| Number { value: factor / number.value, ..number });
        match self {
            Self::Nanometre => word.number(),
            Self::Micrometre => word.scaled(3),
            Self::Angstrom => word.scaled(-1),
            Self::Metre => word.scaled(9),
            Self::ElectronVolt => over(EV_NM),
            Self::PerCentimetre => over(1e7),
        }
    }

    /// The unit that the name of a column states.
    pub fn stated(name: &str) -> Option<Self> {
        let name = name.to_lowercase();
        let plain = name.replace([' ', '^', '(', ')', '[', ']'], "").replace("⁻¹", "-1").replace('−', "-");
        let others = ["µm", "μm", "um", "1/m", "m-1", "nm"].iter().any(|unit| plain.ends_with(unit));
        if plain.ends_with("1/cm") || plain.ends_with("cm-1") || (plain.contains("wavenumber") && !others) {
            return Some(Self::PerCentimetre);
        }
        if plain.contains("wavenumber") {
            return None;
        }
        let words: Vec<&str> = name.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty()).collect();
        let states = |units: &[&str]| words.iter().any(|word| units.contains(word));
        // Both signs for micro: U+00B5 and the Greek letter, which is what lower case makes of
        // either.
        let micro = words.iter().any(|word| word.ends_with("µm") || word.ends_with("μm"));
        match () {
            () if states(&["nm", "nanometre", "nanometer", "nanometres", "nanometers"]) => Some(Self::Nanometre),
            () if micro
                || name == "wl"
                || states(&["um", "micron", "microns", "micrometre", "micrometer", "micrometres", "micrometers"]) =>
            {
                Some(Self::Micrometre)
            }
            () if states(&["å", "å", "angstrom", "angstroms", "ångström", "ang"]) || name.contains("(a)") => {
                Some(Self::Angstrom)
            }
            () if states(&["ev"]) => Some(Self::ElectronVolt),
            () if words.len() > 1 && words.last() == Some(&"m") => Some(Self::Metre),
            () => None,
        }
    }

    /// The unit that the numbers tell: the only one by which they reach into the visible. Energies and wavenumbers may always be wavelengths
    /// in the infrared instead.
    pub fn told(words: &[Word]) -> Option<Self> {
        let reaches = |unit: &Self| {
            let nm: Vec<f64> = words.iter().filter_map(|word| unit.nm(*word).ok()).map(|nm| nm.value).collect();
            let (low, high) =
                nm.iter().fold((f64::INFINITY, 0.0), |(low, high): (f64, f64), &nm| (low.min(nm), high.max(nm)));
            low < LAMBDA_MAX_NM && high > LAMBDA_MIN_NM
        };
        let lengths = [Self::Nanometre, Self::Micrometre, Self::Angstrom];
        let mut possible = lengths.into_iter().chain([Self::ElectronVolt, Self::PerCentimetre]).filter(reaches);
        possible.next().filter(|unit| lengths.contains(unit) && possible.next().is_none())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_state_units() {
        for (name, unit) in [
            ("wavelength_nm", Some(WaveUnit::Nanometre)),
            ("Wavelength (µm)", Some(WaveUnit::Micrometre)),
            ("lambda [μm]", Some(WaveUnit::Micrometre)),
            ("wl", Some(WaveUnit::Micrometre)),
            ("Wavelength (Å)", Some(WaveUnit::Angstrom)),
            ("WAVELENGTH (A)", Some(WaveUnit::Angstrom)),
            ("lambda_m", Some(WaveUnit::Metre)),
            ("Energy (eV)", Some(WaveUnit::ElectronVolt)),
            ("wavenumber (cm^-1)", Some(WaveUnit::PerCentimetre)),
            ("Wavenumber (1/µm)", None),
            ("wavenumber", Some(WaveUnit::PerCentimetre)),
            ("wavelength", None),
            ("m", None),
        ] {
            assert_eq!(WaveUnit::stated(name), unit, "{name}");
        }
    }

    #[test]
    fn numbers_tell_a_unit_only_where_no_other_is_possible() {
        let told = |first: &str, last: &str| WaveUnit::told(&[first, last].map(|text| Word { text, offset: 0 }));
        assert_eq!(told("400", "700"), Some(WaveUnit::Nanometre));
        assert_eq!(told("0.4", "0.7"), Some(WaveUnit::Micrometre));
        assert_eq!(told("4000", "7000"), Some(WaveUnit::Angstrom));
        // eV or infrared µm; Å or 1/cm.
        assert_eq!((told("1.6", "3.2"), told("5000", "25000")), (None, None));
        // µm or eV; nm or Å; nothing that anyone sees.
        assert_eq!(told("0.3", "2.5"), None);
        assert_eq!(told("300", "9000"), None);
        assert_eq!(told("20", "30"), None);
        let nm = |unit: WaveUnit, text| unit.nm(Word { text, offset: 0 }).unwrap().value;
        assert!((nm(WaveUnit::ElectronVolt, "2") - 619.920992).abs() < 1e-6);
        assert_eq!((nm(WaveUnit::PerCentimetre, "20000"), nm(WaveUnit::Metre, "5.876e-7")), (500.0, 587.6));
    }
}
