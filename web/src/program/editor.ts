// The editor of programs: CodeMirror with the project's own language server behind it.

import { closeBrackets } from "@codemirror/autocomplete";
import { defaultKeymap, history, historyKeymap } from "@codemirror/commands";
import { bracketMatching, indentUnit } from "@codemirror/language";
import { lintGutter, lintKeymap } from "@codemirror/lint";
import { formatDocument, languageServerExtensions, LSPClient } from "@codemirror/lsp-client";
import { highlightSelectionMatches, searchKeymap } from "@codemirror/search";
import { EditorState } from "@codemirror/state";
import {
  drawSelection,
  EditorView,
  highlightActiveLine,
  highlightActiveLineGutter,
  keymap,
  lineNumbers,
  rectangularSelection,
} from "@codemirror/view";
import type { Catalog } from "../api/contract.ts";
import { breakpointGutter, breakpoints, setBreakpoints } from "./breakpoints.ts";
import { capabilities, colours, refreshColours } from "./colours.ts";
import { Link } from "./link.ts";
import { type Present, presentLines, setPresent } from "./present.ts";
import { sanitize } from "./sanitize.ts";
import { theme } from "./theme.ts";

/** What an editor tells and asks. */
export interface Hooks {
  /** A WebSocket to the language server. */
  socket(): WebSocket;
  /** The text was changed. */
  changed(): void;
  /** Somebody wants to set or take the breakpoint of a line; null where there are no breakpoints. */
  toggle: ((line: number) => void) | null;
  /** Whether the language server is there. */
  server(up: boolean): void;
}

/** The usual ends of names of files, by language. */
export const EXTENSIONS = { tmcl: ".tmc", "a-script": ".prg" } as const;

const COMMENT = { tmcl: "//", "a-script": ";" } as const;

export class Editor {
  readonly #view: EditorView;
  readonly #link: Link;

  constructor(parent: HTMLElement, catalog: Catalog, text: string, hooks: Hooks) {
    const { language, model } = catalog;
    const client = new LSPClient({
      initializationOptions: { model },
      extensions: [...languageServerExtensions(), { clientCapabilities: capabilities, editorExtension: colours }],
      sanitizeHTML: sanitize,
    });
    this.#view = new EditorView({
      parent,
      root: parent.getRootNode() as ShadowRoot,
      state: EditorState.create({
        doc: text,
        extensions: [
          breakpointGutter(hooks.toggle),
          lineNumbers(),
          lintGutter(),
          highlightActiveLine(),
          highlightActiveLineGutter(),
          highlightSelectionMatches(),
          drawSelection(),
          rectangularSelection(),
          bracketMatching(),
          closeBrackets(),
          history(),
          indentUnit.of("  "),
          presentLines,
          // Tab leaves the editor, as it leaves everything: it is formatted, not indented by hand.
          keymap.of([...defaultKeymap, ...historyKeymap, ...searchKeymap, ...lintKeymap]),
          EditorState.languageData.of(() => [{ commentTokens: { line: COMMENT[language] } }]),
          EditorView.updateListener.of((update) => update.docChanged && hooks.changed()),
          EditorView.contentAttributes.of({ "aria-label": "Program" }),
          client.plugin(`file:///program${EXTENSIONS[language]}`, language),
          theme,
        ],
      }),
    });
    this.#link = new Link(client, hooks.socket, (up) => {
      if (up) refreshColours(this.#view);
      hooks.server(up);
    });
  }

  get text(): string {
    return this.#view.state.doc.toString();
  }

  /** Another text: what could be undone before can still be. */
  set text(text: string) {
    const { state } = this.#view;
    this.#view.dispatch({ changes: { from: 0, to: state.doc.length, insert: text }, selection: { anchor: 0 } });
  }

  /** Lines with a breakpoint, from 1. */
  get breakpoints(): number[] {
    return breakpoints(this.#view);
  }

  set breakpoints(lines: readonly number[]) {
    setBreakpoints(this.#view, lines);
  }

  /** The lines at which programs are. */
  set present(lines: readonly Present[]) {
    setPresent(this.#view, lines);
  }

  /** Lets the language server format the text. */
  format(): void {
    formatDocument(this.#view);
  }

  /** Puts the cursor at a line and a column, both from 1, and shows it. */
  goTo(line: number, column: number): void {
    const { doc } = this.#view.state;
    const { from, to } = doc.line(Math.min(Math.max(line, 1), doc.lines));
    const anchor = Math.min(from + Math.max(column - 1, 0), to);
    this.#view.dispatch({ selection: { anchor }, effects: EditorView.scrollIntoView(anchor, { y: "center" }) });
    this.#view.focus();
  }

  close(): void {
    this.#link.close();
    this.#view.destroy();
  }
}
