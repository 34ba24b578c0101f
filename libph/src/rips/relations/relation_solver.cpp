// SPDX-License-Identifier: MIT
#include "libph/src/rips/relations/relation_solver.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace ph {
namespace {

// The approximate number of bytes that a solver needs.
double bytes(std::size_t vertices) {
  constexpr double a_pair = 28;  // measured with random distances
  const auto n = static_cast<double>(vertices);
  return a_pair * n * n;
}

double most_bytes(const MemoryBudget& memory) {
  constexpr double most = 1 << 29, share = 0.25;  // bytes, and the share of the remaining memory
  return std::min(most, share * static_cast<double>(memory.left()));
}

// True if there are so few vertices that memory is allocated in one block. For more vertices,
// memory that is no longer needed must be freed earlier.
bool is_few(std::size_t vertices) { return vertices <= 700; }
std::size_t part_bytes(std::size_t vertices) {
  constexpr std::size_t line = 64;
  return (is_few(vertices) ? static_cast<std::size_t>(bytes(vertices)) / 2 / line + 1 : 1) * line;
}

}  // namespace

RelationSolver::RelationSolver(std::size_t vertices, Annotations<Z2>& annotations,
                               SweepObserver<Z2>& observer, const SweepTuning& tuning,
                               MemoryBudget& memory)
    : block_(2 * part_bytes(vertices), &memory),
      kept_part_(block_.allocate(part_bytes(vertices)), part_bytes(vertices), &memory),
      lent_part_(block_.allocate(part_bytes(vertices)), part_bytes(vertices), &memory),
      kept_(is_few(vertices) ? static_cast<std::pmr::memory_resource*>(&kept_part_) : &memory),
      lent_(is_few(vertices) ? static_cast<std::pmr::memory_resource*>(&lent_part_) : &memory),
      observer_(observer),
      tuning_(tuning),
      memory_(memory),
      sums_(vertices, kept_),
      edges_(kept_),
      births_(kept_),
      lists_(std::make_unique<FormalSums>(lent_)),
      deaths_(kept_) {
  std::pmr::vector<Generator> numbers(&memory), sum(&memory);
  annotations.for_each_living([&](Generator g, Position birth) {
    numbers.resize(g + 1);
    numbers[g] = static_cast<Generator>(living_++);
    births_.push_back(birth);
  });
  annotations.for_each_edge([&](const Edge& edge, const auto& terms) {
    sum.clear();
    for (const auto& t : terms) sum.push_back(numbers[t.cell]);
    assign(edge, lists_->insert(sum));
  });
}

bool RelationSolver::fits(std::size_t vertices, const MemoryBudget& memory) {
  return bytes(vertices) <= most_bytes(memory);
}

void RelationSolver::give_birth(const Edge& edge) {
  const auto g = static_cast<Generator>(births_.size());
  births_.push_back(edge.position);
  ++living_;
  assign(edge, has_rows() ? rows_->append_generator() : lists_->insert({&g, 1}));
}

void RelationSolver::prefetch(Vertex u, Vertex v, std::span<const bits::Word> link) const {
  bits::for_each(link.data(), 0, link.size(), [&](std::size_t w) {
    sums_.prefetch(u, static_cast<Vertex>(w));
    sums_.prefetch(v, static_cast<Vertex>(w));
  });
}

bool RelationSolver::annotate(const Edge& edge, std::span<const Vertex> roots) {
  if (has_rows()) {
    constexpr std::size_t line = 8;  // words
    for (const Vertex w : roots)
      for (const Sum a : {sums_(edge.u, w), sums_(edge.v, w)})
        for (std::size_t k = 0; k < rows_->words(); k += line) __builtin_prefetch((*rows_)[a] + k);
  }
  const Sum a = sums_(edge.u, roots.front()), b = sums_(edge.v, roots.front());
  for (const Vertex w : roots.subspan(1)) {  // mutant: formal-relations
    const std::array<Sum, 4> relation{sums_(edge.u, w), sums_(edge.v, w), a, b};
    const Triangle death{edge.position, w};
    if (has_rows()) {
      if (rows_->add_relation(relation)) deaths_.push_back(death);
    } else if (const Generator g = lists_->add_relation(relation); g != EchelonRelations::kNone) {
      report_death(g, death);
    }
  }
  if (a == 0 || b == 0)
    assign(edge, a | b);
  else if (a != b)
    assign(edge, has_rows() ? rows_->add(a, b) : lists_->add(a, b));
  return solve_if_due();
}

