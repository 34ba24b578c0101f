// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <string_view>

#include "ph/parts/cloud_part.hpp"
#include "ph/parts/image_part.hpp"

namespace ph::barcode {

/// What --dry-run says of an image in parts: one fact a line.
/// @param process the word for those that compute the parts together and send each other what is
/// known, as Transport has it; empty: each part is a file.
std::string forecast_text(const ImagePartForecast& forecast, const std::string& description,
                          int parts, std::string_view process);

/// The same of a point cloud.
std::string forecast_text(const CloudPartForecast& forecast, const std::string& description,
                          int parts, std::string_view process);

/// Whether layers are to be shared out by what is in them: else a rank would take twice the mean.
inline bool is_unequal(const ImagePartForecast& forecast) {
  constexpr double most = 2;
  return forecast.longest >= most;
}

}  // namespace ph::barcode
