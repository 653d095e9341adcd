//! Source of a material: its origin, and how it is read.

use std::path::{Path, PathBuf};

use svbrdf_files::read::ReadOptions;
use svbrdf_files::source::{MaterialSource, Place};
use svbrdf_files::steps::RunId;

/// Where a material came from.
#[derive(Clone, Debug, PartialEq)]
pub enum Origin {
    /// The built-in material of this number, 0 for the ground truth.
    BuiltIn(usize),
    Path(PathBuf),
}

/// Where a material comes from and how it is read: what it takes to open it again.
#[derive(Clone, Debug, PartialEq)]
pub struct Source {
    /// The name that it is given; `None` for that of its files.
    pub name: Option<String>,
    pub origin: Origin,
    /// The options specified; the sidecar file completes them.
    pub specified: ReadOptions,
    /// The options chosen since, which alone count.
    pub chosen: Option<ReadOptions>,
    /// Whether it is resized to the ground truth.
    pub fit: bool,
    /// The training run that it is a step of, where all steps of the run are at hand. The folder of the run in place of the path of a
    /// step is the newest step.
    pub run: Option<RunId>,
}

impl Source {
    /// The built-in material of this number, 0 for the ground truth.
    pub fn built_in(number: usize) -> Self {
        Self {
            name: None,
            origin: Origin::BuiltIn(number),
            specified: ReadOptions::AUTO,
            chosen: None,
            fit: false,
            run: None,
        }
    }

    /// The source in a set of materials, which has a training run and not one of its steps.
    pub fn of_set(&self) -> Self {
        let whole = self.run.as_ref().map(|run| Origin::Path(run.folder.clone()));
        Self { origin: whole.unwrap_or_else(|| self.origin.clone()), ..self.clone() }
    }

    /// The name of its material, which was read from `path`; `None` for that of its files.
    pub fn material_name(&self, path: &Path) -> Option<String> {
        let (Some(run), Some((_, number))) = (&self.run, RunId::of_step(path)) else {
            return self.name.clone();
        };
        let name = self.name.as_ref().unwrap_or(&run.name).clone();
        Some(RunId { name, ..run.clone() }.step_name(number))
    }

    /// The name that it is given, or the last part of its path.
    pub fn label(&self) -> String {
        if let Some(name) = &self.name {
            return name.clone();
        }
        match &self.origin {
            Origin::BuiltIn(_) => "built-in material".to_owned(),
            Origin::Path(path) => file_name(path),
        }
    }
}

impl From<MaterialSource> for Source {
    fn from(MaterialSource { name, place, options, fit, .. }: MaterialSource) -> Self {
        let origin = match place {
            Place::Path(path) => Origin::Path(path),
            Place::BuiltIn(number) => Origin::BuiltIn(number),
        };
        Self { name, origin, specified: options, chosen: None, fit, run: None }
    }
}

/// A source for each material. Several steps of one training run, of which none has a name, are that run.
pub fn sources(materials: Vec<MaterialSource>) -> Vec<Source> {
    let run = |material: &MaterialSource| match material.name {
        Some(_) => None,
        None => Some(RunId::of_step(material.location())?.0),
    };
    let runs: Vec<Option<RunId>> = materials.iter().map(run).collect();
    let mut sources = Vec::new();
    for (index, (material, run)) in materials.into_iter().zip(&runs).enumerate() {
        let is_same = |other: &&Option<RunId>| run.is_some() && *other == run;
        let source = Source::from(material);
        match run {
            Some(_) if runs[..index].iter().any(|other| is_same(&other)) => {}
            Some(run) if runs.iter().filter(is_same).count() > 1 => {
                let origin = Origin::Path(run.folder.clone());
                sources.push(Source { origin, run: Some(run.clone()), ..source });
            }
            _ => sources.push(source),
        }
    }
    sources
}

/// The last part of a path, as text.
pub fn file_name(path: &Path) -> String {
    path.file_name().map_or_else(|| path.display().to_string(), |n| n.to_string_lossy().into_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn several_steps_of_one_run_are_one_source() {
        let paths =
            ["x/a_step1.png", "b.png", "x/a_step3.png", "x/c_step3.png", "y/a_step2.png"].map(PathBuf::from);
        let all = sources(paths.into_iter().map(MaterialSource::from).collect());
        let found: Vec<_> =
            all.iter().map(|s| (s.origin.clone(), s.run.as_ref().map(|r| r.name.as_str()))).collect();
        let path = |path: &str| Origin::Path(path.into());
        let expected = [
            (path("x"), Some("a")),
            (path("b.png"), None),
            (path("x/c_step3.png"), None),
            (path("y/a_step2.png"), None),
        ];
        assert_eq!(found, expected);
    }
}
