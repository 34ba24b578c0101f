// SPDX-License-Identifier: MIT
#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "libph/src/plot/plot_coverage.hpp"

namespace ph::plot {

/// The font built into the library, for pictures made of pixels.
class Font {
 public:
  /// A glyph at size 1. Outer outlines are clockwise. Outlines of holes are counterclockwise.
  struct Glyph {
    std::vector<std::vector<Place>> outlines;  // the origin is the start of the baseline
    double advance = 0;                        // distance to the next character
  };

  /// Loads the font. @throws Error (internal) if FreeType cannot read it; std::bad_alloc.
  Font();
  ~Font();
  Font(const Font&) = delete;
  Font& operator=(const Font&) = delete;

  /// The glyph of a UTF-8 character, or a box if the font lacks this character.
  const Glyph& glyph(const std::string& character);

  /// A name such as "FreeType 2.12.1, DejaVu Sans".
  static std::string name();

 private:
  struct Face;
  std::unique_ptr<Face> face_;
  std::map<std::string, Glyph> glyphs_;
};

}  // namespace ph::plot
