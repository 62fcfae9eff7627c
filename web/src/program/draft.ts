// What stands in the editor outlives the page: a draft for each controller in this browser.

/** A text with its name. */
export interface Draft {
  /** The file's name. */
  name: string;
  text: string;
  /** The text that the controller has in its memory, as far as this page knows. */
  downloaded: string | null;
}

const key = (device: string) => `program ${device}`;

/** The draft of a controller; null if there is none. */
export function load(device: string): Draft | null {
  try {
    const stored = JSON.parse(localStorage.getItem(key(device)) ?? "null") as Partial<Draft> | null;
    if (typeof stored?.name !== "string" || typeof stored.text !== "string") return null;
    const downloaded = typeof stored.downloaded === "string" ? stored.downloaded : null;
    return { name: stored.name, text: stored.text, downloaded };
  } catch {
    return null;
  }
}

/** Keeps a draft. A browser that has no room, or must not, keeps none. */
export function keep(device: string, draft: Draft): void {
  try {
    localStorage.setItem(key(device), JSON.stringify(draft));
  } catch {
    // The text is still in the editor.
  }
}
