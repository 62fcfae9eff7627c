// The looks of the machine's drawing.

import { css } from "lit";

export const machineStyles = css`
  .axis + .axis {
    margin-top: 10px;
    padding-top: 10px;
    border-top: 1px solid var(--line);
  }
  .head {
    font-size: 13px;
  }
  svg {
    display: block;
    width: 100%;
    font-size: 11px;
    font-variant-numeric: tabular-nums;
    touch-action: pan-y;
  }
  text {
    fill: var(--muted);
  }
  .rail {
    stroke: var(--strong-line);
    stroke-width: 4;
    stroke-linecap: round;
    fill: none;
  }
  .mark {
    stroke: var(--line);
    stroke-width: 1.5;
  }
  .home {
    fill: var(--ok);
    opacity: 0.75;
  }
  .home-arc {
    stroke: var(--ok);
    stroke-width: 6;
    fill: none;
  }
  .carriage {
    fill: var(--accent);
  }
  .slack {
    fill: var(--accent);
    opacity: 0.25;
  }
  .hand {
    stroke: var(--accent);
    stroke-width: 4;
    stroke-linecap: round;
  }
  .switch {
    cursor: grab;
    touch-action: none;
    user-select: none;
    outline: none;
  }
  .switch .body {
    fill: var(--panel);
    stroke: var(--strong-line);
    stroke-width: 2;
  }
  .switch text {
    fill: var(--text);
    font-weight: 650;
    text-anchor: middle;
  }
  .switch.on .body {
    fill: var(--ok);
    stroke: var(--ok);
  }
  .switch.on.limit .body {
    fill: var(--error);
    stroke: var(--error);
  }
  .switch.on .body + text {
    fill: var(--panel);
  }
  .hit {
    fill: transparent;
  }
  .switch:focus-visible .body {
    stroke: var(--accent);
    stroke-width: 3;
  }
`;
