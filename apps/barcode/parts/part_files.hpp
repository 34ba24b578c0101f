// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "barcode/output/outputs.hpp"
#include "barcode/run.hpp"
#include "common/run/session.hpp"

namespace ph::barcode {

/// A part that was read, and where it came from.
struct PartFile {
  std::string path;
  std::vector<std::byte> bytes;
};

/// Whether a path is to hold a part: it ends in .ph.
bool is_part_path(const std::string& path);

/// Where part I of P of an input goes: a folder, which is created, gets a file of that name.
/// @param part from 0 on. @throws Error (cannot_create).
std::string part_path(const std::string& output, const std::string& name, int part, int parts);

/// All of a part file. @throws Error as Input::open.
std::vector<std::byte> read_part_file(const std::string& path, app::Session& session);

/// What --resume may keep: all of a part file that is there, if no input is younger.
std::optional<std::vector<std::byte>> kept_part_file(const std::string& path,
                                                     std::span<const std::string> inputs,
                                                     app::Session& session);

/// The part that --resume may keep, of such a file. What is damaged or another is said to be, and
/// has to be computed anew.
/// @param of_bytes makes a part of bytes; throws Error (bad_data) on what is none.
/// @param why_not says why a part is not the one that is wanted; nothing: it is.
template <class OfBytes, class WhyNot>
std::optional<std::invoke_result_t<OfBytes, std::span<const std::byte>>> kept_part(
    const std::string& path, std::span<const std::string> inputs, app::Session& session,
    OfBytes&& of_bytes, WhyNot&& why_not) {
  const auto bytes = kept_part_file(path, inputs, session);
  if (!bytes) return std::nullopt;
  std::string why;
  try {
    auto part = of_bytes(std::span<const std::byte>(*bytes));
    why = why_not(part);
    if (why.empty()) return part;
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::bad_data) throw;
    why = error.marked();
  }
  session.note("--resume: " + path + ": " + why + ": computed again");
  return std::nullopt;
}

/// Writes a part, which appears when it is complete. @return its size, for people.
std::string write_part_file(app::Output& output, std::span<const std::byte> bytes);

/// Writes bars that are whole again, without those that the user does not want to see.
Outcome write_bars(Barcode bars, BarcodeInfo info, Outputs& outputs, const Arguments& arguments,
                   app::Session& session);

}  // namespace ph::barcode
