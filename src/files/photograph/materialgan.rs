//! The calibration of the captures of MaterialGAN (Guo et al. 2020): positions and light in centimetres.

use std::ops::RangeInclusive;
use std::path::PathBuf;

use serde::Deserialize;
use serde_json::Value;

use svbrdf_core::model::scene::{Kind, Scene};

/// The text files of the first release of MaterialGAN, one number or three in a line. The first also stands for all of them.
pub const TEXTS: [&str; 4] = ["camera_pos.txt", "light_pos.txt", "image_size.txt", "light_power.txt"];

/// The key of the positions of the camera, by which a calibration is told from other JSON.
pub const POSITIONS: &str = "camera_pos";

/// Powers of a light that renderings can have.
const POWERS: RangeInclusive<f64> = 1e-30..=1e30;

/// A JSON file of MaterialGAN, such as `render.json` or `optim_latent_256.json`, or the text files of its first release.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct Calibration {
    /// The width of the material in centimetres.
    #[serde(alias = "image_size")]
    im_size: f64,
    camera_pos: Vec<[f64; 3]>,
    light_pos: Vec<[f64; 3]>,
    /// The numbers of the photographs, which also name their files; without, all.
    idx: Option<Vec<usize>>,
    /// The power of the light, RGB; radiance is `light_pow * f * NoL / distance^2`.
    light_pow: Option<[f64; 3]>,
    /// The folder of the photographs.
    pub target_dir: Option<PathBuf>,
}

/// The power of a light whose radiance is stored.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightPower {
    /// The mean over RGB, where the unit of length is half the width of the material.
    pub mean: f64,
    /// Red, green and blue over their mean.
    pub colour: [f64; 3],
}

impl LightPower {
    /// Whether red, green and blue are equal.
    pub fn is_white(&self) -> bool {
        self.colour.iter().all(|channel| (channel - 1.0).abs() < 1e-9)
    }
}

impl Calibration {
    /// Whether JSON is meant as a calibration, though it may have mistakes.
    pub fn is_meant(text: &str) -> bool {
        serde_json::from_str::<Value>(text).is_ok_and(|value| value.get(POSITIONS).is_some())
    }

    /// The scene of each photograph, in units of half the width of the material.
    ///
    /// # Errors
    /// The problem, where the numbers make no sense.
    pub fn scenes(&self) -> Result<Vec<Scene>, String> {
        if !self.im_size.is_finite() || self.im_size <= 0.0 {
            return Err(format!("its im_size is {}, not a width", self.im_size));
        }
        if self.camera_pos.len() != self.light_pos.len() {
            let [cameras, lights] = [self.camera_pos.len(), self.light_pos.len()];
            return Err(format!("it lists {cameras} camera_pos and {lights} light_pos"));
        }
        let scaled = |position: [f64; 3]| position.map(|c| c * 2.0 / self.im_size);
        let scene = |index: usize| {
            let missing = || format!("its idx names position {index} of {}", self.camera_pos.len());
            let camera = *self.camera_pos.get(index).ok_or_else(missing)?;
            Ok(Scene { kind: Kind::Near, view: scaled(camera), light: scaled(self.light_pos[index]) })
        };
        self.numbers().into_iter().map(scene).collect()
    }

    /// The numbers of the photographs, in the order of [`Self::scenes`].
    pub fn numbers(&self) -> Vec<usize> {
        self.idx.clone().unwrap_or_else(|| (0..self.camera_pos.len()).collect())
    }

    /// What the four files of [`TEXTS`] hold, in their order: the photographs are beside them.
    ///
    /// # Errors
    /// The problem, with the name of the file.
    pub fn of_texts([cameras, lights, size, power]: [&str; 4]) -> Result<Self, String> {
        let [cameras_name, lights_name, size_name, power_name] = TEXTS;
        let im_size = match numbers::<1>(size_name, size)?.as_slice() {
            [[size]] => *size,
            lines => return Err(format!("{size_name}: expected one line, found {}", lines.len())),
        };
        let light_pow = match numbers::<3>(power_name, power)?.as_slice() {
            [power] => *power,
            lines => return Err(format!("{power_name}: expected one line, found {}", lines.len())),
        };
        Ok(Self {
            im_size,
            camera_pos: numbers(cameras_name, cameras)?,
            light_pos: numbers(lights_name, lights)?,
            idx: None,
            light_pow: Some(light_pow),
            target_dir: Some(PathBuf::new()),
        })
    }

