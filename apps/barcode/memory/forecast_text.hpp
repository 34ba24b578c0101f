// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <string_view>

#include "ph/parts/cloud_part.hpp"
#include "ph/parts/image_part.hpp"

namespace ph::barcode {

/// The output of --dry-run for an image in parts, with one fact per line.
/// @param process the word for processes that compute the parts together and exchange messages, as
/// in Transport. If it is empty, each part is written to a file.
std::string forecast_text(const ImagePartForecast& forecast, const std::string& description,
                          int parts, std::string_view process);

/// Does the same for a point cloud.
std::string forecast_text(const CloudPartForecast& forecast, const std::string& description,
                          int parts, std::string_view process);

/// True if layers should be distributed by their content, because otherwise one rank would take at
/// least twice as long as the mean.
inline bool is_unequal(const ImagePartForecast& forecast) {
  constexpr double most = 2;
  return forecast.longest >= most;
}

}  // namespace ph::barcode
