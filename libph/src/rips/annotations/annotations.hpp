// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <concepts>
#include <cstdint>
#include <cstdlib>
#include <memory_resource>
#include <span>
#include <unordered_set>
#include <vector>

#include "libph/src/rips/annotations/dead_generators.hpp"
#include "libph/src/rips/annotations/number_set.hpp"
#include "libph/src/rips/sweep/active_edges.hpp"
#include "libph/src/rips/sweep/sorted_terms.hpp"
#include "ph/detail/core/chain.hpp"
#include "ph/detail/core/field.hpp"
#include "ph/detail/core/flat_map.hpp"
#include "ph/error.hpp"

namespace ph {

/// The classes of edges with respect to the living generators of H^1. Each generator is a cocycle.
/// The annotation of an edge (Busaryev, Cabello, Chen, Dey, Wang, Annotating simplices with a
/// homology basis) is the vector of the generators' values on the edge. Edges of the same class
/// share one vector. An edge that was never annotated has the zero vector. Annotations are
/// alternating: a(u,v) = -a(v,u).
///
/// Dead generators are replaced in a class when the class is next requested. Until then, two
/// classes that became equal may still be separate, and edges of a class that became zero may still
/// be active.
template <Field K>
class Annotations {
 public:
  using Generator = typename DeadGenerators<K>::Generator;
  using Term = typename DeadGenerators<K>::Term;
  using Vector = typename DeadGenerators<K>::Vector;

  /// A class up to sign: only one of the vectors +-a is stored. 0 is the zero class.
  struct Class {
    std::uint32_t id = 0;
    bool negated = false;
    bool is_zero() const { return id == 0; }
    Class operator-() const { return {id, !std::same_as<K, Z2> && id != 0 && !negated}; }
    friend bool operator==(const Class&, const Class&) = default;
  };

  /// @param edges receives the edges whose class is not zero. It must be empty at first, and must
  /// outlive this object. @param keeps_values true if for_each_value will be called.
  Annotations(const K& field, ActiveEdges& edges, bool keeps_values,
              std::pmr::memory_resource* memory)
      : field_(field),
        edges_(edges),
        keeps_values_(keeps_values),
        births_(memory),
        vectors_(memory),
        hashes_(memory),
        members_(memory),
        links_(memory),
        seen_(memory),
        fresh_(memory),
        unused_(memory),
        dead_(field, memory),
        occurrences_(memory),
        sums_(memory),
        known_(16, Hash{this}, Equal{this}, memory),
        scratch_(memory),
        merged_(memory) {
    add_class();  // the zero class
    unused_.clear();
  }
  Annotations(const Annotations&) = delete;
  Annotations& operator=(const Annotations&) = delete;

  /// An edge, with a number by which the caller identifies it.
  struct Edge {
    std::uint32_t u, v;      ///< u > v
    std::uint32_t position;  ///< any number
  };

  /// Adds a generator whose value is one on a new edge and zero on all other edges.
  void add_generator(const Edge& edge) {
    scratch_.clear();
    scratch_.emplace_back(add_generator(edge.position), field_.from_int(1));
    assign(edge, intern());
  }
  /// Adds a generator whose value is zero on all edges so far. @param birth the position of the
  /// edge that gives birth to the generator.
  Generator add_generator(std::uint32_t birth) {
    births_.push_back(birth);
    if (keeps_values_) occurrences_.emplace_back();
    return static_cast<Generator>(births_.size() - 1);
  }
  std::uint32_t birth(Generator g) const { return births_[g]; }
  std::size_t living_count() const { return births_.size() - dead_.count(); }
  /// Calls `visit(generator, birth)` for the living generators, oldest first.
  template <class Visit>
  void for_each_living(Visit&& visit) const {
    for (Generator g = 0; g < births_.size(); ++g)
      if (!dead_.contains(g)) visit(g, births_[g]);
  }

  /// Returns the class of a sum of generators.
  Class class_of(std::span<const Term> sum) {
    scratch_.assign(sum.begin(), sum.end());
    dead_.eliminate_from(scratch_);
    return intern();
  }
  /// Calls `visit(edge, terms)` for each edge whose class is not zero. The terms are the vector of
  /// that class.
  template <class Visit>
  void for_each_edge(Visit&& visit);

