// SPDX-License-Identifier: MIT
// Shows where the selected bars are in the data: their representatives, and their birth and death
// cells.
import { CellGeometry, emptyGeometry, type Geometry } from "../geometry/cell_geometry";
import { dimColour } from "../common/palette";
import type { Report } from "../model/report";
import type { Session } from "../model/session";
import { surfaceOfBar } from "../geometry/voxel_sets";

export interface Shape {
  geometry: { [kind in keyof Geometry]: ArrayLike<number> };
  colour: string;
  width: number; // width of its segments in pixels
  opacity: number; // opacity of its triangles
  surface: boolean; // true if its triangles are shaded and hide what is behind them
}

const kMostChains = 100,
  kMostCells = 400_000,
  kMostCorners = 1_200_000, // number of corners of the surfaces around voxels
  kMostOutlined = 4000; // number of cells of a surface; the edges of more would be a tangle

// No other colour of the page is close to the colour of births: neither the colours of values,
// which are drawn on the same surface, nor the colours of segments or dimensions.
export const kBirthColour = "#e6007e",
  kDeathColour = "#cc79a7";

/// The bars whose cells are shown: the one under the pointer, or the most persistent selected ones.
export function barsInView(session: Session): number[] {
  if (session.focus.bar >= 0) return [session.focus.bar];
  const found: number[] = [];
  const most = Math.min(kMostChains, session.selection.length);
  for (let i = 0; found.length < most; ++i) {
    const bar = session.report.bars.byPersistence[i]!;
    if (session.isSelected(bar)) found.push(bar);
  }
  return found;
}

/// True if the representative of a bar is the entire mesh, as for the void of a closed surface:
/// drawing it would hide the data and show nothing.
export function isWholeMesh({ chains, triangles, bars }: Report, bar: number): boolean {
  const chain = chains?.ofBar.get(bar);
  if (chain === undefined || !triangles || bars.dim[bar] !== 2) return false;
  return chains!.start[chain + 1]! - chains!.start[chain]! >= triangles.values.length;
}

export function shapesOf(session: Session): Shape[] {
  const { report, theme } = session;
  const { bars, chains, voxels, image } = report;
  const cells = new CellGeometry(report);
  const births = emptyGeometry(),
    deaths = emptyGeometry();
  const byDim = new Map<number, Geometry>();
  const hulls: Shape[] = [];
  let left = kMostCells,
    cornersLeft = kMostCorners;
  for (const bar of barsInView(session)) {
    if (bars.barcodeOf(bar) !== 0) continue;
    const dim = bars.dim[bar]!;
    const birth = bars.cell(bar, 0),
      death = bars.cell(bar, 1);
    if (birth.length > 0) cells.add(births, birth, 0, birth.length);
    if (death.length > 0) cells.add(deaths, death, 0, death.length);
    if (voxels?.ofBar.has(bar) && image!.shape[0]! > 1 && cornersLeft > 0) {
      const triangles = surfaceOfBar(voxels, bar, image!.shape);
      cornersLeft -= triangles.length / 3;
      hulls.push(surfaceShape({ ...emptyGeometry(), triangles }, dimColour(dim, theme)));
    }
    const chain = chains?.ofBar.get(bar);
    if (chain === undefined || !chains || isWholeMesh(report, bar)) continue;
    const arity = bars.arity(bar, 0);
    let geometry = byDim.get(dim);
    if (!geometry) byDim.set(dim, (geometry = emptyGeometry()));
    for (
      let at = chains.first[chain]!;
      at < chains.first[chain + 1]! && left > 0;
      at += arity, --left
    )
      cells.add(geometry, chains.cells, at, arity);
  }
  const outline = { ...deaths, triangles: [] }; // filled triangles would cover the visible data
  return [
    ...hulls,
    ...[...byDim].map(([dim, geometry]) =>
      dim >= 2
        ? surfaceShape(geometry, dimColour(dim, theme))
        : { geometry, colour: dimColour(dim, theme), width: 3.5, opacity: 0.3, surface: false },
    ),
    { geometry: outline, colour: kDeathColour, width: 2.5, opacity: 0.45, surface: false },
    { geometry: births, colour: kBirthColour, width: 5, opacity: 0.5, surface: false },
  ];
}

function surfaceShape(geometry: Shape["geometry"], colour: string): Shape {
  const many = geometry.triangles.length > 9 * kMostOutlined;
  const shown = many ? { ...geometry, segments: [] } : geometry;
  return { geometry: shown, colour, width: 1, opacity: 0.5, surface: true };
}
