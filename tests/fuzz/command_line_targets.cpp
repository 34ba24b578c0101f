// SPDX-License-Identifier: MIT
// For any words on a command line, the program must return options, an answer, or an error that
// says what is wrong with the words.
#include <array>
#include <vector>

#include "apps/barcode/arguments/arguments.hpp"
#include "apps/cluster/arguments/arguments.hpp"
#include "apps/distance/arguments/arguments.hpp"
#include "apps/segment/arguments/arguments.hpp"
#include "apps/vectorise/arguments/arguments.hpp"
#include "tests/fuzz/targets.hpp"
#include "tests/fuzz/violation.hpp"

namespace ph::fuzz {
namespace {

/// The lines of a text as command-line arguments. As on a real command line, no argument contains a
/// NUL byte.
std::vector<std::string> words_of(std::string_view bytes, const char* program) {
  std::vector<std::string> words{program};
  while (!bytes.empty()) {
    const std::size_t end = bytes.find('\n');
    words.emplace_back(bytes.substr(0, end));
    words.back().resize(words.back().find('\0') == std::string::npos ? words.back().size()
                                                                     : words.back().find('\0'));
    bytes.remove_prefix(end == std::string_view::npos ? bytes.size() : end + 1);
  }
  return words;
}

template <class Arguments>
void check(const std::vector<std::string>& words,
           std::optional<std::string> (*parse)(int, const char* const*, Arguments&)) {
  std::vector<const char*> argv;
  for (const std::string& word : words) argv.push_back(word.c_str());
  Arguments arguments;
  try {
    const auto answer = parse(static_cast<int>(argv.size()), argv.data(), arguments);
    require(!answer || !answer->empty(), "a command line is answered by nothing");
  } catch (const Error& error) {
    // The error no_input means that an input is an existing folder, but that the command line
    // gives no output for each of its files.
    require(error.kind() == ErrorKind::usage || error.kind() == ErrorKind::not_built_in ||
                error.kind() == ErrorKind::no_input,
            "a command line is no usage error");
    require(*error.what() != '\0', "an error without a message");
  }
}

template <class Arguments>
std::string help_of(std::optional<std::string> (*parse)(int, const char* const*, Arguments&)) {
  constexpr std::array words{"program", "--help", "all"};
  Arguments arguments;
  return parse(words.size(), words.data(), arguments).value_or("");
}

}  // namespace

std::string help_of(std::string_view target) {
  if (target == "barcode_arguments") return help_of(&barcode::parse_arguments);
  if (target == "cluster_arguments") return help_of(&cluster::parse_arguments);
  if (target == "distance_arguments") return help_of(&distance_program::parse_arguments);
  if (target == "segment_arguments") return help_of(&segment::parse_arguments);
  if (target == "vectorise_arguments") return help_of(&vectorise::parse_arguments);
  return "";
}

void run_barcode_arguments(std::string_view bytes) {
  check(words_of(bytes, "ph-barcode"), &barcode::parse_arguments);
}

void run_cluster_arguments(std::string_view bytes) {
  check(words_of(bytes, "ph-cluster"), &cluster::parse_arguments);
}

void run_distance_arguments(std::string_view bytes) {
  check(words_of(bytes, "ph-distance"), &distance_program::parse_arguments);
}

void run_segment_arguments(std::string_view bytes) {
  check(words_of(bytes, "ph-segment"), &segment::parse_arguments);
}

void run_vectorise_arguments(std::string_view bytes) {
  check(words_of(bytes, "ph-vectorise"), &vectorise::parse_arguments);
}

}  // namespace ph::fuzz
