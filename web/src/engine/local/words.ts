/** What a page without a server says where the studio on a computer is needed. */
const GET_STUDIO = "Install Punctura on your computer and start “punctura run”.";

export const NOTES = [
  "The core runs in this page as WebAssembly, on a simulated device in a simulated hand.",
  `A haptic device needs the studio. ${GET_STUDIO}`,
];

export const NEEDS_STUDIO = `This needs the studio, and this page has none. ${GET_STUDIO}`;

export const EXERCISE_FILE = `This is an exercise, not a scene. ${NEEDS_STUDIO}`;

/** leftOut: ticks. */
export const leftOutWords = (leftOut: number): string =>
  `${leftOut.toLocaleString("en")} ticks were left out, because the browser gave this page no time`;
