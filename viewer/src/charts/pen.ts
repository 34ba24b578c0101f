// SPDX-License-Identifier: MIT
// One interface for drawing charts, with two outputs: the canvas on the screen, and SVG for export,
// where text stays text.

export interface TextStyle {
  colour: string;
  size?: number;
  anchor?: "start" | "middle" | "end";
  bold?: boolean;
  upwards?: boolean; // rotated by a quarter turn
  halo?: string; // colour around the letters, for text on a picture
}

type Line = [
  x1: number,
  y1: number,
  x2: number,
  y2: number,
  colour: string,
  width?: number,
  dash?: number[],
];
type Rect = [
  x: number,
  y: number,
  width: number,
  height: number,
  colour: string,
  opacity?: number,
];
type Paint = [fill: string, opacity?: number, stroke?: string, strokeWidth?: number];
type Circle = [x: number, y: number, r: number, ...paint: Paint];

/// Draws shapes and texts. The points of a polygon or an open stroke are a list x, y, x, y, …
export interface Pen {
  line(...line: Line): void;
  rect(...rect: Rect): void;
  polygon(points: number[], ...paint: Paint): void;
  stroke(points: number[], colour: string, width: number): void;
  circle(...circle: Circle): void;
  text(x: number, y: number, text: string, style: TextStyle): void;
}

const kFont =
  "system-ui, -apple-system, 'Segoe UI', Roboto, 'Helvetica Neue', Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif";

let measuring: CanvasRenderingContext2D | undefined;
/// The width of a text in pixels.
export function textWidth(text: string, size: number): number {
  measuring ??= document.createElement("canvas").getContext("2d")!;
  measuring.font = `${size}px ${kFont}`;
  return measuring.measureText(text).width;
}

export class CanvasPen implements Pen {
  constructor(private readonly context: CanvasRenderingContext2D) {}

  line(...[x1, y1, x2, y2, colour, width = 1, dash = []]: Line): void {
    const c = this.context;
    c.strokeStyle = colour;
    c.lineWidth = width;
    c.setLineDash(dash);
    c.beginPath();
    c.moveTo(x1, y1);
    c.lineTo(x2, y2);
    c.stroke();
    c.setLineDash([]);
  }
  rect(...[x, y, width, height, colour, opacity = 1]: Rect): void {
    this.context.globalAlpha = opacity;
    this.context.fillStyle = colour;
    this.context.fillRect(x, y, width, height);
    this.context.globalAlpha = 1;
  }
  polygon(points: number[], ...paint: Paint): void {
    this.trace(points);
    this.context.closePath();
    this.paint(...paint);
  }
  stroke(points: number[], colour: string, width: number): void {
    this.trace(points);
    this.paint("none", 1, colour, width);
  }
  circle(...[x, y, r, ...paint]: Circle): void {
    this.context.beginPath();
    this.context.arc(x, y, r, 0, 2 * Math.PI);
    this.paint(...paint);
  }
  text(x: number, y: number, text: string, style: TextStyle): void {
    const c = this.context;
    c.save();
    c.translate(x, y);
    if (style.upwards) c.rotate(-Math.PI / 2);
    c.font = `${style.bold ? "600 " : ""}${style.size ?? 11}px ${kFont}`;
    c.textAlign = style.anchor === "middle" ? "center" : (style.anchor ?? "start");
    if (style.halo) {
      c.strokeStyle = style.halo;
      c.lineWidth = 3;
      c.lineJoin = "round";
      c.strokeText(text, 0, 0);
    }
    c.fillStyle = style.colour;
    c.fillText(text, 0, 0);
    c.restore();
  }

  private trace(points: number[]): void {
    this.context.beginPath();
    for (let i = 0; i + 1 < points.length; i += 2) this.context.lineTo(points[i]!, points[i + 1]!);
  }
  private paint(...[fill, opacity = 1, stroke = "none", strokeWidth = 1]: Paint): void {
    const c = this.context;
    c.globalAlpha = opacity;
    if (fill !== "none") {
      c.fillStyle = fill;
      c.fill();
    }
    c.globalAlpha = 1;
    if (stroke === "none") return;
    c.strokeStyle = stroke;
    c.lineWidth = strokeWidth;
    c.stroke();
  }
}

