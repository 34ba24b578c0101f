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

/// The loops of one part of a volume: bars that come from all layers together, dimension 1 first of
/// all. Parts work side by side, in any processes on any machines, and send each other messages
/// until nothing is on its way. Who works when, and in which order messages arrive, is all the
/// same: the bars are those of the whole volume. See docs/explanation/engines/slabs.md.
///
///     ImageLoops loops(part);                      // then `part` is joined with the others
///     loops.begin(whole.told_to_loops(number));    // a few bytes from where the whole is
///     do {
///       loops.work();
///       for (auto& message : loops.take_messages()) send(message.to, message.bytes);
///       for (auto& bytes : received()) loops.receive(bytes);
///     } while (any part has sent something);
///     Barcode bars = loops.barcode();              // with those of the others all there are
class ImageLoops {
 public:
  /// @param part right after it was computed, as one part that has_loops(). It lends its voxels and
  ///        what it knows of loops; bars and seams stay.
  /// @param field the characteristic of the coefficients; the same in all parts.
  /// @param context outlives this.
  /// @throws Error (usage) if the part is not that, or on a field that is none.
  explicit ImageLoops(ImagePart& part, std::int64_t field = 2,
                      const RunContext& context = default_context());
  ImageLoops(ImageLoops&&) noexcept;
  ImageLoops& operator=(ImageLoops&&) noexcept;
  ~ImageLoops();

  int part() const;
  /// @param told what `ImagePart::told_to_loops` says of this part. @throws Error (bad_data).
  void begin(std::span<const std::byte> told);
  /// Takes in a message for this part; also before it begins. Each must come once, in any order.
  /// @throws Error (bad_data) if it is damaged, or has come before; what is found from then on is
  ///         of no use.
  void receive(std::span<const std::byte> message);
  /// Whether there is nothing to do until something is received.
  bool is_idle() const;
  /// Works on so many columns until all are done or wait for others. @throws Error (cancelled).
  void work(std::size_t most = SIZE_MAX);

  struct Message {
    int to;
    std::vector<std::byte> bytes;
  };
  /// What is to be sent, one for each part at most.
  std::vector<Message> take_messages();

  /// Its own bars of positive length. Precondition: all parts are idle, and all that was sent has
  /// been received.
  Barcode barcode() const;

  /// What has been sent and received so far. Of all parts together as much is received as is sent
  /// once nothing is on its way.
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
