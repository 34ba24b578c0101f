# SPDX-License-Identifier: MIT
"""Decides whether two programs found the same bars, allowing for different rounding.

Programs compute distances in single or double precision and print six digits. The ends of a bar may
differ in the last digit, and a bar that has length 0 in one program may have a small positive
length in another.
"""
import bisect
import math
import re

RELATIVE = 1e-5  # tolerance, relative to the larger end


def read(text, max_dim):
    """Reads Ripser's output as {dim: sorted [(birth, death)]}."""
    bars, dim = {d: [] for d in range(max_dim + 1)}, None
    for line in text.splitlines():
        if found := re.match(r"persistence intervals in dim(?:ension)? (\d+)", line):
            dim = int(found[1])
        elif found := re.match(r" \[([^,]+), ?([^)]*)\)", line):
            bars[dim].append((float(found[1]), float(found[2]) if found[2] else math.inf))
    return {d: sorted(list_) for d, list_ in bars.items()}


def _slack(value):
    return RELATIVE * abs(value) if math.isfinite(value) else 0.0


def _close(a, b):
    return a == b or abs(a - b) <= max(_slack(a), _slack(b))


def _unmatched(ours, theirs):
    """The bars of either list that have no partner in the other list. Each bar is paired with the
    first unpaired bar that is close to it."""
    births = [birth for birth, _ in theirs]
    free = [True] * len(theirs)
    alone = []
    for birth, death in ours:
        slack = 2 * _slack(birth)
        window = range(bisect.bisect_left(births, birth - slack), bisect.bisect_right(births, birth + slack))
        partner = next((i for i in window
                        if free[i] and _close(birth, births[i]) and _close(death, theirs[i][1])), None)
        if partner is None:
            alone.append((birth, death))
        else:
            free[partner] = False
    return alone, [bar for bar, is_free in zip(theirs, free) if is_free]


def difference(ours, theirs):
    """A description of the first difference, or None. Bars so short that they may be due to
    rounding do not count."""
    for dim, bars in ours.items():
        other = theirs.get(dim, [])
        for owner, list_ in zip(("ours", "theirs"), _unmatched(bars, other)):
            for birth, death in list_:
                if not _close(birth, death):
                    return (f"H{dim}: only {owner} [{birth:g}, {death:g}); {len(bars)} bars of ours, "
                            f"{len(other)} of theirs")
    return None
