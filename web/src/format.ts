/** A number with so many places, a minus sign instead of a hyphen, and no sign at a zero; "–" if there is none. */
export const fixedNumber = (value: number | undefined, places: number): string => {
  if (value === undefined || !Number.isFinite(value)) return "–";
  const text = value.toFixed(places);
  return Number(text) === 0 ? text.replace("-", "") : text.replace("-", "−");
};
/** Numbers with units, with a fixed number of digits so that the text does not jump. */
export const mm = (metres: number, places = 2): string => `${(metres * 1e3).toFixed(places)} mm`;
export const newton = (force: number, places = 2): string => `${force.toFixed(places)} N`;
export const degrees = (number: number): string => `${number} ${Math.abs(number) === 1 ? "degree" : "degrees"}`;
/** The same words, with no line break between a number and its unit. */
export const unbroken = (text: string): string => text.replace(/(\d) (?=(N|mN|mm|mL|s|degrees?)\b)/g, "$1\u00a0");
/** What an error says. */
export const errorText = (error: unknown): string => (error instanceof Error ? error.message : String(error));
