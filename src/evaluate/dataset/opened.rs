//! A ground truth and a prediction that were read, registered and masked.

use std::path::Path;

use svbrdf_core::loss::check_same_size;
use svbrdf_core::material::{Mask, Material};
use svbrdf_core::progress::Progress;
use svbrdf_files::read::{self, Read, ReadOptions};

use super::reading::DatasetReading;
use super::record::{CandidateFile, Case};
use super::remark::Remark;
use crate::diagnose::Storage;

/// A ground truth and a prediction of one size.
pub(super) type OpenedPair<'a> = (&'a OpenedMaterial, &'a OpenedMaterial);

/// A material that was opened, or why it cannot be used.
pub(super) struct Opened {
    pub(super) found: Result<OpenedMaterial, String>,
    /// The part of the ground truth that a prediction of another size is compared with.
    pub(super) truth: Option<OpenedMaterial>,
    /// Which texels a mask keeps.
    pub(super) kept: Option<Mask>,
    pub(super) remarks: Vec<Remark>,
}

/// A material that was read, and how it is stored.
pub(super) struct OpenedMaterial {
    pub(super) material: Material<f32>,
    /// Of a ground truth, where one is asked for.
    mask: Option<Mask>,
    pub(super) storage: Storage,
}

impl Opened {
    fn failed(problem: String) -> Self {
        Self { found: Err(problem), truth: None, kept: None, remarks: Vec::new() }
    }

    /// Reads a ground truth.
    pub(super) fn ground_truth(case: &Case, reading: &DatasetReading) -> Self {
        let mask = |read: &Read<f32>| {
            let mask = reading.mask.as_ref().map(|mask| mask.of(&case.material, read));
            mask.transpose().map_err(|problem| problem.to_string())
        };
        open(&case.ground_truth, &reading.ground_truths, reading.roughness[0], reading.strict, mask)
    }

    /// A prediction of the size of the ground truth, or why there is none.
    pub(super) fn beside(candidate: &CandidateFile, truth: &Self, reading: &DatasetReading) -> Self {
        let truth = match (&truth.found, &candidate.missing) {
            (Err(problem), _) => return Self::failed(format!("ground truth: {problem}")),
            (_, Some(problem)) => return Self::failed(problem.clone()),
            (Ok(truth), None) => truth,
        };
        let options = reading.of_method(&candidate.method);
        let opened = open(&candidate.path, options, reading.roughness[1], reading.strict, |_| Ok(None));
        let (mut part, mut kept) = (None, truth.mask.clone());
        let found = opened.found.and_then(|found| {
            let pair = [&truth.material, &found.material];
            let registration = reading.registrations.get(&candidate.method);
            let Some(registration) = registration.filter(|_| pair[0].size() != pair[1].size()) else {
                check_same_size(pair[0], pair[1]).map_err(|problem| problem.to_string())?;
                return Ok(found);
            };
            let applied = registration.applied(pair);
            let [of_truth, material] = applied.map_err(|problem| problem.to_string())?;
            if let Some(mask) = &truth.mask {
                kept = registration.of_mask(mask, pair[1].size());
                kept.as_ref().ok_or("the mask keeps no texel of this part of the ground truth")?;
            }
            let storage = truth.storage.clone();
            part = Some(OpenedMaterial { material: of_truth, mask: None, storage });
            Ok(OpenedMaterial { material, ..found })
        });
        Self { found, truth: part, kept, ..opened }
    }
}

/// What a figure has of a material.
#[derive(Clone, Debug)]
pub struct CaseMaterials {
    /// The ground truth, or the part of it that the first prediction of another size is compared with; then the predictions, of its size.
    pub materials: Vec<Result<Material<f32>, String>>,
    pub mask: Option<Mask>,
}

/// Reads the ground truth of a material and these predictions, brought to one size as `reading` decides.
pub fn materials_of(
    case: &Case,
    candidates: &[Option<&CandidateFile>],
    reading: &DatasetReading,
) -> CaseMaterials {
    let truth = Opened::ground_truth(case, reading);
    let all: Vec<Option<(&CandidateFile, Opened)>> =
        candidates.iter().map(|one| one.map(|one| (one, Opened::beside(one, &truth, reading)))).collect();
    let first = all.iter().flatten().find(|(_, opened)| opened.truth.is_some());
    let part = first.and_then(|(one, opened)| {
        let way = reading.registrations.get(&one.method)?;
        Some((*way, opened.found.as_ref().ok()?.material.clone()))
    });
    let mask = first.and_then(|(_, opened)| opened.kept.clone());
    let whole = truth.found.map(|whole| (whole.material, whole.mask));
    let (whole, mask) = match (whole, &part) {
        (Ok((whole, own)), None) => (Ok(whole), own),
        (Ok((whole, _)), Some((way, sample))) => {
            (way.applied([&whole, sample]).map(|[part, _]| part).map_err(|problem| problem.to_string()), mask)
        }
        (Err(problem), _) => (Err(problem), None),
    };
    let size = whole.as_ref().map(Material::size).unwrap_or_default();
    let prediction = |one: Option<(&CandidateFile, Opened)>| {
        let material = one.ok_or("no prediction")?.1.found?.material;
        let material = match &part {
            Some((way, sample)) if material.size() != size => way
                .applied([&material, sample])
                .map(|[part, _]| part)
                .map_err(|problem| problem.to_string())?,
            _ => material,
        };
        let is_of_size = material.size() == size;
        if is_of_size { Ok(material) } else { Err("it is of another part of the ground truth".to_owned()) }
    };
    let predictions: Vec<_> = all.into_iter().map(prediction).collect();
    CaseMaterials { materials: std::iter::once(whole).chain(predictions).collect(), mask }
}

/// Reads a material.
fn open(
    path: &Path,
    options: &ReadOptions,
    roughness: Option<[f64; 2]>,
    strict: bool,
    mask: impl FnOnce(&Read<f32>) -> Result<Option<Mask>, String>,
) -> Opened {
    let read = match read::read::<f32>(path, options, &Progress::default()) {
        Ok(read) => read,
        Err(problem) => return Opened::failed(problem.to_string()),
    };
    let guesses = if strict { read.refuse_guesses(path) } else { Ok(()) };
    let (remarks, storage, mask) = (Remark::of(&read), read.storage(), mask(&read));
    let material = match roughness {
        Some(change) => read.material.with_roughness(change),
        None => read.material,
    };
    let found = guesses.map_err(|problem| problem.to_string()).and(mask);
    let found = found.map(|mask| OpenedMaterial { material, mask, storage });
    Opened { found, truth: None, kept: None, remarks }
}
