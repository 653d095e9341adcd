//! Comparisons: the materials, the convention, and the backend that computes their losses.

use std::fmt::Debug;

use crate::error::Error;
use crate::material::{Grid, Material};
use crate::math::real::Real;
use crate::model::convention::Convention;
use crate::model::scene::Scene;
use crate::parallel;
use crate::progress::Progress;

/// A ground truth, predictions of the same size, and the convention that they are compared by.
///
/// [`Comparison::run`] computes the rendering loss of every prediction over the scenes of a
/// [`Request`](super::Request). The precision is the materials': `f32` is many times faster, `f64` is the
/// reference.
///
/// ```
/// use svbrdf_core::loss::{Comparison, Request};
/// use svbrdf_core::material::Material;
/// use svbrdf_core::model::brdf::Texel;
/// use svbrdf_core::model::convention::Convention;
/// use svbrdf_core::progress::Progress;
///
/// let texel = |roughness: f32| Texel { normal: glam::Vec3::Z, diffuse: [0.5; 3], specular: [0.04; 3], roughness };
/// let truth = Material::uniform("truth", 64, 64, &texel(0.6))?;
/// let [same, rough] = [("same", 0.6), ("too rough", 0.7)].map(|(name, r)| Material::uniform(name, 64, 64, &texel(r)));
/// let (same, rough) = (same?, rough?);
/// let comparison = Comparison::new(&truth, &[&same, &rough], Convention::default())?;
/// let outcome = comparison.run(&Request::default(), &Progress::default())?;
/// assert!(outcome.losses[0].estimate.mean == 0.0 && outcome.losses[1].estimate.mean > 0.01);
/// # Ok::<(), svbrdf_core::error::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Comparison<'a, T> {
    ground_truth: &'a Material<T>,
    predictions: Vec<&'a Material<T>>,
    convention: Convention,
    backend: &'a dyn Backend<T>,
    pilot: bool,
    most_scenes: Option<usize>,
    places: Option<(Grid, &'a [usize])>,
}

/// What computes the loss of each scene.
pub trait Backend<T>: Debug + Sync {
    /// For each prediction of `comparison` the loss of each of `scenes`: the mean over texels and RGB of
    /// `|ln(R_gt + epsilon) - ln(R_pred + epsilon)|`.
    ///
    /// `texels` are the compared ones, at least one, given as row * width + column; one that is given twice counts twice. `None`: all.
    /// `scenes` are usable, at least one. The result does not depend on the number of threads.
    ///
    /// # Errors
    /// [`Error::Cancelled`].
    ///
    /// # Panics
    /// Where there is no such texel, or none, as indexing a slice does.
    fn scene_losses(
        &self,
        comparison: &Comparison<'_, T>,
        scenes: &[Scene],
        texels: Option<&[usize]>,
        progress: &Progress,
    ) -> Result<Vec<Vec<f64>>, Error>;

    /// The same where the scene with index i is compared on texels of its own, `texels(i)`; 0 where there are none. A scene is one
    /// step of `progress`.
    ///
    /// # Errors
    /// As [`Backend::scene_losses`].
    fn losses_on_own_texels(
        &self,
        comparison: &Comparison<'_, T>,
        scenes: &[Scene],
        texels: &(dyn Fn(usize) -> Vec<usize> + Sync),
        progress: &Progress,
    ) -> Result<Vec<Vec<f64>>, Error>
    where
        T: Send + Sync,
    {
        let predictions = comparison.predictions().len();
        progress.begin(scenes.len() as u64);
        let of_scene = |index: usize| {
            let (scene, unseen) = (&scenes[index..=index], Progress::default());
            let losses = match texels(index).as_slice() {
                [] => vec![vec![0.0]; predictions],
                texels => self.scene_losses(comparison, scene, Some(texels), &unseen)?,
            };
            progress.step().map(|()| losses.concat())
        };
        let losses = parallel::try_map(scenes.len(), of_scene)?;
        Ok(by_prediction(predictions, &losses))
    }
}

/// For each prediction the losses of all scenes, from those of each scene.
pub(super) fn by_prediction(predictions: usize, per_scene: &[Vec<f64>]) -> Vec<Vec<f64>> {
    (0..predictions).map(|p| per_scene.iter().map(|losses| losses[p]).collect()).collect()
}

