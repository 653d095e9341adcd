//! Report on the robustness of the order of predictions.

use serde::Serialize;

use svbrdf_core::progress::Progress;

use super::Report;
use super::heading::Compared;
use super::latex::{escaped, latex};
use super::table::{Cell, Field, Reader, Table};
use crate::error::Error;
use crate::robust::{Answered, RobustInput};

/// Whether the order of predictions survives other conventions, epsilons and scenes.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RobustReport {
    #[serde(flatten)]
    compared: Compared,
    /// The materials that scores are means over, with paired intervals over them; none where one ground truth is asked about.
    materials: Vec<String>,
    /// The answer in a sentence.
    sentence: String,
    /// The default one first.
    questions: Vec<AskedQuestion>,
    /// Pairs of predictions that change sides, where both differences are significant.
    changes: Vec<Change>,
}

/// A question, and the order that it gives.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct AskedQuestion {
    question: String,
    /// Kendall's tau to the order by default: 1 where no pair changes sides.
    tau: f64,
    /// The predictions, the best first.
    order: Vec<String>,
}

/// A pair of predictions that changes sides.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct Change {
    question: String,
    first: String,
    second: String,
    /// 95% interval of the score of the first - that of the second, by default.
    default_interval95: [f64; 2],
    /// The same under the question.
    interval95: [f64; 2],
}

impl RobustReport {
    /// Asks all questions.
    ///
    /// # Errors
    /// As [`RobustInput::answers`].
    pub fn new(input: &RobustInput<'_>, progress: &Progress) -> Result<Self, Error> {
        let answers = input.answers(progress)?;
        let names: Vec<&str> = input.predictions.iter().map(|prediction| prediction.name()).collect();
        let compared = Compared::new(input.ground_truth, &input.convention);
        Ok(Self::of_answers(compared, &names, &answers))
    }

    /// The report of answers, the default one first.
    pub fn of_answers(compared: Compared, names: &[&str], answers: &[Answered]) -> Self {
        let default = &answers[0];
        let mut changes = Vec::new();
        for answer in &answers[1..] {
            for (a, first) in names.iter().enumerate() {
                for (b, second) in names.iter().enumerate().skip(a + 1) {
                    let (before, after) = (default.differences[a][b], answer.differences[a][b]);
                    if let (Some(before), Some(after)) = (before, after)
                        && default.sign(a, b) * answer.sign(a, b) < 0
                    {
                        changes.push(Change {
                            question: answer.question.clone(),
                            first: (*first).to_owned(),
                            second: (*second).to_owned(),
                            default_interval95: before,
                            interval95: after,
                        });
                    }
                }
            }
        }
        let question = |answer: &Answered| AskedQuestion {
            question: answer.question.clone(),
            tau: default.tau(answer),
            order: answer.order().into_iter().map(|index| names[index].to_owned()).collect(),
        };
        let sentence = sentence(names, answers, &changes);
        let questions = answers.iter().map(question).collect();
        Self { compared, materials: Vec::new(), sentence, questions, changes }
    }

    /// As it is, of answers that are means over `materials`.
    pub fn over(self, materials: Vec<String>) -> Self {
        Self { materials, ..self }
    }

    /// The answer in a sentence.
    pub fn sentence(&self) -> &str {
        &self.sentence
    }

    /// Each pair of predictions that changes sides, with both intervals.
    pub fn changes(&self) -> impl Iterator<Item = String> {
        self.changes.iter().map(|change| {
            let Change { question, first, second, default_interval95: [a, b], interval95: [c, d] } = change;
            format!("{first} - {second}: {a:.4} to {b:.4} by default, {c:.4} to {d:.4} under {question}")
        })
    }

    /// A table for a paper.
    pub fn latex(&self) -> String {
        let row = |asked: &AskedQuestion| format!("{} & {:.2} \\\\\n", escaped(&asked.question), asked.tau);
        latex("lr", "Question & $\\tau$", &self.questions.iter().map(row).collect::<String>())
    }
}

