//! Options of reading in words: `KEY=VALUE`, with the keys and values of sidecar files.

use std::str::FromStr;

use serde_json::{Map, Value};

use svbrdf_core::error::Error as CoreError;

use super::{
    Albedo, Energy, NonFinite, NormalEncoding, NormalY, Order, Preset, ReadOptions, Roughness, Workflow,
};
use crate::error::Error;

impl ReadOptions {
    /// The keys, in alphabetical order.
    pub fn keys() -> Vec<String> {
        Self::AUTO.object().into_iter().map(|(key, _)| key).collect()
    }

    /// `KEY=VALUE` for every value of the options that have few.
    pub fn examples() -> Vec<String> {
        fn of<T: ToString>(key: &str, all: impl IntoIterator<Item = T>) -> Vec<String> {
            all.into_iter().map(|value| format!("{key}={}", value.to_string())).collect()
        }
        [
            of("albedo", Albedo::ALL),
            of("specular-albedo", Albedo::ALL),
            of("normal-y", NormalY::ALL),
            of("normal-encoding", NormalEncoding::ALL),
            of("roughness", Roughness::ALL),
            of("workflow", Workflow::ALL),
            of("energy", Energy::ALL),
            of("order", Order::ALL),
            of("flip-v", [true, false]),
            of("non-finite", NonFinite::ALL),
            of("preset", Preset::ALL),
        ]
        .concat()
    }

    /// The specified options as `KEY=VALUE`, in the order of [`ReadOptions::keys`], with commas between them.
    pub fn words(&self) -> String {
        let words = self.object().into_iter().filter_map(|(key, value)| match value {
            Value::Null => None,
            Value::String(text) => Some(format!("{key}={text}")),
            other => Some(format!("{key}={other}")),
        });
        words.collect::<Vec<_>>().join(",")
    }

    /// These options and `others`.
    ///
    /// # Errors
    /// [`Error::SpecifiedTwice`] where both specify an option.
    pub fn and(self, others: Self) -> Result<Self, Error> {
        let mut all = self.object();
        for (key, value) in others.object().into_iter().filter(|(_, value)| !value.is_null()) {
            if all.get(&key).is_some_and(|value| !value.is_null()) {
                return Err(Error::SpecifiedTwice { option: key });
            }
            all.insert(key, value);
        }
        serde_json::from_value(all.into()).map_err(|error| Error::Internal(error.to_string()))
    }

    /// Every option by its key; null where it is not specified.
    pub(crate) fn object(&self) -> Map<String, Value> {
        match serde_json::to_value(self) {
            Ok(Value::Object(all)) => all,
            _ => Map::new(),
        }
    }
}

impl FromStr for ReadOptions {
    type Err = Error;

    /// Options as [`ReadOptions::words`] writes them: `albedo=srgb,normal-y=down`.
    fn from_str(text: &str) -> Result<Self, Error> {
        text.split(',').try_fold(Self::AUTO, |options, word| {
            let Some((key, value)) = word.split_once('=') else {
                let (found, known) = (word.to_owned(), "KEY=VALUE, such as albedo=srgb".to_owned());
                return Err(CoreError::unknown_name("option of reading", found, known).into());
            };
            options.and(Self::of_word(key.trim(), value.trim())?)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every option with all of its values, or some where there are many.
    fn values() -> Vec<(&'static str, Vec<String>)> {
        fn of<T: ToString>(all: impl IntoIterator<Item = T>) -> Vec<String> {
            all.into_iter().map(|value| value.to_string()).collect()
        }
        vec![
            ("preset", of(Preset::ALL)),
            ("albedo", of(Albedo::ALL)),
            ("specular-albedo", of(Albedo::ALL)),
            ("normal-y", of(NormalY::ALL)),
            ("normal-encoding", of(NormalEncoding::ALL)),
            ("roughness", of(Roughness::ALL)),
            ("workflow", of(Workflow::ALL)),
            ("dielectric-f0", of(["0.0", "0.04", "0.3333333333333333", "1.0"])),
            ("energy", of(Energy::ALL)),
            ("order", of(Order::ALL)),
            ("grid", of(["1x1", "4x1", "64x64"])),
            ("exemplar", of([0, 7])),
            ("flip-v", of([true, false])),
            ("non-finite", of(NonFinite::ALL)),
        ]
    }

    #[test]
    fn options_in_words_are_read_as_they_were() {
        let values = values();
        let mut keys: Vec<_> = values.iter().map(|(key, _)| (*key).to_owned()).collect();
        keys.sort();
        assert_eq!(keys, ReadOptions::keys(), "every key is tested");
        for seed in 0..2000_usize {
            // Each option is left out or has one of its values, all in combinations that do not repeat early.
            let pick = |(place, (key, all)): (usize, &(&str, Vec<String>))| {
                let choice = (seed * (2 * place + 3) + seed / (place + 1)) % (all.len() + 1);
                all.get(choice).map(|value| format!("{key}={value}"))
            };
            let mut words: Vec<String> = values.iter().enumerate().filter_map(pick).collect();
            words.sort();
            let text = words.join(",");
            if !text.is_empty() {
                assert_eq!(text.parse::<ReadOptions>().unwrap().words(), text);
            }
        }
    }
}
