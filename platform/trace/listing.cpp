#include <trace/listing.h>

#include <vp/text.h>
#include <vp/unit.h>

#include <cstring>
#include <sstream>

namespace platform::trace {

namespace {

using Kind = vp::WaveVariable::Kind;

std::string type_of(const vp::WaveVariable& variable) {
  if (variable.is_event) return "event";
  if (variable.kind == Kind::real) return "real";
  if (variable.kind == Kind::text) return "text";
  return std::to_string(variable.width) + (variable.width == 1 ? " bit" : " bits");
}

/// Counts the values of each net that are not the one before.
class ValueCounter final : public vp::WaveHandler {
 public:
  explicit ValueCounter(TraceFile& file) : file_(file), nets_(file.reader().nets()) {}

  bool at(std::uint64_t ps) override {
    if (first.empty()) first = exact_time(ps, file_.reader().below_ps());
    return true;
  }
  void change(std::uint32_t net, const vp::WaveValue& value) override {
    Net& state = nets_[net];
    Form form = Form::text;
    std::uint64_t bits = value.bits;
    std::string_view text = value.text;
    if (value.kind == Kind::bits && value.plain && state.is_narrow) {
      form = Form::bits;
    } else if (value.kind == Kind::bits) {
      text = shortest_digits(text);
      if (text.size() == 1) {
        form = Form::letter;
        bits = static_cast<unsigned char>(text.front());
      }
    } else if (value.kind == Kind::real && value.known) {
      form = Form::real;
      std::memcpy(&bits, &value.real, sizeof bits);
    }
    const bool same = state.count != 0 && state.form == form &&
                      (form == Form::text ? texts_[net] == text : state.bits == bits);
    if (same && !state.is_event) return;
    ++state.count;
    state.form = form;
    state.bits = bits;
    if (form != Form::text) return;
    if (texts_.empty()) texts_.resize(nets_.size());
    texts_[net] = text;
  }
  bool needs_texts() const override { return false; }
  void declare(const vp::WaveVariable& variable) {
    nets_[variable.net].is_event = variable.is_event;
    nets_[variable.net].is_narrow = variable.width <= 64;
  }
  std::vector<std::uint64_t> counts() const {
    std::vector<std::uint64_t> counts;
    counts.reserve(nets_.size());
    for (const Net& net : nets_) counts.push_back(net.count);
    return counts;
  }

  std::string first;  ///< time; empty before it

 private:
  /// What two values are compared by: bits, the bits of a real, a letter that fills all digits, or
  /// what the file says.
  enum Form : std::uint8_t { bits, real, letter, text };
  /// Small, as there may be millions.
  struct Net {
    std::uint64_t bits = 0;
    std::uint64_t count : 56;
    std::uint64_t form : 2, is_event : 1, is_narrow : 1;

    Net() : count(0), form(Form::text), is_event(0), is_narrow(0) {}
  };
  TraceFile& file_;
  std::vector<Net> nets_;
  std::vector<std::string> texts_;  ///< by net; empty before the first
};

}  // namespace

std::string exact_time(std::uint64_t ps, unsigned below_ps) {
  if (below_ps == 0) return vp::format_time(ps);
  const std::string femtoseconds = std::to_string(below_ps) + " fs";
  return ps == 0 ? femtoseconds : vp::format_time(ps) + " " + femtoseconds;
}

Listing::Listing(TraceFile& file, const vp::TraceFilter& filter)
    : file_(file), filter_(filter), first_of_net_(file.reader().nets()) {
  filter.check(file.paths());
  vp::WaveReader& reader = file.reader();
  ValueCounter counter(file);
  std::uint32_t place = 0;
  for (const std::string& path : file.paths()) {
    const vp::WaveVariable& variable = file.variable(place++);
    if (!filter.selects(path)) continue;
    ++signals_;
    if (first_of_net_[variable.net] != 0) continue;
    first_of_net_[variable.net] = place;
    reader.select(variable.net);
    counter.declare(variable);
  }
  reader.read(counter);
  values_of_net_ = counter.counts();
  for (const std::uint64_t count : values_of_net_) values_ += count;
  first_ = counter.first;
  if (!first_.empty()) last_ = exact_time(reader.now_ps(), reader.below_ps());
}

void Listing::each(const std::function<void(const Signal&)>& take) const {
  const vp::WaveReader& reader = file_.reader();
  std::uint32_t place = 0;
  for (const std::string& path : file_.paths()) {
    const vp::WaveVariable& variable = file_.variable(place++);
    if (!filter_.selects(path)) continue;
    Signal signal{path, type_of(variable), "", 0, {}};
    const std::uint32_t first = first_of_net_[variable.net];
    if (first != place) {
      signal.alias_of = file_.paths()[first - 1];
    } else {
      signal.values = values_of_net_[variable.net];
    }
    if (variable.enumeration != 0) {
      for (const auto& [digits, word] : reader.enumerations()[variable.enumeration - 1].words)
        signal.words.push_back(word);
    }
    take(signal);
  }
}

void Listing::write(std::ostream& out) const {
  constexpr std::uint64_t fs_per_ps = 1000;
  const std::uint64_t step_fs = file_.reader().timescale_fs();
  out << file_.name() << ": steps of " << exact_time(step_fs / fs_per_ps, step_fs % fs_per_ps)
      << ", " << (first_.empty() ? "no values" : first_ + " to " + last_) << ", " << signals_
      << (signals_ == 1 ? " signal, " : " signals, ") << values_
      << (values_ == 1 ? " value\n" : " values\n");
  each([&](const Signal& signal) {
    out << signal.path << "  " << signal.type << "  ";
    if (signal.alias_of.empty()) {
      out << signal.values << (signal.values == 1 ? " value" : " values");
    } else {
      out << "= " << signal.alias_of;
    }
    if (!signal.words.empty()) out << "  " << vp::join(signal.words, " ");
    out << "\n";
  });
}

std::string Listing::text() const {
  std::ostringstream text;
  write(text);
  return text.str();
}

std::vector<Table> Listing::tables() const {
  Table trace{"trace",
              "Trace",
              {"file", "timescale_fs", "first", "last", "values"},
              {{file_.name(), file_.reader().timescale_fs(), first_, last_, values_}},
              false};
  Table table{"signals", "Signals", {"signal", "type", "values", "alias_of", "words"}, {}, false};
  each([&](const Signal& signal) {
    table.rows.push_back(
        {signal.path, signal.type, signal.values, signal.alias_of, vp::join(signal.words, " ")});
  });
  return {std::move(trace), std::move(table)};
}

}  // namespace platform::trace
