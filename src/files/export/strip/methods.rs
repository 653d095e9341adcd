//! A figure of methods: materials in rows, the ground truth and each method in columns, all under one light and view.

use svbrdf_core::error::Error as CoreError;
use svbrdf_core::image::Image;
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::picture::content::PictureContent;
use svbrdf_core::picture::difference::DifferenceParams;
use svbrdf_core::picture::exposure;
use svbrdf_core::progress::Progress;

use super::column::{INK, NAME, SMALL};
use super::legend;
use super::sheet::{GAP, MARGIN, put};
use crate::disk::memory;
use crate::error::Error;
use crate::export::text::{self, Anchor};

/// Pixels above the first row, for the names of methods; below a cell, for its text; and below the last row, for the scale bar.
const HEAD: usize = 28;
const BELOW: usize = 20;
const LEGEND: usize = 56;
const BACKGROUND: [u8; 3] = [255; 3];
/// The place of a prediction that is not there.
const MISSING: [u8; 3] = [224; 3];

/// What every cell shows, and how.
#[derive(Clone, Debug, PartialEq)]
pub struct MethodStrip {
    /// Of a difference, its range is one of all cells.
    pub content: PictureContent,
    pub scene: Scene,
    pub convention: Convention,
    /// Stops by which renderings are brightened. `None`: for each row so that the brightest 1% of its ground truth just clip.
    pub exposure_ev: Option<f32>,
    /// Longest side of a cell, in pixels: larger materials are averaged to it.
    pub side: usize,
}

/// What a row has of a material.
#[derive(Clone, Debug)]
pub struct MethodRow {
    /// The ground truth, then a prediction of each method; `None` where there is none. One of another size is as none.
    pub materials: Vec<Option<Material<f32>>>,
    /// What stands below each of them, such as its loss; none without.
    pub texts: Vec<String>,
}

impl MethodStrip {
    /// The figure under the names of the methods, a row for each of the named materials; `row` reads it when it is drawn. The ground
    /// truth shows its value where predictions show a difference from it.
    ///
    /// # Errors
    /// Those of [`PictureContent::pictures`], and of [`Material::resized`]; [`Error::Memory`]; [`Error::Internal`] where text cannot be
    /// drawn.
    pub fn picture(
        &self,
        methods: &[String],
        materials: &[String],
        row: impl Fn(usize) -> MethodRow,
        progress: &Progress,
    ) -> Result<Image<u8>, Error> {
        progress.begin(materials.len() as u64);
        let heads: Vec<&str> =
            std::iter::once("ground truth").chain(methods.iter().map(String::as_str)).collect();
        let names = materials.iter().map(|name| text::width(name, NAME)).max().unwrap_or(0) + 2 * MARGIN;
        let wide =
            heads.iter().map(|head| text::width(head, NAME) + MARGIN).max().unwrap_or(0).max(self.side);
        let high = self.side + BELOW + GAP;
        let has_legend = self.content.difference.is_some();
        let width = names + heads.len() * (wide + GAP);
        let height = HEAD + materials.len() * high + if has_legend { LEGEND } else { 0 };
        let what = || format!("a figure of {width} x {height} pixels");
        let _reserved = memory::reserve((3 * width * height) as u64, what)?;
        let mut picture = Image { width, height, pixels: vec![BACKGROUND; width * height] };
        let left = |column: usize| names + column * (wide + GAP);
        for (column, head) in heads.iter().enumerate() {
            text::draw(&mut picture, head, [left(column), HEAD / 2], NAME, INK, Anchor::Left)?;
        }
        for (index, name) in materials.iter().enumerate() {
            let (top, row) = (HEAD + index * high, row(index));
            text::draw(&mut picture, name, [MARGIN, top + self.side / 2], NAME, INK, Anchor::Left)?;
            for (column, cell) in self.cells(&row, progress)?.into_iter().enumerate() {
                put(&mut picture, [left(column), top], &cell);
                if let Some(text) = row.texts.get(column) {
                    let at = [left(column), top + self.side + BELOW / 2];
                    text::draw(&mut picture, text, at, SMALL, INK, Anchor::Left)?;
                }
            }
            progress.step()?;
        }
        if let Some(difference) = self.content.difference {
            let at = [left(1), height - LEGEND];
            legend::draw(&mut picture, at, [wide.max(2 * MARGIN), LEGEND], difference)?;
        }
        Ok(picture)
    }

    /// The pictures of a row.
    fn cells(&self, row: &MethodRow, progress: &Progress) -> Result<Vec<Image<u8>>, Error> {
        let size = row.materials.first().and_then(Option::as_ref).map(Material::size);
        // A prediction of another size cannot be compared.
        let is_of_size = |one: &&Material<f32>| Some(one.size()) == size;
        let reduced = |one: &Option<Material<f32>>| {
            one.as_ref().filter(is_of_size).map(|one| self.reduced(one.clone())).transpose()
        };
        let materials: Vec<Option<Material<f32>>> =
            row.materials.iter().map(reduced).collect::<Result<_, CoreError>>()?;
        let truth = materials.first().and_then(Option::as_ref);
        let automatic =
            || truth.map_or(0.0, |truth| exposure::automatic(truth, &self.scene, &self.convention));
        let ev = self.exposure_ev.unwrap_or_else(automatic);
        let value = PictureContent { difference: None, ..self.content };
        let image = |one: &Material<f32>| {
            self.content.quantity.image(one, &self.scene, &self.convention, &progress.part())
        };
        let of_truth = truth.map(image).transpose()?;
        let mut cells = Vec::new();
        for (column, one) in materials.iter().enumerate() {
            let pair = one.as_ref().zip(of_truth.as_ref());
            let Some((one, truth)) = pair else {
                let [width, height] =
                    of_truth.as_ref().map_or([self.side; 2], |truth| [truth.width, truth.height]);
                cells.push(Image { width, height, pixels: vec![MISSING; width * height] });
                continue;
            };
            let image = image(one)?;
            let (content, image) = match self.content.difference.filter(|_| column > 0) {
                None => (value, image),
                Some(difference) => {
                    let params = DifferenceParams { epsilon: self.convention.epsilon, exposure_ev: ev };
                    (self.content, difference.kind.picture(truth, &image, params))
                }
            };
            let pixels = image.pixels.iter().map(|rgb| content.colour(*rgb, ev)).collect();
            cells.push(Image { width: image.width, height: image.height, pixels });
        }
        Ok(cells)
    }

