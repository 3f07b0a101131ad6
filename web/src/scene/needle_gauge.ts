/**
 * Gauges, their designated sizes (mm, ISO 9626:2016, Table 1) and the colours of their hubs (ISO 6009:2016). The
 * standard names the colours; the shades here are ours.
 */
const SIZES: readonly (readonly [gauge: number, diameter: number, name: string, shade: number])[] = [
  [10, 3.4, "olive brown", 0x6b5b2a],
  [11, 3.0, "yellow green", 0xa4c639],
  [12, 2.7, "pale blue", 0x9cc9e8],
  [13, 2.4, "purple", 0x7a3f98],
  [14, 2.1, "pale green", 0x9bd5a0],
  [15, 1.8, "blue grey", 0x6f8796],
  [16, 1.6, "white", 0xf4f4f2],
  [17, 1.4, "red violet", 0xa3257a],
  [18, 1.2, "pink", 0xf29bb7],
  [19, 1.1, "cream", 0xf2e3b6],
  [20, 0.9, "yellow", 0xf5d000],
  [21, 0.8, "deep green", 0x0b7a3e],
  [22, 0.7, "black", 0x2a2a2c],
  [23, 0.6, "deep blue", 0x12459c],
  [24, 0.55, "medium purple", 0x8a5bb5],
  [25, 0.5, "orange", 0xf0801d],
  [26, 0.45, "brown", 0x7b4a26],
  [27, 0.4, "medium grey", 0x8e9193],
  [28, 0.36, "blue green", 0x0f8b8d],
  [29, 0.33, "red", 0xcc1f2f],
  [30, 0.3, "yellow", 0xf5d000],
];
const NEAR = 0.02; // share of the diameter: K06's 1.08 mm is 19 G

export interface Gauge {
  readonly gauge: number;
  /** Of the hub. */
  readonly color: string;
  readonly shade: number;
}

/** The gauge of a needle of this outer diameter (mm); null if none is within 2 %. */
export function gaugeOf(diameter: number): Gauge | null {
  const found = SIZES.find(([, size]) => Math.abs(size - diameter) <= NEAR * diameter);
  return found ? { gauge: found[0], color: found[2], shade: found[3] } : null;
}
