#include <trace/tools.h>
#include <trace/window.h>
#include <vp/error.h>
#include <vp/frame_gate.h>
#include <vp/unit.h>
#include <vp/wave_writer.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace platform::trace {

namespace {

using Kind = vp::WaveVariable::Kind;
using Writer = vp::WaveWriter;

class Cutter final : private WindowReader {
 public:
  Cutter(TraceFile& file, const std::string& to, const CutOptions& options)
      : WindowReader(file, options), nets_(file.reader().nets()) {
    options.filter.check(file.paths());
    for (const std::uint32_t net : options.as_texts) nets_[net].as_text = true;
    writer_ = vp::open_wave_writer(to);
    if (counts_femtoseconds()) writer_->count_femtoseconds();
    for (std::uint32_t i = 0; i < file.paths().size(); ++i) {
      if (options.filter.selects(file.paths()[i])) add(i);
    }
    if (net_of_id_.empty())
      throw vp::InputError("trace '" + file.name() + "': the signals have no bits");
  }

  void run() {
    read();
    if (!mixed_.empty()) throw MixedTypes(problem_, std::move(mixed_));
    writer_->close(steps(std::max(now(), start())));
  }

 private:
  struct Net {
    std::vector<Writer::Id> ids;  ///< it may have several names
    Kind kind = Kind::bits;
    bool is_event = false;
    bool as_text = false, is_mixed = false;
    std::optional<std::string> last;  ///< before the window
  };

  void add(std::uint32_t i) {
    const vp::WaveVariable& variable = file_.variable(i);
    if (variable.width == 0) return;
    file_.reader().select(variable.net);
    Net& net = nets_[variable.net];
    net.kind = net.as_text ? Kind::text : variable.kind;
    const auto kind = net.kind == Kind::text   ? Writer::Kind::text
                      : variable.is_event      ? Writer::Kind::event
                      : net.kind == Kind::real ? Writer::Kind::real
                                               : Writer::Kind::wire;
    net.is_event = variable.is_event;
    try {
      net.ids.push_back(writer_->add(file_.paths()[i], kind, variable.width));
    } catch (const std::invalid_argument& error) {
      throw vp::InputError("trace '" + file_.name() + "': " + error.what());
    }
    net_of_id_.push_back(variable.net);
  }

  void begin(Moment start) override {
    if (!mixed_.empty()) return;
    Writer::WrittenValues values;
    for (const std::uint32_t net : net_of_id_) values.push_back(nets_[net].last);
    writer_->begin_written(steps(start), values);
  }
  void reach(Moment now) override {
    if (mixed_.empty()) writer_->set_time(steps(now));
  }
  void change(std::uint32_t number, const vp::WaveValue& value) override {
    Net& net = nets_[number];
    if (value.kind != net.kind && !net.as_text) note(number, value);
    if (!mixed_.empty()) return;
    if (!begun()) {
      if (!net.is_event || is_inside()) net.last = value.text;
      return;
    }
    for (const Writer::Id id : net.ids) {
      if (net.kind == Kind::text) {
        writer_->change_text(id, value.text);
      } else {
        writer_->change_digits(id, value.text);
      }
    }
  }
  /// From here on nothing is written: the trace is read for other signals like this one.
  void note(std::uint32_t number, const vp::WaveValue& value) {
    if (mixed_.empty()) {
      problem_ = "trace '" + file_.name() + "' at " + vp::format_time(now().first) +
                 ": a signal has the value '" + std::string(value.text) +
                 "', which is not of its type: leave it out with cut --filter";
    }
    if (!std::exchange(nets_[number].is_mixed, true)) mixed_.push_back(number);
  }

  std::unique_ptr<Writer> writer_;
  std::vector<Net> nets_;
  std::vector<std::uint32_t> net_of_id_;
  std::vector<std::uint32_t> mixed_;  ///< nets with values that are not of their type
  std::string problem_;
};

}  // namespace

void cut(TraceFile& file, const std::string& to, const CutOptions& options) {
  Cutter(file, to, options).run();
}

}  // namespace platform::trace
