// A studio that a check starts for itself, with a project of its own in a folder, and a library for its gallery.
import { spawn } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { run } from "./aid.mjs";

/** Prompts of some dozens of materials. */
export const KINDS = readFileSync(new URL("../../docs/images/studio-library.txt", import.meta.url), "utf8").trim().split("\n");

/** The library `some.aspl` of prompts in a folder: { file, names }, in the order of its gallery. */
export function library(folder, prompts = KINDS) {
  writeFileSync(join(folder, "some.csv"), ["name,prompt", ...prompts.map((prompt) => `${prompt},${prompt}`), ""].join("\n"));
  run(process.env.ASPERITY, folder, "build", "some.csv", "-o", "some.aspl", "--no-cache", "--quiet");
  const { textures } = JSON.parse(run(process.env.ASPERITY, folder, "list", "some.aspl", "--json"));
  return { file: join(folder, "some.aspl"), names: textures.map(({ name }) => name) };
}

/** A studio, started with `given`, and with `variables` in its environment: { address, end }; `end` takes a signal. */
export async function serve(folder, given, variables = {}) {
  const studio = spawn(process.env.ASPERITY, ["studio", ...given, "--port", "0", "--quiet"],
    { env: { ...process.env, XDG_DATA_HOME: folder, ...variables } });
  const ended = new Promise((done) => studio.on("exit", done));
  const address = await new Promise((done, failed) => {
    studio.stdout.once("data", (text) => done(String(text).trim()));
    studio.stderr.on("data", (text) => failed(new Error(String(text))));
  });
  return { address, end: (signal) => (studio.kill(signal), ended) };
}
