import { element } from "../panel.ts";

/** Lets the browser save what lies at an address of the studio. */
export function saveAddress(address: string, name: string): void {
  const link = element("a", { href: address, download: name, hidden: true });
  document.body.append(link);
  link.click();
  link.remove();
}

/** A file name from a person's words. */
export const fileName = (words: string, ending: string): string =>
  `${
    words
      .normalize("NFKD")
      .replace(/[^\w.-]+/g, "-")
      .replace(/^[-.]+|[-.]+$/g, "")
      .toLowerCase() || "scene"
  }.${ending}`;
