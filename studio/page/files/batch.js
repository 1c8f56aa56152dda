// A list of prompts that is compiled into a library: how far it is, and the way to stop it.

import { element, find } from "../dom.js";
import { Refusal } from "../server.js";
import { texts } from "../texts.js";

/** How often the server is asked how far it is, ms. */
const EVERY_MS = 400;

/** Whether a file lists prompts. */
export const isList = ({ name }) => /\.(csv|toml|jsonl)$/i.test(name);

/** What `asked` promises of a file, or `null` where a person has stopped it. */
export async function watched(server, { name }, asked) {
  let over = false;
  let stopped = false;
  const said = element("span", {}, texts.files.compiling(name));
  const stop = element("button", { type: "button", id: "stop-batch", onclick: () => {
    stopped = true;
    server.stopBatch().catch(() => {});
  } }, texts.files.stop);
  find("opening").replaceChildren(said, " ", stop);
  const follow = async () => {
    while (!over) {
      await new Promise((done) => setTimeout(done, EVERY_MS));
      const { done, total } = over ? {} : await server.batch().catch(() => ({}));
      if (!over && total) said.textContent = texts.files.compiled(name, done, total);
    }
  };
  follow();
  try {
    return await asked;
  } catch (error) {
    if (stopped && error instanceof Refusal) return null;
    throw error;
  } finally {
    over = true;
  }
}
