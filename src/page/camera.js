// From a point of a pane to the point of the material that is seen there: the twin of src/core/picture/camera.rs.

/**
 * @typedef {[number, number, number]} Vector
 * @typedef {{kind: "near" | "distant", view: Vector, light: Vector}} Scene
 * @typedef {{width: number, height: number}} Grid
 * @typedef {{origin: Vector, originRight: Vector, originUp: Vector, direction: Vector, directionRight: Vector,
 *   directionUp: Vector}} Camera
 * @typedef {{pixelsPerTexel: number, centre: [number, number]}} Framing  Physical pixels per texel, and the point in the middle of the
 *   pane, in texels from the left and from the upper edge: src/viewer/model/view/framing.rs.
 */

/** Room left around the material when it is fitted into a pane. */
const MARGIN = 1.03;
/** Widest view: tangent of half the vertical field of view. */
const WIDEST = 4;
/** Where an orthographic view starts, in units of half the width of the material. */
const FAR_AWAY = 100;
/** Least and greatest magnification of the fitted material. */
const ZOOMS = [0.1, 1000];

/** @param {Vector} a @param {number} s @returns {Vector} */
const scaled = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
/** @param {Vector} a @param {Vector} b @returns {Vector} */
const sum = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
/** @param {Vector} a @param {Vector} b */
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
/** @param {Vector} a @param {Vector} b @returns {Vector} */
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
/** @param {Vector} a */
const norm = (a) => Math.hypot(a[0], a[1], a[2]);
/** @param {Vector} a @returns {Vector} */
const unit = (a) => scaled(a, 1 / norm(a));
/** @param {number} x @param {number} low @param {number} high */
const clamp = (x, low, high) => Math.min(Math.max(x, low), high);

/** @param {Grid} grid @returns {[number, number]} */
function halfExtent({ width, height }) {
  const spacings = Math.max(width, 2) - 1;
  return [width / spacings, height / spacings];
}

/** @param {Grid} grid @returns {Vector[]} */
function corners(grid) {
  const [x, y] = halfExtent(grid);
  return [[-x, -y, 0], [x, -y, 0], [-x, y, 0], [x, y, 0]];
}

/** @param {Grid} grid @param {number} aspect @returns {Camera} */
function flatCamera(grid, aspect) {
  const [halfWidth, halfHeight] = halfExtent(grid);
  const reach = Math.max(halfHeight, halfWidth / aspect) * MARGIN;
  return {
    origin: [0, 0, 1], originRight: [reach * aspect, 0, 0], originUp: [0, reach, 0],
    direction: [0, 0, -1], directionRight: [0, 0, 0], directionUp: [0, 0, 0],
  };
}

/** @param {Scene} scene @param {Grid} grid @param {number} aspect @returns {Camera} */
function sceneCamera(scene, grid, aspect) {
  const forward = scaled(unit(scene.view), -1);
  const right = unit(cross(forward, [0, 1, 0]));
  const up = cross(right, forward);
  const eye = scene.view;
  const nearest = 0.05 * norm(eye);
  const isNear = scene.kind === "near";
  const reaches = corners(grid).map((corner) => {
    const q = isNear ? sum(corner, scaled(eye, -1)) : corner;
    const depth = isNear ? Math.max(dot(q, forward), nearest) : 1;
    return Math.max(Math.abs(dot(q, up) / depth), Math.abs(dot(q, right) / depth) / aspect);
  });
  const widest = Math.max(...reaches) * MARGIN;
  const reach = isNear ? Math.min(widest, WIDEST) : widest;
  const [across, upwards] = [scaled(right, reach * aspect), scaled(up, reach)];
  /** @type {Vector} */
  const none = [0, 0, 0];
  return isNear
    ? { origin: eye, originRight: none, originUp: none, direction: forward, directionRight: across, directionUp: upwards }
    : {
      origin: scaled(forward, -FAR_AWAY), originRight: across, originUp: upwards,
      direction: forward, directionRight: none, directionUp: none,
    };
}

