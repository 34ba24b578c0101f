// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory_resource>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "libph/src/cubical/columns/parallel_reduction.hpp"
#include "libph/src/cubical/loops/loop_column.hpp"
#include "libph/src/cubical/loops/loop_owners.hpp"
#include "libph/src/cubical/rounds/loop_message.hpp"
#include "libph/src/cubical/rounds/part_stars.hpp"
#include "libph/src/cubical/sinks/pair_sink.hpp"
#include "libph/src/cubical/slabs/free_cells.hpp"
#include "libph/src/cubical/stars/free_edges.hpp"

namespace ph::cubical {

/// Computes H1 for three axes in one part of a grid. It works like LoopReduction, except that a
/// column belongs to the part that has the star of its pivot. If the pivot turns out to be in
/// another part, the column is sent to that part. Columns are therefore added only within a part,
/// and no part waits for an answer. See docs/explanation/engines/slabs.md.
template <Field K>
class PartLoops {
  using Chain = LoopColumn<K, PartStars>;
  struct Ages {
    const std::pmr::vector<LoopSquare>* squares;
    bool is_older(std::uint32_t a, std::uint32_t b) const {
      return LoopSquare::precedes((*squares)[a], (*squares)[b]);  // mutant: square-order
    }
  };
  using Reduction = ParallelReduction<K, Chain, Ages>;
  using Column = typename Reduction::Column;
  using Message = LoopMessage<K>;

 public:
  using Term = typename Reduction::Term;

  /// @param stars the stars of the part; `stars` and `whole` must outlive this object.
  /// @param image distinguishes images, fields and options.
  PartLoops(PartStars& stars, const GridShape& whole, const PartLayout& layout, int part,
            std::uint64_t image, const K& field, const RunContext& context);
  PartLoops(const PartLoops&) = delete;
  PartLoops& operator=(const PartLoops&) = delete;

  /// Starts the reduction. @param free the cells of the part that neither graph pairs.
  /// @throws Error (bad_data) if `free` contains other cells.
  void begin(FreeCells free);
  /// Reads a message from another part, which may arrive before `begin` is called.
  /// @throws Error (bad_data) if the message is damaged or has already been received.
  void receive(std::span<const std::byte> message);
  /// True if there is nothing to do until a message is received.
  bool is_idle() const { return !is_ready() || next_ == queue_.size(); }
  /// Reduces at most `most` columns, as far as this part can reduce them.
  void work(std::size_t most);
  /// Calls `use(part, bytes)` with each message to another part that has been written since the
  /// last call.
  template <class Use>
  void send(Use&& use) {
    for (auto& [to, writer] : outbox_)
      if (!writer.is_empty()) use(to, writer.take(image_, part_, to));
  }
  /// Passes on the pairs whose edges are in this part, and the classes of this part that never die.
  /// Precondition: all parts are idle, and every message sent has been received.
  void finish(PairSink& pairs) const;

  std::uint64_t columns_sent = 0, columns_received = 0;

 private:
  // mutant: ghosts-ready
  bool is_ready() const { return reduction_.has_value() && layers_missing_ == 0; }
  void take_edges(std::pmr::vector<GridCell>& edges);
  void take_squares(const std::pmr::vector<GridCell>& squares);
  void tell_layers();
  void check(const Message& message);
  bool is_free(const LoopEdge& edge) const;
  void assign(Chain& chain, std::uint32_t i);
  bool is_done(std::uint32_t i, std::optional<Term>& pivot, Chain& chain);
  WholeCell cell(const LoopSquare& square) const;

  const GridShape& whole_;
  const PartLayout layout_;
  const int part_;
  const std::uint64_t image_;
  const K field_;
  const RunContext& context_;
  PartStars& grid_;
  std::size_t layers_missing_ = 0;             // ghost layers that have not arrived yet
  std::vector<std::vector<std::byte>> early_;  // messages that arrived before `begin` was called
  // For each sender, indexed by the number of the message, true if the message was received.
  std::map<int, std::vector<bool>> heard_;

  FreeEdges free_;
  // The squares of the columns. The squares of this part come first, from old to young.
  std::pmr::vector<LoopSquare> squares_;
  std::size_t own_ = 0;
  // Columns from other parts that have not been reduced here yet.
  std::pmr::vector<std::pmr::vector<Term>> arrived_;
  std::pmr::vector<std::uint32_t> queue_;
  std::size_t next_ = 0;  // the position in the queue
  std::optional<LoopOwners<PartStars, Column>> owners_;
  std::optional<Reduction> reduction_;

  std::mutex mutex_;  // protects the members below
  std::vector<LoopSquare> zero_;
  std::map<int, typename Message::Writer> outbox_;
};

}  // namespace ph::cubical
