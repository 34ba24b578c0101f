// SPDX-License-Identifier: MIT
#include "ph/parts/image_part.hpp"

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "cubical/rounds/part_layout.hpp"
#include "cubical/slabs/slabs.hpp"
#include "facade/parts/part_state.hpp"
#include "ph/error.hpp"

namespace ph {
namespace {

using cubical::GridFrame;
using cubical::GridShape;
using cubical::WholeImage;

WholeImage whole_image(const Image& image, int parts, const ImagePartOptions& options) {
  const std::size_t axes = image.extents.size();
  if (!options.cubical.periodic.empty() && options.cubical.periodic.size() > axes)
    throw Error(ErrorKind::usage, fmt::format("periodic axes: found {}, the image has {} axes",
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
          false};
}

void check(const WholeImage& whole, const GridShape& shape, int part, bool may_have_loops) {
  if (shape.top_dim() < 2)
    throw Error(ErrorKind::usage,
                "parts of an image: found one axis or none with more than one "
                "voxel, expected two or three");
  const auto layers = shape.axis(shape.layer_axis()).extent;
  if (whole.parts < 1 || static_cast<std::uint64_t>(whole.parts) > layers)
    throw Error(ErrorKind::usage, fmt::format("parts of an image: found {}, expected 1 to {}, the "
                                              "layers of its slowest axis",
                                              whole.parts, layers));
  if (part < 0 || part >= whole.parts)
    throw Error(ErrorKind::usage,
                fmt::format("part of an image: found number {} of {}", part + 1, whole.parts));
  if (whole.loops && !may_have_loops)
    throw Error(ErrorKind::usage,
                "parts of a volume: found bars of dimension 1 wanted, which joined parts do not "
                "tell; expected max_dim 0, min_dim 2, or option loops and ImageLoops");
}

/// Some layers of the slowest axis with those beside them.
struct Layers {
  std::size_t begin, end;
  bool has_before, has_after;
};

/// Voxels of layers, copied only where a periodic axis begins again.
Voxels voxels_of(const Image& image, const Layers& layers, std::size_t depth,
                 std::size_t layer_size) {
  const auto owner = std::make_shared<const Voxels>(image.values);
  const std::size_t bytes = bytes_of(owner->type()) * layer_size;
  const auto* const data = static_cast<const std::byte*>(owner->data());
  const std::size_t count =
      layers.end - layers.begin + (layers.has_before ? 1 : 0) + (layers.has_after ? 1 : 0);
  const bool wraps_before = layers.has_before && layers.begin == 0;
  const bool wraps_after = layers.has_after && layers.end == depth;
  if (!wraps_before && !wraps_after)
    return Voxels(BorrowedVoxels{owner->type(),
                                 data + (layers.begin - (layers.has_before ? 1 : 0)) * bytes,
                                 count * layer_size, owner, owner->is_in_file()});
  return with_voxels(owner->type(), data, [&]<class T>(const T* all) {
    std::vector<T> copy;
    copy.reserve(count * layer_size);
    const auto append = [&](std::size_t from, std::size_t to) {
      copy.insert(copy.end(), all + from * layer_size, all + to * layer_size);
    };
    if (layers.has_before)
      append(wraps_before ? depth - 1 : layers.begin - 1, wraps_before ? depth : layers.begin);
    append(layers.begin, layers.end);
    if (layers.has_after) append(wraps_after ? 0 : layers.end, wraps_after ? 1 : layers.end + 1);
    return Voxels(std::move(copy));
  });
}

}  // namespace

ImagePart::ImagePart(const Image& image, int part, int parts, const ImagePartOptions& options,
                     const RunContext& context) {
  WholeImage whole = whole_image(image, parts, options);
  if (GridShape::count_axes(whole.image()) > 3)
    throw Error(ErrorKind::usage,
                "parts of an image: found more than three axes with more than "
                "one voxel, expected two or three");
  whole.loops = cubical::wants_loops(GridShape(whole.image()), whole.wanted());
  state_ = std::make_unique<State>(std::move(whole), context);
  const GridShape& shape = state_->shape;
  check(state_->whole, shape, part, options.loops);
  state_->first = state_->last = part;

  const GridShape::Axis& axis = shape.axis(shape.layer_axis());
  if (image.values.size() != axis.extent * axis.stride)
    throw Error(ErrorKind::bad_data, fmt::format("image: found {} voxels, its extents say {}",
                                                 image.values.size(), axis.extent * axis.stride));
  const cubical::PartLayout layout(shape, parts);
  Layers layers{layout.first_layer(part), layout.end_layer(part), false, false};
  layers.has_before = axis.periodic || part > 0;
  layers.has_after = axis.periodic || part + 1 < parts;
  Image own{image.extents, voxels_of(image, layers, axis.extent, axis.stride), image.masked};
  CubicalOptions own_options = options.cubical;
  own_options.periodic = state_->whole.periodic;
  const auto k = static_cast<std::size_t>(axis.of_input);
  own_options.periodic[k] = false;
  own.extents[k] = static_cast<Index>(own.values.size() / axis.stride);
  const Cubical cubical(own, own_options, context);
  const CubicalImage voxels = cubical.cubical_image();
  if (!GridFrame::can_hold(voxels))
    throw Error(ErrorKind::resource, fmt::format("part of an image: found {} voxels, expected "
                                                 "fewer than about 2^31; more parts have fewer",
                                                 voxels.size()));
  const GridFrame frame(voxels);

  cubical::SlabPlace place = layout.place(part);
  cubical::Slabs slabs(frame, cubical::Slabs::layers_that_fit(frame, context), context, place,
                       layout.first_with_ghosts(part));
  if (state_->whole.loops) {
    place.cube_pairs = slabs.cube_pairs();
    state_->own.emplace(cubical, std::move(place), cubical::FreeCells(&context.memory));
  }
  cubical::FreeCells* const free = state_->own ? &state_->own->free : nullptr;
  const cubical::BarSink sink = state_->sink(state_->bars);
  cubical::PairSink pairs(shape, options.cells, sink);
  for (std::uint32_t slab = 0; slab < slabs.count(); ++slab) {
    context.report({"slabs", slab, slabs.count()});
    {
      const cubical::StarGrid grid = slabs.stars(slab);
      state_->pairs.add(grid, slabs.first_voxel(slab), pairs, free);
    }
    slabs.forget(slab);
    state_->claim.grow_to(state_->bars.bytes());
  }
  pairs.finish();
}

ImagePart::ImagePart(std::unique_ptr<State> state) : state_(std::move(state)) {}
ImagePart::ImagePart(ImagePart&&) noexcept = default;
ImagePart& ImagePart::operator=(ImagePart&&) noexcept = default;
ImagePart::~ImagePart() = default;

int ImagePart::first() const { return state_->first; }
int ImagePart::last() const { return state_->last; }
int ImagePart::parts() const { return state_->whole.parts; }

void ImagePart::join(ImagePart next, const RunContext& context) {
  if (next.state_->whole != state_->whole)
    throw Error(ErrorKind::bad_data,
                "parts of images: found other extents, types or options, expected parts of one");
  if (next.first() != last() + 1)
    throw Error(ErrorKind::bad_data,
                fmt::format("parts of an image: found part {} behind part {}, expected part {}",
                            next.first() + 1, last() + 1, last() + 2));
  context.poll();
  // The T-construction is seen from the other end.
  const bool come_before = state_->shape.is_t_construction();
  const cubical::BarSink sink = state_->sink(state_->bars);
  cubical::PairSink pairs(state_->shape, state_->whole.cells, sink);
  state_->pairs.join(std::move(next.state_->pairs), come_before, pairs,
                     state_->whole.loops ? &state_->freed : nullptr);
  pairs.finish();
  state_->freed.add(next.state_->freed);
  state_->own.reset();
  const Barcode& bars = next.state_->bars;
  for (std::size_t i = 0; i < bars.size(); ++i) {
    const auto death = bars.death_cell(i);
    state_->bars.add(bars[i], bars.birth_cell(i).numbers,
                     death ? death->numbers : std::span<const Index>());
  }
  state_->claim.grow_to(state_->bars.bytes());
  state_->last = next.last();
}

Barcode ImagePart::barcode(const RunContext& context) const {
  Barcode all = state_->bars;
  const cubical::BarSink sink = state_->sink(all);
  cubical::PairSink pairs(state_->shape, state_->whole.cells, sink);
  state_->pairs.finish(pairs);
  pairs.finish();
  all.sort(context);
  return all;
}

}  // namespace ph
