// SPDX-License-Identifier: MIT
// fuzz_replay CORPUS SAMPLES: runs the files in CORPUS/<target>/ through their targets, as
// libFuzzer does. Also runs each sample through all targets, because for the other formats it is a
// damaged file. Prints the number of runs, and exits with 1 if a property does not hold.
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

#include "tests/fuzz/targets.hpp"

namespace {

namespace fs = std::filesystem;

std::string bytes_of(const fs::path& path) {
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return bytes.str();
}

/// Runs files through targets and reports failures.
class Replay {
 public:
  void run(const ph::fuzz::Target& target, const fs::path& file) {
    ++runs_;
    try {
      target.run(bytes_of(file));
    } catch (const std::exception& error) {
      fail(file.string() + " as " + target.name + ": " + error.what());
    }
  }
  void fail(const std::string& what) {
    std::cout << what << "\n";
    ++failures_;
  }
  int finish() const {
    std::cout << runs_ << " runs, " << failures_ << " failures\n";
    return failures_ == 0 && runs_ > 0 ? 0 : 1;
  }

 private:
  int runs_ = 0, failures_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: fuzz_replay CORPUS SAMPLES\n";
    return 64;
  }
  Replay replay;
  for (const auto& folder : fs::directory_iterator(argv[1])) {
    const ph::fuzz::Target* target = ph::fuzz::find_target(folder.path().filename().string());
    if (target == nullptr) {
      replay.fail(folder.path().string() + ": no such target");
      continue;
    }
    for (const auto& file : fs::directory_iterator(folder.path())) replay.run(*target, file);
  }
  for (const auto& file : fs::recursive_directory_iterator(argv[2])) {
    if (!file.is_regular_file()) continue;
    for (const ph::fuzz::Target& target : ph::fuzz::targets()) replay.run(target, file);
  }
  return replay.finish();
}
