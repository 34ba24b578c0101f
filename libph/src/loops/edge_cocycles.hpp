// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <memory_resource>
#include <span>

#include "libph/src/loops/early_graph.hpp"
#include "ph/barcode.hpp"

namespace ph::detail {

/// The birth and death of a bar, by which bars are compared.
struct Lifetime {
  double birth, death;
  EarlyGraph::Key birth_key;
};

/// Decides which bars of a filtration matter for the cycles of a given bar. These bars are its
/// *elders*, which are born before it and do not die before it.
class Elders {
 public:
  /// Makes an object that compares births by edge or by value. @param by_value true for a
  /// comparison by value, which is needed if the order among edges of equal value may have changed
  /// (as after a collapse). If two bars are born at the same value, the bar that does not die first
  /// is then an elder of the other bar. Each bar is then its own elder.
  explicit Elders(bool by_value) : by_value_(by_value) {}
  bool is_elder(const Lifetime& elder, const Lifetime& of) const {
    if (elder.death < of.death) return false;  // mutant: loops-elder
    return by_value_ ? elder.birth <= of.birth : elder.birth_key < of.birth_key;
  }
  /// True if `a` is born before `b`, by value or by edge as chosen.
  bool is_born_before(const Lifetime& a, const Lifetime& b) const {
    return by_value_ ? a.birth < b.birth : a.birth_key < b.birth_key;
  }
  bool by_value() const { return by_value_; }

 private:
  bool by_value_;
};

/// The values of cocycles on the first edges of a graph.
class EdgeCocycles {
 public:
  struct Term {
    std::uint32_t cocycle;
    std::uint32_t value;  ///< value from the smaller to the larger vertex, 1 … p - 1
  };

  explicit EdgeCocycles(const RunContext& context)
      : lifetimes_(&context.memory), offsets_(&context.memory), terms_(&context.memory) {}

  /// Takes the values of cocycles from a barcode that was computed on the same vertices.
  /// @param cocycles the barcode, with cocycles in H1. @param keep selects the bars whose cocycles
  /// are taken.
  template <class Keep>
  void take(const EarlyGraph& graph, const Barcode& cocycles, std::int64_t field, Keep&& keep,
            Ticker& ticker) {
    struct Placed {
      EarlyGraph::Key key;
      Term term;
    };
    std::pmr::vector<Placed> placed(terms_.get_allocator().resource());
    for (std::size_t i = 0; i < cocycles.size(); ++i) {
      if (cocycles[i].dim != 1 || !(cocycles[i].birth <= graph.last_value())) continue;
      const auto birth = key_of(graph, cocycles.birth_cell(i));
      if (!birth) continue;
      const Lifetime lifetime{cocycles[i].birth, cocycles[i].death, *birth};
      if (!keep(lifetime)) continue;
      const InputChain chain = cocycles.representative(i);
      for (std::size_t k = 0; k < chain.size(); ++k) {
        ticker.work();
        const auto key = key_of(graph, chain.cell(k));
        if (!key) continue;  // the edge is born later than any loop
        const std::int64_t value = (chain.coefficient(k) % field + field) % field;
        placed.push_back(
            {*key,
             {static_cast<std::uint32_t>(lifetimes_.size()), static_cast<std::uint32_t>(value)}});
      }
      lifetimes_.push_back(lifetime);
    }
    offsets_.assign(std::size_t{graph.edges()} + 2, 0);
    for (const Placed& p : placed) ++offsets_[p.key + 1];
    for (std::size_t i = 1; i < offsets_.size(); ++i) offsets_[i] += offsets_[i - 1];
    terms_.resize(placed.size());
    std::pmr::vector<std::size_t> next(offsets_.begin(), offsets_.end(),
                                       terms_.get_allocator().resource());
    for (const Placed& p : placed) terms_[next[p.key]++] = p.term;
  }

  /// For each cocycle, the lifetime of its bar.
  std::span<const Lifetime> lifetimes() const { return lifetimes_; }
  std::span<const Term> on(EarlyGraph::Key key) const {
    if (offsets_.empty()) return {};
    return std::span(terms_).subspan(offsets_[key], offsets_[key + 1] - offsets_[key]);
  }

  static std::optional<EarlyGraph::Key> key_of(const EarlyGraph& graph, const InputCell& edge) {
    return graph.key_of(graph.vertex_of(edge.numbers[0]), graph.vertex_of(edge.numbers[1]));
  }

 private:
  std::pmr::vector<Lifetime> lifetimes_;
  std::pmr::vector<std::size_t> offsets_;  // start of each edge's terms, by key
  std::pmr::vector<Term> terms_;
};

}  // namespace ph::detail
