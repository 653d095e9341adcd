//! Packed images: square tiles beside or above one another, in the order that the tile of the normals tells.

use std::ops::Range;
use std::path::Path;

use crate::error::Error;
use crate::read::options::{Albedo, Energy, NormalY, Order, Preset, ReadOptions, Role, Roughness, TileGrid};
use crate::read::raster::Raster;
use crate::read::raster::measure::{NORMAL_AT_LEAST, normal_score, signed_normal_score};
use crate::read::record::{Assumption, Certainty, Note, Reason, SpecifiedBy, StorageConvention, What};
use crate::read::stored::{Inferred, MapsByRole, StoredMap, StoredMaterial};

/// Of a picture of diffuse alone.
const ROUGHNESS: f32 = 0.5;

/// Where the tiles of one material are: the order, and the number of the first tile.
#[derive(Clone, Debug)]
struct Tiling {
    grid: TileGrid,
    order: Order,
    first: usize,
    why: Reason,
    certainty: Certainty,
}

/// Takes a packed image apart.
///
/// # Errors
/// [`Error::NotPacked`] where it does not have the shape of one, or no tile looks like normals in a shape that needs it.
pub(super) fn material(
    path: &Path,
    image: &Raster,
    meaning: Option<&str>,
    options: &ReadOptions,
) -> Result<StoredMaterial, Error> {
    let name = path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
    let own = meaning
        .and_then(|text| WrittenEncoding::of(text, image))
        .filter(|_| options.order.is_none() && options.grid.is_none());
    let chosen = own.as_ref().map(WrittenEncoding::tiling).or_else(|| choose(image, &name, options));
    let refused = || refusal(path, image, options);
    let Tiling { grid, order, first, why, certainty } = chosen.ok_or_else(refused)?;
    if is_stack(grid, order.len()) {
        options.exemplar_of(grid.rows, path)?;
    }
    let tile = grid.tile(image.size()).ok_or_else(refused)?;
    let mut maps = MapsByRole::default();
    for (place, role) in order.roles().enumerate() {
        let number = first + place;
        let raster = image.crop(grid.corner(number, tile), tile);
        maps.add(role, StoredMap { raster, file: path.to_owned(), part: format!("tile {}", number + 1) });
    }
    if !maps.has(Role::Roughness) {
        maps.add(Role::Roughness, StoredMap::constant(path, &[ROUGHNESS]));
    }
    let mut found = maps.material(path, name, "", options)?;
    if order == Order::D {
        let chosen = format!("roughness {ROUGHNESS}");
        let missing = Assumption::new(What::Missing, chosen, Reason::DiffuseAlone, Certainty::Unsure);
        found.assumptions.push(missing);
    }
    match own {
        Some(own) => own.add_to(&mut found),
        None => add_usual(&mut found, order, image),
    }
    let maps = order.roles().map(Role::name).collect::<Vec<_>>().join(", ");
    let chosen = format!("{order} in {grid} tiles of {} x {} ({maps})", tile[0], tile[1]);
    found.assumptions.insert(0, Assumption::new(What::Layout, chosen, why, certainty));
    let photos = if grid.rows == 1 || grid.columns == 1 { first } else { 0 };
    if photos > 0 {
        found.notes.push(Note::Photos { count: photos, tiles: grid.count() });
    }
    if is_stack(grid, order.len()) {
        let index = first / grid.columns;
        found.notes.push(Note::Rows { count: grid.rows, index });
    }
    Ok(found)
}

/// The encoding that this program wrote into a strip, as in `ndrs, diffuse linear, ..., energy scaled`.
struct WrittenEncoding {
    order: Order,
    diffuse: Albedo,
    specular: Albedo,
    roughness: Roughness,
    normal_y: NormalY,
    energy: Energy,
}

impl WrittenEncoding {
    /// `None` where the text or the shape of the picture is none that this program writes.
    fn of(text: &str, image: &Raster) -> Option<Self> {
        let mut parts = text.split(", ");
        let order: Order = parts.next()?.parse().ok()?;
        let mut next = |key: &str| parts.next()?.strip_prefix(key)?.strip_prefix(' ').map(str::to_owned);
        let own = Self {
            order,
            diffuse: next("diffuse")?.parse().ok()?,
            specular: next("specular")?.parse().ok()?,
            roughness: next("roughness")?.parse().ok()?,
            normal_y: next("normal y")?.parse().ok()?,
            energy: next("energy")?.parse().ok()?,
        };
        (image.width == order.len() * (image.width / order.len())).then_some(own)
    }

