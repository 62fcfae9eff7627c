// The lines at which programs are: one that runs, and one that is held.

import { type Extension, RangeSetBuilder, StateEffect, StateField } from "@codemirror/state";
import { Decoration, type DecorationSet, EditorView } from "@codemirror/view";

/** A line (from 1) that is marked. */
export interface Present {
  line: number;
  kind: "running" | "held" | "error";
}

const LINES = {
  running: Decoration.line({ class: "cm-present cm-present-running" }),
  held: Decoration.line({ class: "cm-present cm-present-held" }),
  error: Decoration.line({ class: "cm-present cm-present-error" }),
};

const set = StateEffect.define<readonly Present[]>();

const field = StateField.define<DecorationSet>({
  create: () => Decoration.none,
  update(decorations, transaction) {
    decorations = decorations.map(transaction.changes);
    for (const effect of transaction.effects) {
      if (!effect.is(set)) continue;
      const builder = new RangeSetBuilder<Decoration>();
      for (const { line, kind } of effect.value) {
        if (line > transaction.state.doc.lines) continue;
        const { from } = transaction.state.doc.line(line);
        builder.add(from, from, LINES[kind]);
      }
      decorations = builder.finish();
    }
    return decorations;
  },
  provide: (self) => EditorView.decorations.from(self),
});

/** Marks these lines and no others, in any order. The first held one is brought into sight. */
export function setPresent(view: EditorView, lines: readonly Present[]): void {
  const sorted = [...lines].sort((a, b) => a.line - b.line);
  const held = sorted.find(({ kind, line }) => kind === "held" && line <= view.state.doc.lines);
  const effects: StateEffect<unknown>[] = [set.of(sorted)];
  if (held) effects.push(EditorView.scrollIntoView(view.state.doc.line(held.line).from, { y: "nearest", yMargin: 40 }));
  view.dispatch({ effects });
}

export const presentLines: Extension = field;
