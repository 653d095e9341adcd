//! The ground truths as witnesses of how the predictions of a method are read: once for the method, not file by file.
//!
//! A decision is a convention that all files of a method follow: the encoding of its colours, the direction of y in its normals, whether
//! its roughness is glossiness, and which part of the ground truths they are. A free parameter is never fitted.

mod colours;
mod group;
mod scalars;

use std::collections::BTreeMap;
use std::path::Path;

use svbrdf_core::material::Material;
use svbrdf_core::parallel;
use svbrdf_core::progress::Progress;
use svbrdf_files::read::{self, Read, ReadOptions};

use super::reading::DatasetReading;
use super::record::Case;
use crate::error::Error;
use crate::protocols::MaskSource;
use crate::registration;
use group::{Group, Sampled};

/// The most materials that are looked at, spread over the data set.
const MATERIALS: usize = 24;
/// The fewest materials that decide.
const FEWEST: usize = 3;

/// How the ground truths and each method are read, where `reading` leaves it open: decided by the materials beside each other.
///
/// What is specified stays. Where `reading` is strict, nothing is decided here. A material that cannot be read is passed over.
///
/// # Errors
/// [`Cancelled`](Error::is_cancelled).
pub fn decided(
    cases: &[Case],
    reading: DatasetReading,
    progress: &Progress,
) -> Result<DatasetReading, Error> {
    if reading.strict {
        return Ok(reading);
    }
    let step = cases.len().div_ceil(MATERIALS).max(1);
    let looked_at: Vec<&Case> = cases.iter().step_by(step).collect();
    let materials = parallel::try_map(looked_at.len(), |index| {
        if progress.is_cancelled() {
            return Err(Error::from(svbrdf_core::error::Error::Cancelled));
        }
        Ok(Beside::of(looked_at[index], &reading))
    })?;
    let mut methods: Vec<&str> = materials.iter().flat_map(|one| one.predictions.keys().copied()).collect();
    methods.sort_unstable();
    methods.dedup();
    let mut decided = reading;
    let mut groups = Vec::new();
    for method in methods {
        let pairs: Vec<_> = materials.iter().filter_map(|one| one.pair(method)).collect();
        let found = register(&mut decided, method, &pairs);
        groups.push((method, sampled(&pairs, found)));
    }
    decide(&mut decided, &groups);
    Ok(decided)
}

/// A ground truth that was read, with the mask that is asked for, and the first prediction of each method.
struct Beside<'a> {
    truth: Option<Read<f32>>,
    predictions: BTreeMap<&'a str, Read<f32>>,
}

type PairRead<'a> = [&'a Read<f32>; 2];

impl<'a> Beside<'a> {
    fn of(case: &'a Case, reading: &DatasetReading) -> Self {
        let read = |path: &Path, options: &ReadOptions| {
            // A pipe can be read once.
            let is_stream = path.metadata().is_ok_and(|found| !found.is_file() && !found.is_dir());
            (!is_stream).then(|| read::read::<f32>(path, options, &Progress::default()).ok()).flatten()
        };
        let first = case.candidates.iter().filter(|one| one.sample == 0 && one.missing.is_none());
        let of = |one: &'a super::CandidateFile| {
            Some((one.method.as_str(), read(&one.path, reading.of_method(&one.method))?))
        };
        let masked = |mut truth: Read<f32>| {
            let mask = |mask: &MaskSource| mask.of(&case.material, &truth).ok();
            truth.mask = reading.mask.as_ref().and_then(mask);
            truth
        };
        Self {
            truth: read(&case.ground_truth, &reading.ground_truths).map(masked),
            predictions: first.filter_map(of).collect(),
        }
    }

    fn pair(&self, method: &str) -> Option<PairRead<'_>> {
        Some([self.truth.as_ref()?, self.predictions.get(method)?])
    }
}

/// Finds how the predictions of a method of other sizes lie on their ground truths; `None` where they have one size, or do not.
fn register(
    decided: &mut DatasetReading,
    method: &str,
    pairs: &[PairRead<'_>],
) -> Option<registration::Registration> {
    let of_pair = |pair: &PairRead<'_>| pair.map(|read| read.material.size());
    if let Some(given) = decided.registrations.get(method) {
        return Some(*given);
    }
    let differ: Vec<[&Material<f32>; 2]> = pairs
        .iter()
        .filter(|pair| of_pair(pair)[0] != of_pair(pair)[1])
        .map(|pair| pair.map(|read| &read.material))
        .collect();
    let found = registration::common(&differ, &decided.ways).filter(|_| 2 * differ.len() > pairs.len())?;
    decided.registrations.insert(method.to_owned(), found.registration);
    let [of_truth, of_prediction] = differ[0].map(Material::size);
    decided.decisions.push(format!(
        "{method}: {} of ground truths of {} x {} to predictions of {} x {}: the maps of {} materials correlate by {:.2}",
        found.registration, of_truth[0], of_truth[1], of_prediction[0], of_prediction[1], differ.len(), found.correlation
    ));
    Some(found.registration)
}

/// Texels of the pairs that can be compared.
fn sampled(pairs: &[PairRead<'_>], found: Option<registration::Registration>) -> Vec<[Sampled; 2]> {
    let of = |pair: &PairRead<'_>| {
        let materials = pair.map(|read| &read.material);
        let (mut mask, size) = (pair[0].mask.clone(), materials[1].size());
        let [truth, prediction] = match found {
            Some(registration) if materials[0].size() != size => {
                mask = mask.and_then(|mask| registration.of_mask(&mask, size));
                registration.applied(materials).ok()?
            }
            _ => materials.map(Clone::clone),
        };
        let [truth, prediction] = match mask.map(|mask| mask.texels()) {
            Some(kept) if truth.size() == prediction.size() => {
                [truth, prediction].map(|one| one.gathered(&kept, [kept.len(), 1]))
            }
            _ => [truth, prediction],
        };
        (truth.size() == prediction.size())
            .then(|| [Sampled::of(&truth, pair[0]), Sampled::of(&prediction, pair[1])])
    };
    pairs.iter().filter_map(of).collect()
}

/// Decides the readings of the ground truths and of all methods.
fn decide(decided: &mut DatasetReading, groups: &[(&str, Vec<[Sampled; 2]>)]) {
    let whole: Vec<Group<'_>> = groups
        .iter()
        .filter(|(_, pairs)| pairs.len() >= FEWEST)
        .map(|(method, pairs)| Group { method, pairs })
        .collect();
    for role in colours::ROLES {
        colours::decide(decided, &whole, role);
    }
    for group in &whole {
        scalars::normal_y(decided, group);
        scalars::roughness(decided, group);
    }
}

impl DatasetReading {
    /// The options of a method, to specify something that it leaves open.
    fn options_mut(&mut self, method: &str) -> &mut ReadOptions {
        let common = self.predictions;
        self.methods.entry(method.to_owned()).or_insert(common)
    }
}
