#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Compares bars of alpha complexes with the exact bars of GUDHI: compare_alpha.py CASES

Exits with 77 if GUDHI is not installed.
"""
import json
import math
import sys

SKIPPED = 77
NEAR = 1e-12  # relative; with weights, relative to the squares of coordinates


def gudhi_bars(case):
    import gudhi

    weights = {"weights": case["weights"]} if case["weights"] else {}
    complex_ = gudhi.AlphaComplex(points=case["points"], precision="exact", **weights)
    tree = complex_.create_simplex_tree()
    pairs = tree.persistence(homology_coeff_field=case["field"], min_persistence=0,
                             persistence_dim_max=True)
    return [(d, b, e) for d, (b, e) in pairs]


def groups(first, second, least):
    """Groups of bars whose births are equal up to rounding, each as two lists of (birth, death):
    the bars of the first and of the second barcode."""
    both = sorted([(b, e, 0) for b, e in first] + [(b, e, 1) for b, e in second])
    group = [[], []]
    last = None
    for birth, death, which in both:
        if last is not None and birth - last > max(least, NEAR * abs(birth)):
            yield group
            group = [[], []]
        group[which].append((death, birth))
        last = birth
    yield group


def difference(case, ours, theirs):
    """What is wrong, or None. Bars that may have been created by rounding do not count."""
    largest = max(abs(x) for row in case["points"] for x in row) ** 2
    least = 1e-15 * largest
    if case["weights"]:
        least = NEAR * max(largest, *case["weights"])
    for dim in range(4):
        lasting = [[(b, e) for d, b, e in bars if d == dim and e - b > max(2 * least, 2 * NEAR * e
                    if e < math.inf else 0)] for bars in (ours, theirs)]
        if len(lasting[0]) != len(lasting[1]):
            return f"H{dim}: libph {len(lasting[0])} bars, gudhi {len(lasting[1])}"
        for group in groups(*lasting, least):
            if len(group[0]) != len(group[1]):
                return f"H{dim}: births {group[0][:3]} in libph, {group[1][:3]} in gudhi"
            for (e, b), (f, c) in zip(sorted(group[0]), sorted(group[1])):
                if not math.isclose(e, f, rel_tol=NEAR, abs_tol=least):
                    return f"H{dim}: libph [{b}, {e}), gudhi [{c}, {f})"
    return None


def main():
    try:
        import gudhi  # noqa: F401
    except ImportError as error:
        print(f"SKIPPED: {error} (apt install python3-gudhi python3-numpy)")
        return SKIPPED
    count = failed = bars = 0
    with open(sys.argv[1]) as file:
        for line in file:
            case = json.loads(line)
            ours = [tuple(bar) for bar in case["bars"]]
            wrong = difference(case, ours, gudhi_bars(case))
            bars += len(ours)
            if wrong:
                failed += 1
                print(f"case {count}: {wrong}")
                if failed == 1 and len(case["points"]) < 50:
                    print(f"  {line}")
            count += 1
    print(f"{count - failed} passed, {failed} failed (alpha complexes compared with gudhi, {bars} "
          "bars)")
    return 1 if failed or not bars else 0


if __name__ == "__main__":
    sys.exit(main())
