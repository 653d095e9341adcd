//! Steps of training runs: predictions whose names tell at which step of the training they were written.
//!
//! `wood_step000100.png`, `wood_step000200/` and the files `wood_iter300_normal.png`, `wood_iter300_diffuse.png` and so on are
//! steps of the run `wood`. Where the name has nothing else, as in `epoch_12.exr`, the run has the name of the folder.

mod names;

use std::fs;
use std::path::{Path, PathBuf};

use crate::disk::stamp::Stamp;
use crate::error::Error;
use crate::read::EXTENSIONS;
use names::Counted;
pub use names::Counter;

/// What identifies a training run.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct RunId {
    /// The folder in which its steps are, or which holds the folder of its steps.
    pub folder: PathBuf,
    pub name: String,
    pub counter: Counter,
}

/// A prediction that was written at a step of a training.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TrainingStep {
    pub number: u64,
    /// A file, a folder, or the prefix of files.
    pub path: PathBuf,
    pub stamp: Stamp,
}

/// A training run: one prediction in its steps.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TrainingRun {
    pub id: RunId,
    /// By their numbers, the newest last; at least one.
    pub steps: Vec<TrainingStep>,
}

/// A file or folder by its name.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Listed {
    name: String,
    is_folder: bool,
    stamp: Stamp,
}

/// A name of a step, taken apart.
#[derive(Debug)]
struct NamedStep {
    run: RunId,
    number: u64,
    /// Whether it is the name of one map of the step, which is then the prefix `path`.
    is_map: bool,
    path: PathBuf,
}

impl NamedStep {
    /// `name` is a file, a folder or a prefix in `folder`.
    fn of(folder: &Path, name: &str) -> Option<Self> {
        let stem = without_extension(name).unwrap_or(name);
        let Counted { run_name, counter, number, is_map, end } = Counted::of(stem, folder)?;
        let run = RunId { folder: folder.to_owned(), name: run_name, counter };
        let path = folder.join(if is_map { &stem[..end] } else { name });
        Some(Self { run, number, is_map, path })
    }
}

impl RunId {
    /// The run that the file, folder or prefix `path` is a step of, and the number of the step.
    pub fn of_step(path: &Path) -> Option<(Self, u64)> {
        let name = path.file_name()?.to_str()?;
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        NamedStep::of(folder, name).map(|named| (named.run, named.number))
    }

    /// A step of it, in words.
    pub fn step_name(&self, number: u64) -> String {
        format!("{}, {} {number}", self.name, self.counter)
    }
}

/// The training runs whose steps are in `folder`; without any, those in the folders in it. None in a folder that is itself a
/// material, or anything else.
///
/// # Errors
/// [`Error::Unreadable`].
pub fn runs_in(folder: &Path) -> Result<Vec<TrainingRun>, Error> {
    let listed = list(folder).map_err(|source| Error::unreadable(folder, source))?;
    let runs = grouped(folder, &listed);
    if !runs.is_empty() {
        return Ok(runs);
    }
    let mut runs = Vec::new();
    for inner in listed.iter().filter(|entry| entry.is_folder) {
        let path = folder.join(&inner.name);
        // What cannot be listed, or has been removed meanwhile, is no run.
        let Ok(listed) = list(&path) else { continue };
        let named = |run: TrainingRun| {
            let name = if run.id.name == inner.name {
                run.id.name
            } else {
                format!("{}/{}", inner.name, run.id.name)
            };
            TrainingRun { id: RunId { folder: folder.to_owned(), name, counter: run.id.counter }, ..run }
        };
        runs.extend(grouped(&path, &listed).into_iter().map(named));
    }
    Ok(runs)
}

