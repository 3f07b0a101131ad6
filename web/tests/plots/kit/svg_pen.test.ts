import { describe, expect, it } from "vitest";
import { Polyline } from "../../../src/plots/kit/polyline.ts";
import { SvgPen } from "../../../src/plots/kit/svg_pen.ts";

describe("a drawing as a file", () => {
  it("has the line as it was, with its gaps and lone points", () => {
    const pen = new SvgPen();
    const line = new Polyline();
    line.add(1, 2);
    line.add(3.23456, 4);
    line.gap();
    line.add(9, 9);
    pen.line(line, { colour: "red", width: 1.5, alpha: 0.5 });
    const file = pen.file(100, 50, "white", "t", "w");
    expect(file).toContain('d="M1 2L3.23 4M9 9h1"');
    expect(file).toContain('stroke-opacity="0.5"');
    expect(file).toContain('viewBox="0 0 100 50"');
  });

  it("text is text, whatever a membrane is called", () => {
    const pen = new SvgPen();
    pen.text(0, 0, '<script>"&', { colour: "black" });
    const file = pen.file(1, 1, "white", "<b>", "&");
    expect(file).not.toContain("<script>");
    expect(file).toContain("&lt;script&gt;&quot;&amp;");
    expect(file).toContain("<title>&lt;b&gt;</title>");
  });

  it("what is clipped stands in a group of its own, closed again", () => {
    const pen = new SvgPen();
    pen.within(1, 2, 3, 4, () => pen.segment(0, 0, 1, 1, { colour: "red", width: 1 }));
    pen.within(1, 2, 3, 4, () => {});
    const file = pen.file(1, 1, "white", "", "");
    expect(file.match(/<g /g)?.length).toBe(2);
    expect(file.match(/<\/g>/g)?.length).toBe(2);
    expect(file).toContain('clip-path="url(#clip1)"');
  });

  it("an empty line is nothing", () => {
    const pen = new SvgPen();
    pen.line(new Polyline(), { colour: "red", width: 1 });
    expect(pen.file(1, 1, "white", "", "")).not.toContain("<path");
  });
});
