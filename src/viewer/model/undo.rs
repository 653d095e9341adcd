//! Undo and redo.

use std::sync::Arc;

use crate::model::Model;
use crate::model::Moment;
use crate::model::view::Exposed;

/// Takes note of the moment, once the first materials are there. `is_photograph_settled`: none is being read.
pub fn remember(model: &mut Model, is_photograph_settled: bool) {
    let is_of_dataset = model.dataset.open.is_some();
    // Of a data set, going to another material is no step to undo.
    if model.materials.openings.is_empty() && !is_of_dataset {
        let materials = model.materials.sources();
        if materials != model.history.materials {
            model.history.materials = materials;
            model.remember_session();
        }
    }
    if (is_of_dataset || !model.history.materials.is_empty()) && is_photograph_settled {
        let (time, now) = (model.time, moment(model));
        model.history.moments.feed_state(time, &now);
    }
}

pub fn undo(model: &mut Model) {
    let now = moment(model);
    let earlier = model.history.moments.undo(&now).cloned();
    return_to(model, earlier);
}

pub fn redo(model: &mut Model) {
    let now = moment(model);
    let later = model.history.moments.redo(&now).cloned();
    return_to(model, later);
}

fn moment(model: &Model) -> Arc<Moment> {
    Arc::new(Moment {
        view: model.view.clone(),
        materials: model.history.materials.clone(),
        scenes: model.settings.loss.file_scenes().cloned(),
        photograph: model.photograph.source().cloned(),
    })
}

fn return_to(model: &mut Model, moment: Option<Arc<Moment>>) {
    let Some(moment) = moment else { return };
    let Moment { view, materials, scenes, photograph } = Arc::unwrap_or_clone(moment);
    model.view = view;
    model.exposed = Exposed::Restored;
    if scenes.as_ref() != model.settings.loss.file_scenes() {
        model.settings.loss = model.settings.loss.with_file(scenes);
    }
    if photograph.as_ref() != model.photograph.source() {
        model.photograph.set(photograph);
    }
    if materials != model.history.materials {
        model.read(model.materials.restore(&materials));
        model.history.materials = materials;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::material::loaded::LoadedMaterial;
    use crate::model::material::opening::Item;
    use crate::model::material::read::ReadMaterial;
    use crate::model::opening;
    use svbrdf_files::source::MaterialSource;

    /// A model with the built-in materials.
    fn model() -> Model {
        let samples = svbrdf_files::samples::load::<f32>().unwrap();
        let all = std::iter::once(samples.ground_truth).chain(samples.predictions).enumerate();
        let loaded = |(number, read)| {
            let read = ReadMaterial::new(MaterialSource::built_in(number), read, None);
            LoadedMaterial::new(std::sync::Arc::new(read))
        };
        let mut model = Model::default();
        model.materials.all = all.map(loaded).collect();
        model
    }

    /// Lets the model stand still for this many seconds.
    fn pause(model: &mut Model, seconds: f64) {
        for _ in 0..2 {
            model.time += seconds / 2.0;
            remember(model, true);
        }
    }

    #[test]
    fn undo_reads_a_closed_prediction_again_and_keeps_the_others() {
        let mut model = model();
        pause(&mut model, 1.0);
        opening::close(&mut model, 1);
        pause(&mut model, 2.0);
        undo(&mut model);
        let [opening] = &model.materials.openings[..] else { panic!("{:?}", model.materials.openings) };
        let reads = opening.items.iter().filter(|item| matches!(item, Item::Read(_))).count();
        assert_eq!((opening.items.len(), reads), (svbrdf_files::samples::COUNT, 1));
    }
}
