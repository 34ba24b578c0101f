// SPDX-License-Identifier: MIT
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ph/detail/segment/depth_scene.hpp"
#include "ph/segment.hpp"
#include "python/src/calls/words.hpp"

namespace ph::python {

/// Collects notes in the terms of the Python interface, apart from guesses about the input.
/// @param notes, guesses must outlive the result.
inline segment::Note note_into(std::vector<std::string>& notes, std::vector<std::string>& guesses) {
  return [&](const Message& text) {
    (text.is_guess() ? guesses : notes).push_back(text.in_words(kWords));
  };
}
inline segment::Note note_into(std::vector<std::string>& notes) { return note_into(notes, notes); }

/// A camera, and the notes about it.
struct NamedCamera {
  Camera camera;
  /// The name or file of the camera; empty if the camera was given as numbers.
  std::string calibration;
  std::vector<std::string> notes = {};
};

/// The cloud that is segmented. It never changes.
struct SceneCloud {
  Cloud cloud;
  /// The camera of a depth image; null for other clouds.
  std::shared_ptr<const NamedCamera> camera;
  std::vector<std::string> notes = {}, guesses = {};
};

/// The result of a segmentation, with its input.
struct SegmentedScene {
  /// Null if a stored tree was read.
  std::shared_ptr<const SceneCloud> input;
  segment::Segmentation result = {};
  std::vector<std::string> notes = {};

  const Cloud* cloud() const { return input ? &input->cloud : nullptr; }
};

}  // namespace ph::python
