// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "ph/barcode.hpp"
#include "ph/detail/metric/metric.hpp"
#include "ph/points.hpp"
#include "ph/rips.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// Options of a cloud that is computed in parts; all parts must have the same options.
struct CloudPartOptions {
  /// Largest distance at which two points are joined, inclusive. By default there is no limit.
  std::optional<double> threshold = std::nullopt;
  PointDistance distance = PointDistance::euclidean;  ///< parts support no other distance
  /// A part is processed in this many blocks, one after another, and holds one block at a time. 0:
  /// the number is chosen such that a block has about four million points. The result does not
  /// depend on this number.
  int blocks = 0;
  /// Number of points drawn to cut the cloud, and to find which points are far apart. 0: chosen by
  /// the part.
  Index sample = 0;
};

/// A forecast for the parts of a cloud, from the numbers of points and blocks. The points, which
/// may be a mapped file, are not counted.
struct CloudPartForecast {
  /// A lower and an upper bound, in bytes.
  struct Bytes {
    double low = 0, high = 0;
  };
  Bytes memory;  ///< of one part
  Bytes file;    ///< of one part's file, see CloudPart::bytes
  Bytes join;    ///< memory to join all parts and compute the bars
  Bytes sent;    ///< sent by all ranks together, one part per rank
};

/// The components of a point cloud, as far as some of its blocks, and the points near these blocks,
/// determine them: edges of the cloud's minimum spanning tree. Parts are computed separately, by
/// any processes that can read the cloud, on any machines, and can be joined in any grouping and
/// order: all parts together give, bit for bit, the spanning forest of Rips for the entire cloud.
/// See docs/explanation/engines/cloud-parts.md.
///
/// The points have at most eight coordinates and Euclidean distances. A cloud may have any number
/// of points; the parts that are joined must have fewer than 2^32 - 1 points.
class CloudPart {
 public:
  /// Reads all points in order: once for the entire cloud, and once more for each block. Holds the
  /// points of a block and the points near it, about 200 bytes per point, and 16 to 24 bytes per
  /// edge found. The points may therefore be a mapped file that is larger than the memory.
  /// @param points the entire cloud, one point per row. @param part counted from 0.
  /// @param context must outlive this part and every part with which it is joined; the same applies
  /// to the context of `of_bytes`.
  /// @throws Error (usage) on invalid options and parts, (bad_data) as PointMetric, (resource),
  /// (cancelled).
  CloudPart(PointsView points, int part, int parts, const CloudPartOptions& options = {},
            const RunContext& context = default_context());
  /// Forecasts memory and file sizes without reading coordinates. @throws Error (usage) as the
  /// constructor.
  static CloudPartForecast forecast(PointsView points, int parts,
                                    const CloudPartOptions& options = {});
  CloudPart(CloudPart&&) noexcept;
  CloudPart& operator=(CloudPart&&) noexcept;
  ~CloudPart();

  /// The number of parts into which the cloud is divided.
  int parts() const;
  /// The parts that it contains, ascending, and the parts that are still missing.
  const std::vector<int>& present() const;
  std::vector<int> missing() const;
  // mutant: cloud-whole
  bool is_whole() const { return present().size() == static_cast<std::size_t>(parts()); }
  /// The number of points of the entire cloud, and the number of coordinates of each.
  Index points() const;
  Index coordinates() const;
  std::optional<double> threshold() const;
  /// True if this is exactly part `part` of `parts` of the cloud `points`, with these options. The
  /// coordinates are compared by a fingerprint of 64 bits. O(coordinates).
  bool is_of(PointsView points, int part, int parts, const CloudPartOptions& options) const;
  /// Takes in another part of the same cloud.
  /// @throws Error (bad_data) if it is a part of another cloud, has other options or shares a part
  ///         with this one; this part is then unchanged. Error (resource, cancelled): neither part
  ///         can be used afterwards.
  void join(CloudPart other, const RunContext& context = default_context());

  /// The bars of H0 of positive length, without cells: 24 bytes each. Precondition: is_whole().
  /// @throws Error (bad_data) if the parts lack edges of the forest. This is noticed, because every
  ///         part knows which points must be joined, and how long the edges between them are.
  Barcode barcode(const RunContext& context = default_context()) const;
  /// The origin of the bars, which is also the origin of bars of `rips`.
  BarcodeInfo info() const;
  /// The filtration of the entire cloud, held only as its minimum spanning forest: for
  /// `persistence` with max_dim 0 and cells, and for `merge_tree`. Precondition: is_whole().
  /// @throws Error (bad_data) as barcode, (resource) as Rips.
  Rips rips(const RunContext& context = default_context()) const&;
  /// The same filtration; this object can afterwards only be assigned to or destroyed.
  Rips rips(const RunContext& context = default_context()) &&;

  /// The part as bytes: the same on every machine, whatever the order of joins.
  std::vector<std::byte> bytes() const;
  /// @throws Error (bad_data) on anything that `bytes` did not make.
  static CloudPart of_bytes(std::span<const std::byte> bytes,
                            const RunContext& context = default_context());

 private:
  struct State;
  explicit CloudPart(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace ph
