# SPDX-License-Identifier: MIT
"""The faults that plant_mutants.py plants in the code for diagram distances and vectors; see
mutants.py."""
from mutant import found_by

MUTANTS = [
    *found_by("bottleneck_tests", [
        ("bottleneck: radius exclusive", "bottleneck-radius", ">", ">="),
        ("bottleneck: no bar of a closed tree may stay alone", "bottleneck-alone", "for (const Number a : nodes_) ;"),
        ("bottleneck: nobody else comes within reach of a closed tree", "bottleneck-unseen", ";"),
        ("bottleneck: the matching with fewer pairs", "bottleneck-pairs", ">", "<"),
    ]),
    *found_by("points_left_tests", [
        ("bottleneck: a node counts as empty once one of its halves is", "bottleneck-node", "] | left_[2 * node", ""),
    ]),
    *found_by("assignment_tests", [
        ("Wasserstein: the second best is not looked for", "auction-second", "first", "second"),
        ("Wasserstein: bids beyond the cost of being alone", "auction-alone", "const double price = second;"),
        ("Wasserstein: pairs are kept whatever they cost", "auction-part", "assignment_.part(0, x)", ""),
        ("Wasserstein: a path leaves the prices of the other side", "path-prices", "- rise", ""),
    ]),
    *found_by("wasserstein_tests", [
        ("Wasserstein: the diagonal is as far in every norm", "diagonal-norm", "return ground > 0 ? 1 : 2;"),
    ]),
    *found_by("many_diagrams_tests", [
        ("sliced Wasserstein: both ends of the half circle", "sliced-angle", "static_cast<double>(count)",
         "(static_cast<double>(count) - 1)"),
        ("sliced Wasserstein: nothing of the other diagram", "sliced-other", ";"),
        ("diagram distances: in the order in which they are done", "distance-place", "place", "k"),
        ("barycentre: the diagonal does not count", "barycentre-diagonal", "==", "<="),
    ]),
    *found_by("significance_tests", [
        ("universal null: the mean of noise is 0", "null-mean", "- std::numbers::egamma", ""),
        ("universal null: Čech as Rips", "null-cech", "0.5", "1"),
        ("quantile: one side of two", "quantile-side", "*", "/ 2 *"),
        ("confidence radius: not doubled", "confidence-doubled", "2 *", ""),
        ("confidence radius: a node is what its first child is", "parts-node", "kMixed", "of_node[below]"),
        ("bootstrap: sums, not means", "bootstrap-mean", "/ count", ""),
        ("permutation test: the observed one is no shuffle", "permutation-observed",
         "(static_cast<double>(as_low_count) + 1)", "static_cast<double>(as_low_count)"),
        ("permutation test: pairs of a bar with itself", "permutation-itself", "(sizes[g] - 1)", "sizes[g]"),
        ("permutation test: powers overflow", "permutation-powers", "return least < most ? 1 : largest * of_largest;"),
    ]),
    *found_by("curves_tests", [
        ("vectors: a capped bar is dropped as well", "vector-capped", "continue;"),
        ("vectors: a place in a grid is one too far", "grid-place", "if (is_end) return guess;"),
        ("vectors: the last value of a grid is rounded", "grid-last", ""),
        ("vectors: a silhouette does not fall", "silhouette-falls", "-", ""),
        ("vectors: the entropy curve has shares of those alive", "entropy-share", "=", "= 0.5 *"),
    ]),
    *found_by("vectors_tests", [
        ("vectors: bars of length 0 count", "vector-length-zero", ""),
        ("vectors: a percentile from the farther neighbour", "percentile", "part :", "(1 - part) :"),
        ("vectors: the standard deviation of a sample", "deviation", "size()", "size() - 1"),
        ("vectors: sums forget what they rounded", "long-sum", "low_ += 0;"),
        ("persistence images: a window of 4 standard deviations", "image-window", "8", "4"),
        ("persistence images: density in place of the integral", "image-integral",
         "masses_[i] = (edges_[i + 1] - edges_[i]) / (2 * width_) * 1.128379 * std::exp(-(edges_[i] - centre) * (edges_[i] - centre) / width_ / width_);"),
    ]),
    *found_by("landscape_tests", [
        ("landscapes: bars that fall as they begin to are left out", "landscape-deaths",
         "if (i > 0) for (const Bar& bar : sorted.at(i - 1)) deaths.offer(bar.death);"),
        ("landscapes: what two tents share is not left below", "landscape-shared", ""),
        ("landscapes: tents that begin together are in the wrong order", "landscape-order", ">", "<"),
    ]),
    *found_by("euler_curve_tests", [
        ("Euler curves: equal neighbours decide for both", "euler-equal", "direction.is_down", "true"),
        ("Euler curves: a circle is open", "euler-circle", "&& !is_circle_", ""),
        ("Euler curves: cells with four facets look at three", "euler-facets", "3", "4"),
        ("Euler curves: cells above the threshold enter", "euler-threshold", "if (change == 0) return;"),
        ("Euler curves: the first axis is no circle", "euler-first-axis", "return kNone;"),
        ("Euler curves: a bar of odd dimension counts like others", "euler-sign", "const std::int64_t sign = 1;"),
    ]),
    *found_by("batches_tests", [
        ("ATOL: centres depend on the order of bars", "atol-order", ""),
        ("ATOL: copies of a bar count once", "atol-copies", "heaps.back().count = 1;"),
        ("ATOL: rounds end after the first", "atol-rounds", "most_rounds", "1"),
        ("ATOL: widths keep the unit in which they were computed", "atol-unit", "!", ""),
        ("ATOL: means are sums that were rounded", "atol-clamp", "std::clamp(x / count, low[0], high[0])", "x / count"),
        ("kernels: near is half as near", "kernel-reach", "const double reach = 0.5 * width;"),
        ("kernels: the mirrored bar is at twice the length", "kernel-mirror", "2", "4"),
    ]),
    *found_by("wasserstein_scales_tests", [
        ("Wasserstein: what was found first is optimal", "wasserstein-refined", "return found;"),
        ("Wasserstein: powers that vanish are zero", "wasserstein-vanishes", "return true;"),
        ("Wasserstein: to be alone costs half of what was found", "wasserstein-most", "2", "0.5"),
    ]),
]
