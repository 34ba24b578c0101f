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

/// What is wanted of an image that is computed in parts: the same of all of them.
struct ImagePartOptions {
  CubicalOptions cubical = {};
  int min_dim = 0;
  std::optional<int> max_dim = std::nullopt;  ///< default: all
  bool cells = true;                          ///< else bars have none
  /// Whether a volume's bars that need all layers may be wanted: ImageLoops finds them, but not of
  /// more than three axes. A part that has them looks at all its layers at once, whatever
  /// RunContext::slab_layers says.
  bool loops = false;
  /// The first layer of each part, ascending from 0 on; default: parts of about equal size.
  std::vector<Index> first_layers = {};
};

/// What parts of an image will take, foreseen from a sample of its voxels.
struct ImagePartForecast {
  /// ImagePartOptions::first_layers with which no part takes much longer than the others.
  std::vector<Index> first_layers;
  /// How much longer the longest of parts of equal size takes than their mean.
  double longest = 1;
  /// Bytes, at least and at most.
  struct Bytes {
    double low = 0, high = 0;
  };
  Bytes memory;  ///< of the part that takes most; voxels of a mapped file are counted
  Bytes file;    ///< of the largest part, as ImagePart::bytes
  Bytes join;    ///< memory to join all of them
  Bytes sent;    ///< by all ranks together, if each has a part; with ImageLoops
};

/// The barcode of some layers of an image, as far as it is known without the others: its own pairs
/// that no other layer can change, and what can change at its ends. Parts are computed apart, by
/// any processes on any machines, and joined in any grouping: the bars are those of the whole
/// image. See docs/explanation/engines/slabs.md.
///
/// Images of two to eight axes that have more than one voxel, of any size; where loops are wanted a
/// part has fewer than about 2^31 voxels. Of d axes, three or more, bars of dimensions 1 to d - 2
/// need all layers, and where an axis closes up also those above: they are refused, unless it is a
/// volume and option `loops` says that ImageLoops will find them. Max_dim 0 and min_dim d - 1 can
/// be had.
class ImagePart {
 public:
  /// Layers n · part / parts up to n · (part + 1) / parts of the n of the slowest axis, or those
  /// that the options say. Looks at the voxels of these and of the layer on either side, and at no
  /// others.
  /// @param part from 0 on. @param parts at most one a layer.
  /// @param context outlives the part, and what it is joined with; so does that of `of_bytes`.
  /// @throws Error (usage) on options and parts that are none, (bad_data) and (resource) as
  ///         Cubical, (cancelled).
  ImagePart(const Image& image, int part, int parts, const ImagePartOptions& options = {},
            const RunContext& context = default_context());
  /// How many parts there may be: one a layer.
  /// @throws Error (usage) on images that have no parts.
  static int most_parts(const Image& image, const CubicalOptions& options = {});
  /// Looks at about one voxel in twenty.
  /// @throws Error (usage, bad_data) as the constructor.
  static ImagePartForecast forecast(const Image& image, int parts,
                                    const ImagePartOptions& options = {});
  ImagePart(ImagePart&&) noexcept;
  ImagePart& operator=(ImagePart&&) noexcept;
  ~ImagePart();

  /// Which of how many parts it covers: those from first() to last().
  int first() const;
  int last() const;
  int parts() const;
  bool is_whole() const { return first() == 0 && last() + 1 == parts(); }
  /// Of the whole image.
  const std::vector<Index>& extents() const;
  VoxelType type() const;
  const ImagePartOptions& options() const;
  /// Whether it is part `part` alone of `parts` of an image of that shape and type, with those
  /// options: else it is not what the constructor would make. The voxels are not looked at.
  bool is_of(const Image& image, int part, int parts, const ImagePartOptions& options) const;
  /// Takes in the parts right after it.
  /// @throws Error (bad_data) if they are not, or of another image, or of other options; nothing
  ///         has changed then.
  void join(ImagePart next, const RunContext& context = default_context());
  /// The bars of positive length, without those of ImageLoops. Precondition: is_whole().
  Barcode barcode(const RunContext& context = default_context()) const;

  /// Whether ImageLoops has bars that are wanted.
  bool has_loops() const;
  /// What the joins have found out for the loops of one part, as bytes. Precondition: is_whole(),
  /// has_loops().
  std::vector<std::byte> told_to_loops(int part) const;

  /// What it consists of, as bytes with a checksum: the same on every machine.
  std::vector<std::byte> bytes() const;
  /// @throws Error (bad_data) on what `bytes` has not made.
  static ImagePart of_bytes(std::span<const std::byte> bytes,
                            const RunContext& context = default_context());

 private:
  friend class ImageLoops;
  struct State;
  explicit ImagePart(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace ph
