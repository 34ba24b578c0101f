// SPDX-License-Identifier: MIT
// Checks the properties that all readers must have: a reader returns a valid result, or fails with
// a message of one line that names the file.
#include <algorithm>
#include <optional>

#include "libph/src/io/bytes/unpack.hpp"
#include "tests/fuzz/heap_meter.hpp"
#include "tests/fuzz/readers.hpp"
#include "tests/fuzz/targets.hpp"
#include "tests/fuzz/violation.hpp"

namespace ph::fuzz {
namespace {

constexpr std::size_t kBudget = std::size_t{64} << 20;
/// Additional memory that is allowed for a message, the input's name and other small things.
constexpr std::size_t kFree = std::size_t{1} << 20;

/// The outcome of an attempt to read.
struct Outcome {
  std::optional<Content> content;
  std::string message;
  bool out_of_budget = false;

  friend bool operator==(const Outcome&, const Outcome&) = default;
};

void require_message(const std::string& message, const std::string& name) {
  require(message.starts_with(name) && message.size() > name.size() + 2,
          "a message does not begin with the file's name");
  const bool ascii =
      std::all_of(message.begin(), message.end(), [](char c) { return c >= ' ' && c <= '~'; });
  require(ascii || printable(message, SIZE_MAX) == message, "a message is not one printable line");
}

std::string name_of(const NamedReader& reader) { return "input" + std::string(reader.extension); }

Outcome attempt(const NamedReader& reader, std::string_view bytes, ReadOptions options) {
  RunContext context;
  context.memory.set_limit(kBudget);
  options.context = &context;
  const std::string name = name_of(reader);
  // The bytes are copied to a separate allocation, where a read beyond the end is detected.
  const Input input = Input::hold({bytes.begin(), bytes.end(), &context.memory}, name, &context);
  Outcome outcome;
  try {
    outcome.content = reader.read(input, options);
  } catch (const Error& error) {
    outcome.message = error.what();
    outcome.out_of_budget = error.kind() == ErrorKind::resource;
    require(outcome.out_of_budget || error.kind() == ErrorKind::bad_data,
            "a reader throws neither bad data nor resource");
    if (!outcome.out_of_budget) require_message(outcome.message, name);
  }
  require(HeapMeter::last_peak() <= kBudget + kFree, "a reader took more memory than its budget");
  return outcome;
}

}  // namespace

void run_reader(std::string_view name, std::string_view bytes) {
  const NamedReader& reader = *find_reader(name);
  const Outcome strict = attempt(reader, bytes, {});
  // Exceptions take most of the time, so not every check runs for each input.
  if (bytes.size() % 8 == 0)
    require(strict == attempt(reader, bytes, {}), "a reader gives two results for one file");
  if (!strict.content && bytes.size() % 2 != 0) return;
  // Bytes that are accepted by strict reading must also be accepted by lenient reading, and must
  // give the same result.
  ReadOptions taking{.allow_empty = true, .nan = NanPolicy::drop};
  // This option declares that a table is a matrix. It applies only to readers that read nothing but
  // matrices.
  if (name == "distances" || name == "correlations" || name == "npy_distances")
    taking.symmetrise = Symmetrise::lower;
  const Outcome lenient = attempt(reader, bytes, taking);
  require(!strict.content || strict.content == lenient.content,
          "a lenient reader reads something else");
  if (lenient.content) reader.rewrite(Input::view(bytes, name_of(reader)), taking);
}

void run_gzip(std::string_view bytes) {
  constexpr std::size_t kMost = std::size_t{1} << 16;  // a limit that unpacked data can reach
  RunContext context;
  context.memory.set_limit(kBudget);
  const Input input = Input::hold({bytes.begin(), bytes.end(), &context.memory}, "input", &context);
  try {
    const detail::Packed packed{input, 0, detail::stated_size(input.text())};
    require(detail::unpack(packed, kMost).size() <= kMost, "unpacked beyond the limit");
  } catch (const Error& error) {
    const bool kind = error.kind() == ErrorKind::bad_data || error.kind() == ErrorKind::resource;
    require(kind, "unpacking throws neither bad data nor resource");
    require_message(error.what(), "input");
  }
}

}  // namespace ph::fuzz