void RelationSolver::assign(const Edge& edge, Sum a) {
  if (a == 0) return;
  edges_.push_back(edge);
  sums_.set(edge.u, edge.v, a);
}

void RelationSolver::report_death(Generator g, Triangle death) {
  --living_;
  observer_.on_death(births_[g], death, {});
}

bool RelationSolver::solve_if_due() {
  if (has_rows()) {
    const std::size_t enough =
        std::max(tuning_.relations_for_formal, 4 * rows_->matrix().living_count());
    if (deaths_.size() < enough) return true;
    if (!solve()) return false;
  } else {
    // This factor was found by measurement. If lists are turned into rows earlier, the rows are
    // longer. If they are turned into rows later, more relations are checked needlessly.
    if (5 * lists_->relations().dead_count() <= 4 * births_.size()) return true;
    const auto vectors = static_cast<double>(births_.size() + 2 * sum_count());
    if (vectors * static_cast<double>(living_) / 8 > most_bytes(memory_)) return true;
    make_rows();
  }
  return 2 * living_ > tuning_.classes_for_formal;
}

bool RelationSolver::solve() {
  const std::size_t before = living_;
  const auto killed = rows_->solve();
  for (std::size_t i = 0; i < killed.size(); ++i)
    if (killed[i] != RelationMatrix::kNone) report_death(killed[i], deaths_[i]);
  deaths_.clear();
  // The number of additions per row above which substitution is worthwhile.
  constexpr std::size_t many = 4;
  if (rows_->matrix().additions() > many * births_.size()) make_rows();
  return living_ != before;
}

void RelationSolver::make_rows() {
  const std::size_t sums = sum_count(), generators = births_.size();
  const std::size_t words = SumRows::words_for(living_);
  std::pmr::vector<SumRows::Word> rows(kept_);
  // The reserve leaves room for about as many new sums.
  rows.reserve(2 * sums * words);
  rows.resize(sums * words, 0);
  {
    std::pmr::vector<SumRows::Word> meanings(generators * words, 0, lent_);
    std::size_t living = 0;
    for (Generator g = 0; g < generators; ++g) {
      if (is_dead(g)) continue;
      meanings[g * words + living / 64] |= SumRows::Word{1} << (living % 64);
      births_[living++] = births_[g];
    }
    if (has_rows())
      rows_->matrix().substitute(meanings.data(), words);
    else
      lists_->relations().substitute(meanings.data(), generators, words);
    for (Sum a = 0; a < sums; ++a) {
      const auto add = [to = rows.data() + a * words, &meanings, words](std::size_t g) {
        for (std::size_t k = 0; k < words; ++k) to[k] ^= meanings[g * words + k];
      };
      if (has_rows())
        bits::for_each((*rows_)[a], 0, rows_->words(), add);
      else
        std::ranges::for_each((*lists_)[a], add);
    }
    births_.resize(living);
  }
  if (!has_rows()) {
    lists_.reset();
    lent_part_.release();
  }
  rows_ = std::make_unique<SumRows>(births_.size(), std::move(rows), lent_);
}

void RelationSolver::hand_over(Annotations<Z2>& annotations) {
  make_rows();
  for (const Position birth : births_) annotations.add_generator(birth);
  std::pmr::vector<Annotations<Z2>::Term> terms(&memory_);
  for (const Edge& edge : edges_) {
    terms.clear();
    bits::for_each((*rows_)[sums_(edge.u, edge.v)], 0, rows_->words(), [&](std::size_t g) {
      terms.emplace_back(static_cast<Generator>(g), Z2::from_int(1));
    });
    // mutant: formal-classes
    if (!terms.empty()) annotations.assign(edge, annotations.class_of(terms));
  }
}

void RelationSolver::finish() {
  if (has_rows()) solve();
  for (Generator g = 0; g < births_.size(); ++g)
    if (!is_dead(g)) observer_.on_essential(births_[g], {});
}

}  // namespace ph
