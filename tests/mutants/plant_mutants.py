#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Plants faults in a copy of libph, one at a time, and demands that the tests find each of them.

    plant_mutants.py [--jobs N] [--check] [NAME...]     (names of mutants; default: all)

A mutant is killed if one of its test programs fails or runs into the time limit. It counts as a
failure if the tests pass, if it does not compile, or if the text it replaces is not found exactly
once: then the code has moved on and the mutant must follow. Exit code 0 if all were killed.
--check builds nothing and only sees whether each text is found.
"""
import argparse
import os
import shutil
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TIME_LIMIT = 90  # seconds a test program may run

CUBES = "libph/include/ph/complex/cubical_cells.ipp"
CUBICAL = "libph/src/complex/cubical.cpp"
RIPS = "libph/include/ph/complex/rips_filtration.hpp"
GRAPH = "libph/include/ph/complex/rips_graph.hpp"
GRAPH_CPP = "libph/src/complex/rips_graph.cpp"
FOREST = "libph/src/metric/spanning_forest.cpp"
FOREST_PRIM = "libph/include/ph/metric/spanning_forest.hpp"
SEARCH = "libph/src/metric/neighbour_search.cpp"
ANNOTATIONS = "libph/include/ph/engine/annotations.hpp"
DEAD_GENERATORS = "libph/include/ph/engine/dead_generators.hpp"
EXTENSIONS = "libph/include/ph/engine/lens_extensions.hpp"
SURFACES = "libph/include/ph/engine/lens_surfaces.hpp"
TRIANGLES = "libph/include/ph/engine/triangle_cochain.hpp"
HOMOLOGY = "libph/include/ph/engine/homology_reduction.hpp"
COHOMOLOGY = "libph/include/ph/engine/cohomology_reduction.hpp"
GROUPS = "libph/include/ph/complex/rips_groups.hpp"
WEIGHTS = "libph/src/complex/vertex_weights.cpp"
COLLAPSE = "libph/src/complex/edge_collapse.cpp"
COLLAPSE_ROWS = "libph/src/complex/collapse_rows.hpp"
COLLAPSE_LISTS = "libph/src/complex/collapse_lists.hpp"

# name, file, text that occurs exactly once, what replaces it, test programs that must notice
MUTANTS = [
    ("cubical: both ends of an edge with one sign", CUBES,
     "visit(Cell{keys[lower], lower}, -sign);", "visit(Cell{keys[lower], lower}, sign);",
     ["known_images"]),
    ("cubical: signs do not alternate from axis to axis", CUBES,
     "    sign = -sign;\n  }\n}", "  }\n}", ["known_images"]),
    ("cubical: first cofacet not the oldest where an axis wraps", CUBES,
     "if (wrapped) {", "if (wrapped && count > 99) {", ["known_images"]),
    ("cubical: a periodic axis wraps one cell short", CUBICAL,
     "below = x > 0 ? x - 1 : last,", "below = x > 0 ? x - 1 : last - 1,", ["known_images"]),
    ("cubical: superlevel sets forget the sign", CUBICAL,
     "grid_.superlevel = options.superlevel;", "grid_.superlevel = false;", ["known_images"]),
    ("cubical: threshold exclusive", CUBICAL,
     "value <= grid_.limit)", "value < grid_.limit)", ["arrows_tests"]),
    ("cubical, by stars: threshold exclusive", "libph/src/cubical/star_grid.cpp",
     ": static_cast<double>(x)) <= limit;", ": static_cast<double>(x)) < limit;", ["known_images"]),
    ("rips: facets all with one sign", RIPS,
     "visit(Cell{key, without(cell.vertices, slot)}, slot % 2 == 0 ? 1 : -1);",
     "visit(Cell{key, without(cell.vertices, slot)}, 1);", ["conformance_random"]),
    ("rips: tie-break turned round", RIPS,
     "a.vertices < b.vertices", "b.vertices < a.vertices", ["conformance_random"]),
    ("rips: a facet keeps its coface's key", RIPS,
     "if (gone == longest.u || gone == longest.v) {", "if (gone == longest.u && dim > 9) {",
     ["conformance_random"]),
    ("rips: enclosing radius halved", GRAPH,
     "threshold.value_or(radius);", "threshold.value_or(radius / 2);", ["invariance_tests"]),
    ("rips: threshold exclusive", GRAPH, "if (row[j] <= last)", "if (row[j] < last)", ["invariance_tests"]),
    ("edges: ties turned round", "libph/include/ph/core/filtration.hpp",
     "return a.u != b.u ? a.u < b.u : a.v < b.v;", "return a.u != b.u ? a.u > b.u : a.v > b.v;",
     ["rips_tests"]),
    ("lens: birth of the oldest generator", ANNOTATIONS,
     "return vectors_[a.id].back().cell;", "return vectors_[a.id].front().cell;",
     ["conformance_random"]),
    ("lens: two components at most", "libph/include/ph/engine/lens_sweep.hpp",
     "i < components_.count(); ++i) {", "i < std::min<std::size_t>(2, components_.count()); ++i) {",
     ["conformance_random"]),
    ("lens: active edges at one end only", "libph/src/engine/lens_graph.cpp",
     "return in_lens(e.u, w); });", "return in_lens(e.u, w) && w > e.u; });", ["conformance_random"]),
    ("lens: idle though classes live", "libph/include/ph/engine/lens_sweep.hpp",
     " && living_ == 0;", ";", ["conformance_random"]),
    ("lens: idle bins are never added", "libph/include/ph/engine/lens_sweep.hpp",
     "graph_.add_all(edges, context_);", "(void)edges;", ["conformance_random"]),
    ("lens, lists: active edges to whatever is joined to the larger end", "libph/src/engine/lens_graph.cpp",
     "marks_[w] == of_both;", "marks_[w] != 0 && w > 2;", ["conformance_random"]),
    ("lens: who comes to hold a generator is not noted", ANNOTATIONS,
     "holders_[t.cell].add(holders);", "(void)holders;", ["representatives_random"]),
    ("lens: over Z/p a generator that leaves is still held", ANNOTATIONS,
     "if (!dead_.contains(g)) holders_[g].erase(id);", "(void)g;", ["representatives_random"]),
    ("lens: what a generator became has the other sign", DEAD_GENERATORS,
     "const auto scale = field_.negate(field_.inverse(", "const auto scale = (field_.inverse(",
     ["annotation_tests"]),
    ("lens: what comes in for a dead generator may be dead", DEAD_GENERATORS,
     "while (const Word dead", "if (const Word dead", ["annotation_tests"]),
    ("lens: a class never learns of deaths", ANNOTATIONS,
     "if (seen_[a.id] == dead_.count() || a.is_zero()) return a;", "return a;",
     ["conformance_random"]),
    ("lens, lists: a neighbour comes last", "libph/include/ph/engine/neighbour_lists.hpp",
     "std::lower_bound(begin, end, v);", "end;", ["edge_lists_tests"]),
    ("id sets: a row of bits forgets who comes", "libph/include/ph/engine/id_set.hpp",
     "bits_.resize(other.bits_.size());", "bits_.clear();", ["annotation_tests"]),
    ("edges: gaps in the last bin", "libph/src/core/binned_edges.cpp",
     "last_parts_[w]),", "last_parts_[0]),", ["rips_tests"]),
    ("lens: classes that become equal lose their sign", ANNOTATIONS,
     "links_[id] = {other, are_opposite(id, other)};", "links_[id] = {other, false};",
     ["conformance_random"]),
    ("surfaces: components that kill nothing bear nothing", "libph/include/ph/engine/lens_sweep.hpp",
     "      born_.push_back(i);\n      continue;", "      continue;", ["conformance_random"]),
    ("surfaces: a class at both ends is seen at one", EXTENSIONS,
     "j->generator <= i->generator);", "j->generator < i->generator);", ["conformance_random"]),
    ("surfaces: who lives on is not corrected", SURFACES,
     "cocycles_.add(x.generator, y.generator, scale);", "", ["conformance_random"]),
    ("surfaces: an elder class is added", SURFACES,
     "for (std::size_t i = 0; i < dying; ++i) {", "for (std::size_t i = dying; i-- > 0;) {",
     ["conformance_random"]),
    ("surfaces: the dead are not forgotten", SURFACES,
     "births_[h].edge = kDead;", "", ["conformance_random"]),
    ("surfaces: every potential fits", EXTENSIONS,
     "neighbours, field_, words)) return false;", "neighbours, field_, words)) continue;",
     ["conformance_random"]),
    ("surfaces: hubs see all of a lens", "libph/src/engine/lens_cover.cpp",
     "left |= rest_[k] = component[k] & ~reached_[k];", "rest_[k] = 0;", ["conformance_random"]),
    ("surfaces: any vertex is an apex", "libph/src/engine/lens_components.cpp",
     "if (missed == bits::kNone) {", "if (true) {", ["conformance_random"]),
    ("surfaces: cones forget one end", EXTENSIONS,
     "for (const Term& t : at_v ? x.at_v : x.at_u) {", "for (const Term& t : x.at_u) {",
     ["conformance_random"]),
    ("surfaces: mismatches are only looked for in the first part", EXTENSIONS,
     "if (Row::difference(mismatch(x), p,", "if (i == 0 && Row::difference(mismatch(x), p,",
     ["conformance_random"]),
    ("surfaces: parts keep their constants", EXTENSIONS,
     "if (here == value) continue;", "continue;", ["conformance_random"]),
    ("surfaces: the younger part survives", "libph/include/ph/engine/lens_forest.hpp",
     "roots_[part] < roots_[all];", "roots_[part] > roots_[all];", ["conformance_random"]),
    ("surfaces: a star with one sign", TRIANGLES,
     "(end == u) == (other < w) ? a : field.negate(a)", "a", ["conformance_random"]),
    ("surfaces: rows of edges with one sign", TRIANGLES,
     "a < b ? value : shared.field.negate(value)", "value", ["conformance_random"]),
    ("surfaces: stars are written with one sign", "libph/include/ph/engine/star_writer.hpp",
     "v, w < u ? a : opposite", "v, a", ["conformance_random"]),
    ("weights: edges forget births", WEIGHTS, "double value = std::max(born, distance);",
     "double value = distance;", ["weighted_rips_tests"]),
    ("weights: the ball of the elder is forgotten", WEIGHTS, "distance + (b / 2 + c / 2)",
     "distance + std::min(b, c)", ["weighted_rips_tests"]),
    ("weights: the smaller number is the elder", "libph/include/ph/engine/lens_sweep.hpp",
     "if (age_[younger] < age_[elder])", "if (younger < elder)", ["weighted_rips_tests"]),
    ("weights: vertices in the order of their numbers", RIPS,
     "if (a.key == 0 && value(a) != value(b)) return value(a) < value(b);", "",
     ["weighted_rips_tests"]),
    ("weights: the enclosing radius forgets births", GRAPH,
     "std::ranges::copy(weights.births(), farthest.begin());", "", ["weighted_rips_tests"]),
    ("weights: who is born at the threshold stays away",
     "libph/src/complex/rips_vertices.cpp", "births[v] > *threshold", "births[v] >= *threshold",
     ["weighted_rips_tests"]),
    ("greedy: the last among equals", "libph/include/ph/metric/greedy_permutation.hpp",
     "if (of_i > nearest[", "if (of_i >= nearest[", ["sampling_tests"]),
    ("greedy: roots are not compared", "libph/src/metric/greedy_permutation.cpp",
     "std::sqrt(nearest_[i]) == root", "nearest_[i] == largest", ["sampling_tests"]),
    ("sparse: balls stop at half their size", "libph/src/complex/sparse_rips.cpp",
     "2 * order.radii[k] * (1 + 1 / epsilon)", "order.radii[k] * (1 + 1 / epsilon)",
     ["sampling_tests"]),
    ("sparse: edges come as if balls still grew", "libph/include/ph/complex/sparse_rips.hpp",
     "distance + (distance - small);", "distance;", ["sampling_tests"]),
    ("sparse: edges go too early", "libph/include/ph/complex/sparse_rips.hpp",
     "value <= (1 + epsilon_) * small", "value <= small", ["sampling_tests"]),
    ("collapse: a dominator stays one whatever comes", COLLAPSE,
     "dominates = dominates && graph_.are_joined(dominator, x, now);", "(void)x;",
     ["edge_collapse_tests"]),
    ("collapse: edges of the past are never left", COLLAPSE,
     "if (kept[i].to == last) graph_.leave", "if (kept[i].to == 0) graph_.leave",
     ["edge_collapse_tests"]),
    ("collapse: edges of one value in any order", COLLAPSE,
     "std::ranges::sort(kept);",
     "std::ranges::sort(kept, [](auto a, auto b) {"
     " return a.to < b.to || (a.to == b.to && a.edge > b.edge); });",
     ["edge_collapse_tests"]),
    ("collapse: moved edges keep their value", COLLAPSE,
     "edges.push_back({input_.value(to), e.u, e.v});", "edges.push_back({e.value, e.u, e.v});",
     ["edge_collapse_tests"]),
    ("collapse: one pass only", COLLAPSE,
     "while (is_next_worth(before, collapsed.edge_count())) {", "while (false) {",
     ["edge_collapse_tests"]),
    ("collapse, rows: what comes later counts as there", COLLAPSE_ROWS,
     "it->vertex == b && it->key <= now", "it->vertex == b", ["edge_collapse_tests"]),
    ("collapse, rows: a neighbour comes with one of its edges", COLLAPSE_ROWS,
     "arrivals.push_back({std::max(x.key, other->key), x.vertex});",
     "arrivals.push_back({std::min(x.key, other->key), x.vertex});", ["edge_collapse_tests"]),
    ("collapse, rows: too few candidates", COLLAPSE_ROWS,
     "for (const Vertex x : also_) insert(set, x);", "", ["edge_collapse_tests"]),
    ("collapse, lists: the lens of the end", COLLAPSE_LISTS,
     "if (key <= now) lens.push_back(x);", "lens.push_back(x);", ["edge_collapse_tests"]),
    ("collapse: zero-length bars are lost in silence", "libph/src/persistence/collapse_choice.cpp",
     "if (options.min_persistence < 0)", "if (options.min_persistence < -9)",
     ["edge_collapse_tests"]),
    ("forest: threshold exclusive", FOREST_PRIM,
     "if (first.value <= limit &&", "if (first.value < limit &&", ["components_tests"]),
    ("forest: copies joined one to the next", FOREST,
     "forest.push_back({0.0, i, first_equal[i]});", "forest.push_back({0.0, i, i - 1});",
     ["components_tests"]),
    ("forest: neighbours known are all there are", FOREST,
     "if (point.place == kKnown) point.knows = Knows::lower_bound;",
     "if (point.place == kKnown) point = {{limit_, kNone}, kKnown, Knows::lower_bound};",
     ["components_tests"]),
    ("forest: bounds that tie are never asked", FOREST,
     "return best == kNone || precedes(p, best);", "return best == kNone;",
     ["components_tests"]),
    ("forest: a leaf is of its first point's component", FOREST,
     "if (component_[p] != first) return Parts::kMixed;", "if (p == tree_.size()) return Parts::kMixed;",
     ["components_tests"]),
    ("search: ties by the order of the tree", SEARCH,
     "tree_.rows()[a.position] < tree_.rows()[b.position]", "a.position < b.position",
     ["components_tests"]),
    ("search: no room for rounding", SEARCH,
     "return 1 + 4e-16 * static_cast<double>(axes + 8);",
     "return 1 - 4e-16 * static_cast<double>(axes + 8);", ["components_tests"]),
    ("rips: threshold ignored for sparse distances", GRAPH_CPP,
     "const double last = std::min(limit, std::numeric_limits<double>::max());",
     "const double last = std::numeric_limits<double>::max();", ["rips_tests"]),
    ("near pairs: radius exclusive", "libph/src/metric/pairs_within.cpp",
     "if (Index{j} <= i) continue;\n      if (const double d = metric(i, j); d <= radius)",
     "if (Index{j} <= i) continue;\n      if (const double d = metric(i, j); d < radius)",
     ["metric_tests"]),
    ("homology: no clearing", HOMOLOGY,
     "previous_pivots_ = std::move(pivots_);", "previous_pivots_ = CellMap<F>(f_, &context_.memory);",
     ["conformance_random"]),
    ("homology: pivots not reset", HOMOLOGY,
     "pivots_ = CellMap<F>(f_, &context_.memory);\n  }", "pivots_ = previous_pivots_;\n  }",
     ["persistence_tests"]),
    ("cohomology: no clearing", COHOMOLOGY, "cleared_.insert(column->pivot, 0);", "",
     ["conformance_random"]),
    ("cohomology: a zero coefficient is kept", "libph/include/ph/engine/working_column.hpp",
     "if (!field.is_zero(sum)) chain[kept++] = Term(cell, sum);", "chain[kept++] = Term(cell, sum);",
     ["representatives_random"]),
    ("cohomology: every first equal cofacet is an emergent pair", COHOMOLOGY,
     "pivots_->owner_of(cofacet).number >= number &&", "",
     ["conformance_random"]),
    ("cohomology: a column that was driven out is left alone", COHOMOLOGY,
     "if (other == PivotTable<F, K>::kNone) return;", "if (other != number) return;",
     ["conformance_random"]),
    ("pivots: the first to come stays", "libph/include/ph/engine/pivot_table.hpp",
     "if (found.owner.number != kNone && found.owner.number < i) return i;",
     "if (found.owner.number != kNone) return i;", ["conformance_random"]),
    ("rips: any lens is a cone", GROUPS, "return missed == 0;\n  }", "return true;\n  }",
     ["conformance_random"]),
    ("rips: the least vertex is like the others", GROUPS, "if (x == lowest) return;", "",
     ["conformance_random"]),
    ("rips: any common neighbour makes an apparent pair", "libph/include/ph/complex/rips_filtration.ipp",
     "if (lead.vertex >= below) break;", "", ["conformance_random"]),
    ("apparent pairs: only one side looked at", "libph/include/ph/engine/apparent_pairs.hpp",
     "if (facet && *facet == cell) return cofacet;", "return cofacet;", ["conformance_random"]),
    ("elder rule reversed", "libph/include/ph/engine/elder_rule.hpp",
     "if (age[younger] < age[elder])", "if (age[younger] > age[elder])", ["merge_tree_tests"]),
    ("field: inverse without its sign", "libph/src/core/field.cpp",
     "s0 < 0 ? s0 + p_ : s0", "s0 < 0 ? -s0 : s0", ["core_tests"]),
    ("merge tree: sizes not added up", "libph/src/engine/merge_tree.cpp",
     "sizes[elder] += sizes[younger];", "sizes[elder] = sizes[younger];", ["merge_tree_tests"]),
    ("barcode: younger bars first", "libph/src/core/barcode.cpp",
     "return bar.birth + 0.0;", "return -bar.birth;", ["core_tests"]),
    ("facade: a negative dimension counts as zero", "libph/src/persistence.cpp",
     "if (dim < 0) throw", "if (dim < -1) throw", ["persistence_tests"]),
    ("estimate: the orders of a clique's vertices count", "libph/src/complex/clique_count.cpp",
     "orders *= static_cast<double>(std::max<std::size_t>(d - 1, 1));", "orders *= 1;",
     ["persistence_tests"]),
    ("estimate: cliques counted from each vertex", "libph/src/complex/clique_count.cpp",
     "intersect(from, neighbours_.above(v), sets[d]);",
     "intersect(from, neighbours_.of(v), sets[d]);", ["persistence_tests"]),
    ("estimate: parts say nothing", "libph/src/persistence/memory_forecast.cpp",
     "kMargin * large.extra * std::pow(factor, power)", "0 * factor * power", ["persistence_tests"]),
    ("explicit complex: a coface may come before its facet", "libph/src/complex/explicit.cpp",
     "if (values[facet] > values[i]) {", "if (values[facet] > values[i] + 1e9) {",
     ["complex_tests"]),
]

SOURCES = ["core", "metric", "complex", "cubical", "engine", "persistence"]  # folders of libph/src
NINJA = """\
cxx = {compiler}
flags = -std=c++20 -O1 -Ilibph/include -Itests '-DPH_SHARED_DIR=""' {includes}
rule compile
  command = $cxx $flags -MMD -MF $out.d -c $in -o $out
  depfile = $out.d
  deps = gcc
