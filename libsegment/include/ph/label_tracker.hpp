// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "ph/scene_tree.hpp"

namespace ph::segment {

/// The role of an object for grasping, kept over several frames.
struct Standing {
  Role role = Role::object;
  StandsOn on;
  friend bool operator==(const Standing&, const Standing&) = default;
};

/// Numbers the segments of a stream of frames: an object keeps its number from frame to frame.
///
/// A segment takes the number of the object with which it overlaps most. The overlap is the number
/// of shared places, divided by the number of places in the union of the two. The shared places
/// must be more than a quarter of the smaller of the two. Pairs with the largest overlap are
/// matched first, and no object is matched twice. All other segments get new numbers, 1, 2, …. An
/// object that no segment took keeps the places that no segment covers, and keeps its number for
/// some frames. Walls and boards have numbers as well. The role of an object, and what the object
/// stands on, change only when three frames in a row agree: a wall that is a segment in one frame
/// is still a wall. O(n log n) per frame; the tracker stores one frame.
class LabelTracker {
 public:
  /// @param patience the number of frames for which an unseen object is remembered, >= 0.
  /// @param cell edge, in metres, of the cubes that are compared in unorganised clouds; above 0.
  /// @throws Error (usage) on other values.
  explicit LabelTracker(int patience = 5, double cell = 0.01);

  /// Takes the next frame of a sensor with a fixed raster: places are pixels.
  /// @param labels one per pixel: 0 for none, else any number of a segment. A frame whose size
  /// differs from the size of the previous frame has no places in common with it.
  /// @return for each pixel, the number of the object to which its segment belongs; 0 if there is
  /// none.
  std::vector<std::uint32_t> update(std::span<const std::uint32_t> labels);
  /// Takes the next frame as a result of ph::segment::segment. If the cloud is unorganised, places
  /// are cubes of space whose size does not depend on the voxels of the scene; the sensor must then
  /// stand still.
  /// @return for each segment the number of its object: the object of label i + 1 is at i.
  /// @throws Error (bad_data) if the cut does not belong to this scene.
  std::vector<std::uint32_t> update(const SceneTree& scene, const SceneCut& cut);
  /// The roles of the segments of the last scene: label i + 1 is at i. `on` names a surface and a
  /// segment of that scene. Empty if the last frame was given as labels alone.
  const std::vector<Standing>& standings() const { return standings_; }

 private:
  using Key = std::array<double, 4>;  // size of the raster or of a cube, then the place
  struct Place {
    Key key;
    std::uint32_t number;  // number of a segment (from 0) or of an object
  };
  struct Object {
    std::uint32_t number;
    int unseen = 0;      // number of frames in a row without it
    bool is_new = true;  // true if it is first seen in this frame
    Standing is = {};    // `segment` holds the number of an object here
    Standing said = {};  // the standing in the last frames, if it differs from `is`
    int times = 0;       // number of frames in a row that showed `said`
  };
  std::vector<Place> cubes(const SceneTree& scene, const SceneCut& cut) const;
  std::vector<std::uint32_t> match(std::vector<Place> places, std::size_t things,
                                   std::size_t segments);
  void settle(const SceneTree& scene, const SceneCut& cut,
              const std::vector<std::uint32_t>& numbers);
  Object& object(std::uint32_t number);

  int patience_;
  double cell_;
  std::uint32_t next_ = 1;
  std::vector<Place> places_;    // the places of the objects, by key
  std::vector<Object> objects_;  // by number
  std::vector<Standing> standings_;
};

/// The motion of a camera between two frames, found from both supporting planes. Motion within the
/// plane cannot be detected.
struct CameraMotion {
  double turn = 0;   ///< angle between the planes, degrees
  double shift = 0;  ///< change of the distance from the viewpoint, metres
};
/// Empty if a frame has no plane, or if the two planes differ by no more than noise: half a degree,
/// or 5 mm at a range of one metre.
std::optional<CameraMotion> camera_motion(const SceneTree& before, const SceneTree& after);

}  // namespace ph::segment
