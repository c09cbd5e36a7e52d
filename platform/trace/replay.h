#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <trace/trace_file.h>
#include <vp/wave_expression.h>

namespace platform::trace {

/// Plays a trace back instant by instant: the values that stand, and those before the instant. A
/// clock edge samples the latter.
class Replay final : public vp::WaveValues, private vp::WaveHandler {
 public:
  using Slot = std::uint32_t;

  /// Told when all changes of an instant are there.
  class Listener {
   public:
    virtual ~Listener() = default;
    /// False: enough.
    virtual bool instant(std::uint64_t ps) = 0;
  };

  explicit Replay(TraceFile& file);

  /// Follows the variable; the same net gives the same slot.
  Slot watch(std::uint32_t variable);
  /// Follows the signal a user wrote: see vp::find_path().
  Slot watch(const std::string& name, const std::string& where);

  void run(Listener& listener);

  std::uint64_t first_ps() const { return first_ps_; }
  std::uint64_t last_ps() const { return file_.reader().now_ps(); }
  /// Slots that were written in this instant.
  const std::vector<Slot>& changed() const { return changed_; }

  std::optional<vp::WaveNumber> now(Slot slot) const override { return number(slots_[slot].now); }
  std::optional<vp::WaveNumber> before(Slot slot) const override {
    return number(slots_[slot].before);
  }
  bool known(Slot slot) const { return slots_[slot].now.known; }
  std::uint64_t bits(Slot slot) const { return slots_[slot].now.bits; }
  bool was_known(Slot slot) const { return slots_[slot].before.known; }
  std::uint64_t bits_before(Slot slot) const { return slots_[slot].before.bits; }
  /// As it is written in the trace; of a text what it says.
  const std::string& text(Slot slot) const { return slots_[slot].now.text; }
  vp::WaveVariable::Kind kind(Slot slot) const { return slots_[slot].now.kind; }
  std::uint32_t variable(Slot slot) const { return slots_[slot].variable; }
  /// Keeps the texts of all values, for those who show them; otherwise those of texts only.
  void keep_texts() { keep_texts_ = true; }

 private:
  struct Value {
    vp::WaveVariable::Kind kind = vp::WaveVariable::Kind::bits;
    bool known = false;
    std::uint64_t bits = 0;
    double real = 0;
    std::string text;
  };
  struct State {
    std::uint32_t variable;
    bool touched;
    Value now, before;
  };
  static std::optional<vp::WaveNumber> number(const Value& value);
  bool at(std::uint64_t ps) override;
  void change(std::uint32_t net, const vp::WaveValue& value) override;
  bool finish_instant();

  TraceFile& file_;
  Listener* listener_ = nullptr;
  bool keep_texts_ = false;
  bool started_ = false;
  bool stopped_ = false;
  std::uint64_t first_ps_ = 0;
  std::uint64_t now_ps_ = 0;
  std::vector<int> slot_of_net_;
  std::vector<State> slots_;
  std::vector<Slot> changed_;
};

}  // namespace platform::trace
