#include "vcd_reader.h"

#include "gzip_source.h"

#include <fcntl.h>
#include <vp/error.h>
#include <vp/file.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>

// The values of a VCD.

namespace vp {

namespace {

constexpr const char* too_long =
    "a word, or white space, longer than 256 KiB: the file is corrupt, or no VCD";

class FileSource final : public ByteSource {
 public:
  explicit FileSource(const std::filesystem::path& file) : file_(file, "trace") {
    ::posix_fadvise(file_.descriptor(), 0, 0, POSIX_FADV_SEQUENTIAL);
  }

  std::size_t read(char* to, std::size_t size) override {
    return file_.read(to, size, InputFile::HostClock::now() + InputFile::patience);
  }

 private:
  InputFile file_;
};

bool is_blank(char c) {
  return static_cast<unsigned char>(c) <= ' ';
}

/// What a word is that begins with a letter.
enum class Word : std::uint8_t { other, time, scalar, vector, real, text, port, keyword };

struct Letter {
  Word word = Word::other;
  bool known = false;
  char bit = 0;
  char small = 0;  ///< as it is handed over
};

constexpr std::array<Letter, 256> make_letters() {
  std::array<Letter, 256> letters{};
  const auto at = [&](char c) -> Letter& { return letters[static_cast<unsigned char>(c)]; };
  for (const char c : {'0', '1', 'x', 'z', 'u', 'w', 'l', 'h', '-'}) {
    const Letter letter{Word::scalar, c == '0' || c == '1' || c == 'l' || c == 'h',
                        static_cast<char>(c == '1' || c == 'h'), c};
    at(c) = letter;
    if (c >= 'a') at(static_cast<char>(c - 'a' + 'A')) = letter;
  }
  at('#').word = Word::time;
  at('b').word = at('B').word = Word::vector;
  at('r').word = at('R').word = Word::real;
  at('s').word = at('S').word = Word::text;
  at('p').word = Word::port;
  at('$').word = Word::keyword;
  return letters;
}
constexpr auto letters = make_letters();

/// Eight digits 0 and 1 at once.
bool take_eight(const char* from, std::uint64_t& bits) {
  constexpr std::uint64_t zeros = 0x3030303030303030u, ones = 0x0101010101010101u;
  constexpr std::uint64_t gather = 0x8040201008040201u;  // the digit read first becomes the highest
  std::uint64_t word = 0;
  std::memcpy(&word, from, sizeof word);
  word ^= zeros;
  if ((word & ~ones) != 0) return false;
  bits = bits << 8 | word * gather >> 56;
  return true;
}

constexpr std::uint32_t no_net = 0;

}  // namespace

bool VcdWindow::refill(const char* from) {
  const auto unused = static_cast<std::size_t>(from - buffer_.data());
  const auto held = static_cast<std::size_t>(end_ - from);
  const bool only_blanks =
      held == 0 && unused == size && std::all_of(buffer_.data(), buffer_.data() + size, is_blank);
  if (held == size || only_blanks) {
    cursor = from;
    too_long_ = true;
    return false;
  }
  line(from);
  counted_ = buffer_.data();
  std::memmove(buffer_.data(), from, held);
  cursor = buffer_.data();
  end_ = buffer_.data() + held;
  std::size_t count = 0;
  const char* last = nullptr;
  do {
    count = source_->read(end_, size - static_cast<std::size_t>(end_ - buffer_.data()));
    read_ += count;
    end_ += count;
    last = end_;
    while (last != cursor && !is_blank(last[-1])) --last;
    // A word, and what belongs to it, must come whole: read until there is another blank.
  } while (count != 0 && static_cast<std::size_t>(last - cursor) <= held &&
           end_ != buffer_.data() + size);
  std::memset(end_, ' ', padding);
  safe_ = last;
  return static_cast<std::size_t>(end_ - cursor) > held;
}

std::uint64_t VcdWindow::line(const char* at) const {
  if (at > counted_) {
    lines_ += static_cast<std::uint64_t>(std::count(counted_, at, '\n'));
    counted_ = at;
  }
  return lines_;
}

VcdReader::VcdReader(const std::filesystem::path& file, const WaveOptions& options,
                     WaveNotes& notes)
    : file_(file),
      options_(options),
      notes_(notes),
      window_(unpacked(std::make_unique<FileSource>(file), file,
                       [this](const std::string& text) {
                         if (options_.strict)
                           throw InputError("trace '" + file_.string() + "' " + text +
                                            " (--strict refuses that)");
                         notes_.add(text, 0);
                       })),
      at_(window_.cursor) {
  read_header();
}

void VcdReader::fail(const std::string& problem) const {
  throw InputError("trace '" + file_.string() + "', line " + std::to_string(window_.line(at_)) +
                   " (byte " + std::to_string(window_.offset(at_)) + "): " + problem);
}

void VcdReader::note(const std::string& text) {
  if (options_.strict) fail(text + " (--strict refuses that)");
  notes_.add(text, window_.line(at_));
}

std::string_view VcdReader::next_word() {
  const char* from = window_.cursor;
  for (;;) {
    while (from < window_.safe() && is_blank(*from)) ++from;
    if (from < window_.safe()) break;
    if (window_.refill(from)) {
      from = window_.cursor;
      continue;
    }
    at_ = from = window_.cursor;
    if (window_.too_long()) fail(too_long);
    if (from == window_.end()) return {};
    window_.close_last_word();
  }
  const char* to = from + 1;
  while (!is_blank(*to)) ++to;
  window_.cursor = at_ = to;
  return {from, static_cast<std::size_t>(to - from)};
}

std::string_view VcdReader::next(const char* inside) {
  const std::string_view word = next_word();
  if (word.empty())
    fail(std::string("the file ends in the middle of ") + inside + ": it is truncated");
  return word;
}

bool VcdReader::pass_to_end() {
  for (;;) {
    const std::string_view word = next_word();
    if (word.empty()) return false;
    if (word == "$end") return true;
  }
}

void VcdReader::skip_to_end(const char* inside) {
  while (next(inside) != "$end") continue;
}

std::uint32_t VcdReader::net_of(std::string_view code) const {
  constexpr std::size_t short_code = 3;
  if (code.size() > short_code) {
    const auto found = by_long_code_.find(std::string(code));
    return found == by_long_code_.end() ? no_net : found->second;
  }
  std::size_t index = 0;
  for (const char c : code) {
    if (c < '!' || c > '~') return no_net;
    index = index * 94 + static_cast<std::size_t>(c - '!') + 1;
  }
  return index < by_short_code_.size() ? by_short_code_[index] : no_net;
}

std::uint32_t VcdReader::declared_net_of(std::string_view code) {
  const std::uint32_t net = net_of(code);
  if (net != no_net) return net;
  const std::string problem = code.empty() ? "a value without an identifier"
                                           : "the identifier " + shown(code) + " was not declared";
  if (!options_.lenient) fail(problem + " (--lenient leaves such values out)");
  note("values of identifiers that were not declared are left out");
  return no_net;
}

bool VcdReader::has_longer(std::string_view code) const {
  for (const auto& [longer, net] : by_long_code_) {
    if (longer.size() > code.size() && longer.compare(0, code.size(), code) == 0) return true;
  }
  // Codes of up to three characters: what two more may follow.
  for (char a = '!'; a <= '~' && code.size() < 3; ++a) {
    const std::string longer = std::string(code) + a;
    if (net_of(longer) != no_net) return true;
    for (char b = '!'; b <= '~' && longer.size() < 3; ++b) {
      if (net_of(longer + b) != no_net) return true;
    }
  }
  return false;
}

void VcdReader::read(const std::vector<bool>& selected, Clock& clock, WaveHandler& handler) {
  for (std::size_t i = 0; i < nets_.size(); ++i)
    nets_[i].selected = selected[i] && (nets_[i].width != 0);
  if (over_ || (!started_ && !begin_values(clock, handler))) return;
  for (;;) {
    const Status status = read_window(clock, handler);
    if (status == Status::stopped) return;
    if (status == Status::again) continue;
    if (status == Status::more && (window_.refill(window_.cursor) || accept_last_word())) continue;
    over_ = true;
    return;
  }
}

/// Values before the first time are those at 0. False: nothing more is to be read now.
bool VcdReader::begin_values(Clock& clock, WaveHandler& handler) {
  for (;;) {
    const std::string_view word = next_word();
    if (word.empty()) {
      over_ = true;
      return false;
    }
    if (word.front() == '$' && word != "$dumpoff" && word != "$dumpportsoff") {
      if (read_keyword(word, handler) == Status::over) {
        over_ = true;
        return false;
      }
      continue;
    }
    window_.cursor = word.data();
    if (word.front() == '#') return true;
    started_ = true;
    return clock.reach(0);
  }
}

/// Reads the words that are whole. Codes of up to three characters, as nearly all are, are looked
/// up in a table.
VcdReader::Status VcdReader::read_window(Clock& clock, WaveHandler& handler) {
  const char* at = window_.cursor;
  const char* const safe = window_.safe();
  const std::uint32_t* const table = by_short_code_.data();
  const std::size_t table_size = by_short_code_.size();
  const auto is_code = [](char c) { return static_cast<unsigned char>(c - '!') < 94; };
  // Passes the code at `to`, and tells its net + 1.
  const auto take_code = [&](const char*& to) -> std::uint32_t {
    const char* const from = to;
    std::size_t index = 0;
    for (int i = 0; i < 3 && is_code(*to); ++i, ++to)
      index = index * 94 + static_cast<std::size_t>(*to - '!') + 1;
    if (is_blank(*to) && index < table_size && table[index] != no_net) return table[index];
    while (!is_blank(*to)) ++to;
    at_ = to;
    return declared_net_of({from, static_cast<std::size_t>(to - from)});
  };
  while (at < safe) {
    const Letter letter = letters[static_cast<unsigned char>(*at)];
    if (letter.word == Word::scalar) {
      const char* to = at + 1;
      if (is_blank(*to) && !pass_blanks_of_bit(to)) break;
      const std::uint32_t net = take_code(to);
      at_ = at = to;
      if (net == no_net || !nets_[net - 1].selected) continue;
      if (nets_[net - 1].kind != WaveVariable::Kind::bits) {
        read_bits({&letters[static_cast<unsigned char>(letter.small)].small, 1}, net - 1, handler);
        continue;
      }
      WaveValue value;
      value.known = letter.known;
      value.bits = letter.bit > 0 ? 1 : 0;
      value.text = {&letters[static_cast<unsigned char>(letter.small)].small, 1};
      handler.change(net - 1, value);
      continue;
    }
    if (letter.word == Word::vector) {
      const char* const digits = at + 1;
      const char* to = digits;
      std::uint64_t bits = 0;
      while (take_eight(to, bits)) to += 8;
      for (; static_cast<unsigned char>(*to - '0') < 2; ++to)
        bits = bits << 1 | static_cast<std::uint64_t>(*to - '0');
      const char* const plain = to;
      while (!is_blank(*to)) ++to;
      const std::string_view text(digits, static_cast<std::size_t>(to - digits));
      const bool is_plain = plain == to;
      while (to < safe && is_blank(*to)) ++to;
      if (to >= safe) break;
      const std::uint32_t net = take_code(to);
      at_ = at = to;
      if (net == no_net || !nets_[net - 1].selected) continue;
      const Net& form = nets_[net - 1];
      if (!is_plain || text.empty() || text.size() > form.width ||
          form.kind != WaveVariable::Kind::bits) {
        read_bits(text, net - 1, handler);
        continue;
      }
      WaveValue value;
      value.known = true;
      value.bits = bits;
      value.text = text;
      handler.change(net - 1, value);
      continue;
    }
    if (letter.word == Word::time) {
      const char* to = at + 1;
      std::uint64_t steps = 0;
      for (; static_cast<unsigned char>(*to - '0') < 10; ++to)
        steps = steps * 10 + static_cast<std::uint64_t>(*to - '0');
      constexpr std::ptrdiff_t always_fits = 19;
      const bool is_plain = is_blank(*to) && to - at > 1 && to - at <= always_fits + 1;
      while (!is_blank(*to)) ++to;
      at_ = window_.cursor = to;
      Status status = Status::again;
      if (is_plain && steps > steps_) {
        steps_ = steps;
        started_ = true;
        if (!clock.reach(steps)) status = Status::stopped;
      } else {
        status = read_time({at + 1, static_cast<std::size_t>(to - at - 1)}, clock);
      }
      // A lenient reader may have gone into the next window.
      if (status != Status::again || window_.safe() != safe || window_.cursor != to) return status;
      at = to;
      continue;
    }
    if (is_blank(*at)) {
      ++at;
      continue;
    }
    const char* to = at;
    while (!is_blank(*to)) ++to;
    const std::string_view word(at, static_cast<std::size_t>(to - at));
    at_ = to;
    if (letter.word == Word::keyword) {
      window_.cursor = to;
      return read_keyword(word, handler);
    }
    if (letter.word == Word::other) fail("unexpected " + shown(word) + ": the file is corrupt");
    // A value, for a port two strengths, an identifier.
    for (int left = letter.word == Word::port ? 3 : 1; left > 0; --left) {
      while (to < safe && is_blank(*to)) ++to;
      if (to >= safe) break;
      if (left > 1) {
        while (!is_blank(*to)) ++to;
      }
    }
    if (to >= safe) break;
    const std::uint32_t net = take_code(to);
    at_ = at = to;
    if (net == no_net || !nets_[net - 1].selected) continue;
    const std::string_view text = word.substr(1);
    if (letter.word == Word::real) {
      read_real(text, net - 1, handler);
    } else if (letter.word == Word::text) {
      read_text(text, net - 1, handler);
    } else {
      read_port(text, net - 1, handler);
    }
  }
  window_.cursor = at;
  return Status::more;
}

/// Some tools write a blank between a bit and its identifier. False: that is behind the window.
bool VcdReader::pass_blanks_of_bit(const char*& to) {
  const char* const from = to;
  while (to < window_.safe() && (*to == ' ' || *to == '\t')) ++to;
  if (to >= window_.safe() && window_.safe() != window_.end()) return false;
  const char* end = to;
  while (end < window_.end() && !is_blank(*end)) ++end;
  if (net_of({to, static_cast<std::size_t>(end - to)}) == no_net) {
    to = from;  // a value without an identifier
    return true;
  }
  at_ = end;
  note("a blank is between a bit and its identifier");
  return true;
}

VcdReader::Status VcdReader::read_time(std::string_view digits, Clock& clock) {
  std::uint64_t steps = 0;
  const char* const end = digits.data() + digits.size();
  const auto parsed = std::from_chars(digits.data(), end, steps);
  if (parsed.ec == std::errc::result_out_of_range)
    fail("the time " + shown(digits) + " has more than 64 bits");
  if (parsed.ec != std::errc()) fail("the time " + shown(digits) + " is no number");
  const std::string_view rest(parsed.ptr, static_cast<std::size_t>(end - parsed.ptr));
  if (!rest.empty()) {
    if (rest.front() != '.') fail("the time " + shown(digits) + " is no number");
    if (rest.substr(1).find_first_not_of('0') != std::string_view::npos) {
      fail("the time " + shown(digits) +
           " is not whole: multiply the times, and give the file a finer $timescale");
    }
  }
  if (started_ && steps < steps_) {
    if (!options_.lenient)
      fail("the time falls to " + std::to_string(steps) + " (--lenient leaves such steps out)");
    return fall() ? Status::again : Status::over;
  }
  if (started_ && steps == steps_) return Status::again;
  steps_ = steps;
  started_ = true;
  return clock.reach(steps) ? Status::again : Status::stopped;
}

/// Leaves out a step whose time falls. False: the file is over.
bool VcdReader::fall() {
  note("times fall; these steps are left out");
  for (;;) {
    const std::string_view word = next_word();
    if (word.empty()) return false;
    const Word kind = letters[static_cast<unsigned char>(word.front())].word;
    if (kind == Word::time) {
      window_.cursor = word.data();
      return true;
    }
    const int more = kind == Word::port                                                 ? 3
                     : kind == Word::vector || kind == Word::real || kind == Word::text ? 1
                                                                                        : 0;
    for (int i = 0; i < more; ++i) next_word();
    if (word == "$comment" && !pass_to_end()) return false;
  }
}

VcdReader::Status VcdReader::read_keyword(std::string_view word, WaveHandler& handler) {
  const bool off = word == "$dumpoff" || word == "$dumpportsoff";
  if (word == "$comment" || word == "$version" || word == "$date" || word == "$attrbegin" || off) {
    if (off) {
      handler.recorded(false);
      hand_over_unknowns(handler);
    }
    if (pass_to_end()) return Status::again;
    note("was cut off in the middle of " + std::string(off ? "$dumpoff" : "a comment") +
         ": everything before it is read");
    return Status::over;
  }
  if (word == "$dumpon" || word == "$dumpportson") {
    handler.recorded(true);
    return Status::again;
  }
  // $vcdclose is followed by the time at which the trace ends.
  static constexpr std::string_view known[] = {"$end",       "$dumpvars",      "$dumpall",
                                               "$dumpports", "$dumpflush",     "$dumpportsall",
                                               "$vcdclose",  "$dumpportsflush"};
  if (std::find(std::begin(known), std::end(known), word) == std::end(known))
    fail("unknown keyword " + shown(word));
  return Status::again;
}

/// What is in $dumpoff: nothing is known.
void VcdReader::hand_over_unknowns(WaveHandler& handler) {
  for (std::uint32_t i = 0; i < nets_.size(); ++i) {
    const Net& net = nets_[i];
    if (!net.selected || net.is_event) continue;
    WaveValue value;
    value.kind = net.kind;
    value.real = std::numeric_limits<double>::quiet_NaN();
    value.known = net.kind == WaveVariable::Kind::text;
    value.text = net.kind == WaveVariable::Kind::bits   ? "x"
                 : net.kind == WaveVariable::Kind::real ? "nan"
                                                        : "";
    handler.change(i, value);
  }
}

/// Digits that are no plain number: letters, too many, a prefix; or of a signal of another type.
void VcdReader::read_bits(std::string_view digits, std::uint32_t net, WaveHandler& handler) {
  const Net& form = nets_[net];
  if (digits.substr(0, 2) == "0b") digits.remove_prefix(2);
  DecodedDigits decoded = decode_digits(digits);
  if (digits.empty()) fail("a value of 0 digits");
  if (!decoded.valid) fail(shown(digits) + " is no binary number");
  if (decoded.capitals) {
    digits_ = digits;
    for (char& c : digits_) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
    digits = digits_;
  }
  WaveValue value;
  value.known = decoded.known;
  value.bits = decoded.bits;
  value.text = digits;
  if (form.kind == WaveVariable::Kind::text) {
    note("a text has a number as its value");
    value.kind = form.kind;
    value.known = true;
  } else if (form.kind == WaveVariable::Kind::real) {
    note("a real signal has bits as its value: they are taken as a whole number");
    value.kind = form.kind;
    value.real = value.known ? static_cast<double>(value.bits) : std::nan("");
    text_.resize(32);
    const auto end = std::to_chars(text_.data(), text_.data() + text_.size(), value.real).ptr;
    value.text = std::string_view(text_.data(), static_cast<std::size_t>(end - text_.data()));
  } else if (digits.size() > form.width) {
    shorten(digits, form.width);
    decoded = decode_digits(digits);
    value.known = decoded.known;
    value.bits = decoded.bits;
    value.text = digits;
  } else if (digits.size() < form.width &&
             std::string_view("01xz").find(digits.front()) == std::string_view::npos) {
    note(
        "values begin with a letter that the standard does not extend to the left: it is "
        "repeated");
  }
  handler.change(net, value);
}

/// Leaves out the digits on the left that say nothing.
void VcdReader::shorten(std::string_view& digits, unsigned width) {
  const std::string_view lost = digits.substr(0, digits.size() - width);
  const std::string_view left = digits.substr(lost.size());
  const char restored = left.front() == '1' ? '0' : left.front();
  if (lost.find_first_not_of(restored) != std::string_view::npos) {
    fail("a value of " + std::to_string(digits.size()) + " digits for a signal of " +
         std::to_string(width) + " bits");
  }
  note(
      "values have more digits than their signal: those on the left, which say nothing, are left "
      "out");
  digits = left;
}

void VcdReader::read_real(std::string_view digits, std::uint32_t net, WaveHandler& handler) {
  WaveValue value;
  value.kind = WaveVariable::Kind::real;
  if (!digits.empty() && digits.front() == '+') digits.remove_prefix(1);
  value.text = digits;
  const char* const end = digits.data() + digits.size();
  const auto parsed = std::from_chars(digits.data(), end, value.real);
  if (parsed.ec == std::errc::invalid_argument || parsed.ptr != end)
    fail(shown(digits) + " is no number");
  value.known = std::isfinite(value.real);
  if (nets_[net].kind != WaveVariable::Kind::real) {
    note("a signal of bits or text has a real number as its value");
    if (nets_[net].kind == WaveVariable::Kind::text) {
      value.kind = WaveVariable::Kind::text;
      value.known = true;
    }
  }
  handler.change(net, value);
}

void VcdReader::read_text(std::string_view text, std::uint32_t net, WaveHandler& handler) {
  if (nets_[net].kind != WaveVariable::Kind::text)
    note("a signal of bits or numbers has words as values: it is a text from there on");
  unescape(text, text_);
  WaveValue value;
  value.kind = WaveVariable::Kind::text;
  value.known = true;
  value.text = text_;
  handler.change(net, value);
}

void VcdReader::read_port(std::string_view states, std::uint32_t net, WaveHandler& handler) {
  std::string digits;
  for (const char c : states) {
    digits += state_of_port(c);
    if (digits.back() == '\0') fail(shown(states) + " are no states of a port");
  }
  read_bits(digits, net, handler);
}

bool VcdReader::accept_last_word() {
  at_ = window_.cursor;
  if (window_.too_long()) fail(too_long);
  const char* from = window_.cursor;
  while (from != window_.end() && is_blank(*from)) ++from;
  if (from == window_.end()) return false;
  at_ = from;
  std::vector<std::string_view> words;
  for (const char* to = from; to != window_.end(); from = to) {
    while (from != window_.end() && is_blank(*from)) ++from;
    for (to = from; to != window_.end() && !is_blank(*to);) ++to;
    if (to != from) words.emplace_back(from, static_cast<std::size_t>(to - from));
  }
  const std::string_view first = words.front();
  const Word kind = letters[static_cast<unsigned char>(first.front())].word;
  const std::size_t needed = kind == Word::port                                                 ? 4
                             : kind == Word::vector || kind == Word::real || kind == Word::text ? 2
                                                                                                : 1;
  const std::string_view last = words.back();
  bool whole = words.size() == needed && window_.safe() != window_.end();
  if (kind == Word::scalar || needed > 1) {
    const std::string_view code = needed == 1 ? last.substr(1) : last;
    whole = whole && net_of(code) != no_net && !has_longer(code);
  } else if (kind == Word::time) {
    std::uint64_t steps = 0;
    const char* const end = last.data() + last.size();
    const auto parsed = std::from_chars(last.data() + 1, end, steps);
    whole = whole && parsed.ec == std::errc() && parsed.ptr == end && steps >= steps_;
  } else {
    whole = whole && first == "$end";
  }
  if (!whole) {
    note("was cut off in the middle of a value: everything before it is read");
    return false;
  }
  note("does not end with a line end: its last word is taken as whole");
  window_.close_last_word();
  return true;
}

}  // namespace vp
