// The chart alone.

import { css, html } from "lit";
import { base } from "../ui/styles.ts";
import "./curves.ts";
import { Tab } from "./tab.ts";

class ChartTab extends Tab {
  static override styles = [base, css``];

  override render() {
    return html`<pt-curves ${this.given()}></pt-curves>`;
  }
}
customElements.define("pt-chart-tab", ChartTab);
