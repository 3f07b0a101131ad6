/** The membranes' colours in styles/tokens.css, --data-1 to --data-8. A number beside the colour tells more of them. */
export const COLOURS = 8;

/** The token of a membrane's colour, without its dashes. */
export const colourToken = (membrane: number): string => `data-${(membrane % COLOURS) + 1}`;
