// SPDX-License-Identifier: MIT
// Corrects the checksums of a PNG before it is read. Otherwise the checksums would stop nearly
// every change before it reaches a decoder.
#include <vector>

#include "libph/src/io/bytes/unpack.hpp"
#include "ph/io/cloud.hpp"
#include "tests/fuzz/round_trip.hpp"
#include "tests/fuzz/targets.hpp"
#include "tests/fuzz/violation.hpp"

namespace ph::fuzz {
namespace {

std::size_t big_endian(std::string_view bytes, std::size_t at) {
  return load<std::uint32_t>(reinterpret_cast<const std::byte*>(bytes.data() + at),
                             std::endian::big);
}

/// The first channel of a picture.
Image grey_of(const Raster& raster) {
  std::vector<std::uint16_t> grey;
  for (std::size_t i = 0; i < raster.samples.size(); i += static_cast<std::size_t>(raster.channels))
    grey.push_back(raster.samples[i]);
  return {{raster.height, raster.width}, std::move(grey)};
}

/// The bytes with the right checksum for every chunk.
std::string with_right_checksums(std::string_view bytes) {
  constexpr std::size_t kSignature = 8, kLength = 4, kKind = 4, kSum = 4;
  std::string repaired(bytes);
  for (std::size_t at = kSignature; at + kLength + kKind + kSum <= bytes.size();) {
    const std::size_t covered = kKind + big_endian(bytes, at);
    if (covered > bytes.size() - at - kLength - kSum) break;
    const std::uint32_t sum = detail::checksum(bytes.substr(at + kLength, covered));
    at += kLength + covered;
    for (int shift = 24; shift >= 0; shift -= 8)
      repaired[at++] = static_cast<char>(sum >> shift & 0xFF);
  }
  return repaired;
}

}  // namespace

void run_png(std::string_view bytes) {
  run_reader("png", bytes);
  const std::string repaired = with_right_checksums(bytes);
  run_reader("png", repaired);
  run_reader("image", repaired);
  RunContext context;
  context.memory.set_limit(std::size_t{64} << 20);
  try {
    const Input input = Input::hold({repaired.begin(), repaired.end()}, "input.png", &context);
    const Raster raster = read_png(input);
    const Cloud cloud =
        cloud_from_depth(grey_of(raster), raster, {{.fx = 2, .fy = 2, .cx = 1, .cy = 1}});
    require(cloud.width == raster.width && cloud.height == raster.height,
            "a pixel is no point of the cloud");
    static_cast<void>(content_of(cloud));
  } catch (const Error& error) {
    const bool kind = error.kind() == ErrorKind::bad_data || error.kind() == ErrorKind::resource;
    require(kind, "a depth image is neither taken nor bad");
  }
}

}  // namespace ph::fuzz
