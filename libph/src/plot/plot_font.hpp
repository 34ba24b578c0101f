// SPDX-License-Identifier: MIT
#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "plot/plot_coverage.hpp"

namespace ph::plot {

/// The font that the library has in it, for pictures made of pixels.
class Font {
 public:
  /// Areas around holes go around clockwise, holes the other way. For a size of 1.
  struct Glyph {
    std::vector<std::vector<Place>> outlines;  // the baseline begins at the origin
    double advance = 0;                        // to the next one
  };

  /// @throws Error (internal) if FreeType cannot read the font; std::bad_alloc.
  Font();
  ~Font();
  Font(const Font&) = delete;
  Font& operator=(const Font&) = delete;

  /// Of a character in UTF-8; a box of one that the font lacks.
  const Glyph& glyph(const std::string& character);

  /// "FreeType 2.12.1, DejaVu Sans"
  static std::string name();

 private:
  struct Face;
  std::unique_ptr<Face> face_;
  std::map<std::string, Glyph> glyphs_;
};

}  // namespace ph::plot
