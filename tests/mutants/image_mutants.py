# SPDX-License-Identifier: MIT
"""The faults that plant_mutants.py plants in images and parts; see mutants.py."""
from mutant import found_by

MUTANTS = [
    *found_by("known_images_tests", [
        ("cubical: both ends of an edge with one sign", "cubical-edge-sign", "-", ""),
        ("cubical: signs do not alternate from axis to axis", "cubical-axis-sign", ""),
        ("cubical: first cofacet not the oldest where an axis wraps", "cubical-wrapped",
         "if (wrapped && count > 99) {"),
        ("cubical: a periodic axis wraps one cell short", "cubical-wrap", ",", "- 1,"),
        ("cubical: superlevel sets forget the sign", "cubical-superlevel", "grid_.superlevel = false;"),
        ("cubical, by stars: threshold exclusive", "star-threshold", "<=", "<"),
    ]),
    *found_by("gradient_tests", [
        ("cubical: threshold exclusive", "cubical-threshold", "<=", "<"),
        ("columns: what makes a chain long is not put in order", "chain-long", ""),
    ]),
    *found_by("masked_images_tests", [
        ("cubical, by stars: what is absent is young in both constructions", "star-absent", "!(u <= v) : !(u >= v)",
         "u > v : u < v"),
        ("cubical: what is absent has a sign", "cubical-absent", "std", "(superlevel ? -1 : 1) * std"),
        ("cubical: NaN without a mask is taken", "cubical-nan", ""),
    ]),
    *found_by("image_part_tests", [
        ("parts: NaN is taken for a value", "part-nan", ""),
        ("parts: what is open before some layers is taken for old", "seam-age",
         "return root.kind == Kind::critical ? 1 : 2;"),
        ("parts: nothing reaches the seam before", "seam-before", "before, &", ""),
        ("parts: a ring stays open", "part-ring", ""),
        ("parts: turned around, the end comes first", "part-turned", "const bool come_before = false;"),
        ("parts: edges that a part alone leaves over are lost", "part-edges-left", ""),
        ("parts: seams are not compared", "seam-compared", "== next.before.values",
         ".size() == next.before.values.size()"),
        ("parts: a checksum is not looked at", "part-checksum", ") refuse(", "&& expected == 0) refuse("),
        ("parts: layers that are told may be of any order", "part-layer-order", "greater_equal", "greater"),
        ("parts: cells behind the last voxels have seams", "seam-cell", ""),
    ]),
    *found_by("ranks_tests", [
        ("ranks: messages have no order", "message-order", "!=", ">"),
        ("ranks: messages are not checked", "message-checksum", "!= expected_checksum", "== expected_checksum + 1"),
        ("ranks: the last of an odd number waits for nobody", "join-odd", "<", "+ 1 <"),
        ("parts: their first layers are those of the parts before", "part-first-layer", "upper_bound", "lower_bound"),
    ]),
    *found_by("image_loops_tests", [
        ("loops in parts: what came last is older", "square-order", "return a < b;"),
        ("loops in parts: joins tell nothing", "join-free", ".add", "= std::move"),
        ("loops in parts: squares lead out of ghosts", "ghost-squares", "return true;"),
        ("loops in parts: the first layer of a ring is like others as a ghost", "ghost-of-ring",
         "if (false) return star_tables(wrapped(v) | 1U << layer_axis());"),
        ("loops in parts: a pivot is lost when its column goes", "chain-pivot-stays", "stay_.clear();"),
        ("columns: what replaces cells below a pivot is never younger", "chain-replace",
         "take_pivot(replace); return pivot;"),
        ("loops in parts: a column goes, even if its pivot has become one of the part's own", "column-goes",
         "(pivot && !is_here()) pivot = chain.follow(*pivot, times * (chain.size() + few)); if (is_here()) return false",
         "(is_here()) return false; if (pivot) pivot = chain.follow(*pivot, times * (chain.size() + few))"),
        ("loops in parts: no work waits for ghosts", "ghosts-ready", "&& layers_missing_ == 0", ""),
    ]),
    *found_by("part_forecast_tests", [
        ("parts: no layer is kept for the last ones", "part-last-layers", "|| must", ""),
        ("parts: nothing is foreseen of layers with few rows", "forecast-few-rows", "std::min(step / 2, rows - 1)",
         "step / 2"),
    ]),
    *found_by("many_axes_part_tests", [
        ("parts of many axes: what comes later is older if it is equal", "many-axes-tie",
         "return values_[u] <= values_[v];"),
        ("parts of many axes: cells around a ring are not the last", "many-axes-ring", "3,", "0,"),
        ("parts of many axes: of two top cells of a star the younger one stays", "many-axes-stays", ">", "<"),
        ("parts of many axes: a cell is in a star without its faces", "many-axes-faces", ""),
    ]),
    *found_by("slabs_tests", [
        ("slabs: ghosts of one axis have cells", "slab-ghosts", ""),
        ("slabs: of one axis what comes from the other end comes before", "slab-one-axis", "if (false) {"),
        ("slabs: a circle has no loop", "slab-circle", ""),
    ]),
    *found_by("cloud_part_tests", [
        ("cloud parts: what has to be joined may not be", "cloud-joined", "|| !forest.claims.empty()", ""),
    ]),
    *found_by("voxel_representatives_tests", [
        ("voxels: what goes around a circle of one voxel is a set", "voxels-of-circle",
         "&& grid_.shape().loop_count() == 0", ""),
        ("voxels: a hollow without voxels has no cycle", "voxels-of-hollow", "if (rep.as_set) return;"),
    ]),
]