/// What is in a folder and not hidden, sorted by name. Only names of steps have stamps.
fn list(folder: &Path) -> std::io::Result<Vec<Listed>> {
    let mut all = Vec::new();
    for entry in fs::read_dir(folder)?.flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        let Ok(metadata) = fs::metadata(entry.path()) else { continue };
        if name.starts_with('.') {
            continue;
        }
        let is_folder = metadata.is_dir();
        let stamp = match is_folder {
            false => Stamp::of_file(&metadata),
            true if NamedStep::of(folder, &name).is_some() => Stamp::of(&entry.path()).unwrap_or_default(),
            true => Stamp::default(),
        };
        all.push(Listed { name, is_folder, stamp });
    }
    all.sort_by(|a, b| a.name.cmp(&b.name));
    Ok(all)
}

/// The runs whose steps are among `listed`, which are in `folder`.
///
/// Under one number a folder comes first, whose preview a picture beside it may be, then a picture, then a set of maps.
fn grouped(folder: &Path, listed: &[Listed]) -> Vec<TrainingRun> {
    let opens = |entry: &&Listed| entry.is_folder || without_extension(&entry.name).is_some();
    let named = |entry: &Listed| {
        let NamedStep { run, number, is_map, path } = NamedStep::of(folder, &entry.name)?;
        let order = (run, number, !entry.is_folder, is_map);
        Some((order, TrainingStep { number, path, stamp: entry.stamp }))
    };
    let mut all: Vec<_> = listed.iter().filter(opens).filter_map(named).collect();
    all.sort_by(|(a, step), (b, other)| (a, &step.path).cmp(&(b, &other.path)));
    all.dedup_by(|((next_run, next_number, ..), next), ((run, number, _, is_map), step)| {
        let is_same = next_run == run && next_number == number;
        if is_same && *is_map && next.path == step.path {
            // Another map of the same set.
            step.stamp = step.stamp.with(next.stamp);
        }
        is_same
    });
    let mut runs: Vec<TrainingRun> = Vec::new();
    for ((id, ..), step) in all {
        match runs.last_mut().filter(|run| run.id == id) {
            Some(run) => run.steps.push(step),
            None => runs.push(TrainingRun { id, steps: vec![step] }),
        }
    }
    runs
}

