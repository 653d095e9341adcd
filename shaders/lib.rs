//! The shaders: WGSL modules, each made of pieces that are joined in order. No code but this table.
//!
//! A piece that is the twin of Rust code says of which file; its functions have the names of the functions there, or name them in the
//! line above (`tests/shaders.rs`).

/// A WGSL module made of pieces.
#[derive(Clone, Copy, Debug)]
pub struct Shader {
    /// For messages.
    pub name: &'static str,
    /// File names and texts, in the order in which they are joined.
    pub pieces: &'static [(&'static str, &'static str)],
}

impl Shader {
    /// The text of the module.
    pub fn source(&self) -> String {
        self.pieces.iter().map(|(_, text)| *text).collect::<Vec<_>>().join("\n")
    }
}

/// A file of this folder with its name.
macro_rules! piece {
    ($file:literal) => {
        ($file, include_str!($file))
    };
}

/// The shaders that read maps, for maps that an adapter holds in one way.
#[derive(Clone, Copy, Debug)]
pub struct MapShaders {
    /// Pass 1: a texel a fragment.
    pub shade: Shader,
    /// Every n-th texel of a map.
    pub reduce: Shader,
}

/// The shaders that read maps by this piece.
macro_rules! map_shaders {
    ($maps:literal) => {
        MapShaders {
            shade: Shader {
                name: "shade",
                pieces: &[
                    piece!("texel.wgsl"),
                    piece!("brdf.wgsl"),
                    piece!("scene.wgsl"),
                    piece!("grid.wgsl"),
                    piece!("fullscreen.wgsl"),
                    piece!("stride.wgsl"),
                    piece!($maps),
                    piece!("shade.wgsl"),
                    piece!("shade_entry.wgsl"),
                ],
            },
            reduce: Shader {
                name: "reduce",
                pieces: &[
                    piece!("texel.wgsl"),
                    piece!("fullscreen.wgsl"),
                    piece!("stride.wgsl"),
                    piece!($maps),
                    piece!("reduce.wgsl"),
                ],
            },
        }
    };
}

/// Of maps as floats.
pub const FLOATS: MapShaders = map_shaders!("maps.wgsl");

/// Of maps as codes.
pub const CODED: MapShaders = map_shaders!("coded_maps.wgsl");

/// Pass 2: a screen pixel a fragment.
pub const DISPLAY: Shader = Shader {
    name: "display",
    pieces: &[
        piece!("grid.wgsl"),
        piece!("fullscreen.wgsl"),
        piece!("camera.wgsl"),
        piece!("footprint.wgsl"),
        piece!("srgb.wgsl"),
        piece!("colour_map.wgsl"),
        piece!("difference.wgsl"),
        piece!("encode.wgsl"),
        piece!("display.wgsl"),
        piece!("display_entry.wgsl"),
    ],
};

/// Kept pixels, copied.
pub const BLIT: Shader = Shader { name: "blit", pieces: &[piece!("fullscreen.wgsl"), piece!("blit.wgsl")] };

/// Pass 1 of the report, for WebGL.
pub const PAGE_SHADE: Shader = Shader {
    name: "page_shade",
    pieces: &[
        piece!("texel.wgsl"),
        piece!("brdf.wgsl"),
        piece!("scene.wgsl"),
        piece!("grid.wgsl"),
        piece!("fullscreen.wgsl"),
        piece!("stride.wgsl"),
        piece!("maps.wgsl"),
        piece!("shade.wgsl"),
        piece!("page_shade.wgsl"),
    ],
};

/// Pass 2 of the report, for WebGL.
pub const PAGE_DISPLAY: Shader = Shader {
    name: "page_display",
    pieces: &[
        piece!("grid.wgsl"),
        piece!("fullscreen.wgsl"),
        piece!("camera.wgsl"),
        piece!("footprint.wgsl"),
        piece!("srgb.wgsl"),
        piece!("colour_map.wgsl"),
        piece!("difference.wgsl"),
        piece!("encode.wgsl"),
        piece!("display.wgsl"),
        piece!("page_display.wgsl"),
    ],
};

/// Differences as numbers, of the report, for WebGL.
pub const PAGE_DIFFERENCE: Shader = Shader {
    name: "page_difference",
    pieces: &[
        piece!("fullscreen.wgsl"),
        piece!("colour_map.wgsl"),
        piece!("difference.wgsl"),
        piece!("page_difference.wgsl"),
    ],
};

/// The shaders of the report in GLSL for WebGL 2: JSON of each program with its bindings and the places of its uniforms.
///
/// Made by `cargo xtask bless shaders` and committed: to make it while building would cost every build 23 s of processor time, for naga.
pub const PAGE_GLSL: &str = include_str!("page.json");

/// The shaders that [`PAGE_GLSL`] is made of.
pub const PAGE: [(&str, Shader); 3] =
    [("shade", PAGE_SHADE), ("display", PAGE_DISPLAY), ("difference", PAGE_DIFFERENCE)];

/// Every shader of this crate.
pub const ALL: [Shader; 9] = [
    FLOATS.shade,
    FLOATS.reduce,
    CODED.shade,
    CODED.reduce,
    DISPLAY,
    BLIT,
    PAGE_SHADE,
    PAGE_DISPLAY,
    PAGE_DIFFERENCE,
];
