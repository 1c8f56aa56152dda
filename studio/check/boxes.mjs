// What must not happen at any size: parts that lie on each other, stick out of their panel, or cannot be read under a pointer.

/** Elements that people read or use; what lies on the picture or on another control on purpose is none. */
const PARTS = "button, select, input[type=text], h2, h3, output, summary, .told, .facts, .value, .badge, .small";
const LAID_ON = ".zoom, .scale, .put, .rail, .suggestions, .notices, .stage, .segments, .unseen, .take, .hits, dialog";

/** Runs in the page: what lies wrong, in words. */
function wrong([parts, laidOn]) {
  const isSeen = (at) => at.checkVisibility({ visibilityProperty: true, checkVisibilityCSS: true }) && !at.closest(laidOn);
  /** What of an element is seen: its box, cut by what scrolls or hides around it. */
  const boxOf = (at) => {
    let { left, top, right, bottom } = at.getBoundingClientRect();
    for (let around = at.parentElement; around; around = around.parentElement) {
      if (getComputedStyle(around).overflow === "visible") continue;
      const cut = around.getBoundingClientRect();
      [left, top, right, bottom] = [Math.max(left, cut.left), Math.max(top, cut.top), Math.min(right, cut.right), Math.min(bottom, cut.bottom)];
    }
    return { at, left, top, right, bottom };
  };
  const name = ({ at }) => `${at.id ? `#${at.id}` : `${at.tagName.toLowerCase()}.${at.className}`} “${at.textContent.trim().slice(0, 24)}”`;
  const boxes = [...document.querySelectorAll(parts)].filter(isSeen).map(boxOf).filter(({ left, top, right, bottom }) => right - left > 1 && bottom - top > 1);
  const found = [];
  for (const box of boxes) {
    const panel = box.at.closest(".panel, .bar")?.getBoundingClientRect();
    if (panel && (box.right > panel.right + 1 || box.left < panel.left - 1)) found.push(`${name(box)} sticks out of its panel`);
  }
  boxes.forEach((a, n) => {
    for (const b of boxes.slice(n + 1)) {
      if (a.at.contains(b.at) || b.at.contains(a.at)) continue;
      const [wide, high] = [Math.min(a.right, b.right) - Math.max(a.left, b.left), Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top)];
      if (wide > 2 && high > 2) found.push(`${name(a)} and ${name(b)} overlap by ${wide.toFixed(0)} × ${high.toFixed(0)} px`);
    }
  });
  return found;
}

/** Whether everything has its own place in the page as it is. */
export async function placed(page, assert, what) {
  const found = await page.evaluate(wrong, [PARTS, LAID_ON]);
  assert(found.length === 0, `nothing lies on anything else ${what}${found.slice(0, 6).map((text) => `; ${text}`).join("")}`);
}

/** A mark on one button of each look: what else it is called in its place has the same colours. */
function markLooks() {
  const looks = new Set();
  for (const button of document.querySelectorAll("button")) {
    const look = [button.className, button.id === "auto", button.ariaPressed, button.ariaCurrent, button.parentElement.className].join();
    button.toggleAttribute("data-look", !looks.has(look) && button.checkVisibility() && !button.disabled);
    if (button.hasAttribute("data-look")) looks.add(look);
  }
}

/** Whether buttons of every look can be read under the pointer. */
export async function readable(page, assert, what) {
  await page.emulateMedia({ reducedMotion: "reduce" });
  const poor = [];
  await page.evaluate(markLooks);
  for (const button of await page.locator("button[data-look]").all()) {
    await button.hover({ timeout: 1000 }).catch(() => {});
    poor.push(...await button.evaluate(async (at) => {
      const { violations } = await window.axe.run(at, { runOnly: ["color-contrast"] });
      return violations.flatMap(({ nodes }) => nodes.map(({ target, any }) => `${target}: ${any[0]?.data?.contrastRatio}`));
    }));
  }
  await page.emulateMedia({ reducedMotion: "no-preference" });
  assert(poor.length === 0, `buttons can be read under the pointer ${what}${poor.map((text) => `; ${text}`).join("")}`);
}
