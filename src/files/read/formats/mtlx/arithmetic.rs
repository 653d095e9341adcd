//! What an input of MaterialX is bound to, and its arithmetic: sums and products of constants and of one picture, which stay affine in it.

use crate::read::options::transfer::ColourSpace;

/// Most operands of a node.
pub(super) const OPERANDS: usize = 3;

/// What an input is bound to.
#[derive(Clone, Debug)]
pub(super) enum Bound {
    /// A value, and its colour space where the file declares it.
    Values {
        values: Vec<f32>,
        space: Option<String>,
    },
    Picture(BoundPicture),
}

/// The picture that an input is bound to.
#[derive(Clone, Debug)]
pub(super) struct BoundPicture {
    pub file: String,
    /// The colour space where the file declares it.
    pub space: Option<String>,
    /// Whether its node is one of colours, so that the colour space counts.
    pub is_colour: bool,
    /// The one channel that is taken of it.
    pub channel: Option<usize>,
    /// What is computed of its linear numbers.
    pub affine: Affine,
    /// The scale of x and y of a normal.
    pub scale: f32,
    /// How it lies over the surface, in words; empty where it fills the first set of coordinates once.
    pub placement: String,
    /// Inputs of its node that are not understood.
    pub unread: Vec<String>,
}

/// Products with `scale` plus `offset`, for red, green and blue.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Affine {
    pub scale: [f32; 3],
    pub offset: [f32; 3],
}

impl Default for Affine {
    fn default() -> Self {
        Self { scale: [1.0; 3], offset: [0.0; 3] }
    }
}

impl Bound {
    /// Channel number `channel` alone.
    #[must_use]
    pub(super) fn channel(self, channel: usize) -> Self {
        match self {
            Self::Values { values, .. } if values.len() > 1 => {
                let value = values.get(channel).or(values.last()).copied().unwrap_or_default();
                Self::Values { values: vec![value], space: None }
            }
            Self::Picture(picture) if picture.channel.is_none() => {
                let Affine { scale, offset } = picture.affine;
                let one = |three: [f32; 3]| [three.get(channel).copied().unwrap_or(three[2]); 3];
                let affine = Affine { scale: one(scale), offset: one(offset) };
                Self::Picture(BoundPicture { channel: Some(channel), affine, ..picture })
            }
            other => other,
        }
    }
}

/// What stands in the way from an input to a picture or a value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Obstacle {
    /// A node that computes, by its name and kind.
    Procedural(String),
    /// A name that leads nowhere, or round.
    Nowhere(String),
    /// Normals of another space than that of the tangents, by its name.
    Space(String),
}

/// The value of a node of this `kind`, whose input of a name is the `operand` of it or else a number; `None` where it is no
/// affine function of at most one picture.
///
/// # Errors
/// Those of an operand.
pub(super) fn value(
    kind: &str,
    operand: impl Fn(&str) -> Result<Option<Bound>, Obstacle>,
) -> Result<Option<Bound>, Obstacle> {
    let operand = |name: &str, usual: f32| Ok(operand(name)?.unwrap_or_else(|| constant(usual)));
    let minus = |bound: Bound| product(bound, constant(-1.0));
    Ok(match kind {
        "multiply" => product(operand("in1", 0.0)?, operand("in2", 1.0)?),
        "divide" => inverse(&operand("in2", 1.0)?).and_then(|by| product(operand("in1", 0.0).ok()?, by)),
        "add" => sum(operand("in1", 0.0)?, operand("in2", 0.0)?),
        "subtract" => minus(operand("in2", 0.0)?).and_then(|by| sum(operand("in1", 0.0).ok()?, by)),
        "invert" => minus(operand("in", 0.0)?).and_then(|by| sum(operand("amount", 1.0).ok()?, by)),
        "combine3" => gathered([operand("in1", 0.0)?, operand("in2", 0.0)?, operand("in3", 0.0)?]),
        // bg + mix (fg - bg)
        "mix" => {
            let (fg, bg, mix) = (operand("fg", 0.0)?, operand("bg", 0.0)?, operand("mix", 0.0)?);
            mixed(fg, bg, mix)
        }
        _ => None,
    })
}

