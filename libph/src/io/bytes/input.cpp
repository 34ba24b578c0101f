// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <memory_resource>
#include <system_error>
#include <tuple>
#include <utility>

#include "libph/src/io/bytes/unpack.hpp"
#include "libph/src/io/bytes/utf8.hpp"
#include "ph/detail/core/files.hpp"
#include "ph/detail/core/format_size.hpp"
#include "ph/detail/core/lower_case.hpp"
#include "ph/detail/core/machine_memory.hpp"
#include "ph/detail/io/reader.hpp"

namespace ph {
namespace {

// Files up to this size are copied instead of mapped. Copying is cheaper than page faults, and is
// safe if the file shrinks.
constexpr std::size_t kMapFrom = std::size_t{16} << 20;
constexpr std::size_t kFirstChunk = std::size_t{64} << 10;
// The bytes of a stream that are checked before the rest is read.
constexpr std::size_t kStart = 4096;
// A stream that begins with this many NUL bytes contains no data.
constexpr std::size_t kNulProbe = std::size_t{1} << 20;

// A file descriptor, which the destructor closes unless it is standard input.
class Descriptor {
 public:
  Descriptor(int number, bool owned) : number_(number), owned_(owned) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (owned_ && number_ >= 0) files::close(number_);
  }
  int get() const { return number_; }

 private:
  int number_;
  bool owned_;
};

std::string lower_extension(const std::filesystem::path& path) {
  return lower_case(path.extension().string());
}

std::size_t half_of_memory() {
  const std::uint64_t all = physical_memory();
  return all == 0 ? std::numeric_limits<std::size_t>::max() : static_cast<std::size_t>(all / 2);
}

// The length of the UTF-8 sequence at the start of `s`. It is 0 if the sequence is invalid or not
// allowed in a message.
std::size_t printable_length(std::string_view s) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(s[i]); };
  const std::size_t length = utf8_length(s);
  if (length == 1 && (byte(0) < 0x20 || byte(0) == 0x7F)) return 0;
  // C1 control characters are not allowed.
  if (length == 2 && byte(0) == 0xC2 && byte(1) < 0xA0) return 0;
  // Line separators and marks that reorder text are not allowed, because a name with them could
  // change how the message around it reads.
  if (length == 3 && byte(0) == 0xE2 && byte(1) == 0x80 && byte(2) >= 0xA8 && byte(2) <= 0xAE)
    return 0;
  return length;
}

std::string message_of(const std::string& place, const Fault& fault) {
  std::string message = mark_place(place) + ": " + fault.what;
  if (!fault.found.empty()) message += ", found " + fault.found;
  if (!fault.expected.empty()) message += ", expected " + fault.expected;
  if (!fault.hint.empty()) message += "; " + fault.hint.marked();
  return message;
}

}  // namespace

std::string printable(std::string_view bytes, std::size_t max_bytes) {
  std::string result;
  while (!bytes.empty()) {
    if (result.size() >= max_bytes) return result + "...";
    const std::size_t length = printable_length(bytes);
    const auto c = static_cast<unsigned char>(bytes[0]);
    if (length == 0) {
      if (c == '\n') {
        result += "\\n";
      } else if (c == '\t') {
        result += "\\t";
      } else if (c == '\r') {
        result += "\\r";
      } else {
        result += fmt::format("\\x{:02X}", c);
      }
      bytes.remove_prefix(1);
    } else {
      result += bytes.substr(0, length);
      bytes.remove_prefix(length);
    }
  }
  return result;
}

// The bytes of an Input. They are in a buffer of the run's memory resource, a mapped file, a vector
// or a temporary file.
struct Input::Storage {
  explicit Storage(std::pmr::memory_resource* resource) : memory(resource) {}
  explicit Storage(std::pmr::vector<char> bytes)
      : memory(bytes.get_allocator().resource()), held(std::move(bytes)) {}
  explicit Storage(ScratchFile file) : memory(nullptr), scratch(std::move(file)), exceeds(true) {}
  Storage(const Storage&) = delete;
  Storage& operator=(const Storage&) = delete;
  ~Storage() {
    if (mapped) {
      files::unmap(data, capacity);
    } else if (data != nullptr) {
      memory->deallocate(data, capacity, alignof(std::max_align_t));
    }
  }

  void grow_to(std::size_t bytes) {
    char* larger = static_cast<char*>(memory->allocate(bytes, alignof(std::max_align_t)));
    if (data != nullptr) {
      std::memcpy(larger, data, used);
      memory->deallocate(data, capacity, alignof(std::max_align_t));
    }
    data = larger;
    capacity = bytes;
  }

  /// Drops the pages of a mapped file before this byte, which were read. They would stay in memory
  /// while the results grow.
  void let_go_to(std::size_t done) {
    if (done > let_go) forget_file_pages(data + let_go, done - let_go);
    let_go = done;  // a second pass begins at 0 again
  }

