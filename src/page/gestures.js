// Mouse, pen, touch: the press decides the gesture, which then does one thing.

/** Factor of a height per notch of the wheel, and of the magnification. */
const SCALE_STEP = 1.1;
const ZOOM_STEP = 1.15;
/** How far from the line of the wipe it is grabbed, in CSS pixels: by a mouse, by a finger. */
const REACH = { mouse: 8, touch: 22 };

/** @typedef {"light" | "view" | "pan" | "wipe"} Gesture */

class Gestures {
  /** @param {Figure} figure @param {(texel: [number, number] | null) => void} hovered */
  constructor(figure, hovered) {
    this.figure = figure;
    this.hovered = hovered;
    /** @type {Map<number, [number, number]>} Where each pointer is, in CSS pixels of the canvas. */
    this.pointers = new Map();
    /** @type {Gesture | null} */
    this.gesture = null;
    this.space = false;
    const { canvas } = figure;
    canvas.addEventListener("pointerdown", (event) => this.down(event));
    canvas.addEventListener("pointermove", (event) => this.move(event));
    for (const kind of /** @type {const} */ (["pointerup", "pointercancel"])) canvas.addEventListener(kind, (event) => this.up(event));
    // WebKit reports a leave where a press ends, too, and a finger has no place after it.
    canvas.addEventListener("pointerleave", (event) => this.hover(this.place(event)));
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    canvas.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
  }

  /** @param {MouseEvent} event @returns {[number, number]} */
  place(event) {
    const { left, top } = this.figure.canvas.getBoundingClientRect();
    return [event.clientX - left, event.clientY - top];
  }

  /** The pane at a place. @param {[number, number]} place */
  paneAt([x, y]) {
    return this.figure.boxes().find((b) => x >= b.x && x < b.x + b.width && y >= b.y && y < b.y + b.height);
  }

  /** The point of the plane that is seen at a place. @param {[number, number]} place @param {ReturnType<Figure["boxes"]>[number]} [of] */
  point(place, of) {
    const box = of ?? this.paneAt(place);
    if (!box) return null;
    const camera = this.figure.camera(box.width, box.height);
    return planeFromNdc(camera, 2 * (place[0] - box.x) / box.width - 1, 1 - 2 * (place[1] - box.y) / box.height);
  }

  /** @param {PointerEvent} event @param {[number, number]} place @returns {Gesture} */
  begin(event, place) {
    const { state } = this.figure;
    const box = this.paneAt(place);
    const reach = event.pointerType === "mouse" ? REACH.mouse : REACH.touch;
    if (event.button === 1 || this.space) return "pan";
    if (event.button === 2 || event.shiftKey) return "view";
    if (box && box.pane.wipe !== null && Math.abs(place[0] - box.x - state.wipe * box.width) <= reach) return "wipe";
    if (state.drag === "view") return "view";
    return state.drag === "pan" || state.quantity !== "rendering" ? "pan" : "light";
  }

  /** @param {PointerEvent} event */
  down(event) {
    const { canvas } = this.figure;
    event.preventDefault();
    canvas.focus({ preventScroll: true });
    canvas.setPointerCapture(event.pointerId);
    const place = this.place(event);
    this.pointers.set(event.pointerId, place);
    this.box = this.paneAt(place);
    if (this.pointers.size > 1) {
      this.gesture = null;
      return;
    }
    this.gesture = this.begin(event, place);
    if (this.gesture !== "pan") this.carryOn(place, [0, 0]);
  }

  /** @param {PointerEvent} event */
  move(event) {
    const place = this.place(event);
    const before = this.pointers.get(event.pointerId);
    if (!before) return this.hover(place);
    if (this.pointers.size === 2) this.pinch(event.pointerId, before, place);
    this.pointers.set(event.pointerId, place);
    if (this.pointers.size === 1) this.carryOn(place, [place[0] - before[0], place[1] - before[1]]);
    this.hover(place);
  }

  /** @param {PointerEvent} event */
  up(event) {
    this.pointers.delete(event.pointerId);
    this.gesture = null;
  }

  /** @param {[number, number]} place */
  hover(place) {
    const point = this.point(place);
    this.hovered(point && this.figure.texel(point));
  }

  /** @param {[number, number]} place @param {[number, number]} moved */
  carryOn(place, [dx, dy]) {
    const { figure, box } = this;
    const { state } = figure;
    const point = this.point(place, box);
    if (!box || !this.gesture || !point) return;
    if (this.gesture === "pan") this.pan([dx, dy], box);
    else if (this.gesture === "wipe") state.wipe = clamp((place[0] - box.x) / box.width, 0, 1);
    else moveOverPlane(state.scene, this.gesture, point);
    figure.changed();
  }

  /** @param {[number, number]} moved @param {{width: number, height: number}} box */
  pan([dx, dy], box) {
    const { state } = this.figure;
    state.pan = [state.pan[0] + 2 * dx / box.width, state.pan[1] - 2 * dy / box.height];
  }

  /** Two fingers: their distance zooms, their middle pans. @param {number} id @param {[number, number]} before @param {[number, number]} now */
  pinch(id, before, now) {
    const other = [...this.pointers].find(([key]) => key !== id)?.[1];
    const { box } = this;
    if (!other || !box) return;
    const apart = (/** @type {[number, number]} */ a) => Math.max(Math.hypot(a[0] - other[0], a[1] - other[1]), 1);
    /** @type {[number, number]} */
    const middle = [(now[0] + other[0]) / 2, (now[1] + other[1]) / 2];
    this.zoom(apart(now) / apart(before), middle, box);
    this.pan([(now[0] - before[0]) / 2, (now[1] - before[1]) / 2], box);
  }

  /** Zooms about a place. @param {number} factor @param {[number, number]} place @param {{x: number, y: number, width: number, height: number}} box */
  zoom(factor, place, box) {
    const { state } = this.figure;
    const zoom = clamp(state.zoom * factor, ZOOMS[0], ZOOMS[1]);
    const at = [2 * (place[0] - box.x) / box.width - 1, 1 - 2 * (place[1] - box.y) / box.height];
    const panned = (/** @type {0 | 1} */ i) => at[i] - (at[i] - state.pan[i]) * zoom / state.zoom;
    state.pan = [panned(0), panned(1)];
    state.zoom = zoom;
    this.figure.changed();
  }

  /** @param {WheelEvent} event */
  wheel(event) {
    if (event.ctrlKey && !event.deltaMode && Math.abs(event.deltaY) >= 100) return;
    event.preventDefault();
    const place = this.place(event);
    const box = this.paneAt(place);
    const delta = event.deltaY + event.deltaX;
    const notches = clamp(-delta / (event.deltaMode === 0 ? 100 : 3), -3, 3);
    if (event.shiftKey) {
      const { scene } = this.figure.state;
      const [x, y, z] = scene.light;
      setEndpoint(scene, "light", [x, y, z * SCALE_STEP ** notches]);
      this.figure.changed();
    } else if (box) {
      this.zoom(ZOOM_STEP ** notches, place, box);
    }
  }
}
