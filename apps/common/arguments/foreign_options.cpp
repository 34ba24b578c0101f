// SPDX-License-Identifier: MIT
#include "apps/common/arguments/foreign_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace ph::app {
namespace {

/// Names of options that other programs and packages have, separated by spaces, and an option of
/// ours. A row applies to the programs that have this option, and the first such row counts.
/// Without a hint, the names stand for the option.
struct ForeignOptions {
  std::string_view names;
  std::string_view option;
  std::string_view hint = {};
};

constexpr std::array kRows{
    ForeignOptions{"maxdim dim dimension maxdimension upper-dim", "--max-dim"},
    ForeignOptions{
        "max-dimension cpx-dimension", "--max-dim",
        "did you mean '--max-dim'? It is the highest dimension of bars, one less than the "
        "dimension of the complex"},
    ForeignOptions{"homology-dimensions top-dim", "--min-dim",
                   "--min-dim and --max-dim are the ends of a range: --min-dim 2 --max-dim 2 gives "
                   "H2 alone"},
    ForeignOptions{"thresh max-edge-length max-edge maxscale max-filtration", "--threshold"},
    ForeignOptions{"coeff field-charac homology-coeff-field prime", "--field"},
    ForeignOptions{"distance-matrix precomputed", "--diagonal",
                   "'--format distance' reads distances"},
    ForeignOptions{"sublevel", "--superlevel",
                   "sublevel sets are the default, --superlevel takes superlevel sets"},
    ForeignOptions{"invert reverse", "--superlevel"},
    ForeignOptions{"labels label-image", "--representatives",
                   "the labels of Python's bars are an image: bars.labels(dim)"},
    ForeignOptions{"betti betti-curve euler euler-curve landscape", "--representatives",
                   "ph-vectorise computes curves and vectors of barcodes"},
    ForeignOptions{"mask", "--nan", "'--nan drop' leaves out the voxels that are NaN"},
    ForeignOptions{"spacing pixdim voxel-spacing", "--construction",
                   "bars do not depend on the size of voxels"},
    ForeignOptions{"connectivity neighbours neighbors", "--construction",
                   "'--construction vertices' joins 4 or 6 neighbours, '--construction cells' 8 or "
                   "26"},
    ForeignOptions{"filtration", "--construction",
                   "'--construction vertices' is the V-construction, '--construction cells' the "
                   "T-construction"},
    ForeignOptions{"periodic-dimensions periodic-axes pbc", "--periodic"},
    ForeignOptions{"box", "--period"},
    ForeignOptions{"do-cocycles cocycles", "--representatives",
                   "did you mean '--representatives cocycles'?"},
    ForeignOptions{"cycles generators", "--representatives",
                   "did you mean '--representatives cycles'?"},
    ForeignOptions{"location", "--representatives", "did you mean '--representatives voxels'?"},
    ForeignOptions{"n-perm n-landmarks landmarks", "--subsample"},
    ForeignOptions{"sparse epsilon", "--approximate",
                   "did you mean '--approximate', which is sparse / (1 - sparse)?"},
    ForeignOptions{"min-samples min-points min-pts", "--neighbours",
                   "did you mean '--neighbours', which does not count the point itself? It is "
                   "min_samples - 1"},
    ForeignOptions{"neighbors n-neighbors k", "--neighbours"},
    ForeignOptions{"min-cluster-size", "--neighbours", "did you mean '--min-size'?"},
    ForeignOptions{"cluster-selection-method", "--neighbours", "did you mean '--method'?"},
    ForeignOptions{"cluster-selection-epsilon eps", "--epsilon"},
    ForeignOptions{"max-cluster-size", "--max-size"},
    ForeignOptions{"allow-single-cluster", "--allow-single"},
    ForeignOptions{"probabilities outlier-scores glosh", "--scores"},
    ForeignOptions{"condensed-tree", "--neighbours", "did you mean '--tree'?"},
    ForeignOptions{"voxel-size leaf-size leaf voxel-resolution", "--voxel"},
    ForeignOptions{"cluster-tolerance eps tolerance", "--min-part",
                   "objects end at seams, and no distance separates them; --voxel sets the scale; "
                   "with '--method paper', --distance joins the voxels that are at most so far "
                   "apart"},
    ForeignOptions{"min-cluster-size min-points min-samples", "--min-size",
                   "did you mean '--min-size', which counts voxels?"},
    ForeignOptions{"distance-threshold ransac-threshold plane-threshold", "--plane-distance"},
    ForeignOptions{"K k camera-matrix camera-intrinsics", "--intrinsics"},
    ForeignOptions{"depth-trunc max-depth", "--max-range"},
    ForeignOptions{"units unit scale", "--depth-scale",
                   "did you mean '--depth-scale', the number of units per metre? It is 1000 for "
                   "millimetres"},
    ForeignOptions{"track tracking", "--stable-labels"},
    ForeignOptions{"supports ground floor", "--surfaces"},
    ForeignOptions{"fx fy cx cy", "--intrinsics", "did you mean '--intrinsics FX,FY,CX,CY'?"},
    ForeignOptions{"n-bins num-bins num-samples resolution", "--grid",
                   "did you mean '--grid N', a number of points?"},
    ForeignOptions{"bandwidth", "--sigma"},
    ForeignOptions{"n-layers num-landscapes", "--layers"},
    ForeignOptions{"metric", "--directions", "did you mean '--distance'?"},
    ForeignOptions{"p", "--order"},
    ForeignOptions{"q internal-p", "--ground"},
    ForeignOptions{"delta e relative-error", "--error"},
    ForeignOptions{"random-state random-seed", "--seed"},
    ForeignOptions{"min-lifetime min-length", "--min-persistence"},
    ForeignOptions{"n-threads num-threads n-jobs jobs j workers", "--threads"},
    ForeignOptions{"max-memory memory", "--memory-limit"},
    ForeignOptions{"v verbosity", "--verbose"},
    ForeignOptions{"output-file outfile out", "--output"},
    ForeignOptions{"input-file input i", "--output", "an input is an argument without an option"},
};

/// True if a list of words, separated by spaces, contains the word.
bool has_word(std::string_view words, std::string_view word) {
  while (!words.empty()) {
    const std::size_t end = std::min(words.find(' '), words.size());
    if (words.substr(0, end) == word) return true;
    words.remove_prefix(std::min(end + 1, words.size()));
  }
  return false;
}

}  // namespace

std::string hint_for_foreign_option(std::string_view typed,
                                    std::span<const std::string_view> known) {
  const std::string_view word = typed.substr(2);
  for (const ForeignOptions& row : kRows) {
    if (!has_word(row.names, word) || std::ranges::find(known, row.option) == known.end()) continue;
    return row.hint.empty() ? fmt::format("did you mean '{}'?", row.option) : std::string(row.hint);
  }
  return {};
}

}  // namespace ph::app
