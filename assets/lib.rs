//! Files that the program embeds. `cargo xtask bless assets` makes the icons; `pictures/` has those of the documents.

/// The built-in materials as PNG, each with its name: normal, diffuse, roughness and specular side by side, linear, 256 x 256
/// texels. The ground truth is the first.
pub const SAMPLES: [(&str, &[u8]); 3] = [
    ("worn tiles", include_bytes!("samples/worn_tiles.png")),
    ("blurred normals", include_bytes!("samples/blurred_normals.png")),
    ("wrong roughness", include_bytes!("samples/wrong_roughness.png")),
];

/// The icon of the window as PNG, 64 x 64 pixels.
pub const ICON: &[u8] = include_bytes!("icons/64.png");
