//! A figure: materials in rows; maps, renderings and differences in columns; crops magnified beside them.

mod crop;
mod legend;
mod methods;
mod sheet;

use svbrdf_core::image::Image;
use svbrdf_core::material::{Mask, Material};
use svbrdf_core::model::convention::Convention;
use svbrdf_core::picture::content::ColouredDifference;
use svbrdf_core::progress::Progress;

pub use crop::Crop;
pub use legend::Column;
pub use methods::{MethodRow, MethodStrip};
pub use sheet::Paper;

use super::figure::Figure;
use crate::error::Error;
use legend::{scene_text, stops};
use sheet::{Division, GAP, SMALL, Sheet};

/// The columns of a figure, and how they are rendered and coloured.
#[derive(Clone, Debug, PartialEq)]
pub struct Strip {
    pub columns: Vec<Column>,
    pub convention: Convention,
    /// Stops by which renderings are brightened.
    pub exposure_ev: f32,
    /// Rectangles of texels that are framed in every cell and magnified beside it.
    pub crops: Vec<Crop>,
    pub paper: Paper,
}

impl Strip {
    /// The figure of `materials` of one size, the ground truth first, under their names. Each cell has the pixels that
    /// `svbrdf render` writes, but for the frames of crops and for texels outside of the `mask`, which are gray; in a PNG a texel is a pixel, or a square of them.
    ///
    /// # Errors
    /// [`Error::CropOutside`], [`Error::FigureTooNarrow`], those of
    /// [`PictureContent::pictures`](svbrdf_core::picture::content::PictureContent::pictures).
    pub fn figure(
        &self,
        materials: &[&Material<f32>],
        names: &[String],
        mask: Option<&Mask>,
        progress: &Progress,
    ) -> Result<Figure, Error> {
        let sheet = Sheet::new(self.paper, self.columns.len(), names, !self.crops.is_empty())?;
        let size = materials.first().map_or([1; 2], |material| material.size());
        let division = Division::new(size, &self.crops, sheet.column)?;
        let mut figure = Figure::new([sheet.width, 0.0], division.scale());
        let scenes: Vec<_> = self.columns.iter().filter_map(Column::scene).collect();
        let is_common = scenes.windows(2).all(|pair| pair[0] == pair[1]);
        let heading = |column: &Column| {
            let scene = column.scene().filter(|_| !is_common).map(|scene| (scene_text(scene), SMALL));
            std::iter::once((column.name(), 1.0)).chain(scene).collect()
        };
        let headings: Vec<Vec<(String, f64)>> = self.columns.iter().map(heading).collect();
        let first = sheet.headings(&mut figure, &headings);
        let has_legend = self.columns.iter().any(|column| column.content.difference.is_some());
        let row = division.height.max(if has_legend { legend::HEIGHT * sheet.em } else { 0.0 });
        let top = |number: usize| first + number as f64 * (row + GAP * sheet.em);
        for (number, name) in names.iter().enumerate() {
            sheet.name(&mut figure, top(number), size[1] as f64 * division.texel, name);
        }
        let mut legends = Vec::new();
        for (index, column) in self.columns.iter().enumerate() {
            let Self { convention, exposure_ev, .. } = self;
            let pictures =
                column.content.pictures(materials, &column.scene, convention, *exposure_ev, progress)?;
            let content = pictures.content;
            let from = materials.len() - pictures.images.len();
            for (number, image) in (from..).zip(pictures.images) {
                let pixels = image.pixels.iter().map(|&rgb| content.colour(rgb, self.exposure_ev)).collect();
                let mut cell = Image { width: image.width, height: image.height, pixels };
                mask.inspect(|mask| mask.gray_outside(&mut cell));
                division.put(&mut figure, [sheet.left(index), top(number)], cell);
            }
            legends.extend(content.difference.map(|difference| (index, difference)));
        }
        for (columns, difference) in bars(&legends) {
            let left = sheet.left(columns[0]);
            let width = sheet.left(columns[1]) + sheet.column - left;
            let at = [left, top(0) + 0.5 * (row - legend::HEIGHT * sheet.em).max(0.0)];
            legend::draw(&mut figure, at, width, sheet.em, difference);
        }
        figure.size[1] = top(names.len()) - GAP * sheet.em;
        if let Some(scene) = scenes.first().filter(|_| is_common) {
            let note = format!("{}; {}", scene_text(scene), stops(self.exposure_ev));
            figure.size[1] = sheet.note(&mut figure, top(names.len()), &note);
        }
        Ok(figure)
    }

    /// What the figure shows, as (keyword, text), with the entry of its session.
    pub fn entries(&self, names: &[String], session: (&'static str, String)) -> Vec<(&'static str, String)> {
        let columns = self.columns.iter().map(|column| column.text(self.convention.epsilon));
        let mut entries = vec![
            ("svbrdf:columns", columns.collect::<Vec<_>>().join(" | ")),
            ("svbrdf:sources", names.join(" | ")),
            session,
        ];
        if !self.crops.is_empty() {
            let crops = self.crops.iter().map(Crop::to_string).collect::<Vec<_>>();
            entries.push(("svbrdf:crops", crops.join(" | ")));
        }
        entries
    }
}

/// The scale bars of columns with differences: one over neighbours of one kind and range, from the first to the last, and none where
/// there is one already.
fn bars(columns: &[(usize, ColouredDifference)]) -> Vec<([usize; 2], ColouredDifference)> {
    let mut bars: Vec<([usize; 2], ColouredDifference)> = Vec::new();
    for (column, difference) in columns {
        match bars.iter_mut().find(|(_, other)| other == difference) {
            Some((columns, _)) if columns[1] + 1 == *column => columns[1] = *column,
            Some(_) => {}
            None => bars.push(([*column; 2], *difference)),
        }
    }
    bars
}

#[cfg(test)]
mod tests {
    use svbrdf_core::picture::difference::Difference;

    use super::*;

    #[test]
    fn equal_ranges_have_one_bar() {
        let of = |kind, range| ColouredDifference { kind, range: Some(range) };
        let [log, angle] = [of(Difference::Log, 2.0), of(Difference::Angle, 45.0)];
        assert_eq!(bars(&[(1, log), (2, log), (3, angle), (5, log)]), [([1, 2], log), ([3, 3], angle)]);
        let other = of(Difference::Log, 1.0);
        assert_eq!(bars(&[(1, log), (2, other)]), [([1, 1], log), ([2, 2], other)]);
    }
}
