//! The plane of a material in a photograph: four corners, and the projective map between them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::error::Error;

/// Least area, in pixels, of a triangle between three corners.
const LEAST: f64 = 1e-3;

/// The corners of the plane in a photograph: top left, top right, bottom right and bottom left of the material.
///
/// In pixels (x, y), y down: (0, 0) is the outer corner of the top left pixel, whose middle is (0.5, 0.5). They are the
/// outer corners of the outermost texels, not the middles of these.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Corners(pub [[f64; 2]; 4]);

impl Corners {
    /// The whole picture of `size` = (width, height).
    pub fn whole(size: [usize; 2]) -> Self {
        let [w, h] = size.map(|side| side as f64);
        Self([[0.0, 0.0], [w, 0.0], [w, h], [0.0, h]])
    }

    /// Whether the corners span a convex area within a picture of `size` = (width, height), clockwise.
    ///
    /// # Errors
    /// [`Error::UnusableCorners`].
    pub fn check(&self, size: [usize; 2]) -> Result<(), Error> {
        let bad = |problem: String| Err(Error::UnusableCorners { problem });
        let [w, h] = size.map(|side| side as f64);
        let is_out_of_range = |[x, y]: &&[f64; 2]| !((0.0..=w).contains(x) && (0.0..=h).contains(y));
        if let Some([x, y]) = self.0.iter().find(is_out_of_range) {
            return bad(format!(
                "expected corners within the {w} x {h} pixels of the photograph, found {x},{y}"
            ));
        }
        // Twice the signed areas of the triangles at the corners: positive where the way around turns right.
        let turn = |i: usize| {
            let [[ax, ay], [bx, by], [cx, cy]] = [0, 1, 2].map(|k| self.0[(i + k) % 4]);
            (bx - ax) * (cy - by) - (by - ay) * (cx - bx)
        };
        let turns = [0, 1, 2, 3].map(turn);
        if turns.iter().all(|&turn| turn >= 2.0 * LEAST) {
            return Ok(());
        }
        let found = self.0.map(|[x, y]| format!("{x},{y}")).join(" ");
        if turns.iter().all(|&turn| turn <= -2.0 * LEAST) {
            return bad(format!("expected corners in clockwise order, found {found}"));
        }
        bad(format!("expected the corners of a convex area in clockwise order, found {found}"))
    }

    /// The map from (s, t), where s runs from 0 at the left edge of the material to 1 at the right one and t from 0 at the top
    /// to 1 at the bottom, to pixels.
    pub fn homography(&self) -> Homography {
        // Heckbert 1989, "Fundamentals of Texture Mapping and Image Warping", section 2.2.3.
        let [[x0, y0], [x1, y1], [x2, y2], [x3, y3]] = self.0;
        let ([dx1, dy1], [dx2, dy2]) = ([x1 - x2, y1 - y2], [x3 - x2, y3 - y2]);
        let (sx, sy) = (x0 - x1 + x2 - x3, y0 - y1 + y2 - y3);
        let determinant = dx1 * dy2 - dx2 * dy1;
        let g = (sx * dy2 - dx2 * sy) / determinant;
        let h = (dx1 * sy - sx * dy1) / determinant;
        Homography {
            x: [x1 - x0 + g * x1, x3 - x0 + h * x3, x0],
            y: [y1 - y0 + g * y1, y3 - y0 + h * y3, y0],
            w: [g, h, 1.0],
        }
    }
}

/// A projective map of the unit square: the rows of a matrix on (s, t, 1).
#[derive(Clone, Copy, Debug)]
pub struct Homography {
    x: [f64; 3],
    y: [f64; 3],
    w: [f64; 3],
}

impl Homography {
    /// Where (s, t) of the unit square lies.
    pub fn at(&self, s: f64, t: f64) -> [f64; 2] {
        let row = |[a, b, c]: [f64; 3]| a * s + b * t + c;
        let w = row(self.w);
        [row(self.x) / w, row(self.y) / w]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_homography_maps_corners_to_corners_and_keeps_lines() {
        let corners = Corners([[10.0, 20.0], [90.0, 5.0], [80.0, 70.0], [5.0, 60.0]]);
        let map = corners.homography();
        let unit = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        for ([s, t], expected) in unit.into_iter().zip(corners.0) {
            let found = map.at(s, t);
            assert!((found[0] - expected[0]).hypot(found[1] - expected[1]) < 1e-12, "{found:?}");
        }
        // The diagonals of the square meet where the diagonals of the quadrilateral meet.
        let [a, m, c] = [map.at(0.0, 0.0), map.at(0.5, 0.5), map.at(1.0, 1.0)];
        let [b, d] = [map.at(1.0, 0.0), map.at(0.0, 1.0)];
        let off = |p: [f64; 2], q: [f64; 2]| (q[0] - p[0]) * (m[1] - p[1]) - (q[1] - p[1]) * (m[0] - p[0]);
        assert!(off(a, c).abs() < 1e-9 && off(b, d).abs() < 1e-9);
        assert_eq!(Corners::whole([6, 4]).homography().at(0.25, 0.5), [1.5, 2.0]);
    }

    #[test]
    fn corners_that_cannot_be_meant_are_refused() {
        let problem = |corners: [[f64; 2]; 4]| match Corners(corners).check([100, 80]) {
            Err(error) => error.to_string(),
            Ok(()) => String::new(),
        };
        let [a, b, c, d] = [[1.0, 1.0], [99.0, 2.0], [98.0, 79.0], [2.0, 78.0]];
        assert_eq!(problem([a, b, c, d]), "");
        assert_eq!(problem([b, c, d, a]), "", "turned by a quarter");
        assert!(Corners::whole([100, 80]).check([100, 80]).is_ok());
        for (wrong, words) in [
            ([a, b, [101.0, 79.0], d], "within the 100 x 80 pixels of the photograph, found 101,79"),
            ([a, b, [f64::NAN, 79.0], d], "found NaN,79"),
            ([a, d, c, b], "expected corners in clockwise order, found 1,1 2,78 98,79 99,2"),
            ([a, c, b, d], "convex"),
            ([a, b, [20.0, 20.0], d], "convex"),
            ([a, a, c, d], "convex"),
            ([[1.0, 1.0], [2.0, 1.0], [3.0, 1.0], [4.0, 1.0]], "convex"),
        ] {
            assert!(problem(wrong).contains(words), "{wrong:?}: {}", problem(wrong));
        }
    }
}
