//! A ground truth and a prediction that were read, registered and masked.

use std::path::Path;
use std::sync::Arc;

use svbrdf_core::loss::check_same_size;
use svbrdf_core::material::Material;
use svbrdf_core::progress::Progress;
use svbrdf_files::read::{self, ReadOptions};

use super::reading::DatasetReading;
use super::record::CandidateFile;
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
    pub(super) kept: Option<Arc<[bool]>>,
    pub(super) remarks: Vec<Remark>,
}

/// A material that was read, and how it is stored.
pub(super) struct OpenedMaterial {
    pub(super) material: Material<f32>,
    /// Which texels are opaque.
    mask: Option<Arc<[bool]>>,
    pub(super) storage: Storage,
}

impl Opened {
    fn failed(problem: String) -> Self {
        Self { found: Err(problem), truth: None, kept: None, remarks: Vec::new() }
    }

    /// Reads a ground truth.
    pub(super) fn ground_truth(path: &Path, reading: &DatasetReading) -> Self {
        open(path, &reading.ground_truths, reading.roughness[0], reading.strict)
    }

    /// A prediction of the size of the ground truth, or why there is none.
    pub(super) fn beside(candidate: &CandidateFile, truth: &Self, reading: &DatasetReading) -> Self {
        let truth = match (&truth.found, &candidate.missing) {
            (Err(problem), _) => return Self::failed(format!("ground truth: {problem}")),
            (_, Some(problem)) => return Self::failed(problem.clone()),
            (Ok(truth), None) => truth,
        };
        let options = reading.of_method(&candidate.method);
        let opened = open(&candidate.path, options, reading.roughness[1], reading.strict);
        let (mut part, mut kept) = (None, None);
        let found = opened.found.and_then(|found| {
            let pair = [&truth.material, &found.material];
            let registration = reading.registrations.get(&candidate.method);
            match registration.filter(|_| pair[0].size() != pair[1].size()) {
                Some(_) if reading.mask.is_some() => {
                    Err("a mask is not cut to predictions of another size; leave out --mask".to_owned())
                }
                Some(registration) => {
                    let applied = registration.applied(pair);
                    let [of_truth, material] = applied.map_err(|problem| problem.to_string())?;
                    let storage = truth.storage.clone();
                    part = Some(OpenedMaterial { material: of_truth, mask: None, storage });
                    Ok(OpenedMaterial { material, ..found })
                }
                None => {
                    check_same_size(pair[0], pair[1]).map_err(|problem| problem.to_string())?;
                    kept = reading.mask.map(|_| truth.kept()).transpose()?;
                    Ok(found)
                }
            }
        });
        Self { found, truth: part, kept, ..opened }
    }
}

impl OpenedMaterial {
    /// Which texels its mask keeps, at least one.
    fn kept(&self) -> Result<Arc<[bool]>, String> {
        let [width, height] = self.material.size();
        let mask = self.mask.as_ref().filter(|mask| mask.len() == width * height);
        let mask =
            mask.ok_or("no alpha of the ground truth is a mask, 0 or 1 nearly everywhere; leave out --mask")?;
        if mask.iter().any(|kept| *kept) {
            Ok(Arc::clone(mask))
        } else {
            Err("the mask of the ground truth keeps no texel".to_owned())
        }
    }
}

/// Reads a material.
fn open(path: &Path, options: &ReadOptions, roughness: Option<[f64; 2]>, strict: bool) -> Opened {
    let read = match read::read::<f32>(path, options, &Progress::default()) {
        Ok(read) => read,
        Err(problem) => return Opened::failed(problem.to_string()),
    };
    let guesses = if strict { read.refuse_guesses(path) } else { Ok(()) };
    let (remarks, storage) = (Remark::of(&read), read.storage());
    let material = match roughness {
        Some(change) => read.material.with_roughness(change),
        None => read.material,
    };
    let found = guesses.map(|()| OpenedMaterial { material, mask: read.mask, storage });
    let found = found.map_err(|problem| problem.to_string());
    Opened { found, truth: None, kept: None, remarks }
}
