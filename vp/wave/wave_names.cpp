#include <algorithm>
#include <charconv>
#include <functional>
#include <map>
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

std::string with_range(const WaveDeclared& declared) {
  std::string text = declared.variable.path + "[" + std::to_string(declared.left);
  if (declared.left != declared.right) text += ":" + std::to_string(declared.right);
  return text + "]";
}

}  // namespace

void take_range(WaveDeclared& declared) {
  std::string& path = declared.variable.path;
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

namespace {

/// Finds paths; the table grows with them.
class NameTable {
 public:
  explicit NameTable(std::size_t most) : places_(std::size_t{16}) {
    while (places_.size() < most * 2) places_.resize(places_.size() * 2);
  }
  /// The slot of a path: 0 in it if missing.
  template <class PathAt>
  std::uint32_t& slot(std::string_view path, const PathAt& path_at) {
    const std::size_t mask = places_.size() - 1;
    for (std::size_t i = std::hash<std::string_view>{}(path)&mask;; i = (i + 1) & mask) {
      if (places_[i] == 0 || path_at(places_[i] - 1) == path) return places_[i];
    }
  }
  std::vector<std::uint32_t> take() { return std::move(places_); }

 private:
  std::vector<std::uint32_t> places_;
};

/// Declarations of one name in one scope: parts of a vector, or several signals.
class Namer {
 public:
  Namer(std::vector<WaveDeclared> declared, std::uint32_t nets, WaveNotes& notes)
      : all_(std::move(declared)), nets_(nets), notes_(notes), gone_(all_.size()) {}

  WaveNames names() {
    gather();
    for (auto& [first, group] : groups_) settle(group);
    number();
    WaveNames names;
    for (std::size_t i = 0; i < all_.size(); ++i) {
      if (!gone_[i]) names.variables.push_back(std::move(all_[i].variable));
    }
    names.joined = std::move(joined_);
    NameTable table(names.variables.size());
    for (std::uint32_t i = 0; i < names.variables.size(); ++i) {
      const auto path_at = [&](std::uint32_t place) -> std::string_view {
        return names.variables[place].path;
      };
      table.slot(names.variables[i].path, path_at) = i + 1;
    }
    names.table = table.take();
    return names;
  }

 private:
  using Place = std::uint32_t;

  /// Finds declarations of one name. The same net again is the same signal.
  void gather() {
    NameTable table(all_.size());
    const auto path_at = [&](Place place) -> std::string_view { return all_[place].variable.path; };
    for (Place i = 0; i < all_.size(); ++i) {
      Place& first = table.slot(all_[i].variable.path, path_at);
      if (first == 0) {
        first = i + 1;
        if (is_single(all_[i])) groups_[i] = {i};
        continue;
      }
      auto& group = groups_[first - 1];
      if (group.empty()) group.push_back(first - 1);
      const auto same = [&](Place other) {
        const WaveDeclared &a = all_[other], &b = all_[i];
        // One net under [15:0] and [0:15] is one signal; bits that share a net are not.
        return a.variable.net == b.variable.net && (!is_single(a) || a.left == b.left);
      };
      if (std::any_of(group.begin(), group.end(), same)) {
        gone_[i] = true;
      } else {
        group.push_back(i);
      }
    }
  }
  static bool is_single(const WaveDeclared& declared) {
    return declared.may_join && declared.is_single;
  }

  void settle(std::vector<Place>& group) {
    if (group.size() > 1 && join(group)) return;
    const bool parts =
        std::all_of(group.begin(), group.end(), [&](Place place) { return all_[place].may_join; });
    const bool any = std::any_of(group.begin(), group.end(),
                                 [&](Place place) { return is_single(all_[place]); });
    if (!parts || !any) return;
    for (const Place place : group) all_[place].variable.path = with_range(all_[place]);
  }

  /// Parts that adjoin, from the left to the right, up or down.
  bool adjoin(const std::vector<Place>& group) const {
    int direction = 0;
    for (std::size_t i = 0; i < group.size(); ++i) {
      const WaveDeclared& part = all_[group[i]];
      if (!part.may_join) return false;
      const auto go = [&](int step) {
        if (direction == 0) direction = step;
        return direction == step;
      };
      if (part.left != part.right && !go(part.left > part.right ? -1 : 1)) return false;
      if (i == 0) continue;
      const auto step = static_cast<__int128>(part.left) - all_[group[i - 1]].right;
      if ((step != 1 && step != -1) || !go(static_cast<int>(step))) return false;
    }
    return true;
  }

  bool join(std::vector<Place>& group) {
    if (!adjoin(group)) {
      std::vector<Place> sorted = group;
      std::stable_sort(sorted.begin(), sorted.end(),
                       [&](Place a, Place b) { return all_[a].left > all_[b].left; });
      if (!adjoin(sorted)) return false;
      group.swap(sorted);
    }
    std::vector<WavePart> parts;
    std::vector<std::uint64_t> key;
    unsigned width = 0;
    for (const Place place : group) {
      const WaveVariable& part = all_[place].variable;
      parts.push_back({part.net, part.width});
      key.push_back(std::uint64_t{part.net} << 32 | part.width);
      width += part.width;
      gone_[place] = true;
    }
    const auto [known, is_new] = nets_of_.emplace(std::move(key), nets_ + joined_.size());
    if (is_new) joined_.push_back(std::move(parts));
    const Place first = *std::min_element(group.begin(), group.end());
    gone_[first] = false;
    all_[first].variable.net = static_cast<std::uint32_t>(known->second);
    all_[first].variable.width = width;
    return true;
  }

  /// What has the name of another signal gets a number.
  void number() {
    NameTable table(all_.size());
    const auto path_at = [&](Place place) -> std::string_view { return all_[place].variable.path; };
    std::unordered_map<std::string, unsigned> next;
    for (Place i = 0; i < all_.size(); ++i) {
      if (gone_[i]) continue;
      std::string& path = all_[i].variable.path;
      if (table.slot(path, path_at) != 0) {
        notes_.add("a name is declared again with other values: it is called " +
                       shown(path + "#2") + " here",
                   all_[i].line);
        unsigned& count = next[path];
        const std::string base = path;
        do {
          path = base + "#" + std::to_string(++count + 1);
        } while (table.slot(path, path_at) != 0);
      }
      table.slot(path, path_at) = i + 1;
    }
  }

  std::vector<WaveDeclared> all_;
  std::uint32_t nets_;
  WaveNotes& notes_;
  std::vector<bool> gone_;
  std::map<Place, std::vector<Place>> groups_;  ///< by the first of a name
  std::map<std::vector<std::uint64_t>, std::size_t> nets_of_;
  std::vector<std::vector<WavePart>> joined_;
};

}  // namespace

WaveNames named(std::vector<WaveDeclared> declared, std::uint32_t nets, WaveNotes& notes) {
  return Namer(std::move(declared), nets, notes).names();
}

std::int64_t place_of(std::string_view path, const std::vector<WaveVariable>& variables,
                      const std::vector<std::uint32_t>& table) {
  const std::size_t mask = table.size() - 1;
  for (std::size_t i = std::hash<std::string_view>{}(path)&mask; table[i] != 0;
       i = (i + 1) & mask) {
    if (variables[table[i] - 1].path == path) return table[i] - 1;
  }
  return -1;
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
  WaveEnumeration table{words[0], {}};
  for (std::size_t i = 0; i < count; ++i) {
    std::string word;
    unescape(words[2 + i], word);
    table.words.emplace_back(words[2 + count + i], word);
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

}  // namespace

std::string clean_name(std::string_view name) {
  std::string clean;
  while (!name.empty()) {
    const auto first = static_cast<unsigned char>(name.front());
    std::size_t length = utf8_length(name);
    if (length == 0) {
      length = 1;
      clean += static_cast<char>(0xc0 | first >> 6);
      clean += static_cast<char>(0x80 | (first & 0x3f));
    } else if (first < ' ' || first == 0x7f) {
      clean += '?';
    } else {
      clean += name.substr(0, length);
    }
    name.remove_prefix(length);
  }
  return clean;
}

}  // namespace vp
