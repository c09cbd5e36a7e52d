#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <utility>

namespace xilinx {

/// Memory that software ordered a core to write and that is not complete, the oldest order first.
/// It lets a watch see whether the program reads it meanwhile.
class WriteOrders {
 public:
  struct Order {
    std::uint64_t address = 0;
    std::uint64_t bytes = 0;
    std::uint64_t written = 0;
  };
  /// What is written goes round and round, so that memory which was written once has data.
  bool is_cyclic = false;

  /// Called when an order begins to be open (true) and when it no longer is. May be null.
  using Listener = std::function<void(const Order& order, bool begins)>;
  void on_change(Listener listener) { listener_ = std::move(listener); }

  void add(std::uint64_t address, std::uint64_t bytes) {
    if (bytes == 0) return;
    open_.push_back({address, bytes, 0});
    tell(open_.back(), true);
  }
  /// A burst reached memory.
  void wrote(std::uint64_t address, std::uint64_t bytes) {
    for (Order& order : open_) {
      if (address < order.address || address - order.address >= order.bytes) continue;
      order.written = std::min(order.bytes, order.written + bytes);
      return;
    }
  }
  /// The oldest one is done.
  void end() {
    if (open_.empty()) return;
    ++ended_;
    const Order order = open_.front();
    open_.pop_front();
    tell(order, false);
  }
  /// All but the oldest `kept` are dropped.
  void drop(std::size_t kept = 0) {
    while (open_.size() > kept) {
      const Order order = open_.back();
      open_.pop_back();
      tell(order, false);
    }
  }

  const std::deque<Order>& open() const { return open_; }
  /// Orders that were done since the start.
  std::uint64_t ended() const { return ended_; }

 private:
  void tell(const Order& order, bool begins) const {
    if (listener_) listener_(order, begins);
  }

  std::deque<Order> open_;
  std::uint64_t ended_ = 0;
  Listener listener_;
};

}  // namespace xilinx
