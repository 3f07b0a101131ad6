/** Why this page cannot move the needle: which page has control, if any. Without a full stop. */
export const withoutControl = ({ holder }: { readonly holder: number | null }): string =>
  holder === null ? "No page has control" : "Another page has control";
