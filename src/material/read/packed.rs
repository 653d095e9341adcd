//! Packed images: square tiles beside or above one another. The tile that looks like normals tells the order.

use std::path::Path;

use super::assumption::{Assumption, Certainty, What};
use super::evidence::{NORMAL_AT_LEAST, normal_score, signed_normal_score};
use super::found::{Found, Pictures, Source};
use super::names::Role;
use super::options::{Albedo, NormalY, Order, ReadOptions, Roughness};
use super::raster::Raster;
use crate::error::Error;

/// How an image is divided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Grid {
    columns: usize,
    rows: usize,
    side: usize,
}

/// Where the tiles of one material are: the order, and the number of the first tile.
#[derive(Clone, Debug)]
struct Choice {
    grid: Grid,
    order: Order,
    first: usize,
    why: String,
    certainty: Certainty,
}

/// Takes a packed image apart, or says that it is none.
///
/// # Errors
/// [`Error::NotAMaterial`] where it has not the shape of one, or no tile looks like normals in a shape that needs it.
pub fn unpack(path: &Path, image: &Raster, options: &ReadOptions) -> Result<Found, Error> {
    let choice = choose(image, options).ok_or_else(|| refusal(path, image))?;
    let Choice { grid, order, first, why, certainty } = choice;
    let mut pictures = Pictures::default();
    for (place, role) in roles(order).iter().enumerate() {
        let number = first + place;
        let corner = [number % grid.columns * grid.side, number / grid.columns * grid.side];
        let raster = image.crop(corner, [grid.side; 2]);
        pictures.add(*role, Source { raster, file: path.to_owned(), part: format!("tile {}", number + 1) });
    }
    let name = path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
    let mut found = pictures.into_found(path, name, "")?;
    hint(&mut found, order, image);
    let Grid { columns, rows, side } = grid;
    let certainty = if options.order.is_some() { Certainty::Given } else { certainty };
    let chosen = format!("{order} in {columns} x {rows} tiles of {side} x {side}");
    found.assumptions.insert(0, Assumption::new(What::Layout, chosen, why, certainty));
    let photos = if rows == 1 || columns == 1 { first } else { 0 };
    if photos > 0 {
        found
            .notes
            .push(format!("The first {photos} of {} tiles are taken as photos and ignored.", columns * rows));
    }
    if columns >= 4 && rows > 1 {
        found.notes.push(format!(
            "The image holds {rows} materials, one a row; this is number {} from 0. Another: --exemplar.",
            first / columns
        ));
    }
    Ok(found)
}

fn roles(order: Order) -> &'static [Role] {
    match order {
        Order::Ndrs => &[Role::Normal, Role::Diffuse, Role::Roughness, Role::Specular],
        Order::Dnrs => &[Role::Diffuse, Role::Normal, Role::Roughness, Role::Specular],
        Order::Dnr => &[Role::Diffuse, Role::Normal, Role::Roughness],
        Order::Dsrn => &[Role::Diffuse, Role::Specular, Role::Roughness, Role::Normal],
        Order::Ndsr => &[Role::Normal, Role::Diffuse, Role::Specular, Role::Roughness],
    }
}

/// What goes with an order, by those who use it.
fn hint(found: &mut Found, order: Order, image: &Raster) {
    let (albedo, roughness, why) = match order {
        _ if image.is_float() => (Albedo::Linear, Roughness::R, "floats are linear"),
        Order::Ndrs => (Albedo::Linear, Roughness::R, "so do Deschaintre et al. store this order"),
        Order::Dnrs | Order::Dnr | Order::Ndsr => {
            (Albedo::Gamma22, Roughness::Gamma22, "so do MaterialGAN and its heirs store this order")
        }
        Order::Dsrn => (Albedo::Gamma22, Roughness::R, "so does MatFusion store this order"),
    };
    found.hints.albedo = Some((albedo, why.to_owned(), Certainty::Likely));
    found.hints.specular = found.hints.albedo.clone();
    found.hints.roughness = Some((roughness, why.to_owned(), Certainty::Likely));
    let why = "so do all who are known to pack maps";
    found.hints.normal_y = Some((NormalY::Up, why.to_owned(), Certainty::Likely));
}

