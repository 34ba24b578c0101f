// SPDX-License-Identifier: MIT
#include "apps/segment/input/frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "apps/common/files/batch_names.hpp"
#include "ph/detail/io/reader.hpp"
#include "ph/error.hpp"

namespace ph::segment {
namespace {

// Depth images come last.
constexpr std::array<std::string_view, 9> kExtensions = {".pcd", ".ply",  ".xyz", ".xyzrgb", ".csv",
                                                         ".pts", ".tree", ".png", ".pgm"};
constexpr std::size_t kImages = 2;

/// The files of a folder that may be frames, sorted by name. NumPy arrays do not count, because
/// they may be labels of an earlier run.
std::vector<std::string> frames_in(const std::string& folder, bool depth_images) {
  std::span<const std::string_view> extensions = kExtensions;
  if (!depth_images) extensions = extensions.first(extensions.size() - kImages);
  return app::files_in(folder, extensions, "frames: no file is a cloud");
}

}  // namespace

FrameSource::FrameSource(const Arguments& a, const RunContext& context)
    : patterns_(a.files), has_files_(!a.files.of_each_frame().empty()) {
  for (const auto& [option, path] : patterns_.of_each_frame()) app::prepare_outputs(option, path);
  for (const std::string& input : a.inputs) {
    if (!app::is_folder(input)) {
      inputs_.push_back(input);
      continue;
    }
    for (std::string& frame : frames_in(input, a.image.has_camera()))
      inputs_.push_back(std::move(frame));
  }
  if (has_files_) take_names();
  if (!a.frames_from.empty()) list_.emplace(a.frames_from, context);
}

/// Gives each input a name for its files. @throws Error (usage) if two inputs would have the same
/// files.
void FrameSource::take_names() {
  names_ = app::output_names(inputs_);
  for (std::size_t i = 0; i < names_.size(); ++i) {
    if (taken_.emplace(names_[i], 1).second) {
      take_files(patterns_.filled(names_[i]));
      continue;
    }
    const auto other =
        static_cast<std::size_t>(std::ranges::find(names_, names_[i]) - names_.begin());
    throw Error(ErrorKind::usage, fmt::format("{} and {} would both be written to files named {}",
                                              printable(inputs_[other]), printable(inputs_[i]),
                                              printable(names_[i])));
  }
}

void FrameSource::take_files(const OutputPaths& files) {
  const auto outputs = files.of_each_frame();
  if (outputs.size() < 2) return;
  for (const auto& [option, path] : outputs)
    if (taken_files_.contains(path))
      throw Error(ErrorKind::usage,
                  fmt::format("{}: {} would be written for two frames", option, printable(path)));
  for (const auto& [option, path] : outputs) taken_files_.insert(path);
}

void FrameSource::add_known(app::InputFiles& known) {
  for (const std::string& input : inputs_) known.add(input);
  if (!list_) return;
  for (const std::string& input : list_->known()) known.add(input);  // mutant: file-frames
}

std::optional<Frame> FrameSource::next() {
  if (given_ < inputs_.size()) {
    const std::size_t i = given_++;
    return Frame{inputs_[i], has_files_ ? patterns_.filled(names_[i]) : OutputPaths{}};
  }
  std::optional<std::string> input = list_ ? list_->next() : std::nullopt;
  if (!input) return std::nullopt;
  if (!has_files_) return Frame{*std::move(input), {}};
  OutputPaths files = patterns_.filled(name_of(*input));
  take_files(files);
  return Frame{*std::move(input), std::move(files)};
}

/// The name for the output files of a frame in a list. It is the frame's file name without its
/// extension. Later frames are unknown, so the name cannot be chosen to be unique among all of
/// them. If an earlier frame has the same name, a number is appended.
std::string FrameSource::name_of(const std::string& input) {
  std::string stem = app::output_names({input}).front();
  const auto [known, is_new] = taken_.emplace(stem, 1);
  if (is_new) return stem;
  std::size_t number = known->second;
  std::string name;
  do {
    name = fmt::format("{}-{}", stem, ++number);
  } while (!taken_.emplace(name, 1).second);
  taken_[stem] = number;
  return name;
}

}  // namespace ph::segment
