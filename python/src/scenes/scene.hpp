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

/// Collects notes in the terms of the Python interface. @param notes outlives it.
inline segment::Note note_into(std::vector<std::string>& notes) {
  return [&notes](const Message& text) { notes.push_back(text.in_words(kWords)); };
}

/// A camera, and the notes about it.
struct NamedCamera {
  Camera camera;
  std::string calibration;  ///< its name or file; empty: it was given as numbers
  std::vector<std::string> notes = {};
};

/// The cloud that is segmented. Nobody changes it.
struct SceneCloud {
  Cloud cloud;
  std::shared_ptr<const NamedCamera> camera;  ///< for a depth image; null otherwise
  std::vector<std::string> notes = {};
};

/// The result of a segmentation, with its input.
struct SegmentedScene {
  std::shared_ptr<const SceneCloud> input;  ///< null: a stored tree was read
  segment::Segmentation result = {};
  std::vector<std::string> notes = {};

  const Cloud* cloud() const { return input ? &input->cloud : nullptr; }
};

}  // namespace ph::python
