// Links from the findings to the figure: worst scenes and directions of the light.

/** Half of the side of a map over directions, on which the disk has the radius 1. */
const DISK = 1.08;

/** @param {Figure} figure @param {HTMLElement} section */
function linkFindings(figure, section) {
  const { state, data } = figure;
  const show = () => {
    Object.assign(state, { quantity: "rendering", zoom: 1, pan: [0, 0] });
    figure.changed();
    section.scrollIntoView({ block: "start", behavior: matchMedia("(prefers-reduced-motion: reduce)").matches ? "auto" : "smooth" });
    figure.canvas.focus({ preventScroll: true });
  };
  document.querySelectorAll("button[data-scene]").forEach((button) => {
    button.removeAttribute("disabled");
    button.addEventListener("click", () => {
      const { scene, exposure } = data.scenes[Number(/** @type {HTMLElement} */ (button).dataset.scene)];
      Object.assign(state.scene, structuredClone(scene));
      state.exposure = exposure;
      show();
    });
  });
  document.querySelectorAll("svg.directions").forEach((map) => {
    const svg = /** @type {SVGSVGElement} */ (map);
    const cursor = /** @type {SVGElement} */ (svg.querySelector(".cursor"));
    let [x, y] = [0, 0];
    const put = () => {
      const across = Math.hypot(x, y);
      const shrink = across > 0.97 ? 0.97 / across : 1;
      [x, y] = [x * shrink, y * shrink];
      cursor.setAttribute("cx", String(x));
      cursor.setAttribute("cy", String(-y));
      cursor.removeAttribute("visibility");
      Object.assign(state.scene, { kind: "distant", view: [0, 0, 1], light: [x, y, Math.sqrt(1 - x * x - y * y)] });
      Object.assign(state, { quantity: "rendering" });
      figure.changed();
    };
    svg.setAttribute("tabindex", "0");
    svg.setAttribute("role", "application");
    svg.addEventListener("click", (event) => {
      const { left, top, width, height } = svg.getBoundingClientRect();
      [x, y] = [DISK * (2 * (event.clientX - left) / width - 1), DISK * (1 - 2 * (event.clientY - top) / height)];
      put();
      show();
    });
    svg.addEventListener("keydown", (event) => {
      const moves = /** @type {Record<string, number[]>} */ ({ ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] });
      const move = moves[event.key];
      if (event.key === "Enter") show();
      if (!move) return;
      event.preventDefault();
      [x, y] = [x + 0.05 * move[0], y + 0.05 * move[1]];
      put();
    });
  });
}
