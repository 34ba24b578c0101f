// SPDX-License-Identifier: MIT
// Where the selected bars are: their representatives and the cells of their birth and death.
import { CellGeometry, emptyGeometry, type Geometry } from "./cell_geometry";
import { dimColour } from "./palette";
import type { Session } from "./session";

export interface Shape {
  geometry: Geometry;
  colour: string;
  width: number; // of its segments, pixels
  opacity: number; // of its triangles
}

const kMostChains = 100,
  kMostCells = 400_000;

export const kBirthColour = "#f0e442",
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

export function shapesOf(session: Session): Shape[] {
  const { report, theme } = session;
  const { bars, chains } = report;
  const cells = new CellGeometry(report);
  const births = emptyGeometry(),
    deaths = emptyGeometry();
  const byDim = new Map<number, Geometry>();
  let left = kMostCells;
  for (const bar of barsInView(session)) {
    if (bars.barcodeOf(bar) !== 0) continue;
    const dim = bars.dim[bar]!;
    const birth = bars.cell(bar, 0),
      death = bars.cell(bar, 1);
    if (birth.length > 0) cells.add(births, birth, 0, birth.length);
    if (death.length > 0) cells.add(deaths, death, 0, death.length);
    const chain = chains?.ofBar.get(bar);
    if (chain === undefined || !chains) continue;
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
  return [
    ...[...byDim].map(([dim, geometry]) => ({
      geometry,
      colour: dimColour(dim, theme),
      width: dim >= 2 ? 1 : 3.5,
      opacity: 0.3,
    })),
    { geometry: deaths, colour: kDeathColour, width: 2.5, opacity: 0.45 },
    { geometry: births, colour: kBirthColour, width: 5, opacity: 0.5 },
  ];
}
