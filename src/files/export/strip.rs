//! A figure: materials in rows; maps, renderings and differences in columns.

use svbrdf_core::error::Error;
use svbrdf_core::image::Image;
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_core::picture::content::{ColouredDifference, PictureContent};
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_core::progress::Progress;

use super::text::{self, Anchor};

/// Pixels between two cells.
pub const GAP: usize = 4;
/// Pixels above the first row, for the names of columns and what they are of.
pub const HEADER: usize = 60;
const BACKGROUND: [u8; 3] = [255; 3];
const INK: [u8; 3] = [32; 3];
const WEAK: [u8; 3] = [96; 3];
/// Heights of text, in pixels.
const NAME: u32 = 17;
const SMALL: u32 = 13;
/// Pixels around a name.
const MARGIN: usize = 10;
/// Least height of a row: that of a legend.
const LEAST_ROW: usize = 52;

/// A column: what it shows, and under which light and view.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    pub content: PictureContent,
    pub scene: Scene,
}

/// The columns of a figure, and how they are rendered and coloured.
#[derive(Clone, Debug, PartialEq)]
pub struct Strip {
    pub columns: Vec<Column>,
    pub convention: Convention,
    /// Stops by which renderings are brightened.
    pub exposure_ev: f32,
}

impl Strip {
    /// The figure of `materials` of one size, the ground truth first, under their names. Each cell has the pixels that
    /// `svbrdf render` writes: one a texel.
    ///
    /// # Errors
    /// Those of [`PictureContent::pictures`], [`Error::Internal`] where text cannot be drawn.
    pub fn picture(
        &self,
        materials: &[&Material<f32>],
        names: &[String],
        progress: &Progress,
    ) -> Result<Image<u8>, Error> {
        let sheet = Sheet::new(&self.columns, materials, names);
        let mut picture = filled(sheet.size(), BACKGROUND);
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
            for (row, image) in pictures.images.iter().enumerate() {
                let bytes = image.pixels.iter().map(|&rgb| content.colour(rgb, self.exposure_ev)).collect();
                put(&mut picture, [left, sheet.top(first + row)], [image.width, image.height], bytes);
            }
            if let Some(difference) = content.difference {
                legend(&mut picture, [left, sheet.top(0)], [width, sheet.row], difference)?;
            }
            let mut y = 0;
            for (line, size, ink) in header(column) {
                text::draw(&mut picture, &line, [left, y + 13], size, ink, Anchor::Left)?;
                y += 17;
            }
        }
        Ok(picture)
    }

    /// Where the figure comes from, as (keyword, text).
    pub fn entries(&self, names: &[String]) -> Vec<(&'static str, String)> {
        let columns = self.columns.iter().map(|column| {
            let epsilon = self.convention.epsilon;
            match column.content.quantity {
                Quantity::Rendering => {
                    format!("{}, {}", column.content.text(epsilon), endpoints(&column.scene).join(", "))
                }
                _ => column.content.text(epsilon),
            }
        });
        vec![
            ("svbrdf:columns", columns.collect::<Vec<_>>().join(" | ")),
            ("svbrdf:sources", names.join(" | ")),
            ("svbrdf:convention", self.convention.name.to_owned()),
            ("svbrdf:exposure", format!("{} EV", self.exposure_ev)),
        ]
    }
}

/// Light and view.
fn endpoints(scene: &Scene) -> [String; 2] {
    let kind = match scene.kind {
        Kind::Near => "",
        Kind::Distant => "distant ",
    };
    let point = |[x, y, z]: [f64; 3]| format!("{x:.3}, {y:.3}, {z:.3}");
    [format!("{kind}light {}", point(scene.light)), format!("view {}", point(scene.view))]
}

/// The name of a column, and what it is of: lines of text with their heights and inks.
fn header(column: &Column) -> Vec<(String, u32, [u8; 3])> {
    let quantity = column.content.quantity;
    let name = match column.content.difference {
        Some(difference) => format!("{}, {}", quantity.name(), difference.kind.name()),
        None => quantity.name().to_owned(),
    };
    let mut lines = vec![(name, NAME, INK)];
    if quantity == Quantity::Rendering {
        let [light, view] = endpoints(&column.scene);
        lines.extend([(light, SMALL, WEAK), (view, SMALL, WEAK)]);
    }
    lines
}

