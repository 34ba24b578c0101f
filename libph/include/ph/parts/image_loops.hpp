// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "ph/barcode.hpp"
#include "ph/parts/image_part.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// The loops of one part of a volume: bars that need all layers together, above all in dimension 1.
/// Parts work in parallel, in any processes on any machines, and send each other messages until no
/// message is in transit. The order of work and of messages does not matter: the bars are always
/// the bars of the entire volume. See docs/explanation/engines/slabs.md.
///
///     ImageLoops loops(part);                      // then `part` is joined with the others
///     loops.begin(whole.told_to_loops(number));    // a few bytes from the process with the whole
///     do {
///       loops.work();
///       for (auto& message : loops.take_messages()) send(message.to, message.bytes);
///       for (auto& bytes : received()) loops.receive(bytes);
///     } while (any part has sent something);
///     Barcode bars = loops.barcode();              // the bars of all parts together are complete
class ImageLoops {
 public:
  /// @param part must have just been computed, as a single part with has_loops(). The part lends
  ///        its voxels and its data on loops to this object, and keeps its bars and the data at its
  ///        two ends.
  /// @param field the characteristic of the coefficients; the same in all parts.
  /// @param context must outlive this object.
  /// @throws Error (usage) on any other part, or on an invalid field.
  explicit ImageLoops(ImagePart& part, std::int64_t field = 2,
                      const RunContext& context = default_context());
  ImageLoops(ImageLoops&&) noexcept;
  ImageLoops& operator=(ImageLoops&&) noexcept;
  ~ImageLoops();

  int part() const;
  /// @param told the result of `ImagePart::told_to_loops` for this part. @throws Error (bad_data).
  void begin(std::span<const std::byte> told);
  /// Takes in a message for this part, which may arrive even before `begin`. Each message must be
  /// received exactly once; the order does not matter.
  /// @throws Error (bad_data) if a message is damaged or was received before; later results are
  ///         then useless.
  void receive(std::span<const std::byte> message);
  /// True if there is nothing to do until a message is received.
  bool is_idle() const;
  /// Reduces up to `most` columns, and stops earlier if all columns are done or wait for other
  /// parts. @throws Error (cancelled).
  void work(std::size_t most = SIZE_MAX);

  struct Message {
    int to;
    std::vector<std::byte> bytes;
  };
  /// The messages to send, at most one per part.
  std::vector<Message> take_messages();

  /// The part's own bars of positive length. Precondition: all parts are idle, and every message
  /// sent has been received.
  Barcode barcode() const;

  /// Amounts sent and received so far. Once no message is in transit, the amounts sent and received
  /// by all parts together are equal.
  struct Traffic {
    std::uint64_t columns_sent = 0, columns_received = 0, bytes_sent = 0;
    std::uint64_t messages_sent = 0, messages_received = 0;
  };
  Traffic traffic() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ph
