//! Packed images: square tiles beside or above one another, in the order that the tile of the normals tells.

use std::ops::Range;
use std::path::Path;

use super::tile;
use crate::error::Error;
use crate::read::options::transfer::PACKED;
use crate::read::options::{Albedo, NormalY, Order, Preset, ReadOptions, Role, Roughness, TileGrid};
use crate::read::raster::Raster;
use crate::read::raster::measure::{NORMAL_AT_LEAST, normal_score, signed_normal_score};
use crate::read::record::{Assumption, Certainty, Ground, Note, Reason, What};
use crate::read::stored::{MapsByRole, StoredMap, StoredMaterial, written_albedo};

/// Of a picture of diffuse alone.
const ROUGHNESS: f32 = 0.5;

const DESCHAINTRE: Reason =
    Reason::fixed(Ground::Deschaintre, "Deschaintre et al. store this order in this way");
const MATERIALGAN: Reason =
    Reason::fixed(Ground::Code, "MaterialGAN and its successors store this order in this way");
const MATFUSION: Reason = Reason::fixed(Ground::Code, "MatFusion stores this order in this way");
const SVBRDF_EVALUATION: Reason =
    Reason::fixed(Ground::Measurement, "svbrdf-evaluation appears to store this order in this way");

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
    let is_divided = options.grid.is_some() || (options.order.is_some() && !grids(image, options).is_empty());
    let cut = if is_divided { None } else { tile::without_borders(image) };
    let (image, border) = cut.as_ref().map_or((image, 0), |(tiles, border)| (tiles, *border));
    let own = meaning.and_then(|text| written_albedo(text.strip_prefix(PACKED)?)).filter(|_| {
        image.width.is_multiple_of(Order::NDRS.len()) && options.order.is_none() && options.grid.is_none()
    });
    let chosen = own.map(|_| own_tiling()).or_else(|| choose(image, &name, options));
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
        let why = Reason::measured("a picture of diffuse alone does not say it");
        let missing = Assumption::new(What::Missing, chosen, why, Certainty::Unsure);
        found.assumptions.push(missing);
    }
    match own {
        Some(albedo) => found.specify(albedo, &Role::ALL),
        None => add_usual(&mut found, order, grid, image),
    }
    let maps = order.roles().map(Role::name).collect::<Vec<_>>().join(", ");
    let chosen = format!("{order} in {grid} tiles of {} x {} ({maps})", tile[0], tile[1]);
    found.assumptions.insert(0, Assumption::new(What::Layout, chosen, why, certainty));
    let photos = if grid.rows == 1 || grid.columns == 1 { first } else { 0 };
    if border > 0 {
        let borders = format!("The borders of {border} texels around the tiles are cut off.");
        found.notes.push(Note::Told(borders));
    }
    if photos > 0 {
        let tiles = grid.count();
        let ignored = format!("The first {photos} of {tiles} tiles are taken as photos and ignored.");
        found.notes.push(Note::Told(ignored));
    }
    if is_stack(grid, order.len()) {
        let index = first / grid.columns;
        found.notes.push(Note::Rows { count: grid.rows, index });
    }
    Ok(found)
}

fn own_tiling() -> Tiling {
    let grid = TileGrid { columns: Order::NDRS.len(), rows: 1 };
    Tiling { grid, order: Order::NDRS, first: 0, why: Reason::NATIVE_TEXT, certainty: Certainty::Sure }
}

/// Adds the encoding that goes with an order in this grid; nothing where none is known: pixels decide then.
fn add_usual(found: &mut StoredMaterial, order: Order, grid: TileGrid, image: &Raster) {
    let materialgan = (Albedo::Gamma22, Roughness::Gamma22, MATERIALGAN);
    let (albedo, roughness, why) = match order {
        _ if image.is_float() => (Albedo::Linear, Roughness::R, Reason::FLOATS),
        Order::NDRS => (Albedo::Linear, Roughness::R, DESCHAINTRE),
        Order::DNRS | Order::DNR => materialgan,
        Order::NDSR if grid.columns == 2 => materialgan,
        Order::DSRN => (Albedo::Gamma22, Roughness::R, MATFUSION),
        Order::IBRM => (Albedo::Srgb, Roughness::R, SVBRDF_EVALUATION),
        _ => return,
    };
    let certainty = if order == Order::IBRM { Certainty::Unsure } else { Certainty::Likely };
    found.inferred.albedo = Some((albedo, why.clone(), certainty));
    found.inferred.specular = found.inferred.albedo.clone();
    found.inferred.roughness = Some((roughness, why, Certainty::Likely));
    let why = Reason::measured("all known sources of packed maps do this");
    found.inferred.normal_y = Some((NormalY::Up, why, Certainty::Likely));
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
        return Some(placed(grid, order, options, Reason::SPECIFIED, Certainty::Given));
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
        Some(order) => (order, "no tile tells; it is the order of the preset"),
        None if none && grid.columns == 4 && name.to_lowercase().contains("svbrdf") => {
            (Order::IBRM, "no tile looks like normals, and svbrdf-evaluation uses such names")
        }
        None => (Order::NDRS, "no single tile looks like normals; this is the usual order"),
    };
    Some(placed(grid, order, options, Reason::measured(why), Certainty::Unsure))
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
    let known: &[Order] = if grid.columns == 2 && grid.rows == 2 { &Order::SQUARES } else { &Order::ROWS };
    let is_one = |order: &&Order| {
        let normals = order.roles().position(|role| role == Role::Normal);
        let photos = count.checked_sub(order.len()).filter(|photos| *photos == 0 || **order == Order::NDRS);
        photos.zip(normals).is_some_and(|(photos, normals)| photos + normals == place)
    };
    let known: Vec<Order> = known.iter().filter(is_one).copied().collect();
    let usual = *known.first()?;
    if is_stack(grid, 0) && !every_row_has_normals(image, grid, place) {
        return None;
    }
    let why = Reason::measured(format!(
        "tile {} looks like normals ({:.0}% of its pixels), the next best {:.0}%",
        place + 1,
        100.0 * best,
        100.0 * second
    ));
    let first = |order: Order| start + count - order.len();
    let against = |order: &Order| contradicted(image, grid, first(*order), *order);
    let (order, why, certainty) = match against(&usual) {
        Some(tile) => {
            let other = known.into_iter().find(|order| *order != usual && against(order).is_none());
            (other.unwrap_or(usual), why.contradicted(&tile), Certainty::Unsure)
        }
        None => (usual, why, Certainty::Likely),
    };
    Some(Tiling { grid, order, first: first(order), why, certainty })
}

/// The first tile that cannot be the map that an order of tiles makes of it.
fn contradicted(image: &Raster, grid: TileGrid, first: usize, order: Order) -> Option<Reason> {
    let size = grid.tile(image.size())?;
    order.roles().enumerate().find_map(|(place, map)| {
        let number = first + place;
        let found = tile::contradiction(&image.crop(grid.corner(number, size), size), map)?;
        let (tile, map) = (number + 1, map.name());
        Some(Reason::measured(format!("tile {tile} {found}: it is no {map} map, as in the usual order")))
    })
}

fn refusal(path: &Path, image: &Raster, options: &ReadOptions) -> Error {
    let grid = options.grid.map(|grid| [grid.columns, grid.rows]);
    Error::NotPacked { path: path.to_owned(), size: image.size(), grid }
}
