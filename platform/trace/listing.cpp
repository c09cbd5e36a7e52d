#include <trace/listing.h>

#include <vp/text.h>
#include <vp/unit.h>

#include <cstring>
#include <optional>

namespace platform::trace {

namespace {

using Kind = vp::WaveVariable::Kind;

std::string type_of(const vp::WaveVariable& variable) {
  if (variable.is_event) return "event";
  if (variable.kind == Kind::real) return "real";
  if (variable.kind == Kind::text) return "text";
  return std::to_string(variable.width) + (variable.width == 1 ? " bit" : " bits");
}

/// Without the digits on the left that full_digits() restores.
std::string_view shortest_digits(std::string_view digits) {
  const auto is_restored = [&] {
    return digits[0] == '0' ? digits[1] == '0' || digits[1] == '1'
                            : digits[0] != '1' && digits[0] == digits[1];
  };
  while (digits.size() > 1 && is_restored()) digits.remove_prefix(1);
  return digits;
}

/// Counts the values of each net that are not the one before.
class ValueCounter final : public vp::WaveHandler {
 public:
  explicit ValueCounter(TraceFile& file) : file_(file), nets_(file.reader().nets()) {}

  bool at(std::uint64_t ps) override {
    if (!first) first = exact_time(ps, file_.reader().below_ps());
    return true;
  }
  void change(std::uint32_t net, const vp::WaveValue& value) override {
    Net& state = nets_[net];
    Form form = Form::text;
    std::uint64_t bits = value.bits;
    std::string_view text = value.text;
    if (value.kind == Kind::bits && value.plain && state.width <= 64) {
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
    nets_[variable.net].width = variable.width;
  }
  std::uint64_t count(std::uint32_t net) const { return nets_[net].count; }

  std::optional<std::string> first;

 private:
  /// What two values are compared by: bits, the bits of a real, a letter that fills all digits, or
  /// what the file says.
  enum class Form : std::uint8_t { bits, real, letter, text };
  struct Net {
    std::uint64_t count = 0, bits = 0;
    unsigned width = 0;
    Form form = Form::text;
    bool is_event = false;
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

Listing listing(TraceFile& file, const vp::TraceFilter& filter) {
  filter.check(file.paths(), {});
  vp::WaveReader& reader = file.reader();
  ValueCounter counter(file);
  std::vector<std::int64_t> first_of_net(reader.nets(), -1);
  Listing listing;
  std::vector<std::uint32_t> nets;
  for (std::uint32_t i = 0; i < file.paths().size(); ++i) {
    if (!filter.selects(file.paths()[i])) continue;
    const vp::WaveVariable& variable = file.variable(i);
    Listing::Signal signal{file.paths()[i], type_of(variable), "", 0, {}};
    if (first_of_net[variable.net] >= 0) {
      signal.alias_of = listing.signals[static_cast<std::size_t>(first_of_net[variable.net])].path;
    } else {
      first_of_net[variable.net] = static_cast<std::int64_t>(listing.signals.size());
      reader.select(variable.net);
      counter.declare(variable);
    }
    if (variable.enumeration != 0) {
      for (const auto& [digits, word] : reader.enumerations()[variable.enumeration - 1].words)
        signal.words.push_back(word);
    }
    listing.signals.push_back(std::move(signal));
    nets.push_back(variable.net);
  }
  reader.read(counter);
  listing.file = file.name();
  listing.timescale_fs = reader.timescale_fs();
  listing.has_times = counter.first.has_value();
  listing.first = counter.first.value_or("");
  listing.last = exact_time(reader.now_ps(), reader.below_ps());
  for (std::size_t i = 0; i < nets.size(); ++i) {
    listing.signals[i].changes = counter.count(nets[i]);
    if (listing.signals[i].alias_of.empty()) listing.changes += listing.signals[i].changes;
  }
  return listing;
}

std::string Listing::text() const {
  constexpr std::uint64_t fs_per_ps = 1000;
  std::string text =
      file + ": steps of " + exact_time(timescale_fs / fs_per_ps, timescale_fs % fs_per_ps) + ", " +
      (has_times ? first + " to " + last : "no values") + ", " + std::to_string(signals.size()) +
      (signals.size() == 1 ? " signal, " : " signals, ") + std::to_string(changes) +
      (changes == 1 ? " value\n" : " values\n");
  for (const Signal& signal : signals) {
    text += signal.path + "  " + signal.type + "  ";
    text += signal.alias_of.empty()
                ? std::to_string(signal.changes) + (signal.changes == 1 ? " value" : " values")
                : "= " + signal.alias_of;
    if (!signal.words.empty()) text += "  " + vp::join(signal.words, " ");
    text += "\n";
  }
  return text;
}

std::vector<Table> Listing::tables() const {
  Table trace{"trace",
              "Trace",
              {"file", "timescale_fs", "first", "last", "values"},
              {{file, timescale_fs, first, has_times ? last : std::string(), changes}},
              false};
  Table table{"signals", "Signals", {"signal", "type", "values", "alias_of", "words"}, {}, false};
  for (const Signal& signal : signals) {
    table.rows.push_back(
        {signal.path, signal.type, signal.changes, signal.alias_of, vp::join(signal.words, " ")});
  }
  return {std::move(trace), std::move(table)};
}

}  // namespace platform::trace
