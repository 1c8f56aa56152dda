// The texts of the plots, in English. Functions take what they name.

import { signed } from "./axes.js";

const place = (/** @type {any} */ { speed_mm_s, force_n }) => `${signed(speed_mm_s, 0)} mm/s, ${signed(force_n, 2)} N`;
const level = (db) => (Number.isFinite(db) ? `${signed(db, 1)} dB` : "silent");
const kinds = { interior: "measured model", edge: "edge model" };
const span = (range, decimals, unit) =>
  range ? `${signed(range[0], decimals)} to ${signed(range[1], decimals)} ${unit}` : "none";
const mu = (least, most) =>
  least === most ? `μ ${least.toFixed(2)}` : `μ ${least.toFixed(2)} to ${most.toFixed(2)} over speed`;

export const texts = {
  plane: {
    title: "Speed × force",
    hint: "Arrow keys move a point, Shift in larger steps; Page Up and Page Down go from model to model; Escape ends; Enter reads the figure aloud.",
    speed_axis: "Speed, mm/s",
    force_axis: "Force, N",
    level_axis: "dB re 1 (m/s²)²",
    legend: {
      hand: "hand",
      outside: "hand beyond the grid",
      interior: "model",
      edge: "edge model",
      contour: ({ every_db, floor_hz }) => `a line every ${every_db} dB of vibration above ${floor_hz} Hz`,
    },
    hand: ({ outside, level_db, ...at }) => `${place(at)}: ${level(level_db)}${outside ? ", edge model" : ""}`,
    lifted: ({ speed_mm_s }) => `${signed(speed_mm_s, 0)} mm/s, not touching`,
    chosen: ({ kind, level_db, ...at }) => `${kind ? `${kinds[kind]} at ` : ""}${place(at)}: ${level(level_db)}`,
    no_hand: "No hand yet",
    no_texture: "No texture yet",
    about: ({ max_speed_mm_s, max_force_n, triangles, low_db, high_db }, { interior, edge }) =>
      `Up to ${signed(max_speed_mm_s, 0)} mm/s and ${signed(max_force_n, 1)} N; ${interior} models, ${edge} edge models, ` +
      `${triangles.length} triangles; colours from ${signed(low_db, 0)} to ${signed(high_db, 0)} dB`,
  },
  spectrum: {
    title: "Spectrum",
    hint: "Enter reads the figure aloud.",
    frequency_axis: "Frequency, Hz",
    density_axis: "dB re 1 (m/s²)²/Hz",
    model_ends: "half the model’s rate",
    legend: {
      measured: "vibration and taps, last 0.5 s",
      expected: "expected from the model",
      chosen: "model at the chosen point",
    },
    strongest: ({ freq_hz }) => `strongest at ${signed(freq_hz, 0)} Hz`,
    expected: ({ freq_hz }) => `The model is strongest at ${signed(freq_hz, 0)} Hz`,
    silent: "silent",
  },
  waveform: {
    title: "Waveform",
    hint: "Enter reads the figure aloud.",
    time_axis: "Time, ms",
    acceleration_axis: "Acceleration, m/s²",
    legend: { measured: "vibration", tap: "tap" },
    loudness: ({ rms_m_s2, peak_m_s2 }) => `${signed(rms_m_s2, 2)} m/s² RMS, peak ${signed(peak_m_s2, 1)}`,
    silent: "silent",
  },
  force: {
    title: "Force on the hand",
    hint: "Enter reads the figure aloud.",
    x_axis: "x, N",
    y_axis: "From above: y, N",
    z_axis: "From the side: z, N",
    legend: { arrow: "mean of 20 ms", dot: "each ms", limit: "limit of the device" },
    force: ({ fx_n, fy_n, fz_n }) => `x ${signed(fx_n, 2)}, y ${signed(fy_n, 2)}, z ${signed(fz_n, 2)} N`,
    silent: "no force yet",
  },
  friction: {
    title: "Friction",
    hint: "Enter reads the figure aloud.",
    normal_axis: "Normal force, N",
    friction_axis: "Friction, N",
    legend: { dot: "last 2 s", line: "μ of the texture" },
    ratio: ({ friction_n, normal_n, ratio }) =>
      `${signed(friction_n, 2)} N at ${signed(normal_n, 2)} N: ${signed(ratio, 2)}`,
    coefficient: mu,
    silent: "no contact",
  },
  strip: {
    title: "Last ten seconds",
    hint: "While frozen, arrow keys, Page Up, Page Down, Home and End scroll; Enter reads the figure aloud.",
    time_axis: "Time, s",
    lanes: {
      speed: "Speed, mm/s",
      force: "Normal force, N",
      vibration: "Vibration, m/s²",
      tap: "Tap, N",
      friction: "Friction, N",
    },
    running: (t_s) => `at ${t_s.toFixed(1)} s`,
    frozen: (t_s) => `frozen at ${t_s.toFixed(3)} s`,
    at: ({ t_s, speed, force, vibration, tap, friction }) =>
      `${t_s.toFixed(3)} s: ${signed(speed, 0)} mm/s, ${signed(force, 2)} N, ${signed(vibration, 2)} m/s², tap ${signed(tap, 2)} N, friction ${signed(friction, 2)} N`,
    ranges: ({ speed, force, vibration, tap, friction }) =>
      `Speed ${span(speed, 0, "mm/s")}, force ${span(force, 2, "N")}, vibration ${span(vibration, 2, "m/s²")}, tap ${span(tap, 2, "N")}, friction ${span(friction, 2, "N")}`,
  },
  controls: {
    freeze: "Freeze",
    run: "Run",
    scroll: "Moment shown",
    moment: (t_s) => `${t_s.toFixed(2)} s`,
    save: "Save as CSV",
    save_trajectory: "Save the trajectory",
    file: "asperity-ticks.csv",
    trajectory_file: "asperity-trajectory.csv",
  },
};
