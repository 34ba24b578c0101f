// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "apps/barcode/arguments/arguments.hpp"
#include "apps/barcode/job/job.hpp"
#include "apps/barcode/output/outputs.hpp"
#include "apps/common/run/session.hpp"

namespace ph::barcode {

/// A part that was read, and the name of its file.
struct PartFile {
  std::string path;
  std::vector<std::byte> bytes;
};

/// True if a path is intended for a part, that is, if it ends in .ph.
bool is_part_path(const std::string& path);

/// The path of one part of an input. If `output` is a folder, it is created, and the file in it is
/// named after the part.
/// @param part the number of the part, from 0. @throws Error (cannot_create).
std::string part_path(const std::string& output, const std::string& name, int part, int parts);

/// The whole content of a part file. @throws Error like Input::open.
std::vector<std::byte> read_part_file(const std::string& path, app::Session& session);

/// The file that --resume may keep: the whole content of the file, if it exists.
std::optional<std::vector<std::byte>> kept_part_file(const std::string& path,
                                                     app::Session& session);

/// The part in a file, for --resume. If the file is damaged or contains another part, a note
/// reports this, and the part must be computed again.
/// @param of_bytes makes a part from bytes; throws Error (bad_data) on other bytes.
/// @param why_not returns what is wrong with a part that is not the requested part, for example
/// "has inputs that failed". The text is empty if it is the requested part.
template <class OfBytes, class WhyNot>
std::optional<std::invoke_result_t<OfBytes, std::span<const std::byte>>> kept_part(
    const std::string& path, app::Session& session, OfBytes&& of_bytes, WhyNot&& why_not) {
  const auto bytes = kept_part_file(path, session);
  if (!bytes) return std::nullopt;
  std::string why;
  try {
    auto part = of_bytes(std::span<const std::byte>(*bytes));
    why = why_not(part);
    if (why.empty()) return part;
    why = " " + why;
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::bad_data) throw;
    why = ": " + error.marked();
  }
  session.note("--resume: " + path + why + "; it is computed again");
  return std::nullopt;
}

/// Writes a part. The file appears once it is complete. @return the size of the file, as text for
/// users.
std::string write_part_file(app::Output& output, std::span<const std::byte> bytes);

/// Adds to the origin of bars that parts gave: this program and its input.
BarcodeInfo named(BarcodeInfo info, const std::string& description, const Job& job);

/// Writes the bars of a complete result, without finite bars that are not longer than the user's
/// limit.
Outcome write_bars(Barcode bars, BarcodeInfo info, Outputs& outputs, const Job& job,
                   app::Session& session);

}  // namespace ph::barcode