/** Of a camera that looks at the middle of the material: half the height of the pane there, in units of the plane. @param {Camera} c */
function halfHeight(c) {
  const distance = -dot(c.origin, c.direction) / dot(c.direction, c.direction);
  return norm(sum(c.originUp, scaled(c.directionUp, distance)));
}

/**
 * The zoom and pan of a framing, in a pane of `height` physical pixels.
 * @param {Framing} framing @param {Camera} fitted @param {Grid} grid @param {number} height @returns {{zoom: number, pan: [number, number]}}
 */
function framed({ pixelsPerTexel, centre: [column, row] }, fitted, grid, height) {
  const [x, y] = halfExtent(grid);
  const texel = 2 * y / grid.height;
  const zoom = clamp(pixelsPerTexel * 2 * halfHeight(fitted) / (texel * height), ZOOMS[0], ZOOMS[1]);
  // Within the material, so that some of it is seen.
  const [across, down] = [clamp(column / grid.width, 0, 1), clamp(row / grid.height, 0, 1)];
  const at = ndcFromPoint(fitted, [(2 * across - 1) * x, (1 - 2 * down) * y, 0]) ?? [0, 0];
  return { zoom, pan: [-at[0] * zoom, -at[1] * zoom] };
}

/** Magnified by `zoom` and moved by `pan`, in units of the pane. @param {Camera} c @param {number} zoom @param {[number, number]} pan @returns {Camera} */
function zoomed(c, zoom, pan) {
  const [x, y] = [-pan[0] / zoom, -pan[1] / zoom];
  return {
    origin: sum(c.origin, sum(scaled(c.originRight, x), scaled(c.originUp, y))),
    originRight: scaled(c.originRight, 1 / zoom),
    originUp: scaled(c.originUp, 1 / zoom),
    direction: sum(c.direction, sum(scaled(c.directionRight, x), scaled(c.directionUp, y))),
    directionRight: scaled(c.directionRight, 1 / zoom),
    directionUp: scaled(c.directionUp, 1 / zoom),
  };
}

/** The point of the plane that is seen at (x, y) of the pane. @param {Camera} c @param {number} x @param {number} y @returns {[number, number] | null} */
function planeFromNdc(c, x, y) {
  const origin = sum(c.origin, sum(scaled(c.originRight, x), scaled(c.originUp, y)));
  const direction = sum(c.direction, sum(scaled(c.directionRight, x), scaled(c.directionUp, y)));
  if (direction[2] >= 0) return null;
  const t = -origin[2] / direction[2];
  return [origin[0] + direction[0] * t, origin[1] + direction[1] * t];
}

/** Where in the pane the point `p` is seen. @param {Camera} c @param {Vector} p @returns {[number, number] | null} */
function ndcFromPoint(c, p) {
  const q = sum(p, scaled(c.origin, -1));
  const isPerspective = norm(c.originRight) === 0;
  const [a, b, d] = isPerspective ? [c.directionRight, c.directionUp, c.direction] : [c.originRight, c.originUp, c.direction];
  const determinant = dot(a, cross(b, d));
  const [x, y, s] = [dot(q, cross(b, d)), dot(q, cross(d, a)), dot(q, cross(a, b))].map((n) => n / determinant);
  if (!isPerspective) return [x, y];
  return s > 0 ? [x / s, y / s] : null;
}

/** @typedef {{texel: [number, number], cell: [number, number]}} Seen  A texel, and the cell of the plane that shows it. */

/**
 * What covers a point of the plane. Where the material is repeated, cells are counted from the first one of the plane.
 * @param {Grid} grid @param {[number, number]} point @param {boolean} tiled @returns {Seen | null}
 */
function seenAt(grid, [x, y], tiled) {
  const spacings = Math.max(grid.width, 2) - 1;
  const [column, row] = [[x, grid.width], [-y, grid.height]].map(([at, count]) => {
    const place = 0.5 * (at * spacings + count);
    if (!(place >= 0 && place < count)) return null;
    const shown = Math.floor(tiled ? 2 * place + 0.5 * count : place);
    return { texel: shown % count, cell: shown - (tiled ? Math.floor(count / 2) : 0) };
  });
  return column && row && { texel: [column.texel, row.texel], cell: [column.cell, row.cell] };
}
