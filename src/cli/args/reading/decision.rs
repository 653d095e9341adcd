//! The decision of the command line on how each material is read.

use svbrdf_evaluate::report::distinct_names;
use svbrdf_files::Error;
use svbrdf_files::read::ReadOptions;
use svbrdf_files::source::MaterialSource;

use super::statement::{Statement, Whose};
use crate::cli::output::CommandError;

/// How the materials of a command are read: what is specified for all, for a side or for a name, once each.
#[derive(Clone, Debug, Default)]
pub struct StatedReading(Vec<Statement>);

impl StatedReading {
    /// What the `statements` specify together.
    pub fn new<'a>(statements: impl IntoIterator<Item = &'a Statement>) -> Result<Self, Error> {
        let mut all: Vec<Statement> = Vec::new();
        for one in statements {
            match all.iter_mut().find(|known| known.whose == one.whose) {
                Some(known) => known.options = known.options.and(one.options)?,
                None => all.push(one.clone()),
            }
        }
        Ok(Self(all))
    }

    /// How the material or method `name` on this side is read: what is specified for its name, then for its side, then for all.
    pub fn options_for(&self, side: Whose, name: &str) -> ReadOptions {
        let of = |whose: Whose| {
            self.0.iter().find(|one| one.whose == whose).map_or(ReadOptions::AUTO, |one| one.options)
        };
        of(Whose::Named(name.to_owned())).over(of(side)).over(of(Whose::All))
    }

    /// The names of materials, as reports print them. Of the names that a material may have once it is read: one for which something is
    /// specified, or else the most likely.
    pub fn names_of(&self, sources: &[MaterialSource]) -> Vec<String> {
        let possible: Vec<_> = sources.iter().map(|source| self.possible_names(source)).collect();
        let choices = possible.iter().map(Vec::len).max().unwrap_or(0);
        let of_choice = |choice: usize| {
            let name =
                |names: &'_ Vec<String>| names.get(choice).or(names.last()).cloned().unwrap_or_default();
            let names: Vec<String> = possible.iter().map(name).collect();
            let named: Vec<_> =
                names.iter().map(String::as_str).zip(sources.iter().map(MaterialSource::location)).collect();
            distinct_names(&named)
        };
        let all: Vec<Vec<String>> = (0..choices).map(of_choice).collect();
        let chosen = |index: usize| {
            let specified =
                all.iter().find(|names| self.0.iter().any(|one| one.whose.is_named(&names[index])));
            specified.or(all.first()).map_or_else(String::new, |names| names[index].clone())
        };
        (0..sources.len()).map(chosen).collect()
    }

    /// Files are looked at only where something is specified for some of the materials.
    fn possible_names(&self, source: &MaterialSource) -> Vec<String> {
        match &source.name {
            None if self.0.iter().any(|one| one.whose != Whose::All) => source.possible_names(),
            name => vec![name.clone().unwrap_or_default()],
        }
    }

    /// Whether something is specified for a material by its name.
    pub fn has_names(&self) -> bool {
        self.0.iter().any(|one| matches!(one.whose, Whose::Named(_)))
    }

    /// Refuses what is specified for materials that do not exist: those on a side without any, and names that no material has. The
    /// ground truth of a data set has no name.
    pub fn check(&self, ground_truth: Option<&str>, predictions: &[String]) -> Result<(), CommandError> {
        let names: Vec<&str> =
            ground_truth.into_iter().chain(predictions.iter().map(String::as_str)).collect();
        let problem = self.0.iter().find_map(|one| problem(one, &names, predictions));
        problem.map_or(Ok(()), |problem| Err(CommandError::Usage(problem)))
    }
}

/// Why a statement is not for exactly the materials that it should be for.
fn problem(statement: &Statement, names: &[&str], predictions: &[String]) -> Option<String> {
    let ambiguous = |word: &str, meaning: &str| {
        format!(
            "{word}: in {statement} is {meaning}, and a material has the name {word}; give it another name, as in \
             other={word}.png"
        )
    };
    match &statement.whose {
        Whose::Predictions if predictions.is_empty() => {
            Some(format!("there is no prediction; leave out {statement}"))
        }
        Whose::GroundTruth if predictions.iter().any(|name| name == "gt") => {
            Some(ambiguous("gt", "the ground truth"))
        }
        Whose::Predictions
            if names.len() > 1 + usize::from(names.len() > predictions.len()) && names.contains(&"pred") =>
        {
            Some(ambiguous("pred", "all predictions"))
        }
        Whose::Named(name) if !names.contains(&name.as_str()) => Some(format!(
            "no material is named {name}, as in {statement}; the names are {}",
            names.join(", ")
        )),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn reading(statements: &[&str]) -> Result<StatedReading, Error> {
        let parsed: Vec<Statement> = statements.iter().map(|text| text.parse().unwrap()).collect();
        StatedReading::new(&parsed)
    }

    #[test]
    fn the_name_counts_before_the_side_and_the_side_before_all() {
        let reading = reading(&[
            "albedo=srgb,roughness=r",
            "pred:albedo=linear",
            "a:b=c:albedo=log0.01",
            "pred:energy=scaled",
        ])
        .unwrap();
        let words = |side, name| reading.options_for(side, name).words();
        assert_eq!(words(Whose::GroundTruth, "gt"), "albedo=srgb,roughness=r");
        assert_eq!(words(Whose::Predictions, "other"), "albedo=linear,energy=scaled,roughness=r");
        assert_eq!(words(Whose::Predictions, "a:b=c"), "albedo=log0.01,energy=scaled,roughness=r");
        let typed: Vec<_> = reading.0.iter().map(ToString::to_string).collect();
        let expected = [
            "--read albedo=srgb,roughness=r",
            "--read pred:albedo=linear,energy=scaled",
            "--read a:b=c:albedo=log0.01",
        ];
        assert_eq!(typed, expected);
    }

    #[test]
    fn statements_for_materials_that_do_not_exist_or_could_be_others_are_refused() {
        let error = reading(&["a:albedo=srgb", "a:albedo=srgb"]).unwrap_err();
        assert_eq!(error.to_string(), "albedo is specified twice; leave out one");
        reading(&["a:albedo=srgb", "b:albedo=srgb", "albedo=srgb"]).unwrap();
        for (statement, ground_truth, predictions, expected) in [
            ("pred:albedo=srgb", "gt", &[][..], "there is no prediction; leave out --read pred:albedo=srgb"),
            ("c:albedo=srgb", "gt", &["a", "b"], "the names are gt, a, b"),
            ("gt:albedo=srgb", "truth", &["gt"], "the ground truth"),
            ("pred:albedo=srgb", "gt", &["pred", "b"], "all predictions"),
            ("gt:albedo=srgb", "gt", &["a"], ""),
            ("pred:albedo=srgb", "gt", &["pred"], ""),
            ("b:albedo=srgb", "gt", &["a", "b"], ""),
            ("truth:albedo=srgb", "truth", &[], ""),
        ] {
            let predictions: Vec<String> = predictions.iter().map(|&name| name.to_owned()).collect();
            let checked = reading(&[statement]).unwrap().check(Some(ground_truth), &predictions);
            let problem = checked.err().map(|error| error.to_string()).unwrap_or_default();
            assert!(
                problem.is_empty() == expected.is_empty() && problem.contains(expected),
                "{statement}: {problem}"
            );
        }
    }
}
