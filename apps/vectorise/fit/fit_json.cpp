// SPDX-License-Identifier: MIT
#include "apps/vectorise/fit/fit.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "apps/common/arguments/command_line.hpp"
#include "apps/common/terminal/build_information.hpp"
#include "ph/detail/io/json_cursor.hpp"
#include "ph/detail/io/json_writer.hpp"
#include "ph/error.hpp"
#include "ph/euler_curve.hpp"

namespace ph::vectorise {
namespace {

using detail::JsonCursor;

constexpr std::string_view kFormat = "ph-vectorise fit";
constexpr std::int64_t kMost = std::int64_t{1} << 30;  // the largest accepted count

std::string range_json(double lo, double hi, std::string_view name, std::size_t count) {
  return json::object(
      {{"lo", json::number(lo)}, {"hi", json::number(hi)}, {name, json::integer(count)}});
}

bool has_grid(Kind kind) {
  return kind == Kind::betti || kind == Kind::landscape || kind == Kind::silhouette ||
         kind == Kind::life_entropy || kind == Kind::euler;
}

std::string block_json(const Fit& fit, const Block& block) {
  std::string members;
  if (fit.kind != Kind::euler) json::add_members(members, {{"dim", json::integer(block.dim)}});
  json::add_members(members,
                    {{"shape", json::array(shape_of(fit, block), json::integer<std::size_t>)}});
  if (has_grid(fit.kind))
    json::add_members(
        members, {{"grid", range_json(block.grid.lo, block.grid.hi, "points", block.grid.points)}});
  if (fit.kind == Kind::image) {
    const auto& [births, lengths] = block.frame;
    json::add_members(members,
                      {{"births", range_json(births.lo, births.hi, "pixels", births.pixels)},
                       {"lengths", range_json(lengths.lo, lengths.hi, "pixels", lengths.pixels)},
                       {"sigma", json::number(block.sigma)}});
  }
  if (fit.kind == Kind::atol)
    json::add_members(
        members,
        {{"centres", json::array(block.atol.centres, json::numbers<std::array<double, 2>>)},
         {"widths", json::numbers(block.atol.widths)},
         {"contrast", json::string(name_of(block.atol.contrast))}});
  return "{" + members + "}";
}

/// Reads the JSON that fit_json writes. Unknown members are skipped.
class Reader {
 public:
  explicit Reader(const Input& input) : input_(input), json_(input) {}

  Fit read() {
    bool has_format = false, has_kind = false;
    std::set<std::string> seen;
    std::optional<std::int64_t> length;
    json_.for_each_member([&](const std::string& name) {
      const std::size_t place = json_.place();
      if (!seen.insert(name).second) json_.fail(place, {name, "a second one", "one", {}});
      if (name == "format") {
        if (const std::string value = json_.string(); value != kFormat)
          json_.fail(place, {"format", printable(value, 40), std::string(kFormat), {}});
        has_format = true;
      } else if (name == "version") {
        json_.integer(1, 1, "version");
      } else if (name == "kind") {
        fit_.kind = word<Kind>("kind");
        has_kind = true;
      } else if (name == "length") {
        length = json_.integer(1, std::numeric_limits<std::int64_t>::max(), "length");
      } else if (name == "infinite") {
        read_infinite();
      } else if (name == "layers") {
        fit_.layers = count("layers");
      } else if (name == "count") {
        fit_.count = count("count");
      } else if (name == "power") {
        fit_.power = json_.number();
      } else if (name == "normalised") {
        fit_.normalised = json_.boolean();
      } else if (name == "construction") {
        fit_.cubical.construction = word<CubicalOptions::Construction>("construction");
      } else if (name == "superlevel") {
        fit_.cubical.superlevel = json_.boolean();
      } else if (name == "periodic") {
        json_.for_each_element([&] { fit_.cubical.periodic.push_back(json_.boolean()); });
      } else if (name == "blocks") {
        json_.for_each_element([&] { read_block(); });
      } else {
        json_.skip_value();
      }
    });
    json_.expect_end();
    if (!has_format || !has_kind || fit_.blocks.empty())
      input_.fail({"not a fit",
                   "an incomplete object",
                   R"("format": "ph-vectorise fit", "kind" and "blocks")",
                   {}});
    for (const char* const parameter : parameters_of(fit_.kind))
      if (!seen.contains(parameter))
        input_.fail({"not a fit",
                     fmt::format("no {}", parameter),
                     fmt::format("{} with this kind", parameter),
                     {}});
    check();
    if (length && static_cast<std::uint64_t>(*length) != length_of(fit_))
      input_.fail({"length",
                   fmt::format("{}", *length),
                   fmt::format("{}, the length of the blocks", length_of(fit_)),
                   {}});
    return std::move(fit_);
  }

