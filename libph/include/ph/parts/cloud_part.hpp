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

/// What is wanted of a cloud that is computed in parts: the same of all of them.
struct CloudPartOptions {
  /// Largest distance at which two points are joined, inclusive. Default: no limit.
  std::optional<double> threshold = std::nullopt;
  PointDistance distance = PointDistance::euclidean;  ///< no other one can be had in parts
  /// A part goes through so many blocks, one after another, and holds one at a time. 0: as many as
  /// leave a block about four million points. What is computed does not depend on it.
  int blocks = 0;
  /// Points drawn to cut the cloud, and to tell what is far from what. 0: enough.
  Index sample = 0;
};

/// What parts of a cloud will take, foreseen from the numbers of points and blocks. The points,
/// which may be a mapped file, are not counted.
struct CloudPartForecast {
  /// Bytes, at least and at most.
  struct Bytes {
    double low = 0, high = 0;
  };
  Bytes memory;  ///< of a part
  Bytes file;    ///< of a part, as CloudPart::bytes
  Bytes join;    ///< memory to join all of them and have the bars
  Bytes sent;    ///< by all ranks together, if each has a part
};

/// The components of a point cloud, as far as they are known from some blocks of it and what is
/// near these: edges of its minimum spanning tree. Parts are computed apart, by any processes that
/// can read the cloud, on any machines, and joined in any grouping and order: what comes of all of
/// them is, bit by bit, the spanning forest of Rips of the whole cloud. See
/// docs/explanation/engines/cloud-parts.md.
///
/// Points of at most eight coordinates, with Euclidean distances. A cloud has any number of points;
/// some parts joined have fewer than 2^32 - 1.
class CloudPart {
 public:
  /// Reads the points from first to last, once and once more for each block; holds those of a block
  /// and what is near them, about 200 bytes a point, and 16 to 24 bytes for each edge found. So the
  /// points may be a mapped file that is larger than the memory.
  /// @param points all of the cloud, one a row. @param part from 0 on.
  /// @param context outlives the part, and what it is joined with; so does that of `of_bytes`.
  /// @throws Error (usage) on options and parts that are none, (bad_data) as PointMetric,
  /// (resource), (cancelled).
  CloudPart(PointsView points, int part, int parts, const CloudPartOptions& options = {},
            const RunContext& context = default_context());
  /// Looks at no coordinates. @throws Error (usage) as the constructor.
  static CloudPartForecast forecast(PointsView points, int parts,
                                    const CloudPartOptions& options = {});
  CloudPart(CloudPart&&) noexcept;
  CloudPart& operator=(CloudPart&&) noexcept;
  ~CloudPart();

  /// Of how many parts it has some.
  int parts() const;
  /// The parts that are in it, ascending, and those that are not yet.
  const std::vector<int>& present() const;
  std::vector<int> missing() const;
  bool is_whole() const { return present().size() == static_cast<std::size_t>(parts()); }
  /// Of the whole cloud: how many points, of how many coordinates each.
  Index points() const;
  Index coordinates() const;
  std::optional<double> threshold() const;
  /// Whether it is part `part` alone of `parts` of a cloud of that many points and axes, with those
  /// options. The coordinates are not looked at.
  bool is_of(PointsView points, int part, int parts, const CloudPartOptions& options) const;
  /// Takes in other parts of the same cloud.
  /// @throws Error (bad_data) if they are of another cloud, or of other options, or one is in it
  ///         already; nothing has changed then. Error (resource, cancelled): neither can be used.
  void join(CloudPart other, const RunContext& context = default_context());

  /// The bars of H0 of positive length, without cells: 24 bytes each. Precondition: is_whole().
  /// @throws Error (bad_data) if the parts do not have all edges of the forest: every part says
  ///         what has to be joined, and by edges of which length.
  Barcode barcode(const RunContext& context = default_context()) const;
  /// The filtration of the whole cloud, of which only the minimum spanning forest is held: for
  /// `persistence` with max_dim 0 and cells, and for `merge_tree`. Precondition: is_whole().
  /// @throws Error (bad_data) as barcode, (resource) as Rips.
  Rips rips(const RunContext& context = default_context()) const&;
  /// Leaves a part that can only be assigned to.
  Rips rips(const RunContext& context = default_context()) &&;

  /// What it consists of, as bytes: the same on every machine, however it was joined.
  std::vector<std::byte> bytes() const;
  /// @throws Error (bad_data) on what `bytes` has not made.
  static CloudPart of_bytes(std::span<const std::byte> bytes,
                            const RunContext& context = default_context());

 private:
  struct State;
  explicit CloudPart(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace ph
