//! The controls of the bar at the top, and how much room each needs.

/// How much room the bar has: what does not fit into one line is in the menu.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Room {
    Little,
    Some,
    Full,
}

impl Room {
    /// Of a bar of this width, in points.
    pub fn of(width: f32) -> Self {
        match width {
            1320.0.. => Self::Full,
            870.0.. => Self::Some,
            _ => Self::Little,
        }
    }
}

/// A control that is in the bar where there is room, and in the menu otherwise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BarItem {
    Copy,
    Histogram,
    Perspective,
    Tile,
    FalseColour,
    Swap,
    Exposure,
    AutoExposure,
    Clip,
    Fit,
    OneToOne,
    Reset,
    Undo,
    Redo,
}

impl BarItem {
    pub const ALL: [Self; 14] = [
        Self::Copy,
        Self::Histogram,
        Self::Perspective,
        Self::Tile,
        Self::FalseColour,
        Self::Swap,
        Self::Exposure,
        Self::AutoExposure,
        Self::Clip,
        Self::Fit,
        Self::OneToOne,
        Self::Reset,
        Self::Undo,
        Self::Redo,
    ];

    /// The least room in which it is in the bar.
    pub fn needs(self) -> Room {
        match self {
            Self::Perspective => Room::Little,
            Self::Swap | Self::Exposure | Self::AutoExposure | Self::Fit | Self::Reset => Room::Some,
            _ => Room::Full,
        }
    }
}
