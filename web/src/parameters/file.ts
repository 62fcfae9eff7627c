// Parameters in a file: JSON that says which model they are of, and when they were read.

import type { Catalog, ParameterInfo, Value } from "../api/contract.ts";
import { check } from "./value.ts";

const FORMAT = "pulsetrain parameters";
const VERSION = 1;

/** Files that are longer are not read. */
export const MAX_BYTES = 1 << 20;

/** The settings, which a file can give back. */
export function write(catalog: Catalog, device: string, values: Record<string, Value>, date: Date): string {
  const parameters: Record<string, Value> = {};
  for (const info of catalog.parameters) {
    const value = values[info.id];
    if (info.is_setting && value !== undefined) parameters[info.id] = value;
  }
  const file = { format: FORMAT, version: VERSION, model: catalog.model, device, date: date.toISOString(), parameters };
  return `${JSON.stringify(file, null, 2)}\n`;
}

/** What was read: the values that the table allows, and a sentence for each other. */
export interface ParameterFile {
  device: string;
  date: string;
  values: Map<ParameterInfo, Value>;
  problems: string[];
}

/** Reads a file. Null with a sentence if it is none for this model. */
export function read(catalog: Catalog, text: string): ParameterFile | string {
  let file: unknown;
  try {
    file = JSON.parse(text);
  } catch (error) {
    return `The file is not JSON: ${(error as Error).message}.`;
  }
  if (!isObject(file) || file["format"] !== FORMAT) return "The file has no parameters of a controller.";
  if (file["version"] !== VERSION) return "The file is of a newer version of this page.";
  if (file["model"] !== catalog.model) return `The file is of a ${String(file["model"])}, not of a ${catalog.model}.`;
  const parameters = file["parameters"];
  if (!isObject(parameters)) return "The file has no parameters.";
  const known = new Map(catalog.parameters.map((info) => [info.id, info]));
  const values = new Map<ParameterInfo, Value>();
  const problems: string[] = [];
  for (const [id, value] of Object.entries(parameters)) {
    const info = known.get(id);
    const problem = info === undefined ? "There is no such parameter." : info.is_setting ? wrong(info, value) : "Not a setting.";
    if (info !== undefined && problem === null) values.set(info, value as Value);
    else problems.push(`${id}: ${problem}`);
  }
  return { device: String(file["device"] ?? ""), date: String(file["date"] ?? ""), values, problems };
}

function wrong(info: ParameterInfo, value: unknown): string | null {
  return typeof value === "number" || typeof value === "string" ? check(info, value) : "Neither a number nor text.";
}

function isObject(value: unknown): value is Record<string, unknown> {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

/** A parameter that would change. */
export interface Change {
  info: ParameterInfo;
  from: Value | undefined;
  to: Value;
}

/** What writing the values would change, in the order of the table. */
export function changes(catalog: Catalog, wanted: ReadonlyMap<ParameterInfo, Value>, present: Record<string, Value>) {
  const list: Change[] = [];
  for (const info of catalog.parameters) {
    const to = wanted.get(info);
    if (to !== undefined && to !== present[info.id]) list.push({ info, from: present[info.id], to });
  }
  return list;
}
