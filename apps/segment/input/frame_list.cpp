// SPDX-License-Identifier: MIT
#include "apps/segment/input/frame_list.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <utility>

#include "ph/detail/core/files.hpp"
#include "ph/detail/io/reader.hpp"
#include "ph/error.hpp"

namespace ph::segment {
namespace {

constexpr std::size_t kMostName = 1 << 16;  // in bytes; systems allow about 4 096

}  // namespace

FrameList::FrameList(const std::string& path, const RunContext& context)
    : context_(context), name_(path == "-" ? "standard input" : printable(path)) {
  const bool is_standard = path == "-";
  if (is_standard) files::pass_bytes(files::kStandardInput);
  file_ = is_standard ? files::kStandardInput : files::open_to_read(files::path_of(path));
  const auto status = file_ < 0 ? std::nullopt : files::status_of(file_);
  if (!status || status->kind == files::Kind::folder)
    throw Error(ErrorKind::no_input, fmt::format("{}: cannot read the list of frames: {}", name_,
                                                 files::reason(status ? EISDIR : errno)));
  is_file_ = status->kind == files::Kind::regular;
}

FrameList::~FrameList() {
  if (file_ != files::kStandardInput && file_ >= 0) files::close(file_);
}

const std::deque<std::string>& FrameList::known() {
  if (is_file_)
    while (std::optional<std::string> name = read_name()) ahead_.push_back(*std::move(name));
  return ahead_;
}

std::optional<std::string> FrameList::next() {
  if (ahead_.empty()) return read_name();
  std::string name = std::move(ahead_.front());
  ahead_.pop_front();
  return name;
}

std::optional<std::string> FrameList::read_name() {
  while (std::optional<std::string> line = read_line()) {
    if (line->ends_with('\r')) line->pop_back();
    if (const std::size_t nul = line->find('\0'); nul != std::string::npos)
      throw Error(
          ErrorKind::bad_data,
          fmt::format("--frames-from: found a NUL byte after '{}', expected one name per line",
                      printable(line->substr(0, nul))));
    if (!line->empty()) return line;
  }
  return std::nullopt;
}

std::optional<std::string> FrameList::read_line() {
  std::size_t looked_at = 0;
  for (;;) {
    if (const std::size_t end = read_.find('\n', looked_at); end != std::string::npos) {
      std::string line = read_.substr(0, end);
      read_.erase(0, end + 1);
      return line;
    }
    looked_at = read_.size();
    if (looked_at > kMostName)
      throw Error(ErrorKind::bad_data,
                  fmt::format("--frames-from: found a line of more than {} bytes, '{}', expected "
                              "one name per line",
                              kMostName, printable(read_, 40)));
    std::array<char, 1 << 12> some{};
    const std::ptrdiff_t got = files::read_some(file_, some.data(), some.size());
    if (got < 0 && errno != EAGAIN)  // mutant: frame-list-error
      throw Error(ErrorKind::io, fmt::format("{}: cannot read the list of frames: {}", name_,
                                             files::reason(errno)));
    if (got == 0) {
      if (read_.empty()) return std::nullopt;
      return std::exchange(read_, {});  // mutant: frame-list-last
    }
    if (got > 0) read_.append(some.data(), static_cast<std::size_t>(got));
    context_.poll();
  }
}

}  // namespace ph::segment
