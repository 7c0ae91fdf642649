//! Data sets and materials by name: built in, or from a user's folders, which are searched first.
//!
//! Opening a library does nothing; a file is read and parsed when it is first asked for, and kept. Names are paths below
//! the quantity's folder without `.toml`: "Au/olmon-2012-evaporated" is `spectra/ior/Au/olmon-2012-evaporated.toml`;
//! upper and lower case do not matter. A name with the ending of a data file (see `format`) is a file beside the scene.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use include_dir::{Dir, include_dir};
use serde::Deserialize;

use super::curve::common_range;
use super::error::Fault;
use super::format::{Format, file_of, part_of, text_of};
use super::toml_file::{self, Loaded};
use super::{
    About, ColorMatching, Dataset, Daylight, Ior, Observer, Quantity, Spectrum, SpectrumError, agf_file, cgats_file,
    nearest, rii_page, spdx_file, table_file,
};

static SPECTRA: Dir = include_dir!("$CARGO_MANIFEST_DIR/spectra");
static MATERIALS: Dir = include_dir!("$CARGO_MANIFEST_DIR/materials");

/// The text of a material's file; what it means is for the scene to say.
#[derive(Clone, Debug, PartialEq)]
pub struct MaterialText {
    /// Its file name without `.toml`, which may differ from the alias that was asked for.
    pub name: String,
    pub text: String,
    /// Where it was found; built-in files are named `built-in:…`.
    pub origin: PathBuf,
    /// What relative names in it are relative to.
    pub base: PathBuf,
}

/// Where data come from. Cheap to open; shared between threads.
#[derive(Default)]
pub struct Library {
    dirs: Vec<PathBuf>,
    iors: Cache<Ior>,
    curves: Cache<Dataset>,
    observers: Cache<ColorMatching>,
}

type Cache<T> = Mutex<HashMap<(Quantity, PathBuf), Arc<T>>>;

impl Library {
    /// The built-in library behind folders of the same layout (`spectra/ior/…`, `materials/…`), the first first.
    pub fn new(dirs: Vec<PathBuf>) -> Self {
        Self { dirs, ..Self::default() }
    }

    /// The index of refraction of this name, or of a file relative to `base`.
    pub fn ior(&self, name: &str, base: &Path) -> Result<Arc<Ior>, SpectrumError> {
        self.load(&self.iors, Quantity::Ior, name, base, |text, name, format| match format {
            Format::Toml => match toml_file::read(text, name, Quantity::Ior)? {
                Loaded::Ior(ior) => Ok(ior),
                _ => Err(not_a("an index of refraction")),
            },
            Format::Yaml => rii_page::read(text, name),
            Format::Agf => agf_file::read(text, name, part_of(name)),
            Format::Spdx => Err(not_a("an index of refraction: this format holds lights and reflectances")),
            Format::Cgats => Err(not_a("an index of refraction: this format holds reflectances")),
            Format::Columns if part_of(name).is_some() => Err(no_parts()),
            Format::Columns => {
                let (n, k, about) = table_file::read_ior(text, name)?;
                let range_nm = [n.range_nm(), k.range_nm()].into_iter().flatten().reduce(common_range);
                Ok(Ior { n, k, about: About { range_nm, ..about } })
            }
        })
    }

    /// A reflectance, 0…1.
    pub fn reflectance(&self, name: &str, base: &Path) -> Result<Arc<Dataset>, SpectrumError> {
        self.curve(Quantity::Reflectance, name, base)
    }

    /// An absorption coefficient, m⁻¹, natural base.
    pub fn absorption(&self, name: &str, base: &Path) -> Result<Arc<Dataset>, SpectrumError> {
        self.curve(Quantity::Absorption, name, base)
    }

    /// The relative spectral power of a light.
    pub fn illuminant(&self, name: &str, base: &Path) -> Result<Arc<Dataset>, SpectrumError> {
        self.curve(Quantity::Illuminant, name, base)
    }

    /// An illuminant that is to shine in a picture: where the tables of D50, D55, D65 and D75 end at 780 nm as published, the
    /// light goes on to 830 nm by the components that they were made from (CIE 15:2004, table T.2).
    pub fn light(&self, name: &str, base: &Path) -> Result<Arc<Dataset>, SpectrumError> {
        let found = self.illuminant(name, base)?;
        Ok(match (Daylight::of_name(name), &found.spectrum) {
            (Some(daylight), Spectrum::Table(table)) => {
                let spectrum = Spectrum::Table(daylight.continued(table));
                let about = About { range_nm: spectrum.range_nm(), ..found.about.clone() };
                Arc::new(Dataset { spectrum, about })
            }
            _ => found,
        })
    }

    /// The colour matching functions of an observer.
    pub fn observer(&self, observer: Observer) -> Result<Arc<ColorMatching>, SpectrumError> {
        let name = observer.name();
        self.load(&self.observers, Quantity::Observer, name, Path::new(""), |text, name, _| {
            match toml_file::read(text, name, Quantity::Observer)? {
                Loaded::Observer(observer) => Ok(observer),
                _ => Err(not_a("an observer")),
            }
        })
    }