/// Red, green and blue of constants and of the same channels of one picture, or all of one channel of it.
fn gathered(channels: [Bound; 3]) -> Option<Bound> {
    let mut picture: Option<BoundPicture> = None;
    let (mut scale, mut offset) = ([0.0; 3], [0.0; 3]);
    let mut sources = Vec::new();
    for (place, channel) in channels.into_iter().enumerate() {
        match channel {
            Bound::Values { values, space } => offset[place] = linear(&values, space.as_deref())?[0],
            Bound::Picture(one) => {
                (scale[place], offset[place]) = (one.affine.scale[place], one.affine.offset[place]);
                sources.push((place, one.channel?));
                let key = |one: &BoundPicture| (one.file.clone(), one.space.clone(), one.placement.clone());
                if picture.as_ref().is_some_and(|other| key(other) != key(&one)) {
                    return None;
                }
                picture.get_or_insert(one);
            }
        }
    }
    let Some(picture) = picture else { return Some(Bound::Values { values: offset.to_vec(), space: None }) };
    let first = sources.first().map(|(_, source)| *source);
    let channel = match sources.iter().all(|(place, source)| place == source) {
        true => None,
        false => Some(first.filter(|first| sources.iter().all(|(_, source)| source == first))?),
    };
    Some(Bound::Picture(BoundPicture { channel, affine: Affine { scale, offset }, ..picture }))
}

fn mixed(fg: Bound, bg: Bound, mix: Bound) -> Option<Bound> {
    match &mix {
        Bound::Values { .. } => {
            let rest = sum(constant(1.0), product(mix.clone(), constant(-1.0))?)?;
            sum(product(fg, mix)?, product(bg, rest)?)
        }
        Bound::Picture(_) => {
            let difference = sum(fg, product(bg.clone(), constant(-1.0))?)?;
            sum(bg, product(difference, mix)?)
        }
    }
}

fn constant(value: f32) -> Bound {
    Bound::Values { values: vec![value], space: None }
}

/// Linear numbers of Rec. 709, one for each channel; `None` where their colour space is not known.
fn linear(values: &[f32], space: Option<&str>) -> Option<[f32; 3]> {
    let three = match values {
        [one] => return Some([*one; 3]),
        [r, g] => [*r, *g, 0.0],
        [r, g, b, ..] => [*r, *g, *b],
        [] => return None,
    };
    let Some(space) = space else { return Some(three) };
    Some(ColourSpace::of_name(space)?.to_linear(three.map(f64::from)).map(|value| value as f32))
}

/// 1 / the constant.
fn inverse(bound: &Bound) -> Option<Bound> {
    let Bound::Values { values, space } = bound else { return None };
    let inverse = linear(values, space.as_deref())?.map(f32::recip);
    inverse.iter().all(|v| v.is_finite()).then(|| Bound::Values { values: inverse.to_vec(), space: None })
}

fn product(a: Bound, b: Bound) -> Option<Bound> {
    combined(
        a,
        b,
        |a, b| a * b,
        |picture, by| {
            let Affine { scale, offset } = picture.affine;
            Affine { scale: of(scale, by, |a, b| a * b), offset: of(offset, by, |a, b| a * b) }
        },
    )
}

fn sum(a: Bound, b: Bound) -> Option<Bound> {
    combined(
        a,
        b,
        |a, b| a + b,
        |picture, by| Affine { offset: of(picture.affine.offset, by, |a, b| a + b), ..picture.affine },
    )
}

fn of(a: [f32; 3], b: [f32; 3], both: impl Fn(f32, f32) -> f32) -> [f32; 3] {
    [0, 1, 2].map(|c| both(a[c], b[c]))
}

/// Two operands in either order: of constants the result of `both`, of a picture and a constant the affine function.
fn combined(
    a: Bound,
    b: Bound,
    both: impl Fn(f32, f32) -> f32,
    affine: impl Fn(&BoundPicture, [f32; 3]) -> Affine,
) -> Option<Bound> {
    match (a, b) {
        (Bound::Values { values: a, space: of_a }, Bound::Values { values: b, space: of_b }) => {
            let values = of(linear(&a, of_a.as_deref())?, linear(&b, of_b.as_deref())?, both);
            let count = a.len().max(b.len()).min(3);
            Some(Bound::Values { values: values[..count].to_vec(), space: None })
        }
        (Bound::Picture(picture), Bound::Values { values, space })
        | (Bound::Values { values, space }, Bound::Picture(picture)) => {
            let affine = affine(&picture, linear(&values, space.as_deref())?);
            Some(Bound::Picture(BoundPicture { affine, ..picture }))
        }
        (Bound::Picture(_), Bound::Picture(_)) => None,
    }
}