function escaped(text: string): string {
  return text
    .replace(/[\u0000-\u0008\u000b\u000c\u000e-\u001f\ufffe\uffff]/g, "\ufffd") // not allowed in XML
    .replace(/&/g, "&amp;")
    .replace(/</g, "&lt;")
    .replace(/>/g, "&gt;")
    .replace(/"/g, "&quot;");
}

function painted(...[fill, opacity = 1, stroke = "none", strokeWidth = 1]: Paint) {
  return { fill, "fill-opacity": opacity, stroke, "stroke-width": strokeWidth };
}

const coordinate = (value: number) => String(Number(value.toFixed(2)));

export class SvgPen implements Pen {
  private readonly elements: string[] = [];

  line(...[x1, y1, x2, y2, colour, width = 1, dash = []]: Line): void {
    this.add("line", {
      x1,
      y1,
      x2,
      y2,
      stroke: colour,
      "stroke-width": width,
      "stroke-dasharray": dash.length ? dash.join(" ") : undefined,
    });
  }
  rect(...[x, y, width, height, colour, opacity = 1]: Rect): void {
    this.add("rect", { x, y, width, height, fill: colour, "fill-opacity": opacity });
  }
  polygon(points: number[], ...paint: Paint): void {
    this.add("polygon", { points: this.list(points), ...painted(...paint) });
  }
  stroke(points: number[], colour: string, width: number): void {
    this.add("polyline", {
      points: this.list(points),
      fill: "none",
      stroke: colour,
      "stroke-width": width,
    });
  }
  circle(...[x, y, r, ...paint]: Circle): void {
    this.add("circle", { cx: x, cy: y, r, ...painted(...paint) });
  }
  text(x: number, y: number, text: string, style: TextStyle): void {
    this.add(
      "text",
      {
        x,
        y,
        fill: style.colour,
        stroke: style.halo,
        "stroke-width": style.halo && 3,
        "stroke-linejoin": style.halo && "round",
        "paint-order": style.halo && "stroke",
        "font-size": style.size ?? 11,
        "text-anchor": style.anchor ?? "start",
        "font-weight": style.bold ? 600 : undefined,
        transform: style.upwards ? `rotate(-90 ${coordinate(x)} ${coordinate(y)})` : undefined,
      },
      escaped(text),
    );
  }
  image(x: number, y: number, width: number, height: number, url: string): void {
    this.add("image", { x, y, width, height, href: url });
  }
  /// Moves everything that `draw` draws.
  at(x: number, y: number, draw: () => void): void {
    this.elements.push(`<g transform="translate(${coordinate(x)} ${coordinate(y)})">`);
    draw();
    this.elements.push("</g>");
  }
  document(width: number, height: number, title: string, description: string): string {
    return (
      `<?xml version="1.0" encoding="UTF-8"?>\n<svg xmlns="http://www.w3.org/2000/svg" width="${coordinate(width)}" ` +
      `height="${coordinate(height)}" viewBox="0 0 ${coordinate(width)} ${coordinate(height)}" role="img" ` +
      `font-family="${kFont}">\n<title>${escaped(title)}</title>\n<desc>${escaped(description)}</desc>\n` +
      `${this.elements.join("\n")}\n</svg>\n`
    );
  }

  private list(points: number[]): string {
    return points.map(coordinate).join(" ");
  }
  private add(
    name: string,
    attributes: Record<string, string | number | undefined>,
    content = "",
  ): void {
    const text = Object.entries(attributes)
      .filter(([, value]) => value !== undefined)
      .map(([key, value]) => ` ${key}="${typeof value === "number" ? coordinate(value) : value}"`)
      .join("");
    this.elements.push(content ? `<${name}${text}>${content}</${name}>` : `<${name}${text}/>`);
  }
}
