// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "ph/barcode.hpp"
#include "ph/detail/io/png.hpp"
#include "ph/io/plot.hpp"
#include "ph/run_context.hpp"

namespace ph::plot {

/// A colour as 0x00RRGGBB.
using Colour = std::uint32_t;

inline constexpr double kWidth = 250;   // in points: 88 mm, the width of a journal column
inline constexpr Index kPixels = 1040;  // width of a PNG, at 300 dots per inch
inline constexpr double kDotsPerInch = 300;
inline constexpr double kHalo = 1.6;  // width of a line around text, half of it outside the text
inline constexpr Colour kInk = 0x222222, kGrey = 0x767676, kGrid = 0xe4e4e4, kWhite = 0xffffff;

/// The colours of Okabe and Ito, which people with any kind of colour vision can distinguish.
Colour colour_of_dim(int dim);
/// "H" (or another letter) followed by a dimension in Unicode's subscript digits.
std::string with_subscript(std::string_view letter, int number);
/// Formats a number as "12,345".
std::string grouped(std::size_t number);
/// The characters of a UTF-8 text. Control characters of ASCII, U+FFFE, U+FFFF and malformed bytes
/// become U+FFFD, because XML does not allow most of them.
std::vector<std::string> characters_of(std::string_view text);

/// An outline that consists of lines, which may be closed, and of circles.
class Outline {
 public:
  enum class Verb : std::uint8_t {
    move_to,
    line_to,
    line_by,
    horizontal_to,  // uses only x
    horizontal_by,
    vertical_to,  // uses only y
    vertical_by,
    // The circle starts and ends at the current place, and extends to the right by its width x.
    circle_by,
    close
  };
  struct Step {
    Verb verb;
    double x, y;
  };

  Outline& move_to(double x, double y) { return add({Verb::move_to, x, y}); }
  Outline& line_to(double x, double y) { return add({Verb::line_to, x, y}); }
  Outline& line_by(double x, double y) { return add({Verb::line_by, x, y}); }
  Outline& horizontal_to(double x) { return add({Verb::horizontal_to, x, 0}); }
  Outline& horizontal_by(double x) { return add({Verb::horizontal_by, x, 0}); }
  Outline& vertical_to(double y) { return add({Verb::vertical_to, 0, y}); }
  Outline& vertical_by(double y) { return add({Verb::vertical_by, 0, y}); }
  Outline& circle(double x, double y, double radius) {
    return move_to(x - radius, y).add({Verb::circle_by, 2 * radius, 0});
  }
  Outline& close() { return add({Verb::close, 0, 0}); }

  bool empty() const { return steps_.empty(); }
  const std::vector<Step>& steps() const { return steps_; }
  Outline& add(const Step& step) {
    steps_.push_back(step);
    return *this;
  }

 private:
  std::vector<Step> steps_;
};

enum class Anchor { start, middle, end };
enum class Look {
  plain,
  bold,
  upwards,  ///< rotated to read from bottom to top
  haloed    ///< bold, with white around it
};
enum class Stroke { solid, dashed };

/// The style of an outline. Overlapping parts of one outline form a single area.
struct Style {
  std::optional<Colour> fill = {}, stroke = {};
  double stroke_width = 1;  ///< lines meet in round joints
  double fill_opacity = 1;
  bool crisp = false;  ///< without antialiasing, so that adjacent areas show no seam
};

// The elements of a picture.
struct Line {
  double x1, y1, x2, y2;
  Colour colour;
  double width;
  Stroke stroke;
};
struct Rectangle {
  double x, y, width, height;
  Colour colour;
  double opacity;
};
struct Shape {
  Outline outline;
  Style style;
};
struct Text {
  double x, y;  // the place of its anchor on the baseline
  std::string content;
  Anchor anchor;
  double size;
  Colour colour;
  Look look;
};
struct Picture {
  double x, y, width, height;
  const Raster* raster;
};
using Element = std::variant<Line, Rectangle, Shape, Text, Picture>;

/// A complete picture on a white background. The functions to_svg and to_raster convert it to file
/// formats.
struct Drawing {
  double height = 0, width = kWidth;  // in points
  std::optional<PlotSize> size = {};  // if empty: 88 mm, kPixels wide
  std::string title, description;     // for readers who cannot see the picture
  std::vector<Element> elements;
};

/// Collects the elements of one picture.
class Canvas {
 public:
  void line(double x1, double y1, double x2, double y2, Colour colour, double width,
            Stroke stroke = Stroke::solid);
  void rect(double x, double y, double width, double height, Colour colour, double opacity = 1);
  /// Draws nothing if the outline is empty.
  void shape(Outline outline, const Style& style);
  void text(double x, double y, std::string_view content, Anchor anchor = Anchor::start,
            double size = 7, Colour colour = kInk, Look look = Look::plain);
  /// Draws a raster. @param raster must outlive the drawing.
  void picture(double x, double y, double width, double height, const Raster& raster);
  /// Draws the title above everything. If the title is too long, its middle is left out.
  void title(const std::string& title);
  /// Returns the complete drawing and leaves the canvas empty.
  Drawing finish(double height, std::string_view title, std::string_view description);