    fn reduced(&self, material: Material<f32>) -> Result<Material<f32>, CoreError> {
        let size = material.size();
        let longest = size[0].max(size[1]);
        if longest <= self.side {
            return Ok(material);
        }
        material.resized(size.map(|length| (length * self.side / longest).max(1)))
    }

    /// Where the figure comes from, as (keyword, text).
    pub fn entries(&self, methods: &[String], materials: &[String]) -> Vec<(&'static str, String)> {
        let exposure = self.exposure_ev.map_or("automatic, of each row".to_owned(), |ev| format!("{ev} EV"));
        vec![
            ("svbrdf:columns", format!("ground truth | {}", methods.join(" | "))),
            ("svbrdf:sources", materials.join(" | ")),
            ("svbrdf:shows", self.content.text(self.convention.epsilon)),
            ("svbrdf:scene", serde_json::to_string(&self.scene).unwrap_or_default()),
            ("svbrdf:convention", self.convention.name.to_owned()),
            ("svbrdf:exposure", exposure),
        ]
    }
}

#[cfg(test)]
mod tests {
    use svbrdf_core::model::scene::Kind;
    use svbrdf_core::picture::content::ColouredDifference;
    use svbrdf_core::picture::difference::Difference;
    use svbrdf_core::picture::quantity::Quantity;

    use super::*;
    use crate::samples;

    /// Two rows: the built-in pair, and the same without its second prediction.
    fn rows() -> Vec<MethodRow> {
        let built_in = samples::load::<f32>().unwrap();
        let predictions = built_in.predictions.into_iter().map(|one| Some(one.material));
        let all: Vec<_> = std::iter::once(Some(built_in.ground_truth.material)).chain(predictions).collect();
        let texts = ["", "0.3218", "0.2047"].map(str::to_owned).to_vec();
        let mut lacking = all.clone();
        lacking[2] = None;
        [all, lacking].map(|materials| MethodRow { materials, texts: texts.clone() }).to_vec()
    }

    /// The figure of those rows.
    fn picture(strip: &MethodStrip, rows: &[MethodRow]) -> Image<u8> {
        let [methods, names] =
            [["blurred", "rough"], ["tiles", "lacking"]].map(|names| names.map(str::to_owned));
        strip.picture(&methods, &names, |row| rows[row].clone(), &Progress::default()).unwrap()
    }

    fn strip(difference: Option<ColouredDifference>) -> MethodStrip {
        let content = PictureContent { quantity: Quantity::Rendering, difference };
        let scene = Scene { kind: Kind::Near, view: [0.0, 0.0, 2.5], light: [0.4, 0.5, 1.2] };
        MethodStrip { content, scene, convention: Convention::default(), exposure_ev: Some(0.5), side: 128 }
    }

    #[test]
    fn each_cell_is_the_rendering_of_its_material_and_a_missing_one_is_gray() {
        let (rows, strip) = (rows(), strip(None));
        let picture = picture(&strip, &rows);
        let names = text::width("lacking", NAME) + 2 * MARGIN;
        let wide = text::width("ground truth", NAME).max(128 - MARGIN) + MARGIN;
        let cell = |row: usize, column: usize| -> Vec<[u8; 3]> {
            let [left, top] = [names + column * (wide + GAP), HEAD + row * (128 + BELOW + GAP)];
            let lines = picture.pixels.chunks(picture.width).skip(top).take(128);
            lines.flat_map(|line| line[left..left + 128].to_vec()).collect()
        };
        for (row, column) in [(0, 0), (0, 1), (0, 2), (1, 0), (1, 1)] {
            let material = rows[row].materials[column].clone().unwrap().resized([128, 128]).unwrap();
            let part = Progress::default();
            let image = Quantity::Rendering.image(&material, &strip.scene, &strip.convention, &part).unwrap();
            let expected: Vec<_> = image.pixels.iter().map(|rgb| strip.content.colour(*rgb, 0.5)).collect();
            assert!(cell(row, column) == expected, "row {row}, column {column}");
        }
        assert!(cell(0, 1) != cell(0, 2), "a planted fault: columns that changed places");
        assert!(cell(1, 2).iter().all(|pixel| *pixel == MISSING));
    }

    #[test]
    fn a_difference_has_a_scale_bar_and_the_ground_truth_its_value() {
        let rows = rows();
        let difference = ColouredDifference { kind: Difference::Log, range: Some(2.0) };
        let [value, difference] =
            [None, Some(difference)].map(|difference| picture(&strip(difference), &rows));
        assert_eq!(difference.height, value.height + LEGEND);
        let names = text::width("lacking", NAME) + 2 * MARGIN;
        let at = |picture: &Image<u8>, x: usize| picture.pixels[(HEAD + 40) * picture.width + x];
        assert_eq!(at(&value, names + 40), at(&difference, names + 40), "the ground truth");
        let wide = text::width("ground truth", NAME).max(128 - MARGIN) + MARGIN + GAP;
        assert_ne!(at(&value, names + wide + 40), at(&difference, names + wide + 40));
    }
}
