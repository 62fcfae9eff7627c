// The types that cross HTTP. Written by `cargo xtask docs` from those of the server.

/**
 * Something that a controller is to do. Units are those of [`AxisStatus`].
 */
export type Action = { "do": "power",
/**
 * The axis.
 */
axis: string,
/**
 * On or off.
 */
on: boolean, } | { "do": "jog",
/**
 * The axis.
 */
axis: string,
/**
 * Which way.
 */
direction: 1 | -1,
/**
 * The speed from now on; without it that of the axis' parameters.
 */
speed?: number,
/**
 * Whether it goes on only while the WebSocket `live` says so (`hold`), so that the axis stops when whoever
 * began it is gone. The wire knows nothing of it: whoever passes the action on sees to it.
 */
held?: boolean, } | { "do": "move",
/**
 * The targets, by axis.
 */
targets: { [key in string]: number },
/**
 * Whether they count from where the axes stand.
 */
relative: boolean, } | { "do": "stop",
/**
 * The axis; all of them without it.
 */
axis?: string, } | { "do": "abort",
/**
 * The axis; all of them without it.
 */
axis?: string, } | { "do": "home",
/**
 * The axis.
 */
axis: string,
/**
 * How: PMX-2ED-SA 0 to 4 in the order of its manual (`H`, `L`, `ZH`, `Z`, `HL`), CMD-4CR 0 to 12, PD42-1140 1
 * to 8 and what may be added (axis parameter 193).
 */
mode: number,
/**
 * Which way to begin. On the PD42-1140 it is the end whose switch counts, and the modes above 4 say it themselves.
 */
direction: 1 | -1, } | { "do": "set_position",
/**
 * The axis.
 */
axis: string,
/**
 * The position.
 */
value: number, } | { "do": "set_encoder",
/**
 * The axis.
 */
axis: string,
/**
 * The position.
 */
value: number, } | { "do": "clear_error",
/**
 * The axis.
 */
axis: string, } | { "do": "change_speed",
/**
 * The axis.
 */
axis: string,
/**
 * The speed.
 */
speed: number,
/**
 * The acceleration from now on, in the unit of its parameter.
 */
acceleration?: number,
/**
 * The speed window from now on (`SSPDM`); it can only be set at rest.
 */
mode?: number, } | { "do": "change_target",
/**
 * The axis.
 */
axis: string,
/**
 * The target.
 */
target: number, } | { "do": "set_mode",
/**
 * As positions, or from where the axis stands.
 */
absolute: boolean, } | { "do": "output",
/**
 * The name of its pin.
 */
name: string,
/**
 * Its level.
 */
value: Level, };

/**
 * What comes of a line that somebody typed.
 */
export type Answer = {
/**
 * The request, as people write it.
 */
request: string,
/**
 * The reply: the line of an ASCII controller, the value of a TMCL one.
 */
reply: string,
/**
 * What the reply means, if it does not say so itself.
 */
text: string,
/**
 * Whether it was done.
 */
ok: boolean,
/**
 * The bytes that were sent, in hexadecimal.
 */
hex_request: string,
/**
 * The bytes that came.
 */
hex_reply: string, };

/**
 * What an axis did, in the units of its status.
 */
export type AxisSamples = {
/**
 * Positions.
 */
position: Array<number>,
/**
 * Positions as the encoder says.
 */
encoder: Array<number>,
/**
 * Speeds.
 */
speed: Array<number>,
/**
 * Load values, if the controller measures them.
 */
load: Array<number> | null,
/**
 * How far the encoder is from where it should be, if the controller compares.
 */
delta: Array<number> | null, };

/**
 * What an axis is doing.
 */
