// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "ph/core/barcode.hpp"
#include "ph/io/svg_plot.hpp"

namespace ph::svg {

inline constexpr double kWidth = 250;  // points: 88 mm, a column of a paper
inline constexpr std::string_view kInk = "#222222";
inline constexpr std::string_view kGrey = "#767676";
inline constexpr std::string_view kGrid = "#e4e4e4";

/// Okabe and Ito's colours, told apart with every kind of colour vision.
std::string_view colour_of_dim(int dim);
/// "H" and a dimension in Unicode's subscript digits; the same for any other letter.
std::string with_subscript(std::string_view letter, int number);
/// "12,345"
std::string grouped(std::size_t number);
/// Text as XML content or attribute; what XML cannot hold becomes U+FFFD.
std::string xml_escaped(std::string_view text);
/// A coordinate with two decimals at most.
std::string coordinate(double value);

enum class Anchor { start, middle, end };

/// Collects the elements of one picture.
class Canvas {
 public:
  void line(double x1, double y1, double x2, double y2, std::string_view colour, double width,
            std::string_view more = {});
  void rect(double x, double y, double width, double height, std::string_view colour,
            double opacity = 1);
  /// @param data path commands; nothing is drawn if there are none. @param style attributes.
  void path(const std::string& data, const std::string& style);
  void text(double x, double y, std::string_view content, Anchor anchor = Anchor::start,
            double size = 7, std::string_view colour = kInk, std::string_view more = {});
  /// The title above everything; cut in its middle if it is too long.
  void title(const std::string& title);
  /// The whole document. @param description for those who cannot see the picture.
  std::string finish(double height, const std::string& title, const std::string& description) const;

 private:
  std::string elements_;
};

/// Maps the finite values of a barcode to positions and says where the ticks are. Safe for values
/// of any size: it computes in units of a power of ten.
class Axis {
 public:
  /// @param low, high values at the ends; widened if they are equal.
  Axis(double low, double high, double from, double to);

  double from() const { return from_; }
  double to() const { return to_; }
  /// Position of a value; an infinite one, or one beyond the ends, lies at the end.
  double at(double value) const;

  struct Tick {
    double position;
    std::string label;
  };
  /// About `count` ticks at round numbers.
  std::vector<Tick> ticks(int count) const;
  /// "×10⁻⁶" if the labels are in such units, else empty.
  std::string unit() const;
  /// Draws gridlines between `top` and `bottom`, ticks, labels and the axis' name below `bottom`.
  void draw_below(Canvas& canvas, double top, double bottom, const std::string& name) const;

 private:
  double low_, high_;  // in units of 10^exponent_
  double from_, to_;
  int exponent_ = 0;
  bool shows_unit_ = false;
};

/// The least and the largest finite value of a barcode; 0 and 1 if there is none.
struct Range {
  double low = 0;
  double high = 1;
};
Range finite_range(const Barcode& barcode);
/// The dimensions that have bars, ascending.
std::vector<int> dims_of(const Barcode& barcode);
/// "214 bars in H₀, 3 in H₁"
std::string description_of(const Barcode& barcode);

std::string draw_barcode(const Barcode& barcode, const PlotOptions& options);
std::string draw_diagram(const Barcode& barcode, const PlotOptions& options);
std::string draw_betti(const Barcode& barcode, const PlotOptions& options);
std::string draw_tree(std::span<const Branch> tree, const PlotOptions& options);

}  // namespace ph::svg
