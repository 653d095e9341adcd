//! The labels of the figure in other languages than English: labels.json, by language and English text.

use std::collections::BTreeMap;
use std::str::FromStr;

use svbrdf_core::error::Error;

const ALL: &str = include_str!("labels.json");
const ENGLISH: &str = "en";

/// The labels of the figure in one language; by default in English.
#[derive(Clone, Debug, PartialEq)]
pub struct Labels {
    language: String,
    /// By the English text.
    table: BTreeMap<String, String>,
}

impl Default for Labels {
    fn default() -> Self {
        Self { language: ENGLISH.to_owned(), table: BTreeMap::new() }
    }
}

impl Labels {
    /// The language as HTML names it (BCP 47), such as "de".
    pub(super) fn language(&self) -> &str {
        &self.language
    }

    pub(super) fn table(&self) -> &BTreeMap<String, String> {
        &self.table
    }
}

impl FromStr for Labels {
    type Err = Error;

    /// The labels of a language.
    fn from_str(language: &str) -> Result<Self, Error> {
        if language == ENGLISH {
            return Ok(Self::default());
        }
        let failed = |problem: serde_json::Error| Error::Internal(format!("labels.json: {problem}"));
        let mut all: BTreeMap<String, BTreeMap<String, String>> =
            serde_json::from_str(ALL).map_err(failed)?;
        match all.remove(language) {
            Some(table) => Ok(Self { language: language.to_owned(), table }),
            None => Err(Error::UnknownName {
                what: "language",
                found: language.to_owned(),
                known: [ENGLISH]
                    .into_iter()
                    .chain(all.keys().map(String::as_str))
                    .collect::<Vec<_>>()
                    .join(", "),
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_language_has_the_same_labels() {
        let known = Labels::from_str("none").unwrap_err().to_string();
        assert!(known.contains("en, de, fr"), "{known}");
        let [german, french] = ["de", "fr"].map(|language| language.parse::<Labels>().unwrap());
        assert!(german.table.keys().eq(french.table.keys()));
        assert!(
            german.table.len() > 80
                && german.table.values().chain(french.table.values()).all(|text| !text.is_empty())
        );
        assert_eq!("en".parse::<Labels>().unwrap(), Labels::default());
    }
}