export type AxisStatus = {
/**
 * Position, in pulses (TMCL: microsteps); with StepNLoop the target position now, in encoder counts.
 */
position: number,
/**
 * Encoder position, in counts (TMCL: microsteps).
 */
encoder: number | null,
/**
 * Speed, in pulses a second (TMCL: internal units). ASCII controllers say no sign: it is that of the way from one
 * look to the next.
 */
speed: number,
/**
 * Where it goes, or has gone last. What was not said over this wire is only known of TMCL modules.
 */
target: number | null,
/**
 * Difference of the position where it should be and the encoder's, if a closed loop looks at it.
 */
delta: number | null,
/**
 * Load value; lower is more.
 */
load: number | null,
/**
 * The status word.
 */
status: number,
/**
 * The names of its bits that are 1.
 */
flags: Array<string>,
/**
 * What it does, in a word: `idle`, `accelerating`, `constant speed`, `decelerating`, `moving`, `homing`.
 */
state: string,
/**
 * What its closed loop does; `None` if it is off or there is none.
 */
loop_state: string | null,
/**
 * Whether the motor has power; `None` if that cannot be switched.
 */
enabled: boolean | null,
/**
 * Whether the negative limit switch is on.
 */
negative_limit: boolean | null,
/**
 * Whether the positive limit switch is on.
 */
positive_limit: boolean | null,
/**
 * Whether the home switch is on.
 */
home: boolean | null,
/**
 * Whether the index of the encoder is on.
 */
index: boolean | null,
/**
 * What is wrong and has to be cleared.
 */
error: string | null, };

/**
 * A model.
 */
export type Catalog = {
/**
 * Its name.
 */
model: string,
/**
 * Its maker's name and what it is.
 */
title: string,
/**
 * What its programs are written in.
 */
language: "tmcl" | "a-script",
/**
 * The names of its axes.
 */
axes: Array<string>,
/**
 * What it counts in.
 */
units: Units,
/**
 * How many standalone programs run at once.
 */
programs: number,
/**
 * How many lines or commands its programs can have together.
 */
program_capacity: number,
/**
 * Its table of speeds; empty if it does not count in pulses a second.
 */
speed_windows: Array<SpeedWindow>,
/**
 * The ways of homing.
 */
homing: Array<HomingMode>,
/**
 * The bits of an axis' status.
 */
status_bits: Array<StatusBit>,
/**
 * The kinds of actions that it knows.
 */
actions: Array<string>,
/**
 * Its parameters, one an axis or index.
 */
parameters: Array<ParameterInfo>,
/**
 * Its commands.
 */
commands: Array<CommandInfo>,
/**
 * Its pins.
 */
pins: Array<PinInfo>, };

/**
 * A command.
 */
export type CommandInfo = {
/**
 * What it begins with.
 */
name: string,
/**
 * Its form.
 */
syntax: string,
/**
 * What it does.
 */
text: string,
/**
 * A line of it.
 */
example: string,
/**
 * The manual's section.
 */
section: string,
/**
 * Unit of its value.
 */
unit: string, };

/**
 * What a source was compiled to.
 */
export type Compiled = {
/**
 * Whether there is a program.
 */
ok: boolean,
/**
 * How many lines or commands it has in the controller.
 */
size: number,
/**
 * Addresses, and the lines of the source that they come from.
 */
lines: Array<[number, number]>,
/**
 * What it was compiled to, for people.
 */
listing: string,
/**
 * Its names and their values, one a line.
 */
symbols: string,
/**
 * What there is to say about the source.
 */
diagnostics: Array<Diagnostic>, };

/**
 * What a debugger sees.
 */
export type DebugState = {
/**
 * The line that waits, if one does.
 */
held: Held | null,
/**
 * The addresses at which programs are held.
 */
breakpoints: Array<number>, };

/**
 * A message about a source.
 */
export type Diagnostic = {
/**
 * Line, from 1.
 */
line: number,
/**
 * Column, from 1.
 */
column: number,
/**
 * What is the matter.
 */
message: string,
/**
 * Whether there is no program because of it.
 */
is_error: boolean, };

/**
 * A kind of fault that virtual controllers can be given.
 */
