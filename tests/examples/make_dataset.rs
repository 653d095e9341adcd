//! Makes a data set of materials and methods from the built-in generator: `cargo run --release --example make_dataset -- FOLDER
//! [METHODS] [MATERIALS] [SIDE]` writes `FOLDER/gt` and `FOLDER/method_1` and so on, as packed pictures.
//!
//! The first method is wrong by a little everywhere, the second blurs normals, the third is wrong in roughness, the fourth in both;
//! the fifth is the best but on every seventh material, where its roughness fails, and lacks every thirteenth. Further ones are mixtures.

use std::error::Error;
use std::fs;
use std::path::Path;

use svbrdf_core::material::{Material, Planes};
use svbrdf_files::samples::generate::{SIDE, blurred_normals, ground_truth, wrong_roughness};
use svbrdf_files::write::{FileKind, WriteOptions, write};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |place: usize, default: usize| -> Result<usize, Box<dyn Error>> {
        Ok(arguments.get(place).map(|text| text.parse()).transpose()?.unwrap_or(default))
    };
    let folder = Path::new(arguments.first().ok_or("give a folder to write")?);
    let (methods, materials, side) = (number(1, 5)?, number(2, 40)?, number(3, 256)?);
    let truth = ground_truth();
    let faults = [blurred_normals(&truth), wrong_roughness(&truth)];
    for name in std::iter::once("gt".to_owned()).chain((1..=methods).map(|method| format!("method_{method}")))
    {
        fs::create_dir_all(folder.join(name))?;
    }
    for index in 0..materials {
        let name = format!("material_{index:03}");
        let save = |folder_name: &str, planes: &Planes<f64>| -> Result<(), Box<dyn Error>> {
            let path = folder.join(folder_name).join(format!("{name}.png"));
            let material =
                Material::<f64>::new(name.as_str(), SIDE, SIDE, varied(planes, index))?.cast::<f32>();
            write(&material.resized([side, side])?, &path, FileKind::new(&path, &WriteOptions::default())?)?;
            Ok(())
        };
        save("gt", &truth)?;
        for method in 0..methods {
            if let Some(shares) = shares(method, index) {
                save(&format!("method_{}", method + 1), &mixed(&truth, &faults, shares))?;
            }
        }
    }
    Ok(())
}

/// How much of blurred normals and of wrong roughness a method has on a material; `None` where it has no prediction.
fn shares(method: usize, index: usize) -> Option<[f64; 2]> {
    // Between 0 and 1, and different for every pair.
    let own = ((index * 7 + method * 3) % 11) as f64 / 11.0;
    match method {
        0 => Some([0.25 + 0.1 * own, 0.25 + 0.1 * own]),
        1 => Some([0.5 + 0.5 * own, 0.05]),
        2 => Some([0.05, 0.5 + 0.5 * own]),
        3 => Some([0.6 + 0.4 * own, 0.6]),
        4 if index % 13 == 12 => None,
        4 if index % 7 == 6 => Some([0.1, 1.0]),
        4 => Some([0.1 + 0.1 * own, 0.1]),
        _ => Some([own, (method % 5) as f64 / 5.0]),
    }
}

/// The truth with a share of each fault.
fn mixed(truth: &Planes<f64>, faults: &[Planes<f64>; 2], shares: [f64; 2]) -> Planes<f64> {
    let mix = |of: &dyn Fn(&Planes<f64>) -> &Vec<f64>| -> Vec<f64> {
        let planes = [of(truth), of(&faults[0]), of(&faults[1])];
        (0..planes[0].len())
            .map(|i| {
                let [true_value, a, b] = planes.map(|plane| plane[i]);
                true_value + shares[0] * (a - true_value) + shares[1] * (b - true_value)
            })
            .collect()
    };
    let mut normal = [0, 1, 2].map(|axis| mix(&|planes| &planes.normal[axis]));
    for i in 0..normal[0].len() {
        let length = normal.iter().map(|plane| plane[i] * plane[i]).sum::<f64>().sqrt();
        normal.iter_mut().for_each(|plane| plane[i] /= length);
    }
    Planes {
        normal,
        diffuse: [0, 1, 2].map(|channel| mix(&|planes| &planes.diffuse[channel])),
        specular: [0, 1, 2].map(|channel| mix(&|planes| &planes.specular[channel])),
        roughness: mix(&|planes| &planes.roughness),
    }
}

/// The planes moved, in other colours and of another roughness: another material of the same kind.
fn varied(planes: &Planes<f64>, index: usize) -> Planes<f64> {
    let moved = |plane: &Vec<f64>| -> Vec<f64> {
        let (right, down) = (index * 37 % SIDE, index * 53 % SIDE);
        (0..SIDE * SIDE).map(|i| plane[(i / SIDE + down) % SIDE * SIDE + (i % SIDE + right) % SIDE]).collect()
    };
    let tint = |channel: usize| 0.45 + 0.55 * ((index * (channel + 2)) % 5) as f64 / 4.0;
    let scale = 0.6 + 0.7 * (index % 9) as f64 / 8.0;
    Planes {
        normal: planes.normal.each_ref().map(moved),
        diffuse: [0, 1, 2].map(|channel| {
            moved(&planes.diffuse[(channel + index) % 3]).into_iter().map(|x| x * tint(channel)).collect()
        }),
        specular: planes.specular.each_ref().map(moved),
        roughness: moved(&planes.roughness).into_iter().map(|r| (r * scale).clamp(0.02, 1.0)).collect(),
    }
}
