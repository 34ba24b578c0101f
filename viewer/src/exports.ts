// SPDX-License-Identifier: MIT
// What can be taken along: the page as a picture, the selection as numbers.
import { commandLine } from "./command";
import type { DataView } from "./data_view";
import type { Chart } from "./chart";
import { clipped, counted, exact, homology } from "./numbers";
import { dimColour } from "./palette";
import { SvgPen } from "./pen";
import type { Session } from "./session";

export interface Views {
  data: DataView | undefined;
  charts: [title: string, chart: Chart][];
}

/// All views as they stand on the page, charts as lines and text, the cloud as an image.
export function pictureSvg(session: Session, views: Views, page: HTMLElement): string {
  const {
    theme,
    report: { meta, bars },
  } = session;
  const pen = new SvgPen();
  const origin = page.getBoundingClientRect();
  const margin = 20,
    head = 36,
    width = origin.width + 2 * margin,
    height = origin.height + 2 * margin + head;
  pen.rect(0, 0, width, height, theme.panel);
  pen.text(margin, margin + 12, clipped(meta.title, 100), {
    colour: theme.ink,
    size: 16,
    bold: true,
  });
  bars.dims.forEach((dim, i) =>
    pen.text(
      width - margin - 90 * (bars.dims.length - 1 - i),
      margin + 12,
      `${homology(dim)} ${counted(bars.count(dim, 0), "bar")}`,
      {
        colour: dimColour(dim, theme),
        size: 12,
        anchor: "end",
      },
    ),
  );
  const place = (element: Element) => {
    const box = element.getBoundingClientRect();
    return {
      x: box.left - origin.left + margin,
      y: box.top - origin.top + margin + head,
      width: box.width,
      height: box.height,
    };
  };
  const picture = views.data?.picture();
  if (picture) {
    const at = place(views.data!.stage!.renderer.domElement);
    pen.image(at.x, at.y, at.width, at.height, picture);
    drawLegend(pen, views.data!.panel.querySelector(".legend")!, place, session);
  }
  for (const [title, chart] of views.charts) {
    const at = place(chart.panel.querySelector("canvas.over")!);
    pen.text(at.x + 4, at.y - 10, title, { colour: theme.ink, size: 13, bold: true });
    pen.at(at.x, at.y, () => chart.drawAll(pen, chart.shape));
  }
  return pen.document(width, height, meta.title, commandLine(session));
}

/// What of the legend is in view: its swatches and its words where they stand.
function drawLegend(
  pen: SvgPen,
  legend: Element,
  place: (element: Element) => { x: number; y: number; width: number; height: number },
  session: Session,
): void {
  const frame = place(legend);
  for (const mark of legend.querySelectorAll("rect, h3, .name, .count, .ticks span")) {
    const at = place(mark);
    if (at.y < frame.y || at.y + at.height > frame.y + frame.height) continue;
    if (mark instanceof SVGRectElement)
      pen.rect(at.x, at.y, at.width, at.height, mark.getAttribute("fill") ?? "none");
    else
      pen.text(at.x, at.y + at.height - 4, mark.firstChild?.textContent ?? "", {
        colour: session.theme.muted,
        size: 12,
      });
  }
}

/// The same as pixels, two a unit.
export async function picturePng(svgText: string): Promise<Blob> {
  const image = new Image();
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svgText)}`;
  await image.decode();
  const canvas = document.createElement("canvas");
  canvas.width = 2 * image.width;
  canvas.height = 2 * image.height;
  canvas.getContext("2d")!.drawImage(image, 0, 0, canvas.width, canvas.height);
  return new Promise((resolve, reject) =>
    canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error("no picture"))), "image/png"),
  );
}

/// `dim,birth,death` as the programs write it, with the barcode before it where there are two. What
/// is selected, or all that is shown.
export function selectionCsv(session: Session): string {
  const { bars, meta } = session.report;
  const two = meta.barcodes.length > 1;
  const lines = selectedOrShown(session).map((bar) => {
    const numbers = `${bars.dim[bar]},${exact(bars.birth[bar]!)},${exact(bars.death[bar]!)}`;
    return two ? `${bars.barcodeOf(bar) + 1},${numbers}` : numbers;
  });
  return [two ? "barcode,dim,birth,death" : "dim,birth,death", ...lines, ""].join("\n");
}

export function selectionJson(session: Session): string {
  const { report, cut, cutValue } = session;
  const { bars, chains, meta } = report;
  const number = (value: number) => (Number.isFinite(value) ? value : value > 0 ? null : "-inf");
  const cell = (numbers: number[]) => (numbers.length > 0 ? numbers : null);
  const selected = selectedOrShown(session).map((bar) => {
    const chain = chains?.ofBar.get(bar),
      arity = bars.arity(bar, 0);
    const cells: number[][] = [];
    if (chain !== undefined && chains)
      for (let at = chains.first[chain]!; at < chains.first[chain + 1]!; at += arity)
        cells.push(Array.from(chains.cells.subarray(at, at + arity)));
    return {
      barcode: meta.barcodes[bars.barcodeOf(bar)]!.name,
      dim: bars.dim[bar],
      birth: number(bars.birth[bar]!),
      death: number(bars.death[bar]!),
      birth_cell: cell(bars.cell(bar, 0)),
      death_cell: cell(bars.cell(bar, 1)),
      ...(cells.length > 0 ? { representative: cells } : {}),
    };
  });
  return (
    JSON.stringify(
      {
        format: "ph-selection",
        version: 1,
        title: meta.title,
        program: meta.program,
        command: commandLine(session),
        ...(cut
          ? {
              cut: cutValue,
              segments: cut.segments.map(({ label, points, vertices }) => ({
                label,
                points,
                vertices,
              })),
            }
          : {}),
        bars: selected,
      },
      null,
      1,
    ) + "\n"
  );
}

function selectedOrShown(session: Session): number[] {
  if (session.selection.length > 0) return session.selection;
  return Array.from({ length: session.report.bars.size }, (_, i) => i).filter((bar) =>
    session.isShown(bar),
  );
}
