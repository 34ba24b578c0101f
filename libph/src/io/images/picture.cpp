// SPDX-License-Identifier: MIT
// Makes one number per pixel from a PNG, whose pixels may have up to four numbers.
#include <fmt/format.h>

#include <array>

#include "libph/src/io/bytes/readers.hpp"
#include "ph/detail/io/png.hpp"

namespace ph::detail {
namespace {

constexpr std::array<std::string_view, 5> kKinds{"", "grey", "grey + alpha", "RGB", "RGB + alpha"};

// Computes luma as in ITU-R BT.601. It is rounded to the nearest integer, and halves are rounded
// up.
std::uint16_t luma(const std::uint16_t* pixel) {
  // mutant: picture-luma
  return static_cast<std::uint16_t>((299U * pixel[0] + 587U * pixel[1] + 114U * pixel[2] + 500U) /
                                    1000U);
}

// True if all pixels are grey and opaque, so that colours and opacity add nothing.
bool is_grey(const Raster& raster) {
  const auto channels = static_cast<std::size_t>(raster.channels);
  const bool has_alpha = channels % 2 == 0;
  const auto opaque = static_cast<std::uint16_t>((1U << raster.bits) - 1U);
  for (std::size_t at = 0; at < raster.samples.size(); at += channels) {
    const std::uint16_t* const pixel = raster.samples.data() + at;
    if (has_alpha && pixel[channels - 1] != opaque) return false;
    if (channels >= 3 && (pixel[0] != pixel[1] || pixel[0] != pixel[2])) return false;
  }
  return true;
}

// The position of a channel among the samples of a pixel. Returns nothing if the grey value is
// computed from three samples.
std::optional<std::size_t> place_of(Channel channel, const Raster& raster, const Input& input) {
  const auto channels = static_cast<std::size_t>(raster.channels);
  const bool has_colours = channels >= 3, has_alpha = channels % 2 == 0;
  switch (channel) {
    case Channel::automatic:
    case Channel::grey:
      if (has_colours) return std::nullopt;
      return 0;
    case Channel::alpha:
      if (has_alpha) return channels - 1;
      break;
    default:
      if (has_colours)
        return static_cast<std::size_t>(channel) - static_cast<std::size_t>(Channel::red);
  }
  refuse_channel(channel, kKinds[channels], input);
}

}  // namespace

void refuse_channel(Channel channel, std::string_view kind, const Input& input) {
  input.fail({fmt::format("no channel {}", name_of(channel)),
              std::string(kind),
              "a picture that has it",
              {}});
}

Image read_png_image(const Input& input, const ReadOptions& options) {
  return image_of(read_png(input), input, options);
}

Image image_of(Raster raster, const Input& input, const ReadOptions& options) {
  const std::vector<Index> extents{raster.height, raster.width};
  const auto channels = static_cast<std::size_t>(raster.channels);
  const std::size_t count = raster.samples.size() / channels;
  std::optional<std::size_t> place = place_of(options.channel, raster, input);
  if (options.channel == Channel::automatic && channels > 1) {
    if (!is_grey(raster)) {  // mutant: picture-grey
      input.fail({"not a grey picture", fmt::format("{} channels, {}", channels, kKinds[channels]),
                  "1",
                  mark(Setting::channel, channels == 2   ? "grey|alpha"
                                         : channels == 4 ? "grey|red|green|blue|alpha"
                                                         : "grey|red|green|blue") +
                      " takes one"});
    }
    place = 0;
    note(options, fmt::format("{} channels ({}) that hold only grey: read as grey", channels,
                              kKinds[channels]));
  }
  if (raster.bits > 8 && channels == 1) return {extents, std::move(raster.samples)};
  const auto pick = [&](auto& values) {
    input.require_memory(count * sizeof(values[0]));
    values.resize(count);
    for (std::size_t k = 0; k < count; ++k) {
      const std::uint16_t* const pixel = raster.samples.data() + k * channels;
      values[k] =
          static_cast<std::decay_t<decltype(values[0])>>(place ? pixel[*place] : luma(pixel));
    }
  };
  if (raster.bits > 8) {
    std::vector<std::uint16_t> words;
    pick(words);
    return {extents, std::move(words)};
  }
  std::vector<std::uint8_t> bytes;
  pick(bytes);
  return {extents, std::move(bytes)};
}

}  // namespace ph::detail
