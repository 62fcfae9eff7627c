// Files of the user's computer: saved as downloads, opened by the browser's own dialog.

/** Saves text, or anything else that files are made of, under a name. */
export function save(name: string, content: BlobPart, type = "text/plain;charset=utf-8"): void {
  const url = URL.createObjectURL(new Blob([content], { type }));
  const link = document.createElement("a");
  link.href = url;
  link.download = name;
  link.click();
  // The browser has the file when the click's task is over.
  window.setTimeout(() => URL.revokeObjectURL(url), 0);
}

/** A file that the user opened. */
export interface Opened {
  name: string;
  text: string;
}

/**
 * Asks for a file and reads it; null if the user thought better of it. Latin-1 is taken where it is not UTF-8.
 *
 * Fails with a sentence if the file has more than `maxBytes`.
 */
export function open(accept: string, maxBytes: number): Promise<Opened | null> {
  const input = document.createElement("input");
  input.type = "file";
  input.accept = accept;
  return new Promise((resolve, reject) => {
    input.addEventListener("cancel", () => resolve(null));
    input.addEventListener("change", () => {
      const file = input.files?.[0];
      if (file === undefined) resolve(null);
      else if (file.size > maxBytes) reject(new Error(`${file.name} is longer than ${maxBytes} bytes.`));
      else file.arrayBuffer().then((bytes) => resolve({ name: file.name, text: decode(bytes) }), reject);
    });
    input.click();
  });
}

function decode(bytes: ArrayBuffer): string {
  try {
    return new TextDecoder("utf-8", { fatal: true }).decode(bytes);
  } catch {
    return new TextDecoder("windows-1252").decode(bytes);
  }
}
