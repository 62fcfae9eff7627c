// The types that cross HTTP.

export interface Summary {
  name: string;
  model: string;
  title: string;
  kind: "virtual" | "real";
  endpoints: string[];
  link: LinkState;
  removable: boolean;
}
export type LinkState = { state: "up" } | { state: "connecting" } | { state: "lost"; reason: string };

export interface Catalog {
  model: string;
  title: string;
  language: "tmcl" | "a-script";
  axes: string[];
  units: { position: string; speed: string; encoder: string };
  programs: number;
  program_capacity: number;
  /** Pulses-a-second controllers: the rows of their table of speeds. Empty for others. */
  speed_windows: SpeedWindow[];
  homing: HomingMode[];
  status_bits: StatusBit[];
  actions: string[];
  parameters: ParameterInfo[];
  commands: CommandInfo[];
  pins: PinInfo[];
}
export interface SpeedWindow {
  number: number;
  from_pps: number;
  to_pps: number;
  least_low_pps: number;
  step_pps: number;
  least_ms: number;
  delta: number;
}
export interface HomingMode {
  id: number;
  name: string;
  text: string;
  directions: ("+" | "-")[];
  section: string;
}
export interface StatusBit {
  bit: number;
  name: string;
  text: string;
  kind: "state" | "switch" | "error";
}
export interface ParameterInfo {
  id: string;
  group: string;
  axis: string | null;
  name: string;
  symbol: string;
  unit: string;
  text: string;
  section: string;
  low: number | null;
  high: number | null;
  default: number | null;
  decimals: number;
  readable: boolean;
  writable: boolean;
  stored: boolean;
  is_text: boolean;
}
export interface CommandInfo {
  name: string;
  syntax: string;
  text: string;
  example: string;
  section: string;
  unit: string;
}
export interface PinInfo {
  name: string;
  kind: "input" | "output" | "port" | "analog" | "analog_output" | "index";
  axis: string | null;
  role: string;
  unit: string;
  low: number | null;
  high: number | null;
}

export interface Status {
  seconds: number;
  axes: Record<string, AxisStatus>;
  inputs: Record<string, boolean | number>;
  outputs: Record<string, boolean | number>;
  programs: ProgramStatus[];
  absolute: boolean | null;
  alarms: string[];
}
export interface AxisStatus {
  position: number;
  encoder: number | null;
  speed: number;
  target: number | null;
  delta: number | null;
  load: number | null;
  status: number;
  flags: string[];
  state: string;
  loop_state: string | null;
  enabled: boolean | null;
  negative_limit: boolean | null;
  positive_limit: boolean | null;
  home: boolean | null;
  index: boolean | null;
  error: string | null;
}
export interface ProgramStatus {
  state: "idle" | "running" | "paused" | "error";
  counter: number;
}

export type Action =
  | { do: "power"; axis: string; on: boolean }
  | { do: "jog"; axis: string; direction: 1 | -1; speed?: number }
  | { do: "move"; targets: Record<string, number>; relative: boolean }
  | { do: "stop"; axis?: string }
  | { do: "abort"; axis?: string }
  | { do: "home"; axis: string; mode: number; direction: 1 | -1 }
  | { do: "set_position"; axis: string; value: number }
  | { do: "set_encoder"; axis: string; value: number }
  | { do: "clear_error"; axis: string }
  | { do: "change_speed"; axis: string; speed: number; acceleration?: number; mode?: number }
  | { do: "change_target"; axis: string; target: number }
  | { do: "set_mode"; absolute: boolean }
  | { do: "output"; name: string; value: boolean | number };

export interface Answer {
  request: string;
  reply: string;
  text: string;
  ok: boolean;
  hex_request: string;
  hex_reply: string;
}
export interface Traffic {
  at: number;
  out: boolean;
  hex: string;
  text: string;
}

export type Live =
  | { type: "status"; status: Status }
  | { type: "samples"; samples: Samples }
  | { type: "traffic"; traffic: Traffic[] }
  | { type: "link"; link: LinkState }
  | { type: "debug"; debug: DebugState };
export interface Samples {
  seconds: number[];
  axes: Record<string, AxisSamples>;
}
export interface AxisSamples {
  position: number[];
  encoder: number[];
  speed: number[];
  load: number[] | null;
  delta: number[] | null;
}
export interface DebugState {
  held: { program: number; address: number } | null;
  breakpoints: number[];
}

export interface Found {
  address: number;
  model: string | null;
  version: string;
}
export interface Lease {
  holder: string | null;
  mine: boolean;
  seconds: number;
}
export interface Machine {
  axes: Record<string, MachineAxis>;
}
export interface MachineAxis {
  shaft: number;
  negative_limit: number | null;
  positive_limit: number | null;
  home: [number, number] | null;
  index_every: number | null;
  circumference: number | null;
  load: number;
  backlash: number;
}
export interface Compiled {
  ok: boolean;
  size: number;
  lines: [number, number][];
  listing: string;
  symbols: string;
  diagnostics: Diagnostic[];
}
export interface Diagnostic {
  line: number;
  column: number;
  message: string;
  is_error: boolean;
}

/** A parameter's value: text where the table says so. */
export type Value = number | string;
