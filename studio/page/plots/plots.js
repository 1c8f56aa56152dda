// The live plots of the studio, mounted by one call.

import { element } from "../dom.js";
import { Controls } from "./controls.js";
import { Force } from "./force.js";
import { Friction } from "./friction.js";
import { Models } from "./models.js";
import { Plane } from "./plane.js";
import { Scope } from "./scope.js";
import { Spectrum } from "./spectrum.js";
import { Stage } from "./stage.js";
import { Strip } from "./strip.js";
import { Waveform } from "./waveform.js";

/** Ticks of the worklet, a second. */
const TICK_HZ = 16000;

/**
 * Mounts the plots into `container`; `texts` as in `texts.js`, `runtime` promises the exports of `asperity.wasm`. Returns
 *
 *   begin(tick_hz)               forgets all ticks; those of another rate follow
 *   setTexture(inspect, asset)   the JSON of `asperity inspect --json`, and the asset for the worklet; or null
 *   addTicks(message)            a `ticks` message of the worklet
 */
export function mountPlots(container, runtime, texts) {
  const scope = new Scope(TICK_HZ);
  const root = element("div", { class: "plots" });
  container.append(root);
  let figures = [];
  const live = () => {
    for (const figure of figures) figure.dirty = true;
  };

  const stage = new Stage(root, scope, (now_s) => {
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
  const plane = new Plane(stage, "plane", texts.plane, () => {
    plane.invalidate();
    spectrum.invalidate();
  });
  const spectrum = new Spectrum(stage, "spectrum", texts.spectrum);
  const waveform = new Waveform(stage, "waveform", texts.waveform);
  const force = new Force(stage, "force", texts.force);
  const friction = new Friction(stage, "friction", texts.friction);
  const strip = new Strip(stage, "strip", texts.strip, showMoment);
  const controls = new Controls(scope, texts.controls, { freeze, scrolled: showMoment });
  strip.element.append(controls.element);
  figures = [plane, spectrum, waveform, force, friction, strip];
  root.append(element("div", { class: "plot-board" }, plane.element,
    element("div", { class: "plot-stack" }, spectrum.element, waveform.element),
    element("div", { class: "plot-pair" }, force.element, friction.element), strip.element));

  return {
    begin(tick_hz) {
      scope.begin(tick_hz);
      spectrum.renew();
      showMoment();
    },
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
  };
}
