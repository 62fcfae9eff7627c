// Colours of words: the language server's semantic tokens.

import { LSPPlugin } from "@codemirror/lsp-client";
import { RangeSetBuilder, StateEffect, StateField, type Text } from "@codemirror/state";
import { Decoration, type DecorationSet, EditorView, ViewPlugin, type ViewUpdate } from "@codemirror/view";
import { decode, type Legend, type Token } from "./tokens.ts";

/** How long nothing must have been typed. The errors of the text come with the same exchange. */
const QUIET_MS = 150;

/** The token types that this page has colours for; the server says by its own list which it gives. */
export const capabilities = {
  textDocument: {
    semanticTokens: {
      requests: { full: true },
      tokenTypes: [
        ...["keyword", "method", "function", "variable", "property", "enumMember"],
        ...["number", "string", "macro", "comment", "operator"],
      ],
      tokenModifiers: ["definition", "readonly"],
      formats: ["relative"],
      overlappingTokenSupport: false,
      multilineTokenSupport: false,
    },
  },
};

const set = StateEffect.define<DecorationSet>();

const field = StateField.define<DecorationSet>({
  create: () => Decoration.none,
  update(decorations, transaction) {
    for (const effect of transaction.effects) if (effect.is(set)) return effect.value;
    return decorations.map(transaction.changes);
  },
  provide: (self) => EditorView.decorations.from(self),
});

/** Decorations of a text. Tokens that do not fit into it are left out. */
function decorate(doc: Text, tokens: readonly Token[]): DecorationSet {
  const builder = new RangeSetBuilder<Decoration>();
  for (const { line, start, length, classes } of tokens) {
    if (line >= doc.lines) break;
    const { from, to } = doc.line(line + 1);
    if (from + start + length <= to) builder.add(from + start, from + start + length, Decoration.mark({ class: classes }));
  }
  return builder.finish();
}

const again = StateEffect.define<null>();

/** Asks anew though nothing was typed: the server came back. */
export function refreshColours(view: EditorView): void {
  view.dispatch({ effects: again.of(null) });
}

const asker = ViewPlugin.fromClass(
  class {
    #timer = 0;
    readonly #view: EditorView;

    constructor(view: EditorView) {
      this.#view = view;
      this.#soon();
    }

    update(update: ViewUpdate): void {
      const asked = update.transactions.some(({ effects }) => effects.some((effect) => effect.is(again)));
      if (update.docChanged || asked) this.#soon();
    }

    destroy(): void {
      clearTimeout(this.#timer);
    }

    #soon(): void {
      clearTimeout(this.#timer);
      this.#timer = window.setTimeout(() => void this.#ask(), QUIET_MS);
    }

    async #ask(): Promise<void> {
      const plugin = LSPPlugin.get(this.#view);
      if (!plugin) return;
      const { doc } = this.#view.state;
      try {
        await plugin.client.initializing;
        const provider = plugin.client.serverCapabilities?.semanticTokensProvider;
        if (!provider) return;
        plugin.client.sync();
        const answer = await plugin.client.request<object, { data: number[] } | null>(
          "textDocument/semanticTokens/full",
          { textDocument: { uri: plugin.uri } },
        );
        // What was typed meanwhile has asked anew.
        if (answer === null || !this.#view.state.doc.eq(doc)) return;
        const tokens = decode(answer.data, provider.legend as Legend);
        this.#view.dispatch({ effects: set.of(decorate(doc, tokens)) });
      } catch {
        // The server is lost or slow: the text stays as it is until it is asked again.
      }
    }
  },
);

export const colours = [field, asker];
