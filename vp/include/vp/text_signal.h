#pragma once

#include <vp/signal.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace vp {

/// Says in words what others are doing, for traces: a state's name, an access. Costs nothing while
/// it is not traced.
class TextSignal final : public SignalBase {
 public:
  /// `text` is asked when a source changes or touch() is called. It must not change anything.
  TextSignal(const char* name, std::function<std::string()> text,
             std::vector<SignalBase*> sources = {})
      : SignalBase(name), text_(std::move(text)), sources_(std::move(sources)) {}
  const char* kind() const override { return "vp::TextSignal"; }

  /// There is a new text.
  void touch() {
    if (observed_) changed();
  }
  std::string text() const { return text_(); }
  const std::vector<SignalBase*>& sources() const { return sources_; }

  unsigned width() const override { return 1; }
  std::uint64_t bits() const override { return 0; }

 private:
  void commit() override {}

  std::function<std::string()> text_;
  std::vector<SignalBase*> sources_;
};

}  // namespace vp
