// SPDX-License-Identifier: MIT
#include "rips/relations/formal_annotations.hpp"

#include <algorithm>
#include <utility>

namespace ph {
namespace {

std::size_t arena_bytes(std::size_t vertices) {
  constexpr std::size_t few = 700;  // for more, what is outgrown must be given back
  return vertices > few ? 0 : static_cast<std::size_t>(FormalAnnotations::bytes(vertices));
}

}  // namespace

FormalAnnotations::FormalAnnotations(std::size_t vertices, std::size_t together,
                                     std::pmr::memory_resource* memory)
    : arena_(arena_bytes(vertices), memory),
      together_(together),
      labels_(vertices, arena_.kept()),
      edges_(arena_.kept()),
      births_(arena_.kept()),
      sums_(std::make_unique<FormalSums>(arena_.lent())),
      deaths_(arena_.kept()) {}

double FormalAnnotations::bytes(std::size_t vertices) {
  constexpr double a_pair = 28;  // measured with random distances
  const auto n = static_cast<double>(vertices);
  return a_pair * n * n;
}

auto FormalAnnotations::add_generator(Position birth) -> Generator {
  births_.push_back(birth);
  return static_cast<Generator>(births_.size() - 1);
}

void FormalAnnotations::give_birth(const Edge& edge) {
  const Generator g = add_generator(edge.position);
  assign(edge, has_rows() ? rows_->append_generator() : sums_->insert({&g, 1}));
}

auto FormalAnnotations::sum(Path path) -> Class {
  const auto [a, b] = path;
  if (a == 0 || b == 0) return a | b;
  if (a == b) return 0;
  return has_rows() ? rows_->add(a, b) : sums_->add(a, b);
}

void FormalAnnotations::assign(const Edge& edge, Class a) {
  if (a == 0) return;
  edges_.push_back(edge);
  labels_.set(edge.u, edge.v, a);
}

void FormalAnnotations::prefetch(Path path) const {
  constexpr std::size_t line = 8;  // words
  if (!has_rows()) return;
  for (const Class a : {path.first, path.second})
    for (std::size_t k = 0; k < rows_->words(); k += line) __builtin_prefetch((*rows_)[a] + k);
}

bool FormalAnnotations::is_due() const {
  // Measured: sooner, and rows are longer; later, and more relations are looked at for nothing.
  if (!has_rows()) return 5 * sums_->relations().dead_count() > 4 * births_.size();
  return deaths_.size() >= std::max(together_, 4 * living_count());
}

double FormalAnnotations::bytes_to_solve() const {
  if (has_rows()) return RelationMatrix::bytes(births_.size(), deaths_.size());
  const auto generators = static_cast<double>(births_.size() + 2 * class_count());
  return generators * static_cast<double>(living_count()) / 8;
}

void FormalAnnotations::make_rows() {
  using Word = SumRows::Word;
  const std::size_t classes = class_count(), generators = births_.size();
  const std::size_t words = SumRows::words_for(living_count());
  std::pmr::vector<Word> rows(arena_.kept());
  rows.reserve(2 * classes * words);  // about as many are to come
  rows.resize(classes * words, 0);
  {
    std::pmr::vector<Word> meanings(generators * words, 0, arena_.lent());
    std::size_t living = 0;
    for (Generator g = 0; g < generators; ++g) {
      if (is_dead(g)) continue;
      meanings[g * words + living / 64] |= Word{1} << (living % 64);
      births_[living++] = births_[g];
    }
    if (has_rows())
      rows_->matrix().substitute(meanings.data(), words);
    else
      sums_->relations().substitute(meanings.data(), generators, words);
    for (Class a = 0; a < classes; ++a) {
      const auto add = [to = rows.data() + a * words, &meanings, words](std::size_t g) {
        for (std::size_t k = 0; k < words; ++k) to[k] ^= meanings[g * words + k];
      };
      if (has_rows())
        bits::for_each((*rows_)[a], 0, rows_->words(), add);
      else
        std::ranges::for_each((*sums_)[a], add);
    }
    births_.resize(living);
  }
  if (!has_rows()) {
    sums_.reset();
    arena_.take_back();
  }
  rows_ = std::make_unique<SumRows>(births_.size(), std::move(rows), arena_.lent());
}

}  // namespace ph