/// The name of a file that opens as a material, or as a map of one, without its extension.
fn without_extension(name: &str) -> Option<&str> {
    let (stem, extension) = name.rsplit_once('.')?;
    let extension = extension.to_lowercase();
    (extension != "json" && EXTENSIONS.contains(&extension.as_str())).then_some(stem)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn listed(names: &[&str]) -> Vec<Listed> {
        let one = |name: &&str| Listed {
            name: name.trim_end_matches('/').to_owned(),
            is_folder: name.ends_with('/'),
            stamp: Stamp { files: 1, bytes: name.len() as u64, modified: None },
        };
        names.iter().map(one).collect()
    }

    /// The runs as `name counter: file number, ...`.
    fn described(names: &[&str]) -> Vec<String> {
        let one = |run: TrainingRun| {
            let file = |step: &TrainingStep| {
                format!("{} {}", step.number, step.path.file_name().unwrap().to_string_lossy())
            };
            let steps: Vec<_> = run.steps.iter().map(file).collect();
            format!("{} {}: {}", run.id.name, run.id.counter, steps.join(", "))
        };
        grouped(Path::new("/runs/exp1"), &listed(names)).into_iter().map(one).collect()
    }

    #[test]
    fn steps_of_one_name_are_one_run_in_the_order_of_their_numbers() {
        let files = [
            "a_step10.png",
            "a_step9.png",
            "b_step000100/",
            "b_step000020/",
            "gt.png",
            "notes_step3.txt",
            "a_step7.json",
        ];
        assert_eq!(
            described(&files),
            ["a step: 9 a_step9.png, 10 a_step10.png", "b step: 20 b_step000020, 100 b_step000100"]
        );
        assert_eq!(described(&["A_STEP3.PNG"]), ["A step: 3 A_STEP3.PNG"]);
        assert_eq!(described(&["epoch_1.exr", "epoch_2.exr"]), ["exp1 epoch: 1 epoch_1.exr, 2 epoch_2.exr"]);
        assert_eq!(
            described(&["a_step1.png", "a_epoch1.png"]),
            ["a step: 1 a_step1.png", "a epoch: 1 a_epoch1.png"]
        );
        assert_eq!(described(&["normal.png", "diffuse.png", "roughness.png"]), [""; 0]);
        assert_eq!(described(&["normal_step1.png", "diffuse_step1.png"]), [""; 0]);
    }

    #[test]
    fn the_maps_of_a_step_are_one_prefix_and_a_folder_wins_over_its_preview() {
        let files = ["a_step1_diffuse.png", "a_step1_normal.png", "a_step2_normal.png"];
        assert_eq!(described(&files), ["a step: 1 a_step1, 2 a_step2"]);
        let runs = grouped(Path::new("x"), &listed(&files));
        let expected = Stamp { files: 2, bytes: 37, modified: None };
        assert_eq!(runs[0].steps[0].stamp, expected);
        assert_eq!(described(&["a_step1.png", "a_step1/"]), ["a step: 1 a_step1"]);
        assert_eq!(described(&["a_step1/", "a_step1.png"]), ["a step: 1 a_step1"]);
        let with_maps = ["a_step1.png", "a_step1_normal.png", "a_step1-diffuse.png"];
        assert_eq!(described(&with_maps), ["a step: 1 a_step1.png"]);
        let runs = grouped(Path::new("x"), &listed(&["a_step1/", "a_step1_normal.png"]));
        assert_eq!(runs[0].steps[0].stamp.files, 1, "of the folder alone");
    }

    #[test]
    fn a_path_names_its_run() {
        let (id, number) = RunId::of_step(Path::new("out/wood_step000100.png")).unwrap();
        assert_eq!((id.name.as_str(), id.folder.as_path(), number), ("wood", Path::new("out"), 100));
        assert_eq!(id.step_name(number), "wood, step 100");
        let (id, _) = RunId::of_step(Path::new("/runs/exp1/epoch_3")).unwrap();
        assert_eq!(id.name, "exp1");
        let (id, _) = RunId::of_step(Path::new("wood_step1_normal.png")).unwrap();
        assert_eq!((id.name.as_str(), id.folder.as_path()), ("wood", Path::new(".")));
        assert_eq!(RunId::of_step(Path::new("out/wood.png")), None);
    }

    #[test]
    fn runs_in_a_folder_or_in_the_folders_of_it() {
        let folder = tempfile::tempdir().unwrap();
        let write = |name: &str| {
            let path = folder.path().join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, "x").unwrap();
        };
        let files = [
            "l1/step_1.png",
            "l1/step_2.png",
            "l1/.half_step_3.png",
            "rend/pred_step_1/maps.png",
            "other/a.png",
        ];
        files.into_iter().for_each(write);
        let names = |folder: &Path| -> Vec<(String, usize)> {
            let runs = runs_in(folder).unwrap();
            assert!(runs.iter().all(|run| run.id.folder == folder));
            runs.into_iter().map(|run| (run.id.name, run.steps.len())).collect()
        };
        assert_eq!(names(folder.path()), [("l1".to_owned(), 2), ("rend/pred".to_owned(), 1)]);
        assert_eq!(names(&folder.path().join("l1")), [("l1".to_owned(), 2)]);
        assert_eq!(names(&folder.path().join("other")), []);
        let [step] = runs_in(&folder.path().join("rend")).unwrap()[0].steps.clone().try_into().unwrap();
        assert_eq!((step.stamp.files, step.stamp.bytes), (1, 1));
        assert!(runs_in(&folder.path().join("none")).is_err());
        write("own_step_7.png");
        assert_eq!(names(folder.path()), [("own".to_owned(), 1)], "runs in the folder itself come first");
    }
}
