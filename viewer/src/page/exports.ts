// SPDX-License-Identifier: MIT
// Exports the page as a picture, and the selection as numbers.
import { commandLine } from "../model/command_line";
import type { DataView } from "../scene/data_view";
import type { Chart } from "../charts/chart";
import { clipped, counted, exact, homology } from "../common/number_format";
import { dimColour } from "../common/palette";
import { SvgPen } from "../charts/pen";
import type { Session } from "../model/session";

export interface Views {
  data: DataView | undefined;
  charts: [title: string, chart: Chart][];
}

/// All views as laid out on the page, with charts as lines and text, and the cloud as an image.
export function pictureSvg(session: Session, views: Views, page: HTMLElement): string {
  const {
    theme,
    report: { meta, bars },
  } = session;
  const pen = new SvgPen();
  const origin = page.getBoundingClientRect();
  const margin = 20,
    head = 58,
    width = origin.width + 2 * margin,
    height = origin.height + 2 * margin + head;
  pen.rect(0, 0, width, height, theme.panel);
  pen.text(margin, margin + 12, clipped(meta.title, 100), {
    colour: theme.ink,
    size: 16,
    bold: true,
  });
  pen.text(margin, margin + 36, session.finding.sentence, { colour: theme.ink, size: 13 });
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
    const isOnData = views.data!.panel.querySelector(".numbers")!.classList.contains("on-data");
    const [colour, halo] = isOnData ? ["#14181d", "#fff"] : [theme.ink, theme.panel];
    for (const word of views.data!.panel.querySelectorAll(".numbers text"))
      pen.text(
        at.x + Number(word.getAttribute("x")),
        at.y + Number(word.getAttribute("y")),
        word.textContent ?? "",
        { colour, size: 12, bold: true, anchor: "middle", halo },
      );
    drawLegend(pen, views.data!.panel.querySelector(".legend")!, place, session);
  }
  for (const [title, chart] of views.charts) {
    if (chart.isFolded) continue;
    const at = place(chart.panel.querySelector("canvas.over")!);
    pen.text(at.x + 4, at.y - 10, title, { colour: theme.ink, size: 13, bold: true });
    pen.at(at.x, at.y, () => chart.drawAll(pen, chart.shape));
  }
  return pen.document(width, height, meta.title, commandLine(session));
}

/// The visible part of the legend: its swatches and words in their places.
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

/// The picture as a PNG with two pixels per unit of the SVG.
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

/// The selected bars, or all shown bars if none is selected, as lines `dim,birth,death` in the
/// format of the programs. If there are two barcodes, the barcode comes first in each line.
export function selectionCsv(session: Session): string {
  const { bars, meta } = session.report;
  const two = meta.barcodes.length > 1;
  const lines = selectedOrShown(session).map((bar) => {
    const numbers = `${bars.dim[bar]},${exact(bars.birth[bar]!)},${exact(bars.death[bar]!)}`;
    return two ? `${bars.barcodeOf(bar) + 1},${numbers}` : numbers;
  });
  return [two ? "barcode,dim,birth,death" : "dim,birth,death", ...lines, ""].join("\n");
}

/// A barcode file that ph-barcode can read, with the further data that the page shows, except sets
/// of voxels.
export function selectionJson(session: Session): string {
  const { report, cut, cutValue } = session;
  const { chains, meta } = report;
  const { input, complex, field, max_dim, threshold, filtration, engine, timings, peak_memory } =
    meta.provenance;
  // A barcode that was read from a file may state neither its complex nor its field.
  const isComputed = complex !== undefined && field !== undefined;
  const selected = selectedOrShown(session);
  const allHaveChains = selected.length > 0 && selected.every((bar) => chains?.ofBar.has(bar));
  return (
    JSON.stringify(
      {
        format: "ph-barcode",
        version: 1,
        program: meta.program,
        command: commandLine(session),
        input: { path: input?.path ?? "", description: input?.description ?? "" },
        ...(isComputed ? { complex, field, max_dim, threshold } : {}),
        ...filtration,
        ...(isComputed ? { engine } : {}),
        ...(allHaveChains ? { representatives: meta.barcodes[0]?.representatives } : {}),
        bars: selected.map((bar) => barJson(session, bar)),
        ...(cut && {
          cut: cutValue,
          segments: cut.segments.map(({ label, points, vertices }) => ({
            label: session.numberOf(label),
            points,
            vertices,
            ...saidInJson(session, label),
          })),
          ...(meta.scene && { surfaces: meta.scene.surfaces.map(({ role }, i) => ({ number: i + 1, role })) }),
        }),
        timings: timings ?? {},
        peak_memory: peak_memory ?? null,
      },
      null,
      1,
    ) + "\n"
  );
}

/// The program's JSON for a segment of its answer, with the same names.
function saidInJson(session: Session, label: number): object {
  const said = session.saidOf(label);
  if (!said) return {};
  const on = said.on_surface
    ? { surface: said.on_surface }
    : said.on_segment
      ? { segment: said.on_segment }
      : null;
  return { persistence: said.persistence, role: said.role, on };
}

function barJson(session: Session, bar: number): object {
  const { bars, chains, meta } = session.report;
  const kind = meta.barcodes[bars.barcodeOf(bar)]!.cells ?? "vertices";
  const number = (value: number) => (Number.isFinite(value) ? value : value > 0 ? null : "-inf");
  const named = (numbers: number[]) => (kind === "row" ? { row: numbers[0] } : { [kind]: numbers });
  const cell = (numbers: number[]) => (numbers.length > 0 ? named(numbers) : null);
  const chain = chains?.ofBar.get(bar);
  const representative: object[] = [];
  if (chains && chain !== undefined) {
    const arity = bars.arity(bar, 0);
    for (
      let i = chains.start[chain]!, at = chains.first[chain]!;
      i < chains.start[chain + 1]!;
      ++i, at += arity
    )
      representative.push({
        ...named(Array.from(chains.cells.subarray(at, at + arity))),
        coefficient: chains.coefficients?.[i] ?? 1,
      });
  }
  return {
    ...(meta.barcodes.length > 1 ? { barcode: meta.barcodes[bars.barcodeOf(bar)]!.name } : {}),
    dim: bars.dim[bar],
    birth: number(bars.birth[bar]!),
    death: number(bars.death[bar]!),
    birth_cell: cell(bars.cell(bar, 0)),
    death_cell: cell(bars.cell(bar, 1)),
    ...(representative.length > 0 ? { representative } : {}),
  };
}

function selectedOrShown(session: Session): number[] {
  if (session.selection.length > 0) return session.selection;
  return Array.from({ length: session.report.bars.size }, (_, i) => i).filter((bar) =>
    session.isShown(bar),
  );
}
