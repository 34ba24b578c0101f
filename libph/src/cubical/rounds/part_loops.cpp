// SPDX-License-Identifier: MIT
#include "libph/src/cubical/rounds/part_loops.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "ph/error.hpp"

namespace ph::cubical {
namespace {

[[noreturn]] void refuse(const char* why) { throw Error(ErrorKind::bad_data, why); }

}  // namespace

template <Field K>
PartLoops<K>::PartLoops(PartStars& stars, const GridShape& whole, const PartLayout& layout,
                        int part, std::uint64_t image, const K& field, const RunContext& context)
    : whole_(whole),
      layout_(layout),
      part_(part),
      image_(image),
      field_(field),
      context_(context),
      grid_(stars),
      free_(grid_, context),
      squares_(&context.memory),
      arrived_(&context.memory),
      queue_(&context.memory) {}

template <Field K>
void PartLoops<K>::begin(FreeCells free) {
  take_edges(free.edges);
  take_squares(free.squares);
  owners_.emplace(grid_, free_, context_);
  reduction_.emplace(own_, field_, context_, Reduction::kLanes, Ages{&squares_});
  tell_layers();
  for (const auto& message : std::exchange(early_, {})) receive(message);
}

template <Field K>
void PartLoops<K>::take_edges(std::pmr::vector<GridCell>& edges) {
  std::ranges::sort(edges);
  for (auto at = edges.begin(); at != edges.end();) {
    const std::uint64_t voxel = at->voxel();
    if (!grid_.owns(voxel)) refuse("loops: found an edge of another part");
    unsigned numbers = 0;
    for (; at != edges.end() && at->voxel() == voxel; ++at) numbers |= 1U << at->number();
    const std::uint32_t v = grid_.here(voxel), star = grid_.star(v);
    if (star == kAbsent || (numbers & ~grid_.tables(v).critical_edges(star)) != 0)
      refuse("loops: found an edge that is not critical");
    free_.add(v, numbers);
  }
  free_.finish();
  edges = std::pmr::vector<GridCell>(edges.get_allocator());
  grid_.mark_own(free_);
}

template <Field K>
void PartLoops<K>::take_squares(const std::pmr::vector<GridCell>& squares) {
  squares_.reserve(squares.size());
  for (const GridCell& square : squares) {
    if (!grid_.owns(square.voxel())) refuse("loops: found a square of another part");
    const std::uint32_t v = grid_.here(square.voxel());
    if (!grid_.enters(v)) refuse("loops: found a square that is not critical");
    const StarTables& tables = grid_.tables(v);
    if ((tables.critical_squares(grid_.star(v), grid_.pair_cubes(v)) >> square.number() & 1U) == 0)
      refuse("loops: found a square that is not critical");
    const auto number = static_cast<int>(square.number());
    squares_.push_back(
        LoopSquare::of(grid_.value(v), square.voxel(), tables.square_order().rank(number)));
  }
  std::ranges::sort(squares_, &LoopSquare::precedes);
  own_ = squares_.size();
  queue_.resize(own_);
  std::iota(queue_.begin(), queue_.end(), 0U);
}

template <Field K>
void PartLoops<K>::tell_layers() {
  layers_missing_ = layout_.ghosts(part_).size();
  for (int to = 0; to < layout_.parts(); ++to) {
    auto layers = layout_.ghosts(to);
    layers.erase(std::unique(layers.begin(), layers.end()), layers.end());
    for (const std::uint64_t layer : layers) {
      if (layout_.part_of(layer) != part_) continue;
      if (to == part_)  // the ghost is at the other end of a ring
        layers_missing_ -= *grid_.hear(layer, grid_.layer(layer));
      else
        outbox_[to].add_layer(layer, grid_.layer(layer));
    }
  }
}

template <Field K>
bool PartLoops<K>::is_free(const LoopEdge& edge) const {
  const std::uint32_t v = grid_.here(edge.voxel());
  if (!grid_.enters(v)) return false;
  const StarTables& tables = grid_.tables(v);
  const std::uint32_t star = grid_.star(v);
  const int number = tables.edge_order().at(edge.rank());
  return (StarTables::edges(star) >> number & 1U) != 0 && tables.arrow(star) != number &&
         (star & tables.taken_mark(number)) == 0 && edge.value() == grid_.value(v);
}

template <Field K>
void PartLoops<K>::check(const Message& message) {
  constexpr std::uint64_t most_ahead = 1 << 20;
  std::vector<bool>& heard = heard_[message.header.from];
  const std::uint64_t number = message.header.number;
  if (number >= heard.size() + most_ahead) refuse("loops of another part: a message is missing");
  if (number >= heard.size()) heard.resize(number + 1);
  if (heard[number]) refuse("loops of another part: found a message that was received before");
  heard[number] = true;
  for (const auto& layer : message.layers)
    if (layer.stars.size() != grid_.layer_size())
      refuse("loops of another part: found a layer of another image");
  for (const auto& column : message.columns)
    for (const Term& term : column.terms)
      if (grid_.owns(term.cell.voxel()) && !is_free(term.cell))
        refuse("loops of another part: found an edge that is already paired");
}

template <Field K>
void PartLoops<K>::receive(std::span<const std::byte> bytes) {
  if (!reduction_) {
    early_.emplace_back(bytes.begin(), bytes.end());
    return;
  }
  Message message(bytes, field_, image_, part_, layout_.parts(), layout_.size(), &context_.memory);
  check(message);
  if (squares_.size() + message.columns.size() > UINT32_MAX)
    throw Error(ErrorKind::resource, "loops of a part: found 2^32 columns or more");
  for (const auto& layer : message.layers) {
    const auto count = grid_.hear(layer.layer, layer.stars);
    if (!count || *count > layers_missing_)
      refuse("loops of another part: found a layer of another image");
    layers_missing_ -= *count;
  }
  for (auto& column : message.columns) {
    queue_.push_back(static_cast<std::uint32_t>(squares_.size()));
    squares_.push_back(column.square);
    arrived_.push_back(std::move(column.terms));
  }
  reduction_->grow(message.columns.size());
  columns_received += message.columns.size();
}

template <Field K>
void PartLoops<K>::assign(Chain& chain, std::uint32_t i) {
  if (i >= own_) {
    const std::pmr::vector<Term> terms = std::move(arrived_[i - own_]);
    chain.assign(terms);
    return;
  }
  const std::uint32_t v = grid_.here(squares_[i].voxel());
  chain.assign_boundary(v, grid_.tables(v).square_order().at(squares_[i].rank()));
}

template <Field K>
bool PartLoops<K>::is_done(std::uint32_t i, std::optional<Term>& pivot, Chain& chain) {
  const auto is_here = [&] { return pivot && grid_.owns(pivot->cell.voxel()); };
  // Expanding the cells that this part sees takes about as long as sending them. The limit prevents
  // a single column from taking a very long time. After cells have been expanded, the pivot may be
  // an edge of this part.
  constexpr std::size_t few = 64, times = 4;
  // mutant: column-goes
  if (pivot && !is_here()) pivot = chain.follow(*pivot, times * (chain.size() + few));
  if (is_here()) return false;
  const std::span<const Term> below = pivot ? chain.consolidate() : std::span<const Term>();
  const std::lock_guard lock(mutex_);
  if (pivot) {
    const int to = layout_.part_of(pivot->cell.voxel() / layout_.layer_size());
    outbox_[to].add_column(squares_[i], *pivot, below);
    ++columns_sent;
  } else {
    zero_.push_back(squares_[i]);
  }
  return true;
}

template <Field K>
void PartLoops<K>::work(std::size_t most) {
  if (is_idle()) return;
  const auto begin = queue_.begin() + static_cast<std::ptrdiff_t>(next_);
  const std::size_t count = std::min(most, queue_.size() - next_);
  std::pmr::vector<std::uint32_t> round(begin, begin + static_cast<std::ptrdiff_t>(count),
                                        &context_.memory);
  next_ += count;
  if (next_ == queue_.size()) {
    queue_.clear();
    next_ = 0;
  }
  // Starting threads would take longer than reducing a few columns.
  constexpr std::size_t few = 1024, piece = 64;
  reduction_->run_some(
      std::move(round), "loops", count < few ? few : piece,
      [&] { return Chain(grid_, field_, context_); },
      [&](Chain& chain, std::uint32_t i) { assign(chain, i); },
      [&](const LoopEdge& pivot) -> const Column*& { return owners_->of(pivot); },
      [&](const LoopEdge& pivot) { owners_->expect(pivot); }, [](std::span<std::uint32_t>) {},
      [&](std::uint32_t i, std::optional<Term>& pivot, Chain& chain) {
        return is_done(i, pivot, chain);
      });
}

template <Field K>
WholeCell PartLoops<K>::cell(const LoopSquare& square) const {
  const StarTables& tables = star_tables(whole_.wrapped(square.voxel()));
  return {square.voxel(), widened(kSquares[tables.square_order().at(square.rank())]),
          square.value()};
}

template <Field K>
void PartLoops<K>::finish(PairSink& pairs) const {
  Ticker ticker(context_, "bars of loops", free_.count());
  owners_->for_each([&](const StarCell& edge, const Column* column) {
    ticker.tick();
    const WholeCell birth{grid_.in_whole(edge.voxel), widened(edge.direction), edge.value};
    if (column != nullptr)
      pairs.pair(1, birth, cell(squares_[column->number()]));
    else
      pairs.essential(1, birth);
  });
  for (const LoopSquare& square : zero_) pairs.essential(2, cell(square));
}

template class PartLoops<Z2>;
template class PartLoops<Zp>;

}  // namespace ph::cubical
