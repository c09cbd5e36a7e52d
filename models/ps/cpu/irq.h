#pragma once

#include <cstdint>

#include <hal/hal.h>

namespace ps {

/// A core's side of interrupts: whether it may take one, its handler, and whether the handler ends
/// what it is called for.
class Irq {
 public:
  void connect(hal_interrupt_handler handler, void* context) {
    handler_ = handler;
    context_ = context;
  }
  /// Null: none is connected.
  hal_interrupt_handler handler() const { return handler_; }
  void call_handler() const { handler_(context_); }

  bool masked() const { return masked_; }
  void mask(bool mask) { masked_ = mask; }
  bool in_handler() const { return in_handler_; }
  bool interruptible() const { return !masked_ && !in_handler_; }
  /// The program waits with IRQ masked, rather than in a handler.
  bool masked_by_program() const { return masked_ && !in_handler_; }

  /// As the core does when it takes an interrupt, and when it returns from it.
  void enter() { masked_ = in_handler_ = true; }
  void leave() { masked_ = in_handler_ = false; }

  /// Handlers in a row after which an interrupt is taken to be unacknowledged (decision).
  static constexpr unsigned many_handlers = 1'000;
  /// The handler returned at `now_ps`, with an interrupt `pending` or without. True once it has
  /// left many_handlers of them in a row.
  bool leaves_too_many(bool pending, std::uint64_t now_ps) {
    if (!pending) {
      pending_returns_ = 0;
      return false;
    }
    if (++pending_returns_ == 1) pending_since_ps_ = now_ps;
    return pending_returns_ == many_handlers;
  }
  /// When the first of them returned.
  std::uint64_t pending_since_ps() const { return pending_since_ps_; }

 private:
  hal_interrupt_handler handler_ = nullptr;
  void* context_ = nullptr;
  bool masked_ = true;
  bool in_handler_ = false;
  unsigned pending_returns_ = 0;
  std::uint64_t pending_since_ps_ = 0;
};

}  // namespace ps
