// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "ph/detail/io/reader.hpp"
#include "ph/filtration.hpp"

namespace ph {

/// A picture: `channels` samples per pixel (1 grey, 2 grey + alpha, 3 RGB, 4 RGBA), row by row from
/// the top. Each sample is 0 … 2^bits - 1.
struct Raster {
  Index width = 0;
  Index height = 0;
  int channels = 1;
  int bits = 8;                        ///< 8 or 16; images with fewer bits are expanded to 8
  std::vector<std::uint16_t> samples;  ///< width * height * channels
  std::string name = "image";          ///< printable name of the file, for messages
  /// Resolution to write into the file, for printing; 0 if none.
  double dots_per_inch = 0;

  /// @throws Error (bad_data) unless the number of samples matches the pixels and channels.
  void check() const;
  std::uint16_t at(Index x, Index y, int channel = 0) const {
    return samples[static_cast<std::size_t>((y * width + x) * channels + channel)];
  }
};

/// Reads a PNG of at most 65,535 x 65,535 pixels; palettes become RGB(A). Gamma is not applied.
/// @throws Error (bad_data) if the file is damaged, truncated or claims more pixels than its bytes
/// can hold; Error (no_input).
Raster read_png(const Input& input);
Raster read_png(const std::filesystem::path& path, const RunContext* context = nullptr);

/// Writes 8 or 16 bits per sample, as the raster states. @throws Error (bad_data) if the number of
/// samples does not match the size; Error (io) if the stream fails.
void write_png(std::ostream& out, const Raster& raster);

}  // namespace ph