 private:
  std::vector<Element> elements_;
};

/// The smallest and the largest finite value. If there is no finite value, these are 0 and 1, or 1
/// and 10 on a logarithmic axis.
struct Range {
  double low = 0;
  double high = 1;
};

/// Maps the finite values of a barcode to positions and places the ticks. It works for values of
/// any size, because it computes in units of a power of ten.
class Axis {
 public:
  /// @param range the values at the ends of the axis. The options may replace these values. If both
  /// values are equal, the range is widened.
  /// @throws Error (usage) if the options leave an empty range or an infinite end, or if a
  /// logarithmic axis would show values that are not above 0.
  Axis(const Range& range, const PlotOptions& options, double from, double to);

  double from() const { return from_; }
  double to() const { return to_; }
  /// The position of a value. A value that is infinite or beyond an end gets the position of that
  /// end.
  double at(double value) const;

  struct Tick {
    double position;
    std::string label;
  };
  /// About `count` ticks at round numbers.
  std::vector<Tick> ticks(int count) const;
  /// The text "×10⁻⁶" if the labels are in these units, otherwise empty.
  std::string unit() const;
  /// Draws gridlines between `top` and `bottom`, and the ticks, the labels and the name of the axis
  /// below `bottom`.
  void draw_below(Canvas& canvas, double top, double bottom, const std::string& name) const;

 private:
  std::vector<Tick> powers_of_ten(int count) const;
  std::vector<Tick> round_values(int count) const;
  std::string label_of(double value, int decimals) const;
  /// A value in the units of low_ and high_. On a logarithmic axis of negated data, it is minus the
  /// logarithm of the original value.
  double in_scale(double value) const;

  double low_ = 0, high_ = 1;  // in units of 10^exponent_; logarithms on a logarithmic axis
  double from_, to_;
  int exponent_ = 0;
  bool shows_unit_ = false, logarithmic_ = false, negated_ = false;
};

/// The limits of the axis in terms of the bars' values. For negated data, the two limits are
/// negated and swapped.
PlotAxis limits_of(const PlotOptions& options);
/// The range of the values on the axis, or an arbitrary range if there are no values.
Range finite_range(const Barcode& barcode, const PlotOptions& options);
Range finite_range(std::span<const Branch> tree, const std::vector<std::size_t>& classes,
                   const PlotOptions& options);
/// True if a class is visible on the axis. @param limits see limits_of.
bool is_shown(double birth, double death, const PlotAxis& limits);
/// The bars that are drawn, without cells. @param beyond receives the number of bars that are
/// beyond the axis.
Barcode shown_of(const Barcode& barcode, const PlotOptions& options, std::size_t& beyond);
/// Writes, to the left of the axis's name, how many bars are beyond the axis.
void explain_beyond(Canvas& canvas, std::size_t beyond, double bottom);
/// Centres the drawing in a picture of the size that the options give.
Drawing fitted(Drawing drawing, const PlotOptions& options);
/// The dimensions that have bars, ascending.
std::vector<int> dims_of(const Barcode& barcode);
/// A description such as "214 bars in H₀, 3 in H₁".
std::string description_of(const Barcode& barcode);

// Each of these functions draws the visible bars of a barcode, a merge tree, or a coloured picture.
// @param beyond the number of bars that are beyond the axis.
Drawing draw_barcode(const Barcode& barcode, std::size_t beyond, const PlotOptions& options);
Drawing draw_diagram(const Barcode& barcode, std::size_t beyond, const PlotOptions& options);
Drawing draw_betti(const Barcode& barcode, std::size_t beyond, const PlotOptions& options);
Drawing draw_tree(std::span<const Branch> tree, const PlotOptions& options);
Drawing draw_coloured(const ColouredPicture& picture, const PlotOptions& options);
/// Draws any kind of plot. @throws Error (internal) on an unknown kind.
Drawing draw(const Barcode& barcode, const PlotOptions& options);

std::string to_svg(const Drawing& drawing);

/// The number of bytes that to_raster needs, including the bytes for writing its result as a PNG.
std::size_t raster_bytes(const Drawing& drawing);

/// Converts the drawing to RGB. @throws std::bad_alloc; Error (internal) as Font.
Raster to_raster(const Drawing& drawing);

}  // namespace ph::plot
