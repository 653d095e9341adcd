// The figure: its state, the panes of its layout, and what each of them shows.

/**
 * @typedef {{scene: Scene, quantity: string, model: Record<string, number>, epsilon: number}} Shaded
 * @typedef {{material: number, difference: string | null, wipe: number | null}} Pane
 * @typedef {{key: string, name: string, unit: string, signed: boolean, range: number}} Kind
 * @typedef {{scene: Scene, exposure: number, quantity: string, difference: boolean, layout: string, prediction: number, zoom: number,
 *   pan: [number, number], wipe: number, drag: string, peek: boolean}} State
 * @typedef {{materials: StoredMaterial[], model: Record<string, number>, epsilon: number, convention: string, drawn: string,
 *   kinds: Record<string, Kind>, colours: {heat: string[], diverging: string[]}, shaders: Record<string, ShaderText>,
 *   start: Omit<State, "zoom" | "pan" | "drag" | "peek">, scenes: {scene: Scene, exposure: number}[]}} Data
 */

const LAYOUTS = ["side-by-side", "wipe", "single"];
/** Least width of a pane, in CSS pixels, where others fit below it. */
const NARROWEST = 150;
/** Least side of a pane, in CSS pixels: where all are smaller, one prediction is beside the ground truth. */
const SMALLEST = 100;
/** Heights of panes that differ by less are as good. */
const NEARLY = 0.85;
/** Largest share of the height of the window that the figure takes: there is always room beside it to scroll the page. */
const TALLEST = 0.68;

class Figure {
  /** @param {HTMLCanvasElement} canvas @param {Data} data @param {Maps[]} materials */
  constructor(canvas, data, materials) {
    this.canvas = canvas;
    this.data = data;
    this.materials = materials;
    this.shading = new Shading(canvas, data.shaders, materials);
    this.grid = { width: materials[0].width, height: materials[0].height };
    /** @type {(() => void)[]} Called after every frame. */
    this.watchers = [];
    this.requested = false;
    this.state = this.start();
  }

  /** The state that the report begins with. @returns {State} */
  start() {
    return { ...structuredClone(this.data.start), zoom: 1, pan: [0, 0], drag: "light", peek: false };
  }

  /** Changes the state and draws. @param {Partial<State>} changes */
  set(changes) {
    Object.assign(this.state, changes);
    this.changed();
  }

  /** Draws in the next frame. */
  changed() {
    if (this.requested) return;
    this.requested = true;
    requestAnimationFrame(() => {
      this.requested = false;
      this.draw();
    });
  }

  /** The kind of the difference of the quantity. */
  kind() {
    return this.data.kinds[this.state.quantity];
  }

  /** What is shaded. @returns {Shaded} */
  how() {
    const { scene, quantity } = this.state;
    return { scene, quantity, model: this.data.model, epsilon: this.data.epsilon };
  }

  /** How it is shown. */
  shown() {
    return { exposure: this.state.exposure, range: this.kind().range };
  }

  /** The panes of the layout, in reading order. @returns {Pane[]} */
  panes() {
    const { layout, prediction, peek, difference, wipe } = this.state;
    const count = this.materials.length;
    /** @param {number} material @returns {Pane} */
    const pane = (material) => ({
      material: peek ? 0 : material, wipe: null,
      difference: difference && material > 0 && !peek ? this.kind().key : null,
    });
    if (count === 1) return [pane(0)];
    if (layout === "side-by-side") return (this.hasRoom() ? this.materials.map((_, index) => index) : [0, prediction + 1]).map(pane);
    return [{ ...pane(prediction + 1), wipe: layout === "wipe" && !peek ? wipe : null }];
  }

  /** Whether all materials fit side by side. */
  hasRoom() {
    const { width, height } = this.arrangement(this.materials.length);
    return Math.min(width, height) >= SMALLEST;
  }

  /** Columns and rows, and the size of a pane in CSS pixels. @param {number} count of panes */
  arrangement(count) {
    const width = this.canvas.clientWidth;
    const aspect = clamp(this.grid.width / this.grid.height, 0.4, 2.5);
    const highest = Math.max(innerHeight * TALLEST, 200);
    const all = [];
    for (let columns = 1; columns <= count; columns++) {
      if (columns > 1 && width / columns < NARROWEST) break;
      // No row of many above a row of one.
      if (columns > 2 && count % columns === 1) continue;
      const rows = Math.ceil(count / columns);
      const height = Math.min(width / columns / aspect, highest / rows);
      all.push({ columns, width: width / columns, height });
    }
    // Of those with nearly the largest panes, the one with the fewest rows.
    const largest = Math.max(...all.map(({ height }) => height));
    const best = all.filter(({ height }) => height >= NEARLY * largest).at(-1) ?? all[0];
    return { ...best, rows: Math.ceil(count / best.columns) };
  }

  /** @param {number} width @param {number} height @returns {Camera} */
  camera(width, height) {
    return flatCamera(this.grid, width / height, this.state.zoom, this.state.pan);
  }

  /** The rectangle of each pane, in CSS pixels from the upper left corner. */
  boxes() {
    const panes = this.panes();
    const { columns, width, height } = this.arrangement(panes.length);
    return panes.map((pane, i) => ({
      pane, x: (i % columns) * width, y: Math.floor(i / columns) * height, width, height,
    }));
  }

  draw() {
    const { canvas } = this;
    const { rows, height } = this.arrangement(this.panes().length);
    canvas.style.height = `${rows * height}px`;
    const scale = devicePixelRatio;
    const [w, h] = [Math.round(canvas.clientWidth * scale), Math.round(rows * height * scale)];
    if (canvas.width !== w || canvas.height !== h) [canvas.width, canvas.height] = [w, h];
    this.shading.clear();
    const how = this.how();
    for (const { pane, ...box } of this.boxes()) {
      const gap = 1;
      const [x, y] = [Math.round(box.x * scale) + gap, Math.round(box.y * scale) + gap];
      const right = Math.round((box.x + box.width) * scale) - gap;
      const lower = Math.round((box.y + box.height) * scale) - gap;
      const pixels = { x, y: h - lower, width: right - x, height: lower - y };
      if (pixels.width < 1 || pixels.height < 1) continue;
      this.shading.pane(pane, how, this.camera(box.width, box.height), pixels, this.shown());
    }
    for (const watcher of this.watchers) watcher();
  }

  /** The texel that covers a point of the plane. @param {[number, number]} point */
  texel(point) {
    return texelAt(this.grid, point);
  }

  /** The numbers of a texel of a material. @param {number} material @param {[number, number]} texel */
  value(material, [x, y]) {
    const numbers = [...this.shading.read(this.shading.shade(material, this.how()), { x, y, width: 1, height: 1 })].slice(0, 3);
    return this.state.quantity === "normal" ? numbers.map((n) => 2 * n - 1) : numbers;
  }

  /** The difference of a texel of a prediction. @param {number} material @param {[number, number]} texel */
  difference(material, [x, y]) {
    const target = this.shading.differences(material, this.how(), this.kind().key);
    return this.shading.read(target, { x, y, width: 1, height: 1 })[0];
  }
}
