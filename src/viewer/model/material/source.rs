//! Sources of materials: their labels, and the training runs among them.

use std::path::Path;

use svbrdf_files::source::{MaterialSource, Place};
use svbrdf_files::steps::RunId;

/// The name that it is given, or the last part of its path.
pub fn label(source: &MaterialSource) -> String {
    match (&source.name, &source.place) {
        (Some(name), _) => name.clone(),
        (None, Place::BuiltIn(_)) => "built-in material".to_owned(),
        (None, Place::Path(path)) => file_name(path),
    }
}

/// A source for each material. Several steps of one training run, of which none has a name, are that run.
pub fn sources(materials: Vec<MaterialSource>) -> Vec<MaterialSource> {
    let run = |material: &MaterialSource| match material.name {
        Some(_) => None,
        None => Some(RunId::of_step(material.location())?.0),
    };
    let runs: Vec<Option<RunId>> = materials.iter().map(run).collect();
    let mut sources = Vec::new();
    for (index, (material, run)) in materials.into_iter().zip(&runs).enumerate() {
        let is_same = |other: &&Option<RunId>| run.is_some() && *other == run;
        match run {
            Some(_) if runs[..index].iter().any(|other| is_same(&other)) => {}
            Some(run) if runs.iter().filter(is_same).count() > 1 => {
                let place = Place::Path(run.folder.clone());
                sources.push(MaterialSource { place, run: Some(run.clone()), ..material });
            }
            _ => sources.push(material),
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
    use std::path::PathBuf;

    use super::*;

    #[test]
    fn several_steps_of_one_run_are_one_source() {
        let paths =
            ["x/a_step1.png", "b.png", "x/a_step3.png", "x/c_step3.png", "y/a_step2.png"].map(PathBuf::from);
        let all = sources(paths.into_iter().map(MaterialSource::from).collect());
        let found: Vec<_> =
            all.iter().map(|s| (s.place.clone(), s.run.as_ref().map(|r| r.name.as_str()))).collect();
        let path = |path: &str| Place::Path(path.into());
        let expected = [
            (path("x"), Some("a")),
            (path("b.png"), None),
            (path("x/c_step3.png"), None),
            (path("y/a_step2.png"), None),
        ];
        assert_eq!(found, expected);
    }
}
