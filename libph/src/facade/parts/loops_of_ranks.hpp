// SPDX-License-Identifier: MIT
#pragma once
#include <optional>

#include "facade/parts/post.hpp"
#include "ph/parts/image_loops.hpp"

namespace ph {

/// The loops of all ranks, in rounds: each works until it has nothing to do, then all exchange what
/// they have for each other, until nobody has anything. Each rank calls it.
/// @param own of part `rank`, or nothing where there are more ranks than parts. @param parts of the
///        image. @param whole what join_ranks gave rank 0; null on the others.
/// @return the bars of all of them on rank 0, in no order; none on the others.
/// @throws Error as ImageLoops and Post::receive.
Barcode loops_of_ranks(std::optional<ImageLoops> own, int parts, const ImagePart* whole, Post& post,
                       const RunContext& context);

}  // namespace ph
