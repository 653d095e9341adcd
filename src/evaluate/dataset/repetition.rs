//! The command that repeats a ranking of a data set.

use std::ffi::OsString;

use svbrdf_core::text::{line, quoted};

use super::pick::Pick;
use super::record::{DatasetReading, DatasetSettings, Method, Source};

/// The command line that makes the same results, quoted for a shell. Options that have their defaults are left out.
pub(super) fn command(settings: &DatasetSettings, reading: &DatasetReading, pick: Pick) -> String {
    let DatasetSettings { source, convention, target_error, scenes, seed, metrics, diagnose, .. } = settings;
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
        ("--target-error", target_error.map_or("1%".into(), |target| format!("{}%", 100.0 * target)), "1%"),
        ("--seed", seed.to_string(), "0"),
        ("--pick", pick.to_string(), "fixed"),
    ];
    let specified = options.into_iter().filter(|(_, value, default)| value != default);
    words.extend(specified.flat_map(|(name, value, _)| [OsString::from(name), value.into()]));
    words.extend(scenes.iter().flat_map(|scenes| scenes.options.iter().map(OsString::from)));
    let switches = [
        ("--metrics", *metrics),
        ("--diagnose", *diagnose),
        ("--strict", reading.strict),
        ("--mask=alpha", reading.mask),
    ];
    words.extend(switches.into_iter().filter(|(_, is)| *is).map(|(name, _)| OsString::from(name)));
    words.extend(read_options(reading).into_iter().map(OsString::from));
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
/// another size.
fn read_options(reading: &DatasetReading) -> Vec<String> {
    let DatasetReading { ground_truths, predictions, methods, .. } = reading;
    let of_methods = methods.iter().map(|(name, options)| (name.as_str(), options));
    let all = [("gt", ground_truths), ("pred", predictions)].into_iter().chain(of_methods);
    let read = all.map(|(name, options)| (name, options.words())).filter(|(_, words)| !words.is_empty());
    let read = read.flat_map(|(name, words)| ["--read".to_owned(), format!("{name}:{words}")]);
    let ways = reading.registrations.iter();
    read.chain(ways.flat_map(|(name, way)| ["--register".to_owned(), format!("{name}:{way}")])).collect()
}