  /// The annotation a(u,v).
  Class of(std::uint32_t u, std::uint32_t v) {
    if (edges_.degree(u) > edges_.degree(v)) return -of(v, u);
    ActiveEdges::Label* label = edges_.find(u, v);
    if (label == nullptr) return {};
    const Class a = resolve({*label / 2, *label % 2 != 0});
    if (!a.is_zero()) *label = label_of(a);  // otherwise the edge is no longer active
    return a;
  }
  /// Annotates an edge for the first time. The annotation is a(u,v), which must not be zero.
  void assign(const Edge& edge, Class a) {
    members_[a.id].push_back(edge);
    edges_.insert(edge.u, edge.v, label_of(a), label_of(-a));
  }

  /// The sum of two classes. Here and below, arguments must be classes that were returned after the
  /// last call of `kill`.
  Class sum(Class a, Class b);
  /// The coefficient of a generator in a class.
  typename K::Element value(Class a, Generator g) const {
    const Term* term = find(vectors_[a.id], g);
    if (term == nullptr) return field_.from_int(0);
    return a.negated ? field_.negate(term->coefficient()) : term->coefficient();
  }
  /// Calls `visit(generator, value)` for the generators whose coefficient in a class is not zero.
  template <class Visit>
  void for_each_generator(Class a, Visit&& visit) const {
    for (const Term& t : vectors_[a.id])
      visit(t.cell, a.negated ? field_.negate(t.coefficient()) : t.coefficient());
  }
  // mutant: youngest-generator
  Generator youngest(Class a) const { return vectors_[a.id].back().cell; }

  /// Makes a class zero: its youngest generator dies and becomes a combination of the other
  /// generators.
  void kill(Class relation);

  /// Calls `visit(edge, value)` for the edges on which a living generator is not zero. These values
  /// form a cocycle.
  template <class Visit>
  void for_each_value(Generator g, Visit&& visit);

 private:
  struct Hash {
    const Annotations* self;
    std::size_t operator()(std::uint32_t id) const { return self->hashes_[id]; }
  };
  struct Equal {
    const Annotations* self;
    bool operator()(std::uint32_t a, std::uint32_t b) const {
      const Vector &x = self->vectors_[a], &y = self->vectors_[b];
      const bool opposite = self->are_opposite(a, b);
      return std::ranges::equal(x, y, [&](const Term& s, const Term& t) {
        const auto c = opposite ? self->field_.negate(t.coefficient()) : t.coefficient();
        return s.cell == t.cell && s.coefficient() == c;
      });
    }
  };

  static constexpr std::size_t kMostClasses = INT32_MAX;  // labels use one bit for the sign
  static ActiveEdges::Label label_of(Class a) { return a.id << 1 | (a.negated ? 1U : 0U); }
  /// True if two classes that are equal up to sign have opposite signs.
  bool are_opposite(std::uint32_t a, std::uint32_t b) const {
    return vectors_[a].back().coefficient() != vectors_[b].back().coefficient();
  }
  /// The current form of a class that was returned earlier. Dead generators are substituted, and
  /// the class may have been merged into another class.
  Class resolve(Class a);
  /// Follows the links of classes that became equal to other classes. DisjointSets cannot be used,
  /// because a link has a sign.
  Class follow(Class a);
  /// Substitutes all dead generators in a class.
  void update(std::uint32_t id);
  /// Removes a class that has become zero.
  void erase(std::uint32_t id);
  /// Merges a class into another class to which it has become equal up to sign.
  void join(std::uint32_t id, std::uint32_t other);
  /// Updates occurrences_ after the terms of a class have changed. @param before the former terms
  /// of the class.
  void change_occurrences(std::uint32_t id, const Vector& before);
  /// Finds the class of the vector in scratch_. If there is no such class, makes one.
  Class intern();
  /// Makes room for one more class.
  void add_class();
  /// Removes the classes that were made since the last call and that no edge uses.
  void forget_fresh();
  /// The hash of a term. The hash of a vector is the bitwise sum (exclusive or) of the hashes of
  /// its terms, and is the same for +-a.
  std::size_t hash(const Term& t) const {
    const auto size = static_cast<std::uint64_t>(std::abs(field_.to_int(t.coefficient())));
    const std::uint64_t h = (t.cell ^ size << 32) * 0x9E3779B97F4A7C15U;
    return (h ^ h >> 29) * 0xBF58476D1CE4E5B9U;
  }
  std::size_t hash(const Vector& v) const {
    std::size_t sum = 0;
    for (const Term& t : v) sum ^= hash(t);
    return sum;
  }
  template <class T>
  static void release(T& vector) {
    T(vector.get_allocator()).swap(vector);
  }
  /// The term of a generator in v, or null if v has no such term.
  const Term* find(const Vector& v, Generator g) const {
    const auto it = std::ranges::lower_bound(v, g, {}, &Term::cell);
    return it != v.end() && it->cell == g ? &*it : nullptr;
  }

