// The hand by keys, while the stage has the focus: arrows stroke, Space presses, and the zoom.

import { now_s } from "./hand.js";

const OWNER = "keys";
const STEP_MS = 8;
const ZOOM_STEP = 1.25;
const DIRECTIONS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

/** `speed_mm_s` gives the speed of the arrows, `begun` hears of every contact. */
export function followKeys({ surface, hand, force, speed_mm_s, begun }) {
  const { stage, view } = surface;
  const held = new Set();
  let timer = null;
  let at = null;

  const step = () => {
    const t_s = now_s();
    const ways = [...held].map((key) => DIRECTIONS[key]).filter(Boolean);
    const [x, y] = [0, 1].map((axis) => ways.reduce((sum, way) => sum + way[axis], 0));
    const way_mm = (speed_mm_s() * (t_s - at.t_s)) / Math.max(Math.hypot(x, y), 1);
    at = { t_s, x_mm: at.x_mm + x * way_mm, y_mm: at.y_mm + y * way_mm, force_n: force.set_n() };
    keepInView();
    hand.move(OWNER, [at]);
    surface.light(view.toPx([at.x_mm, at.y_mm]));
    if (hand.owner !== OWNER) release();
  };

  // The surface has no end, so the stage follows the hand.
  const keepInView = () => {
    const px = view.toPx([at.x_mm, at.y_mm]);
    const beyond = px.map((x, axis) => {
      const size = axis === 0 ? view.width_px : view.height_px;
      return x - Math.min(Math.max(x, 0.15 * size), 0.85 * size);
    });
    if (beyond[0] || beyond[1]) surface.shift(beyond);
  };

  const release = () => {
    clearInterval(timer);
    timer = null;
    held.clear();
    hand.lift(OWNER, now_s());
  };

  const press = (key) => {
    held.add(key);
    if (timer !== null) return;
    const [x_mm, y_mm] = at ? [at.x_mm, at.y_mm] : view.toMm([view.width_px / 2, view.height_px / 2]);
    at = { t_s: now_s(), x_mm, y_mm, force_n: force.set_n() };
    keepInView();
    begun();
    hand.press(OWNER, at);
    timer = setInterval(step, STEP_MS);
  };

  stage.addEventListener("keydown", (event) => {
    if (!surface.loaded || event.ctrlKey || event.metaKey || event.altKey) return;
    const { key } = event;
    if (key in DIRECTIONS || key === " ") {
      event.preventDefault();
      if (!event.repeat) press(key);
    } else if (key === "+" || key === "=") surface.zoom(ZOOM_STEP);
    else if (key === "-") surface.zoom(1 / ZOOM_STEP);
    else if (key === "0") surface.reset();
  });
  stage.addEventListener("keyup", ({ key }) => {
    if (held.delete(key) && held.size === 0) release();
  });
  stage.addEventListener("blur", () => timer !== null && release());

  // Shift presses harder, whoever strokes.
  for (const name of ["keydown", "keyup"]) {
    addEventListener(name, (/** @type {any} */ event) => event.key === "Shift" && (force.doubled = name === "keydown"));
  }
  addEventListener("blur", () => (force.doubled = false));
}
