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

/// What an object is to those who want to take hold of it, over some frames.
struct Standing {
  Role role = Role::object;
  StandsOn on;
  friend bool operator==(const Standing&, const Standing&) = default;
};

/// Numbers for the segments of a stream of frames: an object keeps its number from frame to frame.
///
/// A segment takes the number of the object with which it shares most places, largest share first
/// (of their union), if that is more than a quarter of the smaller of the two; no object is taken
/// twice. All else gets new numbers, 1, 2, …. An object that no segment took keeps its places, as
/// far as no segment covers them, and its number for some frames more. Walls and boards have
/// numbers, too. What an object is, and what it stands on, changes only when three frames in a row
/// say so: a wall that is a segment in one frame is still a wall. O(n log n) a frame; memory is
/// that of one frame.
class LabelTracker {
 public:
  /// @param patience frames for which an object that is not seen is remembered, >= 0.
  /// @param cell edge of the cubes by which clouds that are not organised are compared, metres, >
  /// 0. @throws Error (usage) on others.
  explicit LabelTracker(int patience = 5, double cell = 0.01);

  /// The next frame of a sensor with a fixed raster: places are pixels.
  /// @param labels one a pixel: 0 none, else any number of a segment. A frame of another size than
  /// that before shares nothing with it.
  /// @return by pixel the number of the object that its segment is; 0 where there is none.
  std::vector<std::uint32_t> update(std::span<const std::uint32_t> labels);
  /// The same for the result of ph::segment::segment. Of an unorganised cloud places are cubes of
  /// space, whatever its voxels are: the sensor must stand still.
  /// @return the number of the object that each segment is: that of label i + 1 at i.
  /// @throws Error (bad_data) if the cut is not one of this scene.
  std::vector<std::uint32_t> update(const SceneTree& scene, const SceneCut& cut);
  /// What the segments of the last scene are, that of label i + 1 at i. `on` names a surface and a
  /// segment of that scene. After labels alone: nothing.
  const std::vector<Standing>& standings() const { return standings_; }

 private:
  using Key = std::array<double, 4>;  // size of the raster or of a cube, then where
  struct Place {
    Key key;
    std::uint32_t number;  // of a segment (from 0), or of an object
  };
  struct Object {
    std::uint32_t number;
    int unseen = 0;      // frames
    bool is_new = true;  // in this frame
    Standing is = {};    // `segment` is the number of an object here
    Standing said = {};  // by the last frames, if not the same,
    int times = 0;       // so many in a row
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
  std::vector<Place> places_;    // of the objects, by key
  std::vector<Object> objects_;  // by number
  std::vector<Standing> standings_;
};

/// How a camera moved between two frames, told from the supporting plane of both: what it does in
/// the plane itself is not seen.
struct CameraMotion {
  double turn = 0;   ///< of the plane, degrees
  double shift = 0;  ///< of its distance from the viewpoint, metres
};
/// Nothing if a frame has no plane, or if the two differ by no more than noise does: half a degree,
/// or 5 mm at a range of a metre.
std::optional<CameraMotion> camera_motion(const SceneTree& before, const SceneTree& after);

}  // namespace ph::segment
