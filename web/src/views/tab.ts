// A tab of a controller's page: what each is given, and how it hears of news.

import { LitElement, type PropertyDeclarations, type PropertyValues } from "lit";
import { Directive, type ElementPart, PartType, type PartInfo, directive } from "lit/directive.js";
import type { Api } from "../api/client.ts";
import type { Catalog, Summary } from "../api/contract.ts";
import type { Control } from "../state/control.ts";
import type { LiveEvent, LiveStore } from "../state/live.ts";

/** Sets properties of an element, those that have changed. */
class Give extends Directive {
  constructor(part: PartInfo) {
    super(part);
    if (part.type !== PartType.ELEMENT) throw new Error("properties are given to elements");
  }
  render(_properties: Partial<Tab>): void {}
  override update(part: ElementPart, [properties]: [Partial<Tab>]): void {
    Object.assign(part.element, properties);
  }
}
const give = directive(Give);

/**
 * A tab derives from this and is drawn anew when one of `watches` changes. A tab that is not shown stays as it
 * is, with what was typed into it, and is not drawn.
 *
 * A tab with properties of its own writes `static override properties = { ...Tab.properties, mine: {...} }`.
 */
export class Tab extends LitElement {
  static override properties: PropertyDeclarations = {
    device: { attribute: false },
    catalog: { attribute: false },
    live: { attribute: false },
    api: { attribute: false },
    control: { attribute: false },
    active: { attribute: false },
  };
  /** Which device. */
  declare device: Summary;
  /** What its model has. */
  declare catalog: Catalog;
  /** What it says of itself. */
  declare live: LiveStore;
  /** The server. */
  declare api: Api;
  /** Who may change something. */
  declare control: Control;
  /** Whether the tab is shown. */
  declare active: boolean;

  /** What of `live` the tab shows. */
  protected readonly watches: readonly LiveEvent[] = [];

  #watched: LiveStore | null = null;
  readonly #refresh = () => this.requestUpdate();

  /** Whether somebody else has control. */
  get locked(): boolean {
    return this.control.holder !== null && !this.control.mine;
  }

  /** Whether the device can be reached. */
  get reachable(): boolean {
    return this.live.connected && this.live.link.state === "up";
  }

  /** Whether a button that changes something makes sense. */
  get usable(): boolean {
    return this.reachable && !this.locked;
  }

  /** What a part of this tab is given, where it stands in a template: `<pt-part ${this.given()}>`. */
  protected given() {
    const { device, catalog, live, api, control, active } = this;
    return give({ device, catalog, live, api, control, active });
  }

  override connectedCallback(): void {
    super.connectedCallback();
    this.#follow();
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.#unfollow();
  }

  override willUpdate(changed: PropertyValues): void {
    if (changed.has("live") || changed.has("active")) this.#follow();
  }

  #follow(): void {
    this.#unfollow();
    if (!this.live || !this.active) return;
    this.#watched = this.live;
    for (const kind of this.#kinds()) this.live.addEventListener(kind, this.#refresh);
    this.control.addEventListener("change", this.#refresh);
  }

  #unfollow(): void {
    if (!this.#watched) return;
    for (const kind of this.#kinds()) this.#watched.removeEventListener(kind, this.#refresh);
    this.control.removeEventListener("change", this.#refresh);
    this.#watched = null;
  }

  #kinds(): LiveEvent[] {
    return [...this.watches, "link", "connection"];
  }
}
