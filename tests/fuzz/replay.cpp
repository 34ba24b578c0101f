// SPDX-License-Identifier: MIT
// fuzz_replay SEEDS SAMPLES: runs the files in SEEDS/<target>/ and SAMPLES/<reader>/ through their
// targets, as libFuzzer does, and prints how many it were. Exits 1 if a property does not hold.
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

#include "targets.hpp"

namespace {

namespace fs = std::filesystem;

std::string bytes_of(const fs::path& path) {
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return bytes.str();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "usage: fuzz_replay FOLDER…, with a folder for each target\n";
    return 64;
  }
  int inputs = 0, folders = 0, failures = 0;
  for (int i = 1; i < argc; ++i) {
    for (const auto& folder : fs::directory_iterator(argv[i])) {
      if (!folder.is_directory()) continue;
      const ph::fuzz::Target* target = ph::fuzz::find_target(folder.path().filename().string());
      if (target == nullptr) {
        std::cout << folder.path() << ": no such target\n";
        ++failures;
        continue;
      }
      ++folders;
      for (const auto& file : fs::directory_iterator(folder.path())) {
        ++inputs;
        try {
          target->run(bytes_of(file.path()));
        } catch (const std::exception& error) {
          std::cout << file.path() << ": " << error.what() << "\n";
          ++failures;
        }
      }
    }
  }
  std::cout << inputs << " inputs in " << folders << " folders, " << failures << " failures\n";
  return failures == 0 && inputs > 0 ? 0 : 1;
}
