// Keys that work wherever no text is written: undo, redo, and the slots.

const NO_TEXT = ["range", "checkbox", "radio", "button", "submit", "file", "color"];

const writes = ({ target }) => target.isContentEditable || target.matches?.("textarea, select")
  || (target.matches?.("input") && !NO_TEXT.includes(target.type));

/** `slot(n)` takes 0 to 3, while `slotKeys()` holds. */
export function followShortcuts({ undo, redo, slot, slotKeys }) {
  addEventListener("keydown", (event) => {
    if (event.defaultPrevented || event.isComposing || event.altKey || writes(event)) return;
    const key = event.key.toLowerCase();
    if (event.ctrlKey || event.metaKey) {
      const run = key === "z" ? (event.shiftKey ? redo : undo) : key === "y" && !event.shiftKey ? redo : null;
      if (!run) return;
      event.preventDefault();
      return run();
    }
    const digit = /^(?:Digit|Numpad)([1-4])$/.exec(event.code)?.[1];
    if (digit && !event.shiftKey && !event.repeat && slotKeys()) slot(Number(digit) - 1);
  });
}
