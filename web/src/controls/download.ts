import { element } from "../panel.ts";

/** Makes the browser save the file at an address of the studio. */
export function saveAddress(address: string, name: string): void {
  const link = element("a", { href: address, download: name, hidden: true });
  document.body.append(link);
  link.click();
  link.remove();
}

/** A file name made from any text. */
export const fileName = (words: string, ending: string): string =>
  `${
    words
      .normalize("NFKD")
      .replace(/[^\w.-]+/g, "-")
      .replace(/^[-.]+|[-.]+$/g, "")
      .toLowerCase() || "scene"
  }.${ending}`;
