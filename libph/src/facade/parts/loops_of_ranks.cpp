// SPDX-License-Identifier: MIT
#include "ph/detail/facade/join_ranks.hpp"

#include <utility>
#include <vector>

#include "ph/detail/facade/bar_bytes.hpp"

namespace ph {
namespace {

using Bytes = std::vector<std::byte>;

/// The bytes that one rank sends to another in a round. The first byte says whether the sender has
/// a message for any rank. The message for the receiving rank follows, and may be empty.
Bytes letter(bool is_busy, const Bytes& message) {
  Bytes bytes{std::byte{is_busy}};
  bytes.insert(bytes.end(), message.begin(), message.end());
  return bytes;
}

/// Lets all ranks exchange the messages of one round. @return true if any rank had a message.
bool exchange(ImageLoops& loops, int parts, Post& post) {
  const int rank = post.rank();
  std::vector<Bytes> messages(static_cast<std::size_t>(parts));
  bool is_busy = false;
  for (ImageLoops::Message& message : loops.take_messages()) {
    is_busy = true;
    messages[static_cast<std::size_t>(message.to)] = std::move(message.bytes);
  }
  bool is_any_busy = is_busy;
  const auto send = [&](int other) {
    post.send(other, letter(is_busy, messages[static_cast<std::size_t>(other)]));
  };
  const auto receive = [&](int other) {
    const Bytes bytes = post.receive(other);
    if (bytes.empty()) throw Error(ErrorKind::io, "a message of loops: found no bytes");
    is_any_busy = is_any_busy || bytes[0] != std::byte{0};
    if (bytes.size() > 1) loops.receive(std::span(bytes).subspan(1));
  };
  // A rank that sends may have to wait until the other rank receives. The lower of two ranks
  // therefore sends first, and each rank exchanges messages with the other ranks in ascending
  // order.
  for (int other = 0; other < parts; ++other) {
    if (other == rank) continue;
    if (rank < other) send(other);
    receive(other);
    if (rank > other) send(other);
  }
  return is_any_busy;
}

}  // namespace

Barcode loops_of_ranks(std::optional<ImageLoops> own, int parts, const ImagePart* whole, Post& post,
                       const RunContext& context) {
  Barcode all(CellKind::grid);
  if (!own) return all;
  if (whole != nullptr) {
    for (int other = 1; other < parts; ++other) post.send(other, whole->told_to_loops(other));
    own->begin(whole->told_to_loops(0));
  } else {
    own->begin(post.receive(0));
  }
  do {
    context.poll();
    own->work();
  } while (exchange(*own, parts, post));
  if (whole == nullptr) {
    ByteWriter to;
    put_bars(to, own->barcode());
    post.send(0, to.take());
    return all;
  }
  add_bars(all, own->barcode());
  for (int other = 1; other < parts; ++other) {
    const Bytes bytes = post.receive(other);
    ByteReader from(bytes, "loops of a rank");
    get_bars(from, all);
    from.expect_end();
  }
  return all;
}

}  // namespace ph
