// SPDX-License-Identifier: MIT
#include "vectorise/arguments/option_scopes.hpp"

#include <array>

namespace ph::vectorise {
namespace {

using app::OptionScope;
using app::Situations;

constexpr Situations of(std::initializer_list<Kind> kinds) {
  Situations all = kFitting | kOfBarcode | kOfImage;
  for (const Kind kind : kinds) all |= situation_of(kind);
  return all;
}
constexpr Situations kAllKinds = 0xFFFFF,
                     kImagesOnly = situation_of(Kind::euler) | kFitting | kFitted | kOfImage;

constexpr std::array kScopes{
    OptionScope{"format", situation_of(Kind::euler) | kFitting | kFitted | kOfBarcode | kOfImage,
                "--kind euler"},
    OptionScope{"nan", kImagesOnly, "images with --kind euler"},
    OptionScope{"construction", kImagesOnly & ~kFitted, "images with --kind euler"},
    OptionScope{"superlevel", kImagesOnly & ~kFitted, "images with --kind euler"},
    OptionScope{"periodic", kImagesOnly & ~kFitted, "images with --kind euler"},
    OptionScope{"kind", kAllKinds | kFitting | kOfBarcode | kOfImage, "what is not fitted yet"},
    OptionScope{"dims", (kAllKinds & ~situation_of(Kind::euler)) | kFitting | kOfBarcode,
                "vectors of single dimensions that are not fitted yet"},
    OptionScope{"infinite", kAllKinds | kFitting | kOfBarcode, "barcodes that are not fitted yet"},
    OptionScope{"grid",
                of({Kind::betti, Kind::landscape, Kind::silhouette, Kind::life_entropy, Kind::image,
                    Kind::euler}),
                "curves, landscapes and images that are not fitted yet"},
    OptionScope{"length-grid", of({Kind::image}), "--kind image"},
    OptionScope{"layers", of({Kind::landscape}), "--kind landscape"},
    OptionScope{"count", of({Kind::lengths, Kind::atol}), "--kind lengths and atol"},
    OptionScope{"sigma", of({Kind::image}), "--kind image"},
    OptionScope{"power", of({Kind::image, Kind::silhouette}), "--kind image and silhouette"},
    OptionScope{"normalised", of({Kind::entropy}), "--kind entropy"},
    OptionScope{"contrast", of({Kind::atol}), "--kind atol"},
    OptionScope{"seed", of({Kind::atol}), "--kind atol"},
    OptionScope{"fit", kAllKinds | kFitting | kOfBarcode | kOfImage, "what is not fitted yet"},
};

}  // namespace

std::span<const OptionScope> option_scopes() { return kScopes; }

}  // namespace ph::vectorise
