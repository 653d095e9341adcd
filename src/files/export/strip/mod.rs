//! A figure: materials in rows; maps, renderings and differences in columns; crops magnified beside them.

mod column;
mod crop;
mod legend;
mod methods;
mod sheet;

use svbrdf_core::image::Image;
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::progress::Progress;

pub use column::Column;
pub use crop::Crop;
pub use methods::{MethodRow, MethodStrip};
pub use sheet::{GAP, HEADER};

use super::text::{self, Anchor};
use crate::error::Error;
use column::{INK, NAME};
use sheet::{Inset, MARGIN, Sheet, put};

const BACKGROUND: [u8; 3] = [255; 3];

/// The columns of a figure, and how they are rendered and coloured.
#[derive(Clone, Debug, PartialEq)]
pub struct Strip {
    pub columns: Vec<Column>,
    pub convention: Convention,
    /// Stops by which renderings are brightened.
    pub exposure_ev: f32,
    /// Rectangles of texels that are framed in every cell and magnified beside it.
    pub crops: Vec<Crop>,
}

impl Strip {
    /// The figure of `materials` of one size, the ground truth first, under their names. Each cell has the pixels that
    /// `svbrdf render` writes, one a texel, but for the frames of crops.
    ///
    /// # Errors
    /// [`Error::CropOutside`], those of [`PictureContent::pictures`](svbrdf_core::picture::content::PictureContent::pictures),
    /// [`Error::Internal`] where text cannot be drawn.
    pub fn picture(
        &self,
        materials: &[&Material<f32>],
        names: &[String],
        progress: &Progress,
    ) -> Result<Image<u8>, Error> {
        let cell = materials.first().map_or([0, 0], |material| material.size());
        self.crops.iter().try_for_each(|crop| crop.check(cell))?;
        let sheet = Sheet::new(&self.columns, cell, names, &self.crops);
        let [width, height] = sheet.size();
        let mut picture = Image { width, height, pixels: vec![BACKGROUND; width * height] };
        for (row, name) in names.iter().enumerate() {
            let at = [MARGIN, sheet.top(row) + sheet.cell[1] / 2];
            text::draw(&mut picture, name, at, NAME, INK, Anchor::Left)?;
        }
        for (index, column) in self.columns.iter().enumerate() {
            let Self { convention, exposure_ev, .. } = self;
            let pictures =
                column.content.pictures(materials, &column.scene, convention, *exposure_ev, progress)?;
            let content = pictures.content;
            let (left, width) = (sheet.lefts[index], sheet.widths[index]);
            let first = materials.len() - pictures.images.len();
            for (row, image) in pictures.images.into_iter().enumerate() {
                let pixels = image.pixels.iter().map(|&rgb| content.colour(rgb, self.exposure_ev)).collect();
                let cell = Image { width: image.width, height: image.height, pixels };
                put_cell(&mut picture, [left, sheet.top(first + row)], cell, &sheet);
            }
            if let Some(difference) = content.difference {
                legend::draw(&mut picture, [left, sheet.top(0)], [width, sheet.row], difference)?;
            }
            let mut y = 0;
            for (line, size, ink) in column.header() {
                text::draw(&mut picture, &line, [left, y + 13], size, ink, Anchor::Left)?;
                y += 17;
            }
        }
        Ok(picture)
    }

    /// Where the figure comes from, as (keyword, text).
    pub fn entries(&self, names: &[String]) -> Vec<(&'static str, String)> {
        let columns = self.columns.iter().map(|column| column.text(self.convention.epsilon));
        let mut entries = vec![
            ("svbrdf:columns", columns.collect::<Vec<_>>().join(" | ")),
            ("svbrdf:sources", names.join(" | ")),
            ("svbrdf:convention", self.convention.name.to_owned()),
            ("svbrdf:exposure", format!("{} EV", self.exposure_ev)),
        ];
        if !self.crops.is_empty() {
            let crops = self.crops.iter().map(Crop::to_string).collect::<Vec<_>>();
            entries.push(("svbrdf:crops", crops.join(" | ")));
        }
        entries
    }
}

/// Puts a cell with its frames at a place, and its insets beside it.
fn put_cell(picture: &mut Image<u8>, [left, top]: [usize; 2], mut cell: Image<u8>, sheet: &Sheet) {
    let line = sheet.line;
    for Inset { crop, colour, magnification, offset } in &sheet.insets {
        let inset = crop.magnified(&cell, *magnification);
        let size = [inset.width, inset.height].map(|side| side + 2 * line);
        let frame = Image { width: size[0], height: size[1], pixels: vec![*colour; size[0] * size[1]] };
        let at = [left + offset[0], top + offset[1]];
        put(picture, at, &frame);
        put(picture, at.map(|edge| edge + line), &inset);
    }
    // After all insets, which show no frames.
    for Inset { crop, colour, .. } in &sheet.insets {
        crop.frame(&mut cell, line, *colour);
    }
    put(picture, [left, top], &cell);
}
