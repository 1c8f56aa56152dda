// A file for the person: a Blob under a name, without leaving the page.

export function save(name, blob) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  // Some browsers read it later than the click.
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}
