// What all elements look alike in: buttons, fields, tables, panels, lamps, badges.

import { css } from "lit";

export const base = css`
  :host {
    display: block;
  }
  :host([hidden]),
  [hidden] {
    display: none !important;
  }
  *,
  *::before,
  *::after {
    box-sizing: border-box;
  }
  h1,
  h2,
  h3,
  p {
    margin: 0;
  }
  h2 {
    font-size: 13px;
    font-weight: 650;
  }
  h3 {
    font-size: 12px;
    font-weight: 600;
    color: var(--muted);
  }
  a {
    color: var(--accent);
  }
  :focus-visible {
    outline: 2px solid var(--accent);
    outline-offset: 2px;
  }

  button,
  .button {
    display: inline-flex;
    align-items: center;
    justify-content: center;
    gap: 6px;
    min-height: 30px;
    padding: 3px 11px;
    border: 1px solid var(--strong-line);
    border-radius: var(--radius);
    background: var(--raised);
    color: var(--text);
    font: inherit;
    font-weight: 500;
    text-decoration: none;
    white-space: nowrap;
    cursor: pointer;
    touch-action: manipulation;
    user-select: none;
  }
  button:hover:not(:disabled) {
    border-color: var(--accent);
  }
  button:active:not(:disabled),
  button[aria-pressed="true"] {
    background: var(--busy-bg);
    border-color: var(--accent);
    color: var(--accent);
  }
  button:disabled {
    opacity: 0.5;
    cursor: default;
  }
  button.primary {
    background: var(--accent);
    border-color: var(--accent);
    color: var(--on-accent);
  }
  button.danger {
    border-color: var(--error);
    color: var(--error);
  }
  button.stop {
    background: var(--stop);
    border-color: var(--stop);
    color: #fff;
    font-weight: 700;
    letter-spacing: 0.03em;
  }
  button.plain {
    border-color: transparent;
    background: none;
  }
  button.small {
    min-height: 24px;
    padding: 0 8px;
    font-size: 12px;
  }

  input,
  select,
  textarea {
    min-height: 30px;
    padding: 3px 8px;
    border: 1px solid var(--strong-line);
    border-radius: var(--radius);
    background: var(--bg);
    color: var(--text);
    font: inherit;
    font-variant-numeric: tabular-nums;
  }
  input:not([type]),
  input[type="text"],
  input[type="search"],
  select {
    width: 100%;
    min-width: 0;
  }
  input::file-selector-button {
    margin-right: 8px;
    padding: 3px 9px;
    border: 1px solid var(--strong-line);
    border-radius: 4px;
    background: var(--raised);
    color: var(--text);
    font: inherit;
  }
  input.number {
    text-align: right;
  }
  input[type="checkbox"],
  input[type="radio"] {
    min-height: 0;
    width: 16px;
    height: 16px;
    margin: 0;
    accent-color: var(--accent);
  }
  input[type="range"] {
    min-height: 0;
    padding: 0;
    accent-color: var(--accent);
  }
  input:user-invalid,
  input[aria-invalid="true"] {
    border-color: var(--error);
  }
  textarea {
    width: 100%;
    font-family: var(--mono);
    font-size: 13px;
    resize: vertical;
  }
  label {
    display: flex;
    flex-direction: column;
    gap: 2px;
    color: var(--muted);
    font-size: 12px;
  }
  label.line {
    flex-direction: row;
    align-items: center;
    gap: 7px;
    color: var(--text);
    font-size: 14px;
  }
  label input,
  label select,
  label textarea {
    font-size: 14px;
    color: var(--text);
  }
  label textarea {
    font-size: 13px;
  }

  table {
    border-collapse: collapse;
    width: 100%;
  }
  th {
    text-align: left;
    font-weight: 600;
    font-size: 12px;
    color: var(--muted);
  }
  th,
  td {
    padding: 3px 8px;
    border-bottom: 1px solid var(--line);
    vertical-align: baseline;
  }
  td.number,
  th.number {
    text-align: right;
    font-variant-numeric: tabular-nums;
  }

  code,
  .mono {
    font-family: var(--mono);
    font-size: 0.93em;
  }
  .muted {
    color: var(--muted);
  }
  .panel {
    background: var(--panel);
    border: 1px solid var(--line);
    border-radius: 8px;
    padding: 10px 12px;
    min-width: 0;
  }
  .row {
    display: flex;
    flex-wrap: wrap;
    align-items: center;
    gap: 8px;
  }
  .row.end {
    align-items: flex-end;
  }
  .stack {
    display: flex;
    flex-direction: column;
    gap: var(--gap);
    min-width: 0;
  }
  .grow {
    flex: 1 1 auto;
  }

  .badge {
    display: inline-block;
    padding: 0 8px;
    border-radius: 999px;
    background: var(--raised);
    color: var(--muted);
    font-size: 12px;
    font-weight: 600;
    line-height: 20px;
    white-space: nowrap;
  }
  .badge.ok {
    background: var(--ok-bg);
    color: var(--ok);
  }
  .badge.busy {
    background: var(--busy-bg);
    color: var(--busy);
  }
  .badge.warn {
    background: var(--warn-bg);
    color: var(--warn);
  }
  .badge.error {
    background: var(--error-bg);
    color: var(--error);
  }
  .error-text {
    color: var(--error);
  }
  .warn-text {
    color: var(--warn);
  }

  .visually-hidden {
    position: absolute;
    width: 1px;
    height: 1px;
    overflow: hidden;
    clip-path: inset(50%);
    white-space: nowrap;
  }

  @media (pointer: coarse) {
    button:not(.small),
    input:not([type="checkbox"], [type="radio"], [type="range"]),
    select {
      min-height: 38px;
    }
  }
  @media (prefers-reduced-motion: reduce) {
    * {
      transition: none !important;
      animation: none !important;
    }
  }
`;
