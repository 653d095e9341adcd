//! Answers that a results folder keeps.

use std::path::Path;

use serde_json::{Value, json};
use sha2::{Digest as _, Sha256};

use svbrdf_core::material::{Mask, Material};
use svbrdf_core::progress::Progress;
use svbrdf_files::disk::open::hexadecimal;

use super::{AnyAnalysis, Precise};
use crate::diagnose::Storage;
use crate::error::Error;
use crate::report::{AnalysisInput, Views};
use crate::results::{KeptAnswer, Key, ResultsFolder};

impl AnyAnalysis {
    /// The answer as it is printed: that of the folder `results`, where it has it, or that of [`AnyAnalysis::run`], which is added to it.
    ///
    /// # Errors
    /// As [`AnyAnalysis::run`]; [`Unwritable`](svbrdf_files::Error::Unwritable) and [`Unreadable`](svbrdf_files::Error::Unreadable) of the
    /// folder.
    pub fn kept<T: Precise>(
        &self,
        input: &AnalysisInput<'_, T>,
        options: Value,
        results: &Path,
        progress: &Progress,
    ) -> Result<KeptAnswer<Views>, Error> {
        let folder = ResultsFolder::open(results)?;
        let (name, key) = (input.ground_truth.name(), self.key(input, &options));
        let answer = match folder.load(name, &key) {
            Some(known) => known,
            None => {
                let views = Views::of(&*self.run(input, options, progress)?)?;
                folder.add(name, &key, &views, progress)?;
                views
            }
        };
        let (notes, unkept) = folder.end(progress)?;
        Ok(KeptAnswer { answer, notes, unkept })
    }

    /// All that the answer depends on, with the materials by their content.
    fn key<T: Precise>(&self, input: &AnalysisInput<'_, T>, options: &Value) -> Key {
        let AnalysisInput { ground_truth, predictions, storages, paths, convention, request, .. } = input;
        let material = |(material, storage): (&&Material<T>, &&Storage)| {
            let numbers = material.planes().all().flat_map(|plane| plane.chunks(1 << 12));
            let numbers = numbers.map(|some| some.iter().flat_map(|x| x.f64().to_le_bytes()).collect());
            let storage = format!("{storage:?}");
            json!({"name": material.name(), "size": material.size(), "storage": storage, "sha256": digest(numbers)})
        };
        let materials = std::iter::once(ground_truth).chain(predictions).zip(storages).map(material);
        let bytes = |mask: &Mask| mask.kept().iter().map(|kept| u8::from(*kept)).collect();
        Key::new(json!({
            "format": 1,
            "analysis": self.name,
            "options": options,
            "request": request,
            "few_scenes": input.few_scenes,
            "convention": convention,
            "precision": T::NAME,
            "materials": materials.collect::<Vec<_>>(),
            "paths": paths,
            "mask": input.mask.as_ref().map(|mask| digest([bytes(mask)].into_iter())),
        }))
    }
}

fn digest(parts: impl Iterator<Item = Vec<u8>>) -> String {
    hexadecimal(parts.fold(Sha256::new(), |hash, part| hash.chain_update(part)))
}
