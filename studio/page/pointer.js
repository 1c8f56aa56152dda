// Mouse, pen and finger on the stage: strokes, taps, pinches, and the wheel.

const WHEEL_ZOOM = 1.0015;
const WHEEL_STEP_N = 0.1;
/** Pixels of a line, for wheels that count lines. */
const LINE_PX = 16;

/** `turn` changes the force by newtons, `begun` hears of every contact. */
export function followPointer({ surface, hand, force, turn, begun }) {
  const { stage } = surface;
  /** Pointers that touch, by their ids, px. */
  const down = new Map();
  /** The one that strokes. */
  let stroking = null;
  let pinch = null;

  const sample = (event) => {
    const [x_mm, y_mm] = surface.view.toMm(surface.at(event));
    return { t_s: event.timeStamp / 1000, x_mm, y_mm, force_n: force.of(event) };
  };
  const owner = (id) => `pointer ${id}`;
  const spread = () => {
    const [[ax, ay], [bx, by]] = [...down.values()];
    return { apart_px: Math.max(Math.hypot(ax - bx, ay - by), 1), middle_px: [(ax + bx) / 2, (ay + by) / 2] };
  };

  stage.addEventListener("pointerdown", (event) => {
    if (event.button !== 0 || !surface.loaded) return;
    stage.focus({ preventScroll: true });
    stage.setPointerCapture(event.pointerId);
    down.set(event.pointerId, surface.at(event));
    if (down.size === 1) {
      stroking = event.pointerId;
      begun();
      hand.press(owner(stroking), sample(event));
    } else {
      if (stroking !== null) hand.lift(owner(stroking), event.timeStamp / 1000);
      stroking = null;
      pinch = down.size === 2 ? spread() : null;
    }
    // No selection, and no mouse events that imitate a finger.
    event.preventDefault();
  });

  // Raw updates do not wait for the next frame, which a slow picture may hold up.
  const raw = "onpointerrawupdate" in stage;
  stage.addEventListener(raw ? "pointerrawupdate" : "pointermove", (event) => {
    if (event.pointerId !== stroking) return;
    const coalesced = event.getCoalescedEvents?.() ?? [];
    hand.move(owner(stroking), (coalesced.length ? coalesced : [event]).map(sample));
  });

  stage.addEventListener("pointermove", (event) => {
    if (hand.owner === null || event.pointerId === stroking) surface.light(surface.at(event));
    if (!down.has(event.pointerId)) return;
    down.set(event.pointerId, surface.at(event));
    if (pinch && down.size === 2) {
      const now = spread();
      surface.zoom(now.apart_px / pinch.apart_px, now.middle_px);
      pinch = now;
    }
  });

  const up = (event) => {
    if (!down.delete(event.pointerId)) return;
    // For browsers, a finger is a gesture when it is lifted.
    begun();
    pinch = null;
    if (event.pointerId === stroking) {
      hand.lift(owner(stroking), event.timeStamp / 1000);
      stroking = null;
    }
  };
  for (const name of ["pointerup", "pointercancel", "lostpointercapture"]) stage.addEventListener(name, up);
  stage.addEventListener("pointerleave", () => hand.owner === null && surface.light());
  stage.addEventListener("contextmenu", (event) => down.size > 0 && event.preventDefault());

  stage.addEventListener("wheel", (event) => {
    event.preventDefault();
    if (stroking !== null) return turn(event.deltaY < 0 ? WHEEL_STEP_N : -WHEEL_STEP_N);
    const px = event.deltaY * (event.deltaMode === WheelEvent.DOM_DELTA_LINE ? LINE_PX : 1);
    surface.zoom(WHEEL_ZOOM ** -px, surface.at(event));
  }, { passive: false });
}
