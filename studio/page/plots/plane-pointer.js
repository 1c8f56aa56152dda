// Choosing a point of the plane, by pointer or keys.

/** A vertex so near takes the pointer to itself, CSS pixels. */
const NEAR_PX = 8;
/** Steps of the keys, shares of the plane; with Shift, `COARSE`. */
const FINE = 0.01;
const COARSE = 0.1;
const KEYS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
/** Where the keys begin without a hand: the stroke that attributes of assets describe. */
const STROKE = { speed_mm_s: 100, force_n: 1 };

export class PlanePointer {
  constructor(plane, chosen) {
    this.plane = plane;
    this.chosen = chosen;
    const { canvas } = plane;
    canvas.addEventListener("pointermove", (event) => this.#point(event));
    canvas.addEventListener("pointerdown", (event) => this.#point(event));
    canvas.addEventListener("pointerleave", (event) => {
      // A finger that is lifted leaves its point.
      if (event.pointerType !== "touch") this.leave();
    });
    canvas.addEventListener("blur", () => this.leave());
    canvas.addEventListener("keydown", (event) => this.#key(event));
  }

  leave() {
    this.#choose(null);
  }

  #choose(point) {
    if (point === null && this.plane.scope.chosen === null) return;
    this.plane.scope.chosen = point;
    this.plane.read_s = -Infinity;
    this.chosen();
  }

  #point({ offsetX, offsetY }) {
    const { placed, scope } = this.plane;
    if (!placed || !scope.models) return;
    const { box, x, y } = placed;
    const { models } = scope;
    let [vertex, nearest] = [null, NEAR_PX];
    models.vertices.forEach(({ speed_mm_s, force_n }, n) => {
      const away = Math.hypot(x(speed_mm_s) - offsetX, y(force_n) - offsetY);
      if (away < nearest) [vertex, nearest] = [n, away];
    });
    if (vertex !== null) return this.#choose(this.#vertex(vertex));
    if (offsetX < box.left || offsetX > box.right || offsetY < box.top || offsetY > box.bottom) return this.leave();
    const share = (offset, from, to) => (offset - from) / (to - from);
    this.#choose({
      speed_mm_s: share(offsetX, box.left, box.right) * models.max_speed_mm_s,
      force_n: share(offsetY, box.bottom, box.top) * models.max_force_n,
    });
  }

  #vertex(vertex) {
    const { speed_mm_s, force_n } = this.plane.scope.models.vertices[vertex];
    return { speed_mm_s, force_n, vertex };
  }

  #key(event) {
    const { scope } = this.plane;
    if (!scope.models) return;
    if (event.key === "Escape") return this.leave();
    const { models } = scope;
    if (event.key === "PageUp" || event.key === "PageDown") {
      event.preventDefault();
      // From model to model, in the order of the asset.
      const count = models.vertices.length;
      const before = scope.chosen?.vertex ?? (event.key === "PageDown" ? -1 : count);
      return this.#choose(this.#vertex((before + (event.key === "PageDown" ? 1 : -1) + count) % count));
    }
    const direction = KEYS[event.key];
    if (!direction) return;
    event.preventDefault();
    const step = event.shiftKey ? COARSE : FINE;
    const from = scope.chosen ?? (scope.hand?.touches ? scope.hand : STROKE);
    this.#choose(models.nearest({
      speed_mm_s: from.speed_mm_s + direction[0] * step * models.max_speed_mm_s,
      force_n: from.force_n + direction[1] * step * models.max_force_n,
    }));
  }
}
