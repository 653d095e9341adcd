//! Bindings of inputs of MaterialX, and the nodes that turn a component of normals around or put channels together: both stay affine
//! in one picture.

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

/// The value of a node of this `kind`, each of whose inputs is the `operand` of its name; `None` where it is no affine function of one picture.
pub(super) fn value(
    kind: &str,
    operand: impl Fn(&str) -> Result<Option<Bound>, Obstacle>,
) -> Result<Option<Bound>, Obstacle> {
    Ok(match kind {
        "invert" if operand("amount")?.is_none() => operand("in")?.and_then(inverted),
        "combine3" => gathered([operand("in1")?, operand("in2")?, operand("in3")?]),
        _ => None,
    })
}

fn inverted(bound: Bound) -> Option<Bound> {
    let Bound::Picture(picture) = bound else { return None };
    let Affine { scale, offset } = picture.affine;
    let affine = Affine { scale: scale.map(|factor| -factor), offset: offset.map(|offset| 1.0 - offset) };
    Some(Bound::Picture(BoundPicture { affine, ..picture }))
}

/// Red, green and blue of constants and of the same channels of one picture, or all of one channel of it.
fn gathered(channels: [Option<Bound>; 3]) -> Option<Bound> {
    let mut picture: Option<BoundPicture> = None;
    let (mut scale, mut offset) = ([0.0; 3], [0.0; 3]);
    let mut sources = Vec::new();
    for (place, channel) in channels.into_iter().enumerate() {
        match channel {
            None => {}
            Some(Bound::Values { values, .. }) => offset[place] = *values.first()?,
            Some(Bound::Picture(one)) => {
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
    let first = sources.first().map(|(_, source)| *source);
    let channel = match sources.iter().all(|(place, source)| place == source) {
        true => None,
        false => Some(first.filter(|first| sources.iter().all(|(_, source)| source == first))?),
    };
    Some(Bound::Picture(BoundPicture { channel, affine: Affine { scale, offset }, ..picture? }))
}
