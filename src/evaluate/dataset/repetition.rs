//! The command that repeats a ranking of a data set, and digests of its files, by which anyone can tell whether theirs are the same.

use std::ffi::OsString;

use svbrdf_core::text::{line, quoted};

use svbrdf_files::read::{MaterialPath, ReadOptions};

use super::pick::Pick;
use super::reading::DatasetReading;
use super::record::{Case, DatasetSettings, Method, Source};
use crate::error::Error;
use crate::protocols::Protocol;
use std::collections::BTreeMap;
use svbrdf_core::parallel;
use svbrdf_core::progress::Progress;

/// The command line that makes the same results, quoted for a shell. Options that have their defaults are left out.
pub(super) fn command(settings: &DatasetSettings, reading: &DatasetReading, pick: Pick) -> String {
    let DatasetSettings { source, convention, scenes, seed, protocol, diagnose, .. } = settings;
    let metrics = settings.metrics.as_ref().filter(|_| protocol.is_none());
    let mut words: Vec<OsString> = vec!["svbrdf".into(), "rank".into()];
    match source {
        Source::Folders { ground_truths, methods } => {
            words.extend([OsString::from("--dataset"), ground_truths.into()]);
            words.extend(methods.iter().map(method));
        }
        Source::Predictions { ground_truth, predictions } => {
            words.push(ground_truth.into());
            words.extend(predictions.iter().map(method));
        }
        Source::Table(path) => words.extend([OsString::from("--pairs"), path.into()]),
    }
    let options = [
        ("--convention", convention.argument(), "printed"),
        (
            "--target-error",
            scenes.target().map_or("1%".into(), |target| format!("{}%", 100.0 * target)),
            "1%",
        ),
        ("--seed", seed.to_string(), "0"),
        ("--pick", pick.to_string(), "fixed"),
    ];
    let is_of_protocol = |name: &str| protocol.is_some() && name == "--convention";
    let specified =
        options.into_iter().filter(|(name, value, default)| value != default && !is_of_protocol(name));
    words.extend(specified.flat_map(|(name, value, _)| [OsString::from(name), value.into()]));
    words.extend(scenes.options.iter().filter(|_| scenes.target().is_none()).map(OsString::from));
    words.extend(protocol.iter().flat_map(|one| [OsString::from("--protocol"), one.argument().into()]));
    words.extend(metrics.map(|metrics| match Vec::from(metrics.clone()) {
        words if words.is_empty() => "--metrics".into(),
        words => OsString::from(format!("--metrics={}", words.join(","))),
    }));
    let switches = [("--diagnose", *diagnose), ("--common", settings.common), ("--strict", reading.strict)];
    words.extend(switches.into_iter().filter(|(_, is)| *is).map(|(name, _)| OsString::from(name)));
    let of_protocol = protocol.as_ref().and_then(|protocol| protocol.mask.as_ref());
    let mask = reading.mask.as_ref().filter(|mask| Some(*mask) != of_protocol);
    words.extend(mask.map(|mask| OsString::from(format!("--mask={mask}"))));
    words.extend(read_options(reading, protocol.as_ref()).into_iter().map(OsString::from));
    words.iter().map(quoted).collect::<Vec<_>>().join(" ")
}

/// The path of a method, with its name where that is another one than the path has.
fn method(method: &Method) -> OsString {
    let own = method.path.file_name().unwrap_or_default().to_string_lossy();
    let name = if line(&own) == method.name { String::new() } else { format!("{}=", method.name) };
    let mut word = OsString::from(name);
    word.push(&method.path);
    word
}

/// `--read gt:KEY=VALUE,...` for the ground truths, the predictions and the methods that are read by options, and `--register` for those of
/// another size. What the protocol states is left out.
fn read_options(reading: &DatasetReading, protocol: Option<&Protocol>) -> Vec<String> {
    let DatasetReading { ground_truths, predictions, methods, .. } = reading;
    let [of_truths, of_predictions] = protocol
        .map_or([ReadOptions::AUTO; 2], |protocol| [protocol.ground_truths.read, protocol.predictions.read]);
    let of_methods = methods.iter().map(|(name, options)| (name.as_str(), options, of_predictions));
    let all = [("gt", ground_truths, of_truths), ("pred", predictions, of_predictions)];
    let all = all.into_iter().chain(of_methods).filter(|(_, options, stated)| *options != stated);
    let read = all.map(|(name, options, _)| (name, options.words())).filter(|(_, words)| !words.is_empty());
    let read = read.flat_map(|(name, words)| ["--read".to_owned(), format!("{name}:{words}")]);
    let ways = reading.registrations.iter();
    read.chain(ways.flat_map(|(name, way)| ["--register".to_owned(), format!("{name}:{way}")])).collect()
}

/// Hexadecimal digits of a digest.
const DIGITS: usize = 16;

/// The beginning of the SHA-256 of the files of each material, by `ground truth, wood` and `ours, wood`. A material that cannot be located has
/// none.
///
/// # Errors
/// [`Cancelled`](Error::is_cancelled).
pub fn digests(cases: &[Case], progress: &Progress) -> Result<BTreeMap<String, String>, Error> {
    let of = |index: usize| {
        if progress.is_cancelled() {
            return Err(Error::from(svbrdf_core::error::Error::Cancelled));
        }
        let case = &cases[index];
        let truth = ("ground truth".to_owned(), &case.ground_truth);
        let predictions = case.candidates.iter().map(|one| match one.sample {
            0 => (one.method.clone(), &one.path),
            sample => (format!("{} {sample}", one.method), &one.path),
        });
        let digest = |(whose, path): (String, &std::path::PathBuf)| {
            let found = MaterialPath::new(path, &ReadOptions::AUTO).dependencies().ok()?;
            Some((format!("{whose}, {}", case.material), found.sha256.get(..DIGITS)?.to_owned()))
        };
        Ok::<_, Error>([truth].into_iter().chain(predictions).filter_map(digest).collect::<Vec<_>>())
    };
    Ok(parallel::try_map(cases.len(), of)?.into_iter().flatten().collect())
}
