#include <trace/wavedrom.h>

#include <trace/tools.h>
#include <vp/error.h>
#include <vp/frame_gate.h>
#include <vp/unit.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>

namespace platform::trace {

namespace {

using Kind = vp::WaveVariable::Kind;

constexpr std::size_t most_columns = 100;
/// Equal columns that are drawn before a gap takes their place.
constexpr std::size_t most_equal = 3;

struct Lane {
  std::string name;
  Replay::Slot slot;
  bool is_bit;
  std::string wave;
  std::vector<std::string> data;
  std::string last;
};

class Diagram final : public Replay::Listener {
 public:
  Diagram(TraceFile& file, const WaveDromOptions& options)
      : file_(file),
        options_(options),
        replay_(file),
        clock_(replay_, replay_.watch(options.every.signal), options.every.falling) {
    replay_.keep_texts();
    for (const std::string& name : options.signals) {
      const auto place = vp::find_path(name, file.paths(), "plot: ");
      const vp::WaveVariable& variable = file.variable(place);
      const bool is_bit = variable.kind == Kind::bits && variable.width == 1;
      lanes_.push_back({file.paths()[place], replay_.watch(place), is_bit, {}, {}, {}});
    }
  }

  std::string json() {
    replay_.run(*this);
    if (columns_ == 0)
      throw vp::InputError("plot: '" + options_.every.signal + "' has no edge in the window");
    nlohmann::ordered_json signals = nlohmann::ordered_json::array();
    signals.push_back({{"name", options_.every.signal}, {"wave", clock_wave_}});
    for (const Lane& lane : lanes_) {
      nlohmann::ordered_json one = {{"name", lane.name}, {"wave", lane.wave}};
      if (!lane.data.empty()) one["data"] = lane.data;
      signals.push_back(std::move(one));
    }
    const nlohmann::ordered_json all = {
        {"signal", std::move(signals)},
        {"foot",
         {{"text", file_.name() + " from " + vp::format_time(first_ps_) +
                       ", a column for each edge"
                       " of " +
                       options_.every.signal}}}};
    return all.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  }

 private:
  bool instant(std::uint64_t ps) override {
    if (ps >= options_.to_ps) return false;
    const std::uint64_t edges = clock_.edges();
    clock_.instant(ps);
    if (clock_.edges() == edges || ps < options_.from_ps) return true;
    if (columns_ == 0) first_ps_ = ps;
    column();
    return true;
  }
  std::string value(const Lane& lane) const {
    const std::string& text = replay_.text_before(lane.slot);
    if (lane.is_bit) return text.empty() ? "x" : text == "h" ? "1" : text == "l" ? "0" : text;
    return readable(text.empty() ? "x" : text, replay_.kind_before(lane.slot),
                    replay_.width(lane.slot));
  }
  void column() {
    std::vector<std::string> values;
    bool equal = columns_ != 0;
    for (const Lane& lane : lanes_) {
      values.push_back(value(lane));
      equal = equal && values.back() == lane.last;
    }
    equal_ = equal ? equal_ + 1 : 0;
    ++columns_;
    if (equal_ > most_equal) {
      if (equal_ == most_equal + 1) add_gap();
      return;
    }
    clock_wave_ += columns_ == 1 ? (options_.every.falling ? 'n' : 'p') : '.';
    for (std::size_t i = 0; i < lanes_.size(); ++i) add(lanes_[i], values[i]);
    if (clock_wave_.size() > most_columns) {
      throw vp::InputError("plot: the window has more than " + std::to_string(most_columns) +
                           " columns: choose a shorter --window, or fewer signals");
    }
  }
  void add_gap() {
    clock_wave_ += '|';
    for (Lane& lane : lanes_) lane.wave += '|';
  }
  static void add(Lane& lane, const std::string& value) {
    if (value == lane.last && !lane.wave.empty()) {
      lane.wave += '.';
      return;
    }
    lane.last = value;
    if (lane.is_bit) {
      // WaveDrom has no sign for the weak and unset states of VHDL.
      lane.wave += value == "0" || value == "1" || value == "z" ? value : "x";
    } else if (value == "x" || value == "z") {
      lane.wave += value;
    } else {
      lane.wave += '=';
      lane.data.push_back(value);
    }
  }

  const TraceFile& file_;
  const WaveDromOptions& options_;
  Replay replay_;
  SampleClock clock_;
  std::vector<Lane> lanes_;
  std::string clock_wave_;
  std::uint64_t first_ps_ = 0;
  std::size_t columns_ = 0, equal_ = 0;
};

}  // namespace

std::string wavedrom_json(TraceFile& file, const WaveDromOptions& options) {
  return Diagram(file, options).json();
}

}  // namespace platform::trace
