// SPDX-License-Identifier: MIT
// Checks parts that processes send to each other or store in files. The checksum of a part would
// reject every change before any other check. For this reason, the fuzzer supplies only the content
// of a part, and the checksum is computed here.
#include <algorithm>
#include <utility>
#include <vector>

#include "apps/barcode/parts/inputs_part.hpp"
#include "ph/detail/core/sealed_part.hpp"
#include "ph/error.hpp"
#include "ph/parts/cloud_part.hpp"
#include "ph/parts/image_part.hpp"
#include "ph/persistence.hpp"
#include "tests/fuzz/targets.hpp"
#include "tests/fuzz/violation.hpp"

namespace ph::fuzz {
namespace {

std::span<const std::byte> as_bytes(std::string_view text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

/// Runs a function that may refuse its bytes. @return true if it did not refuse them.
template <class Run>
bool is_taken(Run&& run) {
  try {
    run();
    return true;
  } catch (const Error& error) {
    require(error.kind() == ErrorKind::bad_data || error.kind() == ErrorKind::resource,
            "a part is neither bad nor too large");
    require(std::string_view(error.what()).find('\n') == std::string_view::npos,
            "a message of several lines");
    return false;
  }
}

}  // namespace

void run_image_part(std::string_view bytes) {
  RunContext context;
  context.memory.set_limit(std::size_t{16} << 20);
  is_taken([&] { kind_of_part(as_bytes(bytes)); });
  const std::vector<std::byte> sealed = sealed_part("image", as_bytes(bytes));
  require(kind_of_part(sealed) == "image", "a part that is sealed is of another kind");
  is_taken([&] {
    ImagePart part = ImagePart::of_bytes(sealed, context);
    const std::vector<std::byte> again = part.bytes();
    ImagePart same = ImagePart::of_bytes(again, context);
    require(same.bytes() == again, "a part is not read as it was written");
    require(!is_taken([&] { part.join(std::move(same), context); }), "a part is behind itself");
    require(part.bytes() == again, "a join that was refused has changed a part");
    if (part.is_whole()) part.barcode(context);
  });
}

void run_cloud_part(std::string_view bytes) {
  RunContext context;
  context.memory.set_limit(std::size_t{16} << 20);
  is_taken([&] { kind_of_part(as_bytes(bytes)); });
  const std::vector<std::byte> sealed = sealed_part("cloud", as_bytes(bytes));
  is_taken([&] {
    CloudPart part = CloudPart::of_bytes(sealed, context);
    const std::vector<std::byte> again = part.bytes();
    require(CloudPart::of_bytes(again, context).bytes() == again,
            "a part is not read as it was written");
    require(!is_taken([&] { part.join(CloudPart::of_bytes(again, context), context); }),
            "a part is there twice");
    require(part.bytes() == again, "a join that was refused has changed a part");
    if (!part.is_whole()) return;
    is_taken([&] {
      const Barcode bars = part.barcode(context);
      const Barcode same = persistence(part.rips(context), {.max_dim = 0}, context);
      require(std::ranges::equal(bars, same), "the forest has other bars than the part");
    });
  });
}

void run_inputs_part(std::string_view bytes) {
  using barcode::InputsPart;
  is_taken([&] {
    const std::vector<std::byte> sealed = sealed_part(barcode::kInputsKind, as_bytes(bytes));
    InputsPart part = InputsPart::of_bytes(sealed);
    const std::vector<std::byte> again = part.bytes();
    require(again == sealed, "a part is not read as it was written");
    require(!is_taken([&] { part.join(InputsPart::of_bytes(again)); }), "a part is there twice");
    require(part.bytes() == again, "a join that was refused has changed a part");
  });
}

}  // namespace ph::fuzz
