//! Saved files: pictures of the materials as `svbrdf render` and `svbrdf strip` write them, the view, the session, and scenes.

use std::io::Write as _;
use std::path::Path;
use std::sync::Arc;

use svbrdf_core::image::Image;
use svbrdf_core::loss::{Comparison, Request, Sampling};
use svbrdf_core::material::Material;
use svbrdf_core::model::sampler::Sampler;
use svbrdf_core::picture::content::{ColouredDifference, PictureContent, Pictures};
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_core::progress::Progress;
use svbrdf_evaluate::Error as EvaluateError;
use svbrdf_evaluate::analyses::ScenesReport;
use svbrdf_evaluate::report::{Compared, Json as _};
use svbrdf_files::disk::atomic::{self, Destination};
use svbrdf_files::export::Provenance;
use svbrdf_files::export::strip::{Column, Crop, Paper, Strip};
use svbrdf_files::scene_file;

use crate::dataset::matrix;
use crate::error::Error;
use crate::jobs::answers::content::{ComparedPair, refuse_mask};
use crate::model::inspection::Region;
use crate::model::material::loaded::LoadedMaterial;
use crate::model::material::read::ReadMaterial;
use crate::pane::Displayed;

/// What writes a file, on a thread of its own.
pub type Writing = Box<dyn FnOnce(&Path, &Progress) -> Result<(), Error> + Send>;

/// The content of a picture of the panes.
fn content(displayed: &Displayed<'_>) -> PictureContent {
    let view = &displayed.model.view;
    let difference = ColouredDifference { kind: view.difference_kind(), range: Some(displayed.range()) };
    let has_reference = displayed.materials().len() > 1 || displayed.photograph().is_some();
    let compares = view.display.difference && has_reference;
    PictureContent { quantity: view.display.quantity, difference: compares.then_some(difference) }
}

/// Where a picture of the materials comes from.
fn provenance(displayed: &Displayed<'_>, content: PictureContent) -> Provenance {
    Provenance {
        content,
        convention: displayed.model.view.convention(),
        sources: names(displayed.materials()),
        renderer: "CPU, f32".to_owned(),
        session: displayed.model.session(),
    }
}

fn names(materials: &[LoadedMaterial]) -> Vec<String> {
    materials.iter().map(|slot| slot.name().to_owned()).collect()
}

fn materials(materials: &[LoadedMaterial]) -> Vec<Arc<ReadMaterial>> {
    materials.iter().map(|slot| slot.read.clone()).collect()
}

/// What the panes show of all materials, side by side.
pub fn renderings(displayed: &Displayed<'_>) -> Writing {
    let content = content(displayed);
    let (all, mut provenance) = (materials(displayed.materials()), provenance(displayed, content));
    Box::new(move |path, progress| {
        let destination = Destination::of_picture(path)?;
        let all: Vec<&Material<f32>> = all.iter().map(|loaded| loaded.material()).collect();
        let Provenance { convention, session, .. } = &provenance;
        let Pictures { images, content } =
            content.pictures(&all, &session.scene, convention, session.exposure, progress)?;
        provenance.content = content;
        Ok(destination.write_picture(&images, &provenance, None, progress)?)
    })
}

/// The materials of a data set that are listed: marks, notes and losses.
pub fn materials_csv(displayed: &Displayed<'_>) -> Writing {
    let table = matrix::table(displayed.shown());
    Box::new(move |path, progress| Ok(atomic::write_text(path, &table.csv()?, progress)?))
}

/// The figure of all materials, the rectangle magnified.
pub fn strip(displayed: &Displayed<'_>) -> Writing {
    let state = &displayed.model.view;
    let (all, names) = (materials(displayed.materials()), names(displayed.materials()));
    let value = |quantity| PictureContent { quantity, difference: None };
    let maps = [Quantity::Normal, Quantity::Diffuse, Quantity::Roughness, Quantity::Specular];
    let kind = state.display.differences.kind(Quantity::Rendering);
    let set = || state.display.differences.range(Quantity::Rendering);
    let range = if state.display.differences.is_error_map(Quantity::Rendering) { None } else { set() };
    let difference = Some(ColouredDifference { kind, range });
    let mut content: Vec<PictureContent> = maps.into_iter().chain([Quantity::Rendering]).map(value).collect();
    if all.len() > 1 {
        content.push(PictureContent { quantity: Quantity::Rendering, difference });
    }
    let columns = content.into_iter().map(|content| Column { content, scene: state.scene }).collect();
    let region = displayed.model.inspection.region;
    let crop = |region: Region| {
        let ([left, top], [width, height]) = (region.first, region.size());
        Crop { left, top, width, height }
    };
    let crops = region.into_iter().map(crop).collect();
    let (convention, exposure_ev) = (state.convention(), state.exposure_ev);
    let strip = Strip { columns, convention, exposure_ev, crops, paper: Paper::default() };
    let session = displayed.model.session();
    Box::new(move |path, progress| {
        let destination = Destination::of_figure(path)?;
        let mask = all.first().and_then(|truth| truth.record.mask.clone());
        let all: Vec<&Material<f32>> = all.iter().map(|loaded| loaded.material()).collect();
        let figure = strip.figure(&all, &names, mask.as_ref(), progress)?;
        Ok(destination.write_figure(&figure, &strip.entries(&names, session.entry(path)?), progress)?)
    })
}

