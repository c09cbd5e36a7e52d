#include "fst_reader.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "wave_input.h"

namespace vp {

namespace {

/// Bytes that are read at once: chains of one block lie side by side.
constexpr std::uint64_t window_size = 1 << 18;

/// What a scalar can be: 0, 1 and the letters.
constexpr std::size_t scalar_states = 2 + fst::letters.size();
std::array<WaveValue, scalar_states> scalar_values() {
  std::array<WaveValue, scalar_states> values;
  for (std::size_t state = 0; state < values.size(); ++state) {
    WaveValue& value = values[state];
    value.plain = state < 2;
    value.text =
        value.plain ? std::string_view("01").substr(state, 1) : fst::letters.substr(state - 2, 1);
    value.known = value.plain || value.text == "h" || value.text == "l";
    value.bits = value.text == "1" || value.text == "h" ? 1 : 0;
  }
  return values;
}

std::uint64_t swapped(std::uint64_t bits, bool swap) {
  return swap ? __builtin_bswap64(bits) : bits;
}

}  // namespace

FstReader::FstReader(const std::filesystem::path& file) : file_(file) {
  constexpr int femtoseconds = -15, hundred_seconds = 2;
  const int scale = file_.timescale();
  if (scale < femtoseconds || scale > hundred_seconds) {
    constexpr std::uint64_t place = 73;
    file_.fail("the time scale 1e" + std::to_string(scale) + " s is not 1 fs to 100 s", place);
  }
  for (int i = femtoseconds; i < scale; ++i) timescale_fs_ *= 10;
  read_hierarchy();
}

std::string FstReader::remark() const {
  if (file_.is_finished()) return {};
  return "was not finished by its writer; it ends with the last whole block of changes";
}

[[noreturn]] void FstReader::corrupt_changes() const {
  file_.fail("the changes of a signal are corrupt", file_.changes()[block_ - 1].at);
}

std::uint64_t FstReader::block_before(std::uint64_t steps) {
  if (starts_.empty()) {
    for (const fst::File::Section& section : file_.changes()) {
      const std::string start = file_.read(section.at, sizeof steps);
      starts_.push_back(fst::Cursor(file_, start, section.at, "block of changes").u64());
    }
  }
  const auto after = std::upper_bound(starts_.begin(), starts_.end(), steps);
  return after == starts_.begin() ? 0 : static_cast<std::uint64_t>(after - starts_.begin()) - 1;
}

void FstReader::read(const std::vector<bool>& selected, WaveClock& clock, WaveHandler& handler) {
  needs_texts_ = handler.needs_texts();
  bool entered = entry_.has_value();
  if (entered) {
    block_ = *std::exchange(entry_, std::nullopt);
    // The first values of a block leave out texts.
    for (std::size_t net = 0; net < nets_.size(); ++net) {
      if (selected[net] && nets_[net].kind == WaveVariable::Kind::text) block_ = 0;
    }
    open_ = false;
  }
  for (;;) {
    if (open_) {
      if (!hand_over_block(clock, selected, handler)) return;
      open_ = false;
    }
    if (block_ == file_.changes().size()) break;
    open_block(file_.changes()[block_++], selected, std::exchange(entered, false));
  }
  const std::uint64_t end = file_.is_finished() ? file_.end_time() : block_end_;
  if (!file_.changes().empty() && end > block_end_) clock.reach(end);
}

void FstReader::open_block(const fst::File::Section& section, const std::vector<bool>& selected,
                           bool entered) {
  constexpr std::uint64_t fixed = 24, longest_numbers = 4 * 10 + 1;
  const std::uint64_t table_end = read_times(section);
  const std::string head = file_.read(section.at, std::min(section.size, fixed + longest_numbers));
  fst::Cursor cursor(file_, head, section.at, "block of changes");
  block_start_ = cursor.u64();
  block_end_ = cursor.u64();
  cursor.u64();  // what its writer thinks a reader needs
  const std::uint64_t unpacked = cursor.varint(), packed = cursor.varint();
  cursor.varint();  // handles in the frame
  const std::uint64_t frame_at = cursor.offset();
  if (packed > section.end() - frame_at) cursor.fail("is shorter than its first values");
  frame_due_ = block_ == 1 || entered;
  if (frame_due_) frame_ = file_.read_packed(frame_at, packed, unpacked);

  const std::uint64_t behind = frame_at + packed;
  const std::string numbers =
      file_.read(behind, std::min(section.end() - behind, std::uint64_t{11}));
  fst::Cursor next(file_, numbers, behind, "block of changes");
  const std::uint64_t handles = next.varint();
  const std::uint64_t changes_at = next.offset();
  const char method = static_cast<char>(next.byte());
  const auto places = read_places(section, changes_at, table_end, handles);
  unpack_chains(places, method, selected);
  instant_ = 0;
  announced_ = false;
  open_ = true;
}

std::uint64_t FstReader::read_times(const fst::File::Section& section) {
  constexpr std::uint64_t tail_size = 24, length_size = 8;
  if (section.size < tail_size + length_size) {
    file_.fail("a block of changes is too short: the file is corrupt", section.at);
  }
  const std::string tail = file_.read(section.end() - tail_size, tail_size);
  fst::Cursor cursor(file_, tail, section.end() - tail_size, "table of times");
  const std::uint64_t unpacked = cursor.u64(), packed = cursor.u64(), count = cursor.u64();
  if (packed > section.size - tail_size - length_size) cursor.fail("is longer than its block");
  const std::uint64_t at = section.end() - tail_size - packed;
  times_ = file_.read_packed(at, packed, unpacked);
  if (count > times_.size() || count > std::numeric_limits<std::uint32_t>::max()) {
    cursor.fail("is shorter than it says");
  }
  times_at_ = at;
  times_taken_ = 0;
  now_ = 0;
  instants_ = count;
  return at - length_size;
}

std::uint64_t FstReader::next_time() {
  fst::Cursor cursor(file_, std::string_view(times_).substr(times_taken_), times_at_,
                     "table of times");
  const std::uint64_t step = cursor.varint();
  times_taken_ += cursor.consumed();
  if (step > std::numeric_limits<std::uint64_t>::max() - now_) cursor.fail("overflows");
  return now_ += step;
}

// The table has an entry for each handle in turn: the distance to the next chain, or whose chain
// it shares, or how many handles have none.
std::vector<FstReader::Place> FstReader::read_places(const fst::File::Section& section,
                                                     std::uint64_t changes_at,
                                                     std::uint64_t table_end,
                                                     std::uint64_t handles) const {
  const std::string length = file_.read(table_end, 8);
  const std::uint64_t size = fst::Cursor(file_, length, table_end, "table of chains").u64();
  if (table_end < changes_at || size > table_end - changes_at) {
    file_.fail("the table of chains is longer than its block: the file is corrupt", table_end);
  }
  const std::uint64_t table_at = table_end - size;
  const std::string bytes = file_.read(table_at, size);
  fst::Cursor cursor(file_, bytes, table_at, "table of chains");
  handles = std::min<std::uint64_t>(handles, nets_.size());
  std::vector<Place> places(handles);
  std::uint64_t handle = 0, at = changes_at, last_alias = 0;
  Place* last = nullptr;
  const auto share = [&](std::uint64_t alias) {
    if (alias == 0 || alias > handle) cursor.fail("names a chain that is not there");
    places[handle++].same_as = static_cast<std::uint32_t>(alias);
  };
  const auto begin = [&](std::uint64_t distance) {
    if (distance == 0 || distance >= table_at - at) cursor.fail("points out of its block");
    at += distance;
    if (last) last->size = at - last->at;
    last = &places[handle++];
    last->at = at;
  };
  while (!cursor.at_end() && handle < handles) {
    if (section.type == fst::values_aliases_signed && (cursor.peek() & 1) != 0) {
      const std::int64_t number = cursor.signed_varint() >> 1;
      if (number > 0) {
        begin(static_cast<std::uint64_t>(number));
      } else {
        if (number < 0) last_alias = -static_cast<std::uint64_t>(number);
        share(last_alias);
      }
      continue;
    }
    const std::uint64_t number = cursor.varint();
    if (number == 0 && section.type == fst::values_aliases) {
      share(cursor.varint());
    } else if ((number & 1) != 0) {
      begin(number >> 1);
    } else {
      handle += std::min(number >> 1, handles - handle);
    }
  }
  // Chains of handles that nothing names may follow.
  if (last) last->size = table_at - last->at;
  return places;
}

void FstReader::unpack_chains(const std::vector<Place>& places, char method,
                              const std::vector<bool>& selected) {
  changes_.begin(instants_);
  std::vector<std::string_view> chains(places.size());
  std::vector<bool> wanted(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!selected[i]) continue;
    wanted[places[i].same_as != 0 ? places[i].same_as - 1 : i] = true;
  }
  unpacked_.clear();
  std::uint64_t window_at = 0, window_end = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Place& place = places[i];
    if (!wanted[i] || place.at == 0) continue;
    if (place.at < window_at || place.at + place.size > window_end) {
      window_at = place.at;
      const std::uint64_t size =
          std::max(place.size, std::min(window_size, file_.size() - window_at));
      window_end = window_at + size;
      if (window_.size() < size) window_.resize(size);
      file_.read(window_at, window_.data(), size);
    }
    const auto packed = std::string_view(window_).substr(place.at - window_at, place.size);
    fst::Cursor cursor(file_, packed, place.at, "chain of changes");
    const std::uint64_t size = cursor.varint();
    const std::string_view content = packed.substr(cursor.consumed());
    if (size > fst::most_unpacked(method, content.size())) cursor.fail("has an impossible size");
    const std::size_t length = size == 0 ? content.size() : size;
    char* const chain = unpacked_.take(length);
    if (size == 0) {
      std::copy(content.begin(), content.end(), chain);
    } else if (!fst::unpack(method, content, chain, length)) {
      cursor.fail("cannot be unpacked");
    }
    chains[i] = {chain, length};
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::uint32_t same_as = places[i].same_as;
    const std::string_view chain = chains[same_as != 0 ? same_as - 1 : i];
    if (!selected[i] || chain.empty()) continue;
    if (!changes_.add(chain_of(static_cast<std::uint32_t>(i), chain))) corrupt_changes();
  }
}

