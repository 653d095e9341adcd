//! The command that repeats a ranking of a data set.

use svbrdf_core::text::{line, quoted};

use super::pick::Pick;
use super::record::{DatasetReading, DatasetSettings, Method, Source};

/// The command line that makes the same results, quoted for a shell. Options that have their defaults are left out.
pub(super) fn command(settings: &DatasetSettings, reading: &DatasetReading, pick: Pick) -> String {
    let DatasetSettings { source, convention, target_error, scenes, seed, metrics, diagnose, .. } = settings;
    let mut words = vec!["svbrdf".to_owned(), "rank".to_owned()];
    match source {
        Source::Folders { ground_truths, methods } => {
            words.extend(["--dataset".to_owned(), ground_truths.display().to_string()]);
            words.extend(methods.iter().map(method));
        }
        Source::Predictions { ground_truth, predictions } => {
            words.push(ground_truth.display().to_string());
            words.extend(predictions.iter().map(method));
        }
        Source::Table(path) => words.extend(["--pairs".to_owned(), path.display().to_string()]),
    }
    let options = [
        ("--convention", convention.argument(), "printed"),
        ("--target-error", target_error.map_or("1%".into(), |target| format!("{}%", 100.0 * target)), "1%"),
        ("--seed", seed.to_string(), "0"),
        ("--pick", pick.to_string(), "fixed"),
    ];
    let specified = options.into_iter().filter(|(_, value, default)| value != default);
    words.extend(specified.flat_map(|(name, value, _)| [name.to_owned(), value]));
    words.extend(scenes.iter().flat_map(|scenes| scenes.options.clone()));
    let switches = [("--metrics", *metrics), ("--diagnose", *diagnose), ("--strict", reading.strict)];
    words.extend(switches.into_iter().filter(|(_, is)| *is).map(|(name, _)| name.to_owned()));
    words.extend(read_options(reading));
    words.iter().map(|word| quoted(word)).collect::<Vec<_>>().join(" ")
}

/// The path of a method, with its name where that is another one than the path has.
fn method(method: &Method) -> String {
    let path = method.path.display().to_string();
    let own = method.path.file_name().unwrap_or_default().to_string_lossy();
    if line(&own) == method.name { path } else { format!("{}={path}", method.name) }
}

/// `--read gt:KEY=VALUE,...` for the ground truths, the predictions and the methods that are read by options.
fn read_options(reading: &DatasetReading) -> Vec<String> {
    let DatasetReading { ground_truths, predictions, methods, .. } = reading;
    let of_methods = methods.iter().map(|(name, options)| (name.as_str(), options));
    let all = [("gt", ground_truths), ("pred", predictions)].into_iter().chain(of_methods);
    all.map(|(name, options)| (name, options.words()))
        .filter(|(_, words)| !words.is_empty())
        .flat_map(|(name, words)| ["--read".to_owned(), format!("{name}:{words}")])
        .collect()
}
