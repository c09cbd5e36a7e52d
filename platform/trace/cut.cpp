#include <trace/tools.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <optional>
#include <stdexcept>

#include <vp/error.h>
#include <vp/unit.h>
#include <vp/wave_writer.h>

namespace platform::trace {

namespace {

using Kind = vp::WaveVariable::Kind;
using Writer = vp::WaveWriter;

class Cutter final : public vp::WaveHandler {
 public:
  Cutter(TraceFile& file, const std::string& to, const CutOptions& options)
      : file_(file), options_(options), ids_(file.reader().nets()), last_(file.reader().nets()) {
    options.filter.check(file.paths(), {});
    writer_ = vp::open_wave_writer(to);
    for (std::uint32_t i = 0; i < file.paths().size(); ++i) {
      if (options.filter.selects(file.paths()[i])) add(i);
    }
  }

  bool at(std::uint64_t ps) override {
    if (!first_ps_) first_ps_ = ps;
    if (ps >= options_.to_ps) {
      end_ps_ = options_.to_ps;
      return false;
    }
    if (begun_ || ps > start_ps()) begin();
    if (begun_) writer_->set_time(ps);
    now_ps_ = end_ps_ = ps;
    return true;
  }
  void change(std::uint32_t net, const vp::WaveValue& value) override {
    if (begun_) {
      write(net, value.kind, value.text);
    } else {
      last_[net] = {value.kind, value.known, value.bits, value.real, std::string(value.text)};
    }
  }
  void finish() {
    if (!begun_ && now_ps_ < options_.from_ps) {
      throw vp::InputError("trace '" + file_.name() + "' ends at " + vp::format_time(now_ps_) +
                           ", before the window begins");
    }
    if (!begun_ && (!first_ps_ || *first_ps_ >= options_.to_ps)) {
      throw vp::InputError("trace '" + file_.name() + "' has nothing before " +
                           vp::format_time(options_.to_ps) + ", the end of the window");
    }
    begin();
    writer_->close(std::max(end_ps_, start_ps()));
  }

 private:
  struct Last {
    Kind kind = Kind::bits;
    bool known = false;
    std::uint64_t bits = 0;
    double real = 0;
    std::optional<std::string> text;
  };

  void add(std::uint32_t i) {
    const vp::WaveVariable& variable = file_.variable(i);
    file_.reader().select(variable.net);
    last_[variable.net].kind = variable.kind;
    const auto kind = variable.kind == Kind::real   ? Writer::Kind::real
                      : variable.kind == Kind::text ? Writer::Kind::text
                                                    : Writer::Kind::wire;
    try {
      ids_[variable.net].push_back(writer_->add(file_.paths()[i], kind, variable.width));
    } catch (const std::invalid_argument& error) {
      throw vp::InputError("trace '" + file_.name() + "': " + error.what());
    }
    net_of_id_.push_back(variable.net);
  }

  /// A trace of a window has nothing before its first instant.
  std::uint64_t start_ps() const { return std::max(options_.from_ps, first_ps_.value_or(0)); }
  /// With the values that stand at the window's start.
  void begin() {
    if (begun_) return;
    begun_ = true;
    std::vector<std::uint64_t> values;
    for (const std::uint32_t net : net_of_id_) {
      values.push_back(last_[net].bits);
      if (last_[net].kind == Kind::real) {
        std::memcpy(&values.back(), &last_[net].real, sizeof(double));
      }
    }
    writer_->begin(start_ps(), values);
    for (std::uint32_t net = 0; net < ids_.size(); ++net) {
      const Last& last = last_[net];
      const bool wide = last.text && last.text->size() > 64;
      if (last.kind == Kind::text) {
        if (last.text) write(net, Kind::text, *last.text);
      } else if (!last.known || wide) {
        write(net, last.kind, last.text ? *last.text : last.kind == Kind::real ? "nan" : "x");
      }
    }
  }
  void write(std::uint32_t net, Kind kind, std::string_view text) {
    for (const Writer::Id id : ids_[net]) {
      if (kind == Kind::text) {
        writer_->change_text(id, text);
      } else {
        writer_->change_digits(id, text);
      }
    }
  }

  TraceFile& file_;
  CutOptions options_;
  std::unique_ptr<Writer> writer_;
  std::vector<std::vector<Writer::Id>> ids_;  ///< by net: a net may have several names
  std::vector<std::uint32_t> net_of_id_;
  std::vector<Last> last_;
  bool begun_ = false;
  std::optional<std::uint64_t> first_ps_;
  std::uint64_t now_ps_ = 0, end_ps_ = 0;
};

}  // namespace

void cut(TraceFile& file, const std::string& to, const CutOptions& options) {
  Cutter cutter(file, to, options);
  file.reader().read(cutter);
  cutter.finish();
}

}  // namespace platform::trace
