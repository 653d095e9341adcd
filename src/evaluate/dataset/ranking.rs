//! The ranking of methods over the materials that they have in common: means, medians, intervals and paired differences.

use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};

use svbrdf_core::statistics::median;

use super::bootstrap::{FEWEST, interval_of_mean, interval_of_positive_mean};
use super::pick::{Pick, counted_loss};
use super::record::{DatasetReading, DatasetSettings, KnownLoss, MaterialResult};

/// The 97.5% quantile of the normal distribution.
const Z: f64 = 1.959_964;

/// The results of a data set, and what they say about the methods.
#[derive(Clone, Debug)]
pub struct DatasetReport {
    pub settings: DatasetSettings,
    pub reading: DatasetReading,
    pub pick: Pick,
    pub ranking: Ranking,
    pub results: Vec<MaterialResult>,
}

impl DatasetReport {
    /// The report of `results`; of several predictions of a material, `pick` says which counts.
    pub fn new(
        settings: DatasetSettings,
        reading: DatasetReading,
        results: Vec<MaterialResult>,
        pick: Pick,
    ) -> Self {
        let ranking = Ranking::new(&settings.methods, &results, pick);
        Self { settings, reading, pick, ranking, results }
    }
}

/// The methods over a data set, and the materials that they are compared over.
///
/// Means of different materials cannot be compared. So those methods are compared that have a loss of the most materials, over the
/// materials that all of them have; every other method lacks materials, stands below and is never the best.
#[derive(Clone, Debug, PartialEq)]
pub struct Ranking {
    /// The compared ones first, smallest mean loss first; then those that lack materials, the most materials first.
    pub methods: Vec<MethodSummary>,
    /// The indices of the materials that the means of compared methods are over.
    pub common: BTreeSet<usize>,
}

/// The losses of a method.
#[derive(Clone, Debug, PartialEq)]
pub struct MethodSummary {
    pub method: String,
    /// Whether it is compared with the best method: it has as many materials as any other.
    pub is_compared: bool,
    /// The number of materials with a loss.
    pub materials: usize,
    /// The number of materials without one.
    pub failures: usize,
    /// Over the materials that all compared methods have; of a method that is not compared, over those that it has a loss of.
    pub mean: f64,
    /// Over the materials of the mean.
    pub median: f64,
    /// The 95% interval of the mean over all materials like these; `None` for fewer than [`FEWEST`](super::FEWEST).
    pub interval95_materials: Option<[f64; 2]>,
    /// The 95% interval of the mean over these materials, due to the sampling of scenes alone.
    pub interval95_scenes: [f64; 2],
    /// The mean of this method - the best one over the materials of both, with its interval over materials; `None` for the
    /// best, and where nothing is compared.
    pub to_best: Option<MethodDifference>,
}

/// A paired difference of two methods.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MethodDifference {
    pub mean: f64,
    pub interval95_materials: Option<[f64; 2]>,
}

impl MethodSummary {
    /// Whether the materials cannot separate the method from the best one, which it is compared with: tables set it in bold.
    pub fn ties_with_best(&self) -> bool {
        let is_worse =
            |difference: MethodDifference| difference.interval95_materials.is_some_and(|[low, _]| low > 0.0);
        self.is_compared && !self.to_best.is_some_and(is_worse)
    }

    /// The number of materials with a loss, and of how many where it lacks some.
    pub fn count(&self) -> String {
        match self.failures {
            0 => self.materials.to_string(),
            failures => format!("{} of {}", self.materials, self.materials + failures),
        }
    }
}

impl Ranking {
    /// The ranking of `methods`; of several predictions of a material, `pick` says which counts.
    pub fn new(methods: &[String], results: &[MaterialResult], pick: Pick) -> Self {
        let mut known = losses(results, pick);
        let losses: Vec<(&str, Losses)> = methods
            .iter()
            .map(|method| (method.as_str(), known.remove(method.as_str()).unwrap_or_default()))
            .collect();
        let most = losses.iter().map(|(_, losses)| losses.len()).max().unwrap_or(0);
        let common = common(losses.iter().map(|(_, losses)| losses).filter(|losses| losses.len() == most));
        let summary = |(method, losses): &(&str, Losses)| {
            let is_compared = losses.len() == most && !common.is_empty();
            let summary = summary(method, losses, is_compared.then_some(&common));
            MethodSummary { is_compared, failures: results.len() - losses.len(), ..summary }
        };
        let mut ranked: Vec<(MethodSummary, &Losses)> =
            losses.iter().map(|all| (summary(all), &all.1)).collect();
        ranked.sort_by(|(a, _), (b, _)| order(a, b));
        let best = ranked.first().filter(|(best, _)| best.is_compared).map(|(_, losses)| *losses);
        let with_difference = |(place, (summary, losses)): (usize, (MethodSummary, &Losses))| {
            let common = summary.is_compared.then_some(&common);
            let to_best = best.filter(|_| place > 0).and_then(|best| difference(losses, best, common));
            MethodSummary { to_best, ..summary }
        };
        Self { methods: ranked.into_iter().enumerate().map(with_difference).collect(), common }
    }

