// SPDX-License-Identifier: MIT
#include "facade/parts/join_ranks.hpp"

namespace ph {

std::optional<ImagePart> join_ranks(std::optional<ImagePart> own, Post& post,
                                    const RunContext& context) {
  if (!own) return std::nullopt;
  const int rank = post.rank(), parts = own->parts();
  // Before a step of that width a rank has the parts from its own on, so many.
  for (int width = 1; width < parts; width *= 2) {
    if (rank % (2 * width) == width) {
      post.send(rank - width, own->bytes());
      return std::nullopt;
    }
    if (rank + width < parts) {
      const std::vector<std::byte> bytes = post.receive(rank + width);
      own->join(ImagePart::of_bytes(bytes, context), context);
    }
  }
  return own;
}

}  // namespace ph
