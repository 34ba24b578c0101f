// SPDX-License-Identifier: MIT
#pragma once
#include <optional>

#include "facade/parts/post.hpp"
#include "ph/parts/image_loops.hpp"

namespace ph {

/// Computes the loops of all ranks in rounds: each rank works until it has nothing to do, then all
/// exchange messages, until no rank has any. Every rank must call it.
/// @param own part `rank`, or nothing if there are more ranks than parts. @param parts of the
///        image. @param whole the result of join_ranks on rank 0; null on the others.
/// @return the bars of all ranks on rank 0, in no particular order; none on the others.
/// @throws Error as ImageLoops and Post::receive.
Barcode loops_of_ranks(std::optional<ImageLoops> own, int parts, const ImagePart* whole, Post& post,
                       const RunContext& context);

}  // namespace ph
