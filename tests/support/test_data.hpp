// SPDX-License-Identifier: MIT
#pragma once
#include <filesystem>
#include <string>

#ifndef PH_TEST_DATA
#define PH_TEST_DATA ""
#endif

namespace ph::test {

/// The path of a folder of the optional test data (docs/development/test-data.md); empty if the
/// folder does not exist.
inline std::filesystem::path test_data(const std::string& folder) {
  const std::filesystem::path root = PH_TEST_DATA;
  if (root.empty() || !std::filesystem::is_directory(root / folder)) return {};
  return root / folder;
}

/// The reason for skipping a test that needs this folder.
inline std::string no_test_data(const std::string& folder) {
  return "skipped: PH_TEST_DATA, which is \"" PH_TEST_DATA "\", has no folder " + folder;
}

}  // namespace ph::test