/// A picture of the window, its pixels row by row.
pub fn view(displayed: &Displayed<'_>, picture: Image<u8>) -> Writing {
    let provenance = provenance(displayed, content(displayed));
    let shows = error_map_text(displayed).or_else(|| photograph_text(displayed));
    Box::new(move |path, progress| {
        let entries = provenance.entries(path, shows)?;
        let destination = Destination::new(path, &["png"], "extension of a figure", ".png")?;
        Ok(destination.write_png(&picture, &entries, progress)?)
    })
}

/// The scenes of the loss of the chosen prediction, worst first.
pub fn scenes(displayed: &Displayed<'_>) -> Writing {
    let pair = ComparedPair::of(&displayed.model.materials.all, &displayed.model.view);
    // Also where they are closed by then.
    let read = pair.as_ref().map(ComparedPair::read);
    let convention = displayed.model.view.convention();
    let request = displayed.model.settings.loss.listed_scenes();
    Box::new(move |path, progress| {
        let [truth, prediction] = read.ok_or(EvaluateError::NoPrediction)??;
        refuse_mask(
            std::slice::from_ref(&truth),
            "the list of scenes is over all texels, and not over those of a mask",
        )?;
        let destination = scene_file::destination(path)?;
        let (predictions, truth) = ([prediction.material()], truth.material());
        let comparison = Comparison::new(truth, &predictions, convention)?.without_pilot();
        let outcome = comparison.run(&request, progress)?;
        let compared = Compared::new(truth, &convention);
        let text = ScenesReport::new(compared, &outcome, usize::MAX).json()?;
        Ok(destination.replace(progress, |file| file.write_all(text.as_bytes()))?)
    })
}

/// The session.
pub fn session(displayed: &Displayed<'_>) -> Writing {
    let session = displayed.model.session();
    Box::new(move |path, progress| {
        let text = session.text(path)?;
        atomic::check_place(path)?;
        Ok(atomic::replace(path, progress, |file| file.write_all(text.as_bytes()))?)
    })
}

/// The photograph and the renderings, or the differences of the renderings from it, side by side.
pub fn against_photograph(displayed: &Displayed<'_>) -> Writing {
    let all = displayed.photographs().cloned();
    let view = &displayed.model.view;
    let (kind, difference) = (view.difference_kind(), view.display.difference);
    let mut provenance = provenance(displayed, content(displayed));
    let chosen = displayed.chosen();
    if let (false, Some(photograph)) = (difference, displayed.photograph()) {
        provenance.sources.insert(0, photograph.title(chosen));
    }
    let text = photograph_text(displayed);
    Box::new(move |path, progress| {
        let destination = Destination::of_picture(path)?;
        let all = all.ok_or(Error::Incomplete("the comparison with the photograph"))?;
        let images: Vec<_> = if difference {
            all.comparisons.iter().map(|one| one.difference(kind)).collect()
        } else {
            let photograph = all.get(chosen).map(|one| one.photograph.clone());
            let renderings = all.comparisons.iter().map(|one| one.rendering.clone());
            photograph.into_iter().chain(renderings).collect()
        };
        Ok(destination.write_picture(&images, &provenance, text, progress)?)
    })
}

/// The error maps side by side, as `svbrdf map` writes them.
pub fn error_maps(displayed: &Displayed<'_>) -> Writing {
    let maps = displayed.computed_maps().cloned();
    let (provenance, shows) = (provenance(displayed, content(displayed)), error_map_text(displayed));
    let range = displayed.range() as f32;
    Box::new(move |path, progress| {
        let destination = Destination::of_picture(path)?;
        let maps = maps.ok_or(Error::Incomplete("the error map"))?;
        Ok(destination.write_maps(&maps.images, range, &provenance.entries(path, shows)?, progress)?)
    })
}

/// What the metadata of a picture say where it shows error maps.
fn error_map_text(displayed: &Displayed<'_>) -> Option<String> {
    let (loss, view) = (&displayed.model.settings.loss, displayed.view());
    let scenes = match (loss.listed_scenes(), loss.file_scenes()) {
        (Request::Scenes(Sampling { near, distant, seed, sampler, .. }), _) => {
            let sampler = if sampler == Sampler::Sobol { "scrambled Sobol" } else { "random" };
            format!("{near} near-field and {distant} distant scenes, seed {seed}, {sampler}")
        }
        (_, file) => {
            let (count, name) = file.map_or((0, ""), |file| (file.scenes.len(), file.name.as_str()));
            format!("{count} scenes of {name}")
        }
    };
    let range = displayed.range();
    (view.display.difference && view.is_error_map())
        .then(|| format!("mean log difference of each texel over {scenes}; {range} the last colour"))
}

/// What the metadata of a picture say where it shows differences from a photograph.
fn photograph_text(displayed: &Displayed<'_>) -> Option<String> {
    let kind = displayed.view().difference_kind();
    let photograph = displayed.photograph().filter(|_| displayed.view().display.difference)?;
    let factors = photograph.all()?.comparisons.iter().map(|one| one.factor.to_string());
    Some(format!(
        "{} of renderings p from {} as g: {}, multiplied by {}; NaN or gray where it is clipped; {} the last colour",
        kind.name(),
        photograph.source.path.display(),
        kind.unit(),
        factors.collect::<Vec<_>>().join(" | "),
        displayed.range()
    ))
}
