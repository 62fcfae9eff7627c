// The tabs of a controller's page, in their order: name in the address, title, element, and the file with it,
// which is loaded when the tab is first shown.

import type { Catalog, Summary } from "../api/contract.ts";

export interface TabRow {
  id: string;
  title: string;
  element: string;
  load: () => Promise<unknown>;
  /** Whether a device has this tab; without it each has. */
  fits?: (device: Summary, catalog: Catalog) => boolean;
}

export const TABS: TabRow[] = [
  { id: "control", title: "Control", element: "pt-control", load: () => import("./control.ts") },
  { id: "chart", title: "Chart", element: "pt-chart-tab", load: () => import("./chart.ts") },
  { id: "io", title: "I/O", element: "pt-io", load: () => import("./io.ts") },
  { id: "terminal", title: "Terminal", element: "pt-terminal", load: () => import("./terminal.ts") },
  { id: "parameters", title: "Parameters", element: "pt-parameters", load: () => import("./parameters.ts") },
  { id: "program", title: "Program", element: "pt-program", load: () => import("./program.ts") },
  { id: "tools", title: "Tools", element: "pt-tools", load: () => import("./tools.ts") },
];