export type FaultKind = {
/**
 * Its name.
 */
name: string,
/**
 * What it does.
 */
text: string,
/**
 * The keys that it must have, beside those of every fault.
 */
needs: Array<string>,
/**
 * The keys that it may have.
 */
may: Array<string>,
/**
 * Whether it lasts, so that it can have a `duration`.
 */
lasts: boolean, };

/**
 * A controller that answers on a wire.
 */
export type Found = {
/**
 * Its address on a bus.
 */
address: number,
/**
 * Its model's name on a command line; `None` if it is one that we do not know.
 */
model: string | null,
/**
 * The version of its firmware, in its own words.
 */
version: string, };

/**
 * What a debugger lets a controller do next.
 */
export type Go = "continue" | "step" | "pause";

/**
 * A line that waits.
 */
export type Held = {
/**
 * Its program.
 */
program: number,
/**
 * Its address.
 */
address: number, };

/**
 * A way of homing.
 */
export type HomingMode = {
/**
 * Its number, for the action `home`.
 */
id: number,
/**
 * What it is called.
 */
name: string,
/**
 * What it does.
 */
text: string,
/**
 * The directions in which it can be started.
 */
directions: ("+" | "-")[],
/**
 * The manual's section.
 */
section: string, };

/**
 * Who has control, seen by one client.
 */
export type Lease = {
/**
 * The name that the holder gave itself.
 */
holder: string | null,
/**
 * Whether the holder is who asks.
 */
mine: boolean,
/**
 * Seconds until it ends unless it is renewed.
 */
seconds: number, };

/**
 * Control was given.
 */
export type LeaseGrant = {
/**
 * What the header `Control-Lease` has to say.
 */
lease: string,
/**
 * Seconds until it ends unless it is renewed.
 */
seconds: number, };

/**
 * Asks for control.
 */
export type LeaseRequest = {
/**
 * What others see: 1 to 64 characters.
 */
name: string,
/**
 * Whether to take it from its holder.
 */
force: boolean, };

/**
 * The level of an input or output: on or off, or how much.
 */
export type Level = boolean | number;

/**
 * Whether a controller can be reached.
 */
export type LinkState = { "state": "up" } | { "state": "connecting" } | { "state": "lost",
/**
 * Why.
 */
reason: string, };

/**
 * A message.
 */
export type Live = { "type": "status",
/**
 * All of it.
 */
status: Status, } | { "type": "samples",
/**
 * In the order of time.
 */
samples: Samples, } | { "type": "traffic",
/**
 * In the order of time.
 */
traffic: Array<Traffic>, } | { "type": "link",
/**
 * How it is now.
 */
link: LinkState, } | { "type": "debug",
/**
 * How it is now.
 */
debug: DebugState, };

/**
 * What a client says: which jogs that began with `held` go on. It has to be said at least every 600 ms, and the page
 * says it every 200. An axis that this WebSocket has held and no longer names stops, and all of them do when it closes.
 */
export type LiveRequest = { "type": "hold",
/**
 * The axes.
 */
axes: Array<string>,
/**
 * The present lease of whoever says it, unless the address of the WebSocket has it (`lease`); while somebody
 * has control nobody else holds anything.
 */
lease?: string, };

/**
 * A machine.
 */
export type Machine = {
/**
 * What is at each axis.
 */
axes: { [key in string]: MachineAxis }, };

/**
 * What is at an axis. Positions are pulses at full resolution from where it first stood.
 */
export type MachineAxis = {
/**
 * Where the driven side is.
 */
shaft: number,
/**
 * The switch at the negative end is on here and below; there is none on an axis that goes round.
 */
negative_limit: number | null,
/**
 * The switch at the positive end is on here and above.
 */
positive_limit: number | null,
/**
 * The home switch is on from the first to the second position.
 */
home: [number, number] | null,
/**
 * From one index mark to the next.
 */
index_every: number | null,
/**
 * After so many pulses an axis that goes round is where it was.
 */
circumference: number | null,
/**
 * Its load, in parts of the motor's pull-out torque.
 */
load: number,
/**
 * Play between the motor and what it drives.
 */
backlash: number, };

