// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "ph/detail/core/names.hpp"

namespace ph {

/// The kinds of errors, by what a caller can do about them. The programs turn each kind into an
/// exit code.
enum class ErrorKind {
  usage,          ///< an argument or option is invalid
  bad_data,       ///< the input is malformed or breaks a precondition
  no_input,       ///< the input is missing or unreadable
  not_built_in,   ///< this build lacks the feature, or this machine lacks what the feature needs
  cannot_create,  ///< the output cannot be created
  io,             ///< reading or writing failed partway
  resource,       ///< a limit on memory or on another resource would be exceeded
  cancelled,      ///< the caller asked to stop
  internal,       ///< a bug in libph
};

/// The settings of a computation, whatever the programs and languages call them.
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
  min_size,
  most_supports,
  nan,
  patience,
  plane_distance,
  plane_guess,
  plane_noise,
  raw_points,
  raw_shape,
  raw_skip,
  raw_type,
  report,
  representatives,
  spacing,
  stack,
  steps,
  subsample,
  symmetrise,
  threshold,
  values,
  viewpoint,
  voxel,
  weld,
};

/// All settings except `none`, in the order of their names. The words of a name are separated by
/// underscores.
template <>
inline constexpr std::array names_of<Setting>{
    Named{Setting::allow_empty, "allow_empty"},
    Named{Setting::camera, "camera"},
    Named{Setting::cell, "cell"},
    Named{Setting::channel, "channel"},
    Named{Setting::collapse, "collapse"},
    Named{Setting::columns, "columns"},
    Named{Setting::complex, "complex"},
    Named{Setting::construction, "construction"},
    Named{Setting::crop, "crop"},
    Named{Setting::cut, "cut"},
    Named{Setting::depth_scale, "depth_scale"},
    Named{Setting::diagonal, "diagonal"},
    Named{Setting::distance, "distance"},
    Named{Setting::engine, "engine"},
    Named{Setting::first_meeting, "first_meeting"},
    Named{Setting::format, "format"},
    Named{Setting::from_correlation, "from_correlation"},
    Named{Setting::infinite, "infinite"},
    Named{Setting::intrinsics, "intrinsics"},
    Named{Setting::labels, "labels"},
    Named{Setting::max_dim, "max_dim"},
    Named{Setting::max_range, "max_range"},
    Named{Setting::memory_limit, "memory_limit"},
    Named{Setting::min_part, "min_part"},
    Named{Setting::min_persistence, "min_persistence"},
    Named{Setting::min_size, "min_size"},
    Named{Setting::most_supports, "most_supports"},
    Named{Setting::nan, "nan"},
    Named{Setting::patience, "patience"},
    Named{Setting::plane_distance, "plane_distance"},
    Named{Setting::plane_guess, "plane_guess"},
    Named{Setting::plane_noise, "plane_noise"},
    Named{Setting::raw_points, "raw_points"},
    Named{Setting::raw_shape, "raw_shape"},
    Named{Setting::raw_skip, "raw_skip"},
    Named{Setting::raw_type, "raw_type"},
    Named{Setting::report, "report"},
    Named{Setting::representatives, "representatives"},
    Named{Setting::spacing, "spacing"},
    Named{Setting::stack, "stack"},
    Named{Setting::steps, "steps"},
    Named{Setting::subsample, "subsample"},
    Named{Setting::symmetrise, "symmetrise"},
    Named{Setting::threshold, "threshold"},
    Named{Setting::values, "values"},
    Named{Setting::viewpoint, "viewpoint"},
    Named{Setting::voxel, "voxel"},
    Named{Setting::weld, "weld"},
};

/// A change that would avoid an error: a setting and its new value, such as (engine, "auto"). The
/// value is empty if any other value helps, or if the setting has no value.
struct Remedy {
  Setting setting = Setting::none;
  std::string value;
  friend bool operator==(const Remedy&, const Remedy&) = default;
};

/// The names of settings in a program or a language.
struct Words {
  /// The text for a setting and its value. `value` may be empty, or several values separated by '|'
  /// (see `alternatives`). An empty text means that the program has no such setting.
  std::string (*setting)(Setting setting, std::string_view value);
};

/// The values of a mark as text: "max|min|lower" becomes "max, min or lower".
/// @param quote is put before and after each value.
std::string alternatives(std::string_view values, std::string_view quote = {});

/// Marks a setting, and its value if there is one, for the text of a message or an error: each
/// program and language replaces the mark with its own words. @param value may be several values,
/// separated by '|'.
std::string mark(Setting setting, std::string_view value = {});
/// Marks the place of an error (see Message::place).
std::string mark_place(std::string_view place);
/// Marks the value found at the place of an error (see Message::found).
std::string mark_found(std::string_view found);

/// One line of text for the user, in which settings are marked.
class Message {
 public:
  Message() = default;
  Message(std::string marked)
      : marked_(std::move(marked)) {}                    // NOLINT(google-explicit-constructor)
  Message(std::string_view marked) : marked_(marked) {}  // NOLINT(google-explicit-constructor)
  Message(const char* marked) : marked_(marked) {}       // NOLINT(google-explicit-constructor)
  /// A note that says which of several plausible meanings an input was given.
  static Message guess(std::string marked) {
    Message message(std::move(marked));
    message.is_guess_ = true;
    return message;
  }

  /// True if the result would be another one if the user meant something else.
  bool is_guess() const { return is_guess_; }
  bool empty() const { return marked_.empty(); }
  /// The text as given, with its marks, for use in another message.
  const std::string& marked() const { return marked_; }
  /// The text with the names of settings in lower case: "nan drop leaves such points out".
  std::string str() const;
  /// The text in the words of a program or a language. If the program lacks a setting, clauses
  /// after "; " that name it are left out.
  std::string in_words(const Words& words) const;
  /// The message without the clauses after "; " that name this setting.
  Message without(Setting setting) const;
  /// The message without the place at its start.
  Message without_place() const;

  /// The settings that are named after "; ", one entry per value.
  std::vector<Remedy> remedies() const;
  /// The place of the error: "a.csv:3:7" or "point 3, coordinate 1"; empty if it is unknown.
  std::string place() const;
  /// The number or name that was found there ("nan"); empty if there is none.
  std::string found() const;
  /// True if the place is in the input with this name.
  bool is_about(std::string_view name) const;

  friend bool operator==(const Message&, const Message&) = default;

 private:
  std::string marked_;
  bool is_guess_ = false;
};

/// The one exception type of libph. `what()` is one line, which names settings as Message::str
/// does: problem, found, expected, hint. Copies do not throw.
class Error : public std::runtime_error {
 public:
  /// @param message may contain marks.
  Error(ErrorKind kind, const std::string& message);
  ErrorKind kind() const noexcept { return kind_; }
  /// The line with its marks.
  Message message() const;
  /// The line with its marks, for use in another message.
  std::string marked() const { return message().marked(); }
  /// The line in the words of a program or a language.
  std::string in_words(const Words& words) const { return message().in_words(words); }
  /// The settings whose change would help, see Message::remedies.
  std::vector<Remedy> remedies() const { return message().remedies(); }
  /// The place of the error, see Message::place.
  std::string place() const { return message().place(); }

 private:
  ErrorKind kind_;
  std::shared_ptr<const std::string> marked_;  // null if the line has no marks
};

}  // namespace ph
