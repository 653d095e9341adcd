//! The ranking of methods over the materials that they have in common: means, medians, intervals and paired differences.

use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};

use svbrdf_core::statistics::median;

use super::bootstrap::{interval_of_mean, interval_of_mean_within, may_be_0};
use super::pick::{Pick, counted_loss};
use super::record::{KnownLoss, MaterialResult};
use super::summary::MethodSummary;

/// The 97.5% quantile of the normal distribution.
const Z: f64 = 1.959_964;

/// The numbers of `methods` without their readings, metrics and marks, and the indices of the materials that compared methods are
/// compared over. The compared ones come first, smallest mean loss first; then those that lack materials, the most materials first.
///
/// Means of different materials cannot be compared. So those methods are compared that have a loss of the most materials, over the
/// materials that all of them have; every other method lacks materials, stands below and is never the best. Of several predictions of a
/// material, `pick` says which counts. Where `all` are asked for, every method with a loss is compared, over the materials that all have.
pub(super) fn ranked(
    methods: &[String],
    results: &[MaterialResult],
    pick: Pick,
    all: bool,
) -> (Vec<MethodSummary>, BTreeSet<usize>) {
    let mut known = losses(results, pick);
    let losses: Vec<(&str, Losses)> = methods
        .iter()
        .map(|method| (method.as_str(), known.remove(method.as_str()).unwrap_or_default()))
        .collect();
    let most = losses.iter().map(|(_, losses)| losses.len()).max().unwrap_or(0);
    let is_compared = |losses: &Losses| losses.len() == most || (all && !losses.is_empty());
    let common = common(losses.iter().map(|(_, losses)| losses).filter(|losses| is_compared(losses)));
    let summary = |(method, losses): &(&str, Losses)| {
        let compared = is_compared(losses) && !common.is_empty();
        let summary = summary(method, losses, compared.then_some(&common));
        MethodSummary { compared, failures: results.len() - losses.len(), ..summary }
    };
    let mut ranked: Vec<(MethodSummary, &Losses)> = losses.iter().map(|all| (summary(all), &all.1)).collect();
    ranked.sort_by(|(a, _), (b, _)| order(a, b));
    let best = ranked.first().filter(|(best, _)| best.compared).map(|(_, losses)| *losses);
    let with_difference = |(place, (summary, losses)): (usize, (MethodSummary, &Losses))| {
        let common = summary.compared.then_some(&common);
        let differences = best.filter(|_| place > 0).and_then(|best| differences(losses, best, common));
        let interval = differences.as_deref().and_then(interval_of_mean);
        let signs = |all: &Vec<f64>| [all.iter().filter(|one| **one > 0.0).count(), all.len()];
        MethodSummary {
            worse_on: differences.as_ref().map(signs),
            ties_with_best: summary.compared && differences.as_deref().is_none_or(may_be_0),
            to_best: differences.map(|all| all.iter().sum::<f64>() / all.len() as f64),
            to_best_interval95_materials: interval,
            ..summary
        }
    };
    (ranked.into_iter().enumerate().map(with_difference).collect(), common)
}

/// The compared methods by their means; then the others, which have means of other materials, by the number of these.
fn order(a: &MethodSummary, b: &MethodSummary) -> Ordering {
    let by_count = if a.compared { Ordering::Equal } else { b.materials.cmp(&a.materials) };
    b.compared.cmp(&a.compared).then(by_count).then(a.mean.total_cmp(&b.mean))
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
        compared: false,
        materials: losses.len(),
        failures: 0,
        mean,
        interval95_materials: interval_of_mean_within(&values, &(0.0..=f64::INFINITY)),
        median: median(&mut values).unwrap_or(f64::NAN),
        interval95_scenes: around(mean, reach),
        to_best: None,
        to_best_interval95_materials: None,
        worse_on: None,
        ties_with_best: false,
        reading: None,
        metrics: BTreeMap::new(),
        marks: None,
    }
}

/// mean - reach and mean + reach to first order, on the logarithm: no loss is below 0.
fn around(mean: f64, reach: f64) -> [f64; 2] {
    if reach == 0.0 { [mean; 2] } else { [-reach, reach].map(|reach| mean * (reach / mean).exp()) }
}

/// The paired differences over the materials of both; `None` where they have none in common.
fn differences(losses: &Losses, best: &Losses, common: Option<&BTreeSet<usize>>) -> Option<Vec<f64>> {
    let counts = |index: &usize| common.is_none_or(|common| common.contains(index));
    let paired = losses.iter().filter(|(index, _)| counts(index));
    let paired: Vec<f64> =
        paired.filter_map(|(index, known)| Some(known.loss - best.get(index)?.loss)).collect();
    (!paired.is_empty()).then_some(paired)
}