    fn tiling(&self) -> Tiling {
        let grid = TileGrid { columns: self.order.len(), rows: 1 };
        Tiling {
            grid,
            order: self.order,
            first: 0,
            why: StorageConvention::NativeText.into(),
            certainty: Certainty::Sure,
        }
    }

    fn add_to(&self, found: &mut StoredMaterial) {
        fn sure<T>(value: T) -> Inferred<T> {
            Some((value, StorageConvention::NativeText.into(), Certainty::Sure))
        }
        found.inferred.albedo = sure(self.diffuse);
        found.inferred.specular = sure(self.specular);
        found.inferred.roughness = sure(self.roughness);
        found.inferred.normal_y = sure(self.normal_y);
        found.inferred.energy = sure(self.energy);
    }
}

/// Adds the encoding that goes with an order; nothing where none is known.
fn add_usual(found: &mut StoredMaterial, order: Order, image: &Raster) {
    let (albedo, roughness, why) = match order {
        _ if image.is_float() => (Albedo::Linear, Roughness::R, StorageConvention::Floats),
        Order::NDRS => (Albedo::Linear, Roughness::R, StorageConvention::DeschaintreOrder),
        Order::DNRS | Order::DNR | Order::NDSR => {
            (Albedo::Gamma22, Roughness::Gamma22, StorageConvention::MaterialGanOrder)
        }
        Order::DSRN => (Albedo::Gamma22, Roughness::R, StorageConvention::MatFusionOrder),
        Order::IBRM => (Albedo::Srgb, Roughness::R, StorageConvention::SvbrdfEvaluationOrder),
        _ => return,
    };
    let certainty = if order == Order::IBRM { Certainty::Unsure } else { Certainty::Likely };
    found.inferred.albedo = Some((albedo, why.into(), certainty));
    found.inferred.specular = found.inferred.albedo.clone();
    found.inferred.roughness = Some((roughness, why.into(), Certainty::Likely));
    let why = StorageConvention::PackedNormals;
    found.inferred.normal_y = Some((NormalY::Up, why.into(), Certainty::Likely));
}

/// Every way to divide the image into square tiles, in the order in which they are tried; or the one that was specified.
fn grids(image: &Raster, options: &ReadOptions) -> Vec<TileGrid> {
    if let Some(grid) = options.grid {
        return grid.tile(image.size()).map(|_| grid).into_iter().collect();
    }
    let (w, h) = (image.width, image.height);
    let grid = |columns: usize, rows: usize| {
        let grid = TileGrid { columns, rows };
        grid.tile([w, h]).filter(|tile| tile[0] == tile[1]).map(|_| grid)
    };
    let strip = (w % h == 0).then(|| w / h).filter(|k| (3..=64).contains(k)).and_then(|k| grid(k, 1));
    let upright = (h % w == 0).then(|| h / w).filter(|k| (3..=64).contains(k)).and_then(|k| grid(1, k));
    let stack = |columns: usize| {
        let rows = (w >= columns).then(|| h / (w / columns))?;
        grid(columns, rows.max(1)).filter(|g| g.rows > 1)
    };
    [strip, stack(4), stack(5), upright, grid(2, 2)].into_iter().flatten().collect()
}

