// Files into the page: by drop anywhere, or chosen; several one after another.

import { announce, element, find, notify, withdraw } from "../dom.js";
import { Refusal } from "../server.js";
import { texts } from "../texts.js";
import { isList, watched } from "./batch.js";
import { askMap, isPicture } from "./map.js";

/** Bytes that the server takes. */
const MOST_BYTES = 64 * 2 ** 20;

/** The entry of a folder that is dropped, or `null`. */
function folderOf(item) {
  const entry = item.webkitGetAsEntry?.();
  return entry?.isDirectory ? entry : null;
}

/** The files that lie in a folder itself. */
async function filesOf(folder) {
  const reader = folder.createReader();
  const files = [];
  for (;;) {
    // A browser gives some at a time.
    const entries = await new Promise((done, failed) => reader.readEntries(done, failed));
    if (entries.length === 0) return files;
    const some = entries.filter(({ isFile, name }) => isFile && !name.startsWith("."));
    files.push(...await Promise.all(some.map((entry) => new Promise((done, failed) => entry.file(done, failed)))));
  }
}

/** Why a file is not even sent: { text, help }, or `null`. */
function unfit(file) {
  if (file.size > MOST_BYTES) return { text: texts.files.large(file.name, file.size / 2 ** 20), help: texts.files.large_help };
  return null;
}

export class In {
  #parts;
  #queue = [];
  #done = 0;
  #busy = false;
  #opens = true;

  constructor(parts) {
    this.#parts = parts;
    parts.state.on(["about"], ({ about }) => (this.#opens = about?.opens !== false));
    find("drop").append(element("p", {}, element("strong", {}, texts.files.drop), " ", texts.files.drop_kinds));
    const chooser = find("open-files");
    find("open").addEventListener("click", () => chooser.click());
    chooser.addEventListener("change", () => {
      this.open([...chooser.files].map((file) => ({ file })));
      // So that the same file can be chosen again.
      chooser.value = "";
    });
    this.#followDrags();
  }

  /** Opens files, [{ file, folder }], where `folder` is the entry of one that was dropped. */
  async open(files) {
    this.#queue.push(...files);
    if (this.#busy) return;
    this.#busy = true;
    this.#done = 0;
    while (this.#queue.length > 0) {
      const { file, folder } = this.#queue.shift();
      this.#done++;
      find("opening").textContent = texts.files.opening(file.name, this.#done, this.#done + this.#queue.length);
      const key = `open ${file.name}`;
      withdraw(key);
      const fault = folder ? await this.#tried(file, () => this.#sendFolder(folder)) : unfit(file) ?? (await this.#tried(file, () => this.#send(file)));
      if (fault) notify(key, fault);
      else announce(texts.files.opened(file.name));
    }
    find("opening").textContent = "";
    this.#busy = false;
  }

  /** Shows the texture of a recording or of a material, whose files a folder holds. */
  async #sendFolder(folder) {
    const { server, loader } = this.#parts;
    const { name } = folder;
    const files = await filesOf(folder);
    const isRecording = files.some((file) => file.name === "recording.toml");
    if (!isRecording && !files.some(isPicture)) throw new Refusal(texts.files.folder(name), texts.files.folder_help);
    const stated = isRecording ? {} : await askMap({ name });
    if (!stated) return;
    const bytes = await Promise.all(files.map(async (file) => new File([await file.arrayBuffer()], file.name)));
    const { texture } = await server.openFolder({ name, files: bytes }, stated);
    await loader.take(async () => texture, { kind: "open", name });
  }

  /** Shows what is in a file. */
  async #send(file) {
    const { server, loader, gallery } = this.#parts;
    // A file that cannot be read would look like a server that does not answer.
    const body = new File([await file.arrayBuffer()], file.name);
    const stated = isPicture(file) ? await askMap(file) : {};
    if (!stated) return;
    const asked = server.open(body, stated);
    const opened = await (isList(file) ? watched(server, file, asked) : asked);
    if (opened?.library) await gallery.add(opened.library);
    else if (opened) await loader.take(async () => opened.texture, { kind: "open", name: file.name });
  }

  /** What went wrong, or `null`. */
  async #tried(file, send) {
    try {
      await send();
      return null;
    } catch (error) {
      if (error instanceof DOMException) return { text: texts.files.unread(file.name), help: texts.files.unread_help };
      if (!(error instanceof Refusal)) throw error;
      const named = error.message.includes(file.name);
      return { text: named ? error.message : texts.files.not_opened(file.name, error.message), help: error.help };
    }
  }

  #followDrags() {
    const target = find("drop");
    const brings = ({ dataTransfer }) => this.#opens && dataTransfer?.types.includes("Files");
    // Leaving one element for another one within the page is no end.
    let depth = 0;
    const show = (by) => {
      depth = by === 0 ? 0 : Math.max(depth + by, 0);
      target.hidden = depth === 0;
    };
    addEventListener("dragenter", (event) => brings(event) && show(1));
    addEventListener("dragleave", (event) => brings(event) && show(-1));
    addEventListener("dragover", (event) => {
      if (!brings(event)) return;
      event.preventDefault();
      event.dataTransfer.dropEffect = "copy";
    });
    addEventListener("drop", (event) => {
      if (!brings(event)) return;
      event.preventDefault();
      show(0);
      const items = [...event.dataTransfer.items].filter(({ kind }) => kind === "file");
      this.open(items.map((item) => ({ file: item.getAsFile(), folder: folderOf(item) }))
        .filter(({ file }) => file));
    });
  }
}
