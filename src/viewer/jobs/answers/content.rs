//! Subjects of questions: materials by their content, and pairs of them.

use std::sync::{Arc, Weak};

use svbrdf_core::error::Error as CoreError;
use svbrdf_core::material::Mask;
use svbrdf_core::model::convention::Convention;

use crate::error::Error;
use crate::model::material::loaded::LoadedMaterial;
use crate::model::material::read::{MaterialId, ReadMaterial};
use crate::model::view::ViewState;

/// A material by its content. It does not keep it in memory: an answer may outlive it.
#[derive(Clone, Debug)]
pub struct Content {
    id: MaterialId,
    read: Weak<ReadMaterial>,
}

impl PartialEq for Content {
    fn eq(&self, other: &Self) -> bool {
        self.id == other.id
    }
}

impl Content {
    pub fn of(material: &LoadedMaterial) -> Self {
        Self { id: material.id(), read: Arc::downgrade(&material.read) }
    }

    /// Of these, in their order.
    pub fn all(materials: &[LoadedMaterial]) -> Vec<Self> {
        materials.iter().map(Self::of).collect()
    }

    /// The material, for a worker.
    ///
    /// # Errors
    /// [`CoreError::Cancelled`] where it is closed: nobody waits for an answer about it.
    pub fn read(&self) -> Result<Arc<ReadMaterial>, Error> {
        self.read.upgrade().ok_or_else(|| CoreError::Cancelled.into())
    }
}

/// The materials, for a worker.
///
/// # Errors
/// As [`Content::read`].
pub fn read_all(materials: &[Content]) -> Result<Vec<Arc<ReadMaterial>>, Error> {
    materials.iter().map(Content::read).collect()
}

/// The mask over which these are compared.
///
/// # Errors
/// [`Error::Masked`] where each has its own.
pub fn mask_of(read: &[Arc<ReadMaterial>]) -> Result<Option<&Mask>, Error> {
    let mask = read.first().and_then(|one| one.record.mask.as_ref());
    let is_common = read.iter().all(|one| one.record.mask.as_ref() == mask);
    is_common
        .then_some(mask)
        .ok_or(Error::Masked("one mask of all materials is needed: read them again (Ctrl+R)"))
}

/// Refuses materials with a mask where `what` is over all texels.
///
/// # Errors
/// [`Error::Masked`].
pub fn refuse_mask(read: &[Arc<ReadMaterial>], what: &'static str) -> Result<(), Error> {
    let has_mask = read.iter().any(|one| one.record.mask.is_some());
    if has_mask { Err(Error::Masked(what)) } else { Ok(()) }
}

/// A ground truth and a prediction, and the convention that they are compared by.
#[derive(Clone, Debug, PartialEq)]
pub struct ComparedPair {
    pub ground_truth: Content,
    pub prediction: Content,
    pub convention: Convention,
}

impl ComparedPair {
    /// The pair of the chosen prediction, if there is one.
    pub fn of(materials: &[LoadedMaterial], view: &ViewState) -> Option<Self> {
        let [ground_truth, prediction] = [materials.first()?, materials.get(view.display.prediction + 1)?];
        Some(Self::new(ground_truth, prediction, view.convention()))
    }

    /// The pairs of all predictions.
    pub fn all(materials: &[LoadedMaterial], view: &ViewState) -> Vec<Self> {
        let [ground_truth, predictions @ ..] = materials else { return Vec::new() };
        predictions.iter().map(|prediction| Self::new(ground_truth, prediction, view.convention())).collect()
    }

    fn new(ground_truth: &LoadedMaterial, prediction: &LoadedMaterial, convention: Convention) -> Self {
        let [ground_truth, prediction] = [ground_truth, prediction].map(Content::of);
        Self { ground_truth, prediction, convention }
    }

    /// The two materials, for a worker.
    ///
    /// # Errors
    /// As [`Content::read`].
    pub fn read(&self) -> Result<[Arc<ReadMaterial>; 2], Error> {
        Ok([self.ground_truth.read()?, self.prediction.read()?])
    }
}

/// What the rest of a question determines, so that two questions do not differ by it.
#[derive(Clone, Debug)]
pub struct Given<T>(pub T);

impl<T> PartialEq for Given<T> {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}
