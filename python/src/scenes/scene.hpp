// SPDX-License-Identifier: MIT
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "depth_scene.hpp"
#include "ph/segment.hpp"
#include "words.hpp"

namespace ph::python {

/// Keeps notes in the words of Python. @param notes outlives it.
inline segment::Note note_into(std::vector<std::string>& notes) {
  return [&notes](const Message& text) { notes.push_back(text.in_words(kWords)); };
}

/// A camera, and what to tell about it.
struct NamedCamera {
  Camera camera;
  std::string calibration;  ///< its name or file; empty: it was given by numbers
  std::vector<std::string> notes = {};
};

/// A cloud as it goes into a segmentation. Nobody changes it.
struct SceneCloud {
  Cloud cloud;
  std::shared_ptr<const NamedCamera> camera;  ///< of a depth image; null: it was none
  std::vector<std::string> notes = {};
};

/// What a segmentation gives, with what went in.
struct SegmentedScene {
  std::shared_ptr<const SceneCloud> input;  ///< null: a stored tree was read
  segment::Segmentation result = {};
  std::vector<std::string> notes = {};

  const Cloud* cloud() const { return input ? &input->cloud : nullptr; }
};

}  // namespace ph::python
