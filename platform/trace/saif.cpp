#include <trace/tools.h>
#include <trace/window.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/frame_gate.h>
#include <vp/net_activity.h>
#include <vp/text.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace platform::trace {

namespace {

using Scopes = std::vector<std::string>;

/// What is no letter, digit or underscore has a backslash, as simulators write "data\[3\]".
std::string identifier(const std::string& name) {
  std::string text;
  for (const char c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_') text += '\\';
    text += c;
  }
  return text;
}

class SaifWriter final : private WindowReader {
 public:
  SaifWriter(TraceFile& file, const CutOptions& options) : WindowReader(file, options) {
    options.filter.check(file.paths());
    for (std::uint32_t i = 0; i < file.paths().size(); ++i) {
      if (options.filter.selects(file.paths()[i])) add(i);
    }
    if (signals_.empty())
      throw vp::InputError("trace '" + file.name() + "': the signals have no bits");
    // Those of a scope come together, and before the scopes inside it.
    std::stable_sort(signals_.begin(), signals_.end(),
                     [](const Signal& a, const Signal& b) { return a.scopes < b.scopes; });
  }

  std::string text() {
    read();
    const std::uint64_t from = steps(start()), to = steps(std::max(now(), start()));
    if (to == from)
      throw vp::InputError("trace '" + file_.name() + "' has one instant there, and no duration");
    for (auto& [number, net] : nets_) net.settle(to);
    text_ =
        "(SAIFILE\n(SAIFVERSION \"2.0\")\n(DIRECTION \"backward\")\n(DESIGN )\n"
        "(PROGRAM_NAME \"markervp\")\n(DIVIDER / )\n(TIMESCALE 1 " +
        std::string(counts_femtoseconds() ? "fs" : "ps") + ")\n(DURATION " +
        std::to_string(to - from) + ")\n";
    add_instances();
    return text_ + ")\n";
  }

  std::uint64_t bits() const { return bits_; }

 private:
  struct Signal {
    Scopes scopes;
    std::string name;
    std::uint32_t net;
  };

  void add(std::uint32_t i) {
    const vp::WaveVariable& variable = file_.variable(i);
    if (variable.width == 0 || variable.is_event || variable.kind != vp::WaveVariable::Kind::bits)
      return;
    Scopes scopes = vp::split(file_.paths()[i], '.');
    std::string name = std::move(scopes.back());
    scopes.pop_back();
    if (scopes.empty()) {
      throw vp::InputError("trace '" + file_.name() + "': '" + vp::excerpt(name) +
                           "' is in no scope, without which SAIF has no signals: select others "
                           "with --filter");
    }
    file_.reader().select(variable.net);
    nets_.emplace(variable.net, variable.width);
    signals_.push_back({std::move(scopes), std::move(name), variable.net});
    bits_ += variable.width;
  }

  void begin(Moment start) override {
    for (auto& [number, net] : nets_) net.restart(steps(start));
  }
  void reach(Moment) override {}
  void change(std::uint32_t number, const vp::WaveValue& value) override {
    const bool is_bits = value.kind == vp::WaveVariable::Kind::bits;
    nets_.at(number).change(is_bits ? value.text : "x", steps(now()));
  }

  void add_instances() {
    Scopes open;
    for (auto signal = signals_.begin(); signal != signals_.end();) {
      const Scopes& scopes = signal->scopes;
      const auto parting = std::mismatch(open.begin(), open.end(), scopes.begin(), scopes.end());
      const auto common = static_cast<std::size_t>(parting.first - open.begin());
      close(open, common);
      for (std::size_t i = common; i < scopes.size(); ++i)
        text_ += "(INSTANCE " + identifier(scopes[i]) + "\n";
      open = scopes;
      text_ += "(NET\n";
      for (; signal != signals_.end() && signal->scopes == open; ++signal) add_net(*signal);
      text_ += ")\n";
    }
    close(open, 0);
  }

  void close(const Scopes& open, std::size_t depth) {
    for (std::size_t i = depth; i < open.size(); ++i) text_ += ")\n";
  }

  void add_net(const Signal& signal) {
    const auto& bits = nets_.at(signal.net).bits();
    for (std::size_t i = 0; i < bits.size(); ++i) {
      const vp::NetActivity::Bit& bit = bits[i];
      const std::string index =
          bits.size() == 1 ? "" : "[" + std::to_string(bits.size() - 1 - i) + "]";
      text_ += "(" + identifier(signal.name + index) + " (T0 " + std::to_string(bit.low) +
               ") (T1 " + std::to_string(bit.high) + ") (TX " + std::to_string(bit.unknown) +
               ") (TZ " + std::to_string(bit.floating) + ") (TC " + std::to_string(bit.toggles) +
               ") (IG 0))\n";
    }
  }

  std::vector<Signal> signals_;
  std::map<std::uint32_t, vp::NetActivity> nets_;
  std::uint64_t bits_ = 0;
  std::string text_;
};

}  // namespace

std::uint64_t write_saif(TraceFile& file, const std::string& to, const CutOptions& options) {
  SaifWriter writer(file, options);
  vp::write_file(to, writer.text());
  return writer.bits();
}

}  // namespace platform::trace
