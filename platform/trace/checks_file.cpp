// Reads a checks file: a check a line.
#include <trace/checks.h>

#include <limits>
#include <map>
#include <sstream>

#include <vp/error.h>
#include <vp/input_file.h>
#include <vp/text.h>
#include <vp/unit.h>

namespace platform::trace {

namespace {

constexpr std::uint64_t ps_per_second = 1'000'000'000'000;

/// What was read so far: a clock counts for the checks below it.
struct ChecksReader {
  std::string file;
  std::uint64_t line = 0;
  std::uint64_t clock_hz = 100'000'000;
  std::vector<Check> checks;
  std::map<std::string, std::uint64_t> line_of;  ///< of a check's name

  [[noreturn]] void fail(const std::string& problem) const {
    throw vp::InputError("checks '" + file + "', line " + std::to_string(line) + ": " + problem);
  }

  vp::WaveExpression expression(std::string_view text) const {
    try {
      return vp::WaveExpression(text);
    } catch (const vp::InputError& error) {
      fail(error.what());
    }
  }

  /// The two sides of the word `at`, which stands between blanks.
  std::pair<std::string, std::string> split_at(const std::string& text, const std::string& at,
                                               const std::string& shape) const {
    const auto place = text.find(" " + at + " ");
    if (place == std::string::npos) fail("'" + at + "' is missing: write " + shape);
    return {text.substr(0, place), text.substr(place + at.size() + 2)};
  }

  std::uint64_t number(const std::string& text, vp::Unit unit, const std::string& what) const {
    try {
      const auto value = vp::parse_quantity(text, unit).whole();
      if (value && *value > 0 && *value <= std::numeric_limits<std::int64_t>::max()) {
        return static_cast<std::uint64_t>(*value);
      }
    } catch (const vp::InputError& error) {
      fail(what + " '" + text + "' " + error.what());
    }
    fail(what + " '" + text + "' is not a whole number above 0");
  }

  /// "20 cycles" of the clock, or a time.
  std::uint64_t duration(const std::string& text) const {
    if (text.find("cycle") == std::string::npos) return number(text, vp::Unit::time, "the time");
    const std::uint64_t cycles = number(text, vp::Unit::cycles, "the number");
    if (cycles > ps_per_second) fail("so many cycles never pass");
    return static_cast<std::uint64_t>(static_cast<unsigned __int128>(cycles) * ps_per_second / clock_hz);
  }

  void read_clock(const std::string& text) {
    clock_hz = number(text, vp::Unit::frequency, "the clock");
    if (clock_hz > ps_per_second) fail("the clock is too fast");
  }

  void read_check(const std::string& text);
};

void ChecksReader::read_check(const std::string& text) {
  const auto colon = text.find(':');
  if (colon == std::string::npos) fail("write 'name: always …' or 'clock 100 MHz'");
  Check check;
  check.name = vp::trim(text.substr(0, colon));
  check.text = vp::trim(text.substr(colon + 1));
  check.line = line;
  check.clock_hz = clock_hz;
  if (check.name.empty()) fail("the check has no name before ':'");
  const auto [other, is_new] = line_of.emplace(check.name, line);
  if (!is_new)
    fail("there is a check '" + check.name + "' in line " + std::to_string(other->second));
  const auto blank = check.text.find(' ');
  const std::string kind = check.text.substr(0, blank);
  const std::string rest =
      blank == std::string::npos ? "" : std::string(vp::trim(check.text.substr(blank)));
  if (kind == "always" || kind == "never") {
    check.kind = kind == "always" ? Check::Kind::always : Check::Kind::never;
    check.first = expression(rest);
  } else if (kind == "at") {
    check.kind = Check::Kind::at;
    const auto [when, what] = split_at(rest, "holds", "at CONDITION holds CONDITION");
    check.first = expression(when);
    check.second = expression(what);
  } else if (kind == "within") {
    check.kind = Check::Kind::within;
    const std::string shape = "within 20 cycles of CONDITION holds CONDITION";
    const auto [time, both] = split_at(rest, "of", shape);
    const auto [when, what] = split_at(both, "holds", shape);
    check.limit_ps = duration(time);
    check.first = expression(when);
    check.second = expression(what);
  } else if (kind == "stable") {
    check.kind = Check::Kind::stable;
    const auto [what, when] = split_at(rest, "while", "stable VALUE while CONDITION");
    check.first = expression(what);
    check.second = expression(when);
  } else if (kind == "increases") {
    check.kind = Check::Kind::increases;
    const auto [what, rest2] =
        split_at(rest, "when", "increases VALUE when CONDITION [restart CONDITION]");
    const auto restart = rest2.find(" restart ");
    check.first = expression(what);
    check.second = expression(rest2.substr(0, restart));
    if (restart != std::string::npos) check.restart = expression(rest2.substr(restart + 9));
  } else if (kind == "bursts") {
    check.kind = Check::Kind::bursts;
    const std::string shape = "bursts of 32 beats CONDITION last CONDITION";
    const auto [count, both] = split_at(" " + rest, "beats", shape);
    const auto [beat, last] = split_at(both, "last", shape);
    const std::string words(vp::trim(count));
    if (words.substr(0, 3) != "of ") fail("'of' is missing: write " + shape);
    check.limit = number(std::string(vp::trim(words.substr(3))), vp::Unit::none, "the length");
    check.second = expression(beat);
    check.first = expression(last);
  } else {
    const std::vector<std::string> kinds = {"always", "never",     "at",    "within",
                                            "stable", "increases", "bursts"};
    fail("'" + kind + "' is no kind of check: there are " + vp::join(kinds, ", "));
  }
  checks.push_back(std::move(check));
}

}  // namespace

std::vector<Check> read_checks(const std::string& file) {
  std::istringstream stream(vp::read_text(file, "checks"));
  ChecksReader reader;
  reader.file = file;
  for (std::string line; std::getline(stream, line);) {
    ++reader.line;
    const std::string text(vp::trim(line.substr(0, line.find('#'))));
    if (text.empty()) continue;
    if (text.rfind("clock ", 0) == 0) {
      reader.read_clock(std::string(vp::trim(text.substr(6))));
    } else {
      reader.read_check(text);
    }
  }
  if (reader.checks.empty()) throw vp::InputError("checks '" + file + "': there is none in it");
  return std::move(reader.checks);
}

}  // namespace platform::trace
