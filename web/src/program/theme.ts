// How the editor looks: the page's own colours, so that it follows dark and light by itself.
//
// The editor stands in an element's shadow root. There CodeMirror puts its rules into adopted style sheets and makes no
// style elements, so the page's content security policy needs nothing for it.

import { EditorView } from "@codemirror/view";

export const theme = EditorView.theme({
  "&": { height: "100%", color: "var(--text)", backgroundColor: "var(--panel)", fontSize: "13.5px" },
  "&.cm-focused": { outline: "2px solid var(--accent)", outlineOffset: "-1px" },
  ".cm-scroller": { fontFamily: "var(--mono)", lineHeight: "1.5" },
  ".cm-content": { caretColor: "var(--text)" },
  ".cm-cursor": { borderLeftColor: "var(--text)" },
  "&.cm-focused > .cm-scroller > .cm-selectionLayer .cm-selectionBackground, .cm-selectionBackground": {
    backgroundColor: "color-mix(in srgb, var(--accent) 28%, transparent)",
  },
  ".cm-activeLine": { backgroundColor: "color-mix(in srgb, var(--accent) 7%, transparent)" },
  ".cm-gutters": { backgroundColor: "var(--raised)", color: "var(--muted)", borderRight: "1px solid var(--line)" },
  ".cm-activeLineGutter": { backgroundColor: "var(--line)", color: "var(--text)" },
  ".cm-breakpoints": { cursor: "pointer" },
  ".cm-breakpoints .cm-gutterElement": { width: "16px", padding: "0 3px", display: "grid", placeItems: "center" },
  ".cm-breakpoint": { width: "10px", height: "10px", borderRadius: "50%", backgroundColor: "var(--stop)" },
  ".cm-breakpoints .cm-gutterElement:empty:hover": {
    backgroundImage: "radial-gradient(circle, color-mix(in srgb, var(--stop) 55%, transparent) 5px, transparent 5.5px)",
  },
  ".cm-present-running": { backgroundColor: "var(--ok-bg)", boxShadow: "inset 3px 0 var(--ok)" },
  ".cm-present-held": { backgroundColor: "var(--warn-bg)", boxShadow: "inset 3px 0 var(--warn)" },
  ".cm-present-error": { backgroundColor: "var(--error-bg)", boxShadow: "inset 3px 0 var(--error)" },
  ".cm-selectionMatch": { backgroundColor: "color-mix(in srgb, var(--warn) 22%, transparent)" },
  ".cm-matchingBracket, &.cm-focused .cm-matchingBracket": { backgroundColor: "var(--busy-bg)" },
  ".cm-tooltip": {
    backgroundColor: "var(--panel)",
    color: "var(--text)",
    border: "1px solid var(--strong-line)",
    borderRadius: "var(--radius)",
    boxShadow: "0 6px 24px rgb(0 0 0 / 0.25)",
  },
  ".cm-tooltip .cm-lsp-documentation": { maxWidth: "46em", padding: "4px 10px" },
  ".cm-tooltip-autocomplete > ul": { fontFamily: "var(--mono)" },
  ".cm-tooltip-autocomplete > ul > li[aria-selected]": { backgroundColor: "var(--accent)", color: "var(--on-accent)" },
  // Its pictures are letters that not every system has.
  ".cm-completionIcon": { display: "none" },
  ".cm-completionDetail": { color: "var(--muted)", fontStyle: "normal" },
  "li[aria-selected] .cm-completionDetail": { color: "inherit" },
  ".cm-panels": { backgroundColor: "var(--raised)", color: "var(--text)", borderColor: "var(--line)" },
  ".cm-textfield, .cm-button": {
    color: "var(--text)",
    background: "var(--panel)",
    border: "1px solid var(--strong-line)",
    borderRadius: "var(--radius)",
  },
  ".cm-diagnostic": { color: "var(--text)" },
  ".cm-diagnostic-error": { borderLeftColor: "var(--error)" },
  ".cm-diagnostic-warning": { borderLeftColor: "var(--warn)" },
  ".cm-lintRange-error": { backgroundImage: "none", textDecoration: "underline wavy var(--error)" },
  ".cm-lintRange-warning": { backgroundImage: "none", textDecoration: "underline wavy var(--warn)" },
  ".cm-lint-marker": { width: "9px", height: "9px", borderRadius: "2px", content: '""', marginTop: "5px" },
  ".cm-lint-marker-error": { backgroundColor: "var(--error)", content: '""' },
  ".cm-lint-marker-warning": { backgroundColor: "var(--warn)", content: '""' },
  ".cm-token-keyword": { color: "var(--curve-1)", fontWeight: "600" },
  ".cm-token-method": { color: "var(--curve-6)" },
  ".cm-token-function": { color: "var(--curve-5)" },
  ".cm-token-property, .cm-token-enumMember": { color: "var(--curve-4)" },
  ".cm-token-readonly": { color: "var(--curve-7)" },
  ".cm-token-number": { color: "var(--curve-2)" },
  ".cm-token-string": { color: "var(--curve-3)" },
  ".cm-token-macro": { color: "var(--curve-3)" },
  ".cm-token-comment": { color: "var(--muted)", fontStyle: "italic" },
  ".cm-token-operator": { color: "var(--muted)" },
});