/// A precision that losses are computed in.
pub trait Compute: Real {
    /// The fastest one.
    fn cpu() -> &'static dyn Backend<Self>;
}

impl<'a, T: Compute> Comparison<'a, T> {
    /// Compares `predictions` with `ground_truth`.
    ///
    /// # Errors
    /// [`Error::SizesDiffer`].
    pub fn new(
        ground_truth: &'a Material<T>,
        predictions: &[&'a Material<T>],
        convention: Convention,
    ) -> Result<Self, Error> {
        for prediction in predictions {
            check_same_size(ground_truth, prediction)?;
        }
        Ok(Self {
            ground_truth,
            predictions: predictions.to_vec(),
            convention,
            backend: T::cpu(),
            pilot: true,
            most_scenes: None,
            places: None,
        })
    }
}

impl<'a, T> Comparison<'a, T> {
    /// The same comparison, computed by `backend`.
    #[must_use]
    pub fn on(self, backend: &'a dyn Backend<T>) -> Self {
        Self { backend, ..self }
    }

    /// The same comparison, with intervals from the sampled scenes alone: a pilot takes a few milliseconds.
    #[must_use]
    pub fn without_pilot(self) -> Self {
        Self { pilot: false, ..self }
    }

    /// The same comparison of other predictions.
    ///
    /// # Errors
    /// [`Error::SizesDiffer`].
    pub fn with_predictions<'b>(&self, predictions: &[&'b Material<T>]) -> Result<Comparison<'b, T>, Error>
    where
        'a: 'b,
        T: Real,
    {
        predictions.iter().try_for_each(|prediction| check_same_size(self.ground_truth, prediction))?;
        Ok(Comparison { predictions: predictions.to_vec(), ..*self })
    }

    /// The same comparison, of materials that hold a part of the texels of a larger `grid`: their texel i is at `texels[i]` of it, as
    /// row * width + column. Losses are over the texels that they hold.
    #[must_use]
    pub fn at(self, grid: Grid, texels: &'a [usize]) -> Self {
        Self { places: Some((grid, texels)), ..self }
    }

    /// The same comparison, where an accuracy or a time samples at most `count` scenes instead of
    /// [`MOST_SCENES`](super::MOST_SCENES), rounded down to a number that Sobol sequences are even with; at least 24.
    #[must_use]
    pub fn at_most(self, count: usize) -> Self {
        Self { most_scenes: Some(count), ..self }
    }

    /// The most scenes that an accuracy or a time samples, where this comparison has a limit of its own.
    pub(super) fn most_scenes(&self) -> Option<usize> {
        self.most_scenes
    }

    /// Whether a pilot gives the intervals of few sampled scenes.
    pub(super) fn has_pilot(&self) -> bool {
        self.pilot
    }

    /// The ground truth.
    pub fn ground_truth(&self) -> &'a Material<T> {
        self.ground_truth
    }

    /// The predictions, in the order of the losses.
    pub fn predictions(&self) -> &[&'a Material<T>] {
        &self.predictions
    }

    /// The convention that renderings and their comparison follow.
    pub fn convention(&self) -> &Convention {
        &self.convention
    }

    /// What computes the losses.
    pub fn backend(&self) -> &'a dyn Backend<T> {
        self.backend
    }
}

impl<'a, T: Real> Comparison<'a, T> {
    /// Where the texels of the materials are: the grid, and the place of each of them where that is another one than its own.
    pub fn places(&self) -> (Grid, Option<&'a [usize]>) {
        self.places.map_or((self.ground_truth.grid(), None), |(grid, texels)| (grid, Some(texels)))
    }
}

/// Whether a prediction can be compared with its ground truth texel by texel.
///
/// # Errors
/// [`Error::SizesDiffer`].
pub fn check_same_size<T: Real>(ground_truth: &Material<T>, prediction: &Material<T>) -> Result<(), Error> {
    if ground_truth.size() == prediction.size() {
        return Ok(());
    }
    Err(Error::SizesDiffer {
        first: format!("ground truth {}", ground_truth.name()),
        first_size: ground_truth.size(),
        second: format!("prediction {}", prediction.name()),
        second_size: prediction.size(),
        remedy: "resize them to one size",
    })
}
