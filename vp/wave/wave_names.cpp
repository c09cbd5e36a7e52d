#include <algorithm>
#include <charconv>
#include <string>
#include <utility>

#include "wave_declared.h"

namespace vp {

namespace {

/// "[7:0]" or "[3]" at the end of a name, blanks allowed inside.
struct Range {
  std::size_t begin = std::string::npos;  ///< of the bracket
  std::int64_t left = 0, right = 0;
  bool is_single = false;
};

Range range_of(std::string_view name) {
  Range none;
  if (name.empty() || name.back() != ']') return none;
  const std::size_t open = name.rfind('[');
  if (open == std::string_view::npos || open == 0) return none;
  std::string inside;
  for (const char c : name.substr(open + 1, name.size() - open - 2)) {
    if (c != ' ') inside += c;
  }
  Range range;
  range.begin = open;
  const char* const end = inside.data() + inside.size();
  const auto left = std::from_chars(inside.data(), end, range.left);
  if (left.ec != std::errc()) return none;
  range.is_single = left.ptr == end;
  range.right = range.left;
  if (range.is_single) return range;
  if (*left.ptr != ':') return none;
  const auto right = std::from_chars(left.ptr + 1, end, range.right);
  return right.ec == std::errc() && right.ptr == end ? range : none;
}

std::uint64_t bits_of(std::int64_t left, std::int64_t right) {
  const auto span = static_cast<__int128>(left) - right;
  return static_cast<std::uint64_t>(span < 0 ? -span : span) + 1;
}

}  // namespace

void take_range(WaveDeclared& declared) {
  std::string& path = declared.path;
  const Range range = range_of(path);
  if (range.begin == std::string::npos || path[range.begin - 1] == '.') return;
  const WaveVariable& variable = declared.variable;
  const bool is_bits = variable.kind == WaveVariable::Kind::bits && !variable.is_event;
  const bool apart = path[range.begin - 1] == ' ';
  const bool fits = is_bits && bits_of(range.left, range.right) == variable.width;
  // An index right behind the name, or one that does not say how many bits there are, is an element
  // of an array. VHDL's "tid[-1:0]" has no bits.
  const bool takes =
      range.is_single ? apart && fits : apart || fits || !is_bits || variable.width == 0;
  if (!takes) {
    const std::size_t name_end = path.find_last_not_of(' ', range.begin - 1) + 1;
    path.erase(name_end, range.begin - name_end);
    return;
  }
  path.erase(range.begin);
  path.erase(path.find_last_not_of(' ') + 1);
  declared.left = range.left;
  declared.right = range.right;
  declared.may_join = fits;
  declared.is_single = range.is_single;
}

void WaveNotes::add(const std::string& text, std::uint64_t line) {
  if (closed_) return;
  // What differs from one to the next is in quotes.
  const auto same = [&](const Note& note) {
    return note.text.substr(0, note.text.find('\'')) == text.substr(0, text.find('\''));
  };
  const auto found = std::find_if(notes_.begin(), notes_.end(), same);
  if (found == notes_.end()) {
    notes_.push_back({text, 1, line});
  } else {
    ++found->count;
  }
}

std::vector<std::string> WaveNotes::texts() const {
  std::vector<std::string> texts;
  for (const Note& note : notes_) {
    std::string text = note.text;
    if (note.line != 0 || note.count > 1) text += " (";
    if (note.count > 1) text += std::to_string(note.count) + " times";
    if (note.count > 1 && note.line != 0) text += ", first in ";
    if (note.line != 0) text += "line " + std::to_string(note.line);
    if (note.line != 0 || note.count > 1) text += ")";
    texts.push_back(std::move(text));
  }
  return texts;
}

void WaveEnumerations::attribute(std::string_view text, std::uint64_t handle) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    if (end > at) words.emplace_back(text.substr(at, end - at));
    at = end + 1;
  }
  if (words.empty() || words.front() == "\"\"") {
    const auto known = place_of_.find(handle);
    pending_ = known == place_of_.end() ? 0 : known->second + 1;
    return;
  }
  std::size_t count = 0;
  if (words.size() > 1) {
    std::from_chars(words[1].data(), words[1].data() + words[1].size(), count);
  }
  if (count == 0 || count > words.size() || words.size() < 2 + 2 * count) return;
  WaveEnumeration table{in_utf8(words[0]), {}};
  for (std::size_t i = 0; i < count; ++i) {
    std::string word;
    unescape(words[2 + i], word);
    table.words.emplace_back(words[2 + count + i], in_utf8(word));
  }
  place_of_[handle] = static_cast<std::uint32_t>(all.size());
  all.push_back(std::move(table));
}

std::uint32_t WaveEnumerations::take() {
  return std::exchange(pending_, 0);
}

std::string shown(std::string_view word) {
  constexpr std::size_t longest = 40;
  std::string text;
  for (const char c : word.substr(0, longest)) text += c > ' ' && c <= '~' ? c : '?';
  return "'" + text + (word.size() > longest ? "...'" : "'");
}

void unescape(std::string_view from, std::string& to) {
  to.clear();
  for (std::size_t i = 0; i < from.size(); ++i) {
    if (from[i] != '\\' || i + 1 == from.size()) {
      to += from[i];
      continue;
    }
    const bool hexadecimal = from[i + 1] == 'x';
    const std::string_view digits = from.substr(i + (hexadecimal ? 2 : 1), hexadecimal ? 2 : 3);
    unsigned value = 0;
    const auto end =
        std::from_chars(digits.data(), digits.data() + digits.size(), value, hexadecimal ? 16 : 8);
    if (end.ec == std::errc() && end.ptr == digits.data() + digits.size()) {
      to += static_cast<char>(value);
      i += digits.size() + (hexadecimal ? 1 : 0);
    } else {
      constexpr std::string_view letters = "nrt", meant = "\n\r\t";
      const auto letter = letters.find(from[++i]);
      to += letter == std::string_view::npos ? from[i] : meant[letter];
    }
  }
}

namespace {

/// Bytes of the character of UTF-8 that begins the text; 0 if none does.
std::size_t utf8_length(std::string_view text) {
  const auto first = static_cast<unsigned char>(text.front());
  const std::size_t length = first < 0x80 ? 1 : first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first >= 0xf5 || (first >= 0x80 && first < 0xc2) || length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((static_cast<unsigned char>(text[i]) & 0xc0) != 0x80) return 0;
  }
  return length;
}

void add_latin1(std::string& text, unsigned char byte) {
  text += static_cast<char>(0xc0 | byte >> 6);
  text += static_cast<char>(0x80 | (byte & 0x3f));
}

}  // namespace

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

std::string in_utf8(std::string_view text) {
  std::string result;
  for (std::size_t length = 0; !text.empty(); text.remove_prefix(length)) {
    length = utf8_length(text);
    if (length != 0) {
      result += text.substr(0, length);
    } else {
      add_latin1(result, static_cast<unsigned char>(text.front()));
      length = 1;
    }
  }
  return result;
}

std::string clean_name(std::string_view name) {
  std::string clean = in_utf8(name);
  for (char& c : clean) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < ' ' || byte == 0x7f) c = '?';
  }
  return clean;
}

}  // namespace vp
