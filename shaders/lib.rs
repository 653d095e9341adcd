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

/// A shader of the pieces with these names.
macro_rules! shader {
    ($name:ident: $($piece:ident)+) => {
        Shader {
            name: stringify!($name),
            pieces: &[$((
                concat!(stringify!($piece), ".wgsl"),
                include_str!(concat!(stringify!($piece), ".wgsl")),
            )),+],
        }
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

/// Of maps as floats.
pub const FLOATS: MapShaders = MapShaders {
    shade: shader!(shade: texel brdf scene grid fullscreen stride maps shade shade_entry),
    reduce: shader!(reduce: texel fullscreen stride maps reduce),
};

/// Of maps as codes.
pub const CODED: MapShaders = MapShaders {
    shade: shader!(shade: texel brdf scene grid fullscreen stride coded_maps shade shade_entry),
    reduce: shader!(reduce: texel fullscreen stride coded_maps reduce),
};

/// Pass 2: a screen pixel a fragment.
pub const DISPLAY: Shader = shader!(
    display: grid fullscreen camera footprint srgb colour_map difference encode display display_entry
);

/// Kept pixels, copied.
pub const BLIT: Shader = shader!(blit: fullscreen blit);

/// Pass 1 of the report, for WebGL.
pub const PAGE_SHADE: Shader =
    shader!(page_shade: texel brdf scene grid fullscreen stride maps shade page_shade);

/// Pass 2 of the report, for WebGL.
pub const PAGE_DISPLAY: Shader = shader!(
    page_display: grid fullscreen camera footprint srgb colour_map difference encode display page_display
);

/// Differences as numbers, of the report, for WebGL.
pub const PAGE_DIFFERENCE: Shader =
    shader!(page_difference: fullscreen colour_map difference page_difference);

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
