//! Modes of subcommands, and the options that each does not use: they are refused.
//!
//! Options that exclude each other whatever their values are declared with the options themselves. `tests/cli/options.rs` tries every
//! option in every mode.

/// A way of using a subcommand.
#[derive(Debug)]
pub struct Mode {
    /// Why it does not use the options.
    pub reason: &'static str,
    /// The names of the options that it does not use, without dashes.
    pub unused: &'static [&'static [&'static str]],
}

impl Mode {
    pub fn ignores(&self, option: &str) -> bool {
        self.unused.iter().any(|group| group.contains(&option))
    }
}

/// How materials are read, and their size.
const READING: &[&str] = &["read", "preset", "resize-to"];
/// The scenes of a command that samples them.
const SCENES: &[&str] = &["near", "distant", "seed", "sampler", "scenes", "lights", "fov"];
/// The one scene of a picture.
const ONE_SCENE: &[&str] = &["view", "light", "distant"];

/// Any command with a session file in place of the ground truth.
pub const SESSION: Mode =
    Mode { reason: "a session specifies how its materials are read", unused: &[READING] };

/// Any command without materials: it takes the built-in ones.
pub const BUILT_IN: Mode = Mode {
    reason: "the built-in materials are not read from files",
    unused: &[READING, &["strict", "repeat"]],
};

/// Any command with a fixed set of scenes.
pub const NAMED_SCENES: Mode = Mode {
    reason: "the scenes of this name are a fixed list",
    unused: &[&["near", "distant", "seed", "sampler", "texels", "target-error", "time-budget"]],
};
/// Any command whose scenes are not those of one flash.
pub const NO_FLASH: Mode =
    Mode { reason: "a field of view belongs to `--lights flash`", unused: &[&["fov"]] };

/// `loss` with a session whose scenes are of a file.
pub const SESSION_SCENES: Mode =
    Mode { reason: "the session lists its scenes, which have no seed", unused: &[&["seed"]] };

/// `report --figure`.
pub const REPORT_FIGURE: Mode =
    Mode { reason: "the figure alone has no loss", unused: &[&["target-error", "seed"]] };

/// `report` of a ground truth alone.
pub const REPORT_ALONE: Mode =
    Mode { reason: "there is no prediction, and no loss", unused: &[&["target-error", "seed", "layout"]] };

/// `map --over texels`.
pub const MAP_OVER_TEXELS: Mode = Mode {
    reason: "a map over texels has no fixed direction and the size of its material",
    unused: &[&["fixed", "side"]],
};
/// `map --over lights` and `map --over views`.
pub const MAP_OVER_DIRECTIONS: Mode =
    Mode { reason: "a map over directions samples no scenes", unused: &[SCENES] };

/// `metrics --protocol`.
pub const PROTOCOL: Mode =
    Mode { reason: "a protocol compares materials as they are", unused: &[&["resize-to"]] };

/// `metrics` without a protocol. The parser alone would not refuse this beside options that exclude a protocol.
pub const NO_PROTOCOL: Mode =
    Mode { reason: "only a --protocol writes renderings", unused: &[&["renderings"]] };

/// `rank` of the predictions of one ground truth.
pub const RANK_PREDICTIONS: Mode = Mode {
    reason: "a ranking of the predictions of one material has no results folder, no samples, no metrics and no marks, unlike one with \
        --dataset or --pairs (`svbrdf metrics` and `svbrdf diagnose` print them)",
    unused: &[&["results", "shard", "pick", "metrics", "diagnose", "output", "figures"]],
};
/// `rank` of a data set in a format that is printed.
pub const RANK_PRINTED: Mode = Mode {
    reason: "only --format html writes a file, and figures beside it",
    unused: &[&["output", "figures"]],
};
/// `rank --dataset` and `rank --pairs`.
pub const RANK_DATA_SET: Mode = Mode {
    reason: "materials of a data set are not resized and have one capture each",
    unused: &[&["resize-to", "repeat"]],
};

/// `render` of maps.
pub const RENDER_MAPS: Mode = Mode {
    reason: "a map has no light, no view, no exposure and no convention, and is not rendered",
    unused: &[ONE_SCENE, &["exposure", "convention", "gpu"]],
};
/// `render` of differences that are computed without an exposure.
pub const RENDER_DIFFERENCE: Mode =
    Mode { reason: "only --difference=flip compares exposed renderings", unused: &[&["exposure"]] };
/// `render` of differences to an EXR.
pub const RENDER_NUMBERS: Mode =
    Mode { reason: "an EXR holds differences as numbers, without colours", unused: &[&["range"]] };
/// `strip` without a rendering among its columns.
pub const STRIP_MAPS: Mode = Mode {
    reason: "maps have no light, no view, no exposure and no convention, and no column is a rendering",
    unused: &[ONE_SCENE, &["scenes", "lights", "fov", "exposure", "convention"]],
};
/// `strip` without scenes by name.
pub const STRIP_SAMPLED: Mode = Mode {
    reason: "a strip has no sampled scenes: use flash, flash-9 or hemisphere, or a file of `svbrdf scenes`",
    unused: &[&["lights"]],
};
/// `strip` without a difference among its columns.
pub const STRIP_VALUES: Mode = Mode { reason: "no column is a difference", unused: &[&["range"]] };

/// `info`.
pub const INFO: Mode =
    Mode { reason: "everything noticed and assumed is printed in any case", unused: &[&["verbose"]] };
/// `view`.
pub const VIEW: Mode =
    Mode { reason: "the window lists what is noticed and assumed", unused: &[&["verbose"]] };
/// `photo` with one photograph.
pub const PHOTO_ALONE: Mode = Mode {
    reason: "the exposure of a capture and held-out photographs belong to --capture",
    unused: &[&["exposure", "hold-out"]],
};
/// `view --photo` with a capture.
pub const VIEW_CAPTURE: Mode = Mode {
    reason: "a capture lists the lights and views of its photographs, and how they are read",
    unused: &[&["scene", "scene-number", "flash", "fov", "corners", "transfer", "clip", "falloff"]],
};
