//! The node graph of MaterialX: inputs followed through other nodes to a picture or a value. Nodes that turn a component of normals
//! around, or put channels together, stay affine in one picture.

use roxmltree::Node;

use super::placement::{self, input, of_interface, target};

/// Most operands of a node.
const OPERANDS: usize = 3;

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
    fn channel(self, channel: usize) -> Self {
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

/// The value of a node of this `kind`; `operand` gives each input by its name. `None` unless the value is an affine function of one picture.
fn affine_value(
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

/// More nodes than any chain from an input to its picture has.
const DEEPEST: usize = 256;
/// Nodes that pass on what they get, or one channel of it.
const PASSING: [&str; 9] =
    ["normalmap", "extract", "separate2", "separate3", "separate4", "swizzle", "convert", "dot", "output"];

/// What input `name` of `node` is bound to; `None` where the file does not declare it.
///
/// # Errors
/// [`Obstacle`].
pub(super) fn bound(node: Node<'_, '_>, name: &str) -> Result<Option<Bound>, Obstacle> {
    input(node, name).map(|input| follow(input, DEEPEST)).transpose()
}

/// The attribute `name` of a node or of what it is in.
fn inherited(node: Node<'_, '_>, name: &str) -> Option<String> {
    node.ancestors().find_map(|n| n.attribute(name)).map(str::to_owned)
}

/// Whether a node or an input is one of colours: then its colour space counts.
fn is_colour(node: Node<'_, '_>) -> bool {
    node.attribute("type").is_none_or(|kind| kind.starts_with("color"))
}

/// What `input` leads to, through at most `depth` nodes.
fn follow(input: Node<'_, '_>, depth: usize) -> Result<Bound, Obstacle> {
    let name = input.attribute("name").unwrap_or_default();
    let nowhere = || Obstacle::Nowhere(name.to_owned());
    let depth = depth.checked_sub(1).ok_or_else(nowhere)?;
    if let Some(values) = input.attribute("value").and_then(numbers) {
        let space = inherited(input, "colorspace").filter(|_| is_colour(input));
        return Ok(Bound::Values { values, space });
    }
    if let Some(face) = input.attribute("interfacename") {
        let mut graphs = input.ancestors().filter(|n| n.has_tag_name("nodegraph"));
        let outer = graphs.find_map(|graph| self::input(graph, face)).ok_or_else(nowhere)?;
        return follow(outer, depth);
    }
    let found = through(target(input).ok_or_else(nowhere)?, depth)?;
    let of_output = input.attribute("output").or(input.attribute("channels"));
    Ok(match of_output.and_then(channel_of) {
        Some(channel) => found.channel(channel),
        None => found,
    })
}

/// What a node gives: the picture that it reads, what it passes on, or the values that it computes.
fn through(node: Node<'_, '_>, depth: usize) -> Result<Bound, Obstacle> {
    let kind = node.tag_name().name();
    let value = |name: &str| input(node, name).and_then(|n| n.attribute("value"));
    if kind == "output" {
        return follow(node, depth);
    }
    if let Some(file) = input(node, "file") {
        return picture(node, file, depth).map(Bound::Picture);
    }
    if kind == "constant" {
        let value = input(node, "value").ok_or_else(|| Obstacle::Nowhere("value".to_owned()))?;
        return follow(value, depth);
    }
    if !PASSING.contains(&kind) {
        let name = node.attribute("name").unwrap_or_default();
        // Each operand leads through its share of the nodes that are left, so that no graph takes long.
        let operand = |name: &str| input(node, name).map(|one| follow(one, depth / OPERANDS)).transpose();
        let computed = affine_value(kind, operand)?;
        return computed.ok_or_else(|| Obstacle::Procedural(format!("{name} ({kind})")));
    }
    if kind == "normalmap" && value("space").is_some_and(|space| space.trim() != "tangent") {
        return Err(Obstacle::Space(value("space").unwrap_or_default().trim().to_owned()));
    }
    let next = input(node, "in").ok_or_else(|| Obstacle::Nowhere("in".to_owned()))?;
    let mut found = follow(next, depth)?;
    let index = value("index").and_then(|index| index.trim().parse().ok());
    let swizzled = value("channels").filter(|channels| channels.len() == 1).and_then(channel_of);
    if let Some(channel) = index.or(swizzled) {
        found = found.channel(channel);
    }
    if let (Bound::Picture(picture), Some(scale)) = (&mut found, value("scale").and_then(numbers)) {
        picture.scale *= scale.first().copied().unwrap_or(1.0);
    }
    Ok(found)
}

fn picture(node: Node<'_, '_>, file: Node<'_, '_>, depth: usize) -> Result<BoundPicture, Obstacle> {
    let nowhere = || Obstacle::Nowhere("file".to_owned());
    let file = of_interface(file, depth);
    let name = file.attribute("value").ok_or_else(nowhere)?;
    Ok(BoundPicture {
        file: inherited(file, "fileprefix").unwrap_or_default() + name,
        space: inherited(file, "colorspace"),
        is_colour: is_colour(node),
        channel: None,
        affine: affine(node, depth),
        scale: 1.0,
        placement: placement::of_picture(node, depth),
        unread: placement::unread(node),
    })
}

/// The factors and offsets that nodes of glTF and USD have beside their picture.
fn affine(node: Node<'_, '_>, depth: usize) -> Affine {
    let three = |name: &str, usual: f32| -> [f32; 3] {
        let declared =
            input(node, name).and_then(|one| numbers(of_interface(one, depth).attribute("value")?));
        let declared = declared.filter(|all| !all.is_empty()).unwrap_or_else(|| vec![usual]);
        [0, 1, 2].map(|c: usize| declared[c.min(declared.len() - 1)])
    };
    let (factor, bias) = match node.tag_name().name() {
        "UsdUVTexture" => ("scale", "bias"),
        "gltf_colorimage" => ("color", ""),
        "gltf_image" => ("factor", ""),
        _ => return Affine::default(),
    };
    Affine { scale: three(factor, 1.0), offset: three(bias, 0.0) }
}

/// `0.5`, `1, 0.5, 0` or `true`.
fn numbers(text: &str) -> Option<Vec<f32>> {
    let number = |text: &str| match text.trim() {
        "true" => Some(1.0),
        "false" => Some(0.0),
        number => number.parse().ok().filter(|n: &f32| n.is_finite()),
    };
    text.split(',').map(number).collect()
}

/// Output `outg` or channels `g` is channel 1.
fn channel_of(output: &str) -> Option<usize> {
    match output {
        "outr" | "r" | "x" | "outx" => Some(0),
        "outg" | "g" | "y" | "outy" => Some(1),
        "outb" | "b" | "z" | "outz" => Some(2),
        _ => None,
    }
}
