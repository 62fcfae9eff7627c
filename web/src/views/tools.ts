// Tools: what helps to set a machine up, one at a time.

import { css, html, nothing } from "lit";
import type { Catalog } from "../api/contract.ts";
import { base } from "../ui/styles.ts";
import "../tools/calculator.ts";
import "../tools/homing-wizard.ts";
import "../tools/preview.ts";
import "../tools/ratio-finder.ts";
import "../tools/tuning.ts";
import { Tab } from "./tab.ts";

/** A tool: its name, and the models that it is for. */
interface Row {
  id: string;
  title: string;
  fits?: (catalog: Catalog) => boolean;
}

const TOOLS: Row[] = [
  { id: "units", title: "Units" },
  { id: "preview", title: "Motion profile" },
  { id: "homing", title: "Homing" },
  { id: "ratio", title: "StepNLoop ratio", fits: (catalog) => catalog.parameters.some(({ role }) => role === "closed_loop_ratio") },
  { id: "tuning", title: "StallGuard & CoolStep", fits: (catalog) => catalog.parameters.some(({ id }) => id.startsWith("AP174.")) },
];


class Tools extends Tab {
  static override properties = { ...Tab.properties, chosen: { state: true } };
  declare chosen: string;

  static override styles = [
    base,
    css`
      .choice {
        margin-bottom: var(--gap);
      }
    `,
  ];

  constructor() {
    super();
    this.chosen = "units";
  }

  override render() {
    return html`
      <div class="row choice" role="group" aria-label="Tools">
        ${TOOLS.filter(({ fits }) => fits?.(this.catalog) ?? true).map(
          ({ id, title }) => html`
            <button aria-pressed=${id === this.chosen} @click=${() => (this.chosen = id)}>${title}</button>
          `,
        )}
      </div>
      ${this.#tool()}
    `;
  }

  #tool() {
    const { device, catalog, live, api, control, active } = this;
    switch (this.chosen) {
      case "units":
        return html`<pt-calculator .device=${device} .catalog=${catalog} .live=${live} .api=${api} .control=${control} .active=${active}></pt-calculator>`;
      case "preview":
        return html`<pt-preview .device=${device} .catalog=${catalog} .live=${live} .api=${api} .control=${control} .active=${active}></pt-preview>`;
      case "homing":
        return html`<pt-homing-wizard .device=${device} .catalog=${catalog} .live=${live} .api=${api} .control=${control} .active=${active}></pt-homing-wizard>`;
      case "ratio":
        return html`<pt-ratio-finder .device=${device} .catalog=${catalog} .live=${live} .api=${api} .control=${control} .active=${active}></pt-ratio-finder>`;
      case "tuning":
        return html`<pt-tuning .device=${device} .catalog=${catalog} .live=${live} .api=${api} .control=${control} .active=${active}></pt-tuning>`;
      default:
        return nothing;
    }
  }
}
customElements.define("pt-tools", Tools);
