// What the language server says of a word, as HTML, may contain text of a program. Only plain structure gets through.

const ALLOWED = new Set(["P", "CODE", "PRE", "STRONG", "EM", "UL", "OL", "LI", "BR", "HR", "SPAN", "H1", "H2", "H3", "H4"]);
const TABLES = new Set(["TABLE", "THEAD", "TBODY", "TR", "TH", "TD"]);

/** HTML without attributes but `class`, and with elements that only give structure; others leave their text. */
export function sanitize(html: string): string {
  // A document made this way runs no script and loads nothing.
  const { body } = new DOMParser().parseFromString(html, "text/html");
  for (const element of [...body.querySelectorAll("*")]) {
    if (element.tagName === "SCRIPT" || element.tagName === "STYLE") element.remove();
    else if (!ALLOWED.has(element.tagName) && !TABLES.has(element.tagName)) element.replaceWith(...element.childNodes);
    else for (const { name } of [...element.attributes]) if (name !== "class") element.removeAttribute(name);
  }
  return body.innerHTML;
}
