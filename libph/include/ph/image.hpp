// SPDX-License-Identifier: MIT
#pragma once
#include <atomic>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "ph/detail/image/cubical_image.hpp"

namespace ph {

/// The types that the numbers of an image may have: the types that VoxelType names.
template <class T>
concept VoxelNumber = std::same_as<T, std::uint8_t> || std::same_as<T, std::uint16_t> ||
    std::same_as<T, std::int16_t> || std::same_as<T, float> || std::same_as<T, double>;

/// Numbers of an image that are used in place: in the caller's array, or in a mapped file.
struct BorrowedVoxels {
  VoxelType type;
  const void* data;  ///< the first number, aligned; the others follow
  std::size_t count;
  /// Keeps the memory alive until the last copy of this object is destroyed; if null, the caller
  /// must keep it alive for that long.
  std::shared_ptr<const void> owner = nullptr;
  /// True if the numbers lie in a mapped file: the system may then drop numbers from memory and
  /// read them again from the file (ph/detail/core/file_pages.hpp). Numbers of an array would be
  /// lost in this way.
  bool is_file = false;
};

/// The numbers of an image, stored in their original type: a byte stays a byte. They are read as
/// doubles. Copies share the numbers; changing a copy gives it numbers of its own. Each thread may
/// use its own copy as if nothing were shared. A moved-from object is empty.
class Voxels {
  using Numbers =
      std::variant<std::vector<std::uint8_t>, std::vector<std::uint16_t>, std::vector<std::int16_t>,
                   std::vector<float>, std::vector<double>, BorrowedVoxels>;
  /// The part that copies share. The last owner changes the numbers in place. All other threads
  /// must have finished reading by then. An acquiring load of this counter guarantees this, but
  /// std::shared_ptr::use_count() does not.
  struct Shared {
    Numbers numbers;
    std::atomic<std::size_t> owners{1};
  };

  template <class Use>
  decltype(auto) visit(Use&& use) const {
    return with_voxels(type(), data(), [&]<class T>(const T* first) {
      return use(std::span<const T>(first, size()));
    });
  }

 public:
  Voxels() = default;
  template <VoxelNumber T>
  Voxels(std::vector<T> numbers) : shared_(new Shared{std::move(numbers)}) {}
  explicit Voxels(BorrowedVoxels numbers) : shared_(new Shared{std::move(numbers)}) {}
  Voxels(std::initializer_list<double> numbers) : Voxels(std::vector<double>(numbers)) {}
  Voxels(const Voxels& other) noexcept : shared_(other.shared_) {
    if (shared_ != nullptr) shared_->owners.fetch_add(1, std::memory_order_relaxed);
  }
  Voxels(Voxels&& other) noexcept : shared_(std::exchange(other.shared_, nullptr)) {}
  Voxels& operator=(Voxels other) noexcept {
    std::swap(shared_, other.shared_);
    return *this;
  }
  ~Voxels() {
    if (shared_ != nullptr && shared_->owners.fetch_sub(1, std::memory_order_acq_rel) == 1)
      delete shared_;
  }

  VoxelType type() const {
    if (shared_ == nullptr) return VoxelType::float64;
    const BorrowedVoxels* borrowed = this->borrowed();
    return borrowed != nullptr ? borrowed->type : static_cast<VoxelType>(shared_->numbers.index());
  }
  /// The first number, of the type that type() names; the others follow. If there are no numbers,
  /// the pointer may be null and must not be read.
  const void* data() const {
    if (shared_ == nullptr) return nullptr;
    return std::visit([](const auto& all) { return data_of(all); }, shared_->numbers);
  }
  std::size_t size() const {
    if (shared_ == nullptr) return 0;
    return std::visit([](const auto& all) { return size_of(all); }, shared_->numbers);
  }
  bool empty() const { return size() == 0; }
  /// True if the numbers stay in a file: they take memory only while they are read.
  bool is_in_file() const { return is_borrowed() && borrowed()->is_file; }
  /// True if the numbers are used in place, see BorrowedVoxels.
  bool is_borrowed() const { return borrowed() != nullptr; }
  /// Memory that the numbers take; borrowed numbers take none.
  std::size_t bytes() const { return is_borrowed() ? 0 : size() * bytes_of(type()); }
  /// Precondition: i < size().
  double operator[](std::size_t i) const {
    return with_voxels(type(), data(),
                       [i](const auto* first) { return static_cast<double>(first[i]); });
  }
  /// A copy of the numbers as doubles, 8 bytes each.
  std::vector<double> doubles() const;
  /// Precondition: !empty().
  double front() const { return (*this)[0]; }
  /// Precondition: !empty().
  double back() const { return (*this)[size() - 1]; }