FstChanges::Chain FstReader::chain_of(std::uint32_t net, std::string_view bytes) const {
  const Net& form = nets_[net];
  const bool is_scalar = form.kind == WaveVariable::Kind::bits && form.length() == 1;
  FstChanges::Chain chain{bytes.data(), bytes.data() + bytes.size(), net, FstChanges::Form::vector,
                          static_cast<std::uint32_t>(form.length())};
  if (form.kind == WaveVariable::Kind::text) chain.form = FstChanges::Form::text;
  if (is_scalar) chain.form = FstChanges::Form::scalar;
  if (form.kind == WaveVariable::Kind::real) {
    chain.form = FstChanges::Form::real;
    chain.length = sizeof(double);
  }
  return chain;
}

bool FstReader::hand_over_block(WaveClock& clock, const std::vector<bool>& selected,
                                WaveHandler& handler) {
  if (frame_due_) {
    if (!std::exchange(announced_, true) && !clock.reach(block_start_)) return false;
    hand_over_frame(selected, handler);
    frame_due_ = announced_ = false;
  }
  for (; instant_ < instants_; ++instant_, announced_ = false) {
    if (!std::exchange(announced_, true) && !clock.reach(next_time())) return false;
    const auto changes = changes_.at(instant_);
    if (!changes) corrupt_changes();
    for (const FstChanges::Change& change : *changes) hand_over(change, handler);
  }
  return true;
}