/**
 * An entry of the list of models.
 */
export type ModelInfo = {
/**
 * Its name.
 */
model: string,
/**
 * Its maker's name and what it is.
 */
title: string, };

/**
 * Switches of an axis that are moved.
 */
export type MovedSwitches = {
/**
 * The axis.
 */
axis: string,
/**
 * The switch at the negative end is on here and below.
 */
negative_limit?: number,
/**
 * The switch at the positive end is on here and above.
 */
positive_limit?: number,
/**
 * The home switch is on from the first to the second position.
 */
home?: [number, number], };

/**
 * What is to come.
 */
export type NewDevices = { "bench": string } | { "real": RealDevice };

/**
 * A parameter.
 */
export type ParameterInfo = {
/**
 * What the calls know it by.
 */
id: string,
/**
 * What it has to do with.
 */
group: string,
/**
 * The axis that it belongs to.
 */
axis: string | null,
/**
 * Its name in words.
 */
name: string,
/**
 * Its name in programs.
 */
symbol: string,
/**
 * Unit of its value.
 */
unit: string,
/**
 * What it does.
 */
text: string,
/**
 * The manual's section.
 */
section: string,
/**
 * The least value that can be set.
 */
low: number | null,
/**
 * The greatest one.
 */
high: number | null,
/**
 * From the factory.
 */
default: number | null,
/**
 * Digits after the point.
 */
decimals: number,
/**
 * Whether it can be read.
 */
readable: boolean,
/**
 * Whether it can be set.
 */
writable: boolean,
/**
 * Whether it can outlive the power.
 */
stored: boolean,
/**
 * Whether it is text.
 */
is_text: boolean,
/**
 * What it is for, where other models have the same under other names.
 */
role: Role | null,
/**
 * Whether it can be kept in a file and given back later: no position, output or timer, which would do something.
 */
is_setting: boolean, };

/**
 * A pin.
 */
export type PinInfo = {
/**
 * Its name.
 */
name: string,
/**
 * Direction and kind.
 */
kind: "input" | "output" | "port" | "analog" | "analog_output" | "index",
/**
 * The axis that it belongs to.
 */
axis: string | null,
/**
 * What usually hangs on it; empty for nothing in particular.
 */
role: string,
/**
 * What its number means.
 */
unit: string,
/**
 * The least number on it.
 */
low: number | null,
/**
 * The greatest one.
 */
high: number | null, };

/**
 * What a call says that did not do what it should.
 */
export type Problem = {
/**
 * Why, in a sentence.
 */
error: string,
/**
 * Who has control, if that is why.
 */
holder?: string, };

/**
 * What a program is to do.
 */
export type ProgramAction = { "do": "run",
/**
 * From this address; without it from its beginning.
 */
at?: number, } | { "do": "stop" } | { "do": "pause" } | { "do": "continue" } | { "do": "step" } | { "do": "reset" };

/**
 * Whether a program runs.
 */
export type ProgramState = "idle" | "running" | "paused" | "error";

/**
 * A standalone program.
 */
export type ProgramStatus = {
/**
 * Whether it runs.
 */
state: ProgramState,
/**
 * The address of the line or command that it is at.
 */
counter: number, };

/**
 * A real controller.
 */
export type RealDevice = {
/**
 * What it is to be called: letters, digits and `.`, `_`, `-`.
 */
name: string,
/**
 * The name of its model.
 */
model: string,
/**
 * Where it is: `serial:PATH:BAUD` or `tcp:HOST:PORT`.
 */
link: string,
/**
 * Its address, if it is not alone there.
 */
address?: number, };

/**
 * What a parameter is for.
 */