  /// Calls `use(std::vector<T>&)`, which may change the numbers; T is their type. Copies the
  /// numbers first if they are shared or borrowed.
  template <class Use>
  void change(Use&& use) {
    if (shared_ == nullptr)
      *this = Voxels(std::vector<double>());
    else if (is_borrowed() || shared_->owners.load(std::memory_order_acquire) > 1)
      *this = visit([]<class T>(std::span<const T> all) {
        return Voxels(std::vector<T>(all.begin(), all.end()));
      });
    std::visit(
        [&]<class All>(All& all) {
          if constexpr (!std::same_as<All, BorrowedVoxels>) use(all);
        },
        shared_->numbers);
  }

  /// Iterates over the numbers as doubles.
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

  friend bool operator==(const Voxels& a, const Voxels& b);

 private:
  const BorrowedVoxels* borrowed() const {
    return shared_ == nullptr ? nullptr : std::get_if<BorrowedVoxels>(&shared_->numbers);
  }
  template <class T>
  static const void* data_of(const std::vector<T>& all) {
    return all.data();
  }
  static const void* data_of(const BorrowedVoxels& all) { return all.data; }
  template <class T>
  static std::size_t size_of(const std::vector<T>& all) {
    return all.size();
  }
  static std::size_t size_of(const BorrowedVoxels& all) { return all.count; }

  template <VoxelType named, class T>
  static constexpr bool kStores =
      std::same_as<std::variant_alternative_t<static_cast<std::size_t>(named), Numbers>,
                   std::vector<T>>;
  static_assert(kStores<VoxelType::uint8, std::uint8_t> &&
                    kStores<VoxelType::uint16, std::uint16_t> &&
                    kStores<VoxelType::int16, std::int16_t> && kStores<VoxelType::float32, float> &&
                    kStores<VoxelType::float64, double>,
                "type() is the place of the alternative");

  Shared* shared_ = nullptr;  // null if there are no numbers
};

/// A dense array of any dimension: `extents[k]` voxels along axis k, the last axis fastest (C
/// order). The axes are the axes of the input file.
struct Image {
  std::vector<Index> extents;
  Voxels values;
  /// True if NaN marks an absent voxel, which never enters, in sublevel and in superlevel sets. An
  /// infinite value cannot be such a mark, because its sign would decide whether the voxel enters
  /// first or never. Without a mask, NaN is an error.
  bool masked = false;

  int dim() const { return static_cast<int>(extents.size()); }
};

/// An image made from an array in memory, which may have any layout: voxel (i, j, …) is data[i *
/// strides[0] + j * strides[1] + …]. The array is borrowed if it is in C order without gaps;
/// otherwise it is copied, in its own type. The caller must not change borrowed numbers as long as
/// there is a copy of the image, or a Cubical made from it.
/// @param strides one per axis, negative ones allowed; if empty, C order without gaps.
/// @param owner keeps the array alive; if null, the caller must keep it alive.
/// @throws Error (usage) on a negative extent, if there is not one stride per axis, or on more
/// voxels than std::size_t can count.
Image image_of_array(VoxelType type, const void* data, std::vector<Index> extents,
                     std::span<const std::ptrdiff_t> strides = {},
                     std::shared_ptr<const void> owner = nullptr);

}  // namespace ph
