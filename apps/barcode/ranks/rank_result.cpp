// SPDX-License-Identifier: MIT
#include "apps/barcode/ranks/rank_result.hpp"

#include <fmt/format.h>

#include "ph/detail/core/format_size.hpp"

namespace ph::barcode {

std::string kept_path(const Job& job, int rank, int parts) {
  return fmt::format("{}.{}of{}.ph", job.places.output, rank + 1, parts);
}

void explain_costs(const Post& post, app::Session& session) {
  session.explain(fmt::format("memory {}, sent {}",
                              format_size(static_cast<double>(session.memory_taken())),
                              format_size(static_cast<double>(post.bytes_sent()))));
}

}  // namespace ph::barcode
