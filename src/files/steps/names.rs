//! Names of predictions that tell at which step of a training they were written.

use std::fmt;
use std::path::Path;

use super::read::Label;

/// What a training run counts. Where a name has several numbers, the first of these counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Counter {
    Step,
    Iteration,
    Checkpoint,
    Epoch,
}

/// The words before a number. Each stands before the words that it begins with.
const WORDS: [(&str, Counter); 6] = [
    ("step", Counter::Step),
    ("iteration", Counter::Iteration),
    ("iter", Counter::Iteration),
    ("checkpoint", Counter::Checkpoint),
    ("ckpt", Counter::Checkpoint),
    ("epoch", Counter::Epoch),
];

/// Characters between the words of a name.
const SEPARATORS: [char; 5] = ['_', '-', '=', ' ', '.'];

impl fmt::Display for Counter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Step => "step",
            Self::Iteration => "iteration",
            Self::Checkpoint => "checkpoint",
            Self::Epoch => "epoch",
        })
    }
}

/// A name with the number of a step.
#[derive(Debug)]
pub(super) struct Counted {
    /// The name without the number; the name of the folder where nothing else is left.
    pub run_name: String,
    pub counter: Counter,
    pub number: u64,
    /// Whether it is the name of one map of the step.
    pub is_map: bool,
    /// Where the last number of the name ends, in bytes.
    pub end: usize,
}

impl Counted {
    /// `stem` is the name of a file in `folder` without its extension, a folder in it, or a prefix.
    pub(super) fn of(stem: &str, folder: &Path) -> Option<Self> {
        let found = numbers(stem);
        let (&(begin, ..), &(_, end, ..)) = (found.first()?, found.last()?);
        let &(_, _, counter, number) = found.iter().min_by_key(|(_, _, counter, _)| *counter)?;
        let [before, after] = [&stem[..begin], &stem[end..]].map(|part| part.trim_matches(SEPARATORS));
        let names_map = |part: &str| Label::of(part).is_some_and(|label| label.stem.is_empty());
        if names_map(before) {
            // The maps of a step are not found by a common prefix.
            return None;
        }
        let is_map = names_map(after);
        let parts = [before, if is_map { "" } else { after }];
        let rest = parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join("_");
        let run_name = if rest.is_empty() { folder_name(folder) } else { rest };
        Some(Self { run_name, counter, number, is_map, end })
    }
}

fn folder_name(folder: &Path) -> String {
    let absolute = std::path::absolute(folder).unwrap_or_else(|_| folder.to_owned());
    let last = absolute.components().next_back();
    last.map_or(String::new(), |part| part.as_os_str().to_string_lossy().into_owned())
}

/// The counted numbers of a name: where each begins and ends, and what is counted.
fn numbers(stem: &str) -> Vec<(usize, usize, Counter, u64)> {
    let lower = stem.to_ascii_lowercase();
    let is_letter = |c: char| c.is_alphabetic();
    let mut found = Vec::new();
    let mut from = 0;
    while let Some((begin, word, counter)) = next_word(&lower, from) {
        let after_word = begin + word.len();
        let digits =
            after_word + lower[after_word..].len() - lower[after_word..].trim_start_matches(SEPARATORS).len();
        let end =
            lower[digits..].find(|c: char| !c.is_ascii_digit()).map_or(lower.len(), |count| digits + count);
        let borders =
            !lower[..begin].ends_with(is_letter) && !lower[end..].starts_with(char::is_alphanumeric);
        if borders && let Ok(number) = lower[digits..end].parse() {
            found.push((begin, end, counter, number));
        }
        from = after_word;
    }
    found
}

/// The first word that stands before a number, from `from` on: where it begins.
fn next_word(lower: &str, from: usize) -> Option<(usize, &'static str, Counter)> {
    let places =
        WORDS.iter().filter_map(|&(word, counter)| Some((from + lower[from..].find(word)?, word, counter)));
    // Of words that begin at one place, the longest.
    places.min_by_key(|(begin, word, _)| (*begin, usize::MAX - word.len()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn counted(stem: &str) -> Option<(String, String, bool)> {
        let counted = Counted::of(stem, Path::new("/runs/exp1"))?;
        Some((counted.run_name, format!("{} {}", counted.counter, counted.number), counted.is_map))
    }

    #[test]
    fn names_of_steps() {
        for (name, run, step) in [
            ("wood_step000100", "wood", "step 100"),
            ("wood-step-7", "wood", "step 7"),
            ("wood.iter100", "wood", "iteration 100"),
            ("Wood_Iteration_20", "Wood", "iteration 20"),
            ("epoch12", "exp1", "epoch 12"),
            ("my net_epoch012_pred", "my net_pred", "epoch 12"),
            ("epoch=3-step=1200", "exp1", "step 1200"),
            ("ckpt_000500", "exp1", "checkpoint 500"),
            ("step0", "exp1", "step 0"),
            ("footstep_a_step5", "footstep_a", "step 5"),
            ("bäume_step5", "bäume", "step 5"),
        ] {
            assert_eq!(counted(name), Some((run.to_owned(), step.to_owned(), false)), "{name}");
        }
        let two = Counted::of("wood_epoch3_step1200_normal", Path::new("x")).unwrap();
        assert_eq!((two.run_name.as_str(), two.number, two.is_map), ("wood", 1200, true));
        assert_eq!(two.end, "wood_epoch3_step1200".len());
        let here = std::env::current_dir().unwrap();
        let here = here.file_name().unwrap().to_string_lossy().into_owned();
        assert_eq!(Counted::of("step1", Path::new(".")).unwrap().run_name, here);
        for name in [
            "wood",
            "wood_100",
            "footstep100",
            "wood_step",
            "step_size",
            "wood_step10k",
            "stepper3",
            "äepoch3",
            "iter99999999999999999999",
            "normal_step100",
        ] {
            assert_eq!(counted(name), None, "{name}");
        }
        for map in ["normal", "D", "roughness"] {
            let name = format!("wood_step000100_{map}");
            assert_eq!(counted(&name), Some(("wood".to_owned(), "step 100".to_owned(), true)), "{name}");
        }
    }
}
