// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <memory_resource>
#include <utility>
#include <vector>

#include "libph/src/rips/annotations/vertex_functions.hpp"
#include "ph/detail/core/field.hpp"

namespace ph {

/// An alternating function of two vertices of a link, that is, a 1-cochain of the link's flag
/// complex. It is stored as a row f(x,.) for each vertex x on which it is not zero.
template <Field K>
class LinkPairs {
 public:
  using Vertex = std::uint32_t;
  using Element = typename K::Element;
  using Function = VertexFunction<K>;
  using Unit = typename Function::Unit;

  /// @param rows must outlive this object.
  LinkPairs(RowPool<K>& rows, const K& field, std::pmr::memory_resource* memory)
      : rows_(&rows), field_(&field), ids_(memory), used_(memory) {}

  /// Returns f(x,.), or null if the row is zero.
  const Unit* row(Vertex x) const {
    return x < ids_.size() && ids_[x] != kNone ? (*rows_)[ids_[x]] : nullptr;
  }
  /// Adds values to f(x,.), and subtracts them from f(.,x). @param words the number of words of the
  /// rows to process.
  void add_row(Vertex x, const Unit* values, std::size_t words) {
    Function::add(made_row(x), values, field_->from_int(1), *field_, words);
    Function::for_each(values, words, [&](std::size_t y, Element a) {
      Function::add_at(made_row(static_cast<Vertex>(y)), x, field_->negate(a), *field_);
    });
  }
  /// Adds scaled values to f(x,.) only. The caller must add the opposite values to f(.,x) as well.
  void add_half(Vertex x, const Unit* values, Element scale, std::size_t words) {
    Function::add(made_row(x), values, scale, *field_, words);
  }
  void add(const LinkPairs& other, Element scale, std::size_t words) {
    for (const Vertex x : other.used_) add_half(x, other.row(x), scale, words);
  }
  void clear() {
    for (const Vertex x : used_) rows_->give(std::exchange(ids_[x], kNone));
    used_.clear();
  }
  /// Calls `visit(x, y, f(x,y))` for all pairs in both orders. The pairs with the same x are
  /// consecutive.
  template <class Visit>
  void for_each(std::size_t words, Visit&& visit) const {
    for (const Vertex x : used_)
      Function::for_each(row(x), words,
                         [&](std::size_t y, Element a) { visit(x, static_cast<Vertex>(y), a); });
  }

 private:
  using Id = typename RowPool<K>::Id;
  static constexpr Id kNone = UINT32_MAX;

  Unit* made_row(Vertex x) {
    if (x >= ids_.size()) ids_.resize(x + 1, kNone);
    if (ids_[x] == kNone) {
      ids_[x] = rows_->take();
      used_.push_back(x);
    }
    return (*rows_)[ids_[x]];
  }

  RowPool<K>* rows_;
  const K* field_;
  std::pmr::vector<Id> ids_;  // number of each vertex's row, or kNone
  std::pmr::vector<Vertex> used_;
};

/// An alternating function of three vertices of a link, that is, a 2-cochain of the link's flag
/// complex. It is stored as a row f(x,y,.) for each pair x < y on which it is not zero.
template <Field K>
class LinkTriples {
 public:
  using Vertex = std::uint32_t;
  using Element = typename K::Element;
  using Function = VertexFunction<K>;
  using Unit = typename Function::Unit;

  /// @param rows must outlive this object.
  LinkTriples(RowPool<K>& rows, const K& field, std::pmr::memory_resource* memory)
      : rows_(&rows), field_(&field), ids_(memory), used_(memory) {}

  /// Returns f(x,y,.) if x < y, otherwise -f(x,y,.). Returns null if the row is zero.
  const Unit* row(Vertex x, Vertex y) const {
    if (x > y) std::swap(x, y);
    if (x >= ids_.size() || y >= ids_[x].size()) return nullptr;
    const Id id = ids_[x][y];
    return id == kNone ? nullptr : (*rows_)[id];
  }
  /// Computes f(x,y,z) += a for x < y < z.
  void add_at(Vertex x, Vertex y, Vertex z, Element a) {
    Function::add_at(made_row(x, y), z, a, *field_);
    Function::add_at(made_row(x, z), y, field_->negate(a), *field_);
    Function::add_at(made_row(y, z), x, a, *field_);
  }
  void add(const LinkTriples& other, Element scale, std::size_t words) {
    for (const auto& [x, y] : other.used_)
      Function::add(made_row(x, y), other.row(x, y), scale, *field_, words);
  }
  bool is_zero(std::size_t words) const {
    for (const auto& [x, y] : used_)
      if (!Function::is_zero(row(x, y), words)) return false;
    return true;
  }
  void clear() {
    for (const auto& [x, y] : used_) rows_->give(std::exchange(ids_[x][y], kNone));
    used_.clear();
  }

 private:
  using Id = typename RowPool<K>::Id;
  static constexpr Id kNone = UINT32_MAX;

  Unit* made_row(Vertex x, Vertex y) {
    if (x >= ids_.size()) ids_.resize(x + 1);
    if (y >= ids_[x].size()) ids_[x].resize(y + 1, kNone);
    if (ids_[x][y] == kNone) {
      ids_[x][y] = rows_->take();
      used_.emplace_back(x, y);
    }
    return (*rows_)[ids_[x][y]];
  }

  RowPool<K>* rows_;
  const K* field_;
  std::pmr::vector<std::pmr::vector<Id>> ids_;
  std::pmr::vector<std::pair<Vertex, Vertex>> used_;
};

}  // namespace ph
