# SPDX-License-Identifier: MIT
"""The faults that plant_mutants.py plants; found_by in mutant.py explains the rows."""
import alpha_mutants
import diagram_mutants
import image_mutants
import rips_mutants
from mutant import found_by

MUTANTS = [
    *found_by("masked_images_tests", [
        ("voxels without points are infinite, not absent", "absent-voxels", ""),
        ("listed cubes: absent is infinite before the sign", "listed-cubes-absent", "return",
         "return options_.superlevel ? -kInfinity :"),
        ("explicit: infinite cells enter", "explicit-infinite", ""),
        ("filtered graph: infinite vertices enter", "graph-infinite", "visit(v);"),
        ("merge tree: vertices that never enter lose their numbers", "merge-tree-numbers",
         "if constexpr (std::same_as<F, Cubical>) {"),
    ]),
    *found_by("merge_tree_tests", [
        ("merge tree: all merges are at a value of NaN", "merges-at-value", "if (m.value > value) break;"),
        ("elder rule reversed", "elder-rule", "<", ">"),
        ("merge tree: sizes not added up", "merge-sizes", "+=", "="),
    ]),
    *found_by("cluster_tree_tests", [
        ("clusters: larger than the least size", "cluster-real", ">=", ">"),
        ("clusters: the least size is too small", "cluster-recut", "<", "<="),
    ]),
    *found_by("chosen_clusters_tests", [
        ("clusters: children kept at equal mass", "cluster-mass", ">=", ">"),
        ("clusters: an added point stays at the value of the join", "cluster-joins", "<=", "<"),
    ]),
    *found_by("persistence_tests", [
        ("plan: any number is a field", "field-is-prime", ""),
        ("plan: boundaries without incidences are over any field", "field-without-incidences", "!= 2", "== 4"),
        ("homology: pivots not reset", "homology-pivots", "pivots_ = previous_pivots_;"),
        ("facade: a negative dimension counts as zero", "negative-dimension", "< 0", "< -1"),
        ("estimate: parts say nothing", "estimate-parts", "return {least, most + 0 * factor * power};"),
    ]),
    *found_by("rips_tests", [
        ("edges: ties turned round", "edge-order", "< b.u : a.v <", "> b.u : a.v >"),
    ]),
    *found_by("sampling_tests", [
        ("greedy: the last among equals", "greedy-tie", "of_i >", "of_i >="),
        ("greedy: roots are not compared", "greedy-root", "std::sqrt(nearest_[i]) == root", "nearest_[i] == largest"),
    ]),
    *found_by("edge_collapse_tests", [
        ("collapse: zero-length bars are lost in silence", "collapse-zero-length", "0", "-9"),
    ]),
    *found_by("components_tests", [
        ("forest: threshold exclusive", "forest-threshold", "<=", "<"),
        ("forest: copies joined one to the next", "forest-copies", ", first[i]", ", i - 1"),
        ("forest: neighbours known are all there are", "forest-known",
         "if (point.place == kKnown) point = {{limit_, kNone}, kKnown, Knows::lower_bound};"),
        ("forest: bounds that tie are never asked", "forest-bound-tie", "return best == kNone;"),
        ("forest: points born at the reach are not asked", "forest-birth", ">", ">="),
        ("forest: copies with births joined at 0", "forest-born-copies", ": i", ": first[i]"),
        ("forest: a list has all points at the distance of its last one", "forest-lists",
         "value < last", "value <= last"),
        ("forest: ties between components by the last pair", "first-edges",
         "!precedes(edge, first)", "first.value < edge.value"),
        ("search: ties of births by the last row", "search-birth-tie", "> tree_", "< tree_"),
        ("forest: a leaf is of its first point's component", "forest-leaf",
         "if (p == tree.size()) of_node[node] = kMixed;"),
        ("search: ties by the order of the tree", "search-tie",
         "return b.position == kNone || a.position < b.position;"),
        ("search: no room for rounding", "search-slack", "1 +", "1 -"),
    ]),
    *found_by("metric_tests", [
        ("search: radius of pairs exclusive", "search-radius", ">", ">="),
        ("search: pairs of sibling nodes missed", "search-siblings", "visit_pairs", "if (a != b) visit_pairs"),
        ("near pairs: radius of cubes exclusive", "cubes-radius", "<=", "<"),
    ]),
    *found_by("significance_tests", [
        ("random numbers: one sequence for all tasks", "random-task", "+ task", ""),
    ]),
    *found_by("conformance_random_tests", [
        ("homology: no clearing", "homology-clearing", "previous_pivots_ = CellMap<F>(f_, &context_.memory);"),
        ("cohomology: no clearing", "cohomology-clearing", ""),
        ("cohomology: the death of an apparent pair is an emergent pair", "emergent-apparent",
         "!apparent_.birth_cell_of(dim_ + 1, cofacet)", "true"),
        ("cohomology: a column that was driven out is left alone", "column-driven-out", "if (other != number) return;"),
        ("cohomology: the limit of a column never rises", "limit-rises", "return false;"),
        ("cohomology: a raised limit leaves a key out", "limit-first", "1", "2"),
        ("cohomology: beyond the limit only the cell is listed", "limit-chain", ""),
        ("pivots: the first to come stays", "pivot-first", "&& found.owner.number < i", ""),
        ("apparent pairs: only one side looked at", "apparent-both", "return cofacet;"),
    ]),
    *found_by("representatives_random_tests", [
        ("cohomology: a zero coefficient is kept", "zero-coefficient", "chain[kept++] = Term(cell, sum);"),
    ]),
    *found_by("core_tests", [
        ("field: inverse without its sign", "inverse-sign", "s0 + p_", "-s0"),
        ("barcode: younger bars first", "barcode-order", "bar.birth + 0.0", "-bar.birth"),
    ]),
    *found_by("complex_tests", [
        ("explicit complex: a coface may come before its facet", "explicit-facet", "[i]", "[i] + 1e9"),
    ]),
    *found_by("loops_tests", [
        ("loops: elders live longer, not as long", "loops-elder", "<", "<="),
        ("loops: elders are not looked for", "loops-needs-cocycles", ">=", "> 1e9 *"),
        ("loops: a tie after a collapse needs no cocycle", "loops-needs-cocycles",
         "c.needs_cocycles = last_death >= c.lifetime.death || false;"),
        ("loops: the walk is taken apart edge by edge alone", "loops-taken-apart", "length_of(loops)", "0"),
        ("loops: values of cocycles have no sign", "loops-cocycle-sign", "from < to ? value : p_ -", ""),
        ("loops: the first path in the cover is taken", "loops-path", "if (vertex == to) {"),
        ("loops: the distance to the end guides too far", "loops-estimate", "+", "+ 2 *"),
        ("loops: a vertex moves where there is one triangle of two", "loops-triangles", "|| !is_near(near_middle_, w)",
         ""),
        ("loops: steps go over edges of any age", "loops-edge-age", "limit", "limit && limit == 0"),
    ]),
    *found_by("closed_walks_tests", [
        ("loops: walks have the other direction", "walk-turns", "walk.coefficient = a;"),
        ("loops: an edge over the end of a periodic axis", "walk-period", ""),
    ]),
    *found_by("flat_map_tests", [
        ("flat map: the mark of a free slot is looked up like a key", "map-free-key", ""),
        ("flat map: the value of the last number is not cleared", "map-last-value", ""),
    ]),
    *found_by("cloud_part_tests", [
        ("cloud parts: no hop through the sample is long", "cloud-hop", "return least;"),
        ("cloud parts: points of a block are all near the sample", "cloud-near-sample",
         "return gap > reach(own, sample.square, 0, sample.cell, gap);"),
        ("cloud parts: a nearer point of the sample is none of the block's", "cloud-nearer",
         "known = {cell, known.square / 2};"),
        ("cloud parts: opposite blocks do not look for each other", "cloud-opposite", "return false;"),
        ("cloud parts: a region keeps the side of another one", "cloud-region-end", ""),
        ("cloud parts: claims are looked at before edges of their length", "cloud-claims", "<", "<="),
        ("cloud parts: some of them are all", "cloud-whole", "== static_cast<std::size_t>(parts())", "> 0"),
        ("cloud parts: each block has a size of coordinates of its own", "cloud-largest", "largest_", "0"),
    ]),
    *found_by("cloud_blocks_tests", [
        ("cloud parts: ties of coordinates are all on the right", "cloud-tie", "precedes(x, split)", "false"),
    ]),
    *found_by("public_structs_tests", [
        ("explicit complex: offsets of simplices may be anything", "explicit-layout", ""),
        ("explicit complex: simplices without values", "explicit-values", "!=", ">"),
        ("options: a least persistence of NaN", "persistence-nan", "std::isnan(options.min_persistence)", "false"),
        ("distances: any number of points", "matrix-size", "|| size > most", ""),
    ]),
    *alpha_mutants.MUTANTS,
    *diagram_mutants.MUTANTS,
    *image_mutants.MUTANTS,
    *rips_mutants.MUTANTS,
]