  std::pmr::memory_resource* memory;
  std::pmr::vector<char> held;
  std::optional<ScratchFile> scratch;
  char* data = nullptr;
  std::size_t capacity = 0;
  std::size_t used = 0;
  bool mapped = false;
  std::size_t let_go = 0;            // the first byte of a mapped file that may be in memory
  std::optional<MemoryClaim> claim;  // the memory of a mapped file's pages
  // True if the input exceeds the budget. It then stays in a file and is not counted.
  bool exceeds = false;
};

Input::Input() = default;
Input::Input(Input&&) noexcept = default;
Input& Input::operator=(Input&&) noexcept = default;
Input::~Input() = default;

Input Input::view(std::string_view bytes, const std::string& name, const RunContext* context) {
  Input input;
  input.context_ = context;
  input.text_ = bytes;
  input.extension_ = lower_extension(name);
  input.name_ = printable(name);
  return input;
}

Input Input::hold(std::pmr::vector<char> bytes, const std::string& name,
                  const RunContext* context) {
  Input input = view({}, name);
  input.storage_ = std::make_shared<Storage>(std::move(bytes));
  input.text_ = std::string_view(input.storage_->held.data(), input.storage_->held.size());
  input.context_ = context;
  return input;
}

Input Input::hold(ScratchFile bytes, const std::string& name, const RunContext* context) {
  Input input = view({}, name);
  input.storage_ = std::make_shared<Storage>(std::move(bytes));
  input.text_ = std::string_view(input.storage_->scratch->data(), input.storage_->scratch->size());
  input.context_ = context;
  return input;
}

namespace {

// True if data of this size would take more than a third of the memory left in the budget.
bool is_too_large(std::size_t bytes, Input::Excess excess, const RunContext* context) {
  if (excess == Input::Excess::refused || context == nullptr) return false;
  return excess == Input::Excess::is_expected || bytes > context->memory.left() / 3;
}

}  // namespace

Input Input::open_stored(const std::filesystem::path& whole_path, const RunContext* context,
                         Excess excess, const StartCheck& check) {
  Input input;
  std::filesystem::path path;
  std::tie(path, input.member_) = split_member(whole_path);
  const bool standard_input = path == "-";
  input.name_ = standard_input ? "<stdin>" : printable(path.string());
  if (!standard_input) {
    input.extension_ = lower_extension(path);
    input.path_ = path;
  }
  input.context_ = context;

  if (standard_input) files::pass_bytes(files::kStandardInput);
  const Descriptor file(standard_input ? files::kStandardInput : files::open_to_read(path),
                        !standard_input);
  const auto status = file.get() < 0 ? std::nullopt : files::status_of(file.get());
  if (!status && errno != EISDIR)
    throw Error(ErrorKind::no_input,
                mark_place(input.name_) + ": cannot open: " + files::reason(errno));
  if (!status || status->kind == files::Kind::folder)
    throw Error(ErrorKind::no_input, mark_place(input.name_) + ": cannot read: it is a directory");

  auto storage = std::make_shared<Storage>(
      context != nullptr ? static_cast<std::pmr::memory_resource*>(&context->memory)
                         : std::pmr::new_delete_resource());
  const bool sized = status->kind == files::Kind::regular && status->size > 0 &&
                     (!standard_input || files::is_at_start(file.get()));
  const auto file_size = sized ? static_cast<std::size_t>(status->size) : 0;
  const bool exceeds = file_size > kFirstChunk && is_too_large(file_size, excess, context);
  if (file_size > kMapFrom || exceeds) {
    storage->exceeds = exceeds;
    // The pages of a mapped file occupy memory while they are read.
    if (context != nullptr && !exceeds) storage->claim.emplace(context->memory, file_size);
    if (char* const mapped = files::map_to_read(file.get(), file_size)) {
      storage->data = mapped;
      storage->capacity = storage->used = file_size;
      storage->mapped = true;
    } else {
      storage->claim.reset();
      storage->exceeds = false;
    }
  }
  const std::size_t limit =
      sized ? file_size
      : context != nullptr && context->memory.limit() != MemoryBudget::kUnlimited
          ? context->memory.limit()
          : half_of_memory();
  bool probed = sized, checked = sized || !check;
  while (!storage->mapped) {
    input.poll();
    if (storage->used == storage->capacity) {
      if (sized && storage->used == file_size) break;
      const std::size_t more = sized ? file_size : std::max(kFirstChunk, 2 * storage->capacity);
      // Both buffers exist while the data are copied.
      if (more > limit - std::min(limit, storage->capacity)) {
        throw Error(
            ErrorKind::resource,
            fmt::format("{}: larger than the memory limit allows: {} were read",
                        mark_place(input.name_), format_size(static_cast<double>(storage->used))));
      }
      storage->grow_to(more);
    }
    const std::ptrdiff_t got =
        files::read_some(file.get(), storage->data + storage->used,
                         std::min(storage->capacity - storage->used, std::size_t{1} << 24));
    if (got < 0 && errno == EAGAIN) continue;
    if (got < 0)
      throw Error(ErrorKind::io,
                  mark_place(input.name_) + ": cannot read: " + files::reason(errno));
    if (got == 0) {
      if (!sized) break;
      throw Error(ErrorKind::io,
                  fmt::format("{}: the file shrank while it was read: {} of {} bytes",
                              mark_place(input.name_), storage->used, file_size));
    }
    storage->used += static_cast<std::size_t>(got);
    if (!checked && storage->used >= kStart) {
      checked = true;
      Input start = view({storage->data, storage->used}, {}, context);
      start.name_ = input.name_;
      start.extension_ = input.extension_;
      start.member_ = input.member_;
      // NUL bytes alone get a message of their own below.
      const bool has_data = start.text().find_first_not_of('\0') != std::string_view::npos;
      if (has_data && !detail::is_gzip(start.text())) check(start);
    }
    if (!probed && storage->used >= kNulProbe) {
      probed = true;
      if (std::all_of(storage->data, storage->data + kNulProbe, [](char c) { return c == 0; })) {
        input.fail_at_byte(
            0, {"not data", "only NUL bytes in the first MiB of a stream", "bytes other than NUL",
                "if the NUL bytes are intended, save them to a file first"});
      }
    }
  }
  input.text_ = std::string_view(storage->data, storage->used);
  input.storage_ = std::move(storage);
  return input;
}

