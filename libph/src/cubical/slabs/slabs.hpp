// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory_resource>
#include <optional>
#include <utility>
#include <vector>

#include "libph/src/cubical/slabs/layered_image.hpp"
#include "libph/src/cubical/stars/star_grid.hpp"
#include "ph/detail/core/file_pages.hpp"

namespace ph::cubical {

/// A grid, or a range of its layers, cut into slabs with the same number of layers. The last slab
/// may have fewer layers. If the slowest axis of an entire grid is periodic, the slabs form a ring.
/// A ring has at least two slabs, and its first slab and its last slab are also neighbours.
class Slabs {
 public:
  /// The number of layers of a slab. The context may specify it. Otherwise a slab occupies at most
  /// a quarter of the remaining memory, whatever the values of its voxels are. In both cases, a
  /// slab has at least one layer, and a slab of several layers has at most 2^28 voxels. A GridFrame
  /// can therefore hold the slab.
  static std::uint64_t layers_that_fit(const LayeredImage& image, const RunContext& context) {
    constexpr double bytes = 128;  // per voxel
    // The limit is a number of voxels; larger slabs are not faster.
    constexpr double most = 1 << 28;
    const auto size = static_cast<double>(image.layer_size());
    const double layers = context.slab_layers > 0
                              ? context.slab_layers
                              : static_cast<double>(context.memory.left()) / 4 / (bytes * size);
    return static_cast<std::uint64_t>(
        std::clamp(layers, 1.0, std::max(1.0, std::floor(most / size))));
  }
  /// Precondition: LayeredImage::can_cut, layers > 0.
  /// @param part the position of the image if it is a part of a larger image. The part then has
  /// ghosts at its ends.
  /// @param first the first voxel of the image in the entire grid, including ghosts (modulo 2^64).
  Slabs(const LayeredImage& image, std::uint64_t layers, const RunContext& context,
        const SlabPlace& part = {}, std::uint64_t first = 0)
      : image_(image),
        part_(part),
        first_(first),
        layers_(std::min(layers, image.is_ring() ? depth() - 1 : depth())),
        cube_pairs_(cube_pair_memos(image.shape(), part.is_in_ring, context)),
        around_(&context.memory),
        context_(context) {}

  const LayeredImage& image() const { return image_; }
  const CubePairMemos& cube_pairs() const { return cube_pairs_; }
  std::uint64_t count() const { return (depth() - 1) / layers_ + 1; }
  /// The first voxel of a slab in the entire grid, including ghosts. The first slab of a ring
  /// begins one layer before zero (modulo 2^64).
  std::uint64_t first_voxel(std::uint64_t slab) const {
    return first_ +
           (is_first_of_ring(slab) ? std::uint64_t{0} - 1 : begin(slab)) * image_.layer_size();
  }
  /// The stars of a slab, with the adjacent layers as ghosts. They are valid until the slab is
  /// forgotten.
  StarGrid stars(std::uint64_t slab) { return grid<StarGrid>(slab); }
  /// A slab as another kind of grid. @tparam Grid a SlabFrame that has the same constructor as
  /// StarGrid.
  template <class Grid>
  Grid grid(std::uint64_t slab) {
    const CubicalImage part = voxels(slab);
    read_.reset();
    read_.emplace(context_.memory, part.is_in_file ? part.size() * bytes_of(part.type) : 0);
    return {part,
            context_,
            {.is_first = part_.is_first && slab == 0,
             .is_last = part_.is_last && slab + 1 == count(),
             .is_in_ring = part_.is_in_ring || image_.is_ring(),
             .cube_pairs = cube_pairs_}};
  }
  /// Removes from memory the pages of the image file that were read for a slab.
  void forget(std::uint64_t slab) {
    around_ = decltype(around_)(around_.get_allocator());
    const CubicalImage part = image_.layers(begin(slab), end(slab));
    if (part.is_in_file) {
      // When a page is read, the system also maps the pages around it, including pages of finished
      // slabs.
      constexpr std::ptrdiff_t kMappedAround = 64 << 10;  // mutant: slab-mapped
      const CubicalImage& all = image_.all();
      const auto* const begin_of_all = static_cast<const char*>(all.voxels);
      const auto* const voxels = static_cast<const char*>(part.voxels);
      const auto bytes = [](const CubicalImage& image) {
        return static_cast<std::ptrdiff_t>(image.size() * bytes_of(image.type));
      };
      const std::ptrdiff_t at = voxels - begin_of_all;
      const std::ptrdiff_t from = std::max<std::ptrdiff_t>(at - kMappedAround, 0);
      const std::ptrdiff_t to = std::min(at + bytes(part) + kMappedAround, bytes(all));
      forget_file_pages(begin_of_all + from, static_cast<std::size_t>(to - from));
    }
    read_.reset();
  }

 private:
  bool is_first_of_ring(std::uint64_t slab) const { return image_.is_ring() && slab == 0; }
  bool is_last_of_ring(std::uint64_t slab) const { return image_.is_ring() && slab + 1 == count(); }
  std::uint64_t ghosts_before() const { return part_.has_ghost_before() ? 1 : 0; }
  // The number of layers, without ghosts.
  std::uint64_t depth() const {
    return image_.extent() - ghosts_before() - (part_.has_ghost_after() ? 1 : 0);
  }
  // The layers of a slab and its ghosts are the layers from begin(slab) up to end(slab).
  std::uint64_t begin(std::uint64_t slab) const {
    return slab == 0 ? 0 : ghosts_before() + slab * layers_ - 1;
  }
  std::uint64_t end(std::uint64_t slab) const {
    return slab + 1 == count() ? image_.extent() : ghosts_before() + (slab + 1) * layers_ + 1;
  }
  // The voxels of a slab. At the ends of a ring, neighbouring layers are not adjacent in memory. A
  // slab that spans such an end is therefore copied.
  CubicalImage voxels(std::uint64_t slab) {
    const bool goes_before = is_first_of_ring(slab), goes_after = is_last_of_ring(slab);
    if (!goes_before && !goes_after) return image_.layers(begin(slab), end(slab));
    struct Part {
      std::uint64_t begin, end;
    };
    const Part own{begin(slab), end(slab)}, first{0, 1}, last{image_.extent() - 1, image_.extent()};
    std::array<Part, 2> parts{goes_before ? last : own, goes_before ? own : first};
    // Copies the two parts in the order in which they are in memory.
    if (image_.shape().is_t_construction()) std::swap(parts[0], parts[1]);
    around_.clear();
    for (const Part& part : parts) {
      const CubicalImage some = image_.layers(part.begin, part.end);
      const std::size_t bytes = some.size() * bytes_of(some.type), before = around_.size();
      around_.resize(before + bytes);
      std::memcpy(around_.data() + before, some.voxels, bytes);
    }
    CubicalImage copy = image_.layers_of(around_.data(), own.end - own.begin + 1);
    copy.is_in_file = false;
    return copy;
  }

  const LayeredImage& image_;
  SlabPlace part_;
  std::uint64_t first_, layers_;
  CubePairMemos cube_pairs_;
  std::pmr::vector<std::byte> around_;
  const RunContext& context_;
  // Claims memory for the voxels of the current slab if the image is in a file. These voxels occupy
  // memory while they are used.
  std::optional<MemoryClaim> read_;
};

}  // namespace ph::cubical
