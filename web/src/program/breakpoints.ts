// Breakpoints in the gutter: a click or F9 sets and takes them. They move with the text.

import { type Extension, RangeSet, RangeSetBuilder, StateEffect, StateField } from "@codemirror/state";
import { EditorView, gutter, GutterMarker, keymap } from "@codemirror/view";

class Dot extends GutterMarker {
  override toDOM(): Node {
    const dot = document.createElement("span");
    dot.className = "cm-breakpoint";
    dot.title = "Breakpoint";
    return dot;
  }
}
const DOT = new Dot();

const setLines = StateEffect.define<readonly number[]>();

const dots = StateField.define<RangeSet<GutterMarker>>({
  create: () => RangeSet.empty,
  update(set, transaction) {
    set = set.map(transaction.changes);
    for (const effect of transaction.effects) {
      if (!effect.is(setLines)) continue;
      const builder = new RangeSetBuilder<GutterMarker>();
      for (const number of effect.value) {
        if (number > transaction.state.doc.lines) continue;
        const { from } = transaction.state.doc.line(number);
        builder.add(from, from, DOT);
      }
      set = builder.finish();
    }
    return set;
  },
});

/** The lines with a breakpoint, from 1. */
export function breakpoints(view: EditorView): number[] {
  const lines = new Set<number>();
  const { doc } = view.state;
  for (const at = view.state.field(dots).iter(); at.value !== null; at.next()) lines.add(doc.lineAt(at.from).number);
  return [...lines].sort((a, b) => a - b);
}

/** Puts breakpoints at these lines and nowhere else. */
export function setBreakpoints(view: EditorView, lines: readonly number[]): void {
  view.dispatch({ effects: setLines.of([...new Set(lines)].sort((a, b) => a - b)) });
}

/** The gutter. `toggle` is asked to set or take the breakpoint of a line; without it there is nothing to see. */
export function breakpointGutter(toggle: ((line: number) => void) | null): Extension {
  if (toggle === null) return dots;
  return [
    dots,
    gutter({
      class: "cm-breakpoints",
      markers: (view) => view.state.field(dots),
      initialSpacer: () => DOT,
      renderEmptyElements: true,
      domEventHandlers: {
        mousedown(view, block) {
          toggle(view.state.doc.lineAt(block.from).number);
          return true;
        },
      },
    }),
    keymap.of([
      {
        key: "F9",
        run(view) {
          toggle(view.state.doc.lineAt(view.state.selection.main.head).number);
          return true;
        },
      },
    ]),
  ];
}