/// The values at the start of a block. What is unknown in the first has no value yet; an event of
/// an earlier block is over.
void FstReader::hand_over_frame(const std::vector<bool>& selected, WaveHandler& handler) {
  const std::string_view frame = frame_;
  std::size_t at = 0;
  for (std::uint32_t net = 0; net < nets_.size(); ++net) {
    if (nets_[net].kind == WaveVariable::Kind::text) continue;
    const bool is_real = nets_[net].kind == WaveVariable::Kind::real;
    const std::size_t size = is_real ? sizeof(double) : nets_[net].length();
    if (size > frame.size() - at) return;  // it was declared later
    const std::string_view value = frame.substr(at, size);
    at += size;
    const bool first = block_ == 1;
    if (!selected[net] || (nets_[net].is_event && !first)) continue;
    double real = 0;
    if (is_real) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, value.data(), sizeof bits);
      bits = swapped(bits, file_.is_swapped());
      std::memcpy(&real, &bits, sizeof real);
      if (!first || !std::isnan(real)) hand_over_real(net, value.data(), handler);
    } else if (!first || value.find_first_not_of('x') != std::string_view::npos) {
      hand_over_bits(net, value, handler);
    }
  }
}

void FstReader::hand_over(const FstChanges::Change& change, WaveHandler& handler) {
  static const auto scalars = scalar_values();
  switch (change.form) {
    case FstChanges::Form::scalar:
      handler.change(change.net, scalars[change.state()]);
      break;
    case FstChanges::Form::vector:
      if (change.as_written()) {
        hand_over_bits(change.net, {change.bytes, nets_[change.net].length()}, handler);
      } else {
        hand_over_packed(change, handler);
      }
      break;
    case FstChanges::Form::real:
      // Packed are the eight bytes of a real that happen to be digits.
      hand_over_real(change.net,
                     change.as_written()
                         ? change.bytes
                         : digits_of_byte[static_cast<unsigned char>(*change.bytes)].data(),
                     handler);
      break;
    case FstChanges::Form::text: {
      WaveValue value;
      value.kind = WaveVariable::Kind::text;
      value.known = true;
      value.text = FstChanges::text(change);
      if (!is_utf8(value.text)) value.text = text_ = in_utf8(value.text);
      handler.change(change.net, value);
      break;
    }
  }
}

