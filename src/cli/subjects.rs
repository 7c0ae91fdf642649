//! Materials and models that a command is about, without a scene: by name, and with other data sets in the place of theirs.

use super::scene_file::{LibraryArgs, pair};
use super::show;
use crate::fresnel::{FresnelModel, UnknownModel};
use crate::scene::{Optics, SceneError, class_of, optics};
use crate::spectrum::Library;
use clap::Args;

#[derive(Debug, Args)]
pub struct DataArgs {
    /// Another data set for a material, such as gold=Au/johnson-christy-1972; can be repeated
    #[arg(long, value_name = "MATERIAL=DATASET", value_parser = pair)]
    ior: Vec<(String, String)>,
    #[command(flatten)]
    library: LibraryArgs,
}

impl DataArgs {
    pub fn open(&self) -> Result<Library, SceneError> {
        self.library.open()
    }

    /// What is known of each of these materials: each once, for whoever says gold and Au means one.
    pub fn named(&self, names: &[String], library: &Library) -> Result<Vec<Optics>, SceneError> {
        let mut found: Vec<Optics> = Vec::new();
        for name in names {
            let optics = optics(name, None, library)?;
            if found.iter().all(|other| other.name != optics.name) {
                found.push(optics);
            }
        }
        self.replace(&mut found, library)?;
        for (optics, note) in
            found.iter().flat_map(|optics| optics.ior.about.notes.iter().map(move |note| (optics, note)))
        {
            show::warning(format_args!("`{}`: {note}", optics.ior.about.name));
        }
        Ok(found)
    }

    /// Puts the data sets of the command line in the place of those that materials stand on.
    pub fn replace(&self, found: &mut [Optics], library: &Library) -> Result<(), SceneError> {
        let mut done: Vec<String> = Vec::new();
        for (name, data) in &self.ior {
            let replaced = optics(name, Some(data), library)?;
            if done.contains(&replaced.name) {
                return Err(SceneError::new(format!("--ior names `{}` twice", replaced.name)));
            }
            done.push(replaced.name.clone());
            if replaced.class != class_of(&replaced.ior) {
                let kind = replaced.class.name();
                show::warning(format_args!(
                    "--ior {name}={data}: `{name}` is taken for a {kind}, which these data are not"
                ));
            }
            match found.iter_mut().find(|optics| optics.name == replaced.name) {
                Some(place) => *place = replaced,
                None => {
                    let names: Vec<_> = found.iter().map(|optics| optics.name.as_str()).collect();
                    return Err(SceneError::new(format!(
                        "--ior {name}={data}: `{}` is not among the materials ({})",
                        replaced.name,
                        some(&names)
                    )));
                }
            }
        }
        Ok(())
    }
}

/// Four names, or three and the number of the others.
pub fn some(names: &[&str]) -> String {
    match names {
        [first, second, third, _, _, ..] => format!("{first}, {second}, {third} and {} more", names.len() - 3),
        _ => names.join(", "),
    }
}

/// Which models are asked for.
#[derive(Clone, Debug, PartialEq)]
pub enum Models {
    /// Those that apply.
    All,
    /// Each once.
    Listed(Vec<FresnelModel>),
}

impl std::str::FromStr for Models {
    type Err = UnknownModel;
    fn from_str(text: &str) -> Result<Self, UnknownModel> {
        if text.trim() == "all" {
            return Ok(Self::All);
        }
        let mut listed: Vec<FresnelModel> = Vec::new();
        for name in text.split(',') {
            let model = name.trim().parse()?;
            if !listed.contains(&model) {
                listed.push(model);
            }
        }
        Ok(Self::Listed(listed))
    }
}