    /// Why a built-in index stands for its material, where several were published.
    pub fn why(&self, name: &str) -> Option<String> {
        let text = SPECTRA.get_file("why.csv")?.contents();
        let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(text);
        let mut records = reader.records().filter_map(Result::ok);
        records.find(|record| record.get(0) == Some(name)).and_then(|record| record.get(1).map(str::to_owned))
    }

    /// Whether a name is that of a data file rather than of something in the library.
    pub fn is_file_name(name: &str) -> bool {
        Format::of(name).is_some()
    }

    /// The names of all data sets of a quantity, sorted.
    pub fn names(&self, quantity: Quantity) -> Vec<String> {
        let folder = Path::new("spectra").join(quantity.as_str());
        let users = self.dirs.iter().flat_map(|dir| names_in(&dir.join(&folder)));
        let built_in = SPECTRA.get_dir(quantity.as_str()).map(embedded_names).unwrap_or_default();
        sorted(users.chain(built_in))
    }

    /// The names of all materials, sorted; aliases are not among them.
    pub fn material_names(&self) -> Vec<String> {
        let users = self.dirs.iter().flat_map(|dir| names_in(&dir.join("materials")));
        sorted(users.chain(embedded_names(&MATERIALS)))
    }

    /// A material's text, by its file name or, if there is none, by one of the aliases that the files state.
    pub fn material(&self, name: &str) -> Result<MaterialText, SpectrumError> {
        let names = self.material_names();
        if let Some(found) = same_name(name, &names) {
            return self.material_text(found);
        }
        let mut known = names.clone();
        for candidate in &names {
            let material = self.material_text(candidate)?;
            let aliases = aliases(&material.text);
            if same_name(name, &aliases).is_some() {
                return Ok(material);
            }
            known.extend(aliases);
        }
        let suggestion = nearest(name, known.iter().map(String::as_str)).map(str::to_owned);
        Err(SpectrumError::UnknownMaterial { name: name.to_owned(), suggestion })
    }

    fn material_text(&self, name: &str) -> Result<MaterialText, SpectrumError> {
        let file = format!("{name}.toml");
        for dir in &self.dirs {
            let origin = dir.join("materials").join(&file);
            if origin.is_file() {
                let text = text_of(&origin)?;
                let base = origin.parent().unwrap_or(dir).to_path_buf();
                return Ok(MaterialText { name: name.to_owned(), text, origin, base });
            }
        }
        let text = MATERIALS.get_file(&file).and_then(|file| file.contents_utf8());
        let Some(text) = text else {
            return Err(SpectrumError::UnknownMaterial { name: name.to_owned(), suggestion: None });
        };
        let origin = PathBuf::from(format!("built-in:materials/{file}"));
        Ok(MaterialText { name: name.to_owned(), text: text.to_owned(), origin, base: PathBuf::new() })
    }

    fn curve(&self, quantity: Quantity, name: &str, base: &Path) -> Result<Arc<Dataset>, SpectrumError> {
        self.load(&self.curves, quantity, name, base, |text, name, format| {
            let (spectrum, about) = match format {
                Format::Toml => match toml_file::read(text, name, quantity)? {
                    Loaded::Curve(dataset) => return Ok(dataset),
                    _ => return Err(not_a(quantity.as_str())),
                },
                Format::Columns | Format::Cgats if quantity == Quantity::Reflectance && cgats_file::is_cgats(text) => {
                    cgats_file::read(text, name, part_of(name))?
                }
                Format::Cgats => return Err(not_a(&format!("a {quantity}: of charts, reflectances are read"))),
                Format::Columns if part_of(name).is_some() => return Err(no_parts()),
                Format::Columns => table_file::read_curve(text, name, quantity)?,
                Format::Spdx if quantity != Quantity::Absorption => spdx_file::read(text, name, quantity)?,
                Format::Spdx => return Err(not_a("an absorption: this format holds lights and reflectances")),
                Format::Agf if quantity == Quantity::Absorption => {
                    let ior = agf_file::read(text, name, part_of(name))?;
                    if ior.k == Spectrum::Constant(0.0) {
                        return Err(not_a("an absorption: this glass has no lines IT of transmittances"));
                    }
                    return Ok(Dataset { spectrum: ior.k.absorption_from_k(), about: ior.about });
                }
                Format::Agf => return Err(not_a(&format!("a {quantity} but a glass catalogue"))),
                Format::Yaml if quantity == Quantity::Absorption => {
                    let (k, about) = rii_page::read_k(text, name)?;
                    let range_nm = k.range_nm();
                    return Ok(Dataset {
                        spectrum: Spectrum::Table(k).absorption_from_k(),
                        about: About { range_nm, ..about },
                    });
                }
                Format::Yaml => return Err(not_a(&format!("a {quantity} but an index of refraction"))),
            };
            let about = About { range_nm: about.range_nm.or(spectrum.range_nm()), ..about };
            Ok(Dataset { spectrum, about })
        })
    }