export type Role = "high_speed" | "low_speed" | "acceleration" | "deceleration" | "own_deceleration" | "s_curve" | "speed_window" | "closed_loop" | "closed_loop_ratio" | "pulser_enable" | "microsteps" | "pulse_divisor" | "ramp_divisor";

/**
 * What axes did, a column a quantity.
 */
export type Samples = {
/**
 * The time of each sample, in seconds of device time; of real controllers since the wire was opened.
 */
seconds: Array<number>,
/**
 * The axes by name.
 */
axes: { [key in string]: AxisSamples }, };

/**
 * A program as people write it.
 */
export type SourceText = {
/**
 * It.
 */
source: string, };

/**
 * A row of a table of speeds.
 */
export type SpeedWindow = {
/**
 * Its number in SSPDM.
 */
number: number,
/**
 * The lowest high speed, in pulses a second.
 */
from_pps: number,
/**
 * The highest one.
 */
to_pps: number,
/**
 * The least low speed.
 */
least_low_pps: number,
/**
 * Speeds are multiples of this.
 */
step_pps: number,
/**
 * The shortest ramp, in milliseconds.
 */
least_ms: number,
/**
 * The gentlest acceleration, in pulses a second each second.
 */
delta: number, };

/**
 * What a controller is doing.
 */
export type Status = {
/**
 * When this was so, in seconds since the wire was opened.
 */
seconds: number,
/**
 * Its axes, by name.
 */
axes: { [key in string]: AxisStatus },
/**
 * Digital inputs, and analog ones in their unit, by the names of their pins.
 */
inputs: { [key in string]: Level },
/**
 * Outputs likewise.
 */
outputs: { [key in string]: Level },
/**
 * Its standalone programs.
 */
programs: Array<ProgramStatus>,
/**
 * Whether targets of moves are positions, or count from where the axis stands; `None` if each move says so.
 */
absolute: boolean | null,
/**
 * What is wrong, one sentence each.
 */
alarms: Array<string>, };

/**
 * A bit of an axis' status.
 */
export type StatusBit = {
/**
 * Which one, from 0.
 */
bit: number,
/**
 * What it is called.
 */
name: string,
/**
 * When it is 1.
 */
text: string,
/**
 * What it says.
 */
kind: "state" | "switch" | "error", };

/**
 * A controller in the list.
 */
export type Summary = {
/**
 * Its name.
 */
name: string,
/**
 * The name of its model.
 */
model: string,
/**
 * Its maker's name and what it is.
 */
title: string,
/**
 * The names of its axes, in its own order.
 */
axis_names: Array<string>,
/**
 * Whether it is in this process or elsewhere.
 */
kind: "virtual" | "real",
/**
 * Where others reach it; of a real one, where it is.
 */
endpoints: Array<string>,
/**
 * Whether it can be reached.
 */
link: LinkState,
/**
 * Whether it can be taken from the list.
 */
removable: boolean, };

/**
 * A request or a reply.
 */
export type Traffic = {
/**
 * When, in seconds since the wire was opened.
 */
at: number,
/**
 * Whether the host sent it.
 */
out: boolean,
/**
 * Its bytes, in hexadecimal.
 */
hex: string,
/**
 * What it says.
 */
text: string,
/**
 * Whether it was asked to see what the controller is doing, over and over, and not because somebody wanted
 * something.
 */
polled: boolean, };

/**
 * A line that somebody typed.
 */
export type TypedLine = {
/**
 * It, without its end.
 */
line: string, };

/**
 * What a model counts in.
 */
export type Units = {
/**
 * Positions.
 */
position: string,
/**
 * Speeds.
 */
speed: string,
/**
 * Encoder positions.
 */
encoder: string, };

/**
 * The value of a parameter.
 */
export type Value = number | number | string;

/**
 * Where to look.
 */
export type WhereToLook = {
/**
 * `serial:PATH:BAUD` or `tcp:HOST:PORT`.
 */
link: string, };
