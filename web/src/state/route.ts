// Where one is: `#/` is the overview, `#/NAME/TAB` a tab of a controller.

export interface Route {
  device: string | null;
  tab: string | null;
}

export function parseRoute(hash: string): Route {
  const [device, tab] = hash
    .replace(/^#?\/?/, "")
    .split("/")
    .map((part) => {
      try {
        return decodeURIComponent(part);
      } catch {
        return "";
      }
    });
  return { device: device || null, tab: tab || null };
}

export function routeTo(device: string | null, tab: string | null = null): string {
  return "#/" + [device, tab].filter((part) => part !== null).map(encodeURIComponent).join("/");
}
