// The project's own examples. All of them together are smaller than a picture, so they come with the editor.

const FILES = {
  ...import.meta.glob<string>("../../../examples/tmcl/*.tmc", { query: "?raw", import: "default", eager: true }),
  ...import.meta.glob<string>("../../../examples/ascript/*/*.prg", { query: "?raw", import: "default", eager: true }),
};

/** The folder with the examples of a model. */
const FOLDERS: Record<string, string> = {
  "pd42-1140": "/tmcl/",
  "pmx-2ed": "/ascript/performax/",
  "cmd-4cr": "/ascript/commander/",
};

export interface Example {
  /** The file's name. */
  name: string;
  text: string;
}

/** The examples of a model, by name. */
export function examples(model: string): Example[] {
  const folder = FOLDERS[model];
  if (folder === undefined) return [];
  return Object.entries(FILES)
    .filter(([path]) => path.includes(folder))
    .map(([path, text]) => ({ name: path.slice(path.lastIndexOf("/") + 1), text }))
    .sort((a, b) => a.name.localeCompare(b.name));
}