    /// Finds, reads and keeps a data set.
    fn load<T>(
        &self,
        cache: &Cache<T>,
        quantity: Quantity,
        name: &str,
        base: &Path,
        read: impl FnOnce(&str, &str, Format) -> Result<T, Fault>,
    ) -> Result<Arc<T>, SpectrumError> {
        let format = Format::of(name);
        let key = match format {
            Some(_) => base.join(name),
            None => PathBuf::from(name),
        };
        let lock = || cache.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = lock().get(&(quantity, key.clone())) {
            return Ok(Arc::clone(known));
        }
        let file = match format {
            Some(format) => {
                let path = base.join(file_of(name));
                Found { text: text_of(&path)?, path, name: name.to_owned(), format }
            }
            None => self.find(quantity, name).map_err(|error| match base.join(name).is_file() {
                true => SpectrumError::UnreadableKind { name: name.to_owned() },
                false => error,
            })?,
        };
        let loaded = read(&file.text, &file.name, file.format).map_err(|fault| fault.in_file(file.path, &file.text))?;
        let loaded = Arc::new(loaded);
        lock().insert((quantity, key), Arc::clone(&loaded));
        Ok(loaded)
    }

    fn find(&self, quantity: Quantity, name: &str) -> Result<Found, SpectrumError> {
        if let Some(found) = self.find_exactly(quantity, name)? {
            return Ok(found);
        }
        let names = self.names(quantity);
        if let Some(same) = same_name(name, &names)
            && let Some(found) = self.find_exactly(quantity, same)?
        {
            return Ok(found);
        }
        let suggestion = nearest(name, names.iter().map(String::as_str)).map(str::to_owned);
        Err(SpectrumError::UnknownData { quantity, name: name.to_owned(), suggestion })
    }

    fn find_exactly(&self, quantity: Quantity, name: &str) -> Result<Option<Found>, SpectrumError> {
        let file = format!("{quantity}/{name}.toml");
        let found = |path, text| Some(Found { path, text, name: name.to_owned(), format: Format::Toml });
        for dir in &self.dirs {
            let path = dir.join("spectra").join(&file);
            if path.is_file() {
                let text = text_of(&path)?;
                return Ok(found(path, text));
            }
        }
        let text = SPECTRA.get_file(&file).and_then(|file| file.contents_utf8());
        Ok(text.and_then(|text| found(PathBuf::from(format!("built-in:spectra/{file}")), text.to_owned())))
    }
}

struct Found {
    path: PathBuf,
    text: String,
    name: String,
    format: Format,
}

/// Of a file that is a table, where a part of it was asked for.
fn no_parts() -> Fault {
    Fault::new("this file is one table and has no parts to name after `#`")
}

fn not_a(what: &str) -> Fault {
    Fault::new(format!("this is not {what}"))
}

fn aliases(text: &str) -> Vec<String> {
    #[derive(Deserialize)]
    struct Head {
        #[serde(default)]
        aliases: Vec<String>,
    }
    // A material that does not parse has no aliases; who asks for it by name gets the error.
    toml::from_str::<Head>(text).map(|head| head.aliases).unwrap_or_default()
}

/// The same name, exactly or but for upper and lower case.
fn same_name<'a>(name: &str, names: &'a [String]) -> Option<&'a str> {
    let exactly = names.iter().find(|candidate| *candidate == name);
    let folded = name.to_lowercase();
    exactly.or_else(|| names.iter().find(|candidate| candidate.to_lowercase() == folded)).map(String::as_str)
}

fn sorted(names: impl Iterator<Item = String>) -> Vec<String> {
    let mut names: Vec<_> = names.collect();
    names.sort();
    names.dedup();
    names
}

/// The names of the TOML files below a folder, with / between folders on every system.
fn names_in(folder: &Path) -> Vec<String> {
    let mut names = Vec::new();
    let mut open = vec![(folder.to_owned(), String::new())];
    while let Some((folder, prefix)) = open.pop() {
        let Ok(entries) = std::fs::read_dir(&folder) else { continue };
        for path in entries.flatten().map(|entry| entry.path()) {
            let Some(file) = path.file_name().and_then(|name| name.to_str()) else { continue };
            // A link to a folder above would never end.
            if path.is_dir() && !path.is_symlink() {
                open.push((path.clone(), format!("{prefix}{file}/")));
            } else if let Some(stem) = file.strip_suffix(".toml") {
                names.push(format!("{prefix}{stem}"));
            }
        }
    }
    names
}

fn embedded_names(root: &Dir) -> Vec<String> {
    let mut names = Vec::new();
    let mut open = vec![root];
    while let Some(dir) = open.pop() {
        open.extend(dir.dirs());
        names.extend(dir.files().filter_map(|file| {
            let path = file.path().strip_prefix(root.path()).ok()?;
            let parts: Vec<_> = path.iter().filter_map(|part| part.to_str()).collect();
            parts.join("/").strip_suffix(".toml").map(str::to_owned)
        }));
    }
    names
}
