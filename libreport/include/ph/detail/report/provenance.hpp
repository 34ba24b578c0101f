// SPDX-License-Identifier: MIT
#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ph/io/write.hpp"

namespace ph::report {

/// A function that receives the text of a page, piece by piece: into a file or a string.
using Sink = std::function<void(std::string_view)>;

/// A title for a page: the path of its data, without the folders.
std::string title_of(const std::string& path);

/// The origin of the contents of a page. Empty texts and lists are left out.
struct Provenance {
  std::vector<std::string> command;
  std::string sha256;        ///< hash of the input
  BarcodeInfo run;           ///< program, input, complex, engine, timings …
  bool has_homology = true;  ///< true if field, dimension and threshold of `run` have a meaning
  std::vector<std::string> warnings = {};
  std::vector<std::pair<std::string, std::string>> notes = {};  ///< further notes
};

}  // namespace ph::report
