// What is made stays: the server keeps session, slots and library as they change, and gives them back at the start.

import { notify, withdraw } from "./dom.js";
import { Refusal, Silence } from "./server.js";
import { keptOf } from "./steer/session.js";
import { texts } from "./texts.js";

/** After this the project is written again, where the server was silent, ms. */
const AGAIN_MS = 3000;
/** The status of a project that another page has taken over. */
const CONFLICT = 409;

/** { restore, flush }: brings back the project that the server has, and tells whether there was one; waits until it is written. */
export function startProject({ server, state, session, compare, own }) {
  let saving = null;
  let changed = false;

  const write = async () => {
    try {
      while (changed) {
        changed = false;
        const slots = compare.slots.map((entry) => entry && keptOf(entry));
        await server.keepProject({ ...session.kept, slots, library: own.items });
        withdraw("project");
      }
    } catch (error) {
      if (!(error instanceof Refusal)) throw error;
      if (error instanceof Silence) return void setTimeout(save, AGAIN_MS);
      const action = error.status === CONFLICT ? { label: texts.project.reload, run: () => location.reload() } : { label: texts.server.retry, run: save };
      notify("project", { text: texts.project.not_kept(error.message), help: error.help, action });
    } finally {
      saving = null;
    }
  };
  const save = () => {
    changed = true;
    if (state.get("about")?.project) saving ??= write();
    return saving;
  };

  const restore = async () => {
    const begin = () => [session, compare, own].forEach((part) => part.on("change", save));
    if (!state.get("about").project) return false;
    try {
      const kept = await server.project();
      const isThere = kept.entries?.length > 0;
      own.restore(kept.library ?? []);
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
  return { restore, flush: () => saving };
}
