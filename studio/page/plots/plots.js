// The live plots of the studio, mounted by one call.

import { Controls } from "./controls.js";
import { renderedCsv, trajectoryCsv } from "./csv.js";
import { element } from "./figure.js";
import { Force } from "./force.js";
import { Friction } from "./friction.js";
import { Models } from "./models.js";
import { Plane } from "./plane.js";
import { Scope } from "./scope.js";
import { Spectrum } from "./spectrum.js";
import { Stage } from "./stage.js";
import { Strip } from "./strip.js";
import { texts as english } from "./texts.js";
import { Waveform } from "./waveform.js";

/** Ticks of the worklet, a second. */
const TICK_HZ = 16000;
/** What can be scrolled back to and saved, s. */
const HISTORY_S = 30;

/**
 * Mounts the plots into `container`; `texts` as in `texts.js`, `runtime` promises the exports of `asperity.wasm`. Returns
 *
 *   setTexture(inspect, asset)   the JSON of `asperity inspect --json`, and the asset for the worklet; or null
 *   addTicks(message)     a `ticks` message of the worklet
 *   freeze(on)            whether new ticks are left out, so that the old ones can be looked at
 *   csv(), trajectory()   the ticks kept, as `asperity render` writes and reads them
 *   clear()               forgets all ticks
 *   destroy()
 *
 * The page links `plots.css`.
 */
export function mountPlots(container, runtime, texts = english, { tick_hz = TICK_HZ, history_s = HISTORY_S } = {}) {
  const scope = new Scope(tick_hz, history_s);
  const root = element("div", "plots");
  container.append(root);
  let figures = [];
  const live = () => {
    for (const figure of figures) figure.dirty = true;
  };

  const stage = new Stage(root, (now_s) => {
    const { moved, goes_on } = scope.advance(now_s);
    if (moved) live();
    return goes_on;
  });

  const showMoment = () => {
    live();
    controls.update();
    stage.request();
  };
  const freeze = (on) => {
    scope.freeze(on);
    showMoment();
  };
  const plane = new Plane(stage, scope, texts.plane, () => {
    plane.invalidate();
    spectrum.invalidate();
  });
  const spectrum = new Spectrum(stage, scope, texts.spectrum);
  const waveform = new Waveform(stage, scope, texts.waveform);
  const force = new Force(stage, scope, texts.force);
  const friction = new Friction(stage, scope, texts.friction);
  const strip = new Strip(stage, scope, texts.strip, showMoment);
  const controls = new Controls(scope, texts.controls, { freeze, scrolled: showMoment });
  strip.element.append(controls.element);
  figures = [plane, spectrum, waveform, force, friction, strip];
  const board = element(
    "div",
    "plot-board",
    plane.element,
    element("div", "plot-stack", spectrum.element, waveform.element),
    element("div", "plot-pair", force.element, friction.element),
    strip.element,
  );
  root.append(board);

  return {
    async setTexture(inspect, asset) {
      const loaded = await runtime;
      scope.setTexture(inspect, inspect && new Models(loaded, asset, inspect.ar));
      plane.renew();
      spectrum.renew();
      stage.redrawAll();
    },
    addTicks(message) {
      const began = scope.ring.end === scope.ring.first;
      scope.add(message);
      if (began) controls.update();
      stage.request();
    },
    freeze,
    clear() {
      scope.ring.clear();
      showMoment();
    },
    csv: () => renderedCsv(scope.ring, tick_hz),
    trajectory: () => trajectoryCsv(scope.ring, tick_hz),
    /** What the plots cost: time of the last frame, memory of the ticks. */
    get costs() {
      return { frame_ms: stage.frame_ms, ring_bytes: scope.ring.bytes };
    },
    destroy() {
      stage.destroy();
      root.remove();
    },
  };
}
