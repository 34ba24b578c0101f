// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <compare>
#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <variant>
#include <vector>

#include "ph/core/cubical_image.hpp"

namespace ph {

/// The numbers of an image, stored as they came: a byte stays a byte. Read as doubles. Copies share
/// the numbers; whoever changes them gets numbers of his own.
class Voxels {
  using Storage = std::variant<std::vector<std::uint8_t>, std::vector<std::uint16_t>,
                               std::vector<std::int16_t>, std::vector<float>, std::vector<double>>;

 public:
  Voxels() : Voxels(std::vector<double>()) {}
  /// Of std::uint8_t, std::uint16_t, std::int16_t, float or double.
  template <class T>
  Voxels(std::vector<T> numbers) : storage_(std::make_shared<Storage>(std::move(numbers))) {}
  Voxels(std::initializer_list<double> numbers) : Voxels(std::vector<double>(numbers)) {}

  VoxelType type() const { return static_cast<VoxelType>(storage_->index()); }
  const void* data() const {
    return std::visit([](const auto& all) -> const void* { return all.data(); }, *storage_);
  }
  std::size_t size() const {
    return std::visit([](const auto& all) { return all.size(); }, *storage_);
  }
  bool empty() const { return size() == 0; }
  std::size_t bytes() const {
    return std::visit([](const auto& all) { return all.size() * sizeof(all[0]); }, *storage_);
  }
  double operator[](std::size_t i) const {
    return std::visit([i](const auto& all) { return static_cast<double>(all[i]); }, *storage_);
  }
  std::vector<double> doubles() const {
    return std::visit([](const auto& all) { return std::vector<double>(all.begin(), all.end()); },
                      *storage_);
  }
  double front() const { return (*this)[0]; }
  double back() const { return (*this)[size() - 1]; }

  /// Calls `use(std::vector<T>&)` with the numbers, for the type T that they have, to change them.
  template <class Use>
  void change(Use&& use) {
    if (storage_.use_count() > 1) storage_ = std::make_shared<Storage>(*storage_);
    std::visit(use, *storage_);
  }

  /// Gives doubles.
  class Iterator {
   public:
    using iterator_category = std::input_iterator_tag;
    using value_type = double;
    using difference_type = std::ptrdiff_t;
    using pointer = const double*;
    using reference = double;

    Iterator() = default;
    Iterator(const Voxels& voxels, std::size_t at) : voxels_(&voxels), at_(at) {}
    double operator*() const { return (*voxels_)[at_]; }
    Iterator& operator++() {
      ++at_;
      return *this;
    }
    Iterator operator++(int) {
      const Iterator before = *this;
      ++at_;
      return before;
    }
    friend bool operator==(const Iterator& a, const Iterator& b) { return a.at_ == b.at_; }

   private:
    const Voxels* voxels_ = nullptr;
    std::size_t at_ = 0;
  };
  Iterator begin() const { return {*this, 0}; }
  Iterator end() const { return {*this, size()}; }

  friend bool operator==(const Voxels& a, const Voxels& b) {
    return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin());
  }

 private:
  std::shared_ptr<Storage> storage_;
};

/// A dense array of any dimension: `extents[k]` voxels along axis k, the last axis fastest (C
/// order). The axes are those of the input file.
struct Image {
  std::vector<Index> extents;
  Voxels values;

  int dim() const { return static_cast<int>(extents.size()); }
};

}  // namespace ph
