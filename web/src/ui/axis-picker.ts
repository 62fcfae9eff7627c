// Which axis: a row of radio buttons; nothing where there is only one.

import { html, nothing } from "lit";

export function axisPicker(axes: string[], chosen: string, group: string, pick: (axis: string) => void) {
  if (axes.length < 2) return nothing;
  return html`
    <div class="row" role="radiogroup" aria-label="Axis">
      ${axes.map(
        (axis) => html`
          <label class="line">
            <input type="radio" name=${group} .checked=${axis === chosen} @change=${() => pick(axis)} />${axis}
          </label>
        `,
      )}
    </div>
  `;
}