Input Input::open(const std::filesystem::path& path, const RunContext* context, Excess excess,
                  const StartCheck& check) {
  Input input = open_stored(path, context, excess, check);
  if (!detail::is_gzip(input.text())) return input;
  Input unpacked = input.unpacked(0, detail::stated_size(input.text()), excess);
  if (input.extension_ == ".gz") unpacked.extension_ = lower_extension(input.path_.stem());
  return unpacked;
}

Input Input::of_folder(const std::filesystem::path& path, const RunContext* context) {
  Input input = view({}, path.string(), context);
  const auto status = files::status_of(path);
  if (!status && path != "-")
    throw Error(ErrorKind::no_input,
                mark_place(input.name_) + ": cannot open: " + files::reason(errno));
  if (!status || status->kind != files::Kind::folder)
    throw Error(ErrorKind::usage,
                fmt::format("{}: found {}, expected a folder of pictures; a single file is read "
                            "without this setting, also if it has several pages",
                            mark(Setting::stack), input.name_));
  input.path_ = path;
  return input;
}

Input Input::unpacked(std::size_t offset, std::size_t size, Excess excess) const {
  const std::size_t most =
      context_ != nullptr && context_->memory.limit() != MemoryBudget::kUnlimited
          ? context_->memory.limit()
          : half_of_memory();
  const detail::Packed packed{*this, offset, size};
  Input result = is_too_large(size, excess, context_)
                     ? hold(detail::unpack_to_file(packed), {}, context_)
                     : hold(detail::unpack(packed, most), {}, context_);
  result.name_ = name_;
  result.member_ = member_;
  result.extension_ = extension_;
  result.path_ = path_;
  return result;
}

bool Input::stays_in_file() const { return storage_ != nullptr && storage_->exceeds; }

void Input::take_memory() const {
  if (!stays_in_file()) return;
  if (context_ != nullptr) storage_->claim.emplace(context_->memory, size());
  storage_->exceeds = false;
}

void Input::done_with(std::size_t offset, std::size_t size) const {
  if (stays_in_file()) forget_file_pages(text_.data() + offset, size);
}

std::shared_ptr<const void> Input::keep_in_file() const {
  if (storage_ == nullptr || !(storage_->mapped || storage_->scratch)) return nullptr;
  storage_->claim.reset();
  storage_->exceeds = true;
  return storage_;
}

void Input::require_memory(std::size_t bytes) const {
  if (context_ != nullptr) context_->memory.require(bytes);
}

void Input::poll(std::size_t done) const {
  if (storage_ != nullptr && storage_->mapped) storage_->let_go_to(std::min(done, size()));
  if (context_ == nullptr) return;
  context_->poll();
  context_->report({"read", done, size()});
}

void Input::fail(const Fault& fault) const {
  throw Error(ErrorKind::bad_data, message_of(name_, fault));
}

void Input::fail_at(std::size_t line, std::size_t column, const Fault& fault) const {
  throw Error(ErrorKind::bad_data, message_of(fmt::format("{}:{}:{}", name_, line, column), fault));
}

void Input::fail_at_byte(std::size_t offset, const Fault& fault) const {
  throw Error(ErrorKind::bad_data, message_of(fmt::format("{}: byte {}", name_, offset), fault));
}

}  // namespace ph
