// SPDX-License-Identifier: MIT
// Connects libFuzzer to the table of targets. The program's own name selects the target:
// fuzz_points runs `points`. `fuzz --targets` lists the targets, and `fuzz --help-of TARGET` prints
// the help of the program whose command line the target tests.
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "tests/fuzz/targets.hpp"

namespace {
const ph::fuzz::Target* target = nullptr;
}

// Limits two features of the address sanitizer. Most inputs end in an exception, and for exceptions
// the full features would take most of the time.
extern "C" const char* __asan_default_options() {
  return "detect_stack_use_after_return=0:malloc_context_size=4";
}

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  if (*argc == 2 && std::string_view((*argv)[1]) == "--targets") {
    for (const auto& known : ph::fuzz::targets()) std::puts(known.name.c_str());
    std::exit(0);
  }
  if (*argc == 3 && std::string_view((*argv)[1]) == "--help-of") {
    std::puts(ph::fuzz::help_of((*argv)[2]).c_str());
    std::exit(0);
  }
  const std::string_view path = **argv;
  constexpr std::string_view kPrefix = "fuzz_";
  std::string_view name = path.substr(path.rfind('/') + 1);
  if (name.starts_with(kPrefix)) name.remove_prefix(kPrefix.size());
  target = ph::fuzz::find_target(name);
  if (target == nullptr) {
    std::fprintf(stderr, "no target %s\n", std::string(name).c_str());
    std::exit(64);
  }
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  target->run({reinterpret_cast<const char*>(data), size});
  return 0;
}
