// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ph/barcode.hpp"

namespace ph::barcode {

/// The barcodes of some of several inputs, computed separately from the other inputs.
class InputsPart {
 public:
  /// The facts that all parts share.
  struct Whole {
    std::vector<std::string> inputs, options;  ///< the options as they were typed
    int parts = 1;
    friend bool operator==(const Whole&, const Whole&) = default;
  };
  struct Result {
    std::size_t input = 0;  ///< the number of the input
    /// Of the files that were read for the input; 0 if one of them is no regular file.
    std::uint64_t fingerprint = 0;
    int code = 0;         ///< the exit code of the program for this input
    std::string failure;  ///< the reason if the input failed; empty otherwise
    Barcode bars;
  };

  InputsPart(Whole whole, int part) : whole_(std::move(whole)), numbers_{part} {}

  const Whole& whole() const { return whole_; }
  /// The parts that this object contains, ascending.
  std::span<const int> numbers() const { return numbers_; }
  bool is_whole() const { return numbers_.size() == static_cast<std::size_t>(whole_.parts); }
  /// The results, sorted by the number of the input.
  std::span<const Result> results() const { return results_; }
  /// The number of the part that an input belongs to. Consecutive inputs are often alike, and are
  /// therefore assigned to different parts in turn.
  static int part_of(std::size_t input, int parts) {
    return static_cast<int>(input % static_cast<std::size_t>(parts));
  }

  /// Results must be added in ascending order of their inputs.
  void add(Result result) { results_.push_back(std::move(result)); }
  /// @throws Error (bad_data) if the other part has different inputs or options, or if both objects
  /// contain the same part. In this case, this object stays unchanged.
  void join(InputsPart other);

  std::vector<std::byte> bytes() const;
  /// @throws Error (bad_data) on bytes that `bytes` did not write.
  static InputsPart of_bytes(std::span<const std::byte> bytes);

 private:
  Whole whole_;
  std::vector<int> numbers_;
  std::vector<Result> results_;
};

/// The name of this kind of part (see ph/detail/core/sealed_part.hpp).
inline constexpr std::string_view kInputsKind = "inputs";

}  // namespace ph::barcode
