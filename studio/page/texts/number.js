// Numbers as the page writes them.

export const number = (value, digits) =>
  value.toLocaleString("en", { minimumFractionDigits: digits, maximumFractionDigits: digits }).replace("-", "−");

/** Two numbers with as many digits as show that they differ. */
export function apart(old, now, digits) {
  const most = digits + 6;
  while (digits < most && number(old, digits) === number(now, digits)) digits++;
  return `${number(old, digits)} → ${number(now, digits)}`;
}
