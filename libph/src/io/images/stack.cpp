// SPDX-License-Identifier: MIT
// Reads a folder of pictures as the slices of a volume.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <set>

#include "libph/src/io/bytes/readers.hpp"
#include "libph/src/io/tables/array.hpp"
#include "ph/detail/core/lower_case.hpp"
#include "ph/detail/io/table.hpp"

namespace ph::detail {
namespace {

// The formats of slices, by the extensions of their files.
struct SliceKind {
  std::string_view extension, name;
  Format format;
};
constexpr std::array kSliceKinds{
    SliceKind{".png", "PNG", Format::png}, SliceKind{".pgm", "PGM", Format::pgm},
    SliceKind{".tif", "TIFF", Format::tiff}, SliceKind{".tiff", "TIFF", Format::tiff}};

const SliceKind* slice_kind_of(std::string_view name) {
  const auto* const found = std::ranges::find_if(
      kSliceKinds, [&](const SliceKind& kind) { return ends_in(name, kind.extension); });
  return found == kSliceKinds.end() ? nullptr : found;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// The digits at the start of a text, without leading zeros.
std::string_view take_number(std::string_view& text) {
  std::size_t end = 0;
  while (end < text.size() && is_digit(text[end])) ++end;
  std::string_view digits = text.substr(0, end);
  text.remove_prefix(end);
  while (digits.size() > 1 && digits[0] == '0') digits.remove_prefix(1);
  return digits;
}

// The natural order: numbers in names are compared as numbers, and slice2 comes before slice10.
bool is_before(std::string_view a, std::string_view b) {
  const std::string_view whole_a = a, whole_b = b;
  while (!a.empty() && !b.empty()) {
    if (is_digit(a[0]) && is_digit(b[0])) {
      const std::string_view first = take_number(a), second = take_number(b);
      if (first.size() != second.size()) return first.size() < second.size();
      if (first != second) return first < second;
    } else {
      if (a[0] != b[0]) return a[0] < b[0];
      a.remove_prefix(1);
      b.remove_prefix(1);
    }
  }
  return a.empty() != b.empty() ? a.empty() : whole_a < whole_b;
}

// The last number in a name, if it is below 2^63.
std::optional<std::int64_t> last_number(std::string_view name) {
  name = name.substr(0, name.rfind('.'));
  while (!name.empty() && !is_digit(name.back())) name.remove_suffix(1);
  std::size_t begin = name.size();
  while (begin > 0 && is_digit(name[begin - 1])) --begin;
  std::int64_t number = 0;
  const auto [stop, error] =
      std::from_chars(name.data() + begin, name.data() + name.size(), number);
  if (begin == name.size() || error != std::errc{}) return std::nullopt;
  return number;
}

// The files in a folder that are slices, in their order.
class Slices {
 public:
  Slices(const Input& folder, Format format, const ReadOptions& options)
      : folder_(folder), options_(options) {
    if (format != Format::automatic &&
        std::ranges::find(kSliceKinds, format, &SliceKind::format) == kSliceKinds.end())
      throw Error(ErrorKind::usage,
                  fmt::format("{}: reads folders of PNG, PGM or TIFF pictures, found format {}",
                              mark(Setting::stack), format_info(format).name));
    list(format);
    std::ranges::sort(names_, is_before);
    note_on_order();
  }

  const std::vector<std::string>& names() const { return names_; }
  const SliceKind& kind() const { return *kind_; }

 private:
  void list(Format format) {
    std::error_code error;
    std::vector<std::string> others;
    std::filesystem::directory_iterator at(folder_.path(), error), end;
    for (; !error && at != end; at.increment(error)) {
      std::string name = at->path().filename().string();
      const SliceKind* const kind = slice_kind_of(name);
      std::error_code ignored;
      if (kind == nullptr || name[0] == '.' || at->is_directory(ignored) ||
          (format != Format::automatic && kind->format != format)) {
        others.push_back(std::move(name));
        continue;
      }
      if (kind_ != nullptr && kind->format != kind_->format) {
        folder_.fail({"slices of two formats", fmt::format("{} and {}", kind_->name, kind->name),
                      "one format",
                      mark(Setting::format, fmt::format("{}|{}", format_info(kind_->format).name,
                                                        format_info(kind->format).name)) +
                          " chooses one"});
      }
      kind_ = kind;
      names_.push_back(std::move(name));
    }
    if (error)
      throw Error(ErrorKind::io, fmt::format("{}: cannot read the folder: {}",
                                             mark_place(folder_.name()), error.message()));
    if (names_.empty())
      folder_.fail({"no slices",
                    fmt::format("{} other files", others.size()),
                    "PNG, PGM or TIFF pictures in the folder itself, for " + mark(Setting::stack),
                    {}});
    if (others.empty()) return;
    std::ranges::sort(others, is_before);
    note(options_, fmt::format("{} other file{} or folder{} not read, such as {}", others.size(),
                               others.size() == 1 ? "" : "s", others.size() == 1 ? " is" : "s are",
                               printable(others[0], 80)));
  }

  // Says which slices are read, and reports the first gap in their numbers.
  void note_on_order() const {
    note(options_,
         fmt::format("{} slice{}, from {} to {}", names_.size(), names_.size() == 1 ? "" : "s",
                     printable(names_.front(), 80), printable(names_.back(), 80)));
    std::optional<std::int64_t> step;
    for (std::size_t k = 1; k < names_.size(); ++k) {
      const auto before = last_number(names_[k - 1]), after = last_number(names_[k]);
      const std::optional<std::int64_t> here =
          before && after ? std::optional(*after - *before) : std::nullopt;
      if (k == 1) step = here;
      if (here == step && here != 0) continue;
      note(options_, fmt::format("the numbers of the slices are not evenly spaced: {} is followed "
                                 "by {}",
                                 printable(names_[k - 1], 80), printable(names_[k], 80)));
      return;
    }
  }

  const Input& folder_;
  const ReadOptions& options_;
  const SliceKind* kind_ = nullptr;
  std::vector<std::string> names_;
};

// Reads slices into one array. The first slice decides on the size and the type.
class StackReader {
 public:
  StackReader(const Input& folder, const Slices& slices, const ReadOptions& options)
      : folder_(folder), slices_(slices), options_(options) {}

  Image read() {
    Image first = slice(0);
    Image volume{first.extents, {}, false};
    volume.extents.insert(volume.extents.begin(), static_cast<Index>(slices_.names().size()));
    const auto count = checked_product(first.values.size(), slices_.names().size());
    volume.values = with_voxels(first.values.type(), nullptr, [&]<class T>(const T*) {
      const std::size_t bytes =
          checked_product(count.value_or(SIZE_MAX), sizeof(T)).value_or(SIZE_MAX);
      const auto fill = [&](std::span<T> to) { fill_with(std::move(first), to, volume.masked); };
      if (count && stays_in_file(folder_, bytes))
        return voxels_in_file<T>(first.values.type(), *count, fill);
      folder_.require_memory(bytes);
      std::vector<T> values(*count);
      fill(values);
      return Voxels(std::move(values));
    });
    return volume;
  }

 private:
  template <class T>
  void fill_with(Image first, std::span<T> to, bool& masked) {
    const std::size_t each = first.values.size();
    const auto take = [&](const Image& image, std::size_t k) {
      std::copy_n(static_cast<const T*>(image.values.data()), each, to.data() + k * each);
      masked = masked || image.masked;
    };
    take(first, 0);
    const std::vector<Index> extents = first.extents;
    const VoxelType type = first.values.type();
    first = {};
    for (std::size_t k = 1; k < slices_.names().size(); ++k) {
      const Image image = slice(k);
      if (image.extents != extents || image.values.type() != type)
        fail(k, text_of(image.extents, image.values.type()), text_of(extents, type));
      take(image, k);
      folder_.poll();
    }
  }

  static std::string text_of(const std::vector<Index>& extents, VoxelType type) {
    constexpr std::array<std::string_view, 5> kNames{"uint8", "uint16", "int16", "float32",
                                                     "float64"};
    return fmt::format("{} x {} pixels of {}", extents[1], extents[0],
                       kNames[static_cast<std::size_t>(type)]);
  }

  [[noreturn]] void fail(std::size_t k, const std::string& found, const std::string& expected) {
    path_input(k).fail({"a slice of another kind",
                        found,
                        fmt::format("{}, as in {}", expected, printable(slices_.names()[0], 80)),
                        {}});
  }

  Input path_input(std::size_t k) const {
    return Input::open(folder_.path() / slices_.names()[k], folder_.context());
  }

  Image slice(std::size_t k) {
    const Input input = path_input(k);
    ReadOptions inner = options_;
    inner.note = [&](Message text) {
      // Most notes are the same for all slices.
      if (options_.note && notes_.insert(text.marked()).second)
        options_.note(fmt::format("{}: {}", printable(slices_.names()[k], 80), text.marked()));
    };
    const Image image = slices_.kind().format == Format::png   ? read_png_image(input, inner)
                        : slices_.kind().format == Format::pgm ? read_pgm_image(input)
                                                               : read_tiff_image(input, inner);
    if (image.extents.size() != 2)
      input.fail({"a slice with several pages",
                  fmt::format("{} axes", image.extents.size()),
                  "one picture",
                  {}});
    return image;
  }

  const Input& folder_;
  const Slices& slices_;
  const ReadOptions& options_;
  std::set<std::string> notes_;
};

}  // namespace

bool may_be_slice(std::string_view name) { return slice_kind_of(name) != nullptr; }

Stack read_stack(const Input& folder, Format format, const ReadOptions& options) {
  const Slices slices(folder, format, options);
  return {StackReader(folder, slices, options).read(), slices.kind().format, slices.kind().name};
}

std::vector<std::string> slices_in(const Input& folder, Format format) {
  return Slices(folder, format, {}).names();
}

}  // namespace ph::detail
