// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace ph {

/// What went wrong, in the classes a caller can act on. The programs turn each into an exit code.
enum class ErrorKind {
  usage,          ///< an argument or option makes no sense
  bad_data,       ///< the input is malformed or breaks a precondition
  no_input,       ///< the input is missing or unreadable
  not_built_in,   ///< this build was made without the feature, or this machine lacks what it needs
  cannot_create,  ///< the output cannot be created
  io,             ///< reading or writing broke off
  resource,       ///< memory or another limit would be exceeded
  cancelled,      ///< the caller asked to stop
  internal,       ///< a bug in libph
};

/// What can be set of a computation, whatever the programs and languages call it.
enum class Setting : std::uint8_t {
  none,
  allow_empty,
  camera,
  cell,
  channel,
  collapse,
  columns,
  complex,
  construction,
  crop,
  cut,
  depth_scale,
  diagonal,
  distance,
  engine,
  first_meeting,
  format,
  from_correlation,
  infinite,
  intrinsics,
  labels,
  max_dim,
  max_range,
  memory_limit,
  min_part,
  min_persistence,
  min_seam,
  min_size,
  nan,
  patience,
  plane_distance,
  plane_guess,
  plane_noise,
  raw_shape,
  raw_skip,
  raw_type,
  report,
  representatives,
  spacing,
  steps,
  subsample,
  symmetrise,
  threshold,
  values,
  viewpoint,
  voxel,
};

/// The name of a setting in lower case, its words separated by underscores: "max_dim".
std::string_view setting_name(Setting setting);
/// All settings but `none`, by name.
std::span<const Setting> all_settings();

/// A change that helps: a setting with a value (engine, "auto"). The value is empty if any other
/// one helps, or if the setting has none.
struct Remedy {
  Setting setting = Setting::none;
  std::string value;
  friend bool operator==(const Remedy&, const Remedy&) = default;
};

/// How a program or a language names settings.
struct Words {
  /// A setting with a value, which may be empty or several: see `alternatives`. An empty text means
  /// that there is no such setting.
  std::string (*setting)(Setting setting, std::string_view value);
};

/// The values of a mark as text: of "max|min|lower" it is "max, min or lower".
/// @param quote stands before and after each value.
std::string alternatives(std::string_view values, std::string_view quote = {});

/// A setting, with a value if there is one, as a part of the text of a message or an error: each
/// program and language puts it into its own words. @param value several are separated by '|'.
std::string mark(Setting setting, std::string_view value = {});
/// The same of where something went wrong, see Message::place.
std::string mark_place(std::string_view place);
/// The same of what was found there, see Message::found.
std::string mark_found(std::string_view found);

/// One line for the user: text in which settings are marked.
class Message {
 public:
  Message() = default;
  Message(std::string marked)
      : marked_(std::move(marked)) {}                    // NOLINT(google-explicit-constructor)
  Message(std::string_view marked) : marked_(marked) {}  // NOLINT(google-explicit-constructor)
  Message(const char* marked) : marked_(marked) {}       // NOLINT(google-explicit-constructor)

  bool empty() const { return marked_.empty(); }
  /// The text as it was given, with its marks: to become a part of another message.
  const std::string& marked() const { return marked_; }
  /// The text with the names of settings in lower case: "nan drop leaves such points out".
  std::string str() const;
  /// The text in the words of a program or a language. A clause behind "; " that names a setting
  /// which is not there is left out.
  std::string in_words(const Words& words) const;
  /// The message without the clauses behind "; " that name this setting.
  Message without(Setting setting) const;
  /// The message without the place at its start.
  Message without_place() const;

  /// The settings that are named behind "; ", each value by itself.
  std::vector<Remedy> remedies() const;
  /// Where it went wrong: "a.csv:3:7", or "point 3, coordinate 1"; empty if that is unknown.
  std::string place() const;
  /// What was found there, if that is a number or a name: "nan".
  std::string found() const;
  /// True if the place is in the input of this name.
  bool is_about(std::string_view name) const;

  friend bool operator==(const Message&, const Message&) = default;

 private:
  std::string marked_;
};

/// The one exception type of libph. `what()` is one line, which names settings as Message::str
/// does: what, found, expected, hint. Copies do not throw.
class Error : public std::runtime_error {
 public:
  /// @param message may hold marks.
  Error(ErrorKind kind, const std::string& message);
  ErrorKind kind() const noexcept { return kind_; }
  /// The line with its marks.
  Message message() const;
  /// The line with its marks, to become a part of another one.
  std::string marked() const { return message().marked(); }
  /// The line in the words of a program or a language.
  std::string in_words(const Words& words) const { return message().in_words(words); }
  /// The settings that would help.
  std::vector<Remedy> remedies() const { return message().remedies(); }
  /// Where it went wrong, see Message::place.
  std::string place() const { return message().place(); }

 private:
  ErrorKind kind_;
  std::shared_ptr<const std::string> marked_;  // null: `what()` has no marks
};

}  // namespace ph