/// The answer in a sentence.
fn sentence(names: &[&str], answers: &[Answered], changes: &[Change]) -> String {
    let default = &answers[0];
    if let Some(change) = changes.first() {
        let (first, second) = (&change.first, &change.second);
        let of_pair = changes.iter().filter(|other| (&other.first, &other.second) == (first, second));
        let on = of_pair.map(|change| change.question.as_str()).collect::<Vec<_>>().join(", ");
        return format!("The order of {first} and {second} depends on the question: it changes under {on}.");
    }
    let questions = answers.len();
    let [best, second, ..] = default.order()[..] else {
        return format!("No pair changes sides under any of {questions} questions.");
    };
    let under = answers.iter().filter(|answer| answer.sign(best, second) < 0).count();
    let (best, second) = (names[best], names[second]);
    match under {
        0 => format!("No pair changes sides under any of {questions} questions."),
        all if all == questions => format!("{best} beats {second} under all {questions} questions."),
        some => {
            format!("{best} beats {second} under {some} of {questions} questions, and no pair changes sides.")
        }
    }
}

const FIELDS: [Field<AskedQuestion>; 3] = [
    ("question", "question", |row| row.question.as_str().into()),
    ("tau", "tau", |row| Cell::Digits(2, row.tau)),
    ("order", "order", |row| row.order.join(" < ").into()),
];

impl Report for RobustReport {
    fn heading(&self) -> String {
        let changes = self.changes().map(|change| change + "\n");
        let Compared { ground_truth, convention, epsilon, .. } = &self.compared;
        let heading = match self.materials.len() {
            0 => self.compared.heading("order by the rendering loss"),
            count => format!(
                "order by the rendering loss over {count} materials of {ground_truth}\nconvention {convention}, epsilon {epsilon}\n"
            ),
        };
        heading + &format!("{}\n", self.sentence) + &changes.collect::<String>()
    }

    fn table(&self, reader: Reader) -> Table {
        Table::fields(&FIELDS, &self.questions, reader)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use svbrdf_core::material::Material;
    use svbrdf_core::model::brdf::Texel;
    use svbrdf_core::model::convention::PRINTED;

    fn answered(question: &str, scores: [f64; 3], half: f64) -> Answered {
        let row = |a: f64| scores.iter().map(|b| Some([a - b - half, a - b + half])).collect();
        Answered { question: question.to_owned(), scores: scores.into(), differences: scores.map(row).into() }
    }

    fn report(answers: &[Answered]) -> RobustReport {
        let texel = Texel { normal: glam::Vec3::Z, diffuse: [0.5; 3], specular: [0.04; 3], roughness: 0.5 };
        let truth: Material<f32> = Material::uniform("truth", 4, 4, &texel).unwrap();
        RobustReport::of_answers(Compared::new(&truth, &PRINTED), &["a", "b", "c"], answers)
    }

    #[test]
    fn a_pair_that_changes_sides_is_listed_with_both_intervals() {
        let usual = answered("printed", [0.1, 0.2, 0.4], 0.05);
        let found = report(&[usual.clone(), answered("epsilon 0.1", [0.3, 0.1, 0.4], 0.05)]);
        assert_eq!(
            found.sentence,
            "The order of a and b depends on the question: it changes under epsilon 0.1."
        );
        assert_eq!(found.changes.len(), 1);
        assert!((found.questions[1].tau - 1.0 / 3.0).abs() < 1e-12);
        assert_eq!(found.questions[1].order, ["b", "a", "c"]);
    }

    #[test]
    fn a_difference_that_is_not_significant_is_no_change() {
        let usual = answered("printed", [0.1, 0.2, 0.4], 0.05);
        let found = report(&[usual, answered("epsilon 0.1", [0.12, 0.1, 0.4], 0.05)]);
        assert_eq!((found.changes.len(), found.questions[1].tau), (0, 1.0));
        assert_eq!(found.sentence, "a beats b under 1 of 2 questions, and no pair changes sides.");
        let usual = answered("printed", [0.1, 0.2, 0.4], 0.05);
        assert_eq!(report(&[usual.clone(), usual]).sentence, "a beats b under all 2 questions.");
        let none = answered("printed", [0.1, 0.2, 0.4], 0.5);
        assert_eq!(report(&[none]).sentence, "No pair changes sides under any of 1 questions.");
    }
}
