// SPDX-License-Identifier: MIT
#include "libph/src/plot/plot_font.hpp"

#include <fmt/format.h>
#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_MODULE_H

#include <cstdlib>
#include <new>
#include <span>

#include "ph/error.hpp"

// The font DejaVu Sans is built into the library, because a machine that runs the program may have
// no font or a different one. CMake finds the font file.
extern "C" {
extern const unsigned char kFontBegin[] __asm__("ph_plot_font_begin");
extern const unsigned char kFontEnd[] __asm__("ph_plot_font_end");
}
#ifdef __ELF__
#define PH_READ_ONLY ".pushsection .rodata\n"
#define PH_AS_BEFORE ".popsection\n"
#else
#define PH_READ_ONLY ".section .rdata,\"dr\"\n"
#define PH_AS_BEFORE ".text\n"
#endif
__asm__(PH_READ_ONLY
        ".globl ph_plot_font_begin\n"
        ".globl ph_plot_font_end\n"
        ".balign 16\n"
        "ph_plot_font_begin:\n"
        ".incbin \"" PH_PLOT_FONT
        "\"\n"
        "ph_plot_font_end:\n"
        ".byte 0\n" PH_AS_BEFORE);

namespace ph::plot {
namespace {

// This factor makes text as wide as in Helvetica, for which the pictures are designed.
constexpr double kNarrow = 0.9;
constexpr int kPieces = 5;  // line segments per curve

// This is the allocator of FreeType. When memory runs out, FreeType reports a different error, such
// as a missing module. `user` therefore points to a flag that records whether allocation failed.
extern "C" {
static void* allocate(FT_Memory memory, long size) {
  void* const block = std::malloc(static_cast<std::size_t>(size));
  if (block == nullptr) *static_cast<bool*>(memory->user) = true;
  return block;
}
static void release(FT_Memory, void* block) { std::free(block); }
static void* reallocate(FT_Memory memory, long, long size, void* old) {
  void* const block = std::realloc(old, static_cast<std::size_t>(size));
  if (block == nullptr) *static_cast<bool*>(memory->user) = true;
  return block;
}
}

char32_t code_point(const std::string& character) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(character[i]); };
  if (character.size() == 1) return byte(0);
  char32_t code = byte(0) & (0x7FU >> character.size());
  for (std::size_t i = 1; i < character.size(); ++i) code = code << 6 | (byte(i) & 0x3FU);
  return code;
}

/// Turns one outline of a glyph into a polygon. The points, in font units, are corners and control
/// points of quadratic Bézier curves between the corners. Two consecutive control points imply a
/// corner midway between them.
/// @param tags the tags of the points: char or, since FreeType 2.13.3, unsigned char.
std::vector<Place> flattened(std::span<const FT_Vector> points, const auto* tags, double unit) {
  const std::size_t count = points.size();
  const auto place = [&](std::size_t i) {
    const FT_Vector& p = points[i % count];
    return Place{kNarrow * unit * static_cast<double>(p.x), -unit * static_cast<double>(p.y)};
  };
  const auto is_corner = [&](std::size_t i) { return (tags[i % count] & FT_CURVE_TAG_ON) != 0; };
  const auto middle = [](Place a, Place b) { return Place{(a.x + b.x) / 2, (a.y + b.y) / 2}; };
  std::vector<Place> corners;
  if (count < 2) return corners;
  Place last = is_corner(0)           ? place(0)
               : is_corner(count - 1) ? place(count - 1)
                                      : middle(place(0), place(count - 1));
  corners.push_back(last);
  for (std::size_t i = is_corner(0) ? 1 : 0; i < count + (is_corner(0) ? 1 : 0); ++i) {
    if (is_corner(i)) {
      corners.push_back(last = place(i));
      continue;
    }
    const Place pull = place(i);
    const Place end = is_corner(i + 1) ? place(i + 1) : middle(pull, place(i + 1));
    for (int k = 1; k <= kPieces; ++k) {
      const double t = static_cast<double>(k) / kPieces, s = 1 - t;
      corners.push_back({s * s * last.x + 2 * s * t * pull.x + t * t * end.x,
                         s * s * last.y + 2 * s * t * pull.y + t * t * end.y});
    }
    last = end;
  }
  return corners;
}

}  // namespace

struct Font::Face {
  bool out_of_memory = false;
  FT_MemoryRec_ memory{&out_of_memory, &allocate, &release, &reallocate};
  FT_Library library = nullptr;
  FT_Face face = nullptr;

  ~Face() {
    if (library != nullptr) FT_Done_Library(library);  // this also frees its faces
  }
  /// Checks the result of a FreeType call. @throws std::bad_alloc; Error (internal).
  void require(FT_Error error) const {
    if (out_of_memory) throw std::bad_alloc();
    if (error != 0)
      throw Error(ErrorKind::internal, fmt::format("plot: FreeType error {} in the font", error));
  }
};

Font::Font() : face_(std::make_unique<Face>()) {
  face_->require(FT_New_Library(&face_->memory, &face_->library));
  FT_Add_Default_Modules(face_->library);
  face_->require(FT_New_Memory_Face(face_->library, kFontBegin,
                                    static_cast<FT_Long>(kFontEnd - kFontBegin), 0, &face_->face));
}

Font::~Font() = default;

const Font::Glyph& Font::glyph(const std::string& character) {
  const auto found = glyphs_.find(character);
  if (found != glyphs_.end()) return found->second;
  FT_Face face = face_->face;
  // Glyphs are loaded in font units, because hinting depends on the version of FreeType.
  face_->require(
      FT_Load_Glyph(face, FT_Get_Char_Index(face, code_point(character)), FT_LOAD_NO_SCALE));
  const double unit = 1.0 / face->units_per_EM;
  const FT_Outline& outline = face->glyph->outline;
  Glyph glyph;
  glyph.advance = kNarrow * unit * static_cast<double>(face->glyph->metrics.horiAdvance);
  std::size_t begin = 0;
  for (int k = 0; k < outline.n_contours; ++k) {
    const auto end = static_cast<std::size_t>(outline.contours[k]) + 1;
    glyph.outlines.push_back(
        flattened({outline.points + begin, end - begin}, outline.tags + begin, unit));
    begin = end;
  }
  return glyphs_.emplace(character, std::move(glyph)).first->second;
}

std::string Font::name() {
  return fmt::format("FreeType {}.{}.{}, DejaVu Sans", FREETYPE_MAJOR, FREETYPE_MINOR,
                     FREETYPE_PATCH);
}

}  // namespace ph::plot