rule link
  command = $cxx $in -o $out {libraries}
rule archive
  command = rm -f $out && ar crs $out $in
"""


def flags_of(package):
    found = subprocess.run(["pkg-config", "--cflags", "--libs", package], capture_output=True,
                           text=True, check=True).stdout.split()
    return ([f for f in found if not f.startswith("-l")], [f for f in found if f.startswith("-l")])


def write_build(tree, programs):
    """A build with relative names only, so that a copy of the folder is as up to date as itself."""
    includes, libraries = [], []
    for package in ("eigen3", "fmt", "gtest_main"):
        found = flags_of(package)
        includes += found[0]
        libraries += found[1]
    text = NINJA.format(compiler=os.environ.get("CXX", "c++"), includes=" ".join(includes),
                        libraries=" ".join(libraries + ["-lpthread"]))
    library = []
    sources = [p.relative_to(tree) for f in SOURCES for p in (tree / "libph/src" / f).glob("*.cpp")]
    sources.append(Path("libph/src/persistence.cpp"))
    for source in sorted(sources):
        library.append(f"o/{source.parent.name}_{source.stem}.o")
        text += f"build {library[-1]}: compile {source}\n"
    text += "build o/estimate.o: compile libph/src/estimate.cpp\n"
    text += f"build o/libph.a: archive {' '.join(library)}\n"
    for program in programs:
        text += f"build o/{program}.o: compile tests/core/{program}.cpp\n"
        asks_for_estimate = program in ("persistence_tests", "components_tests")
        extra = "o/estimate.o" if asks_for_estimate else ""
        text += f"build {program}: link o/{program}.o {extra} o/libph.a\n"
    (tree / "build.ninja").write_text(text)


def build(tree, programs, jobs):
    return subprocess.run(["ninja", "-j", str(jobs), *programs], cwd=tree, capture_output=True,
                          text=True)


def passes(tree, program):
    """True or False; None if the time limit was reached."""
    try:
        # Tests of speed and of stopping are not what mutants are for, and slow without optimisation.
        command = [f"./{program}", "--gtest_fail_fast", "--gtest_brief=1",
                   "--gtest_filter=-RunContexts.*:*LinearTime*:*Duplicates*:*LongChains*:*WideCells*"]
        return subprocess.run(command, cwd=tree, capture_output=True, text=True,
                              timeout=TIME_LIMIT).returncode == 0
    except subprocess.TimeoutExpired:
        return None


def why_not_planted(base, mutant):
    """Empty if it can be."""
    _, file, old, _, _ = mutant
    found = (base / file).read_text().count(old) if (base / file).exists() else 0
    return "" if found == 1 else f"NOT PLANTED: {old!r} occurs {found} times in {file}"


def try_mutant(base, mutant):
    _, file, old, new, programs = mutant
    if why_not := why_not_planted(base, mutant):
        return why_not
    text = (base / file).read_text()
    tree = Path(tempfile.mkdtemp(prefix="mutant-", dir=base.parent))
    try:
        shutil.copytree(base, tree, dirs_exist_ok=True)  # times too: only the mutant is built anew
        (tree / file).write_text(text.replace(old, new))
        for program in programs:
            if (result := build(tree, [program], 1)).returncode != 0:
                return "DOES NOT COMPILE: " + result.stdout[-600:]
            passed = passes(tree, program)
            if passed is None:
                return f"killed by the time limit of {program}"
            if not passed:
                return f"killed by {program}"
        return "SURVIVED " + ", ".join(programs)
    finally:
        shutil.rmtree(tree)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("names", nargs="*")
    arguments = parser.parse_args()
    mutants = [m for m in MUTANTS if not arguments.names or m[0] in arguments.names]
    if arguments.check:
        lost = [f"{m[0]}: {why}" for m in mutants if (why := why_not_planted(ROOT, m))]
        print(*lost, f"{len(mutants) - len(lost)} of {len(mutants)} can be planted", sep="\n")
        return 1 if lost else 0
    programs = sorted({p for m in mutants for p in m[4]})
    start = time.monotonic()

    with tempfile.TemporaryDirectory(prefix="ph-mutants-") as folder:
        base = Path(folder) / "base"
        for part in ("libph/include", "libph/src", "tests/core", "tests/support"):
            shutil.copytree(ROOT / part, base / part)
        write_build(base, programs)
        if (result := build(base, programs, arguments.jobs)).returncode != 0:
            print(result.stdout[-4000:])
            return 1
        for program in programs:
            if not passes(base, program):
                print(f"{program} fails without any mutant")
                return 1
        print(f"built without mutants in {time.monotonic() - start:.0f} s", flush=True)

        killed = 0
        with ThreadPoolExecutor(arguments.jobs) as pool:
            for mutant, verdict in zip(mutants, pool.map(lambda m: try_mutant(base, m), mutants)):
                killed += verdict.startswith("killed")
                print(f"{mutant[0]:<60} {verdict}", flush=True)
    print(f"{killed} passed, {len(mutants) - killed} failed "
          f"(mutants killed, {time.monotonic() - start:.0f} s)")
    return 0 if killed == len(mutants) and killed > 0 else 1


if __name__ == "__main__":
    sys.exit(main())
