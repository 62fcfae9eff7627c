// Lamps of switches: on is filled and says so to screen readers, off is hollow.

import { css, html, nothing } from "lit";

export const lampStyles = css`
  .lamp {
    display: inline-flex;
    align-items: center;
    gap: 5px;
    color: var(--muted);
    font-size: 12px;
    white-space: nowrap;
  }
  .lamp::before {
    content: "";
    width: 11px;
    height: 11px;
    border: 2px solid var(--strong-line);
    border-radius: 50%;
  }
  .lamp.on {
    color: var(--text);
    font-weight: 650;
  }
  .lamp.on::before {
    border-color: var(--ok);
    background: var(--ok);
  }
  .lamp.on.hot::before {
    border-color: var(--error);
    background: var(--error);
  }
`;

/** `hot` lamps are red when on. Nothing is drawn where there is no such switch. */
export function lamp(label: string, on: boolean | null | undefined, hint: string, hot = false) {
  if (on === null || on === undefined) return nothing;
  return html`
    <span class="lamp ${on ? "on" : ""} ${hot ? "hot" : ""}" title="${hint}: ${on ? "on" : "off"}"
      >${label}<span class="visually-hidden">, ${hint} ${on ? "on" : "off"}</span></span
    >
  `;
}
