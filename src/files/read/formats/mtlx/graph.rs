//! The node graph of MaterialX: inputs followed through other nodes to a picture or a value.

use roxmltree::Node;

use super::arithmetic::{self, Affine, Bound, BoundPicture, OPERANDS, Obstacle};
use super::connection::{input, of_interface, target};
use super::placement;

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
        let computed = arithmetic::value(kind, operand)?;
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
