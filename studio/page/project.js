// What is made stays: the server keeps session and slots as they change, and gives them back at the start.

import { notify, withdraw } from "./dom.js";
import { Refusal, Silence } from "./server.js";
import { keptOf } from "./steer/session.js";
import { texts } from "./texts.js";

/** After this the project is written again, where the server was silent, ms. */
const AGAIN_MS = 3000;

/** Returns what brings back the project that the server has: whether there was anything in it. */
export function startProject({ server, state, session, compare }) {
  let saving = false;
  let changed = false;

  const save = async () => {
    changed = true;
    if (saving || !state.get("about")?.project) return;
    saving = true;
    try {
      while (changed) {
        changed = false;
        await server.keepProject({ ...session.kept, slots: compare.slots.map((entry) => entry && keptOf(entry)) });
        withdraw("project");
      }
    } catch (error) {
      if (!(error instanceof Refusal)) throw error;
      if (error instanceof Silence) setTimeout(save, AGAIN_MS);
      else notify("project", { text: texts.project.not_kept(error.message), help: error.help, action: { label: texts.server.retry, run: save } });
    } finally {
      saving = false;
    }
  };

  return async () => {
    const begin = () => [session, compare].forEach((part) => part.on("change", save));
    if (!state.get("about").project) return false;
    try {
      const kept = await server.project();
      const isThere = kept.entries?.length > 0;
      if (isThere) {
        session.restore(kept);
        compare.restore((kept.slots ?? []).map((slot) => slot && session.like(slot)));
      }
      begin();
      return isThere;
    } catch (error) {
      if (!(error instanceof Refusal)) throw error;
      // What cannot be read is not written over.
      notify("project", { text: texts.project.not_read(error.message), help: error.help });
      return false;
    }
  };
}
