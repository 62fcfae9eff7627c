// A background colour on an element. The content security policy forbids style attributes, also those of templates;
// a script may set styles.

import { Directive, type ElementPart, directive } from "lit/directive.js";

class Colour extends Directive {
  render(_colour: string): void {}
  override update(part: ElementPart, [colour]: [string]): void {
    (part.element as HTMLElement).style.background = colour;
  }
}

/** `<i ${colour("var(--curve-1)")}>`; empty is none. */
export const colour = directive(Colour);