 private:
  std::size_t count(const char* what) {
    return static_cast<std::size_t>(json_.integer(1, kMost, what));
  }
  template <class Enum>
  Enum word(const char* what) {
    const std::size_t place = json_.place();
    const std::string text = json_.string();
    const std::optional<Enum> value = value_named<Enum>(text);
    if (!value)
      json_.fail(
          place,
          {what, printable(text, 40), fmt::format("{}", fmt::join(all_names<Enum>, ", ")), {}});
    return *value;
  }
  void read_infinite() {
    using Rule = InfiniteRule::Rule;
    if (json_.peek() == '"')
      fit_.infinite = {word<Rule>("infinite"), 0};
    else
      fit_.infinite = {Rule::cap, json_.number()};  // mutant: fit-infinite
  }
  /// The settings that affect the vectors of a kind, in addition to its blocks.
  static std::vector<const char*> parameters_of(Kind kind) {
    switch (kind) {
      case Kind::landscape:
        return {"layers"};
      case Kind::lengths:
        return {"count"};
      case Kind::silhouette:
      case Kind::image:
        return {"power"};
      case Kind::entropy:
        return {"normalised"};
      case Kind::euler:
        return {"construction", "superlevel"};
      default:
        return {};
    }
  }
  void read_block() {
    Block& block = fit_.blocks.emplace_back();
    std::vector<std::size_t>& shape = shapes_.emplace_back();
    json_.for_each_member([&](const std::string& name) {
      if (name == "shape")
        json_.for_each_element([&] { shape.push_back(count("number")); });
      else if (name == "dim")
        block.dim = static_cast<int>(json_.integer(0, kMost, "dimension"));
      else if (name == "grid")
        read_range(block.grid.lo, block.grid.hi, "points", block.grid.points);
      else if (name == "births")
        read_pixels(block.frame.births);
      else if (name == "lengths")
        read_pixels(block.frame.lengths);
      else if (name == "sigma")
        block.sigma = json_.number();
      else if (name == "centres")
        json_.for_each_element([&] { read_centre(block.atol); });
      else if (name == "widths")
        json_.for_each_element([&] { block.atol.widths.push_back(json_.number()); });
      else if (name == "contrast")
        block.atol.contrast = word<Atol::Contrast>("contrast");
      else
        json_.skip_value();
    });
  }
  void read_centre(Atol& atol) {
    const std::size_t place = json_.place();
    std::vector<double> numbers;
    json_.for_each_element([&] { numbers.push_back(json_.number()); });
    if (numbers.size() != 2)
      json_.fail(place,
                 {"centre", fmt::format("{} numbers", numbers.size()), "birth and death", {}});
    atol.centres.push_back({numbers[0], numbers[1]});
  }
  void read_pixels(PixelRange& range) { read_range(range.lo, range.hi, "pixels", range.pixels); }
  void read_range(double& lo, double& hi, std::string_view counted, std::size_t& number) {
    json_.for_each_member([&](const std::string& name) {
      if (name == "lo")
        lo = json_.number();
      else if (name == "hi")
        hi = json_.number();
      else if (name == counted)
        number = count("number");
      else
        json_.skip_value();
    });
  }

  /// Checks that the functions accept the fit, by calling them without bars.
  void check() {
    if (fit_.infinite.rule == InfiniteRule::Rule::keep && !may_keep_infinite(fit_.kind))
      input_.fail({"infinite", "keep", "drop, error or a number with this kind", {}});
    if (fit_.kind == Kind::euler && fit_.blocks.size() > 1)
      input_.fail({"blocks", fmt::format("{}", fit_.blocks.size()), "one for an Euler curve", {}});
    const RunContext& context = input_.context() ? *input_.context() : default_context();
    try {
      for (std::size_t i = 0; i < fit_.blocks.size(); ++i) {
        const Block& block = fit_.blocks[i];
        std::size_t length = 1;
        const std::vector<std::size_t> shape = shape_of(fit_, block);
        if (!shapes_[i].empty() && shapes_[i] != shape)
          input_.fail({"shape",
                       fmt::format("[{}]", fmt::join(shapes_[i], ", ")),
                       fmt::format("[{}], the shape of the grids", fmt::join(shape, ", ")),
                       {}});
        for (const std::size_t n : shape) length *= n;
        if (length > static_cast<std::size_t>(kMost))
          input_.fail({"shape", fmt::format("{} numbers", length), "at most 2^30", {}});
        std::pmr::vector<double> out(length, &context.memory);
        if (fit_.kind == Kind::euler)
          StepFunction().sample(block.grid, out);
        else
          write_block(fit_, block, {}, out, context);
      }
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::usage) throw;
      throw Error(ErrorKind::bad_data,
                  fmt::format("{}: {}", mark_place(input_.name()), error.marked()));
    }
  }

  const Input& input_;
  JsonCursor json_;
  Fit fit_;
  std::vector<std::vector<std::size_t>> shapes_;  // as the file states them
};

}  // namespace

std::string fit_json(const Fit& fit, std::size_t dropped) {
  using Rule = InfiniteRule::Rule;
  const Kind kind = fit.kind;
  const auto only = [](bool is_wanted, std::string text) {
    return is_wanted ? std::move(text) : std::string();
  };
  const bool is_euler = kind == Kind::euler;
  return json::document({
      {"format", json::string(kFormat)},
      {"version", "1"},
      {"program", json::string(app::program_and_version("ph-vectorise"))},
      {"kind", json::string(name_of(kind))},
      {"length", json::integer(length_of(fit))},
      {"infinite", fit.infinite.rule == Rule::cap ? json::number(fit.infinite.cap)
                                                  : json::string(name_of(fit.infinite.rule))},
      {"dropped", json::integer(dropped)},
      {"layers", only(kind == Kind::landscape, json::integer(fit.layers))},
      {"count", only(kind == Kind::lengths, json::integer(fit.count))},
      {"power", only(kind == Kind::silhouette || kind == Kind::image, json::number(fit.power))},
      {"normalised", only(kind == Kind::entropy, json::boolean(fit.normalised))},
      {"construction", only(is_euler, json::string(name_of(fit.cubical.construction)))},
      {"superlevel", only(is_euler, json::boolean(fit.cubical.superlevel))},
      {"periodic", only(is_euler, json::array(fit.cubical.periodic, json::boolean))},
      {"blocks",
       json::lines(fit.blocks, [&](const Block& block) { return block_json(fit, block); })},
  });
}

Fit read_fit(const Input& input) { return Reader(input).read(); }

}  // namespace ph::vectorise