/// Every way to divide the image, in the order in which they are tried.
fn grids(image: &Raster) -> Vec<Grid> {
    let (w, h) = (image.width, image.height);
    let grid = |columns: usize, rows: usize| {
        let fits = w % columns == 0 && h % rows == 0 && w / columns == h / rows;
        fits.then_some(Grid { columns, rows, side: w / columns })
    };
    let strip = (w % h == 0).then(|| w / h).filter(|k| (3..=64).contains(k)).and_then(|k| grid(k, 1));
    let upright = (h % w == 0).then(|| h / w).filter(|k| (3..=64).contains(k)).and_then(|k| grid(1, k));
    let stack =
        (w % 4 == 0 && w >= 4).then(|| grid(4, (h / (w / 4)).max(1))).flatten().filter(|g| g.rows > 1);
    [strip, stack, upright, grid(2, 2)].into_iter().flatten().collect()
}

fn choose(image: &Raster, options: &ReadOptions) -> Option<Choice> {
    let grids = grids(image);
    if let Some(order) = options.order {
        let count = roles(order).len();
        let grid = *grids.iter().find(|g| g.columns * g.rows >= count)?;
        return Some(placed(grid, order, options, "as you said".to_owned(), Certainty::Given));
    }
    grids.iter().find_map(|&grid| recognized(image, grid, options)).or_else(|| {
        let grid = *grids.iter().find(|g| g.rows == 1 && g.columns >= 4)?;
        let why = "no tile looks like normals more than all others; this is the usual order".to_owned();
        Some(placed(grid, Order::Ndrs, options, why, Certainty::Unsure))
    })
}

/// `order` in `grid`: in a strip at its end, after the photos; in a stack in the row that the user chose.
fn placed(grid: Grid, order: Order, options: &ReadOptions, why: String, certainty: Certainty) -> Choice {
    let count = roles(order).len();
    let first = if grid.rows > 1 && grid.columns >= 4 {
        options.exemplar.min(grid.rows - 1) * grid.columns
    } else {
        grid.columns * grid.rows - count
    };
    Choice { grid, order, first, why, certainty }
}

/// The order by the one tile that looks like normals; `None` where none or several do.
fn recognized(image: &Raster, grid: Grid, options: &ReadOptions) -> Option<Choice> {
    let stacked = grid.rows > 1 && grid.columns >= 4;
    let (start, count) = if stacked {
        (options.exemplar.min(grid.rows - 1) * grid.columns, grid.columns)
    } else {
        (0, grid.columns * grid.rows)
    };
    let score = |number: usize| {
        let corner = [number % grid.columns * grid.side, number / grid.columns * grid.side];
        let tile = image.crop(corner, [grid.side; 2]);
        let signed = if image.is_float() { signed_normal_score(&tile) } else { 0.0 };
        normal_score(&tile).max(signed)
    };
    let scores: Vec<f64> = (start..start + count).map(score).collect();
    let (place, best) = scores.iter().copied().enumerate().max_by(|a, b| a.1.total_cmp(&b.1))?;
    let second =
        scores.iter().copied().enumerate().filter(|&(i, _)| i != place).map(|(_, s)| s).fold(0.0, f64::max);
    if best < NORMAL_AT_LEAST || second >= NORMAL_AT_LEAST {
        return None;
    }
    let square = grid.columns == 2 && grid.rows == 2;
    let order = match (count, place) {
        (3, 1) => Order::Dnr,
        (4, 0) if square => Order::Ndsr,
        (4, 3) if square => Order::Dsrn,
        (4, 0) => Order::Ndrs,
        (4, 1) if !square => Order::Dnrs,
        (4, 3) => Order::Dsrn,
        (5.., place) if place + 4 == count => Order::Ndrs,
        _ => return None,
    };
    let why = format!(
        "tile {} looks like normals ({:.0} % of its pixels), the next best {:.0} %",
        place + 1,
        100.0 * best,
        100.0 * second
    );
    let first = start + count - roles(order).len();
    Some(Choice { grid, order, first, why, certainty: Certainty::Likely })
}

fn refusal(path: &Path, image: &Raster) -> Error {
    Error::NotAMaterial {
        path: path.to_owned(),
        expected:
            "a packed strip of square tiles, any photos and then normal | diffuse | roughness | specular, \
            4 or more times as wide as high, or another grid in which one tile looks like normals"
                .to_owned(),
        found: format!("{} x {} pixels without one", image.width, image.height),
        remedy: "correct the strip, say its --order, or give a folder or prefix of one file a map".to_owned(),
    }
}
