// SPDX-License-Identifier: MIT
#pragma once
#include <initializer_list>

#include "apps/common/arguments/option_scope.hpp"
#include "apps/vectorise/fit/fit.hpp"

namespace ph::vectorise {

/// The bit for a kind of vectors.
constexpr app::Situations situation_of(Kind kind) { return 1U << static_cast<unsigned>(kind); }
/// The situations other than the kind of vectors: parameters are fitted now, or were fitted before;
/// an input is a barcode or an image.
inline constexpr app::Situations kFitting = 1U << 20, kFitted = 1U << 21, kOfBarcode = 1U << 22,
                                 kOfImage = 1U << 23;

/// The situations in which vectors of these kinds are fitted now.
constexpr app::Situations of(std::initializer_list<Kind> kinds) {
  app::Situations all = kFitting | kOfBarcode | kOfImage;
  for (const Kind kind : kinds) all |= situation_of(kind);
  return all;
}
inline constexpr app::Situations kAllKinds = 0xFFFFF;

constexpr app::Scope kOfImages{situation_of(Kind::euler) | kFitting | kFitted | kOfImage,
                               "images with --kind euler"};
constexpr app::Scope kOfNewImages{kOfImages.where & ~kFitted, kOfImages.meant_for};
constexpr app::Scope kNotFitted{kAllKinds | kFitting | kOfBarcode | kOfImage,
                                "vectors that are not fitted yet"};
constexpr app::Scope kOfPersistenceImages{of({Kind::image}), "--kind image"};
constexpr app::Scope kOfAtol{of({Kind::atol}), "--kind atol"};

}  // namespace ph::vectorise
