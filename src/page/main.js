// Starts the figure. Where that fails, the still picture stays, with the reason below it.

/** @param {string} id */
function element(id) {
  const found = document.getElementById(id);
  if (!found) throw new Error(`the page has no ${id}`);
  return found;
}

async function start() {
  /** @type {Data} */
  const data = JSON.parse(element("data").textContent ?? "");
  if (!("DecompressionStream" in window)) throw new Error("this browser inflates no data");
  const materials = await Promise.all(data.materials.map(decodeMaterial));
  const canvas = /** @type {HTMLCanvasElement} */ (element("canvas"));
  const still = /** @type {HTMLImageElement} */ (element("still"));
  const figure = new Figure(canvas, data, materials);
  const reset = () => { Object.assign(figure.state, figure.start()); };
  const overlay = new Overlay(figure, element("panes"));
  const gestures = new Gestures(figure, (texel) => overlay.hover(texel));
  addLegend(figure, element);
  bindControls(figure, element, reset);
  listenToKeys(figure, element("figure"), gestures, reset);
  linkScenes(figure, element("figure"));
  const showCanvas = (/** @type {boolean} */ live) => {
    canvas.hidden = element("panes").hidden = !live;
    still.hidden = live;
    element("controls").hidden = element("hint").hidden = !live;
    document.body.classList.toggle("live", live);
  };
  showCanvas(true);
  figure.draw();
  new ResizeObserver(() => figure.changed()).observe(element("stage"));
  addEventListener("resize", () => figure.changed());
  addEventListener("beforeprint", () => {
    figure.draw();
    still.src = canvas.toDataURL("image/png");
    element("caption").textContent = `In reading order: ${figure.panes().map((pane) => overlay.title(pane)).join("; ")}`;
    for (const details of document.querySelectorAll("section:not(#figure) details")) details.setAttribute("open", "");
  });
  canvas.addEventListener("webglcontextlost", (event) => {
    event.preventDefault();
    showCanvas(false);
    problem("the graphics adapter was lost; reload the page");
  });
  // For pages that embed the figure.
  Object.assign(window, { svbrdf: { figure, overlay } });
}

/** @param {string} reason */
function problem(reason) {
  const note = element("problem");
  note.textContent = `This is a still picture: ${reason}.`;
  note.hidden = false;
}

start().catch((error) => problem(error instanceof Error ? error.message : String(error)));