fn choose(image: &Raster, name: &str, options: &ReadOptions) -> Option<Tiling> {
    let grids = grids(image, options);
    if let Some(order) = options.order {
        let whole = (order.len() == 1 && options.grid.is_none()).then_some(TileGrid { columns: 1, rows: 1 });
        let grid = whole.or_else(|| grids.iter().copied().find(|grid| grid.count() >= order.len()))?;
        return Some(placed(grid, order, options, Reason::Specified(SpecifiedBy::Caller), Certainty::Given));
    }
    if let Some(choice) = grids.iter().find_map(|&grid| recognized(image, grid, options)) {
        return Some(choice);
    }
    // In a strip, or in the grid that was specified, the usual order; but a picture of normals all over is no strip.
    let usual = |g: &&TileGrid| (g.rows == 1 || options.grid.is_some()) && g.count() >= 4;
    let grid = *grids.iter().find(usual)?;
    let scores = scores(image, grid, 0..grid.count());
    if scores.iter().all(|&score| score >= NORMAL_AT_LEAST) {
        return None;
    }
    let none = scores.iter().all(|&score| score < NORMAL_AT_LEAST);
    let (order, why) = match options.preset.and_then(Preset::order) {
        Some(order) => (order, Reason::PresetOrder),
        None if none && grid.columns == 4 && name.to_lowercase().contains("svbrdf") => {
            (Order::IBRM, Reason::SvbrdfEvaluationName)
        }
        None => (Order::NDRS, Reason::UsualOrder),
    };
    Some(placed(grid, order, options, why, Certainty::Unsure))
}

/// Whether every row of `grid` is a material of `count` tiles.
fn is_stack(grid: TileGrid, count: usize) -> bool {
    grid.rows > 1 && grid.columns >= count.max(3)
}

/// `order` in `grid`: in a strip at its end, after the photos; in a stack in the row that the user chose.
fn placed(grid: TileGrid, order: Order, options: &ReadOptions, why: Reason, certainty: Certainty) -> Tiling {
    let end = if is_stack(grid, order.len()) {
        (options.exemplar.unwrap_or(0).min(grid.rows - 1) + 1) * grid.columns
    } else {
        grid.count()
    };
    Tiling { grid, order, first: end - order.len(), why, certainty }
}

/// How much each of the tiles looks like normals, from 0 to 1.
fn scores(image: &Raster, grid: TileGrid, tiles: Range<usize>) -> Vec<f64> {
    let Some(size) = grid.tile(image.size()) else { return Vec::new() };
    let score = |number: usize| {
        let tile = image.crop(grid.corner(number, size), size);
        let signed = if image.is_float() { signed_normal_score(&tile) } else { 0.0 };
        normal_score(&tile).max(signed)
    };
    tiles.map(score).collect()
}

/// Whether in each row the tile at `place` looks like normals, and most of all tiles: else one picture of normals with
/// flat and steep parts passes for a stack.
fn every_row_has_normals(image: &Raster, grid: TileGrid, place: usize) -> bool {
    (0..grid.rows).all(|row| {
        let start = row * grid.columns;
        let scores = scores(image, grid, start..start + grid.columns);
        scores[place] >= NORMAL_AT_LEAST && scores.iter().all(|&score| score <= scores[place])
    })
}

/// The order by the one tile that looks like normals; `None` where none or several do.
fn recognized(image: &Raster, grid: TileGrid, options: &ReadOptions) -> Option<Tiling> {
    let (start, count) = if is_stack(grid, 0) {
        (options.exemplar.unwrap_or(0).min(grid.rows - 1) * grid.columns, grid.columns)
    } else {
        (0, grid.count())
    };
    let scores = scores(image, grid, start..start + count);
    let (place, best) = scores.iter().copied().enumerate().max_by(|a, b| a.1.total_cmp(&b.1))?;
    let others = scores.iter().copied().enumerate().filter(|&(i, _)| i != place);
    let second = others.map(|(_, score)| score).fold(0.0, f64::max);
    if best < NORMAL_AT_LEAST || second >= NORMAL_AT_LEAST {
        return None;
    }
    let square = grid.columns == 2 && grid.rows == 2;
    let order = match (count, place) {
        (3, 1) => Order::DNR,
        (4, 0) if square => Order::NDSR,
        (4, 3) => Order::DSRN,
        (4, 0) => Order::NDRS,
        (4, 1) if !square => Order::DNRS,
        (5.., place) if place + 4 == count => Order::NDRS,
        _ => return None,
    };
    if is_stack(grid, 0) && !every_row_has_normals(image, grid, place) {
        return None;
    }
    let why = Reason::NormalTile { number: place + 1, share: best, next: second };
    Some(Tiling { grid, order, first: start + count - order.len(), why, certainty: Certainty::Likely })
}

fn refusal(path: &Path, image: &Raster, options: &ReadOptions) -> Error {
    let grid = options.grid.map(|grid| [grid.columns, grid.rows]);
    Error::NotPacked { path: path.to_owned(), size: image.size(), grid }
}
