# SPDX-License-Identifier: MIT
"""The faults that plant_program_mutants.py plants in ph-distance, in the form of
program_mutants.py."""
from mutant import found_by

MUTANTS = [
    *found_by("ph_distance_results", [
        ("distances: bars of infinite kinds that agree are the reason", "distance-infinite", "!=", "=="),
        ("distances: what is not exact is printed as if it were", "distance-exact", "0", "99"),
        ("distances: the ground norm is not passed on", "distance-ground", "choice.wasserstein_ground", "kInfinity"),
        ("distances: a text is in no unit", "distance-text", "0", "99"),
        ("pairs: distances in the order of the tasks", "pair-order", "task.a, task.b",
         "barcodes.size() - 1 - task.b, barcodes.size() - 1 - task.a"),
        ("matrix: the first of several dimensions", "matrix-dimensions", "size() != 1", "empty()"),
        ("matrix: all pairs are printed as well", "matrix-table", "matrix.empty()", "true"),
        ("matrix: infinite numbers without a word", "matrix-infinite", "0", "99"),
        ("names: quotes in a cell are not doubled", "csv-quotes", "text.insert(i, 1, '\"');", "{}"),
    ], targets=["ph-distance"]),
    *found_by("ph_distance_matchings", [
        ("matchings: bars of the second barcode are left out", "matching-second", "static_cast<void>(j);"),
        ("matchings: costs in the maximum norm", "matching-cost", "*choice.ground()", "kInfinity"),
        ("matchings: the diagonal begins where the bar does", "matching-diagonal", "const double middle = bar.birth;"),
        ("matchings: infinite ends are apart", "matching-infinite", "== y ? 0 : x", ""),
    ], targets=["ph-distance"]),
    *found_by("ph_distance_groups", [
        ("groups: more words than barcodes", "group-words", "!=", "<"),
        ("groups: the first word of a line", "group-first-word", "!= word.end", "== word.end() && word.empty"),
        ("groups: an infinite distance has no names", "group-infinite", "isinf", "isnan"),
        ("groups: the seed is not passed on", "group-seed", 'static_cast<void>(parse_integer("--seed", text, 0));'),
    ], targets=["ph-distance"]),
    *found_by("ph_distance_options", [
        ("options: --at-most is dropped by --groups", "scope-at-most", "kNoGroups", "kAnyAim"),
        ("options: --error is dropped by a matching that is exact", "matching-error", "0", "99"),
        ("options: text in a file that is named as an array", "text-as-array", "a.output_format", "!a.output->empty()"),
        ("options: the groups may be replaced", "group-file", ""),
    ], targets=["ph-distance"]),
]
