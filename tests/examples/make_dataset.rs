//! Makes a data set of materials and methods from the built-in generator: `cargo run --release --example make_dataset -- FOLDER
//! [METHODS] [MATERIALS] [SIDE]` writes `FOLDER/gt` and `FOLDER/method_1` and so on, as packed pictures.
//!
//! A method has its shares of blurred normals and of wrong roughness, which differ by material; the fifth is the best but on every seventh
//! material, and lacks every thirteenth.

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
    for index in 0..materials {
        for method in 0..=methods {
            let Some(shares) = shares(method, index) else { continue };
            let folder = folder.join(if method == 0 { "gt".to_owned() } else { format!("method_{method}") });
            fs::create_dir_all(&folder)?;
            let name = format!("material_{index:03}");
            let path = folder.join(format!("{name}.png"));
            let planes = varied([&truth, &faults[0], &faults[1]], shares, index);
            let material =
                Material::<f64>::new(name, SIDE, SIDE, planes)?.cast::<f32>().resized([side, side])?;
            write(&material, &path, FileKind::new(&path, &WriteOptions::default())?)?;
        }
    }
    Ok(())
}

/// How much of blurred normals and of wrong roughness a method has on a material; `None` where it has no prediction.
fn shares(method: usize, index: usize) -> Option<[f64; 2]> {
    // Between 0 and 1, and different for every pair.
    let own = ((index * 7 + method * 3) % 11) as f64 / 11.0;
    match method {
        0 => Some([0.0, 0.0]),
        1 => Some([0.25 + 0.1 * own, 0.25 + 0.1 * own]),
        5 if index % 13 == 12 => None,
        5 if index % 7 == 6 => Some([0.1, 1.0]),
        5 => Some([0.1 + 0.1 * own, 0.1]),
        _ => Some([own, (method % 5) as f64 / 5.0]),
    }
}

/// The truth with a share of each fault, moved, in other colours and of another roughness: another material of the same kind.
fn varied(planes: [&Planes<f64>; 3], shares: [f64; 2], index: usize) -> Planes<f64> {
    let mixed = |of: &dyn Fn(&Planes<f64>) -> &Vec<f64>| -> Vec<f64> {
        let [truth, a, b] = planes.map(of);
        let (right, down) = (index * 37 % SIDE, index * 53 % SIDE);
        let from = |i: usize| (i / SIDE + down) % SIDE * SIDE + (i % SIDE + right) % SIDE;
        let mix = |i: usize| truth[i] + shares[0] * (a[i] - truth[i]) + shares[1] * (b[i] - truth[i]);
        (0..SIDE * SIDE).map(|i| mix(from(i))).collect()
    };
    let mut normal = [0, 1, 2].map(|axis| mixed(&|planes| &planes.normal[axis]));
    for i in 0..SIDE * SIDE {
        let length = normal.iter().map(|plane| plane[i] * plane[i]).sum::<f64>().sqrt();
        normal.iter_mut().for_each(|plane| plane[i] /= length);
    }
    let tint = |channel: usize| 0.45 + 0.55 * ((index * (channel + 2)) % 5) as f64 / 4.0;
    let scale = 0.6 + 0.7 * (index % 9) as f64 / 8.0;
    Planes {
        normal,
        diffuse: [0, 1, 2].map(|channel| {
            let plane = mixed(&|planes| &planes.diffuse[(channel + index) % 3]);
            plane.into_iter().map(|x| x * tint(channel)).collect()
        }),
        specular: [0, 1, 2].map(|channel| mixed(&|planes| &planes.specular[channel])),
        roughness: mixed(&|planes| &planes.roughness)
            .into_iter()
            .map(|r| (r * scale).clamp(0.02, 1.0))
            .collect(),
    }
}