    /// The power of the light, where there is one.
    ///
    /// # Errors
    /// The problem, where it is no power.
    pub fn power(&self) -> Result<Option<LightPower>, String> {
        let Some(power) = self.light_pow else { return Ok(None) };
        let [r, g, b] = power;
        if !power.iter().all(|channel| channel.is_finite() && *channel > 0.0) {
            return Err(format!("expected a light_pow of three numbers above 0, found {r}, {g}, {b}"));
        }
        let half_width = 0.5 * self.im_size;
        let scaled = power.map(|channel| channel / half_width.powi(2));
        if !power.iter().chain(&scaled).all(|channel| POWERS.contains(channel)) {
            return Err(format!(
                "expected a light_pow from 1e-30 to 1e30, also with half of im_size as the unit of length; found {r:e}, {g:e}, {b:e} \
                and an im_size of {:e}",
                self.im_size
            ));
        }
        let mean = power.iter().sum::<f64>() / 3.0;
        Ok(Some(LightPower { mean: mean / half_width.powi(2), colour: power.map(|channel| channel / mean) }))
    }
}

/// The lines of the file `name`: `N` numbers each, separated by commas.
fn numbers<const N: usize>(name: &str, text: &str) -> Result<Vec<[f64; N]>, String> {
    let line = |(index, line): (usize, &str)| {
        let numbers: Option<Vec<f64>> = line.split(',').map(|number| number.trim().parse().ok()).collect();
        numbers.and_then(|numbers| numbers.try_into().ok()).ok_or_else(|| {
            let expected = if N == 1 { "a number".to_owned() } else { format!("{N} numbers, with commas") };
            format!("{name}, line {}: expected {expected}, found {line:?}", index + 1)
        })
    };
    text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty()).map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_files_have_a_line_per_photograph() {
        let cameras = "1.0125,0.2928,16.7058\n 2.9924, 3.4483, 16.3559\n\n";
        let lights = "1,0,16\r\n2,3,1.6e1\r\n";
        let of = |size, power| Calibration::of_texts([cameras, lights, size, power]);
        let found = of("6.8480\n", "1500.0000,1500.0000,1500.0000\n").unwrap();
        assert_eq!((found.camera_pos.len(), found.numbers()), (2, vec![0, 1]));
        assert_eq!(found.scenes().unwrap()[1].light, [2.0, 3.0, 16.0].map(|x| x * 2.0 / 6.848));
        for (size, power, problem) in [
            ("", "1,1,1", "image_size.txt: expected one line, found 0"),
            ("6\n7", "1,1,1", "image_size.txt: expected one line, found 2"),
            ("6 cm", "1,1,1", "image_size.txt, line 1: expected a number, found \"6 cm\""),
            ("6", "1,1", "light_power.txt, line 1: expected 3 numbers"),
        ] {
            let error = of(size, power).unwrap_err();
            assert!(error.contains(problem), "{error}");
        }
    }

    #[test]
    fn the_power_of_a_light_is_in_half_widths() {
        let of = |power: &str| {
            let text = format!(
                r#"{{"im_size": 4, "camera_pos": [], "light_pos": [], "light_pow": {power}, "_comment": "cm"}}"#
            );
            serde_json::from_str::<Calibration>(&text).unwrap().power()
        };
        let expected = LightPower { mean: 375.0, colour: [2.0, 0.5, 0.5] };
        assert_eq!(of("[3000, 750, 750]"), Ok(Some(expected)));
        assert_eq!(of("null"), Ok(None));
        assert!(of("[1500, 0, 1500]").unwrap_err().contains("above 0, found 1500, 0, 1500"));
        for power in ["[1500, 1e-320, 1500]", "[1500, 1e40, 1500]"] {
            assert!(of(power).unwrap_err().contains("from 1e-30 to 1e30"), "{power}");
        }
    }
}