  const K& field_;
  ActiveEdges& edges_;
  const bool keeps_values_;
  std::pmr::vector<std::uint32_t> births_;            // birth of each generator
  std::pmr::vector<Vector> vectors_;                  // vector of each class
  std::pmr::vector<std::size_t> hashes_;              // hash of each class
  std::pmr::vector<std::pmr::vector<Edge>> members_;  // edges of each class
  // For each class, the class that it became, or the class itself as long as it exists.
  std::pmr::vector<Class> links_;
  std::pmr::vector<std::uint32_t> seen_;    // number of deaths substituted in each class
  std::pmr::vector<std::uint32_t> fresh_;   // classes made since the last kill
  std::pmr::vector<std::uint32_t> unused_;  // numbers of classes that may be used again
  DeadGenerators<K> dead_;
  // For each generator, the classes in which it occurs, if values are kept.
  std::pmr::vector<NumberSet> occurrences_;
  FlatMap<Class> sums_;  // sums of two classes, until the next kill
  std::pmr::unordered_set<std::uint32_t, Hash, Equal> known_;
  Vector scratch_, merged_;
};

template <Field K>
template <class Visit>
void Annotations<K>::for_each_edge(Visit&& visit) {
  for (std::uint32_t id = 1; id < vectors_.size(); ++id) {
    if (links_[id].id == id) resolve({id});  // may merge classes
  }
  for (std::uint32_t id = 1; id < vectors_.size(); ++id)
    for (const Edge& edge : members_[id]) visit(edge, std::span<const Term>(vectors_[id]));
}

template <Field K>
auto Annotations<K>::resolve(Class a) -> Class {
  a = follow(a);
  if (seen_[a.id] == dead_.count() || a.is_zero()) return a;  // mutant: class-cleaned
  update(a.id);
  return follow(a);
}

template <Field K>
auto Annotations<K>::follow(Class a) -> Class {
  while (links_[a.id].id != a.id) {
    const Class up = links_[a.id];
    const Class further = links_[up.id];
    links_[a.id] = up.negated ? -further : further;  // this halves the path
    const Class next = links_[a.id];
    a = a.negated ? -next : next;
  }
  return a;
}

template <Field K>
auto Annotations<K>::intern() -> Class {
  if (scratch_.empty()) return {};
  if (unused_.empty()) add_class();
  const std::uint32_t fresh = unused_.back();
  vectors_[fresh].assign(scratch_.begin(), scratch_.end());
  hashes_[fresh] = hash(scratch_);
  const auto [it, is_new] = known_.insert(fresh);
  if (!is_new) return {*it, are_opposite(fresh, *it)};
  unused_.pop_back();
  links_[fresh] = {fresh, false};
  seen_[fresh] = dead_.count();
  fresh_.push_back(fresh);
  change_occurrences(fresh, {});
  return {fresh, false};
}

template <Field K>
void Annotations<K>::add_class() {
  if (vectors_.size() > kMostClasses)
    throw Error(ErrorKind::resource, "too many classes of edges are alive; lower the threshold");
  unused_.push_back(static_cast<std::uint32_t>(vectors_.size()));
  vectors_.emplace_back();
  hashes_.push_back(0);
  members_.emplace_back();
  links_.push_back({});
  seen_.push_back(0);
}

template <Field K>
void Annotations<K>::forget_fresh() {
  for (const std::uint32_t id : fresh_) {
    if (links_[id].id != id || !members_[id].empty()) continue;  // mutant: sums-in-use
    known_.erase(id);
    scratch_.assign(vectors_[id].begin(), vectors_[id].end());
    vectors_[id].clear();
    change_occurrences(id, scratch_);  // mutant: sums-unused
    unused_.push_back(id);
  }
  fresh_.clear();
}

template <Field K>
void Annotations<K>::update(std::uint32_t id) {
  seen_[id] = dead_.count();
  Vector& vector = vectors_[id];
  if (!dead_.occur_in(vector)) return;
  auto node = known_.extract(id);
  if constexpr (std::same_as<K, Z2>) {
    dead_.eliminate_from(vector);  // a death changes all occurrences at once
  } else {
    if (keeps_values_) scratch_.assign(vector.begin(), vector.end());
    dead_.eliminate_from(vector);
    change_occurrences(id, scratch_);
  }
  hashes_[id] = hash(vector);
  if (vector.empty())
    erase(id);
  else if (const auto met = known_.insert(std::move(node)); !met.inserted)
    join(id, *met.position);
}

template <Field K>
void Annotations<K>::erase(std::uint32_t id) {
  links_[id] = {};
  for (const Edge& edge : members_[id]) edges_.erase(edge.u, edge.v);
  release(members_[id]);
}

template <Field K>
void Annotations<K>::join(std::uint32_t id, std::uint32_t other) {
  links_[id] = {other, are_opposite(id, other)};  // mutant: equal-classes
  auto &from = members_[id], &to = members_[other];
  if (to.size() < from.size()) to.swap(from);
  to.insert(to.end(), from.begin(), from.end());
  release(from);
  scratch_.assign(vectors_[id].begin(), vectors_[id].end());
  release(vectors_[id]);
  change_occurrences(id, scratch_);
}

template <Field K>
void Annotations<K>::change_occurrences(std::uint32_t id, const Vector& before) {
  if (!keeps_values_) return;
  const Vector& now = vectors_[id];
  const auto differ = [](const Vector& a, const Vector& b, auto&& use) {
    auto y = b.begin();
    for (const Term& x : a) {
      while (y != b.end() && y->cell < x.cell) ++y;
      if (y == b.end() || y->cell != x.cell) use(x.cell);
    }
  };
  differ(now, before, [&](Generator g) { occurrences_[g].insert(id); });
  differ(before, now, [&](Generator g) {
    if (!dead_.contains(g)) occurrences_[g].erase(id);  // mutant: occurrence-erased
  });
}

template <Field K>
auto Annotations<K>::sum(Class a, Class b) -> Class {
  if (a.is_zero()) return b;
  if (b.is_zero()) return a;
  if (a == -b) return {};
  if (a.id > b.id) std::swap(a, b);
  const bool flipped = a.negated;
  if (flipped) {
    a = -a;
    b = -b;
  }
  const std::uint64_t pair = std::uint64_t{a.id} << 32 | label_of(b);
  const auto [sum, is_new] = sums_.try_emplace(pair);
  if (is_new) {
    scratch_.assign(vectors_[a.id].begin(), vectors_[a.id].end());
    add_sorted_terms(scratch_, vectors_[b.id], field_.from_int(b.negated ? -1 : 1), field_,
                     merged_);
    *sum = intern();
  }
  return flipped ? -*sum : *sum;
}

template <Field K>
void Annotations<K>::kill(Class relation) {
  const std::uint32_t id = relation.id;
  const Generator g = youngest(relation);
  sums_.clear();
  known_.erase(id);
  if (members_[id].empty()) unused_.push_back(id);
  erase(id);
  forget_fresh();
  scratch_.assign(vectors_[id].begin(), vectors_[id].end());
  dead_.add(scratch_);
  release(vectors_[id]);
  if (!keeps_values_) return;
  const NumberSet occurrences = std::move(occurrences_[g]);
  if constexpr (std::same_as<K, Z2>) {
    for (const Term& t : scratch_)
      if (t.cell != g) occurrences_[t.cell].add(occurrences);  // mutant: occurrence-added
  } else {
    change_occurrences(id, scratch_);
  }
  occurrences.for_each([&](std::uint32_t other) {
    if (other != id) update(other);
  });
}

template <Field K>
template <class Visit>
void Annotations<K>::for_each_value(Generator g, Visit&& visit) {
  occurrences_[g].for_each([&](std::uint32_t id) {
    const Term* term = find(vectors_[id], g);
    for (const Edge& edge : members_[id]) {
      const bool negated = of(edge.u, edge.v).negated;
      visit(edge, negated ? field_.negate(term->coefficient()) : term->coefficient());
    }
  });
}

}  // namespace ph
