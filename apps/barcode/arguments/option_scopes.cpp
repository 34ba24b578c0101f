// SPDX-License-Identifier: MIT
#include "barcode/arguments/option_scopes.hpp"

#include <array>
#include <bit>

namespace ph::barcode {
namespace {

using app::OptionScope;

constexpr app::Situations kAllPairs = kPoints | kMatrix | kTriangle, kRips = kAllPairs | kSomePairs,
                          kCubical = kImage | kVoxels,
                          kListed = kSimplices | kLowerStar | kBoundary | kMesh,
                          kComputed = kRips | kCubical | kListed | kOwn | kAlpha;

constexpr app::Situations kSomeLayers = kImagePart | kRanks;

constexpr std::string_view kOfRips = "Rips complexes of points and distances";
constexpr std::string_view kOfAllPairs = "points and distance matrices";
constexpr std::string_view kOfMatrices = "full distance matrices (--format distance)";
constexpr std::string_view kOfDistances = "distances (--format distance)";
constexpr std::string_view kOfAlpha = "points with --complex alpha";
constexpr std::string_view kOfInputs = "a computation";

constexpr std::array kScopes{
    OptionScope{"format", kComputed | kSomeLayers | kSomeBlocks, kOfInputs},
    OptionScope{"values", kComputed, kOfInputs},  // the readers know better
    OptionScope{"allow-empty", kComputed, kOfInputs},
    OptionScope{"symmetrise", kMatrix, kOfMatrices},
    OptionScope{"from-correlation", kMatrix | kTriangle | kSomePairs, kOfDistances},
    OptionScope{"diagonal", kMatrix, kOfMatrices},
    OptionScope{"nan", kRips | kCubical | kOwn | kAlpha | kSomeLayers | kSomeBlocks,
                "points, distances and images"},
    OptionScope{"raw-shape", kImage | kSomeLayers, "images"},
    OptionScope{"raw-type", kImage | kSomeLayers, "images"},
    OptionScope{"raw-big-endian", kImage | kSomeLayers, "images"},
    OptionScope{"raw-skip", kImage | kSomeLayers, "images"},
    OptionScope{"columns", kComputed | kSomeBlocks, kOfInputs},  // the readers know better
    OptionScope{"channel", kComputed | kSomeLayers, kOfInputs},
    OptionScope{"loops", kComputed, kOfInputs},
    OptionScope{"complex", kComputed | kSomeLayers | kSomeBlocks, kOfInputs},
    OptionScope{"threshold", kComputed | kSomeLayers | kSomeBlocks, kOfInputs},
    OptionScope{"delay", kPoints | kAlpha | kOwn, "Rips and alpha complexes of time series"},
    OptionScope{"metric", kPoints | kSomeBlocks, "Rips complexes of points"},
    OptionScope{"construction", kCubical | kSomeLayers, "images"},
    OptionScope{"superlevel", kCubical | kSomeLayers, "images"},
    OptionScope{"periodic", kCubical | kSomeLayers, "images"},
    OptionScope{"slab-layers", kCubical | kSomeLayers, "images"},
    OptionScope{"voxel", kVoxels, "points with --complex cubical"},
    OptionScope{"voxel-value", kVoxels, "points with --complex cubical"},
    OptionScope{"collapse", kRips, kOfRips},
    OptionScope{"device", kPoints, "Rips complexes of points"},
    OptionScope{"subsample", kAllPairs, kOfAllPairs},
    OptionScope{"subsample-radius", kAllPairs, kOfAllPairs},
    OptionScope{"approximate", kAllPairs, kOfAllPairs},
    OptionScope{"vertex-weights", kRips, kOfRips},
    OptionScope{"dtm", kAllPairs, kOfAllPairs},
    OptionScope{"weight-exponent", kRips, kOfRips},
    OptionScope{"alpha-values", kAlpha, kOfAlpha},
    OptionScope{"weights", kAlpha, kOfAlpha},
    OptionScope{"period", kAlpha, kOfAlpha},
    OptionScope{"alpha-shape", kAlpha, kOfAlpha},
    OptionScope{"wrap", kAlpha, kOfAlpha},
    OptionScope{"max-dim", kComputed | kSomeLayers | kSomeBlocks, kOfInputs},
    OptionScope{"min-dim", kComputed | kSomeLayers, kOfInputs},
    OptionScope{"field", kComputed | kRanks, kOfInputs},
    OptionScope{"engine", kComputed, kOfInputs},
    OptionScope{"check", kComputed, kOfInputs},
    OptionScope{"min-persistence", kComputed | kParts | kRanks | kCloudRanks, kOfInputs},
    OptionScope{"representatives", kComputed, kOfInputs},
    OptionScope{"significance", kAllPairs | kSomePairs | kAlpha,
                "Rips and alpha complexes of points and distances"},
    OptionScope{"dry-run", kComputed | kSomeLayers | kCloudPart | kCloudRanks, kOfInputs},
    OptionScope{"plot", kComputed | kBarcode | kParts | kRanks | kCloudRanks, "one barcode"},
    OptionScope{"plot-kind", kComputed | kBarcode | kParts | kRanks | kCloudRanks, "one barcode"},
    OptionScope{"dims", kComputed | kBarcode | kParts | kRanks | kCloudRanks, "one barcode"},
    OptionScope{"title", kComputed | kBarcode | kParts | kRanks | kCloudRanks, "one barcode"},
    OptionScope{"size", kComputed | kBarcode | kParts | kRanks | kCloudRanks, "one barcode"},
    OptionScope{"axis", kComputed | kBarcode | kParts | kRanks | kCloudRanks, "one barcode"},
};

}  // namespace

std::span<const OptionScope> option_scopes() { return kScopes; }

std::string_view name_of(Situation situation) {
  constexpr std::array<std::string_view, 19> kNames{"points",
                                                    "a full distance matrix",
                                                    "a triangle without its diagonal",
                                                    "some distances only",
                                                    "an image",
                                                    "points with --complex cubical",
                                                    "simplices",
                                                    "simplices with --complex lower-star",
                                                    "a boundary matrix",
                                                    "a mesh with values",
                                                    "points with another complex",
                                                    "a barcode",
                                                    "two barcodes to compare",
                                                    "points with --complex alpha",
                                                    "a part of an image (--part)",
                                                    "parts to join (--join)",
                                                    "an image on several processes",
                                                    "a part of a cloud (--part)",
                                                    "points on several processes"};
  return kNames[static_cast<std::size_t>(std::countr_zero(app::Situations{situation}))];
}

}  // namespace ph::barcode
