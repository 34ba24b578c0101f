// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "ph/detail/facade/post.hpp"
#include "ph/parts/image_loops.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// Parts that ranks can join: ImagePart, CloudPart.
template <class P>
concept JoinablePart = std::movable<P> &&
    requires(P part, std::span<const std::byte> bytes, const RunContext& run) {
  { part.parts() } -> std::same_as<int>;
  { part.bytes() } -> std::same_as<std::vector<std::byte>>;
  { P::of_bytes(bytes, run) } -> std::same_as<P>;
  part.join(std::move(part), run);
};

/// Joins the parts of all ranks along a binary tree, in log2(parts) steps, rounded up. Every rank
/// must call it.
/// @param own part `rank` of the whole, or nothing if there are more ranks than parts; the ranks
///        without a part have the highest numbers.
/// @return the whole on rank 0, nothing on the others.
/// @throws Error as the part's join and Post::receive.
template <JoinablePart Part>
std::optional<Part> join_ranks(std::optional<Part> own, Post& post, const RunContext& context) {
  if (!own) return std::nullopt;
  const int rank = post.rank(), parts = own->parts();
  // Before a step of this width, each remaining rank has at most `width` parts, starting with its
  // own.
  for (int width = 1; width < parts; width *= 2) {
    if (rank % (2 * width) == width) {
      post.send(rank - width, own->bytes());
      return std::nullopt;
    }
    if (rank + width < parts) {  // mutant: join-odd
      const std::vector<std::byte> bytes = post.receive(rank + width);
      own->join(Part::of_bytes(bytes, context), context);
    }
  }
  return own;
}

/// Computes the loops of all ranks in rounds. In a round, each rank works until it has nothing to
/// do, and then all ranks exchange messages. The rounds end when no rank has messages left. Every
/// rank must call it.
/// @param own part `rank`, or nothing if there are more ranks than parts. @param parts the number
///        of parts of the image. @param whole the result of join_ranks on rank 0; null on the
///        others.
/// @return the bars of all ranks on rank 0, in no particular order; none on the others.
/// @throws Error as ImageLoops and Post::receive.
Barcode loops_of_ranks(std::optional<ImageLoops> own, int parts, const ImagePart* whole, Post& post,
                       const RunContext& context);

}  // namespace ph
