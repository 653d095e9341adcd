//! Scenes of published evaluations, by name.

use std::f64::consts::TAU;

use super::hemisphere_points::HEMISPHERE_POINTS;
use super::scene::{Kind, Scene};
use crate::error::Error;

/// Distance of the light and the camera in the evaluation of MatFusion from the centre of the material, whose half width is 1.
const MATFUSION_DISTANCE: f64 = 2.41;

/// A set of scenes with a name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NamedScenes {
    /// [`flash`].
    Flash {
        /// The angle that the width of the material spans at the camera.
        fov_degrees: f64,
    },
    /// [`flash_9`].
    Flash9,
    /// The 128 scenes of MatFusion.
    Hemisphere,
}

impl NamedScenes {
    /// Every set.
    pub const ALL: [Self; 3] =
        [Self::Flash { fov_degrees: Self::FOV_DEGREES }, Self::Flash9, Self::Hemisphere];

    /// The field of view of [`NamedScenes::Flash`] where none is specified: DeepBasis (Wang et al. 2023) puts its flash at 2.414,
    /// MatFusion (Sartor and Peers 2023) at 2.41.
    pub const FOV_DEGREES: f64 = 45.0;

    /// The set of this name; `fov_degrees` is the field of view of `flash`.
    ///
    /// # Errors
    /// [`Error::UnknownName`].
    pub fn named(name: &str, fov_degrees: f64) -> Result<Self, Error> {
        match name {
            "flash" => Ok(Self::Flash { fov_degrees }),
            "flash-9" => Ok(Self::Flash9),
            "hemisphere" => Ok(Self::Hemisphere),
            _ => Err(Error::unknown_name("set of scenes", name, "flash, flash-9, hemisphere")),
        }
    }

    /// The name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Flash { .. } => "flash",
            Self::Flash9 => "flash-9",
            Self::Hemisphere => "hemisphere",
        }
    }

    /// The scenes.
    ///
    /// # Errors
    /// As [`flash`].
    pub fn scenes(self) -> Result<Vec<Scene>, Error> {
        match self {
            Self::Flash { fov_degrees } => Ok(vec![flash(fov_degrees)?]),
            Self::Flash9 => Ok(flash_9().into()),
            Self::Hemisphere => Ok(hemisphere()),
        }
    }

    /// The set that `scenes` are, in the same order.
    pub fn of(scenes: &[Scene]) -> Option<Self> {
        match scenes {
            [Scene { kind: Kind::Near, view: [0.0, 0.0, height], light }]
                if light == &[0.0, 0.0, *height] && *height > 0.0 =>
            {
                Some(Self::Flash { fov_degrees: 2.0 * height.recip().atan().to_degrees() })
            }
            _ if scenes == flash_9() => Some(Self::Flash9),
            _ if scenes == hemisphere() => Some(Self::Hemisphere),
            _ => None,
        }
    }

    /// What the scenes are, for people.
    pub fn description(self) -> String {
        match self {
            Self::Flash { fov_degrees } => {
                let distance = (0.5 * fov_degrees.to_radians()).tan().recip();
                format!("flash at the camera, distance {distance:.3}, field of view {fov_degrees:.1} degrees")
            }
            Self::Flash9 => "flash at the camera in nine positions (MaterialGAN)".to_owned(),
            Self::Hemisphere => "lights on the hemisphere, camera above the centre (MatFusion)".to_owned(),
        }
    }
}

/// The scene of a flash at the camera, straight above the middle of the plane, whose width of 2 spans an angle of `fov_degrees`: light
/// and view at the height 1 / tan(fov / 2).
///
/// # Errors
/// [`Error::UnusableScene`] for an angle that is not between 0.1 and 179 degrees.
pub fn flash(fov_degrees: f64) -> Result<Scene, Error> {
    if !(0.1..=179.0).contains(&fov_degrees) {
        let problem = format!("expected a field of view of 0.1 to 179 degrees, found {fov_degrees}");
        return Err(Error::UnusableScene { problem });
    }
    let camera = [0.0, 0.0, (0.5 * fov_degrees.to_radians()).tan().recip()];
    Ok(Scene { kind: Kind::Near, view: camera, light: camera })
}

/// The nine flashes at the camera of MaterialGAN (Guo et al. 2020), row by row from the top left: x and y of -3, 0 and 3 cm, 16 cm above
/// a material of 6.848 cm (`data/random/render.json` of its released code).
pub fn flash_9() -> [Scene; 9] {
    const WIDTH_CM: f64 = 6.848;
    std::array::from_fn(|index| {
        let x = [-3.0, 0.0, 3.0][index % 3];
        let y = [3.0, 0.0, -3.0][index / 3];
        let camera = [x, y, 16.0].map(|cm| cm * 2.0 / WIDTH_CM);
        Scene { kind: Kind::Near, view: camera, light: camera }
    })
}

/// The 128 scenes of MatFusion's evaluation (Sartor and Peers 2023, `score.py`): the light on the upper hemisphere, the camera above the
/// centre, both at the distance 2.41.
fn hemisphere() -> Vec<Scene> {
    let view = [0.0, 0.0, MATFUSION_DISTANCE];
    let scene = |point: &[u32; 2]| {
        let direction = direction(point.map(|x| f64::from(x) / 2.0_f64.powi(30)));
        Scene { kind: Kind::Near, view, light: direction.map(|c| MATFUSION_DISTANCE * c) }
    };
    HEMISPHERE_POINTS.as_chunks::<2>().0.iter().map(scene).collect()
}

/// The direction of a point of the unit square: uniform on the hemisphere for uniform points.
fn direction([u, cosine]: [f64; 2]) -> [f64; 3] {
    let sine = (1.0 - cosine * cosine).sqrt();
    let (sine_phi, cosine_phi) = (u * TAU).sin_cos();
    [sine * cosine_phi, sine * sine_phi, cosine]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_set_has_scenes_that_can_be_rendered_and_is_recognized() {
        for (name, count) in [("flash", 1), ("flash-9", 9), ("hemisphere", 128)] {
            let named = NamedScenes::named(name, 30.0).unwrap();
            let scenes = named.scenes().unwrap();
            assert_eq!((scenes.len(), named.name()), (count, name));
            assert!(scenes.iter().all(|scene| scene.check().is_ok()), "{name}");
            assert_eq!(NamedScenes::of(&scenes).unwrap().description(), named.description());
            let mut other = scenes;
            other[0].light[0] += 0.1;
            assert_eq!(NamedScenes::of(&other), None, "{name}");
        }
        assert!(NamedScenes::named("dome", 30.0).unwrap_err().to_string().contains("flash-9"));
    }

    #[test]
    fn flashes_are_where_the_released_codes_put_them() {
        let at = |fov| flash(fov).unwrap().light[2];
        assert!((at(NamedScenes::FOV_DEGREES) - 2.414).abs() < 1e-3 && (at(90.0) - 1.0).abs() < 1e-12);
        let [first, .., last] = flash_9();
        let expected = [-3.0, 3.0, 16.0].map(|cm| cm / 3.424);
        for (got, expected) in first.light.into_iter().zip(expected) {
            assert!((got - expected).abs() < 1e-12, "{first:?}");
        }
        assert_eq!(last.view, [-first.view[0], -first.view[1], first.view[2]]);
        assert_eq!(flash_9()[4].light[..2], [0.0, 0.0]);
        let distances = hemisphere().into_iter().map(|scene| glam::DVec3::from(scene.light).length());
        assert!(distances.into_iter().all(|distance| (distance - 2.41).abs() < 1e-12));
    }
}
