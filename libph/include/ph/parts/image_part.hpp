// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "ph/barcode.hpp"
#include "ph/cubical.hpp"
#include "ph/image.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// Options of an image that is computed in parts; all parts must have the same options.
struct ImagePartOptions {
  CubicalOptions cubical = {};
  int min_dim = 0;
  std::optional<int> max_dim = std::nullopt;  ///< default: all dimensions
  bool cells = true;                          ///< if false, bars have no cells
  /// True if bars that need all layers of a volume may be requested later: ImageLoops finds them,
  /// in images of at most three axes. A part with loops processes all its layers at once, whatever
  /// the value of RunContext::slab_layers is.
  bool loops = false;
  /// The first layer of each part, ascending from 0; by default, parts have about equal size.
  std::vector<Index> first_layers = {};
};

/// A forecast for the parts of an image, from a sample of its voxels.
struct ImagePartForecast {
  /// Values of ImagePartOptions::first_layers with which no part takes much longer than the others.
  std::vector<Index> first_layers;
  /// Time of the slowest part if all parts are equally large, relative to the mean time of a part.
  double longest = 1;
  /// A lower and an upper bound, in bytes.
  struct Bytes {
    double low = 0, high = 0;
  };
  Bytes memory;  ///< of the part that takes most memory, including voxels of a mapped file
  Bytes file;    ///< size of the largest part's file, see ImagePart::bytes
  Bytes join;    ///< memory to join all parts
  /// Sent by all ranks together, one part per rank; includes the messages of ImageLoops.
  Bytes sent;
};

/// The barcode of some layers of an image, as far as these layers determine it: the pairs that no
/// other layer can change, and the data at the first and last of these layers that other layers can
/// change. Parts are computed separately, by any processes on any machines, and can be joined in
/// any grouping: the bars are the bars of the entire image. See docs/explanation/engines/slabs.md.
///
/// The image has two to eight axes that count, and any number of voxels; with loops, a part must
/// have fewer than about 2^31 voxels. An axis counts if it has more than one voxel or, in the
/// T-construction, is not periodic. With d >= 3 axes, bars of dimensions 1 to d - 2 need all
/// layers; if an axis closes up, so do bars of higher dimensions. Requests for these bars are
/// refused, unless the image is a volume and option `loops` promises that ImageLoops will find
/// them. A max_dim of 0 and a min_dim of d - 1 are always possible.
class ImagePart {
 public:
  /// Computes layers n · part / parts up to n · (part + 1) / parts of the n layers of the slowest
  /// axis, or the layers that the options name. Reads only the voxels of these layers and of one
  /// layer on either side.
  /// @param part counted from 0. @param parts at most one per layer.
  /// @param context must outlive this part and every part with which it is joined; the same applies
  /// to the context of `of_bytes`.
  /// @throws Error (usage) on invalid options and parts, (bad_data) and (resource) as Cubical,
  ///         (cancelled).
  ImagePart(const Image& image, int part, int parts, const ImagePartOptions& options = {},
            const RunContext& context = default_context());
  /// The largest number of parts: one per layer.
  /// @throws Error (usage) on images that cannot be divided.
  static int most_parts(const Image& image, const CubicalOptions& options = {});
  /// Forecasts from about one voxel in twenty.
  /// @throws Error (usage, bad_data) as the constructor.
  static ImagePartForecast forecast(const Image& image, int parts,
                                    const ImagePartOptions& options = {});
  ImagePart(ImagePart&&) noexcept;
  ImagePart& operator=(ImagePart&&) noexcept;
  ~ImagePart();

  /// This object covers the parts first() to last() of parts() parts.
  int first() const;
  int last() const;
  int parts() const;
  bool is_whole() const { return first() == 0 && last() + 1 == parts(); }
  /// The extents of the entire image.
  const std::vector<Index>& extents() const;
  VoxelType type() const;
  const ImagePartOptions& options() const;
  /// True if this is exactly part `part` of `parts` of the image, with these options, as the
  /// constructor would make it. The voxels that the constructor reads are compared by a fingerprint
  /// of 64 bits. O(these voxels).
  bool is_of(const Image& image, int part, int parts, const ImagePartOptions& options) const;
  /// Takes in the part that follows directly.
  /// @throws Error (bad_data) if it does not follow, belongs to another image or has other options;
  ///         this part is then unchanged.
  void join(ImagePart next, const RunContext& context = default_context());
  /// The bars of positive length, except the bars that ImageLoops finds. Precondition: is_whole().
  Barcode barcode(const RunContext& context = default_context()) const;

  /// True if the options request bars for which ImageLoops is needed.
  bool has_loops() const;
  /// The results of the joins that ImageLoops::begin needs for one part, as bytes. Precondition:
  /// is_whole(), has_loops().
  std::vector<std::byte> told_to_loops(int part) const;

  /// The part as bytes with a checksum: the same on every machine.
  std::vector<std::byte> bytes() const;
  /// @throws Error (bad_data) on anything that `bytes` did not make.
  static ImagePart of_bytes(std::span<const std::byte> bytes,
                            const RunContext& context = default_context());

 private:
  friend class ImageLoops;
  struct State;
  explicit ImagePart(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace ph
