# SPDX-License-Identifier: MIT
"""Draws the results of --perturb of segmentation_scores.py: one panel per kind, one line per
program."""
import math
from xml.sax.saxutils import escape

import perturbations
import segmentation_tables

WIDTH, HEIGHT, LEFT, TOP, GAP = 190, 170, 40, 34, 22
COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9")


def lines_of(report, kind, truth):
    """The points (amount, F) of the line of each program. They include the unmodified frames."""
    result = {}
    for amount, scores in report["curves"][kind].items():
        for program, f in scores.items():
            result.setdefault(program, {})[float(amount)] = f[truth]
    for program, f in segmentation_tables.unharmed(report).items():
        if program in result and f[truth] is not None:
            result[program][perturbations.KINDS[kind].unharmed] = f[truth]
    return {program: sorted(points.items()) for program, points in result.items()}


def panel(kind, lines, colour, x0, lowest):
    amounts = sorted({amount for points in lines.values() for amount, _ in points})
    place = lambda amount: -math.log(amount) if kind == "subset" else amount
    left, right = min(map(place, amounts)), max(map(place, amounts))
    across = lambda amount: x0 + WIDTH * (place(amount) - left) / ((right - left) or 1)
    up = lambda f: TOP + HEIGHT * (1 - (f - lowest) / (1 - lowest))
    parts = [
        f'<rect x="{x0}" y="{TOP}" width="{WIDTH}" height="{HEIGHT}" fill="none" stroke="#999"/>'
    ]
    for tenth in range(round(10 * lowest), 11):
        y = up(tenth / 10)
        parts.append(f'<line x1="{x0}" x2="{x0 + WIDTH}" y1="{y:.1f}" y2="{y:.1f}" stroke="#ddd"/>')
        if x0 == LEFT:
            parts.append(
                f'<text x="{x0 - 5}" y="{y + 4:.1f}" text-anchor="end">{tenth / 10:.1f}</text>'
            )
    last = None
    for amount in amounts:
        if last is None or abs(across(amount) - last) > 17:
            last = across(amount)
            parts.append(
                f'<text x="{last:.1f}" y="{TOP + HEIGHT + 14}" text-anchor="middle">'
                f"{amount:g}</text>"
            )
    what = escape(perturbations.KINDS[kind].what)
    parts.append(
        f'<text x="{x0 + WIDTH / 2}" y="{TOP + HEIGHT + 30}" text-anchor="middle">{what}</text>'
    )
    for program, points in lines.items():
        path = " ".join(f"{across(amount):.1f},{up(f):.1f}" for amount, f in points)
        parts.append(
            f'<polyline points="{path}" fill="none" stroke="{colour[program]}" stroke-width="2"/>'
        )
    return parts


def svg(report, truth="objects"):
    kinds = list(report["curves"])
    lines = {kind: lines_of(report, kind, truth) for kind in kinds}
    programs = list(dict.fromkeys(program for panels in lines.values() for program in panels))
    colour = {program: COLOURS[i % len(COLOURS)] for i, program in enumerate(programs)}
    least = min(
        (f for panels in lines.values() for points in panels.values() for _, f in points), default=0
    )
    lowest = min(0.9, math.floor(10 * least) / 10)
    width, height = LEFT + len(kinds) * (WIDTH + GAP), TOP + HEIGHT + 40
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" '
        f'height="{height}" font-family="sans-serif" font-size="11">',
        f'<rect width="{width}" height="{height}" fill="white"/>',
    ]
    x = LEFT
    for program in programs:
        parts.append(
            f'<line x1="{x}" x2="{x + 18}" y1="14" y2="14" stroke="{colour[program]}" '
            'stroke-width="3"/>'
        )
        parts.append(f'<text x="{x + 23}" y="18">{escape(program)}</text>')
        x += 45 + 7 * len(program)
    parts.append(f'<text x="{width - GAP}" y="18" text-anchor="end">F on {truth}</text>')
    for i, kind in enumerate(kinds):
        parts += panel(kind, lines[kind], colour, LEFT + i * (WIDTH + GAP), lowest)
    return "\n".join([*parts, "</svg>"]) + "\n"
