#include "vcd_reader.h"

#include "gzip_source.h"

#include <vp/error.h>

#include <algorithm>
#include <charconv>
#include <cstring>

// The words behind the header of a VCD.

namespace vp {

namespace {

constexpr const char* too_long =
    "a word, or white space, longer than 256 KiB: the file is corrupt, or no VCD";

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

VcdReader::VcdReader(const std::filesystem::path& file, const WaveOptions& options,
                     WaveNotes& notes)
    : file_(file),
      options_(options),
      notes_(notes),
      window_(unpacked(open_bytes(file), file,
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
  if (code.size() > short_code) return by_long_code_.find(code);
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
  if (by_long_code_.has_longer(code)) return true;
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

void VcdReader::select(const std::vector<bool>& selected) {
  for (std::size_t i = 0; i < nets_.size(); ++i)
    nets_[i].selected = selected[i] && (nets_[i].width != 0);
}

void VcdReader::enter(const Place& place, const std::vector<std::uint64_t>& changes,
                      const std::vector<bool>& selected, Clock& clock, WaveHandler& handler) {
  window_.seek(place.offset, place.line);
  select(selected);
  steps_ = place.steps;
  started_ = true;
  over_ = false;
  if (!clock.reach(place.steps)) return;
  for (const std::uint64_t offset : changes) read_change(offset, clock, handler);
  window_.seek(place.offset, place.line);
}

void VcdReader::read_change(std::uint64_t offset, Clock& clock, WaveHandler& handler) {
  window_.seek(offset, 1);
  single_ = true;
  do {
    if (!window_.refill(window_.cursor)) window_.close_last_word();
  } while (read_window(clock, handler) == Status::more &&
           window_.offset(window_.cursor) == offset && window_.safe() != window_.end());
  single_ = false;
}

void VcdReader::read(const std::vector<bool>& selected, Clock& clock, WaveHandler& handler) {
  select(selected);
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
    window_.cursor = begin_ = word.data();
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
  const char* const until = single_ ? std::min(at + 1, safe) : safe;
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
  while (at < until) {
    const Letter letter = letters[static_cast<unsigned char>(*at)];
    begin_ = at;
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
      value.plain = letter.small == '0' || letter.small == '1';
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
      value.known = value.plain = true;
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