    /// The best method, where methods are compared.
    pub fn best(&self) -> Option<&MethodSummary> {
        self.methods.first().filter(|summary| summary.is_compared)
    }

    /// The results that the numbers of `summary` are over.
    pub fn results_of<'a>(
        &self,
        summary: &MethodSummary,
        results: &'a [MaterialResult],
    ) -> Vec<&'a MaterialResult> {
        let counts = |result: &&MaterialResult| !summary.is_compared || self.common.contains(&result.index);
        results.iter().filter(counts).collect()
    }

    /// The materials that the means are over, of `all` of a data set, and the methods that lack some: lines below a table.
    pub fn over(&self, all: usize) -> Vec<String> {
        let compared = self.methods.iter().filter(|summary| summary.is_compared).count();
        let common = self.common.len();
        let mut lines = vec![match compared {
            0 => "no material has a loss of every method: nothing is compared".to_owned(),
            1 => format!("means over {}", of_all(common, all)),
            _ => format!("means over {} that all {compared} compared methods have", of_all(common, all)),
        }];
        let lacking = self.methods.iter().filter(|summary| compared > 0 && !summary.is_compared);
        lines.extend(lacking.map(|summary| {
            let MethodSummary { method, .. } = summary;
            format!(
                "{method} has {} materials: not compared, its mean is over other materials",
                summary.count()
            )
        }));
        let has_intervals = |summary: &MethodSummary| summary.interval95_materials.is_some();
        if !self.methods.iter().any(has_intervals) {
            lines.push(format!("intervals over materials and significance need {FEWEST} materials"));
        }
        lines
    }
}

/// `the 7 materials`, or `5 of 7 materials`.
fn of_all(count: usize, all: usize) -> String {
    if count == all { format!("the {all} materials") } else { format!("the {count} of {all} materials") }
}

/// The compared methods by their means; then the others, which have means of other materials, by the number of these.
fn order(a: &MethodSummary, b: &MethodSummary) -> Ordering {
    let by_count = if a.is_compared { Ordering::Equal } else { b.materials.cmp(&a.materials) };
    b.is_compared.cmp(&a.is_compared).then(by_count).then(a.mean.total_cmp(&b.mean))
}

/// The losses of a method by the index of the material.
type Losses = BTreeMap<usize, KnownLoss>;

/// The losses of each method: of those that there are, since a table may have as many methods as materials.
fn losses(results: &[MaterialResult], pick: Pick) -> BTreeMap<&str, Losses> {
    let mut all: BTreeMap<&str, Losses> = BTreeMap::new();
    for result in results {
        let methods: BTreeSet<&str> = result.predictions.iter().map(|one| one.method.as_str()).collect();
        for method in methods {
            if let Some(known) = counted_loss(result, method, pick) {
                all.entry(method).or_default().insert(result.index, known);
            }
        }
    }
    all
}

/// The materials that all have.
fn common<'a>(all: impl Iterator<Item = &'a Losses>) -> BTreeSet<usize> {
    let indices = all.map(|losses| losses.keys().copied().collect::<BTreeSet<usize>>());
    indices.reduce(|common, other| &common & &other).unwrap_or_default()
}

/// The numbers of a method over the materials `common`, or over all that it has a loss of.
fn summary(method: &str, losses: &Losses, common: Option<&BTreeSet<usize>>) -> MethodSummary {
    let counts = |index: &usize| common.is_none_or(|common| common.contains(index));
    let known = losses.iter().filter(|(index, _)| counts(index)).map(|(_, known)| known);
    let mut values: Vec<f64> = known.clone().map(|known| known.loss).collect();
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let reach = Z * known.map(|known| known.standard_error.powi(2)).sum::<f64>().sqrt() / count;
    MethodSummary {
        method: method.to_owned(),
        is_compared: false,
        materials: losses.len(),
        failures: 0,
        mean,
        interval95_materials: interval_of_positive_mean(&values),
        median: median(&mut values).unwrap_or(f64::NAN),
        interval95_scenes: around(mean, reach),
        to_best: None,
    }
}

/// mean - reach and mean + reach to first order, on the logarithm: no loss is below 0.
fn around(mean: f64, reach: f64) -> [f64; 2] {
    if reach == 0.0 { [mean; 2] } else { [-reach, reach].map(|reach| mean * (reach / mean).exp()) }
}

/// The paired difference over the materials of both; `None` where they have none in common.
fn difference(losses: &Losses, best: &Losses, common: Option<&BTreeSet<usize>>) -> Option<MethodDifference> {
    let counts = |index: &usize| common.is_none_or(|common| common.contains(index));
    let paired = losses.iter().filter(|(index, _)| counts(index));
    let paired = paired.filter_map(|(index, known)| Some(known.loss - best.get(index)?.loss));
    let differences: Vec<f64> = paired.collect();
    let mean = differences.iter().sum::<f64>() / differences.len() as f64;
    let interval95_materials = interval_of_mean(&differences);
    (!differences.is_empty()).then_some(MethodDifference { mean, interval95_materials })
}
