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
    writer_->close(steps(std::max(now(), start())));
  }

 private:
  struct Net {
    std::vector<Writer::Id> ids;  ///< it may have several names
    Kind kind = Kind::bits;
    bool is_event = false;
    std::optional<std::string> last;  ///< before the window
  };

  void add(std::uint32_t i) {
    const vp::WaveVariable& variable = file_.variable(i);
    if (variable.width == 0) return;
    file_.reader().select(variable.net);
    const auto kind = variable.is_event             ? Writer::Kind::event
                      : variable.kind == Kind::real ? Writer::Kind::real
                      : variable.kind == Kind::text ? Writer::Kind::text
                                                    : Writer::Kind::wire;
    Net& net = nets_[variable.net];
    net.kind = variable.kind;
    net.is_event = variable.is_event;
    try {
      net.ids.push_back(writer_->add(file_.paths()[i], kind, variable.width));
    } catch (const std::invalid_argument& error) {
      throw vp::InputError("trace '" + file_.name() + "': " + error.what());
    }
    net_of_id_.push_back(variable.net);
  }

  void begin(Moment start) override {
    Writer::WrittenValues values;
    for (const std::uint32_t net : net_of_id_) values.push_back(nets_[net].last);
    writer_->begin_written(steps(start), values);
  }
  void reach(Moment now) override { writer_->set_time(steps(now)); }
  void change(std::uint32_t number, const vp::WaveValue& value) override {
    Net& net = nets_[number];
    if (value.kind != net.kind) refuse(value);
    if (!begun()) {
      if (!net.is_event || is_inside()) net.last = value.text;
      return;
    }
    for (const Writer::Id id : net.ids) {
      if (value.kind == Kind::text) {
        writer_->change_text(id, value.text);
      } else {
        writer_->change_digits(id, value.text);
      }
    }
  }
  /// Words in a vector of bits fit in no file of ours.
  [[noreturn]] void refuse(const vp::WaveValue& value) const {
    throw vp::InputError("trace '" + file_.name() + "' at " + vp::format_time(now().first) +
                         ": a signal has the value '" + std::string(value.text) +
                         "', which is not of its type: leave it out with cut --filter");
  }

  std::unique_ptr<Writer> writer_;
  std::vector<Net> nets_;
  std::vector<std::uint32_t> net_of_id_;
};

}  // namespace

void cut(TraceFile& file, const std::string& to, const CutOptions& options) {
  Cutter(file, to, options).run();
}

}  // namespace platform::trace
