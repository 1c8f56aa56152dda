// A participant may stop at any time, and nothing is kept then.

import { busily, find } from "../page/dom.js";
import { texts } from "./texts.js";

/** The button that stops the study, and its question. */
export function startWithdrawal({ server, page, touch }) {
  const dialog = find("withdraw-dialog");
  find("withdraw").textContent = texts.withdraw.open;
  for (const name of ["title", "text", "yes", "no"]) find(`withdraw-${name}`).textContent = texts.withdraw[name];
  find("withdraw").addEventListener("click", () => {
    touch.rest();
    dialog.showModal();
  });
  find("withdraw-no").addEventListener("click", () => dialog.close());
  find("withdraw-yes").addEventListener("click", () => busily(find("withdraw-yes"), async () => {
    await server.withdraw();
    dialog.close();
    find("withdraw").hidden = true;
    touch.leave();
    page.close(texts.withdraw.done, texts.withdraw.done_text);
  }));
}