/// Where the cells of a figure are.
struct Sheet {
    /// Width and height of a material.
    cell: [usize; 2],
    /// Height of a row.
    row: usize,
    rows: usize,
    /// Left edges and widths of the columns: texts of neighbours do not overlap.
    lefts: Vec<usize>,
    widths: Vec<usize>,
    width: usize,
}

impl Sheet {
    fn new(columns: &[Column], materials: &[&Material<f32>], names: &[String]) -> Self {
        let cell = materials.first().map_or([0, 0], |material| material.size());
        let mut width = names.iter().map(|name| text::width(name, NAME)).max().unwrap_or(0) + 2 * MARGIN;
        let (mut lefts, mut widths) = (Vec::new(), Vec::new());
        for column in columns {
            let texts = header(column);
            let text = texts.iter().map(|(line, height, _)| text::width(line, *height) + MARGIN).max();
            let own = cell[0].max(text.unwrap_or(0));
            lefts.push(width);
            widths.push(own);
            width += own + GAP;
        }
        Self { cell, row: cell[1].max(LEAST_ROW), rows: materials.len(), lefts, widths, width }
    }

    fn top(&self, row: usize) -> usize {
        HEADER + row * (self.row + GAP)
    }

    fn size(&self) -> [usize; 2] {
        [self.width, self.top(self.rows)]
    }
}

/// The colours of a difference with their numbers, in the cell of the ground truth.
fn legend(
    picture: &mut Image<u8>,
    [left, top]: [usize; 2],
    [width, height]: [usize; 2],
    difference: ColouredDifference,
) -> Result<(), Error> {
    let range = difference.range.unwrap_or_else(|| difference.kind.default_range());
    let lowest = if difference.kind.is_signed() { -range } else { 0.0 };
    let content = PictureContent { quantity: Quantity::Rendering, difference: Some(difference) };
    let bar = [width * 4 / 5, (height / 12).clamp(1, 16)];
    let colour = |x: usize| {
        let amount = lowest + (range - lowest) * (x as f64 + 0.5) / bar[0] as f64;
        content.colour([amount as f32; 3], 0.0)
    };
    let [x, y] = [left + width / 10, top + height / 2];
    let bytes = (0..bar[1]).flat_map(|_| (0..bar[0]).map(colour)).collect();
    put(picture, [x, y], bar, bytes);
    let below = y + bar[1] + 10;
    text::draw(picture, &format!("{lowest:.3}"), [x, below], SMALL, INK, Anchor::Left)?;
    text::draw(picture, &format!("{range:.3}"), [x + bar[0], below], SMALL, INK, Anchor::Right)?;
    let unit = difference.kind.unit();
    text::draw(picture, unit, [x, y.saturating_sub(10)], SMALL, INK, Anchor::Left)
}

fn filled([width, height]: [usize; 2], colour: [u8; 3]) -> Image<u8> {
    Image { width, height, pixels: vec![colour; width * height] }
}

fn put(picture: &mut Image<u8>, [left, top]: [usize; 2], [width, height]: [usize; 2], bytes: Vec<[u8; 3]>) {
    for row in 0..height {
        let start = (top + row) * picture.width + left;
        picture.pixels[start..start + width].copy_from_slice(&bytes[row * width..][..width]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_of_narrow_columns_do_not_overlap_and_wide_columns_are_as_wide_as_the_material() {
        let content = PictureContent { quantity: Quantity::Rendering, difference: None };
        let light = [-0.123, -0.456, 1.789];
        let scene = Scene { kind: Kind::Distant, view: [-0.111, -0.222, 2.333], light };
        let columns = vec![Column { content, scene }; 3];
        let material = |side| crate::samples::load::<f32>().unwrap().ground_truth.material.resized([side; 2]);
        let names = ["gt".to_owned()];
        for (side, is_wider) in [(16, true), (256, false)] {
            let material = material(side).unwrap();
            let sheet = Sheet::new(&columns, &[&material], &names);
            for pair in sheet.lefts.windows(2) {
                for (line, height, _) in header(&columns[0]) {
                    assert!(pair[0] + text::width(&line, height) < pair[1], "{line} at {side}");
                }
                assert_eq!(pair[1] - pair[0] > side + GAP, is_wider, "{side}");
            }
        }
    }
}