void FstReader::hand_over_packed(const FstChanges::Change& change, WaveHandler& handler) {
  const Net& form = nets_[change.net];
  if (form.is_port) corrupt_changes();
  WaveValue value;
  value.known = value.plain = true;
  if (form.width <= FstChanges::widest_bits) {
    value.bits = change.bits;
    if (needs_texts_) value.text = digits_of(value.bits, form.width);
  } else {
    const unsigned count = (form.width + 7) / 8;
    text_.resize(std::size_t{count} * 8);
    for (unsigned i = 0; i < count; ++i) {
      const auto byte = static_cast<unsigned char>(change.bytes[i]);
      std::memcpy(&text_[std::size_t{i} * 8], digits_of_byte[byte].data(), 8);
    }
    value.text = std::string_view(text_).substr(0, form.width);
    // The lowest 64 bits are in the last nine bytes, or eight if they end with the last one.
    unsigned __int128 last = 0;
    for (unsigned i = count > 9 ? count - 9 : 0; i < count; ++i)
      last = last << 8 | static_cast<unsigned char>(change.bytes[i]);
    value.bits = static_cast<std::uint64_t>(last >> (count * 8 - form.width));
  }
  handler.change(change.net, value);
}

std::string_view FstReader::digits_of(std::uint64_t bits, unsigned width) {
  constexpr unsigned most = 64;
  text_.resize(most);
  for (unsigned i = 0; i < most / 8; ++i)
    std::memcpy(&text_[std::size_t{i} * 8],
                digits_of_byte[bits >> (most - 8 - i * 8) & 0xff].data(), 8);
  return std::string_view(text_).substr(most - width);
}

void FstReader::hand_over_bits(std::uint32_t net, std::string_view digits, WaveHandler& handler) {
  const auto rewrite = [&](const auto& state_of) {
    text_.assign(digits.substr(0, nets_[net].width));
    for (char& c : text_) c = state_of(c);
    digits = text_;
  };
  if (nets_[net].is_port) rewrite(state_of_port);
  const DecodedDigits decoded = decode_digits(digits);
  if (!decoded.valid) corrupt_changes();
  if (decoded.capitals) {
    rewrite([](char c) { return static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c); });
  }
  WaveValue value;
  value.known = decoded.known;
  value.plain = decoded.plain;
  value.bits = decoded.bits;
  value.text = digits;
  handler.change(net, value);
}

void FstReader::hand_over_real(std::uint32_t net, const char* bytes, WaveHandler& handler) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, bytes, sizeof bits);
  bits = swapped(bits, file_.is_swapped());
  WaveValue value;
  value.kind = WaveVariable::Kind::real;
  std::memcpy(&value.real, &bits, sizeof bits);
  value.known = std::isfinite(value.real);
  if (needs_texts_ || !value.known) {
    constexpr std::size_t longest = 32;
    text_.resize(longest);
    const auto end = std::to_chars(text_.data(), text_.data() + longest, value.real).ptr;
    value.text = std::isnan(value.real) ? std::string_view("nan")
                                        : std::string_view(text_).substr(
                                              0, static_cast<std::size_t>(end - text_.data()));
  }
  handler.change(net, value);
}

}  // namespace vp
