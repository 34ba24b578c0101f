// SPDX-License-Identifier: MIT
#pragma once
#include <optional>

#include "facade/parts/post.hpp"
#include "ph/parts/image_part.hpp"

namespace ph {

/// Joins the parts of all ranks along a binary tree, in log2 steps. Each rank calls it.
/// @param own part `rank` of the image, or nothing where there are more ranks than parts; those
///        have the highest numbers.
/// @return the whole on rank 0, nothing on the others.
/// @throws Error as ImagePart::join and Post::receive.
std::optional<ImagePart> join_ranks(std::optional<ImagePart> own, Post& post,
                                    const RunContext& context);

}  // namespace ph
