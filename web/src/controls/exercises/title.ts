interface Titled {
  readonly name: string;
  readonly title: string;
}

/** The title of an exercise, with the name of its file if another exercise has the same title. */
export function titleAmong({ name, title }: Titled, others: readonly Titled[]): string {
  const shared = others.some((other) => other.name !== name && other.title === title);
  return shared ? `${title} (${name})` : title;
}
