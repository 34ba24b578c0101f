// SPDX-License-Identifier: MIT
#include "ph/parts/image_part.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>

#include "libph/src/cubical/rounds/part_layout.hpp"
#include "libph/src/cubical/slabs/slabs.hpp"
#include "libph/src/facade/parts/part_state.hpp"
#include "ph/detail/core/file_pages.hpp"
#include "ph/detail/core/fingerprint.hpp"
#include "ph/detail/facade/bar_bytes.hpp"
#include "ph/error.hpp"

namespace ph {
namespace {

using cubical::GridShape;
using cubical::PartLayout;
using cubical::WholeImage;

WholeImage whole_image(const Image& image, int parts, const ImagePartOptions& options) {
  const std::size_t axes = image.extents.size();
  if (!options.cubical.periodic.empty() && options.cubical.periodic.size() > axes)
    throw Error(
        ErrorKind::usage,
        fmt::format("periodic axes: found {}, expected at most {}, the number of axes of the image",
                    options.cubical.periodic.size(), axes));
  std::vector<bool> periodic = options.cubical.periodic;
  periodic.resize(axes, false);
  return {image.extents,
          std::move(periodic),
          image.values.type(),
          options.cubical.construction == CubicalOptions::Construction::vertices,
          options.cubical.superlevel,
          options.cubical.threshold.value_or(std::numeric_limits<double>::max()),
          parts,
          options.min_dim,
          options.max_dim.value_or(static_cast<int>(axes)),
          options.cells,
          false,
          options.first_layers};
}

/// @throws Error (usage) if there are too many axes.
GridShape shape_of(const WholeImage& whole) {
  if (const int axes = GridShape::count_axes(whole.image()); axes > GridShape::kMostAxes)
    throw Error(ErrorKind::usage,
                fmt::format("parts of an image: found {} axes, expected at most {}", axes,
                            GridShape::kMostAxes));
  return GridShape(whole.image());
}

std::uint64_t layers_of(const GridShape& shape) {
  if (shape.top_dim() < 2)
    throw Error(ErrorKind::usage,
                "parts of an image: found one axis or none with more than one voxel, "
                "expected at least two such axes");
  return shape.axis(shape.layer_axis()).extent;
}

/// The lowest min_dim for which the graph of top cells is enough. Each periodic axis with a single
/// voxel raises this dimension by one, because such an axis repeats every bar one dimension higher.
int lowest_of_top_cells(const GridShape& shape) {
  return shape.top_dim() - 1 + static_cast<int>(shape.loop_count());
}

/// The voxels of some layers, and of one more layer on each side where there is one. They are
/// copied only if a periodic axis makes the outer layers wrap around.
Voxels voxels_of(const Image& image, const PartLayout::Layers& layers,
                 const GridShape::Axis& axis) {
  const auto owner = std::make_shared<const Voxels>(image.values);
  const std::size_t layer_size = axis.stride, bytes = bytes_of(owner->type()) * layer_size;
  const auto* const data = static_cast<const std::byte*>(owner->data());
  const bool is_at_begin = layers.begin == 0, is_at_end = layers.end == axis.extent;
  const std::size_t begin = is_at_begin ? 0 : layers.begin - 1;
  const std::size_t end = is_at_end ? layers.end : layers.end + 1;
  if (!axis.periodic || (!is_at_begin && !is_at_end))
    return Voxels(BorrowedVoxels{owner->type(), data + begin * bytes, (end - begin) * layer_size,
                                 owner, owner->is_in_file()});
  return with_voxels(owner->type(), data, [&]<class T>(const T* all) {
    std::vector<T> copy;
    copy.reserve((end - begin + 2) * layer_size);
    const auto append = [&](std::size_t from, std::size_t to) {
      copy.insert(copy.end(), all + from * layer_size, all + to * layer_size);
    };
    if (is_at_begin) append(axis.extent - 1, axis.extent);
    append(begin, end);
    if (is_at_end) append(0, 1);
    return Voxels(std::move(copy));
  });
}

Image image_of(const Image& image, const PartLayout::Layers& layers, const GridShape::Axis& axis) {
  Image part{image.extents, voxels_of(image, layers, axis), image.masked};
  part.extents[static_cast<std::size_t>(axis.of_input)] =
      static_cast<Index>(part.values.size() / axis.stride);
  return part;
}

/// A hash of the voxels. Pages of a file leave memory once they are read.
std::uint64_t fingerprint_of(const Voxels& voxels) {
  constexpr std::size_t block = std::size_t{1} << 24;
  Fingerprint fingerprint;
  std::span<const std::byte> left(static_cast<const std::byte*>(voxels.data()),
                                  voxels.size() * bytes_of(voxels.type()));
  while (!left.empty()) {
    const auto bytes = left.first(std::min(block, left.size()));
    fingerprint.add(bytes);
    if (voxels.is_in_file()) forget_file_pages(bytes.data(), bytes.size());
    left = left.subspan(bytes.size());
  }
  return fingerprint.value();
}

}  // namespace

WholeImage cubical::checked_whole(const Image& image, int parts, const ImagePartOptions& options) {
  if (options.min_dim < 0 || options.max_dim.value_or(0) < 0)
    throw Error(ErrorKind::usage,
                fmt::format("dimensions of an image in parts: found {}, expected >= 0",
                            std::min(options.min_dim, options.max_dim.value_or(0))));
  WholeImage whole = whole_image(image, parts, options);
  const GridShape shape = shape_of(whole);
  const std::uint64_t layers = layers_of(shape);
  if (parts < 1 || static_cast<std::uint64_t>(parts) > layers)
    throw Error(ErrorKind::usage, fmt::format("parts of an image: found {}, expected 1 to {}, the "
                                              "number of layers along its slowest axis",
                                              parts, layers));
  if (!whole.has_layers(shape))
    throw Error(ErrorKind::usage,
                fmt::format("first layers of parts: found {}, expected one for each of {} parts, "
                            "from 0 in ascending order, each below {}",
                            fmt::join(whole.first_layers, ", "), parts, layers));
  whole.loops = wants_loops(shape, whole.wanted());
  const int top = shape.top_dim();
  const int highest = std::min(whole.max_dim, top - 1);
  if (whole.loops && !(options.loops && top == 3))
    throw Error(
        ErrorKind::usage,
        fmt::format(
            "parts of {0}: found a request for {2}, expected dimension 0 alone{3}, "
            "because {1}",
            top == 3 ? "a volume" : fmt::format("an image of {} axes", top),
            top == 3 ? "loops need messages between the parts, as ImageLoops and ph-barcode-mpi "
                       "send them"
                     : fmt::format("dimensions from 1 to {} need all layers at once", top - 2),
            whole.min_dim == highest ? fmt::format("dimension {}", highest)
                                     : fmt::format("dimensions {} to {}", whole.min_dim, highest),
            shape.any_periodic() ? " in an image with a periodic axis"
                                 : fmt::format(", or {} alone", lowest_of_top_cells(shape))));
  const GridShape::Axis& axis = shape.axis(shape.layer_axis());
  if (image.values.size() != axis.extent * axis.stride)
    throw Error(ErrorKind::bad_data,
                fmt::format("image: found {} voxels, expected {}, the product of its extents",
                            image.values.size(), axis.extent * axis.stride));
  return whole;
}

ImagePart::ImagePart(const Image& image, int part, int parts, const ImagePartOptions& options,
                     const RunContext& context) {
  state_ = std::make_unique<State>(cubical::checked_whole(image, parts, options), context);
  if (part < 0 || part >= parts)
    throw Error(ErrorKind::usage,
                fmt::format("part of an image: found part {0} of {1}, expected part 1 to {1}",
                            part + 1, parts));
  const GridShape& shape = state_->shape;
  const GridShape::Axis& axis = shape.axis(shape.layer_axis());
  state_->first = state_->last = part;

  const PartLayout layout = state_->whole.layout(shape);
  CubicalOptions own_options = options.cubical;
  own_options.periodic = state_->whole.periodic;
  own_options.periodic[static_cast<std::size_t>(axis.of_input)] = false;
  const Cubical cubical = [&] {
    const Image own = image_of(image, layout.turned(layout.own(part)), axis);
    state_->fingerprint = fingerprint_of(own.values);
    return Cubical(own, own_options, context);
  }();
  const CubicalImage voxels = cubical.cubical_image();
  if (!cubical::LayeredImage::can_cut(voxels))
    throw Error(ErrorKind::resource,
                fmt::format("part of an image: found layers of {} voxels, expected at most about "
                            "2^29",
                            axis.stride));
  if (state_->whole.loops && !cubical::GridFrame::can_hold(voxels))
    throw Error(ErrorKind::resource,
                fmt::format("part of an image: found {} voxels, expected fewer than about 2^31 for "
                            "loops; use more parts, which are smaller",
                            voxels.size()));
  const cubical::BarSink sink = state_->sink(state_->bars);
  cubical::PairSink pairs(shape, options.cells, sink);
  if (state_->whole.loops) {
    // Loops need the lower stars of all voxels of the part at once. These stars are therefore
    // computed once and used for all bars.
    auto& own = state_->own.emplace(cubical, layout, part, context);
    state_->pairs.add(own.stars, layout.first_voxel(part), pairs, &own.free);
  } else {
    const cubical::LayeredImage layers(voxels);
    cubical::Slabs slabs(layers, cubical::Slabs::layers_that_fit(layers, context), context,
                         layout.place(part), layout.first_voxel(part));
    for (std::uint64_t slab = 0; slab < slabs.count(); ++slab) {
      context.report({"slabs", slab, slabs.count()});
      if (shape.top_dim() <= 3)
        state_->pairs.add(slabs.stars(slab), slabs.first_voxel(slab), pairs);
      else
        state_->pairs.add(slabs.grid<cubical::LayerGrid>(slab), slabs.first_voxel(slab), pairs);
      slabs.forget(slab);
      state_->claim.grow_to(state_->bars.bytes());
    }
  }
  state_->claim.grow_to(state_->bars.bytes());
  pairs.finish();
}

ImagePart::ImagePart(std::unique_ptr<State> state) : state_(std::move(state)) {}
ImagePart::ImagePart(ImagePart&&) noexcept = default;
ImagePart& ImagePart::operator=(ImagePart&&) noexcept = default;
ImagePart::~ImagePart() = default;

int ImagePart::most_parts(const Image& image, const CubicalOptions& options) {
  const std::uint64_t layers = layers_of(shape_of(whole_image(image, 1, {.cubical = options})));
  return static_cast<int>(std::min<std::uint64_t>(layers, std::numeric_limits<int>::max()));
}

int ImagePart::first() const { return state_->first; }
int ImagePart::last() const { return state_->last; }
int ImagePart::parts() const { return state_->whole.parts; }
const std::vector<Index>& ImagePart::extents() const { return state_->whole.extents; }
VoxelType ImagePart::type() const { return state_->whole.type; }
const ImagePartOptions& ImagePart::options() const { return state_->options; }
bool ImagePart::is_of(const Image& image, int part, int parts,
                      const ImagePartOptions& options) const {
  WholeImage whole = whole_image(image, parts, options);
  whole.loops = options.loops && cubical::wants_loops(state_->shape, whole.wanted());
  if (first() != part || last() != part || state_->whole != whole) return false;
  const GridShape& shape = state_->shape;
  const PartLayout layout = whole.layout(shape);
  const Image own =
      image_of(image, layout.turned(layout.own(part)), shape.axis(shape.layer_axis()));
  return fingerprint_of(own.values) == state_->fingerprint;  // mutant: part-voxels
}

void ImagePart::join(ImagePart next, const RunContext& context) {
  if (next.state_->whole != state_->whole)
    throw Error(
        ErrorKind::bad_data,
        "parts of images: found parts that differ in extents, type, options or number of parts, "
        "expected parts of one image");
  if (next.first() != last() + 1)
    throw Error(ErrorKind::bad_data,
                fmt::format("parts of an image: found part {} after part {}, expected part {}",
                            next.first() + 1, last() + 1, last() + 2));
  context.poll();
  // In the T-construction, the order of the parts is reversed: the next part comes before this
  // part.
  const bool come_before = state_->shape.is_t_construction();  // mutant: part-turned
  const cubical::BarSink sink = state_->sink(state_->bars);
  cubical::PairSink pairs(state_->shape, state_->whole.cells, sink);
  state_->pairs.join(std::move(next.state_->pairs), come_before, pairs,
                     state_->whole.loops ? &state_->freed : nullptr);
  pairs.finish();
  state_->freed.add(next.state_->freed);
  state_->own.reset();
  add_bars(state_->bars, next.state_->bars);
  state_->claim.grow_to(state_->bars.bytes());
  state_->last = next.last();
  state_->fingerprint = 0;
}

Barcode ImagePart::barcode(const RunContext& context) const {
  Barcode all = state_->bars;
  const cubical::BarSink sink = state_->sink(all);
  cubical::PairSink pairs(state_->shape, state_->whole.cells, sink);
  state_->pairs.finish(pairs);
  pairs.finish();
  all.sort(context);
  all.set_info(state_->whole.info());
  return all;
}

}  // namespace ph
