#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <trace/trace_file.h>

namespace platform::trace {

/// Reads a trace one instant at a time, for those who read two.
class Stepper final : private vp::WaveHandler {
 public:
  struct Change {
    std::uint32_t net;
    std::string text;  ///< of bits without leading zeros
  };

  explicit Stepper(TraceFile& file) : file_(file) {}

  /// False: the trace is over. Throws vp::InputError.
  bool next() {
    changes_.clear();
    if (over_) return false;
    now_ps_ = next_ps_;
    stopped_ = false;
    file_.reader().read(*this);
    over_ = !stopped_;
    return started_;
  }
  std::uint64_t now_ps() const { return now_ps_; }
  const std::vector<Change>& changes() const { return changes_; }

 private:
  bool at(std::uint64_t ps) override {
    next_ps_ = ps;
    if (!started_) {
      started_ = true;
      now_ps_ = ps;
      return true;
    }
    stopped_ = true;
    return false;
  }
  void change(std::uint32_t net, const vp::WaveValue& value) override {
    std::string_view text = value.text;
    if (value.kind == vp::WaveVariable::Kind::bits) {
      while (text.size() > 1 && text[0] == '0' && text[1] <= '1') text.remove_prefix(1);
      while (text.size() > 1 && text[0] == text[1] && text[0] != '0' && text[0] != '1') {
        text.remove_prefix(1);
      }
    }
    changes_.push_back({net, std::string(text)});
  }

  TraceFile& file_;
  bool started_ = false, stopped_ = false, over_ = false;
  std::uint64_t now_ps_ = 0, next_ps_ = 0;
  std::vector<Change> changes_;
};

/// A value for people: vectors in hexadecimal, the rest as it is.
std::string readable(const std::string& text, vp::WaveVariable::Kind kind, unsigned width);

}  // namespace platform::trace
